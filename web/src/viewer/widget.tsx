// The viewer: shape, degree slider, colours, spectrum. The page itself computes all sums.
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { number, withUnit } from "../format";
import { plain } from "../geometry/colors";
import { ColorScale } from "../plots/legend";
import { Spectrum } from "../plots/spectrum";
import { NoWebGlError, View } from "../scene/view";
import type { ViewData } from "../viewdata";
import { Check, Select, Slider } from "../widgets";
import { makeModel, setDegree, valuesFor, type Coloring, type Model } from "./model";

const colorings = [
  ["plain", "One colour"],
  ["radius", "Radius"],
  ["difference", "Difference from all degrees"],
] as const;

function useView(model: Model) {
  const host = useRef<HTMLDivElement>(null);
  const [view, setView] = useState<View | null>(null);
  const [trouble, setTrouble] = useState("");
  useEffect(() => {
    const element = host.current;
    if (!element) return undefined;
    try {
      const made = new View(element);
      made.show("main", model.surface);
      made.describe(`The shape ${model.data.title}`);
      made.fit(false);
      setView(made);
      return () => made.dispose();
    } catch (error) {
      if (!(error instanceof NoWebGlError)) throw error;
      setTrouble(error.message);
      return undefined;
    }
  }, [model]);
  return { host, view, trouble };
}

function Measures({ data, degree }: { data: ViewData; degree: number }) {
  const row = data.error.findLast(([l]) => l <= degree);
  if (row?.[0] !== degree || row[1] === null) return null;
  const most = row[2] === null ? "" : `, ${withUnit(row[2], data.unit)} at most`;
  return (
    <p class="hint">
      {withUnit(row[1], data.unit)} off (rms){most}
    </p>
  );
}

export function Viewer({ data }: { data: ViewData }) {
  const model = useMemo(() => makeModel(data), [data]);
  const { host, view, trouble } = useView(model);
  const top = data.expansion.degree;
  const [degree, setShown] = useState(top);
  const [coloring, setColoring] = useState<Coloring>("plain");
  const [beside, setBeside] = useState(false);
  const painted = useMemo(() => {
    setDegree(model, degree);
    return valuesFor(model, coloring);
  }, [model, degree, coloring]);
  useEffect(() => {
    view?.move(model.surface.positions, model.normals);
    if (painted) view?.paintValues(painted.range, painted.values);
    else view?.paint("main", plain);
  }, [view, model, degree, painted]);
  useEffect(() => {
    view?.show("other", beside ? model.original : null);
    view?.arrange(beside ? "side" : "one");
  }, [view, model, beside]);
  return (
    <div class="rholm-viewer">
      <div class="stage">
        <div class="canvas" ref={host} />
        {trouble && <p class="notice">{trouble}</p>}
        {painted && <ColorScale range={painted.range} label={painted.label} unit={data.unit} />}
      </div>
      <div class="panel">
        {data.title && <strong>{data.title}</strong>}
        <Slider label="Degree" value={degree} min={0} max={top} step={1} scale="root" onInput={setShown} />
        <Measures data={data} degree={degree} />
        <Select label="Colours" value={coloring} options={colorings} onChange={setColoring} />
        {model.original && (
          <Check label="Beside the original" checked={beside} onChange={setBeside} />
        )}
        <Spectrum power={data.power} tail={data.tail} degree={degree} />
        <p class="hint">{number(top)} degrees. Drag to turn, wheel to come nearer.</p>
      </div>
    </div>
  );
}
