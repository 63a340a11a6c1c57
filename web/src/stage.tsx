// The canvas and what lies over it: legend, progress, notices.
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { cancelJob, start, transport } from "./actions";
import { listenToPointer } from "./keys";
import { ColorScale } from "./plots/legend";
import { NoWebGlError, View } from "./scene/view";
import { attach, layout, legend, theView } from "./show";
import { busy, job, lost, notice, stopped } from "./state";

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
  return (
    <div class={said.bad ? "notice bad" : "notice"} role="alert">
      <p>{said.text}</p>
      <button type="button" onClick={() => (notice.value = null)}>
        Close
      </button>
    </div>
  );
}

function ViewButtons() {
  return (
    <div class="view-buttons">
      <button type="button" title="All of it in view (F)" onClick={() => theView()?.fit()}>
        Fit
      </button>
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
      {layout.value === "side" && (
        <div class="captions" aria-hidden="true">
          <span>original</span>
          <span>now</span>
        </div>
      )}
      <ViewButtons />
      {legend.value && <ColorScale {...legend.value} />}
      {trouble.value && (
        <div class="notice" role="alert">
          <p>{trouble.value}</p>
        </div>
      )}
      {dropping.value && <div class="drop">Drop it: meshes, points, models, sessions</div>}
      <Notice />
      <Progress />
    </main>
  );
}
