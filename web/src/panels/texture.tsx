import { useLayoutEffect } from "preact/hooks";
import { theView } from "../show";
import { Button } from "../button";
import { item } from "../state";
import * as tool from "../tools/texture";
import { Check, Hint, Select, Slider } from "../widgets";
import type { Signal } from "@preact/signals";

const picks = [
  ["from", "takes the texture from there"],
  ["to", "lays it there"],
  ["none", "turns the shape"],
] as const;

function Live(props: {
  label: string;
  value: Signal<number>;
  min: number;
  max: number;
  step?: number;
  log?: boolean;
}) {
  const { value, ...rest } = props;
  return (
    <Slider
      {...rest}
      value={value.value}
      onInput={(next, since) => {
        value.value = next;
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
        label="Turned to what is there"
        checked={angle === null}
        onChange={(on) => {
          tool.angle.value = on ? null : 0;
          tool.preview(performance.now());
        }}
      />
      <Slider
        label="Turned by"
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
  if (!item.value?.faces) return <Hint>Textures are of surfaces: open one.</Hint>;
  return (
    <>
      <Hint>Click where the texture is taken, then where it goes. Drag the ball on the ring to turn and scale it.</Hint>
      <Select
        label="A click"
        value={tool.picking.value}
        options={picks}
        onChange={(value) => (tool.picking.value = value)}
      />
      <Live label="Radius there (of the diagonal)" value={tool.radiusShare} min={0.01} max={0.5} log />
      <Live label="Radius of the place" value={tool.targetShare} min={0.01} max={0.5} log />
      <Live label="Height" value={tool.height} min={-2} max={4} step={0.01} />
      <Live label="Scale" value={tool.scale} min={0.2} max={5} log />
      <Turn />
      <LiveCheck label="Repeat it side by side" value={tool.repeat} />
      <LiveCheck label="Take away what is there" value={tool.removeOwn} />
      <LiveCheck label="Refine the mesh there" value={tool.refine} />
      <div class="row">
        <Button main disabled={!tool.ready.value} onClick={tool.keep}>
          Keep
        </Button>
        <Button onClick={tool.discard}>Clear</Button>
      </div>
    </>
  );
}
