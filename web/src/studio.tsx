// The page of `rholm studio`.
import { render } from "preact";
import "uplot/dist/uPlot.min.css";
import "./theme.css";
import "./style.css";
import { start, unsaved } from "./actions";
import { App } from "./app";
import { idle } from "./idle";
import { listenToKeys } from "./keys";
import { latencies } from "./latency";
import { setTheme, theme } from "./state";
import { forgetWithItem } from "./tools/brush";
import { followItem } from "./tools/degrees";
import { followWavelength } from "./tools/smooth";
import { followShape } from "./tools/texture";

const page = document.getElementById("page");
if (!page) throw new Error("this document is not the studio's");
window.rholmLatency = latencies;
window.rholmIdle = idle;
setTheme(theme.value);
render(<App />, page);
followItem();
followWavelength();
followShape();
forgetWithItem();
listenToKeys();
window.addEventListener("beforeunload", (event) => unsaved().length > 0 && event.preventDefault());
void start();
