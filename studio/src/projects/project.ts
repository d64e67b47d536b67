// A project: a program, how it is read, and what it is translated to.

/** How a program is read and translated; names and values are those of the command line. */
export interface Choices {
  /** The dialect, or `auto`. */
  from: string;
  /** The machine, or nothing. */
  machine: string;
  /** The dialect of the translation, or nothing yet. */
  to: string;
  /** The machine of the translation, or nothing. */
  machineTo: string;
  fromOption: Record<string, string>;
  toOption: Record<string, string>;
  pass: string[];
  /** The raw part, as `--stock` has it; without, it is guessed. */
  stock: string;
  /** Tools by their numbers, as `--tool` has them behind the sign. */
  tools: Record<string, string>;
  /** What holds the part, each as `--fixture` has it. */
  fixtures: string[];
  /** Z of the table, as `--table` has it. */
  table: string;
  /** X, Y and Z of the part's zero in machine coordinates, mm; none where it is not stated. */
  zero: string[];
  /** Cells along the longer side of the part; 0 where the page chooses. */
  cells: number;
}

export interface Project {
  id: string;
  name: string;
  /** The name of its file. */
  file: string;
  /** Milliseconds since 1970. */
  created: number;
  changed: number;
  /** How its text is made of bytes. */
  encoding: "utf-8" | "windows-1252";
  crlf: boolean;
  choices: Choices;
  /** Files of triangles that fixtures name. */
  bodies?: Record<string, Uint8Array>;
  /** The text of its `ncc.toml`, if there is one: beside it in the folder, or once something was stated. */
  answers?: string;
  /** Where it is in the folder that the binary serves, and the tag of what was read. */
  disk?: { name: string; tag: string };
  /** Where it is on the server. */
  server?: OnServer;
}

/** A program of `ncc serve`, as far as the page has read it. */
export interface OnServer {
  program: string;
  folder: string;
  /** The revision that the text comes from. */
  revision: number;
  /** What is kept with it: empty where nothing is stated. */
  dialect: string;
  machine: string;
  author: string;
  made: string;
  /** Whether text, dialect or machine differ from that revision. */
  draft: boolean;
  /** The latest revision, where this is an older one, which is only looked at. */
  latest?: number;
}

/** Whether a project is in the browser alone. */
export function isBrowsers(project: Project): boolean {
  return !project.disk && !project.server;
}

export function noChoices(from = "auto"): Choices {
  return { from, machine: "", to: "", machineTo: "", fromOption: {}, toOption: {}, pass: [], stock: "", tools: {}, fixtures: [], table: "", zero: [], cells: 0 };
}

/** A new project of a text's bytes, and the text. */
export function projectOf(name: string, file: string, bytes: Uint8Array): [Project, string] {
  let encoding: Project["encoding"] = "utf-8";
  let text: string;
  try {
    text = new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    encoding = "windows-1252";
    text = new TextDecoder(encoding).decode(bytes);
  }
  const crlf = text.includes("\r\n");
  const now = Date.now();
  const project: Project = {
    id: crypto.randomUUID?.() ?? `${now}-${Math.random()}`,
    name,
    file,
    created: now,
    changed: now,
    encoding,
    crlf,
    choices: noChoices(),
  };
  return [project, text.replaceAll("\r\n", "\n")];
}

/** A text of a project's bytes. */
export function textOf(project: Project, bytes: Uint8Array): string {
  return new TextDecoder(project.encoding).decode(bytes).replaceAll("\r\n", "\n");
}

/** The bytes of a project's file. A character that its encoding does not have becomes a question mark. */
export function bytesOf(project: Project, text: string): Uint8Array {
  const lines = project.crlf ? text.replaceAll("\n", "\r\n") : text;
  if (project.encoding === "utf-8") return new TextEncoder().encode(lines);
  const codes = western();
  return Uint8Array.from(lines, (letter) => codes.get(letter) ?? 63);
}

let table: Map<string, number> | undefined;

/** Bytes of Windows' Western characters. */
function western(): Map<string, number> {
  const all = Uint8Array.from({ length: 256 }, (_, byte) => byte);
  table ??= new Map([...new TextDecoder("windows-1252").decode(all)].map((letter, byte) => [letter, byte]));
  return table;
}

/** Puts an option of the command line into choices: `--from-option decimal_point=calculator`. Whether it is one. */
export function choose(choices: Choices, option: string): boolean {
  const [flag, value] = option.trim().split(/\s+/, 2);
  if (!flag || !value) return false;
  const [name, chosen] = value.split("=", 2);
  switch (flag) {
    case "--from":
      choices.from = value;
      return true;
    case "--from-option":
    case "--to-option":
      if (!name || !chosen) return false;
      choices[flag === "--to-option" ? "toOption" : "fromOption"][name] = chosen;
      return true;
    case "--pass":
      if (!choices.pass.includes(value)) choices.pass.push(value);
      return true;
    default:
      return false;
  }
}
