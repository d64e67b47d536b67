// Programs of the server in the dialog of projects: found by folder and name, opened, made, moved, deleted, restored, taken in and
// given out.

import { download } from "../projects/desk";
import { BEGINNING, packedOf, type Section } from "../projects/dialog";
import { zippedFiles, type Packed } from "../projects/zip";
import { el, icon } from "../ui/dom";
import { chooseName } from "../ui/texts";
import { Refused, wordsOf } from "./api";
import type { Program, Wanted } from "./programs";
import { aboutOf, pathOf, type Server } from "./server";
import { say, tell } from "./texts";

/** A search waits so long for the next letter, ms. */
const QUIET = 250;

/** Bytes that are given out at once, at most. */
const LARGEST = 256 * 2 ** 20;

/** A folder among the options; the first option is all of them. */
const sign = (folder: string) => `=${folder}`;

export class ServerList implements Section {
  readonly element = el("section", { id: "server-section", "aria-labelledby": "server-title" });
  readonly words = { browser: tell("inBrowser"), take: tell("toServer") };
  private readonly folders = el("select", { id: "server-folder", "aria-label": tell("folder"), onchange: () => void this.fill() });
  private readonly name = el("input", { type: "search", id: "server-search", "aria-label": tell("search"), placeholder: tell("search") });
  private readonly deleted = el("button", { type: "button", id: "server-deleted", "aria-pressed": "false" }, tell("deletedOnes"));
  private readonly told = el("p", { id: "server-list-told", role: "status" });
  private readonly importing = el("div", { id: "server-import" });
  private readonly list = el("ul", { id: "server-list" });
  private readonly more = el("button", { type: "button", class: "further", hidden: true }, tell("more"));
  private turn = 0;
  private timer = 0;
  private close: () => void = () => undefined;
  private toBrowser: (files: Packed[]) => void = () => undefined;

  constructor(private readonly server: Server) {
    this.name.addEventListener("input", () => {
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => void this.fill(), QUIET);
    });
    this.deleted.addEventListener("click", () => {
      this.deleted.setAttribute("aria-pressed", String(!this.showsDeleted));
      void this.fill();
    });
    const input = el("input", { type: "file", multiple: true, hidden: true, onchange: () => void packedOf(input.files).then((taken) => this.offer(...taken)) });
    const name = el("input", { type: "text", id: "server-new", "aria-label": tell("newProgram"), placeholder: `${tell("newProgram")}: ${tell("folder").toLowerCase()}/part.nc` });
    const create = (event: Event) => {
      event.preventDefault();
      void this.tries(() => this.create(chooseName(name.value)));
    };
    this.element.append(
      el("h3", { id: "server-title" }, tell("onServer")),
      el(
        "form",
        { class: "new", onsubmit: create },
        name,
        el("button", { class: "primary", type: "submit" }, icon("plus"), say("create")),
        el("button", { type: "button", id: "server-take", onclick: () => input.click() }, tell("importTo")),
        el("button", { type: "button", id: "server-zip", onclick: () => void this.tries(() => this.zip()) }, tell("folderZip")),
      ),
      input,
      this.importing,
      el("div", { class: "find" }, this.folders, this.name, this.deleted),
      this.told,
      this.list,
      this.more,
    );
  }

  show(close: () => void, toBrowser: (files: Packed[]) => void): void {
    [this.close, this.toBrowser] = [close, toBrowser];
    this.tell("");
    this.importing.replaceChildren();
    void this.refresh();
  }

  /** Files that shall be taken in: into which folder, is asked. */
  offer(files: Packed[], wrong: string[] = []): void {
    this.tell(wrong.length > 0 ? say("noZip", { name: wrong.join(", ") }) : "", true);
    const [first] = files;
    if (!first) return;
    const chosen = this.folder ?? this.server.desk.project?.server?.folder ?? "";
    const folder = el("input", { type: "text", value: chosen, "aria-label": tell("folder"), placeholder: tell("topFolder"), list: "server-folders" });
    const message = el("input", { type: "text", "aria-label": tell("message"), placeholder: tell("message"), maxlength: 500 });
    const end = () => this.importing.replaceChildren();
    const take = (event: Event) => {
      event.preventDefault();
      end();
      void this.take(files, folder.value.trim().replace(/^\/+|\/+$/g, ""), message.value);
    };
    const browser = () => {
      end();
      this.toBrowser(files);
    };
    const known = [...this.folders.options].slice(1).map((one) => el("option", { value: one.value.slice(1) }));
    this.importing.replaceChildren(
      el(
        "form",
        { class: "new", onsubmit: take, "aria-label": tell("doImport") },
        el("b", {}, files.length > 1 ? tell("importHead", { count: files.length }) : tell("importOne", { name: first.file })),
        folder,
        el("datalist", { id: "server-folders" }, ...known),
        message,
        el("button", { class: "primary", type: "submit" }, tell("doImport")),
        el("button", { type: "button", onclick: browser }, tell("toBrowser")),
        el("button", { type: "button", onclick: end }, say("cancel")),
      ),
    );
    folder.focus();
  }

  private get showsDeleted(): boolean {
    return this.deleted.getAttribute("aria-pressed") === "true";
  }

  /** The folder that is chosen; none where all are. */
  private get folder(): string | undefined {
    return this.folders.value ? this.folders.value.slice(1) : undefined;
  }

  private get wanted(): Wanted {
    return { folder: this.folder, name: this.name.value.trim(), deleted: this.showsDeleted };
  }

  private tell(text: string, bad = false): void {
    this.told.textContent = text;
    this.told.classList.toggle("bad", bad);
  }

  private async tries(does: () => Promise<unknown>): Promise<void> {
    this.tell("");
    try {
      await does();
    } catch (error) {
      const isLate = error instanceof Refused && error.status === 412;
      this.tell(isLate ? tell("changedShort") : wordsOf(error), true);
      if (isLate) await this.refresh();
    }
  }

  /** Folders and programs as they are now. */
  private async refresh(): Promise<void> {
    const chosen = this.folders.value;
    try {
      const all = await this.server.programs.folders();
      const option = ({ folder, programs }: { folder: string; programs: number }) => el("option", { value: sign(folder) }, `${folder || tell("topFolder")} (${programs})`);
      this.folders.replaceChildren(el("option", { value: "" }, tell("allFolders")), ...all.map(option));
      this.folders.value = all.some((one) => sign(one.folder) === chosen) ? chosen : "";
    } catch (error) {
      return this.tell(wordsOf(error), true);
    }
    await this.fill();
  }

  private async fill(after?: string): Promise<void> {
    const turn = ++this.turn;
    try {
      const { programs, next } = await this.server.programs.list({ ...this.wanted, after });
      if (turn !== this.turn) return;
      const rows = this.rows(programs, after !== undefined);
      if (after === undefined) this.list.replaceChildren();
      this.list.append(...rows);
      if (this.list.childElementCount === 0) this.list.append(el("li", { class: "dim none" }, tell(this.showsDeleted ? "noneDeleted" : "none")));
      this.more.hidden = next === null;
      this.more.onclick = () => void this.fill(next ?? undefined);
    } catch (error) {
      this.tell(wordsOf(error), true);
    }
  }

  /** Rows, with the name of each folder above its own. */
  private rows(programs: Program[], goesOn: boolean): HTMLElement[] {
    let folder = goesOn ? this.list.dataset.folder : undefined;
    const rows: HTMLElement[] = [];
    for (const one of programs) {
      if (one.folder !== folder) rows.push(el("li", { class: "folder" }, icon("folder"), one.folder || tell("topFolder")));
      folder = one.folder;
      rows.push(this.row(one));
    }
    this.list.dataset.folder = folder ?? "";
    return rows;
  }

  private row(one: Program): HTMLElement {
    const isOpen = this.server.desk.project?.server?.program === one.id;
    const row = el("li", { class: isOpen ? "current" : "" });
    const about = [one.dialect, one.machine, aboutOf(one)].filter(Boolean).join(" · ");
    const open = () => void this.tries(async () => {
      await this.server.openProgram(one.id);
      this.close();
    });
    const act = (text: string, does: () => void) => el("button", { "aria-label": `${text}: ${pathOf(one.folder, one.name)}`, onclick: does }, text);
    const does = (text: string, work: () => Promise<unknown>) => act(text, () => void this.tries(work).then(() => this.refresh()));
    row.append(el("button", { class: "take", onclick: open }, el("b", {}, one.name), el("small", {}, about)));
    if (one.change === "deleted") {
      row.append(does(tell("restore"), () => this.server.programs.restore(one.id, one.revision - 1, one.revision)));
      return row;
    }
    const remove = () => {
      if (confirm(tell("removeSure", { name: one.name }))) void this.tries(() => this.server.programs.remove(one)).then(() => this.refresh());
    };
    const save = () => void this.tries(async () => download(one.name, await this.server.programs.text(one.id, one.revision)));
    row.append(act(tell("move"), () => this.move(one, row)), act(say("export"), save), act(say("remove"), remove));
    return row;
  }

  /** Asks for another path, in the row. */
  private move(one: Program, row: HTMLElement): void {
    const input = el("input", { type: "text", value: pathOf(one.folder, one.name), "aria-label": tell("move") });
    let ended = false;
    const end = (takes: boolean) => {
      if (ended) return;
      ended = true;
      const [folder, name] = split(input.value);
      const isOther = takes && name !== "" && (folder !== one.folder || name !== one.name);
      void (isOther ? this.tries(async () => this.server.moved(await this.server.programs.change(one.id, one.revision, { folder, name }))) : Promise.resolve()).then(() => this.refresh());
    };
    input.addEventListener("keydown", (event) => {
      if (event.key === "Enter") end(true);
      if (event.key !== "Escape") return;
      event.preventDefault();
      end(false);
    });
    input.addEventListener("blur", () => end(true));
    row.replaceChildren(input);
    input.focus();
    input.select();
  }

  private async create(path: string): Promise<void> {
    const [folder, given] = split(path.includes("/") ? path : pathOf(this.folder ?? "", path));
    const name = /\.\w+$/.test(given) ? given : `${given}.nc`;
    const from = this.server.desk.project?.choices.from;
    const made = await this.server.programs.create(name, folder, new TextEncoder().encode(BEGINNING), "", from === "auto" ? undefined : from);
    await this.server.openProgram(made.id);
    this.close();
  }

  /** Takes files in. A single one is open then; of several, what was refused is told. */
  private async take(files: Packed[], folder: string, message: string): Promise<void> {
    const refused: string[] = [];
    const made: Program[] = [];
    for (const { file, bytes, folder: own, choices } of files) {
      const parts = [folder, ...(own ?? "").split("/")].filter((part) => part !== "" && part !== "." && part !== "..");
      const from = choices && choices.from !== "auto" ? choices.from : undefined;
      try {
        made.push(await this.server.programs.create(file, parts.join("/"), bytes, message, from));
      } catch (error) {
        refused.push(`${pathOf(parts.join("/"), file)}: ${wordsOf(error)}`);
      }
    }
    const [only] = made;
    if (only && files.length === 1) {
      await this.server.openProgram(only.id);
      return this.close();
    }
    await this.refresh();
    this.tell([tell("imported", { count: made.length }), ...refused].join("\n"), refused.length > 0);
  }

  /** Gives out what is listed, and what would be listed further. */
  private async zip(): Promise<void> {
    this.tell(say("working"));
    const files: Record<string, Uint8Array> = {};
    let [after, bytes]: [string | undefined, number] = [undefined, 0];
    do {
      const page: { programs: Program[]; next: string | null } = await this.server.programs.list({ ...this.wanted, deleted: false, after });
      for (const one of page.programs) {
        bytes += one.bytes;
        if (bytes > LARGEST) throw new Error(tell("zipTooLarge"));
        files[pathOf(one.folder, one.name)] = await this.server.programs.text(one.id, one.revision);
      }
      after = page.next ?? undefined;
    } while (after !== undefined);
    this.tell("");
    download(`${this.folder?.replaceAll("/", "-") || "ncc"}.zip`, zippedFiles(files));
  }
}

/** The folder and the name of a path. */
function split(path: string): [string, string] {
  const parts = path.split("/").map((part) => part.trim()).filter((part) => part !== "");
  const name = parts.pop() ?? "";
  return [parts.join("/"), name];
}
