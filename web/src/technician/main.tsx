import { render } from "preact";
import { connect } from "@/live/page";
import "uplot/dist/uPlot.min.css";
import "@/style/tokens.css";
import "@/style/page.css";
import "@/style/controls.css";
import "@/style/cards.css";
import "@/style/views.css";
import "./bench.css";
import "./jog/jog.css";
import "./readings/readings.css";
import { Technician } from "./app";

const root = document.getElementById("app");
if (root === null) throw new Error("technician.html has no element #app");
connect();
render(<Technician />, root);
