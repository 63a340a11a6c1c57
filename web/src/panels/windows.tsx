// The window of a filter and its parameters, as described by the studio.
import { NumberField } from "../controls";
import { percent } from "../format";
import type { WindowParameter } from "../protocol";
import { filterWindows } from "../state";
import * as tool from "../tools/degrees";
import { Hint, Select, Slider } from "../widgets";

const titled = (name: string) => name.charAt(0).toUpperCase() + name.slice(1);

function setParameter(name: string, value: number | undefined, since: number): void {
  const others = Object.entries(tool.parameters.value).filter(([one]) => one !== name);
  tool.parameters.value = Object.fromEntries(value === undefined ? others : [...others, [name, value]]);
  tool.showLook(since);
}

// Shows a slider, or a field if the degree of the filter determines the default.
function Parameter({ one }: { one: WindowParameter }) {
  const { name, min, max } = one;
  if (one.default === null) {
    return (
      <NumberField
        label={`${titled(name)} ${one.symbol}`}
        value={tool.parameters.value[name]}
        placeholder="by the degree"
        least={min}
        most={max}
        whole={one.whole}
        onChange={(value) => {
          setParameter(name, value, performance.now());
          void tool.keepLook();
        }}
      />
    );
  }
  return (
    <Slider
      label={`${titled(name)} ${one.symbol}`}
      value={tool.parameters.value[name] ?? one.default}
      min={min}
      max={max}
      step={one.whole ? 1 : undefined}
      scale="log"
      onInput={(value, since) => setParameter(name, value, since)}
      onChange={() => void tool.keepLook()}
    />
  );
}

export function WindowChoice() {
  const window = tool.window.value;
  if (!window) return null;
  const { windows } = filterWindows.value;
  const overshoot = window.overshoot > 0 ? `${window.parameters.length > 0 ? "By default a" : "A"} step is overshot by ${percent(window.overshoot)}` : "A step is not overshot";
  return (
    <>
      <Select
        label="Window"
        value={window.name}
        options={windows.map(({ name }) => [name, titled(name)] as const)}
        onChange={(value) => {
          tool.chooseWindow(value);
          tool.showLook(performance.now());
          void tool.keepLook();
        }}
      />
      {window.parameters.map((one) => (
        <Parameter key={one.name} one={one} />
      ))}
      <Hint>
        {window.formula}. {titled(window.help)}. {overshoot}.
      </Hint>
    </>
  );
}
