import { render } from "preact";
import { Door } from "./access/door";
import { begin } from "./access/session";
import "./style/tokens.css";
import "./style/page.css";
import "./style/controls.css";
import "./style/cards.css";
import "./style/steps.css";
import "./style/views.css";
import "./style/picture.css";
import "./style/history.css";
import "./access/access.css";

const root = document.getElementById("app");
if (root === null) throw new Error("index.html has no element #app");
render(<Door />, root);
void begin();
