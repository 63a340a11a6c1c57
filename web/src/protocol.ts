// Messages between the studio and the page: docs/studio.md.

export interface Fact {
  label: string;
  value: string;
}

export interface Star {
  star_shaped: boolean;
  center: Vector;
  visible: number; // share of the area that is seen from the centre, 0 ... 1
  offending: number; // faces not seen from the centre
  why: string;
}

export interface ItemExpansion {
  degree: number;
  function: string;
  rms_per_degree: (number | null)[] | null; // in the unit of lengths, after degrees 0 ... L; null: not known
  error: [degree: number, rms: number | null, max: number | null][];
  tail: { strength: number } | null; // S of the predicted energy S / (pi l^4)
  power: number[]; // energy of degrees 0 ... L
}

export interface ItemAtlas {
  bytes: number; // size of its file
  degree: number; // the highest degree of a cap
  error: { rms: number; max: number } | null; // errors of the whole surface, measured, in the unit of lengths
}

// Assumed meaning of a text table's columns; `note` says what was assumed and why.
export interface Table {
  columns: { name: string; taken_for: string }[];
  note: string;
  unsure: boolean; // another reading is possible
}

export type Vector = [number, number, number];
export type Kind = "mesh" | "points" | "expansion" | "atlas";

export interface Item {
  id: number;
  name: string;
  kind: Kind;
  revision: number;
  facts: Fact[];
  vertices: number;
  faces: number;
  diagonal: number; // diagonal of the bounding box
  center: Vector;
  unit: string;
  closed: boolean;
  star: Star | null;
  expansion: ItemExpansion | null;
  table?: Table | null; // only for points read from a text table
  warnings?: string[]; // warnings by the reader of its file
  normals?: boolean;
  caps?: number;
  placed?: string | null; // text on how it was aligned with another item
  atlas?: ItemAtlas | null;
  look: { degree: number; gains: number[] | null } | null;
  saved_as: SavedFormat[];
}

// Format in which an item can be saved; its files end in `extension`.
export interface SavedFormat {
  format: string;
  label: string;
  extension: string;
}

// Format of files that can be opened, and the kinds of items it gives.
export interface OpenedFormat {
  format: string;
  title: string;
  extensions: string[];
  kinds: Kind[];
}

export interface Job {
  id: number;
  label: string;
  stage: string;
  fraction: number;
  state: "running" | "done" | "failed" | "cancelled";
  message: string;
  seconds: number;
}

export interface State {
  version: string;
  session: string;
  max_upload: number; // bytes of a file
  opens: OpenedFormat[];
  items: Item[];
  undo: string | null;
  redo: string | null;
  recipe: { shell: string; python: string };
  job: Job | null;
}

// Parameter of a filter window. If `default` is null, the degree of the filter determines it.
export interface WindowParameter {
  name: string;
  symbol: string;
  help: string;
  whole: boolean;
  min: number;
  max: number;
  default: number | null;
  replaces_cutoff: boolean; // if given, the degree of the filter is ignored
}

export interface FilterWindow {
  name: string;
  formula: string; // the gain of degree l
  help: string;
  overshoot: number; // overshoot of a step at degree 64, in parts of its height
  parameters: WindowParameter[];
}

export interface FilterWindows {
  windows: FilterWindow[];
  default: string;
}

export type Value = number | string | boolean | null;

// Option of a step, from GET api/controls.
export interface Control {
  name: string;
  label: string;
  help: string;
  kind: "flag" | "choice" | "number" | "whole number";
  default: Value; // null: the library decides
  least: number | null;
  most: number | null;
  step: number | null; // step of a slider
  scale: "linear" | "log";
  unit: "" | "diagonal" | "degrees"; // "diagonal": as a part of the item's diagonal
  choices: { value: string; label: string }[];
  shown: boolean; // true: a panel shows it; false: it is under more options
}

export type Controls = Readonly<Record<string, Control[]>>; // keys are the ops of steps

// Request of POST api/step or api/live; docs/studio.md lists its fields.
export type Fields = Record<string, unknown>;

// Drawn data of an item. Lengths are in the unit of the item.
export interface Surface {
  positions: Float32Array; // [n, 3]
  normals: Float32Array | null; // [n, 3]
  triangles: Uint32Array | null; // [m, 3]; null: points
  colors: Uint8Array | null; // [n, 3], sRGB
  labels: Uint32Array | null; // [n], the cap of each vertex
  offending: Uint32Array | null; // faces not seen from the centre
}
