import { useLayoutEffect } from "preact/hooks";
import { theView } from "../show";
import { Button } from "../button";
import { item } from "../state";
import * as brush from "../tools/brush";
import * as tool from "../tools/smooth";
import { withUnit } from "../format";
import { Check, Hint, Select, Slider } from "../widgets";

// While this panel is open the pointer paints.
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

export function BrushControls({ after }: { after: (since: number) => void }) {
  return (
    <>
      <Check
        label="The pointer paints (else it turns the shape)"
        checked={brush.painting.value}
        onChange={(on) => (brush.painting.value = on)}
      />
      <Slider
        label="Brush radius (of the diagonal)"
        value={brush.radiusShare.value}
        min={0.005}
        max={0.5}
        log
        onInput={(value, since) => brush.setRadius(value, since)}
        onChange={() => after(performance.now())}
      />
    </>
  );
}

export function SmoothPanel() {
  usePointer();
  const one = item.value;
  if (!one?.faces) return <Hint>Smoothing is of surfaces: open one.</Hint>;
  const none = brush.dabs.value.length === 0;
  return (
    <>
      <Hint>Paint over what should go. Keys [ and ], or Alt and the wheel, change the brush.</Hint>
      <BrushControls after={tool.preview} />
      <Select
        label="What happens there"
        value={tool.action.value}
        options={tool.actions}
        onChange={(action) => {
          tool.action.value = action;
          tool.preview(performance.now());
        }}
      />
      <Slider
        label="Wavelength (of the diagonal)"
        value={tool.wavelengthShare.value}
        min={0.01}
        max={0.5}
        log
        onInput={(value, since) => {
          tool.wavelengthShare.value = value;
          tool.preview(since);
        }}
      />
      <Slider
        label="Strength"
        value={tool.strength.value}
        min={-1}
        max={1}
        step={0.01}
        onInput={(value, since) => {
          tool.strength.value = value;
          tool.preview(since, false);
        }}
      />
      <Hint>
        Waves shorter than {withUnit(tool.wavelength.value, one.unit)} go; below 0 the strength makes them
        higher.
      </Hint>
      <div class="row">
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
