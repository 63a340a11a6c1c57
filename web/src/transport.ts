// Connection to the studio: requests and events. Pages use HTTP; frames of notebooks use messages.ts.
import type { Fields, Job, State } from "./protocol";
import { decodeBinary, type Binary } from "./binary";

export interface Answer {
  status: number;
  type: string;
  bytes: Uint8Array;
}

export interface Listener {
  state(state: State): void;
  job(job: Job): void;
  connected(yes: boolean): void;
}

export interface Transport {
  // Addresses are relative to api/. Rejects with LostError if there is no answer.
  request(method: "GET" | "POST" | "DELETE", path: string, body?: BodyInit): Promise<Answer>;
  subscribe(listener: Listener): () => void;
  session: string;
  // Returns the session that this page had before, or was given; "" for none.
  remembered(): Promise<string>;
  remember(session: string): void;
  readonly program: string; // name of what answers, for messages
  readonly endsProgram: boolean; // true if the page may end it
  readonly pending: number; // requests without an answer yet
}

// There is no answer.
export class LostError extends Error {}

// The studio refuses, with a reason.
export class RefusedError extends Error {
  constructor(
    readonly status: number,
    readonly code: string,
    message: string,
  ) {
    super(message);
  }
}

const refusals: Record<number, string> = {
  404: "The studio does not know this.",
  409: "Something else is being worked on: wait for it or cancel it.",
  413: "This file is larger than the studio takes.",
  503: "Too many pages are open: close one.",
};

export const sessionKey = "rholm-session";

export class HttpTransport implements Transport {
  session = "";
  pending = 0;
  readonly program = "program";
  readonly endsProgram = true;

  constructor(private readonly base = new URL("api/", document.baseURI)) {}

  async request(method: string, path: string, body?: BodyInit): Promise<Answer> {
    const headers: Record<string, string> = this.session ? { "X-Session": this.session } : {};
    if (typeof body === "string") headers["Content-Type"] = "application/json";
    let response: Response;
    let bytes: Uint8Array;
    this.pending += 1;
    try {
      const init: RequestInit = { method, headers, cache: "no-store" };
      if (body !== undefined) init.body = body;
      response = await fetch(new URL(path, this.base), init);
      bytes = new Uint8Array(await response.arrayBuffer());
    } catch (error) {
      throw new LostError("The studio does not answer.", { cause: error });
    } finally {
      this.pending -= 1;
    }
    const type = response.headers.get("Content-Type") ?? "";
    return accepted({ status: response.status, type, bytes });
  }

  remembered(): Promise<string> {
    return Promise.resolve(sessionStorage.getItem(sessionKey) ?? "");
  }

  remember(session: string): void {
    sessionStorage.setItem(sessionKey, session);
  }

  subscribe(listener: Listener): () => void {
    const address = new URL("events", this.base);
    address.searchParams.set("session", this.session);
    const source = new EventSource(address);
    source.addEventListener("state", (event: MessageEvent<string>) =>
      listener.state(JSON.parse(event.data) as State),
    );
    source.addEventListener("job", (event: MessageEvent<string>) =>
      listener.job(JSON.parse(event.data) as Job),
    );
    source.onopen = () => listener.connected(true);
    source.onerror = () => listener.connected(false);
    return () => source.close();
  }
}

// Returns the answer; throws RefusedError for a refusal.
export function accepted(answer: Answer): Answer {
  const { status, bytes } = answer;
  if (status < 400) return answer;
  let said: { code: string; message: string };
  try {
    said = (json(bytes) as { error: { code: string; message: string } }).error;
  } catch {
    throw new RefusedError(status, "", refusals[status] ?? `The studio says ${status}.`);
  }
  throw new RefusedError(status, said.code, said.message);
}

function json(bytes: Uint8Array): unknown {
  return JSON.parse(new TextDecoder().decode(bytes));
}

export async function getJson<T>(transport: Transport, path: string): Promise<T> {
  return json((await transport.request("GET", path)).bytes) as T;
}

export async function postJson<T>(transport: Transport, path: string, fields: Fields): Promise<T> {
  return json((await transport.request("POST", path, JSON.stringify(fields))).bytes) as T;
}

// `columns` are the columns of a text table, if known.
export async function postFile<T>(transport: Transport, name: string, file: Blob, columns = ""): Promise<T> {
  const said = columns ? `&columns=${encodeURIComponent(columns)}` : "";
  const path = `file?name=${encodeURIComponent(name)}${said}`;
  return json((await transport.request("POST", path, file)).bytes) as T;
}

export async function getBinary(transport: Transport, path: string): Promise<Binary> {
  return decodeBinary((await transport.request("GET", path)).bytes);
}

export async function postLive(transport: Transport, fields: Fields): Promise<Binary> {
  return decodeBinary((await transport.request("POST", "live", JSON.stringify(fields))).bytes);
}
