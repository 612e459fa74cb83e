import { render } from "preact";
import { App } from "./app";
import { connect } from "./live/page";
import "./style/tokens.css";
import "./style/page.css";
import "./style/controls.css";
import "./style/cards.css";
import "./style/steps.css";
import "./style/views.css";
import "./style/picture.css";
import "./style/history.css";
import "./guidance/guidance.css";
import "./style/plan.css";
import "./style/notices.css";

const root = document.getElementById("app");
if (root === null) throw new Error("index.html has no element #app");
connect();
render(<App />, root);
