import { computed, signal } from "@preact/signals";
import { step } from "../actions";
import { Button } from "../button";
import { MoreOptions, NumberControl } from "../controls";
import { bytes, withUnit } from "../format";
import { Option, othersChosen } from "../options";
import type { Item, ItemAtlas } from "../protocol";
import { coloring } from "../show";
import { item } from "../state";
import { Check, Facts, Hint, Slider } from "../widgets";

const tolerance = new Option<number>("compress", "tolerance");
const maxDegree = new Option<number>("compress", "max_degree");

// Size of a mesh with 32-bit floats and indices.
const meshBytes = computed(() => 12 * (item.value?.vertices ?? 0) + 12 * (item.value?.faces ?? 0));

function Compress({ one }: { one: Item }) {
  return (
    <>
      <Hint>A small model of a shape of any kind: overlapping caps, each with an expansion of its own.</Hint>
      <NumberControl of={tolerance} one={one} />
      <NumberControl of={maxDegree} />
      <MoreOptions op="compress" />
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
              ...othersChosen("compress"),
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

// Degree of the slider until the surface arrives.
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
