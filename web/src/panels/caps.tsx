import { computed, signal } from "@preact/signals";
import { step } from "../actions";
import { Button } from "../button";
import { bytes } from "../format";
import type { Item } from "../protocol";
import { coloring } from "../show";
import { item } from "../state";
import { Check, Facts, Hint, Slider } from "../widgets";

const tolerance = signal(3e-3); // parts of the diagonal
const maxDegree = signal(32);
const limit = signal(32);
const mostDegrees = 64; // chosen: larger caps say no more

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
        min={4}
        max={mostDegrees}
        onInput={(value) => (maxDegree.value = value)}
      />
      <Facts facts={[{ label: "As a mesh", value: bytes(meshBytes.value) }]} />
      <Button
        main
        onClick={() =>
          step(
            {
              op: "compress",
              item: one.id,
              tolerance: tolerance.value,
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
  if (one?.kind === "mesh") return <Compress one={one} />;
  return <Hint>Open a mesh, or make one of points first.</Hint>;
}
