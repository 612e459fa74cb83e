import { render } from "preact";
import { Door } from "@/access/door";
import { begin } from "@/access/session";
import { stayFresh } from "@/installed/freshness";
import "@/style/tokens.css";
import "@/style/page.css";
import "@/style/controls.css";
import "@/style/cards.css";
import "@/style/notices.css";
import "@/style/picture.css";
import "@/style/time-left.css";
import "@/access/access.css";
import "./kiosk.css";
import { Kiosk } from "./app";
import { Unpaired } from "./unpaired";

const root = document.getElementById("app");
if (root === null) throw new Error("kiosk.html has no element #app");
document.documentElement.classList.add("kiosk");
// A long press means nothing here: there is no keyboard and no menu.
addEventListener("contextmenu", (event) => event.preventDefault());
render(<Door page={Kiosk} stranger={Unpaired} />, root);
void begin();
stayFresh();
