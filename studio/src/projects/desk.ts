// The open project: opened, saved while its user types, and told to other tabs.

import type { Editor } from "../editor/editor";
import type { Session } from "../session";
import { Signal } from "../ui/signal";
import { say, type TextName } from "../ui/texts";
import { EXAMPLES, type Example } from "./examples";
import { bytesOf, projectOf, type Project } from "./project";
import type { Store } from "./store";

/** So long after the last change a text is saved, ms. */
const QUIET = 600;

export class Desk {
  readonly saved = new Signal<TextName>("saved");
  private timer = 0;
  /** Tells other tabs which project was saved. */
  private readonly others = typeof BroadcastChannel === "undefined" ? undefined : new BroadcastChannel("ncc-studio");

  constructor(
    readonly store: Store,
    private readonly session: Session,
    private readonly editor: Editor,
  ) {
    if (this.others) this.others.onmessage = (event: MessageEvent<string>) => void this.savedElsewhere(event.data);
    // A tab that goes away saves what is left.
    addEventListener("visibilitychange", () => document.hidden && void this.save());
    addEventListener("pagehide", () => void this.save());
    addEventListener("beforeunload", (event) => {
      if (!this.store.keeps) event.preventDefault();
    });
  }

  get project(): Project | undefined {
    return this.session.project.get();
  }

  /** The project that was open last, or the first example. */
  async begin(): Promise<void> {
    const found = this.store.current && (await this.store.get(this.store.current));
    if (found) return this.show(...found);
    const [last] = await this.store.list();
    if (last) return this.open(last.id);
    await this.example(EXAMPLES[0] as Example);
  }

  async open(id: string): Promise<void> {
    await this.save();
    const found = await this.store.get(id);
    if (found) this.show(...found);
  }

  async create(name: string, file: string, bytes: Uint8Array, from = "auto"): Promise<void> {
    await this.save();
    const [project, text] = projectOf(await this.freeName(name), file, bytes);
    project.choices.from = from;
    await this.store.put(project, text);
    this.show(project, text);
  }

  async example(example: Example): Promise<void> {
    const name = example.file.replace(/\.\w+$/, "");
    await this.create(name, example.file, new TextEncoder().encode(example.text), example.from);
  }

  async duplicate(id: string): Promise<void> {
    await this.save();
    const found = await this.store.get(id);
    if (!found) return;
    const [project, text] = found;
    const now = Date.now();
    const name = await this.freeName(project.name);
    await this.store.put({ ...project, id: crypto.randomUUID?.() ?? `${now}`, name, created: now, changed: now }, text);
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

  /** Saves what is not saved. */
  async save(): Promise<void> {
    clearTimeout(this.timer);
    const { project } = this;
    if (!project || this.saved.get() !== "unsaved") return;
    const { text } = this.editor;
    this.saved.set("saving");
    project.changed = Date.now();
    await this.store.put(project, text);
    this.others?.postMessage(project.id);
    if (this.saved.get() === "saving") this.saved.set(this.store.keeps ? "saved" : "noStorage");
  }

  /** Choices were changed: they are part of the project. */
  async choose(change: (project: Project) => void): Promise<void> {
    if (!this.project) return;
    const project = structuredClone(this.project);
    change(project);
    this.session.project.set(project);
    this.session.change();
    await this.store.put(project);
  }

  private show(project: Project, text: string): void {
    clearTimeout(this.timer);
    this.store.current = project.id;
    this.saved.set(this.store.keeps ? "saved" : "noStorage");
    this.session.project.set(project);
    this.editor.open(text);
    this.session.reset();
  }

  /** Another tab saved this project: its text is taken over, unless there is one here that is not saved. */
  private async savedElsewhere(id: string): Promise<void> {
    if (id !== this.project?.id) return;
    if (this.saved.get() === "unsaved") return this.saved.set("otherTab");
    const found = await this.store.get(id);
    if (found && this.project?.id === id && found[1] !== this.editor.text) {
      const line = this.editor.cursor;
      this.show(...found);
      this.editor.goTo(line);
    }
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
