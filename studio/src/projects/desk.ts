// The open project: opened, saved while its user types, and told to other tabs.

import type { Editor } from "../editor/editor";
import type { Session } from "../session";
import { needless, SIDES, type SetUp, type SideName } from "../setup/stated";
import { Signal } from "../ui/signal";
import { say, type TextName } from "../ui/texts";
import { EXAMPLES, type Example } from "./examples";
import type { Folder, List } from "./folder";
import { bytesOf, isBrowsers, noChoices, projectOf, type Project } from "./project";
import type { Store } from "./store";
import { ANSWERS, type Packed } from "./zip";

/** So long after the last change a text is saved, ms. */
const QUIET = 600;

/** The largest program that another one is taken to call, and so many of them together, bytes. */
const [CALLED, TOGETHER] = [4 << 20, 64 << 20];

/** Programs of a server; the desk asks where the open one, or one that is to be opened, is there. */
export interface Remote {
  /** Opens the program of an id, if it is one of the server. */
  open(id: string, asked: number): Promise<boolean>;
  /** Saves the open one. */
  save(): Promise<void>;
  /** Other programs of its folder. */
  others(project: Project): Promise<[id: string, name: string][]>;
  /** The name, the bytes and the dialect of one of them. */
  file(id: string): Promise<[string, Uint8Array, string] | undefined>;
}

export class Desk {
  /** The server, where the page is one of `ncc serve`. */
  remote: Remote | undefined;
  /** The programs of the folder that the binary serves. */
  list: List | undefined;
  readonly saved = new Signal<TextName>("saved");
  /** Whether what was stated of the set-up stands in the project file, in words. */
  readonly setUpTold = new Signal("");
  private timer = 0;
  /** What is written into the project file, one after the other: each writes over what the one before has written. */
  private writing: Promise<unknown> = Promise.resolve();
  /** How often the user has asked for a program: what was asked for before, or by nobody, gives way. */
  private asked = 0;
  /** Tells other tabs which project was saved. */
  private readonly others = typeof BroadcastChannel === "undefined" ? undefined : new BroadcastChannel("ncc-studio");

  constructor(
    readonly store: Store,
    private readonly session: Session,
    private readonly editor: Editor,
    private readonly folder?: Folder,
  ) {
    if (this.others) this.others.onmessage = (event: MessageEvent<string>) => void this.savedElsewhere(event.data);
    // A tab that goes away saves what is left.
    addEventListener("visibilitychange", () => document.hidden && void this.save());
    addEventListener("pagehide", () => void this.save());
    session.beside = async (name) => (this.project?.disk ? (await this.folder?.read(name))?.[0] : this.project?.bodies?.[name]);
    session.stated.on(() => this.dropNeedless());
    addEventListener("beforeunload", (event) => {
      if (!this.store.keeps) event.preventDefault();
    });
  }

  get project(): Project | undefined {
    return this.session.project.get();
  }

  /** Tells the open project now, and each that follows. */
  onProject(tell: (project: Project | undefined) => void): void {
    this.session.project.on(tell);
  }

  /** The project that was open last, or the first program of the folder, or the first example. */
  async begin(): Promise<void> {
    const { asked } = this;
    if (this.folder && !this.list) {
      this.list = await this.folder.list();
      void this.folder.watch(this.list.stamp, (list) => {
        this.list = list;
        void this.changedOnDisk();
      });
      const names = this.list.programs.map((one) => one.name);
      const last = this.store.current && (await this.store.get(this.store.current))?.[0].disk?.name;
      const name = names.find((one) => one === last) ?? names[0];
      if (name) return this.openProgram(name, asked);
    }
    if (this.store.current && (await this.remote?.open(this.store.current, asked))) return;
    const kept = this.store.current ? await this.store.get(this.store.current) : undefined;
    // What is not opened from its server is not there, or is another user's.
    const current = kept?.[0].server ? undefined : kept;
    const [last] = current ? [] : (await this.store.list()).filter(isBrowsers);
    const found = current || (last && (await this.store.get(last.id)));
    if (found) return this.show(...found, asked);
    if (asked === this.asked) await this.example(EXAMPLES[0] as Example, asked);
  }

  /** Other programs, by ids and names: of the folder that is served, or the other projects. */
  async otherPrograms(): Promise<[id: string, name: string][]> {
    const own = this.project;
    if (own?.server && this.remote) return this.remote.others(own);
    if (own?.disk && this.list) {
      const names = this.list.programs.map((one) => one.name).filter((name) => name !== own.disk?.name);
      return names.map((name) => [`disk/${name}`, name]);
    }
    return (await this.store.list()).filter((one) => one.id !== own?.id && isBrowsers(one)).map((one) => [one.id, one.name]);
  }

  /** The name, the bytes and the dialect of one of them. */
  async otherFile(id: string): Promise<[string, Uint8Array, string] | undefined> {
    if (this.project?.server && this.remote) return this.remote.file(id);
    const name = id.startsWith("disk/") && this.project?.disk ? id.slice(5) : undefined;
    if (name !== undefined) {
      const read = await this.folder?.read(name);
      return read && [name, read[0], "auto"];
    }
    const found = await this.store.get(id);
    return found && [found[0].file, bytesOf(...found), found[0].choices.from];
  }

  /** Other programs with their bytes, as far as they are no large ones, and not too many: of several of one name the first. */
  async neighbours(): Promise<[id: string, name: string, bytes: Uint8Array][]> {
    // The server puts the bytes into the engine itself.
    if (this.project?.server) return (await this.otherPrograms()).map(([id, name]) => [id, name, new Uint8Array()]);
    const bytes = new Map(this.list?.programs.map((one) => [one.name, one.bytes]));
    const found: [string, string, Uint8Array][] = [];
    const taken = new Set([this.project?.file]);
    let left = TOGETHER;
    for (const [id, name] of await this.otherPrograms()) {
      const file = (bytes.get(name) ?? 0) > Math.min(CALLED, left) ? undefined : await this.otherFile(id);
      if (!file || taken.has(file[0]) || file[1].length > Math.min(CALLED, left)) continue;
      taken.add(file[0]);
      left -= file[1].length;
      found.push([id, file[0], file[1]]);
    }
    return found;
  }

  async openNeighbour(id: string): Promise<void> {
    if (this.project?.server && (await this.remote?.open(id, this.newlyAsked()))) return;
    return this.project?.disk && id.startsWith("disk/") ? this.openProgram(id.slice(5)) : this.open(id);
  }

  /** The user asks for a program: what was asked for before gives way to it. */
  newlyAsked(): number {
    return ++this.asked;
  }

  async open(id: string): Promise<void> {
    const asked = ++this.asked;
    await this.save();
    const found = await this.store.get(id);
    if (found) this.show(...found, asked);
  }

  /** Opens a program of the folder. What was chosen for it is kept; its text is the file's. */
  async openProgram(name: string, asked = ++this.asked): Promise<void> {
    await this.save();
    const read = await this.folder?.read(name);
    if (!read) return;
    const [bytes, tag] = read;
    const [made, text] = projectOf(name, name, bytes);
    const id = `disk/${this.list?.folder ?? ""}/${name}`;
    const choices = (await this.store.get(id))?.[0].choices ?? made.choices;
    const answers = await this.answersOnDisk();
    const project: Project = { ...made, id, choices, disk: { name, tag }, ...(answers !== undefined && { answers }) };
    await this.store.put(project, text);
    this.show(project, text, asked);
  }

  async create(name: string, file: string, bytes: Uint8Array, from = "auto", asked = ++this.asked): Promise<void> {
    await this.save();
    const [project, text] = projectOf(await this.freeName(name), file, bytes);
    project.choices.from = from;
    await this.store.put(project, text);
    this.show(project, text, asked);
  }

  async example(example: Example, asked = ++this.asked): Promise<void> {
    const name = example.file.replace(/\.\w+$/, "");
    await this.create(name, example.file, new TextEncoder().encode(example.text), example.from, asked);
  }

  async duplicate(id: string): Promise<void> {
    await this.save();
    const found = await this.store.get(id);
    if (!found) return;
    const [project, text] = found;
    const now = Date.now();
    const name = await this.freeName(project.name);
    const { disk: _, server: __, ...free } = project;
    await this.store.put({ ...free, id: crypto.randomUUID?.() ?? `${now}`, name, created: now, changed: now }, text);
  }

  async rename(id: string, name: string): Promise<void> {
    const own = this.project?.id === id ? this.project : (await this.store.get(id))?.[0];
    if (!own || !name.trim()) return;
    const renamed = { ...own, name: name.trim() };
    await this.store.put(renamed);
    if (this.project?.id === id) this.session.project.set(renamed);
  }

  async remove(id: string): Promise<void> {
    const open = this.project?.id === id;
    if (open) clearTimeout(this.timer);
    await this.store.remove(id);
    if (!open) return;
    this.session.project.set(undefined);
    await this.begin();
  }

  /** The bytes of a project's file, under its name. */
  async file(id: string): Promise<[string, Uint8Array] | undefined> {
    if (this.project?.id === id) return [this.project.file, bytesOf(this.project, this.editor.text)];
    const found = await this.store.get(id);
    return found && [found[0].file, bytesOf(...found)];
  }

  /** The text was changed: it is saved soon. */
  changed(): void {
    this.saved.set("unsaved");
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.save(), QUIET);
  }

  /** Saves for good what its user wants saved: on a server that is a revision. */
  saveNow(): Promise<void> {
    return this.project?.server && this.remote ? this.remote.save() : this.save();
  }

  /** Saves what is not saved; of a program of a server a draft, in the browser. */
  async save(): Promise<void> {
    clearTimeout(this.timer);
    const { project } = this;
    if (!project || this.saved.get() !== "unsaved") return;
    const { text } = this.editor;
    if (project.server) {
      project.server.draft = true;
      project.changed = Date.now();
      return this.store.put(project, text);
    }
    this.saved.set("saving");
    project.changed = Date.now();
    if (project.disk && this.folder) {
      const { name, tag } = project.disk;
      const now = await this.folder.write(name, bytesOf(project, text), tag).catch(() => undefined);
      // What somebody else wrote stays; here nothing is lost.
      if (now === undefined) this.saved.set("otherDisk");
      else {
        project.disk.tag = now;
        // Choices that were changed meanwhile made another object of it.
        if (this.project?.id === project.id && this.project.disk) this.project.disk.tag = now;
      }
    }
    await this.store.put(project, text);
    this.tellOthers(project.id);
    if (this.saved.get() === "saving") this.saved.set(this.store.keeps ? "saved" : "noStorage");
  }

  /** Choices were changed: they are part of the project. */
  async choose(change: (project: Project) => void, works = true): Promise<void> {
    if (!this.project) return;
    const before = this.project.choices;
    const project = structuredClone(this.project);
    change(project);
    this.session.project.set(project);
    if (works) this.session.change();
    if (project.server) {
      // Dialect and machine are kept on the server, when its user saves.
      if (project.server.latest) return;
      if (before.from !== project.choices.from || before.machine !== project.choices.machine) this.changed();
    }
    await this.store.put(project);
  }

  /** What the program's `ncc.toml` states needs no choice. */
  private dropNeedless(): void {
    const choices = this.project?.choices;
    const drop = choices && SIDES.map((side) => [side, needless(side, choices, this.session.stated.get())] as const);
    if (!drop?.some(([, names]) => names.length > 0)) return;
    void this.choose(({ choices: own }) => drop.forEach(([side, names]) => names.forEach((name) => delete own[side][name])), false);
  }

  /** States parts of the set-up: they are choices until they stand in the program's `ncc.toml`. */
  async state(set: Partial<SetUp>, tools: Record<string, string> = {}): Promise<void> {
    const id = this.project?.id;
    await this.choose(({ choices }) => {
      Object.assign(choices, set);
      for (const [number, text] of Object.entries(tools)) {
        if (text) choices.tools[number] = text;
        else delete choices.tools[number];
      }
    });
    const told = await this.inTurn(id, () => this.keepSetUp(set, tools));
    if (id === this.project?.id) this.setUpTold.set(told);
  }

  /** Writes for a project, if it is open still when its turn comes; tells what came of it. */
  private inTurn(id: string | undefined, write: () => Promise<string>): Promise<string> {
    const told = this.writing.then(() => (id === this.project?.id ? write() : "")).catch(() => say("answersNotKept"));
    this.writing = told;
    return told;
  }

  private async keepSetUp(set: Partial<SetUp>, tools: Record<string, string>): Promise<string> {
    const project = this.project;
    if (project?.server) return say("answersHere");
    const texts = Object.entries(tools).map(([number, text]) => `${number}=${text}`);
    const empty = [...Object.values(set), ...Object.values(tools)].every((own) => own.length === 0);
    if (!project || (empty && !this.session.stated.get())) return this.setUpTold.get();
    const told = await this.write({ ...set, ...(texts.length > 0 && { tools: texts }) });
    if (told || project.id !== this.project?.id) return told;
    // What the file states needs no choice any more, unless it is another one by now.
    await this.choose(({ choices }) => {
      const none = noChoices();
      for (const key of Object.keys(set) as (keyof SetUp)[]) {
        if (String(choices[key]) === String(set[key])) Object.assign(choices, { [key]: none[key] });
      }
      for (const [number, text] of Object.entries(tools)) if (choices.tools[number] === text) delete choices.tools[number];
    });
    return say("answersKept");
  }

  private async answersOnDisk(): Promise<string | undefined> {
    const read = this.list?.answers ? await this.folder?.read(ANSWERS) : undefined;
    return read && new TextDecoder().decode(read[0]);
  }

  /** Writes what was chosen into the program's `ncc.toml`, so that the command line does the same, `without` an option that is
   * taken back; tells what kept it. */
  keepAnswers(without?: readonly [SideName, string]): Promise<string> {
    return this.inTurn(this.project?.id, async () => {
      const told = await this.write(undefined, without);
      // What was taken back held until here.
      if (!told) this.session.change();
      return told;
    });
  }

  /** Writes what was chosen, or parts of the set-up alone, and reads it again; tells what kept it. */
  private async write(set?: Partial<SetUp> & { tools?: string[] }, without?: readonly [SideName, string]): Promise<string> {
    const { project } = this;
    // A server keeps no project file: what was chosen goes with each translation.
    if (!project || project.server) return "";
    if (project.disk && this.folder) this.list = await this.folder.list();
    const disk = this.list?.answers ? await this.folder?.read(ANSWERS) : undefined;
    const there = project.disk ? disk && new TextDecoder().decode(disk[0]) : project.answers;
    const answer = await this.session.answers(there, set, without);
    const written = answer?.bytes("output");
    if (!written) return answer?.text("messages").trim() || say("answersNotKept");
    if (project.disk && this.folder) {
      // What somebody else wrote meanwhile stays.
      const tag = await this.folder.write(ANSWERS, written, disk?.[1]).catch(() => undefined);
      if (tag === undefined) return say("answersNotKept");
    }
    if (this.project?.id !== project.id) return "";
    await this.choose((own) => (own.answers = new TextDecoder().decode(written)), false);
    if (this.project?.id !== project.id) return "";
    await this.session.readStated(this.project);
    this.dropNeedless();
    return "";
  }

  /** Projects as they go into a zip: one, or all of the browser's. */
  async packed(id?: string): Promise<Packed[]> {
    await this.save();
    const ids = id === undefined ? (await this.store.list()).filter(isBrowsers).map((one) => one.id) : [id];
    const found: Packed[] = [];
    for (const own of ids) {
      const [project] = (await this.store.get(own)) ?? [];
      const file = project && (await this.file(own));
      if (!project || !file) continue;
      const { name, choices, answers } = this.project?.id === own ? this.project : project;
      found.push({ name, file: file[0], bytes: file[1], choices, ...(answers !== undefined && { answers }) });
    }
    return found;
  }

  /** Projects of a zip; the last one is open. */
  async unpack(packed: Packed[]): Promise<void> {
    const asked = ++this.asked;
    for (const { name, file, bytes, answers, choices } of packed) {
      await this.save();
      const [made, text] = projectOf(await this.freeName(name), file, bytes);
      const project: Project = { ...made, ...(choices && { choices }), ...(answers !== undefined && { answers }) };
      await this.store.put(project, text);
      this.show(project, text, asked);
    }
  }

  /** A program was saved: other tabs take it over. */
  tellOthers(id: string): void {
    this.others?.postMessage(id);
  }

  /** Shows a program, unless the user has asked for another meanwhile. */
  show(project: Project, text: string, asked: number): void {
    if (asked !== this.asked) return;
    clearTimeout(this.timer);
    this.store.current = project.id;
    this.saved.set(project.server ? (project.server.draft ? "unsaved" : "saved") : this.store.keeps ? "saved" : "noStorage");
    this.setUpTold.set("");
    // A project of an older page may lack choices of this one.
    this.session.project.set({ ...project, choices: { ...noChoices(), ...project.choices } });
    this.editor.open(text, project.server?.latest !== undefined);
    this.session.reset();
  }

  /** Another tab saved this project: its text is taken over, unless there is one here that is not saved. */
  private async savedElsewhere(id: string): Promise<void> {
    // An older revision is only looked at.
    if (id !== this.project?.id || this.project.server?.latest) return;
    if (this.saved.get() === "unsaved") return this.saved.set("otherTab");
    const { asked } = this;
    const found = await this.store.get(id);
    if (found && this.project?.id === id && found[1] !== this.editor.text) {
      const line = this.editor.cursor;
      this.show(...found, asked);
      this.editor.goTo(line);
    }
  }

  /** A program of the folder was changed by somebody: it is taken over, unless there is a text here that is not saved. */
  private async changedOnDisk(): Promise<void> {
    const disk = this.project?.disk;
    const { asked } = this;
    const answers = disk && (await this.answersOnDisk());
    if (disk && this.project?.disk?.name === disk.name && answers !== this.project.answers) {
      await this.choose((own) => {
        delete own.answers;
        if (answers !== undefined) own.answers = answers;
      });
    }
    void this.session.lookBeside().catch(() => undefined);
    const read = disk && (await this.folder?.read(disk.name));
    const known = this.project?.disk;
    if (!read || !disk || known?.name !== disk.name || read[1] === known.tag) return;
    if (this.saved.get() !== "saved") return this.saved.set("otherDisk");
    const line = this.editor.cursor;
    await this.openProgram(disk.name, asked);
    if (asked === this.asked) this.editor.goTo(line);
  }

  private async freeName(name: string): Promise<string> {
    const taken = new Set((await this.store.list()).map((one) => one.name));
    const wanted = name.trim() || say("untitled");
    if (!taken.has(wanted)) return wanted;
    let number = 2;
    while (taken.has(`${wanted} (${number})`)) number += 1;
    return `${wanted} (${number})`;
  }
}

/** Gives the user a file. */
export function download(name: string, bytes: Uint8Array): void {
  const url = URL.createObjectURL(new Blob([bytes.slice()], { type: "application/octet-stream" }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
