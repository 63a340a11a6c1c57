// Options of steps: their descriptions by the studio, and the chosen values.
import { signal } from "@preact/signals";
import type { Control, Fields, Value } from "./protocol";
import { controls } from "./state";

const chosen = signal<Readonly<Fields>>({}); // keys are "op.name"

export function controlOf(op: string, name: string): Control | undefined {
  return controls.value[op]?.find((one) => one.name === name);
}

// The chosen value, or the default; as a signal.
export class Option<T extends Value> {
  constructor(
    readonly op: string,
    readonly name: string,
  ) {}
  get control(): Control | undefined {
    return controlOf(this.op, this.name);
  }
  get value(): T {
    const { key } = this;
    return (key in chosen.value ? chosen.value[key] : (this.control?.default ?? null)) as T;
  }
  set value(next: T) {
    chosen.value = { ...chosen.peek(), [this.key]: next };
  }
  get chosen(): boolean {
    return this.key in chosen.value;
  }
  reset(): void {
    chosen.value = Object.fromEntries(Object.entries(chosen.peek()).filter(([key]) => key !== this.key));
  }
  private get key(): string {
    return `${this.op}.${this.name}`;
  }
}

// Returns the options that no panel shows by itself.
export function others(op: string): Option<Value>[] {
  return (controls.value[op] ?? []).filter(({ shown }) => !shown).map(({ name }) => new Option(op, name));
}

// Returns the chosen ones of these options, as fields of the step.
export function othersChosen(op: string): Fields {
  return Object.fromEntries(others(op).flatMap((one) => (one.chosen ? [[one.name, one.value]] : [])));
}
