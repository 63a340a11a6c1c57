import { useLayoutEffect } from "preact/hooks";
import { theView } from "../show";
import { Button } from "../button";
import { MoreOptions, NumberControl } from "../controls";
import { item } from "../state";
import * as brush from "../tools/brush";
import * as tool from "../tools/smooth";
import { withUnit } from "../format";
import type { Item } from "../protocol";
import { Check, Hint, Select, Slider } from "../widgets";

// The pointer paints while this panel is open.
function usePointer(): void {
  useLayoutEffect(() => {
    const view = theView();
    if (!view) return undefined;
    view.pointer = brush.brushPointer(() => tool.preview(performance.now()));
    return () => {
      view.pointer = null;
      view.rings([]);
      if (tool.previewed.value) tool.discard();
      brush.clearRegion();
    };
  }, []);
}

function BrushControls({ one, after }: { one: Item; after: (since: number) => void }) {
  return (
    <>
      <Check
        label="Paint with the pointer"
        checked={brush.painting.value}
        onChange={(on) => (brush.painting.value = on)}
      />
      <Slider
        label="Brush radius"
        value={brush.radius.value}
        min={brush.leastRadius * one.diagonal}
        max={brush.mostRadius * one.diagonal}
        scale="log"
        unit={one.unit}
        onInput={(value, since) => brush.setRadius(value / one.diagonal, since)}
        onChange={() => after(performance.now())}
      />
    </>
  );
}

export function SmoothPanel() {
  usePointer();
  const one = item.value;
  if (!one?.faces) return <Hint>Open a surface first: points cannot be smoothed.</Hint>;
  const none = brush.dabs.value.length === 0;
  return (
    <>
      <Hint>Paint over what is to change. The keys [ and ], or Alt and the wheel, change the size of the brush.</Hint>
      <BrushControls one={one} after={tool.preview} />
      <Select
        label="Action"
        value={tool.action.value}
        options={tool.actions}
        onChange={(action) => {
          tool.action.value = action;
          tool.preview(performance.now());
        }}
      />
      <NumberControl of={tool.wavelengthShare} one={one} after={(since) => tool.preview(since)} />
      <NumberControl of={tool.strength} after={(since) => tool.preview(since, false)} />
      <MoreOptions op="smooth" after={(since) => tool.preview(since, false)} />
      <Hint>
        Detail shorter than {withUnit(tool.wavelength.value, one.unit)} is removed. A strength below 0 makes it
        stronger instead.
      </Hint>
      <div class="row sticky">
        <Button main disabled={none} onClick={tool.keep}>
          Keep
        </Button>
        <Button
          disabled={none}
          onClick={() => {
            tool.discard();
            brush.clearRegion();
          }}
        >
          Clear
        </Button>
      </div>
    </>
  );
}
