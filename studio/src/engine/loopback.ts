// The engine in the binary that serves the page. The answer to a request is a line of JSON, then the outputs:
//
//     {"code":0,"outputs":[["findings",812],["messages",0]]}
//
// Not here: what shows the server that a request comes from its page (`Ask`).

import { Answer, Cancelled, type Engine, type Request } from "./engine";

/** Sends a request of the page; fails where the server refuses it. */
export type Ask = (method: string, path: string, body?: BodyInit, signal?: AbortSignal) => Promise<Response>;

/** Requests with the token that the page was opened with, so that no other page can have them done. */
export function withToken(token: string): Ask {
  return async (method, path, body, signal) => {
    const headers = { authorization: `Bearer ${token}` };
    const answer = await fetch(path, { method, headers, ...(body !== undefined && { body }), ...(signal && { signal }) });
    if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
    return answer;
  };
}

export class Loopback implements Engine {
  private breaker = new AbortController();
  /** The steps, one after the other. */
  private chain: Promise<unknown> = Promise.resolve();
  private count = 0;

  constructor(
    private readonly asks: Ask,
    /** The address of the room. */
    protected readonly path: string,
  ) {}

  get waiting(): number {
    return this.count;
  }

  put(name: string, bytes: Uint8Array): void {
    void this.next(() => this.send("PUT", `files/${encodeURIComponent(name)}`, bytes.slice())).catch(() => undefined);
  }

  run(request: Request): Promise<Answer> {
    const { signal } = this.breaker;
    this.count += 1;
    const over = this.next(async () => {
      if (signal.aborted) throw new Cancelled();
      return read(await this.send("POST", "run", JSON.stringify(request), signal));
    }).finally(() => (this.count -= 1));
    return over.catch((error: unknown) => {
      throw signal.aborted ? new Cancelled() : error;
    });
  }

  cancel(): void {
    this.breaker.abort();
    this.breaker = new AbortController();
  }

  /** Does a step after those before it. */
  protected next<T>(step: () => Promise<T>): Promise<T> {
    const own = this.chain.then(step);
    this.chain = own.catch(() => undefined);
    return own;
  }

  /** Sends a request about the room. */
  protected async send(method: string, part: string, body?: BodyInit, signal?: AbortSignal): Promise<Uint8Array> {
    const answer = await this.asks(method, part ? `${this.path}/${part}` : this.path, body, signal);
    return new Uint8Array(await answer.arrayBuffer());
  }
}

function read(bytes: Uint8Array): Answer {
  const end = bytes.indexOf(10);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end))) as {
    code: number;
    outputs: [string, number][];
  };
  const outputs = new Map<string, Uint8Array>();
  let at = end + 1;
  for (const [name, length] of head.outputs) {
    outputs.set(name, bytes.slice(at, at + length));
    at += length;
  }
  return new Answer(head.code, outputs);
}
