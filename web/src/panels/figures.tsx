import { openFiles, step } from "../actions";
import { Button } from "../button";
import { count } from "../format";
import { coloring, markOffending, type Coloring } from "../show";
import { demo, item } from "../state";
import { theView } from "../show";
import type { Item } from "../protocol";
import { TableColumns, UnreadTable } from "./table";
import { Check, Facts, Hint, Select, TextField } from "../widgets";

// Shapes with known answers, for a start.
const made = ["bumpy", "sphere", "ellipsoid", "torus", "box", "points"] as const;

export function FileButton() {
  return (
    <label class="button main">
      Open files
      <input
        type="file"
        multiple
        onChange={(event) => {
          const input = event.currentTarget;
          void openFiles([...(input.files ?? [])]).then(() => (input.value = ""));
        }}
      />
    </label>
  );
}

export function MakeShape() {
  return (
    <select
      aria-label="Make a shape"
      value=""
      onChange={(event) => {
        const shape = event.currentTarget.value;
        event.currentTarget.value = "";
        if (shape) void step({ op: "make", shape }, "Making a shape");
      }}
    >
      <option value="">Make a shape …</option>
      {made.map((shape) => (
        <option key={shape} value={shape}>
          {shape}
        </option>
      ))}
    </select>
  );
}

function Welcome() {
  return (
    <div class="welcome">
      <p>This shape is here to play with: drag it to turn it.</p>
      <p>Move the slider under Degrees and watch detail come and go.</p>
      <p>Drop a file of your own on the page when you like.</p>
    </div>
  );
}

export function MarkOffending({ offending }: { offending: number }) {
  return (
    <Check
      label={`Show the ${count(offending)} faces that the centre does not see`}
      checked={markOffending.value}
      onChange={(on) => (markOffending.value = on)}
    />
  );
}

function StarFacts() {
  const star = item.value?.star;
  if (!star || star.star_shaped) return null;
  return (
    <>
      <Hint>{star.why}</Hint>
      <MarkOffending offending={star.offending} />
    </>
  );
}

const units = ["µm", "mm", "cm", "m", "km"]; // a selection; others can be typed

// Files rarely contain the unit of their numbers.
function Unit({ one }: { one: Item }) {
  return (
    <TextField
      label="Length unit"
      placeholder="not set"
      value={one.unit}
      offers={units}
      onChange={(unit) => step({ op: "unit", item: one.id, unit: unit.trim() }, "Setting the unit")}
    />
  );
}

function Colors() {
  const surface = theView()?.surface("main");
  const options: [Coloring, string][] = [["plain", "One colour"]];
  if (surface?.colors) options.push(["own", "From the file"]);
  if (surface?.labels) options.push(["caps", "One for each cap"]);
  if (options.length === 1) return null;
  return (
    <Select
      label="Colours"
      value={coloring.value === "error" ? "plain" : coloring.value}
      options={options}
      onChange={(value) => (coloring.value = value)}
    />
  );
}

export function FiguresPanel() {
  const one = item.value;
  return (
    <>
      <UnreadTable />
      {demo.value && one && <Welcome />}
      <MakeShape />
      {one && (
        <TextField
          label="Name"
          value={one.name}
          onChange={(name) => step({ op: "rename", item: one.id, name }, "Renaming")}
        />
      )}
      {one && <Unit one={one} />}
      {one && <Facts facts={one.facts} />}
      {one && <TableColumns one={one} />}
      {(one?.warnings ?? []).map((text) => (
        <Hint key={text}>When it was read: {text}.</Hint>
      ))}
      <StarFacts />
      <Colors />
      {one && !one.closed && one.kind === "mesh" && (
        <Button onClick={() => step({ op: "repair", item: one.id }, "Repairing")}>Repair</Button>
      )}
    </>
  );
}
