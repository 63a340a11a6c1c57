import { useLayoutEffect } from "preact/hooks";
import { theView } from "../show";
import { Button } from "../button";
import type { Scale } from "../format";
import type { Item } from "../protocol";
import { item, items } from "../state";
import * as tool from "../tools/texture";
import { Check, Hint, Select, Slider } from "../widgets";
import type { Signal } from "@preact/signals";

const picks = [
  ["from", "Picks the source"],
  ["to", "Picks the target"],
  ["none", "Turns the shape"],
] as const;

function Live(props: {
  label: string;
  value: Signal<number>;
  min: number;
  max: number;
  step?: number;
  scale?: Scale;
  per?: number; // what the value is a part of
  unit?: string;
}) {
  const { value, min, max, per = 1, ...rest } = props;
  return (
    <Slider
      {...rest}
      min={min * per}
      max={max * per}
      value={value.value * per}
      onInput={(next, since) => {
        value.value = next / per;
        tool.preview(since);
      }}
    />
  );
}

function LiveCheck({ label, value }: { label: string; value: Signal<boolean> }) {
  return (
    <Check
      label={label}
      checked={value.value}
      onChange={(on) => {
        value.value = on;
        tool.preview(performance.now());
      }}
    />
  );
}

function Turn() {
  const angle = tool.angle.value;
  return (
    <>
      <Check
        label="Find the best angle"
        checked={angle === null}
        onChange={(on) => {
          tool.angle.value = on ? null : 0;
          tool.preview(performance.now());
        }}
      />
      <Slider
        label="Angle"
        unit="°"
        value={angle ?? 0}
        min={-180}
        max={180}
        disabled={angle === null}
        onInput={(value, since) => {
          tool.angle.value = Math.round(value);
          tool.preview(since);
        }}
      />
    </>
  );
}

// Whether the target's faces are too large for the detail that is laid on it: their edges, as far as the mean tells,
// are much longer. Chosen: twice.
function isCoarse(source: Item, target: Item): boolean {
  const edge = ({ diagonal, faces }: Item) => diagonal / Math.sqrt(faces);
  return tool.ready.value && !tool.refine.value && edge(target) > 2 * tool.scale.value * edge(source);
}

const radius = (of: Item) => ({ min: 0.01, max: 0.5, scale: "log", per: of.diagonal, unit: of.unit }) as const;

export function TexturePanel() {
  useLayoutEffect(() => {
    const view = theView();
    if (!view) return undefined;
    view.pointer = tool.texturePointer;
    return () => {
      view.pointer = null;
      tool.discard();
    };
  }, []);
  const one = item.value;
  if (!one?.faces) return <Hint>Open a surface first: points have no texture.</Hint>;
  const itemOf = (id: number | undefined) => items.value.find((each) => each.id === id) ?? one;
  const source = itemOf(tool.from.value?.item);
  const target = itemOf(tool.to.value?.item);
  return (
    <>
      <Hint>Click on the source of the texture, then on its target. Drag the ball on the ring to turn and scale the texture.</Hint>
      <Select
        label="A click"
        value={tool.picking.value}
        options={picks}
        onChange={(value) => (tool.picking.value = value)}
      />
      <Live label="Radius of the source" value={tool.radiusShare} {...radius(source)} />
      <Live label="Radius of the target" value={tool.targetShare} {...radius(target)} />
      <Live label="Height" value={tool.height} min={-2} max={4} step={0.01} />
      <Live label="Scale" value={tool.scale} min={0.2} max={5} scale="log" />
      <Turn />
      <LiveCheck label="Repeat the texture over the target" value={tool.repeat} />
      <LiveCheck label="Remove the target's own detail first" value={tool.removeOwn} />
      <LiveCheck label="Refine the target's mesh" value={tool.refine} />
      {isCoarse(source, target) && (
        <Hint>The faces of the target are larger than those of the source: without refining, detail is lost.</Hint>
      )}
      <div class="row sticky">
        <Button main disabled={!tool.ready.value} onClick={tool.keep}>
          Keep
        </Button>
        <Button onClick={tool.discard}>Clear</Button>
      </div>
    </>
  );
}
