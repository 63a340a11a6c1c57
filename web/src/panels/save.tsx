import { signal, type Signal } from "@preact/signals";
import { fail, offer, saveAs, saveSession } from "../actions";
import { Button } from "../button";
import { stem } from "../format";
import type { Item } from "../protocol";
import { theView } from "../show";
import { item, studio } from "../state";
import { Copy, Hint, Select, Slider } from "../widgets";

const format = signal(""); // the chosen format; if empty, the item's first one
const width = signal(1600);
const height = signal(1200);
const mostPixels = 16_384; // chosen: the largest canvas of browsers

function SaveShape({ one }: { one: Item }) {
  const formats = one.saved_as;
  const chosen = formats.find((known) => known.format === format.value) ?? formats[0];
  if (!chosen) return null;
  const name = `${stem(one.name)}.${chosen.extension}`;
  return (
    <>
      <Select
        label="Format"
        value={chosen.format}
        options={formats.map((known) => [known.format, known.label] as const)}
        onChange={(value) => (format.value = value)}
      />
      <Button main onClick={() => saveAs(`save?item=${one.id}&format=${chosen.format}`, name, [one])}>
        Save {name}
      </Button>
    </>
  );
}

async function savePicture(one: Item): Promise<void> {
  const view = theView();
  if (!view) return;
  try {
    offer(await view.picture(width.value, height.value), `${stem(one.name)}.png`);
  } catch (error) {
    fail(error);
  }
}

function Pixels({ label, value }: { label: string; value: Signal<number> }) {
  return (
    <Slider
      label={label}
      unit="px"
      value={value.value}
      min={200}
      max={mostPixels}
      step={1}
      scale="log"
      onInput={(pixels) => (value.value = pixels)}
    />
  );
}

function Pictures({ one }: { one: Item }) {
  return (
    <>
      <h3>Picture and report</h3>
      <Pixels label="Width" value={width} />
      <Pixels label="Height" value={height} />
      <div class="row wrap">
        <Button onClick={() => savePicture(one)}>Save the picture</Button>
        {one.expansion && (
          <Button onClick={() => saveAs(`save?item=${one.id}&format=html`, `${stem(one.name)}.html`)}>
            Save a report
          </Button>
        )}
      </div>
    </>
  );
}

export function SavePanel() {
  const one = item.value;
  const recipe = studio.value?.recipe;
  return (
    <>
      {one ? <SaveShape one={one} /> : <Hint>Nothing is open.</Hint>}
      {one && <Pictures one={one} />}
      <h3>Session</h3>
      <Hint>All shapes and steps in one file; open it like any other.</Hint>
      <Button onClick={saveSession}>Save the session</Button>
      {recipe && (
        <>
          <h3>Recipe</h3>
          <Hint>Commands that do the same steps in a shell or in Python.</Hint>
          <Copy label="Shell" text={recipe.shell} />
          <Copy label="Python" text={recipe.python} />
        </>
      )}
    </>
  );
}
