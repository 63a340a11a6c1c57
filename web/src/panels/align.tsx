import { useEffect } from "preact/hooks";
import { step } from "../actions";
import { Button } from "../button";
import { hideOther, showOther } from "../show";
import { item, items, selected } from "../state";
import * as tool from "../tools/blend";
import { Check, Hint, Select, Slider } from "../widgets";

// Both shapes at one place while this panel is open; the second alone while it is blended.
function useBoth(): void {
  const other = tool.partner.value;
  const alone = tool.previewed.value;
  useEffect(() => {
    if (other && !alone) void showOther(other, false, "over");
    else hideOther(alone);
  }, [other?.id, other?.revision, selected.value, alone]);
  useEffect(() => tool.stop, []);
}

export function AlignPanel() {
  useBoth();
  const one = item.value;
  const other = tool.partner.value;
  if (!one || !other) return <Hint>Open a second shape: one of two is turned onto the other.</Hint>;
  const others = items.value.filter(({ id, faces }) => id !== one.id && faces > 0);
  const both = one.expansion !== null && other.expansion !== null;
  return (
    <>
      <Select
        label={`${one.name} (stone) onto`}
        value={String(other.id)}
        options={others.map(({ id, name }) => [String(id), name] as const)}
        onChange={(value) => (tool.partnerId.value = Number(value))}
      />
      <Check
        label="It may be mirrored"
        checked={tool.mirror.value}
        onChange={(on) => (tool.mirror.value = on)}
      />
      {!both && <Hint>Both shapes need degrees: analyse them first.</Hint>}
      <Button
        main
        disabled={!both}
        onClick={() =>
          step({ op: "align", a: one.id, b: other.id, mirror: tool.mirror.value }, "Aligning")
        }
      >
        Align
      </Button>
      <Hint>{one.placed ?? "It is turned and moved; its size stays."}</Hint>
      <Slider
        label="Between the two"
        value={tool.between.value}
        min={0}
        max={1}
        step={0.005}
        disabled={!both}
        onInput={(value, since) => {
          tool.playing.value = false;
          tool.between.value = value;
          tool.preview(since);
        }}
      />
      <div class="row">
        <Button disabled={!both} onClick={() => (tool.playing.value ? tool.stop() : tool.play())}>
          {tool.playing.value ? "Stop" : "Animate"}
        </Button>
        <Button disabled={!both} onClick={tool.keep}>
          Keep as a shape
        </Button>
      </div>
    </>
  );
}
