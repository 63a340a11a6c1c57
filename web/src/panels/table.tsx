// Text tables of points: the assumed columns, and the columns that people enter.
import { openTable, step } from "../actions";
import type { Item } from "../protocol";
import { unread } from "../state";
import { Facts, Hint, TextField } from "../widgets";

const words = "x,y,z,nx,ny,nz,r,g,b,a"; // words of the program's --columns

function Words() {
  return (
    <Hint>
      One word for each column: {words.replaceAll(",", ", ")}; lat, lon, radius for x, y, z; - passes over one; any
      other word is its name.
    </Hint>
  );
}

// Columns of the table that was read, below the shape.
export function TableColumns({ one }: { one: Item }) {
  const { table } = one;
  if (!table) return null;
  const named = table.columns.some(({ name }) => name !== "");
  const rows = table.columns.map(({ name, taken_for }, i) => ({
    label: `${i + 1}${name ? ` ${name}` : ""}`,
    value: taken_for === "-" ? "passed over" : taken_for,
  }));
  return (
    <>
      <h3>Columns of the table</h3>
      <Hint>
        {table.note.charAt(0).toUpperCase()}
        {table.note.slice(1)}.
      </Hint>
      {named && <Facts facts={rows} />}
      <TextField
        key={one.revision}
        label="Columns"
        value={table.columns.map(({ taken_for }) => taken_for).join(",")}
        onChange={(columns) => step({ op: "columns", item: one.id, columns: columns.trim() }, "Reading the table")}
      />
      <Words />
    </>
  );
}

// Shown if a refused file may be a table.
export function UnreadTable() {
  const file = unread.value;
  if (!file) return null;
  return (
    <>
      <h3>A table?</h3>
      <Hint>{file.name} was not read. If it is a table of points, say what its columns are.</Hint>
      <TextField
        label="Its columns"
        placeholder="x,y,z,-"
        value=""
        onChange={(columns) => openTable(file, columns.trim())}
      />
      <Words />
      <button type="button" onClick={() => (unread.value = null)}>
        It is no table
      </button>
    </>
  );
}
