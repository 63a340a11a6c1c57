import { computed, signal } from "@preact/signals";
import { step } from "../actions";
import { Button } from "../button";
import { bytes } from "../format";
import type { Item } from "../protocol";
import { coloring } from "../show";
import { item } from "../state";
import { Check, Facts, Hint, Slider } from "../widgets";

const tolerance = signal(3e-3); // parts of the diagonal
const maxDegree = signal(14);
const mostDegrees = 24; // of a cap, as the library has them
const limit = signal(mostDegrees);

// What a mesh costs as 32-bit floats and indices.
const meshBytes = computed(() => 12 * (item.value?.vertices ?? 0) + 12 * (item.value?.faces ?? 0));

function Compress({ one }: { one: Item }) {
  return (
    <>
      <Hint>Few numbers for a shape of any kind: caps, each a function on a sphere of its own.</Hint>
      <Slider
        label="Allowed error (of the diagonal)"
        value={tolerance.value}
        min={3e-4}
        max={3e-2}
        log
        onInput={(value) => (tolerance.value = value)}
      />
      <Slider
        label="Largest degree of a cap"
        value={maxDegree.value}
        min={2}
        max={mostDegrees}
        onInput={(value) => (maxDegree.value = value)}
      />
      {one.faces > 0 && <Facts facts={[{ label: "As a mesh", value: bytes(meshBytes.value) }]} />}
      <Button
        main
        onClick={() =>
          step(
            {
              op: "compress",
              item: one.id,
              tolerance: tolerance.value * one.diagonal,
              max_degree: maxDegree.value,
            },
            "Compressing",
          )
        }
      >
        Compress
      </Button>
    </>
  );
}

function Atlas({ one }: { one: Item }) {
  return (
    <>
      <Facts
        facts={[
          { label: "Caps", value: String(one.caps ?? 0) },
          { label: "Size", value: bytes(one.bytes ?? 0) },
        ]}
      />
      <Check
        label="Caps in colours"
        checked={coloring.value === "caps"}
        onChange={(on) => (coloring.value = on ? "caps" : "plain")}
      />
      <Slider
        label="Degrees shown"
        value={limit.value}
        min={1}
        max={mostDegrees}
        onInput={(value) => (limit.value = value)}
        onChange={(value) => void step({ op: "atlas_look", item: one.id, limit: value }, "Making the surface")}
      />
    </>
  );
}

export function CapsPanel() {
  const one = item.value;
  if (one?.kind === "atlas") return <Atlas one={one} />;
  if (one) return <Compress one={one} />;
  return <Hint>Open a shape first.</Hint>;
}
