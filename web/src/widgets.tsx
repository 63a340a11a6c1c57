// The small set of controls that all panels use.
import type { ComponentChildren } from "preact";
import { useId, useState } from "preact/hooks";
import { fromPlace, number, toPlace, typedNumber, type Scale } from "./format";

interface SliderProps {
  label: string;
  value: number;
  min: number;
  max: number;
  step?: number | undefined; // step of the slider; whole steps also hold for typed values
  scale?: Scale;
  unit?: string;
  whole?: number; // base of typed percentages; without it, percentages are no numbers
  disabled?: boolean;
  onInput: (value: number, since: number) => void; // while it moves; since: time stamp of the event, ms
  onChange?: (value: number) => void; // when it is released
}

const places = 1000; // chosen: finer than a pixel
const pages = 10; // chosen: key steps of the keys PageUp and PageDown

function keySteps(key: string): number {
  const ways: Record<string, number> = {
    ArrowRight: 1,
    ArrowUp: 1,
    ArrowLeft: -1,
    ArrowDown: -1,
    PageUp: pages,
    PageDown: -pages,
  };
  return ways[key] ?? 0;
}

export function Slider(props: SliderProps) {
  const { label, value, min, max, scale = "linear", unit = "", disabled = false } = props;
  const step = props.step ?? (scale === "log" ? undefined : 1);
  const integer = step !== undefined && Number.isInteger(step);
  const id = useId();
  const [said, say] = useState("");
  const [draft, type] = useState<string | null>(null);
  const textOf = (one: number) => (integer ? String(one) : number(one));
  const within = (wish: number) => Math.min(max, Math.max(min, integer ? Math.round(wish) : wish));
  const stepped = (wish: number) => (step ? Number((step * Math.round(wish / step)).toPrecision(12)) : wish);
  const toRest = (wish: number, since: number) => {
    props.onInput(wish, since);
    props.onChange?.(wish);
  };
  // During typing the field has the typed text; afterwards it shows the value, so invalid text disappears.
  const typed = (since: number) => {
    if (draft === null) return;
    const wish = typedNumber(draft, props.whole);
    type(null);
    if (!Number.isFinite(wish)) {
      say("This is no number.");
      return;
    }
    say(wish > max ? `The most is ${textOf(max)}.` : wish < min ? `The least is ${textOf(min)}.` : "");
    toRest(within(wish), since);
  };
  const moved = (place: string, since: number, rest: boolean) => {
    const wish = within(stepped(fromPlace(scale, Number(place) / places, min, max)));
    say("");
    if (rest) props.onChange?.(wish);
    else props.onInput(wish, since);
  };
  // Slider places on a curved scale are not steps of the value, so keys change the value.
  const key = (event: KeyboardEvent) => {
    const steps = keySteps(event.key);
    if (steps === 0 || !integer) return;
    event.preventDefault();
    say("");
    toRest(within(value + steps * step), event.timeStamp);
  };
  return (
    <div class="slider">
      <label for={id}>{label}</label>
      <span class="value">
        <input
          type="text"
          inputMode="decimal"
          autocomplete="off"
          aria-label={`${label}, exactly`}
          value={draft ?? textOf(value)}
          disabled={disabled}
          onInput={(event) => {
            type(event.currentTarget.value);
            say("");
          }}
          onKeyDown={(event) => event.key === "Enter" && typed(event.timeStamp)}
          onBlur={(event) => typed(event.timeStamp)}
        />
        {unit}
      </span>
      <input
        id={id}
        type="range"
        min={0}
        max={places}
        step={1}
        data-scale={`${scale} ${min} ${max}`}
        value={Math.round(places * toPlace(scale, value, min, max))}
        disabled={disabled}
        aria-valuetext={`${number(value)} ${unit}`.trim()}
        onKeyDown={key}
        onInput={(event) => moved(event.currentTarget.value, event.timeStamp, false)}
        onChange={(event) => moved(event.currentTarget.value, event.timeStamp, true)}
      />
      <small class="said" role="status">
        {said}
      </small>
    </div>
  );
}

interface SelectProps<T extends string> {
  label: ComponentChildren;
  value: T;
  options: readonly (readonly [T, string])[];
  onChange: (value: T) => void;
}

export function Select<T extends string>({ label, value, options, onChange }: SelectProps<T>) {
  return (
    <label class="field choice">
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
  placeholder?: string;
  offers?: readonly string[]; // suggestions; other text can be typed
  onChange: (value: string) => Promise<boolean>; // resolves to true if the value was taken
}

export function TextField({ label, value, placeholder = "", offers = [], onChange }: TextProps) {
  const list = useId();
  return (
    <label class="field">
      <span>{label}</span>
      <input
        type="text"
        autocomplete="off"
        value={value}
        placeholder={placeholder}
        {...(offers.length > 0 ? { list } : {})}
        onChange={(event) => {
          const field = event.currentTarget;
          void onChange(field.value).then((taken) => {
            if (!taken) field.value = value;
          });
        }}
      />
      {offers.length > 0 && (
        <datalist id={list}>
          {offers.map((offer) => (
            <option key={offer} value={offer} />
          ))}
        </datalist>
      )}
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
    setTimeout(() => say("Copy"), 2000); // chosen: long enough to read
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
