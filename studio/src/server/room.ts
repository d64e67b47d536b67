// The engine in a room of the server. A server gives up a room that nobody has used for a while: then its files are put again, and
// what was cut last is cut again.

import type { Request } from "../engine/engine";
import { Loopback } from "../engine/loopback";
import { Refused, type Api, type Sent } from "./api";

/** A request of the room: a text is JSON. */
function sentOf(body: BodyInit | undefined, signal: AbortSignal | undefined): Sent {
  const type = typeof body === "string" ? "application/json" : "application/octet-stream";
  return { ...(body !== undefined && { body, headers: { "content-type": type } }), ...(signal && { signal }) };
}

export class Room extends Loopback {
  private readonly files = new Map<string, Uint8Array>();
  private cut: string | undefined;
  private program: string | undefined;
  private opened = false;

  constructor(api: Api, room: string) {
    super((method, path, body, signal) => api.ask(method, path, sentOf(body, signal)), `/api/v1/engine/${room}`);
    // Rooms of pages that are gone would be kept for a while.
    addEventListener("pagehide", () => {
      this.opened = false;
      void api.ask("DELETE", this.path, { keepalive: true }).catch(() => undefined);
    });
  }

  override put(name: string, bytes: Uint8Array): void {
    this.files.set(name, bytes);
    super.put(name, bytes);
  }

  override run(request: Request): ReturnType<Loopback["run"]> {
    return super.run(request).then((answer) => {
      if (request.verb === "simulate") this.cut = JSON.stringify(request);
      return answer;
    });
  }

  clear(): void {
    this.files.clear();
    [this.cut, this.program] = [undefined, undefined];
    void this.next(async () => {
      if (this.opened) await super.send("DELETE", "");
      this.opened = false;
    }).catch(() => undefined);
  }

  called(program: string): Promise<unknown> {
    this.program = program;
    return this.next(() => this.send("PUT", `called/${program}`));
  }

  protected override async send(method: string, part: string, body?: BodyInit, signal?: AbortSignal): Promise<Uint8Array> {
    if (!this.opened) await this.open(method === "POST", signal);
    try {
      return await super.send(method, part, body, signal);
    } catch (error) {
      if (!(error instanceof Refused && error.status === 404)) throw error;
      await this.open(true, method === "POST" ? signal : undefined);
      return super.send(method, part, body, signal);
    }
  }

  /** Makes the room, with what it had. */
  private async open(whole: boolean, signal?: AbortSignal): Promise<void> {
    await super.send("PUT", "");
    this.opened = true;
    if (!whole) return;
    for (const [name, bytes] of this.files) await super.send("PUT", `files/${encodeURIComponent(name)}`, bytes.slice());
    if (this.program) await super.send("PUT", `called/${this.program}`);
    if (this.cut && signal) await super.send("POST", "run", this.cut, signal);
  }
}
