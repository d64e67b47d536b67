// Commands of the editor that the compiler answers: to a name's meaning, another name, layout, new block numbers. Places and
// texts come from the compiler (the verbs `names`, `rename`, `layout`); what it refuses is told in its words.

import type { Answer } from "../engine/engine";
import { textOf } from "../projects/project";
import type { Session } from "../session";
import { byId, el } from "../ui/dom";
import { say, type TextName } from "../ui/texts";
import type { Editor } from "./editor";

/** Of the verb `names`: five numbers a place (name, line, first column, the one behind, whether it is defined there). */
interface Names {
  /** `shared`: programs in other files may use it. */
  names: { sort: string; text: string; shared: boolean }[];
  places: number[];
}

interface Place {
  name: number;
  line: number;
  from: number;
  to: number;
  defines: boolean;
}

/** Where the programs are that the open one may call. */
export interface Neighbours {
  /** Their files by ids: name and bytes. */
  neighbours(): Promise<[id: string, name: string, bytes: Uint8Array][]>;
  openNeighbour(id: string): Promise<void>;
}

interface Field {
  name: TextName;
  value: string;
  number?: boolean;
}

function placesOf({ places }: Names): Place[] {
  const found: Place[] = [];
  for (let at = 0; at + 4 < places.length; at += 5) {
    const [name = 0, line = 0, from = 0, to = 0, defines = 0] = places.slice(at, at + 5);
    found.push({ name, line, from, to, defines: defines === 1 });
  }
  return found;
}

/** A word may be the name of a program in another file, as `L100` is one: which are, the compiler knows only with that file. */
const WORD = /[A-Z_]{2}|\bL\d/i;

export class Editing {
  private readonly told = byId("editor-told");
  private readonly dialog = byId<HTMLDialogElement>("editor-dialog");
  private ended = true;

  constructor(
    private readonly session: Session,
    private readonly editor: Editor,
    private readonly around: Neighbours,
  ) {
    const commands: [string, () => Promise<void>][] = [
      ["go-to", () => this.goTo()],
      ["rename-name", () => this.rename()],
      ["lay-out", () => this.layOut()],
      ["renumber", () => this.renumber()],
    ];
    for (const [id, does] of commands) byId(id).addEventListener("click", () => void does());
  }

  /** To where the name at the cursor gets its meaning, in another program too; from there to where it is used next. */
  async goTo(): Promise<void> {
    const found = await this.nameHere();
    const calls = this.mayCall && (!found || (found.sort === "program" && !found.places.some((place) => place.defines)));
    if (calls && (await this.goToCalled())) return;
    if (!found) return;
    const { here, places } = found;
    const defined = places.filter((place) => place.defines);
    // A variable has the value that it was given last.
    const before = (place: Place) => place.line < here.line || (place.line === here.line && place.from < here.from);
    const target = here.defines
      ? (places.find((place) => !place.defines && !before(place) && place !== here) ?? places.find((place) => place !== here))
      : (defined.filter(before).at(-1) ?? defined[0]);
    if (!target) return this.tell(say(here.defines ? "usedNowhere" : "definedNowhere"));
    this.tell("");
    this.editor.goTo(target.line, target.from + 1);
    this.editor.focus();
  }

  /** To the program of another file that the line at the cursor calls; whether there is one. */
  private async goToCalled(): Promise<boolean> {
    const { line, column } = this.editor.place;
    const told = this.told.textContent ?? "";
    const files = await this.around.neighbours();
    const answer = files.length > 0 ? await this.session.askAmong(files, "called", { line, column }) : undefined;
    const refused = answer && answer.code !== 0 ? answer.text("messages").trim() : "";
    const place = refused ? undefined : answer?.json<{ file: string; line: number }>("document");
    const id = files.find(([, name]) => name === place?.file)?.[0];
    if (!place || !id) {
      this.tell(refused || told);
      return refused !== "";
    }
    await this.around.openNeighbour(id);
    this.tell("");
    this.editor.goTo(place.line);
    this.editor.focus();
    return true;
  }

  /** Another name for the one at the cursor. */
  async rename(): Promise<void> {
    const found = await this.nameHere();
    if (!found) return;
    const { here, text, shared, places } = found;
    this.tell("");
    const head = say("renameOf", { name: text, count: places.length }) + (shared ? ` ${say("renameShared")}` : "");
    this.ask(head, [{ name: "rename1", value: text }], async ([to = ""]) => {
      const answer = await this.session.ask("rename", { line: here.line, column: here.from, to });
      return this.take(answer);
    });
  }

  async layOut(): Promise<void> {
    this.tell(say("working"));
    this.tell(this.take(await this.session.ask("layout", {})) || this.changed());
    this.editor.focus();
  }

  async renumber(): Promise<void> {
    const fields: Field[] = [
      { name: "firstNumber", value: "10", number: true },
      { name: "numberStep", value: "10", number: true },
    ];
    this.ask(say("renumber"), fields, async (values) => this.take(await this.session.ask("layout", { number: values.map(Number) })));
  }

  private lines = 0;
  /** Whether the line at the cursor may call a program: other programs are read for no other line. */
  private mayCall = false;

  private changed(): string {
    return this.lines === 0 ? say("nothingToChange") : say("linesChanged", { count: this.lines });
  }

  /** Takes a text over, as one step that can be undone; gives why there is none. */
  private take(answer: Answer | undefined): string {
    const [bytes, project] = [answer?.bytes("output"), this.session.project.get()];
    if (!bytes || !project) return (answer?.text("messages") ?? "").trim() || say("failed");
    this.lines = this.editor.replace(textOf(project, bytes));
    return "";
  }

  private async nameHere(): Promise<{ here: Place; sort: string; text: string; shared: boolean; places: Place[] } | undefined> {
    const { line, column } = this.editor.place;
    const answer = await this.session.ask("names", {});
    const names = answer?.json<Names>("document");
    this.mayCall = false;
    if (!names) return void this.tell((answer?.text("messages") ?? "").trim());
    const all = placesOf(names);
    const isCall = (place: Place) => place.line === line && !place.defines && names.names[place.name]?.sort === "program";
    this.mayCall = all.some(isCall) || WORD.test((this.editor.text.split("\n")[line - 1] ?? "").replace(/[(;].*/, ""));
    // A sign in front belongs to the name for whoever points at it.
    const near = all.filter((place) => place.line === line && place.from - 1 <= column && column <= place.to);
    const here = near.find((place) => place.from <= column) ?? near[0] ?? this.only(all, line);
    if (!here) return void this.tell(say("noName"));
    const { sort = "", text = "", shared = false } = names.names[here.name] ?? {};
    return { here, sort, text, shared, places: all.filter((place) => place.name === here.name) };
  }

  /** The one name that a line uses: `GOTO 10`, `M98 P1000`. */
  private only(all: Place[], line: number): Place | undefined {
    const own = all.filter((place) => place.line === line);
    return own.length === 1 ? own[0] : undefined;
  }

  private tell(text: string): void {
    this.told.textContent = text;
  }

  /** A dialog with fields; what the work gives back is told in it, and where that is nothing it is shut. */
  private ask(head: string, fields: Field[], work: (values: string[]) => Promise<string>): void {
    this.tell("");
    const wrong = el("p", { class: "wrong", role: "alert" });
    const inputs = fields.map(({ name, value, number }) => {
      const kind = number ? { type: "number", min: "0", max: "9999999", step: "1", required: true } : { type: "text", required: true };
      return el("input", { ...kind, value, "aria-label": say(name), autocapitalize: "characters", spellcheck: "false" });
    });
    const labels = inputs.map((input, at) => el("label", {}, say(fields[at]?.name ?? "name"), " ", input));
    const done = async (event: Event) => {
      event.preventDefault();
      if (!this.ended) return;
      this.ended = false;
      wrong.textContent = say("working");
      const told = await work(inputs.map((input) => input.value)).catch(String);
      this.ended = true;
      wrong.textContent = told;
      if (told) return;
      this.dialog.close();
      this.tell(this.changed());
      this.editor.focus();
    };
    const close = () => (this.dialog.close(), this.editor.focus());
    const form = el("form", { class: "fields", onsubmit: (event) => void done(event) }, ...labels);
    form.append(
      el("button", { class: "primary", type: "submit" }, say("apply")),
      el("button", { type: "button", onclick: close }, say("cancel")),
    );
    this.dialog.replaceChildren(el("header", {}, el("h2", { id: "editor-dialog-title" }, head)), form, wrong);
    this.dialog.showModal();
    inputs[0]?.select();
  }
}
