// Programs of the server, their revisions and translations, as `/api/v1` has them.

import type { Api } from "./api";

/** A program, as it is or as it was. */
export interface Program {
  id: string;
  folder: string;
  name: string;
  dialect: string | null;
  machine: string | null;
  revision: number;
  change: string;
  bytes: number;
  author: string;
  message: string;
  made: string;
}

/** Which ones are listed. */
export interface Wanted {
  folder?: string | undefined;
  name?: string | undefined;
  deleted?: boolean;
  after?: string | undefined;
}

export interface Machine {
  name: string;
  title: string | null;
  dialect: string | null;
  ships_with_ncc: boolean;
}

export interface Translated {
  id: string;
  program: string;
  revision: number;
  asked: { to?: string; machine_to?: string };
  state: string;
  stale: string[];
  author: string;
  made: string;
}

const PROGRAMS = "/api/v1/programs";
const TRANSLATIONS = "/api/v1/translations";

/** A query of what is stated. */
function query(fields: Record<string, string | undefined>): string {
  const stated = Object.entries(fields).filter((field): field is [string, string] => field[1] !== undefined);
  return stated.length > 0 ? `?${new URLSearchParams(stated)}` : "";
}

const over = (revision: number) => ({ "if-match": `"${revision}"` });

export class Programs {
  constructor(readonly api: Api) {}

  list({ folder, name, deleted, after }: Wanted): Promise<{ programs: Program[]; next: string | null }> {
    const fields = { folder, name: name || undefined, deleted: deleted ? "true" : undefined, after };
    return this.api.json("GET", PROGRAMS + query(fields));
  }

  async folders(): Promise<{ folder: string; programs: number }[]> {
    return (await this.api.json<{ folders: { folder: string; programs: number }[] }>("GET", "/api/v1/folders")).folders;
  }

  /** Programs of a folder, a thousand at most. */
  async inFolder(folder: string): Promise<Program[]> {
    return (await this.api.json<{ programs: Program[] }>("GET", PROGRAMS + query({ folder, limit: "1000" }))).programs;
  }

  read(id: string): Promise<Program> {
    return this.api.json("GET", `${PROGRAMS}/${id}`);
  }

  revision(id: string, number: number): Promise<Program> {
    return this.api.json("GET", `${PROGRAMS}/${id}/revisions/${number}`);
  }

  /** The text of a revision. */
  async text(id: string, revision: number): Promise<Uint8Array> {
    return new Uint8Array(await (await this.api.ask("GET", `${PROGRAMS}/${id}/revisions/${revision}/text`)).arrayBuffer());
  }

  create(name: string, folder: string, bytes: Uint8Array, message: string, dialect?: string): Promise<Program> {
    const where = query({ name, folder: folder || undefined, message: message || undefined, dialect });
    return this.api.json("POST", PROGRAMS + where, text(bytes));
  }

  /** Keeps another text over a revision. */
  save(id: string, revision: number, bytes: Uint8Array, message: string): Promise<Program> {
    const { body, headers } = text(bytes);
    return this.api.json("PUT", `${PROGRAMS}/${id}/text${query({ message: message || undefined })}`, { body, headers: { ...headers, ...over(revision) } });
  }

  change(id: string, revision: number, json: Record<string, string | null>): Promise<Program> {
    return this.api.json("PATCH", `${PROGRAMS}/${id}`, { json, headers: over(revision) });
  }

  remove({ id, revision }: Program): Promise<Program> {
    return this.api.json("DELETE", `${PROGRAMS}/${id}`, { headers: over(revision) });
  }

  revisions(id: string, before?: number): Promise<{ revisions: Program[]; next: number | null }> {
    return this.api.json("GET", `${PROGRAMS}/${id}/revisions${query({ before: before?.toString() })}`);
  }

  /** Makes a program again what it was, over its latest revision. */
  restore(id: string, number: number, latest: number): Promise<Program> {
    return this.api.json("POST", `${PROGRAMS}/${id}/revisions/${number}/restore`, { headers: over(latest) });
  }

  async machines(): Promise<Machine[]> {
    return (await this.api.json<{ machines: Machine[] }>("GET", "/api/v1/machines")).machines;
  }

  async profile(name: string): Promise<Uint8Array> {
    return new Uint8Array(await (await this.api.ask("GET", `/api/v1/machines/${encodeURIComponent(name)}`)).arrayBuffer());
  }

  async translations(program: string): Promise<Translated[]> {
    return (await this.api.json<{ translations: Translated[] }>("GET", TRANSLATIONS + query({ program }))).translations;
  }

  translate(json: Record<string, unknown>): Promise<Translated> {
    return this.api.json("POST", TRANSLATIONS, { json });
  }

  step(id: string, state: string, message: string): Promise<Translated> {
    return this.api.json("POST", `${TRANSLATIONS}/${id}/states`, { json: { state, message } });
  }

  /** What came of a translation. */
  async outcome(id: string, what: string): Promise<Uint8Array> {
    return new Uint8Array(await (await this.api.ask("GET", `${TRANSLATIONS}/${id}/${what}`)).arrayBuffer());
  }
}

function text(bytes: Uint8Array): { body: BodyInit; headers: Record<string, string> } {
  return { body: bytes.slice(), headers: { "content-type": "application/octet-stream" } };
}
