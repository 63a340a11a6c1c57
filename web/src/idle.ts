// When the page is at rest: for those that drive it.
import { quiet } from "./actions";
import { theView } from "./show";

const frames = 3; // chosen: an answer becomes a surface, an effect and a picture

// Until nothing is asked for, worked on or moving, for some frames.
export async function idle(): Promise<void> {
  for (let still = 0; still < frames; ) {
    await new Promise((next) => requestAnimationFrame(next));
    await new Promise((next) => setTimeout(next));
    still = quiet() && !theView()?.busy ? still + 1 : 0;
  }
}

declare global {
  interface Window {
    rholmIdle: () => Promise<void>;
  }
}
