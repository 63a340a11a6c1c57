// The viewer of static pages and notebooks is one module without a server:
// - default.render({model, el}) is for anywidget. The model's `data` are the bytes of src/viewdata.ts.
// - mount(element, data) is for any element. It returns a function that removes the viewer.
// - mountPage() is for a page with the bytes as base64 in #rholm-data, and a place #rholm-view.
import { render as draw } from "preact";
import plotStyle from "uplot/dist/uPlot.min.css?inline";
import style from "./style.css?inline";
import theme from "./theme.css?inline";
import viewerStyle from "./viewer/viewer.css?inline";
import { decodeViewData, fromBase64, type ViewData } from "./viewdata";
import { Viewer } from "./viewer/widget";

export { decodeViewData, type ViewData };

export interface AnyModel {
  get(name: string): unknown;
  on(event: string, listener: () => void): void;
  off(event: string, listener: () => void): void;
}

export function mount(element: HTMLElement, data: ViewData): () => void {
  const root = element.shadowRoot ?? element.attachShadow({ mode: "open" });
  const sheet = document.createElement("style");
  sheet.textContent = plotStyle + theme + style + viewerStyle;
  const place = document.createElement("div");
  root.replaceChildren(sheet, place);
  draw(<Viewer data={data} />, place);
  return () => {
    draw(null, place);
    root.replaceChildren();
  };
}

function bytesOf(value: unknown): Uint8Array {
  if (value instanceof DataView) return new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
  if (value instanceof Uint8Array) return value;
  throw new Error("the model's data are no bytes");
}

function render({ model, el }: { model: AnyModel; el: HTMLElement }): () => void {
  let end: (() => void) | null = null;
  const show = () => {
    end?.();
    end = mount(el, decodeViewData(bytesOf(model.get("data"))));
  };
  show();
  model.on("change:data", show);
  return () => {
    model.off("change:data", show);
    end?.();
  };
}

export function mountPage(): void {
  const data = document.getElementById("rholm-data");
  const place = document.getElementById("rholm-view");
  if (!data || !place) throw new Error("this page has no #rholm-data or no #rholm-view");
  mount(place, decodeViewData(fromBase64(data.textContent)));
}

export default { render };

// A static page contains its data and starts by itself.
if (document.getElementById("rholm-data") && document.getElementById("rholm-view")) mountPage();
