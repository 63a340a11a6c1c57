// The keyboard. `help` lists what `onKey` does.
import { openFiles, redo, undo } from "./actions";
import { theView } from "./show";
import { helpOpen, tab, tabs } from "./state";
import { radiusShare, setRadius } from "./tools/brush";
import { undoStroke } from "./tools/smooth";

export const help: readonly (readonly [keys: string, what: string])[] = [
  ["1 … 8", "the panels, in their order"],
  ["← → ↑ ↓", "turn the shape (when it has the focus)"],
  ["+ and −", "nearer, further"],
  ["F", "all of the shape in view"],
  ["[ and ]", "a smaller, a larger brush; also Alt and the wheel"],
  ["Ctrl Z", "undo; of a brush, its last stroke"],
  ["Ctrl Shift Z, Ctrl Y", "redo"],
  ["?", "this list"],
  ["Esc", "close it"],
];

const turn = Math.PI / 18; // 10 degrees; chosen
const zoom = 1.15; // chosen
const brushStep = 1.15; // chosen

function typing(event: KeyboardEvent): boolean {
  const target = event.target as HTMLElement;
  const input = target instanceof HTMLInputElement && !["range", "checkbox", "file"].includes(target.type);
  return input || target instanceof HTMLTextAreaElement;
}

function command(event: KeyboardEvent): (() => unknown) | null {
  const key = event.key.toLowerCase();
  if (key === "z") return event.shiftKey ? redo : () => undoStroke() || undo();
  return key === "y" ? redo : null;
}

function grow(factor: number, since: number): void {
  setRadius(radiusShare.value * factor, since);
}

function plainKey(event: KeyboardEvent): (() => unknown) | null {
  const view = theView();
  const number = Number(event.key);
  const chosen = tabs[number - 1];
  if (number >= 1 && chosen) return () => (tab.value = chosen[0]);
  switch (event.key) {
    case "?":
      return () => (helpOpen.value = !helpOpen.value);
    case "Escape":
      return () => (helpOpen.value = false);
    case "f":
      return () => view?.fit();
    case "+":
    case "=":
      return () => view?.zoom(zoom);
    case "-":
      return () => view?.zoom(1 / zoom);
    case "[":
      return () => grow(1 / brushStep, event.timeStamp);
    case "]":
      return () => grow(brushStep, event.timeStamp);
    default:
      return event.target instanceof HTMLCanvasElement ? arrow(event.key) : null;
  }
}

function arrow(key: string): (() => unknown) | null {
  const view = theView();
  const ways: Record<string, [number, number]> = {
    ArrowLeft: [-turn, 0],
    ArrowRight: [turn, 0],
    ArrowUp: [0, -turn],
    ArrowDown: [0, turn],
  };
  const way = ways[key];
  return way ? () => view?.turn(...way) : null;
}

function onKey(event: KeyboardEvent): void {
  if (typing(event)) return;
  const control = event.ctrlKey || event.metaKey;
  const work = control ? command(event) : event.altKey ? null : plainKey(event);
  if (!work) return;
  event.preventDefault();
  work();
}

export function listenToKeys(): void {
  document.addEventListener("keydown", onKey);
}

// Listens to the brush's wheel, and to files dropped anywhere on the page.
export function listenToPointer(stage: HTMLElement, over: (yes: boolean) => void): void {
  const wheel = (event: WheelEvent) => {
    if (!event.altKey) return;
    event.preventDefault();
    grow(event.deltaY < 0 ? brushStep : 1 / brushStep, event.timeStamp);
  };
  stage.addEventListener("wheel", wheel, { capture: true, passive: false });
  document.addEventListener("dragover", (event) => {
    event.preventDefault();
    over(true);
  });
  document.addEventListener("dragleave", (event) => {
    if (!event.relatedTarget) over(false);
  });
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    over(false);
    void openFiles([...(event.dataTransfer?.files ?? [])]);
  });
}
