import { useLayoutEffect } from "preact/hooks";
import { theView } from "../show";
import { Button } from "../button";
import { FlagControl, MoreOptions, NumberControl } from "../controls";
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

// Slider for the radius of a disc, as a part of the diagonal of its shape.
function Radius({ label, value, of }: { label: string; value: Signal<number>; of: Item }) {
  return (
    <Slider
      label={label}
      value={value.value * of.diagonal}
      min={0.01 * of.diagonal}
      max={0.5 * of.diagonal}
      scale="log"
      unit={of.unit}
      onInput={(next, since) => {
        value.value = next / of.diagonal;
        tool.preview(since);
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
      <NumberControl of={tool.angle} disabled={angle === null} after={tool.preview} />
    </>
  );
}

// Returns true if the target's faces are too large for the detail laid on it:
// their estimated edges are much longer than the source's. Chosen: twice.
function isCoarse(source: Item, target: Item): boolean {
  const edge = ({ diagonal, faces }: Item) => diagonal / Math.sqrt(faces);
  return tool.ready.value && !tool.refine.value && edge(target) > 2 * tool.scale.value * edge(source);
}

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
      <Radius label="Radius of the source" value={tool.radiusShare} of={source} />
      <Radius label="Radius of the target" value={tool.targetShare} of={target} />
      <NumberControl of={tool.height} after={tool.preview} />
      <NumberControl of={tool.scale} after={tool.preview} />
      <Turn />
      <FlagControl of={tool.repeat} after={tool.preview} />
      <FlagControl of={tool.removeOwn} after={tool.preview} />
      <FlagControl of={tool.refine} after={tool.preview} />
      <MoreOptions op="transfer" after={tool.preview} />
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
