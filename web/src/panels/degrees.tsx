import { useEffect } from "preact/hooks";
import { step } from "../actions";
import { Button } from "../button";
import { MoreOptions, NumberControl } from "../controls";
import { percent, withUnit } from "../format";
import { bandMeans } from "../harmonics/bands";
import { Option, othersChosen } from "../options";
import { Spectrum } from "../plots/spectrum";
import type { Item } from "../protocol";
import { coloring, hideOther, layout, showOther } from "../show";
import { item, tab, theme } from "../state";
import { MarkOffending } from "./figures";
import { WindowChoice } from "./windows";
import * as tool from "../tools/degrees";
import { Check, Hint, Select, Slider } from "../widgets";

const wanted = new Option<number>("expand", "degree");

// Explains why the item has no degrees, if this is known beforehand, and offers other steps.
function NoDegrees({ one }: { one: Item }) {
  if (one.faces === 0) {
    return (
      <>
        <Hint>Only closed surfaces have degrees. First make a surface of these points.</Hint>
        <Button main onClick={() => (tab.value = "points")}>
          Make a surface
        </Button>
      </>
    );
  }
  if (!one.closed) {
    return (
      <>
        <Hint>Only closed surfaces have degrees, and this one is open. Repair closes it; Caps take it as it is.</Hint>
        <MoreOptions op="repair" />
        <Button
          main
          onClick={() => step({ op: "repair", item: one.id, ...othersChosen("repair") }, "Repairing")}
        >
          Repair
        </Button>
        <Button onClick={() => (tab.value = "caps")}>Go to Caps</Button>
      </>
    );
  }
  if (one.atlas) {
    return (
      <>
        <Hint>Each of these caps has degrees of its own. Degrees of the whole shape need its mesh.</Hint>
        <Button main onClick={() => (tab.value = "caps")}>
          Go to Caps
        </Button>
      </>
    );
  }
  return (
    <>
      <Hint>
        No centre sees all of this surface, so it cannot be split into degrees. {one.star?.why}
      </Hint>
      {one.star && one.star.offending > 0 && <MarkOffending offending={one.star.offending} />}
      <Button main onClick={() => (tab.value = "caps")}>
        Go to Caps
      </Button>
    </>
  );
}

const canExpand = (one: Item) => one.closed && one.star?.star_shaped !== false;

function Expand({ one }: { one: Item }) {
  if (!canExpand(one)) return <NoDegrees one={one} />;
  return (
    <>
      <Hint>Split the shape into degrees: coarse form first, then detail.</Hint>
      <NumberControl of={wanted} />
      <MoreOptions op="expand" />
      <Button
        main
        onClick={() =>
          step(
            { op: "expand", item: one.id, degree: wanted.value, center: "auto", ...othersChosen("expand") },
            "Expanding",
          )
        }
      >
        Expand
      </Button>
    </>
  );
}

function Equalizer() {
  const bands = tool.bands.value;
  const set = (k: number, value: number, since: number) => {
    tool.bandValues.value = bands.map((_, i) => (i === k ? value : (tool.bandValues.value[i] ?? 1)));
    tool.showLook(since);
  };
  return (
    <div class="bands" role="group" aria-label="Gain of each band of degrees">
      {bands.map(({ from, to }, k) => (
        <label key={from}>
          <input
            type="range"
            min={0}
            max={3}
            step={0.01}
            value={tool.bandValues.value[k] ?? 1}
            aria-label={`Gain of degrees ${from} to ${to}`}
            onInput={(event) => set(k, Number(event.currentTarget.value), event.timeStamp)}
            onChange={() => void tool.keepLook()}
          />
          <span>{Number((tool.bandValues.value[k] ?? 1).toFixed(2))}</span>
          <small>{from === to ? from : `${from}–${to}`}</small>
        </label>
      ))}
    </div>
  );
}

function changeMode(mode: tool.Mode): void {
  const gains = tool.wish.value?.gains;
  if (mode === "bands") {
    const all = Array.from({ length: tool.top.value + 1 }, (_, l) =>
      gains ? (gains[l] ?? 0) : Number(l <= tool.degree.value),
    );
    tool.bandValues.value = bandMeans(tool.bands.value, all);
  } else if (mode !== "cut" && tool.degree.value === tool.top.value) {
    tool.degree.value = Math.max(1, Math.round(tool.top.value / 4)); // chosen: a visible change
  }
  tool.mode.value = mode;
  tool.showLook(performance.now());
  void tool.keepLook();
}

function Filter() {
  const mode = tool.mode.value;
  const live = (since: number) => tool.showLook(since);
  return (
    <>
      {mode !== "bands" && (
        <Slider
          label="Degree"
          value={tool.degree.value}
          min={0}
          max={tool.top.value}
          step={1}
          scale="root"
          disabled={tool.degreeIsReplaced.value}
          onInput={(value, since) => {
            tool.degree.value = value;
            live(since);
          }}
          onChange={() => void tool.keepLook()}
        />
      )}
      <Select label="Degrees kept" value={mode} options={tool.modes} onChange={changeMode} />
      {tool.usesWindow.value && <WindowChoice />}
      {mode === "sharpen" && (
        <Slider
          label="Amount"
          value={tool.amount.value}
          min={0}
          max={4}
          step={0.01}
          onInput={(value, since) => {
            tool.amount.value = value;
            live(since);
          }}
          onChange={() => void tool.keepLook()}
        />
      )}
      {mode === "bands" && <Equalizer />}
    </>
  );
}

function Comparison({ one }: { one: Item }) {
  useEffect(
    () => () => {
      if (tab.peek() !== "save") hideOther();
    },
    [one.id],
  );
  // Coefficients without their shape cannot be compared.
  if (one.kind !== "mesh") return null;
  return (
    <div class="checks">
      <Check label="Error in colours" checked={coloring.value === "error"} onChange={tool.setErrorMap} />
      <Check
        label="Beside the original"
        checked={layout.value === "side"}
        onChange={(on) => (on ? void showOther(one, true, "side") : hideOther())}
      />
    </div>
  );
}

function ErrorRow({ one }: { one: Item }) {
  if (!one.expansion || tool.mode.value !== "cut") return null;
  const [, told, most] = one.expansion.error.find(([l]) => l === tool.degree.value) ?? [];
  const rms = one.expansion.rms_per_degree?.[tool.degree.value] ?? told;
  const largest = typeof most === "number" ? `, ${withUnit(most, one.unit)} at most` : "";
  if (typeof rms !== "number") {
    return (
      <Hint>
        How far the surface is off at degree {tool.degree.value} (rms) is not known{largest}.
      </Hint>
    );
  }
  return (
    <Hint>
      At degree {tool.degree.value} the surface is {withUnit(rms, one.unit)} off (rms){largest}. The rms is{" "}
      {percent(rms / tool.meanRadius(one))} of the mean radius.
    </Hint>
  );
}

function FindDegree({ one }: { one: Item }) {
  const radius = tool.meanRadius(one);
  if (!one.expansion?.rms_per_degree || !(radius > 0)) return null;
  return (
    <>
      <Slider
        label="Allowed error, rms"
        value={tool.tolerance.value * radius}
        min={1e-6 * radius}
        max={0.3 * radius}
        scale="log"
        unit={one.unit}
        whole={radius}
        onInput={(value) => (tool.tolerance.value = value / radius)}
      />
      <Hint>This is {percent(tool.tolerance.value)} of the mean radius.</Hint>
      <Button onClick={() => tool.degreeForTolerance(one)}>Find the degree</Button>
    </>
  );
}

export function DegreesPanel() {
  const one = item.value;
  if (!one) return <Hint>Open a shape first.</Hint>;
  if (!one.expansion) return <Expand one={one} />;
  return (
    <>
      <Filter />
      <ErrorRow one={one} />
      <Comparison one={one} />
      <Spectrum
        key={theme.value}
        power={one.expansion.power}
        tail={one.expansion.tail}
        degree={tool.mode.value === "bands" ? null : tool.degree.value}
      />
      <FindDegree one={one} />
      {one.kind === "mesh" && (
        <details>
          <summary>Expand again</summary>
          <Expand one={one} />
        </details>
      )}
    </>
  );
}
