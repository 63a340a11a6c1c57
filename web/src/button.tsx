// Button of the studio's page; it is disabled while work runs.
import type { ComponentChildren } from "preact";
import { working } from "./state";

interface ButtonProps {
  children: ComponentChildren;
  onClick: () => unknown;
  disabled?: boolean;
  main?: boolean;
  title?: string;
  always?: boolean; // enabled also while work runs
}

export function Button({ children, onClick, disabled = false, main = false, title, always }: ButtonProps) {
  return (
    <button
      type="button"
      class={main ? "main" : ""}
      disabled={disabled || (!always && working.value)}
      {...(title ? { title } : {})}
      onClick={() => void onClick()}
    >
      {children}
    </button>
  );
}
