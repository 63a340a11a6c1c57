// Tells test drivers when the page is at rest.
import { quiet } from "./actions";
import { theView } from "./show";

const frames = 3; // chosen: an answer becomes a surface, an effect and a picture

// Resolves when no request, work or motion has been pending for some frames.
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
