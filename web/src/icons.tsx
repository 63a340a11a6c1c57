// Icons beside words: lines in a square of 20 by 20, drawn for this page.
const paths = {
  figures: "M4 5h12M4 10h12M4 15h7",
  degrees: "M2 10c2-8 4-8 6 0s3 6 4.5 0 2.5-4 3.5 0 1.5 2.5 2 0",
  smooth: "M16.5 3.5 9 11M9 11l2 2c0 3-3.5 4-7.5 3.5 2-1 1-4 3-5.5z",
  texture: "M3 3h6v6H3zM11 11h6v6h-6zM11.5 6H15v3.5M13 8l2-2",
  points: "M4 5h.01M10 3.5h.01M16 6h.01M6.5 10h.01M12.5 9.5h.01M4 15h.01M9.5 15.5h.01M16 14h.01",
  caps: "M10 2.5 17 7v6l-7 4.5L3 13V7zM10 2.5V10M10 10l7 3M10 10l-7 3",
  align: "M3 8.5a6 6 0 0 1 10-4M13 1.5v3h-3M17 11.5a6 6 0 0 1-10 4M7 18.5v-3h3",
  save: "M10 3v9M6 8.5l4 4 4-4M3.5 13v3.5h13V13",
  undo: "M7 4 3.5 7.5 7 11M4 7.5h7.5a4.5 4.5 0 0 1 0 9H8",
  redo: "M13 4l3.5 3.5L13 11M16 7.5H8.5a4.5 4.5 0 0 0 0 9H12",
  theme: "M10 3a7 7 0 1 0 0 14zM10 3a7 7 0 0 1 0 14",
  help: "M7 7.5a3 3 0 1 1 4.2 2.7c-.8.4-1.2 1-1.2 2M10 15.5h.01",
  stop: "M10 3v7M6 5.5a6 6 0 1 0 8 0",
} as const;

export type IconName = keyof typeof paths;

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class={`icon ${name}`} viewBox="0 0 20 20" width="20" height="20" aria-hidden="true">
      <path d={paths[name]} />
    </svg>
  );
}
