// Live answers: the slider moves, the surface follows. One request in flight, the latest wish wins.
import { fail, transport } from "./actions";
import type { Binary } from "./binary";
import { recordLatency } from "./latency";
import { latestWins, type Latest } from "./latest";
import type { Fields } from "./protocol";
import { theView } from "./show";
import { notice } from "./state";
import { postLive } from "./transport";

interface Wish {
  fields: Fields;
  since: number; // the input event's time stamp, ms
}

// A channel for one kind of request. `apply` puts the answer on the screen.
export function liveChannel(
  kind: string,
  apply: (answer: Binary, fields: Fields) => void,
): Latest<Wish> {
  let refused: typeof notice.value = null; // what the last refusal said: gone with the next answer
  const refuse = (error: unknown) => {
    fail(error);
    refused = notice.peek();
  };
  return latestWins<Wish>(async ({ fields, since }, current) => {
    const answer = await postLive(transport, { live: kind, ...fields });
    if (!current()) return;
    if (refused && notice.peek() === refused) notice.value = null;
    recordLatency(`${kind} (answer)`, since);
    apply(answer, fields);
    await theView()?.drawn();
    recordLatency(kind, since);
  }, refuse);
}
