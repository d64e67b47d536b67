// The dialog of projects: a new one, those that there are, and the examples.

import { byId, el, icon } from "../ui/dom";
import { chooseName, say, type Language } from "../ui/texts";
import { download, type Desk } from "./desk";
import { EXAMPLES } from "./examples";
import { isBrowsers, type Project } from "./project";
import { NoZip, isZip, unzipped, zipped, type Packed } from "./zip";

/** What a new program begins with, in every word-address dialect. */
export const BEGINNING = "%\nO0001\nG21 G17 G90 G94 G40 G49 G80\n\nM30\n%\n";

/** Programs of a server in the dialog. */
export interface Section {
  readonly element: HTMLElement;
  /** The heading of what the browser keeps, and the action that takes a project of it. */
  readonly words: { browser: string; take: string };
  /** The dialog opens. */
  show(close: () => void, toBrowser: (files: Packed[]) => void): void;
  /** Files that shall be taken in; and the names of what is no zip of programs. */
  offer(files: Packed[], wrong?: string[]): void;
}

export class ProjectsDialog {
  private readonly dialog = byId<HTMLDialogElement>("projects-dialog");

  constructor(
    private readonly desk: Desk,
    private readonly language: Language,
    private readonly section?: Section,
  ) {
    this.dialog.addEventListener("click", (event) => {
      if (event.target === this.dialog) this.dialog.close();
    });
  }

  async open(): Promise<void> {
    // What was listed before is not what there is; a file that is taken there would be told in a list that goes.
    if (!this.dialog.open) {
      this.dialog.replaceChildren();
      this.section?.show(() => this.dialog.close(), (files) => void this.desk.unpack(files).then(() => this.dialog.close()));
    }
    await this.fill();
    if (!this.dialog.open) this.dialog.showModal();
  }

  /** Opens the dialog with files that were dropped, where a server may take them in. */
  async drop(files: FileList | null): Promise<void> {
    if (!this.section) return void (await takeFiles(this.desk, files));
    const taken = await packedOf(files);
    if (!this.dialog.open) await this.open();
    this.section.offer(...taken);
  }

  private async fill(): Promise<void> {
    const projects = await this.desk.store.list();
    const input = el("input", { type: "file", multiple: true, hidden: true, onchange: () => void this.take(input.files) });
    const own = el("ul", { id: "projects-list" }, ...projects.filter(isBrowsers).map((project) => this.row(project)));
    const examples = EXAMPLES.map((example) => {
      const take = () => void this.desk.example(example).then(() => this.dialog.close());
      const [sentence] = [example.sentence[this.language === "pt" ? 1 : 0]];
      return el("li", {}, el("button", { class: "take", onclick: take }, el("b", {}, example.file), el("small", {}, sentence)));
    });
    const close = el("button", { "aria-label": say("close"), onclick: () => this.dialog.close() }, icon("close"));
    this.dialog.replaceChildren(
      el("header", {}, el("h2", { id: "projects-title" }, say("projects")), close),
      ...(this.section ? [this.section.element, el("h3", {}, this.section.words.browser)] : []),
      this.newForm(el("button", { type: "button", onclick: () => input.click() }, say("import"))),
      input,
      ...this.onDisk(),
      own,
      el("h3", {}, say("examples")),
      el("ul", { id: "examples" }, ...examples),
    );
  }

  /** Programs of the folder that the binary serves. */
  private onDisk(): HTMLElement[] {
    const { list } = this.desk;
    if (!list) return [];
    const rows = list.programs.map(({ name }) => {
      const take = () => void this.desk.openProgram(name).then(() => this.dialog.close());
      const current = this.desk.project?.disk?.name === name;
      return el("li", { class: current ? "current" : "" }, el("button", { class: "take", onclick: take }, el("b", {}, name)));
    });
    const empty = rows.length === 0 ? [el("li", { class: "dim" }, say("folderEmpty"))] : [];
    return [el("h3", {}, list.folder), el("ul", { id: "folder-list" }, ...rows, ...empty), el("h3", {}, say("projects"))];
  }

  private newForm(importing: HTMLElement): HTMLElement {
    const name = el("input", { type: "text", "aria-label": say("name"), placeholder: say("newProject") });
    const create = async (event: Event) => {
      event.preventDefault();
      const wanted = chooseName(name.value);
      const file = /\.\w+$/.test(wanted) ? wanted : `${wanted}.nc`;
      await this.desk.create(wanted, file, new TextEncoder().encode(BEGINNING), this.desk.project?.choices.from);
      this.dialog.close();
    };
    const form = el("form", { class: "new", onsubmit: (event) => void create(event) }, name);
    const all = el("button", { type: "button", id: "export-all", onclick: () => void this.zip(undefined, "ncc-studio") }, say("exportAll"));
    form.append(el("button", { class: "primary", type: "submit" }, icon("plus"), say("create")), importing, all);
    return form;
  }

  private row(project: Project): HTMLElement {
    const { id, name, changed } = project;
    const when = new Date(changed).toLocaleString(document.documentElement.lang, { dateStyle: "medium", timeStyle: "short" });
    const open = () => void this.desk.open(id).then(() => this.dialog.close());
    const again = (done: Promise<unknown>) => void done.then(() => this.fill());
    const row = el("li", { class: this.desk.project?.id === id ? "current" : "" });
    const rename = () => {
      const input = el("input", { type: "text", value: name, "aria-label": say("rename1") });
      const done = () => again(this.desk.rename(id, input.value));
      input.addEventListener("keydown", (event) => {
        if (event.key === "Enter") input.blur();
        if (event.key !== "Escape") return;
        event.preventDefault();
        input.value = name;
        input.blur();
      });
      input.addEventListener("blur", done, { once: true });
      row.replaceChildren(input);
      input.select();
    };
    const remove = () => {
      if (confirm(say("removeSure", { name }))) again(this.desk.remove(id));
    };
    const save = () => void this.desk.file(id).then((file) => file && download(...file));
    const act = (text: string, does: () => void) =>
      el("button", { "aria-label": `${text}: ${name}`, onclick: does }, text);
    row.append(
      el("button", { class: "take", onclick: open }, el("b", {}, name), el("small", {}, `${project.file} · ${when}`)),
      act(say("rename"), rename),
      act(say("duplicate"), () => again(this.desk.duplicate(id))),
      act(say("export"), save),
      act(say("exportZip"), () => void this.zip(id, name)),
      ...(this.section ? [act(this.section.words.take, () => void this.desk.packed(id).then((files) => this.section?.offer(files)))] : []),
      act(say("remove"), remove),
    );
    return row;
  }

  private async zip(id: string | undefined, name: string): Promise<void> {
    download(`${name}.zip`, zipped(await this.desk.packed(id)));
  }

  private async take(files: FileList | null): Promise<void> {
    const wrong = await takeFiles(this.desk, files);
    if (wrong.length === 0) return this.dialog.close();
    this.dialog.append(el("p", { class: "wrong", role: "alert" }, say("noZip", { name: wrong.join(", ") })));
  }
}

/** Files as they are taken in, of a zip those that it has; and the names of what is no zip of programs. */
export async function packedOf(files: FileList | null): Promise<[Packed[], wrong: string[]]> {
  const [found, wrong]: [Packed[], string[]] = [[], []];
  for (const file of files ?? []) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    try {
      const own = isZip(bytes) ? unzipped(bytes) : [{ name: file.name.replace(/\.\w+$/, ""), file: file.name, bytes }];
      if (own.length === 0) wrong.push(file.name);
      found.push(...own);
    } catch (error) {
      if (!(error instanceof NoZip)) throw error;
      wrong.push(file.name);
    }
  }
  return [found, wrong];
}

/** Files become projects, a zip those that it has; the last one is open. Gives the names of what is no zip of programs. */
async function takeFiles(desk: Desk, files: FileList | null): Promise<string[]> {
  const wrong: string[] = [];
  for (const file of files ?? []) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (!isZip(bytes)) {
      await desk.create(file.name.replace(/\.\w+$/, ""), file.name, bytes);
      continue;
    }
    try {
      const packed = unzipped(bytes);
      if (packed.length === 0) wrong.push(file.name);
      await desk.unpack(packed);
    } catch (error) {
      if (!(error instanceof NoZip)) throw error;
      wrong.push(file.name);
    }
  }
  return wrong;
}

/** Files that are dropped on the page. */
export function wireDrop(takes: (files: FileList | null) => void): void {
  const shade = byId("drop");
  let inside = 0;
  const files = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  addEventListener("dragenter", (event) => {
    if (!files(event)) return;
    inside += 1;
    shade.hidden = false;
  });
  addEventListener("dragleave", (event) => {
    if (files(event) && --inside <= 0) shade.hidden = true;
  });
  addEventListener("dragover", (event) => files(event) && event.preventDefault());
  addEventListener("drop", (event) => {
    if (!files(event)) return;
    event.preventDefault();
    inside = 0;
    shade.hidden = true;
    takes(event.dataTransfer?.files ?? null);
  }, { capture: true });
}
