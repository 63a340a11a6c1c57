// The few controls that all panels are made of.
import type { ComponentChildren } from "preact";
import { useId, useState } from "preact/hooks";
import { fromLog, number, toLog } from "./format";

interface SliderProps {
  label: string;
  value: number;
  min: number;
  max: number;
  step?: number;
  log?: boolean; // equal ways of the slider are equal ratios
  unit?: string;
  disabled?: boolean;
  onInput: (value: number, since: number) => void; // while it moves; since: time stamp of the event, ms
  onChange?: (value: number) => void; // where it comes to rest
}

const logSteps = 1000; // chosen: finer than a pixel

export function Slider(props: SliderProps) {
  const { label, value, min, max, step = 1, log = false, unit = "", disabled = false } = props;
  const id = useId();
  const read = (text: string): number => {
    const at = Number(text);
    return log ? fromLog(at / logSteps, min, max) : at;
  };
  const typed = (text: string, since: number) => {
    const wish = Number(text);
    if (text === "" || !Number.isFinite(wish)) return;
    const within = Math.min(max, Math.max(min, wish));
    props.onInput(within, since);
    props.onChange?.(within);
  };
  const place = log ? Math.round(logSteps * toLog(Math.max(value, min), min, max)) : value;
  const range = log ? { min: 0, max: logSteps, step: 1 } : { min, max, step };
  return (
    <div class="slider">
      <label for={id}>{label}</label>
      <span class="value">
        <input
          type="number"
          aria-label={`${label}, exactly`}
          value={Number(number(value).replace("–", "0")) === value ? value : number(value)}
          step="any"
          disabled={disabled}
          onChange={(event) => typed(event.currentTarget.value, event.timeStamp)}
        />
        {unit}
      </span>
      <input
        id={id}
        type="range"
        {...range}
        value={place}
        disabled={disabled}
        aria-valuetext={`${number(value)} ${unit}`.trim()}
        onInput={(event) => props.onInput(read(event.currentTarget.value), event.timeStamp)}
        onChange={(event) => props.onChange?.(read(event.currentTarget.value))}
      />
    </div>
  );
}

interface SelectProps<T extends string> {
  label: string;
  value: T;
  options: readonly (readonly [T, string])[];
  onChange: (value: T) => void;
}

export function Select<T extends string>({ label, value, options, onChange }: SelectProps<T>) {
  return (
    <label class="field">
      <span>{label}</span>
      <select value={value} onChange={(event) => onChange(event.currentTarget.value as T)}>
        {options.map(([key, text]) => (
          <option key={key} value={key}>
            {text}
          </option>
        ))}
      </select>
    </label>
  );
}

interface CheckProps {
  label: string;
  checked: boolean;
  disabled?: boolean;
  onChange: (checked: boolean) => void;
}

export function Check({ label, checked, disabled = false, onChange }: CheckProps) {
  return (
    <label class="check">
      <input
        type="checkbox"
        checked={checked}
        disabled={disabled}
        onChange={(event) => onChange(event.currentTarget.checked)}
      />
      {label}
    </label>
  );
}

interface TextProps {
  label: string;
  value: string;
  onChange: (value: string) => void;
}

export function TextField({ label, value, onChange }: TextProps) {
  return (
    <label class="field">
      <span>{label}</span>
      <input type="text" value={value} onChange={(event) => onChange(event.currentTarget.value)} />
    </label>
  );
}

export function Copy({ label, text }: { label: string; text: string }) {
  const [said, say] = useState("Copy");
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(text);
      say("Copied");
    } catch {
      say("Select it and copy by hand");
    }
    setTimeout(() => say("Copy"), 2000); // chosen: long enough to be read
  };
  return (
    <div class="copy">
      <div class="row">
        <strong>{label}</strong>
        <button type="button" aria-label={`Copy: ${label}`} onClick={() => void copy()}>
          {said}
        </button>
      </div>
      <pre tabIndex={0}>{text}</pre>
    </div>
  );
}

export function Facts({ facts }: { facts: readonly { label: string; value: string }[] }) {
  return (
    <dl class="facts">
      {facts.map(({ label, value }) => (
        <div key={label}>
          <dt>{label}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

export function Hint({ children }: { children: ComponentChildren }) {
  return <p class="hint">{children}</p>;
}
