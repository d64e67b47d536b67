// The engine in the binary that serves the page. The answer to a request is a line of JSON, then the outputs:
//
//     {"code":0,"outputs":[["findings",812],["messages",0]]}
//
// The token that the page was opened with goes with each request, so that no other page can have them done.

import { Answer, Cancelled, type Engine, type Request } from "./engine";

export class Loopback implements Engine {
  private breaker = new AbortController();
  /** The steps, one after the other. */
  private chain: Promise<unknown> = Promise.resolve();
  private count = 0;

  constructor(
    private readonly token: string,
    private readonly room: string,
  ) {}

  get waiting(): number {
    return this.count;
  }

  put(name: string, bytes: Uint8Array): void {
    const path = `engine/${this.room}/files/${encodeURIComponent(name)}`;
    this.chain = this.chain.then(() => this.ask("PUT", path, bytes.slice(), undefined)).catch(() => undefined);
  }

  run(request: Request): Promise<Answer> {
    const { signal } = this.breaker;
    const path = `engine/${this.room}/run`;
    this.count += 1;
    const step = this.chain.then(async () => {
      if (signal.aborted) throw new Cancelled();
      return read(await this.ask("POST", path, JSON.stringify(request), signal));
    });
    const over = step.finally(() => (this.count -= 1));
    this.chain = over.catch(() => undefined);
    return over.catch((error: unknown) => {
      throw signal.aborted ? new Cancelled() : error;
    });
  }

  cancel(): void {
    this.breaker.abort();
    this.breaker = new AbortController();
  }

  private async ask(
    method: string,
    path: string,
    body: BodyInit,
    signal: AbortSignal | undefined,
  ): Promise<Uint8Array> {
    const headers = { authorization: `Bearer ${this.token}` };
    const answer = await fetch(path, { method, headers, body, ...(signal && { signal }) });
    if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
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
