import { render } from "preact";
import { Door } from "@/access/door";
import { begin } from "@/access/session";
import "uplot/dist/uPlot.min.css";
import "@/style/tokens.css";
import "@/style/page.css";
import "@/style/controls.css";
import "@/style/cards.css";
import "@/style/notices.css";
import "@/style/views.css";
import "@/access/access.css";
import "./bench.css";
import "./jog/jog.css";
import "./readings/readings.css";
import "./parts/panel.css";
import "./camera/camera.css";
import "./target/target.css";
import "./console/console.css";
import "./config/config.css";
import "./diagnostics/diagnostics.css";
import { PageStop } from "@/parts/modal";
import { Technician } from "./app";
import { StopButtons } from "./stop";

const root = document.getElementById("app");
if (root === null) throw new Error("technician.html has no element #app");
render(
  <PageStop.Provider value={StopButtons}>
    <Door page={Technician} />
  </PageStop.Provider>,
  root,
);
void begin();
