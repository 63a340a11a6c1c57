import { computed, signal } from "@preact/signals";
import { step } from "../actions";
import { Button } from "../button";
import { bytes, withUnit } from "../format";
import type { Item, ItemAtlas } from "../protocol";
import { coloring } from "../show";
import { item } from "../state";
import { Check, Facts, Hint, Slider } from "../widgets";

const tolerance = signal(3e-3); // parts of the diagonal
const leastError = 1e-4; // parts of the diagonal; chosen: below it caps are no smaller than the mesh
const mostError = 3e-2;
const maxDegree = signal(14);
const mostDegrees = 24; // of a cap, as the library has them

// What a mesh costs as 32-bit floats and indices.
const meshBytes = computed(() => 12 * (item.value?.vertices ?? 0) + 12 * (item.value?.faces ?? 0));

function Compress({ one }: { one: Item }) {
  return (
    <>
      <Hint>A small model of a shape of any kind: overlapping caps, each with an expansion of its own.</Hint>
      <Slider
        label="Allowed error, rms"
        value={tolerance.value * one.diagonal}
        min={leastError * one.diagonal}
        max={mostError * one.diagonal}
        scale="log"
        unit={one.unit}
        onInput={(value) => (tolerance.value = value / one.diagonal)}
      />
      <Slider
        label="Highest degree of a cap"
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

// The degree that the slider is at, until the surface is there.
const moved = signal<{ id: number; limit: number } | null>(null);

function Atlas({ one, atlas }: { one: Item; atlas: ItemAtlas }) {
  const limit = moved.value?.id === one.id ? moved.value.limit : (one.look?.degree ?? atlas.degree);
  const { error } = atlas;
  const errors = error
    ? [
        { label: "Error, rms", value: withUnit(error.rms, one.unit) },
        { label: "Error, largest", value: withUnit(error.max, one.unit) },
      ]
    : [];
  return (
    <>
      <Facts
        facts={[
          { label: "Caps", value: String(one.caps ?? 0) },
          { label: "File", value: bytes(atlas.bytes) },
          ...errors,
        ]}
      />
      {error && limit < atlas.degree && <Hint>These errors hold for all degrees; those of the surface shown are not known.</Hint>}
      <Check
        label="A colour for each cap"
        checked={coloring.value === "caps"}
        onChange={(on) => (coloring.value = on ? "caps" : "plain")}
      />
      <Slider
        label="Degree of the caps"
        value={limit}
        min={1}
        max={atlas.degree}
        onInput={(value) => (moved.value = { id: one.id, limit: value })}
        onChange={(value) =>
          void step({ op: "atlas_look", item: one.id, limit: value }, "Making the surface").finally(
            () => (moved.value = null),
          )
        }
      />
    </>
  );
}

export function CapsPanel() {
  const one = item.value;
  if (one?.atlas) return <Atlas one={one} atlas={one.atlas} />;
  if (one) return <Compress one={one} />;
  return <Hint>Open a shape first.</Hint>;
}
