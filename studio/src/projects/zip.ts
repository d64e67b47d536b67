// Projects as a zip, a folder each:
//
//     Flange/part.nc        the program, in its own bytes
//     Flange/ncc.toml       answers, as the command line reads them
//     Flange/studio.json    the project's name, and what was chosen
//
// A zip without `studio.json` is one of programs. Names are others' words: of a path only the folders that it names count, and
// nothing is ever written to a disk.

import { strToU8, unzipSync, zipSync } from "fflate";
import { noChoices, type Choices } from "./project";

export const ANSWERS = "ncc.toml";
const ABOUT = "studio.json";
/** The largest zip is this much when it is unpacked, bytes, and has so many files. */
const [LARGEST, MOST] = [256 * 2 ** 20, 5000];

/** A project in a zip. */
export interface Packed {
  /** Folders of a zip without `studio.json`, with `/` between them. */
  folder?: string;
  name: string;
  file: string;
  bytes: Uint8Array;
  /** The text of its `ncc.toml`, if it has one. */
  answers?: string;
  choices?: Choices;
}

/** Too large, or no zip. */
export class NoZip extends Error {}

export function isZip(bytes: Uint8Array): boolean {
  return bytes[0] === 0x50 && bytes[1] === 0x4b && (bytes[2] === 3 || bytes[2] === 5);
}

/** A name that is one part of a path. */
function part(name: string): string {
  return name.replace(/[/\\:\0]/g, "_").replace(/^\.+/, "_") || "_";
}

export function zipped(projects: Packed[]): Uint8Array {
  const files: Record<string, Uint8Array> = {};
  const taken = new Set<string>();
  for (const { name, file, bytes, answers, choices } of projects) {
    let folder = part(name);
    for (let number = 2; taken.has(folder.toLowerCase()); number += 1) folder = `${part(name)} (${number})`;
    taken.add(folder.toLowerCase());
    files[`${folder}/${part(file)}`] = bytes;
    if (answers !== undefined) files[`${folder}/${ANSWERS}`] = strToU8(answers);
    files[`${folder}/${ABOUT}`] = strToU8(`${JSON.stringify({ name, file: part(file), choices }, null, 2)}\n`);
  }
  return zipSync(files);
}

/** Files by their paths. What no path can have becomes another sign. */
export function zippedFiles(files: Record<string, Uint8Array>): Uint8Array {
  return zipSync(Object.fromEntries(Object.entries(files).map(([path, bytes]) => [path.split("/").map(part).join("/"), bytes])));
}

export function unzipped(bytes: Uint8Array): Packed[] {
  let [size, count] = [0, 0];
  let files: Record<string, Uint8Array>;
  try {
    files = unzipSync(bytes, {
      filter: ({ name, originalSize }) => {
        size += originalSize;
        count += 1;
        if (size > LARGEST || count > MOST) throw new NoZip("size");
        return !name.endsWith("/");
      },
    });
  } catch (error) {
    throw new NoZip(String(error));
  }
  const folders = new Map<string, Map<string, Uint8Array>>();
  for (const [path, own] of Object.entries(files)) {
    const parts = path.split(/[/\\]/);
    const name = parts.pop() ?? "";
    // What a Mac adds is nobody's program.
    if (!name || name.startsWith(".") || parts[0] === "__MACOSX") continue;
    const folder = parts.join("/");
    folders.set(folder, (folders.get(folder) ?? new Map()).set(name, own));
  }
  return [...folders].flatMap(([folder, own]) => projectsOf(own).map((one) => ({ ...one, folder })));
}

function projectsOf(files: Map<string, Uint8Array>): Packed[] {
  const text = (name: string) => {
    const bytes = files.get(name);
    return bytes && new TextDecoder().decode(bytes);
  };
  const answers = text(ANSWERS);
  const about = aboutOf(text(ABOUT));
  const programs = [...files].filter(([name]) => name !== ANSWERS && name !== ABOUT);
  return programs.map(([file, bytes]) => {
    const own = about && (about.file === file || programs.length === 1) ? about : undefined;
    const name = own?.name || file.replace(/\.\w+$/, "");
    return { name, file, bytes, ...(answers !== undefined && { answers }), ...(own?.choices && { choices: own.choices }) };
  });
}

/** What `studio.json` says, as far as it has the form: anybody may have written it. */
function aboutOf(text: string | undefined): { name: string; file: string; choices: Choices } | undefined {
  let read: unknown;
  try {
    read = JSON.parse(text ?? "");
  } catch {
    return undefined;
  }
  if (typeof read !== "object" || read === null) return undefined;
  const { name, file, choices } = read as Record<string, unknown>;
  const own = noChoices() as unknown as Record<string, unknown>;
  const given = typeof choices === "object" && choices !== null ? (choices as Record<string, unknown>) : {};
  for (const key of Object.keys(own)) if (isAlike(own[key], given[key])) own[key] = given[key];
  const words = (value: unknown) => (typeof value === "string" ? value : "");
  return { name: words(name), file: words(file), choices: own as unknown as Choices };
}

/** Whether a value has the form of another: a text, a list of texts, or texts by names. */
function isAlike(form: unknown, value: unknown): boolean {
  const isText = (one: unknown) => typeof one === "string";
  if (isText(form)) return isText(value);
  if (Array.isArray(form)) return Array.isArray(value) && value.every(isText);
  return typeof value === "object" && value !== null && !Array.isArray(value) && Object.values(value).every(isText);
}
