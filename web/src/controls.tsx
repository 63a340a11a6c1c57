// Controls for options, as described by the studio.
import { number, typedNumber } from "./format";
import { others, type Option } from "./options";
import type { Control, Item, Value } from "./protocol";
import { notice } from "./state";
import { Check, Select, Slider, TextField } from "./widgets";

interface NumberFieldProps {
  label: string;
  value: number | undefined;
  placeholder: string; // the value used if the field is empty
  least: number | null;
  most: number | null;
  whole: boolean;
  onChange: (value: number | undefined) => void;
}

export function NumberField({ label, value, placeholder, least, most, whole, onChange }: NumberFieldProps) {
  const bounds = [least === null ? "" : `from ${number(least)}`, most === null ? "" : `to ${number(most)}`];
  const take = (typed: string): Promise<boolean> => {
    const wish = typed.trim() === "" ? undefined : typedNumber(typed);
    const inside = wish === undefined || (wish >= (least ?? -Infinity) && wish <= (most ?? Infinity));
    if (!inside || (whole && wish !== undefined && !Number.isInteger(wish))) {
      const kind = whole ? "a whole number" : "a number";
      notice.value = { text: `${[`${label} is ${kind}`, ...bounds].filter(Boolean).join(" ")}.`, bad: true };
      return Promise.resolve(false);
    }
    onChange(wish);
    return Promise.resolve(true);
  };
  return (
    <TextField
      label={label}
      value={value === undefined ? "" : String(value)}
      placeholder={placeholder}
      onChange={take}
    />
  );
}

interface Props<T extends Value> {
  of: Option<T>;
  one?: Item; // lengths are parts of its diagonal
  most?: number; // maximum of a number without one in the list
  disabled?: boolean;
  after?: (since: number) => void;
}

export function NumberControl({ of, one, most, disabled = false, after }: Props<number | null>) {
  const { control } = of;
  if (!control) return null;
  const isLength = control.unit === "diagonal";
  const per = isLength ? (one?.diagonal ?? 1) : 1;
  const whole = control.kind === "whole number";
  const last = most ?? control.most ?? 1;
  return (
    <Slider
      label={control.label}
      value={Math.min(of.value ?? 0, last) * per}
      min={(control.least ?? 0) * per}
      max={last * per}
      step={control.step ?? (whole ? 1 : undefined)}
      scale={control.scale}
      unit={isLength ? (one?.unit ?? "") : control.unit === "degrees" ? "°" : ""}
      disabled={disabled}
      onInput={(value, since) => {
        of.value = value / per;
        after?.(since);
      }}
    />
  );
}

export function FlagControl({ of, after }: Props<boolean>) {
  const { control } = of;
  if (!control) return null;
  return (
    <Check
      label={control.label}
      checked={of.value}
      onChange={(on) => {
        of.value = on;
        after?.(performance.now());
      }}
    />
  );
}

export function ChoiceControl({ of, after }: Props<string>) {
  const { control } = of;
  if (!control) return null;
  return (
    <Select
      label={control.label}
      value={of.value}
      options={control.choices.map(({ value, label }) => [value, label] as const)}
      onChange={(value) => {
        of.value = value;
        after?.(performance.now());
      }}
    />
  );
}

function Other({ of, control, after }: Props<Value> & { control: Control }) {
  if (control.kind === "flag") return <FlagControl of={of as Option<boolean>} {...(after ? { after } : {})} />;
  if (control.kind === "choice") return <ChoiceControl of={of as Option<string>} {...(after ? { after } : {})} />;
  return (
    <NumberField
      label={control.label}
      value={of.chosen ? (of.value as number) : undefined}
      placeholder={control.default === null ? "by default" : String(control.default)}
      least={control.least}
      most={control.most}
      whole={control.kind === "whole number"}
      onChange={(value) => {
        if (value === undefined) of.reset();
        else of.value = value;
        after?.(performance.now());
      }}
    />
  );
}

// Shows all options that the panel does not show by itself.
export function MoreOptions(props: { op: string; label?: string; after?: (since: number) => void }) {
  const { op, label = "More options", after } = props;
  const more = others(op);
  if (more.length === 0) return null;
  return (
    <details>
      <summary>{label}</summary>
      {more.map((of) => of.control && (
        <div key={of.name} title={of.control.help}>
          <Other of={of} control={of.control} {...(after ? { after } : {})} />
        </div>
      ))}
    </details>
  );
}
