import { signal } from "@preact/signals";
import { step } from "../actions";
import { Button } from "../button";
import { ChoiceControl, MoreOptions, NumberControl } from "../controls";
import { Option, othersChosen } from "../options";
import type { Item } from "../protocol";
import { item, items, studio } from "../state";
import { Check, Hint, Select } from "../widgets";

const holes = new Option<string>("reconstruct", "holes");
const noise = signal<"auto" | "none">("auto");
const simplified = signal(false);
const share = new Option<number>("reconstruct", "simplify");
const faces = new Option<number>("simplify", "faces");

function Cloud({ one }: { one: Item }) {
  return (
    <>
      <Hint>
        {one.normals
          ? "These points have normals."
          : "These points have no normals. They are computed first."}
      </Hint>
      <MoreOptions op="orient" label="More options of normals" />
      <Button
        onClick={() =>
          step({ op: "orient", item: one.id, ...othersChosen("orient") }, "Computing normals")
        }
      >
        Compute normals
      </Button>
      <ChoiceControl of={holes} />
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
        <NumberControl of={share} />
      )}
      <MoreOptions op="reconstruct" />
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
              ...othersChosen("reconstruct"),
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
  const least = faces.control?.least ?? 1;
  const most = Math.max(one.faces, least + 1);
  const wanted = Math.min(Math.max(faces.value, least), most);
  return (
    <>
      <h3>Simplify the mesh</h3>
      <Hint>Keeps the surface, with fewer faces.</Hint>
      <NumberControl of={faces} most={most} />
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
