// The studio in a notebook, for anywidget. The page has its own frame for its
// keys, styles and dialogs; its messages are forwarded to Python and back.
import page from "../dist/assets/studio.js?raw";
import style from "../dist/assets/studio.css?raw";
import type { Answered, Asked, Told, Welcome } from "./messages";

export interface MessageModel {
  get(name: string): unknown;
  send(content: unknown, callbacks?: unknown, buffers?: ArrayBufferView[]): void;
  on(event: "msg:custom", listener: (content: FromPython, buffers: DataView[]) => void): void;
  off(event: "msg:custom", listener: (content: FromPython, buffers: DataView[]) => void): void;
}

// The bytes of an answer are in the buffer beside it.
export type FromPython =
  | { answer: { view: number; id: number; status: number; type: string } }
  | Told;

// Returns a self-contained document.
export function frameDocument(script: string, sheet: string): string {
  const safe = script.replaceAll("</script", "<\\/script");
  return `<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta name="rholm-frame" content="notebook" />
    <title>rholm studio</title>
    <style>${sheet}</style>
  </head>
  <body>
    <div id="page"></div>
    <script type="module">${safe}</script>
  </body>
</html>`;
}

function bytesOf(buffer: DataView | undefined): Uint8Array {
  if (!buffer) return new Uint8Array();
  return new Uint8Array(buffer.buffer, buffer.byteOffset, buffer.byteLength).slice();
}

let views = 0; // number of views of this model: an answer belongs to one view, events to all

// Forwards requests of the frame behind the port, and Python's messages; returns a function that stops this.
export function relay(model: MessageModel, port: MessagePort): () => void {
  const view = (views += 1);
  port.onmessage = ({ data: { body, ...asked } }: MessageEvent<Asked>) => {
    model.send({ view, ...asked }, undefined, body ? [body] : []);
  };
  const hear = (said: FromPython, buffers: DataView[]) => {
    if (!("answer" in said)) {
      port.postMessage(said);
    } else if (said.answer.view === view) {
      const bytes = bytesOf(buffers[0]);
      port.postMessage({ answer: { ...said.answer, bytes } } satisfies Answered, [bytes.buffer]);
    }
  };
  model.on("msg:custom", hear);
  return () => {
    model.off("msg:custom", hear);
    port.close();
  };
}

function render({ model, el }: { model: MessageModel; el: HTMLElement }): () => void {
  const frame = document.createElement("iframe");
  frame.title = "rholm studio";
  frame.allow = "fullscreen; clipboard-write";
  frame.style.cssText = `display: block; width: 100%; border: 0; height: ${String(model.get("height"))}px`;
  frame.srcdoc = frameDocument(page, style);
  let end: (() => void) | null = null;
  frame.onload = () => {
    end?.(); // a notebook that moves a frame loads it again
    const { port1, port2 } = new MessageChannel();
    end = relay(model, port1);
    const welcome: Welcome = { welcome: { session: String(model.get("session")) } };
    frame.contentWindow?.postMessage(welcome, "*", [port2]);
  };
  el.replaceChildren(frame);
  return () => {
    end?.();
    frame.remove();
  };
}

export default { render };
