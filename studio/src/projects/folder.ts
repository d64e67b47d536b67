// Programs in the folder that the binary serves: listed, read, watched, and saved over what was read, never over another's.

import { ANSWERS } from "./zip";

export interface List {
  folder: string;
  programs: { name: string; bytes: number }[];
  /** Whether there is a project file beside them. */
  answers: boolean;
  /** Changes when one of them does. */
  stamp: string;
}

export class Folder {
  constructor(private readonly token: string) {}

  /** The programs; with a stamp, as soon as it is another one, or after a while. */
  async list(stamp?: string): Promise<List> {
    const answer = await this.ask("GET", stamp ? `programs?stamp=${stamp}` : "programs");
    if (!answer.ok) throw new Error(`programs: ${answer.status}`);
    const list = (await answer.json()) as List;
    // Answers are no program.
    const programs = list.programs.filter((one) => one.name !== ANSWERS);
    return { ...list, programs, answers: programs.length < list.programs.length };
  }

  /** A program's bytes and their tag. */
  async read(name: string): Promise<[Uint8Array, string] | undefined> {
    const answer = await this.ask("GET", path(name));
    if (!answer.ok) return undefined;
    return [new Uint8Array(await answer.arrayBuffer()), answer.headers.get("etag") ?? ""];
  }

  /** Saves over what has the tag, or anew without one; gives the new one, or nothing where something else is there by now. */
  async write(name: string, bytes: Uint8Array, tag: string | undefined): Promise<string | undefined> {
    const over: Record<string, string> = tag === undefined ? { "if-none-match": "*" } : { "if-match": tag };
    const answer = await this.ask("PUT", path(name), over, bytes.slice());
    return answer.ok ? (answer.headers.get("etag") ?? "") : undefined;
  }

  /** Tells each change, for as long as the page lives. */
  async watch(stamp: string, changed: (list: List) => void): Promise<void> {
    let known = stamp;
    for (;;) {
      try {
        const list = await this.list(known);
        if (list.stamp !== known) changed(list);
        known = list.stamp;
      } catch {
        // The binary may be gone; where it comes back, it is asked again.
        await new Promise((done) => setTimeout(done, 5000));
      }
    }
  }

  private ask(method: string, where: string, more: Record<string, string> = {}, body?: BodyInit): Promise<Response> {
    const headers = { authorization: `Bearer ${this.token}`, ...more };
    return fetch(where, { method, headers, ...(body && { body }) });
  }
}

function path(name: string): string {
  return `programs/${encodeURIComponent(name)}`;
}
