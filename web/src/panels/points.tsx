import { signal } from "@preact/signals";
import { step } from "../actions";
import { Button } from "../button";
import type { Item } from "../protocol";
import { item, items, studio } from "../state";
import { Check, Hint, Select, Slider } from "../widgets";

const holes = signal<"close" | "keep">("close");
const noise = signal<"auto" | "none">("auto");
const simplified = signal(false);
const share = signal(0.1);

const faces = signal(10_000);
const leastFaces = 100; // chosen: a shape that can be told

function Cloud({ one }: { one: Item }) {
  return (
    <>
      <Hint>
        {one.normals
          ? "These points have normals."
          : "These points have no normals. They are computed first."}
      </Hint>
      <Button onClick={() => step({ op: "orient", item: one.id }, "Computing normals")}>
        Compute normals
      </Button>
      <Select
        label="Holes"
        value={holes.value}
        options={[
          ["close", "Close all"],
          ["keep", "Leave open"],
        ]}
        onChange={(value) => (holes.value = value)}
      />
      <Select
        label="Noise"
        value={noise.value}
        options={[
          ["auto", "Estimate it"],
          ["none", "Points are exact"],
        ]}
        onChange={(value) => (noise.value = value)}
      />
      <Check
        label="Simplify the surface"
        checked={simplified.value}
        onChange={(on) => (simplified.value = on)}
      />
      {simplified.value && (
        <Slider
          label="Share of faces kept"
          value={share.value}
          min={0.01}
          max={1}
          scale="log"
          onInput={(value) => (share.value = value)}
        />
      )}
      <Button
        main
        onClick={() =>
          step(
            {
              op: "reconstruct",
              item: one.id,
              simplify: simplified.value ? share.value : null,
              holes: holes.value,
              noise: noise.value,
            },
            "Making a surface",
          )
        }
      >
        Make a surface
      </Button>
    </>
  );
}

function Simplify({ one }: { one: Item }) {
  const most = Math.max(one.faces, leastFaces + 1);
  const wanted = Math.min(Math.max(faces.value, leastFaces), most);
  return (
    <>
      <h3>Simplify the mesh</h3>
      <Hint>Keeps the surface, with fewer faces.</Hint>
      <Slider
        label="Faces"
        value={wanted}
        min={leastFaces}
        max={most}
        step={1}
        scale="log"
        onInput={(value) => (faces.value = value)}
      />
      <Button
        main
        onClick={() => step({ op: "simplify", item: one.id, faces: Math.round(wanted) }, "Simplifying")}
      >
        Simplify
      </Button>
    </>
  );
}

export function PointsPanel() {
  const one = item.value;
  if (one?.kind === "points") return <Cloud one={one} />;
  const cloud = items.value.some(({ kind }) => kind === "points");
  const extensions = (studio.value?.opens ?? [])
    .filter(({ kinds }) => kinds.includes("points"))
    .flatMap((known) => known.extensions.map((extension) => extension.toUpperCase()))
    .join(", ");
  return (
    <>
      <Hint>
        {cloud
          ? "Choose the points in the list to make a surface of them."
          : `Open points (${extensions}) to make a surface of them.`}
      </Hint>
      {one && one.faces > 0 && <Simplify one={one} />}
    </>
  );
}
