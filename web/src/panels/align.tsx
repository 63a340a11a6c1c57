import { useEffect } from "preact/hooks";
import { step } from "../actions";
import { Button } from "../button";
import { FlagControl, MoreOptions, NumberControl } from "../controls";
import { othersChosen } from "../options";
import { hideOther, showOther } from "../show";
import { cssColor, plain, second, type Rgb } from "../geometry/colors";
import { item, items, nameOf, selected } from "../state";
import * as tool from "../tools/blend";
import { Hint, Select } from "../widgets";

// Shows both shapes at one place while this panel is open, and only the blend while one is previewed.
function useBoth(): void {
  const other = tool.partner.value;
  const alone = tool.previewed.value;
  useEffect(() => {
    if (other && !alone) void showOther(other, false, "over");
    else hideOther(alone);
  }, [other?.id, other?.revision, selected.value, alone]);
  useEffect(() => tool.stop, []);
}

// Shows the colour of a shape on the screen.
function Swatch({ color }: { color: Rgb }) {
  return <span class="swatch" style={{ background: cssColor(color) }} aria-hidden="true" />;
}

export function AlignPanel() {
  useBoth();
  const one = item.value;
  const other = tool.partner.value;
  if (!one || !other) return <Hint>Open a second shape: the chosen one is turned and moved onto it.</Hint>;
  const others = items.value.filter(({ id, faces }) => id !== one.id && faces > 0);
  const both = one.expansion !== null && other.expansion !== null;
  return (
    <>
      <p class="moved">
        <Swatch color={plain} /> {nameOf(one)} is turned and moved.
      </p>
      <Select
        label={
          <>
            <Swatch color={second} /> Onto
          </>
        }
        value={String(other.id)}
        options={others.map((each) => [String(each.id), nameOf(each)] as const)}
        onChange={(value) => (tool.partnerId.value = Number(value))}
      />
      <FlagControl of={tool.mirror} />
      <MoreOptions op="align" />
      {!both && <Hint>Both shapes need degrees: expand them first, under Degrees.</Hint>}
      <Button
        main
        disabled={!both}
        onClick={() =>
          step(
            { op: "align", a: one.id, b: other.id, mirror: tool.mirror.value, ...othersChosen("align") },
            "Aligning",
          )
        }
      >
        Align
      </Button>
      <Hint>{one.placed ?? "The size stays as it is."}</Hint>
      <NumberControl
        of={tool.between}
        disabled={!both}
        after={(since) => {
          tool.playing.value = false;
          tool.preview(since);
        }}
      />
      <div class="row">
        <Button disabled={!both} onClick={() => (tool.playing.value ? tool.stop() : tool.play())}>
          {tool.playing.value ? "Stop" : "Animate"}
        </Button>
        <Button disabled={!both} onClick={tool.keep}>
          Keep the blend
        </Button>
      </div>
    </>
  );
}
