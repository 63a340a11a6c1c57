// The studio in a frame of a notebook: requests and events pass through
// the surrounding window, which forwards them to Python (notebook.ts).
import type { Job, State } from "./protocol";
import { accepted, LostError, type Answer, type Listener, type Transport } from "./transport";

// Request of the frame.
export interface Asked {
  id: number;
  method: string;
  path: string; // "api/state"
  query: Record<string, string>;
  session: string;
  body: Uint8Array | null;
}

// Messages to the frame. The first one is a Welcome with the port for all others.
export interface Welcome {
  welcome: { session: string };
}
export interface Answered {
  answer: { id: number; status: number; type: string; bytes: Uint8Array };
}
export interface Told {
  event: string; // "state", "job"; "beat" means that Python is alive
  data: string;
}

const silence = 25_000; // ms; chosen: Python sends a beat every ten seconds

export class PortTransport implements Transport {
  session = "";
  readonly program = "notebook's kernel";
  readonly endsProgram = false;
  private asked = 0;
  private readonly waiting = new Map<number, (answer: Answer | null) => void>();
  private readonly listeners = new Set<Listener>();
  private readonly welcome: Promise<{ port: MessagePort; session: string }>;
  private watch: ReturnType<typeof setTimeout> | undefined;

  constructor(window: Pick<Window, "addEventListener">) {
    this.welcome = new Promise((come) => {
      window.addEventListener("message", ({ data, ports }: MessageEvent<unknown>) => {
        const port = ports[0];
        if (!port || !isWelcome(data)) return;
        port.onmessage = ({ data: said }: MessageEvent<Answered | Told>) => this.hear(said);
        come({ port, session: data.welcome.session });
      });
    });
  }

  get pending(): number {
    return this.waiting.size;
  }

  async remembered(): Promise<string> {
    return (await this.welcome).session;
  }

  remember(): void {
    // The widget stores the session.
  }

  async request(method: string, path: string, body?: BodyInit): Promise<Answer> {
    const { port } = await this.welcome;
    const { pathname, searchParams } = new URL(path, "http://studio/api/");
    const id = (this.asked += 1);
    const answer = new Promise<Answer | null>((give) => this.waiting.set(id, give));
    const bytes = body === undefined ? null : await bytesOf(body);
    const asked: Asked = {
      id,
      method,
      path: pathname.slice(1),
      query: Object.fromEntries(searchParams),
      session: this.session,
      body: bytes,
    };
    port.postMessage(asked);
    const given = await answer;
    if (!given) throw new LostError("The studio does not answer.");
    return accepted(given);
  }

  subscribe(listener: Listener): () => void {
    this.listeners.add(listener);
    this.alive();
    return () => this.listeners.delete(listener);
  }

  private hear(said: Answered | Told): void {
    this.alive();
    if ("answer" in said) {
      const { id, ...answer } = said.answer;
      this.waiting.get(id)?.(answer);
      this.waiting.delete(id);
    } else {
      for (const listener of this.listeners) tell(listener, said);
    }
  }

  // Any message shows that Python is alive, and restarts the time limit of silence.
  private alive(): void {
    clearTimeout(this.watch);
    for (const listener of this.listeners) listener.connected(true);
    this.watch = setTimeout(() => {
      for (const give of this.waiting.values()) give(null);
      this.waiting.clear();
      for (const listener of this.listeners) listener.connected(false);
    }, silence);
  }
}

function isWelcome(data: unknown): data is Welcome {
  return typeof data === "object" && data !== null && "welcome" in data;
}

function tell(listener: Listener, { event, data }: Told): void {
  if (event === "state") listener.state(JSON.parse(data) as State);
  if (event === "job") listener.job(JSON.parse(data) as Job);
}

async function bytesOf(body: BodyInit): Promise<Uint8Array> {
  return new Uint8Array(await new Response(body).arrayBuffer());
}
