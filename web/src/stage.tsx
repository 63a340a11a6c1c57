// The canvas and the elements over it: legend, progress, notices.
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { cancelJob, start, transport } from "./actions";
import { shortened } from "./format";
import { ups, views, type Up, type ViewName } from "./geometry/up";
import { listenToPointer } from "./keys";
import { FileButton, MakeShape } from "./panels/figures";
import { ColorScale } from "./plots/legend";
import { Axes, ScaleBar } from "./plots/sight";
import { NoWebGlError, View } from "./scene/view";
import { attach, layout, legend, setUp, shown, theView, up } from "./show";
import { busy, item, items, job, lost, notice, stopped, studio, working } from "./state";

function Progress() {
  const running = job.value;
  if (running?.state === "running") {
    return (
      <div class="progress" role="status">
        <span>
          {running.label}: {running.stage} ({Math.round(running.seconds)} s)
        </span>
        <progress value={running.fraction} max={1} aria-label={running.label} />
        <button type="button" onClick={() => void cancelJob()}>
          Cancel
        </button>
      </div>
    );
  }
  if (!busy.value) return null;
  return (
    <div class="progress" role="status">
      <span>{busy.value} …</span>
    </div>
  );
}

function Notice() {
  if (stopped.value) {
    return (
      <div class="notice" role="alert">
        <p>The program has ended. This page can be closed.</p>
      </div>
    );
  }
  if (lost.value) {
    return (
      <div class="notice bad" role="alert">
        <p>The studio does not answer. Is the {transport.program} still running?</p>
        <button type="button" onClick={() => void start()}>
          Try again
        </button>
      </div>
    );
  }
  const said = notice.value;
  if (!said) return null;
  const { first, rest } = shortened(said.text);
  return (
    <div class={said.bad ? "notice bad" : "notice"} role="alert">
      <div class="text">
        <p>{first}</p>
        {rest && (
          <details key={said.text}>
            <summary>More</summary>
            <p>{rest}</p>
          </details>
        )}
      </div>
      <button type="button" onClick={() => (notice.value = null)}>
        Close
      </button>
    </div>
  );
}

// Buttons of the camera, axes and scale, below the shape so that they do not cover it.
function ViewBar() {
  const view = theView();
  const sight = view?.sight.value;
  if (!shown.value || !view) return null;
  return (
    <div class="view-bar">
      {sight && <Axes axes={sight.axes} />}
      {sight && <ScaleBar perPixel={sight.perPixel} unit={item.value?.unit ?? ""} />}
      <span class="grow" />
      <div class="view-buttons">
        <select
          aria-label="View from"
          title="Look from there"
          value=""
          onChange={(event) => {
            view.lookFrom(event.currentTarget.value as ViewName);
            event.currentTarget.value = "";
          }}
        >
          <option value="">View …</option>
          {views.map(([name, label]) => (
            <option key={name} value={name}>
              {label}
            </option>
          ))}
        </select>
        <select
          aria-label="Axis that points up"
          title="Axis that points up; remembered for this shape"
          value={up.value}
          onChange={(event) => setUp(event.currentTarget.value as Up)}
        >
          {ups.map((axis) => (
            <option key={axis} value={axis}>
              {axis.toUpperCase()} up
            </option>
          ))}
        </select>
        <button type="button" title="All of it in view (F)" onClick={() => view.fit()}>
          Fit
        </button>
      </div>
    </div>
  );
}

// Shown if nothing is open.
function Empty() {
  if (!studio.value || items.value.length > 0 || working.value || lost.value) return null;
  return (
    <div class="empty">
      <strong>Drop files here</strong>
      <p>Meshes, points, models, sessions</p>
      <div class="row wrap">
        <FileButton />
        <MakeShape />
      </div>
    </div>
  );
}

export function Stage() {
  const host = useRef<HTMLDivElement>(null);
  const trouble = useSignal("");
  const dropping = useSignal(false);
  useEffect(() => {
    const element = host.current;
    if (!element) return undefined;
    listenToPointer(element, (yes) => (dropping.value = yes));
    try {
      const view = new View(element);
      attach(view);
      return () => view.dispose();
    } catch (error) {
      if (!(error instanceof NoWebGlError)) throw error;
      trouble.value = `${error.message} Shapes cannot be shown; files, figures and steps still work.`;
      return undefined;
    }
  }, []);
  return (
    <main class="stage">
      <div class="canvas" ref={host} />
      <div class="over">
        {trouble.value && (
          <div class="notice" role="alert">
            <p>{trouble.value}</p>
          </div>
        )}
        <Notice />
        {layout.value === "side" && (
          <div class="captions" aria-hidden="true">
            <span>original</span>
            <span>now</span>
          </div>
        )}
        {legend.value && <ColorScale {...legend.value} />}
        <span class="grow" />
        <Progress />
        <ViewBar />
      </div>
      <Empty />
      {dropping.value && <div class="drop">Drop it: meshes, points, models, sessions</div>}
    </main>
  );
}
