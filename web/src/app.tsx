// The page: what is open on the left, the shape, one panel for each activity.
import type { ComponentType } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { quit, redo, removeItem, transport, undo } from "./actions";
import { bytes, count } from "./format";
import { help } from "./keys";
import { AlignPanel } from "./panels/align";
import { CapsPanel } from "./panels/caps";
import { DegreesPanel } from "./panels/degrees";
import { FiguresPanel, FileButton } from "./panels/figures";
import { PointsPanel } from "./panels/points";
import { SavePanel } from "./panels/save";
import { SmoothPanel } from "./panels/smooth";
import { TexturePanel } from "./panels/texture";
import type { Item } from "./protocol";
import { Stage } from "./stage";
import { helpOpen, items, selected, setTheme, studio, tab, tabs, theme, type Tab } from "./state";

const panels: Record<Tab, ComponentType> = {
  figures: FiguresPanel,
  degrees: DegreesPanel,
  smooth: SmoothPanel,
  texture: TexturePanel,
  points: PointsPanel,
  caps: CapsPanel,
  align: AlignPanel,
  save: SavePanel,
};

function summary(one: Item): string {
  if (one.kind === "points") return `${count(one.vertices)} points`;
  if (one.kind === "atlas") return `${one.caps ?? 0} caps, ${bytes(one.atlas?.bytes ?? 0)}`;
  const faces = `${count(one.faces)} faces`;
  return one.expansion ? `${faces} · degree ${one.expansion.degree}` : faces;
}

function Items() {
  return (
    <nav class="items" aria-label="Shapes">
      <FileButton />
      <ul>
        {items.value.map((one) => (
          <li key={one.id} class={one.id === selected.value ? "chosen" : ""}>
            <button
              type="button"
              aria-current={one.id === selected.value}
              onClick={() => (selected.value = one.id)}
            >
              <span class="name">{one.name}</span>
              <small>{summary(one)}</small>
            </button>
            <button
              type="button"
              class="remove"
              aria-label={`Remove ${one.name}`}
              title="Remove"
              onClick={() => void removeItem(one)}
            >
              ×
            </button>
          </li>
        ))}
      </ul>
    </nav>
  );
}

function Head() {
  const next = { auto: "light", light: "dark", dark: "auto" } as const;
  const state = studio.value;
  return (
    <header>
      <strong>rholm studio</strong>
      <span class="grow" />
      <button
        type="button"
        disabled={!state?.undo}
        title={state?.undo ? `Undo: ${state.undo} (Ctrl Z)` : "Nothing to undo"}
        onClick={() => void undo()}
      >
        Undo
      </button>
      <button
        type="button"
        disabled={!state?.redo}
        title={state?.redo ? `Redo: ${state.redo} (Ctrl Shift Z)` : "Nothing to redo"}
        onClick={() => void redo()}
      >
        Redo
      </button>
      <button type="button" title="Light, dark, or as the system" onClick={() => setTheme(next[theme.value])}>
        {{ auto: "Light/dark", light: "Light", dark: "Dark" }[theme.value]}
      </button>
      <button type="button" aria-label="Keys" title="Keys (?)" onClick={() => (helpOpen.value = true)}>
        ?
      </button>
    </header>
  );
}

function Tabs() {
  const move = (event: KeyboardEvent) => {
    const way = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!way) return;
    const at = tabs.findIndex(([key]) => key === tab.value);
    const next = tabs[(at + way + tabs.length) % tabs.length];
    if (!next) return;
    tab.value = next[0];
    document.getElementById(`tab-${next[0]}`)?.focus();
  };
  return (
    <div class="tabs" role="tablist" aria-label="Activities" onKeyDown={move}>
      {tabs.map(([key, label]) => (
        <button
          key={key}
          id={`tab-${key}`}
          type="button"
          role="tab"
          aria-selected={tab.value === key}
          aria-controls="panel"
          tabIndex={tab.value === key ? 0 : -1}
          onClick={() => (tab.value = key)}
        >
          {label}
        </button>
      ))}
    </div>
  );
}

function Help() {
  const dialog = useRef<HTMLDialogElement>(null);
  const open = helpOpen.value;
  useEffect(() => {
    if (open) dialog.current?.showModal();
    else dialog.current?.close();
  }, [open]);
  return (
    <dialog ref={dialog} aria-label="Keys" onClose={() => (helpOpen.value = false)}>
      <h2>Keys</h2>
      <dl class="facts">
        {help.map(([keys, what]) => (
          <div key={keys}>
            <dt>
              <kbd>{keys}</kbd>
            </dt>
            <dd>{what}</dd>
          </div>
        ))}
      </dl>
      <p class="hint">Version {studio.value?.version}. Nothing leaves this machine.</p>
      <div class="row">
        <button type="button" class="main" onClick={() => (helpOpen.value = false)}>
          Close
        </button>
        {transport.endsProgram && (
          <button type="button" onClick={() => void quit().then(() => (helpOpen.value = false))}>
            Stop the program
          </button>
        )}
      </div>
    </dialog>
  );
}

export function App() {
  const Panel = panels[tab.value];
  return (
    <div class="page">
      <Head />
      <Items />
      <Stage />
      <aside>
        <Tabs />
        <div id="panel" role="tabpanel" aria-labelledby={`tab-${tab.value}`} class="panel">
          <Panel key={tab.value} />
        </div>
      </aside>
      <Help />
    </div>
  );
}
