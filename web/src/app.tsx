// The page: open items on the left, the shape, tabs of activities, the panel of the chosen tab.
import type { Signal } from "@preact/signals";
import type { ComponentChildren, ComponentType } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { quit, redo, removeItem, saveSession, transport, undo, unsaved } from "./actions";
import { bytes, count } from "./format";
import { Icon } from "./icons";
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
import {
  helpOpen,
  items,
  lost,
  nameOf,
  quitOpen,
  selected,
  setTheme,
  studio,
  tab,
  tabs,
  theme,
  working,
  type Tab,
} from "./state";
import { shownDegree } from "./tools/degrees";

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
  return one.expansion ? `${faces} · ${shownDegree(one)}` : faces;
}

function Items() {
  const list = useRef<HTMLUListElement>(null);
  useEffect(() => {
    list.current?.querySelector(".chosen")?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }, [selected.value, items.value]);
  return (
    <nav class="items" aria-label="Shapes">
      <FileButton />
      <ul ref={list}>
        {items.value.map((one) => (
          <li key={one.id} class={one.id === selected.value ? "chosen" : ""}>
            <button
              type="button"
              aria-current={one.id === selected.value}
              title={one.name}
              onClick={() => (selected.value = one.id)}
            >
              <span class="name">{nameOf(one)}</span>
              <small>{summary(one)}</small>
            </button>
            <button
              type="button"
              class="remove"
              aria-label={`Remove ${nameOf(one)}`}
              title={`Remove ${one.name}`}
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
        <Icon name="undo" />
        <span>Undo</span>
      </button>
      <button
        type="button"
        disabled={!state?.redo}
        title={state?.redo ? `Redo: ${state.redo} (Ctrl Shift Z)` : "Nothing to redo"}
        onClick={() => void redo()}
      >
        <Icon name="redo" />
        <span>Redo</span>
      </button>
      <button type="button" title="Light, dark, or as the system" onClick={() => setTheme(next[theme.value])}>
        <Icon name="theme" />
        <span>{{ auto: "Light/dark", light: "Light", dark: "Dark" }[theme.value]}</span>
      </button>
      <button type="button" aria-label="Help" title="Help: the keys (?)" onClick={() => (helpOpen.value = true)}>
        <Icon name="help" />
      </button>
      {transport.endsProgram && (
        <button
          type="button"
          class="apart"
          title="Stop the program; asks first"
          onClick={() => (quitOpen.value = true)}
        >
          <Icon name="stop" />
          <span>Quit</span>
        </button>
      )}
    </header>
  );
}

function Tabs() {
  const move = (event: KeyboardEvent) => {
    const way = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!way) return;
    event.preventDefault();
    const at = tabs.findIndex(([key]) => key === tab.value);
    const next = tabs[(at + way + tabs.length) % tabs.length];
    if (!next) return;
    tab.value = next[0];
    document.getElementById(`tab-${next[0]}`)?.focus();
  };
  return (
    <div class="tabs" role="tablist" aria-label="Activities" aria-orientation="vertical" onKeyDown={move}>
      {tabs.map(([key, label], i) => (
        <button
          key={key}
          id={`tab-${key}`}
          type="button"
          role="tab"
          title={`${label} (${i + 1})`}
          aria-selected={tab.value === key}
          aria-controls="panel"
          tabIndex={tab.value === key ? 0 : -1}
          onClick={() => (tab.value = key)}
        >
          <Icon name={key} />
          <span>{label}</span>
        </button>
      ))}
    </div>
  );
}

// Dialog that is open while the signal is true.
function Dialog({ open, label, children }: { open: Signal<boolean>; label: string; children: ComponentChildren }) {
  const dialog = useRef<HTMLDialogElement>(null);
  const wanted = open.value;
  useEffect(() => {
    if (wanted) dialog.current?.showModal();
    else dialog.current?.close();
  }, [wanted]);
  return (
    <dialog ref={dialog} aria-label={label} onClose={() => (open.value = false)}>
      {wanted && children}
    </dialog>
  );
}

function Help() {
  return (
    <Dialog open={helpOpen} label="Keys">
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
      <button type="button" class="main" onClick={() => (helpOpen.value = false)}>
        Close
      </button>
    </Dialog>
  );
}

async function stop(): Promise<void> {
  quitOpen.value = false;
  await quit();
}

async function saveAndStop(): Promise<void> {
  if (await saveSession()) await stop();
  else quitOpen.value = false;
}

// The first button loses nothing, so it has the focus.
function QuitQuestion() {
  const losing = unsaved();
  const [first, ...others] = losing.map(nameOf);
  return (
    <>
      <h2>Stop the program?</h2>
      <p class="hint">
        {first && `Not saved as shown: ${first}${others.length > 0 ? ` and ${count(others.length)} more` : ""}. `}
        {first ? "Every other page of this studio ends, too." : "The page ends with it, and every other page of this studio."}
        {working.value && " The work that runs is cancelled."}
      </p>
      <div class="row wrap">
        <button type="button" class="main" autofocus onClick={() => (quitOpen.value = false)}>
          Keep working
        </button>
        {first && (
          <button type="button" disabled={working.value || lost.value} onClick={() => void saveAndStop()}>
            Save the session and stop
          </button>
        )}
        <button type="button" class="danger" onClick={() => void stop()}>
          {first ? "Stop without saving" : "Stop the program"}
        </button>
      </div>
    </>
  );
}

export function App() {
  const Panel = panels[tab.value];
  return (
    <div class="page">
      <Head />
      <Items />
      <Stage />
      <Tabs />
      {/* A new panel starts at its top; the scroll position is not kept. */}
      <div key={tab.value} id="panel" role="tabpanel" aria-labelledby={`tab-${tab.value}`} class="panel">
        <Panel />
      </div>
      <Help />
      <Dialog open={quitOpen} label="Stop the program">
        <QuitQuestion />
      </Dialog>
    </div>
  );
}
