// Live answers during dragging. One request runs at a time; of the waiting ones the latest is kept.
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
  since: number; // time stamp of the input event, ms
}

// Makes a channel for one kind of request. `apply` shows the answer.
export function liveChannel(
  kind: string,
  apply: (answer: Binary, fields: Fields) => void,
): Latest<Wish> {
  let refused: typeof notice.value = null; // notice of the last refusal; removed by the next answer
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
