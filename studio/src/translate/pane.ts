// The translation beside the source: target, verdict, questions that a click answers, the program, what the compiler says.

import { Editor } from "../editor/editor";
import type { Question } from "../engine/documents";
import type { Between } from "../engine/part";
import { download, type Desk } from "../projects/desk";
import { choose, type Choices } from "../projects/project";
import type { Other, Session, Translation } from "../session";
import { SIDES, sideOf, type SideName } from "../setup/stated";
import { byId, el, icon } from "../ui/dom";
import { wireToggle } from "../ui/layout";
import { figure, say, type TextName } from "../ui/texts";
import { Aligned } from "./align";
import { MovesPane } from "./moves";

/** Options of the command line that help texts name, in backquotes. */
const OPTION = /`(--(?:from-option|to-option|from|pass) [\w.=-]+)`/g;

/** Files of dialects end so, as the controls have them. */
const ENDINGS: Record<string, string> = { siemens: "mpf", linuxcnc: "ngc", grbl: "gcode", mach3: "tap", mach9: "cn" };

export class TranslatePane {
  private readonly output: Editor;
  private shown = "";
  private readonly aligned: Aligned;
  private readonly moves: MovesPane;

  constructor(
    private readonly session: Session,
    private readonly desk: Desk,
    source: Editor,
  ) {
    this.output = new Editor(byId("output"), {
      label: say("translation"),
      readOnly: true,
      colours: (doc, first, lines) => session.colours(doc, this.target() || "auto", first, lines),
      words: () => session.words(this.target()),
      cursor: (line) => this.aligned.markOutput(line),
    });
    this.aligned = new Aligned(source, this.output);
    this.moves = new MovesPane(session, desk, () => this.other(), (line, other) => {
      if (line !== undefined) {
        source.goTo(line);
        source.focus();
        this.markSource(line);
      }
      if (other !== undefined) this.output.markPairs([other], true);
    });
    wireToggle("together", (on) => this.aligned.setTogether(on));
    session.translation.on((translation) => this.show(translation));
    for (const signal of [session.project, session.stated]) signal.on(() => this.verdict(session.translation.get()));
    session.stated.on(() => this.choices());
    let open: string | undefined;
    session.project.on((project) => {
      this.choices();
      if (project?.id !== open) byId("answers-told").textContent = "";
      open = project?.id;
    });
    byId("translation-export").addEventListener("click", () => this.save());
    byId("compare").addEventListener("click", () => void this.compare());
  }

  /** Marks what was made of a line of the source. */
  markSource(line: number): void {
    if (this.session.translation.get()?.lines) this.aligned.markSource(line);
  }

  /** The colours are others. */
  draw(): void {
    this.moves.draw();
  }

  /** The translation as a program of its own. */
  private other(): Other | undefined {
    const [output, project] = [this.session.translation.get()?.output, this.session.project.get()];
    if (output === undefined || !project) return undefined;
    const { machine, options } = sideOf("toOption", project.choices, this.session.stated.get());
    const bytes = new TextEncoder().encode(output);
    return { name: `translated-${project.file}`, bytes, from: this.target(), machine, options };
  }

  private target(): string {
    const choices = this.session.project.get()?.choices;
    const machine = this.session.machines.find((one) => one.id === choices?.machineTo);
    return choices?.to || machine?.dialect || (this.session.stated.get()?.to?.dialect ?? "");
  }

  private show(translation: Translation | undefined): void {
    const text = translation?.output ?? "";
    if (text !== this.shown) this.output.open(text.replaceAll("\r\n", "\n"));
    this.shown = text;
    this.aligned.setLines(translation?.lines);
    byId<HTMLButtonElement>("translation-export").disabled = translation?.output === undefined;
    byId<HTMLButtonElement>("compare").disabled = translation?.output === undefined;
    byId("compared").textContent = "";
    this.verdict(translation);
    const questions = translation?.report?.questions ?? [];
    const box = byId("questions");
    const offers = this.offers(translation, questions);
    box.hidden = questions.length === 0 && offers.length === 0;
    box.replaceChildren(...questions.map((one) => this.question(one)), ...offers);
    byId("messages").textContent = translation?.messages ?? "";
    byId<HTMLDetailsElement>("messages-box").open = translation !== undefined && translation.output === undefined;
  }

  private verdict(translation: Translation | undefined): void {
    const [text, look] = verdictOf(translation);
    const place = byId("verdict");
    const idle = !translation && !this.target();
    place.textContent = idle ? say("chooseTarget") : text ? say(text) : "";
    place.className = idle ? "dim" : look;
  }

  private question(question: Question): HTMLElement {
    const { place } = question;
    const answers = question.answers.map(({ option, result }) => {
      const plain = option.replaceAll("`", "");
      return el("button", { title: plain, onclick: () => this.take(plain) }, `${result}`);
    });
    const where = `${place.line} │ ${place.text}`;
    const text = el("p", {}, el("b", {}, question.question), " ", el("span", { class: "place" }, where));
    return el("div", { class: "question" }, text, el("div", { class: "answers" }, ...answers));
  }

  /** Options that help texts name beside the questions: what a user would type, a click does. */
  private offers(translation: Translation | undefined, questions: Question[]): HTMLElement[] {
    if (!translation || translation.output !== undefined || questions.length > 0) return [];
    const advice = (translation.report?.diagnostics ?? []).filter((one) => one.severity === "error").flatMap((one) => one.advice);
    const options = new Set(advice.flatMap((text) => [...text.matchAll(OPTION)].map((match) => match[1] as string)));
    return [...options].map((option) =>
      el("button", { class: "chip", onclick: () => this.take(option) }, say("useChoice", { name: option })),
    );
  }

  private take(option: string): void {
    void this.desk.choose((project) => choose(project.choices, option)).then(() => this.keep());
  }

  /** Writes the answers where the command line finds them. */
  private async keep(without?: readonly [SideName, string]): Promise<void> {
    const place = byId("answers-told");
    const told = await this.desk.keepAnswers(without);
    place.textContent = told || say(this.desk.project?.server ? "answersHere" : "answersKept");
    place.classList.toggle("bad", told !== "");
  }

  /** What was chosen, or stands in `ncc.toml`, each to be taken back by a click. */
  private choices(): void {
    const choices = this.session.project.get()?.choices;
    const chips = choices ? [...this.chips(choices)] : [];
    const box = byId("choices");
    box.hidden = chips.length === 0;
    box.replaceChildren(el("span", {}, `${say("choices")}:`), ...chips);
  }

  private *chips(choices: Choices): Iterable<HTMLElement> {
    for (const side of SIDES) {
      for (const [name, value] of Object.entries(sideOf(side, choices, this.session.stated.get()).options)) {
        yield this.chip(`${name} = ${value}`, (own) => delete own[side][name], [side, name]);
      }
    }
    for (const pass of choices.pass) {
      yield this.chip(pass, (own) => (own.pass = own.pass.filter((one) => one !== pass)));
    }
  }

  private chip(text: string, back: (choices: Choices) => unknown, option?: readonly [SideName, string]): HTMLElement {
    const does = () => void this.desk.choose((project) => back(project.choices)).then(() => this.keep(option));
    return el("button", { class: "chip", title: say("undoChoice", { name: text }), onclick: does }, text, icon("close"));
  }

  private async compare(): Promise<void> {
    const [place, button] = [byId("compared"), byId<HTMLButtonElement>("compare")];
    const translation = this.session.translation.get();
    place.textContent = say("working");
    button.disabled = true;
    const between = await this.session.compare(this.target());
    // A newer translation has cleared the place already.
    if (translation !== this.session.translation.get()) return;
    button.disabled = false;
    place.textContent = between === undefined ? "" : typeof between === "string" ? between.trim() : told(between);
  }

  private save(): void {
    const project = this.session.project.get();
    const text = this.session.translation.get()?.output;
    if (!project || text === undefined) return;
    const stem = project.file.replace(/\.\w+$/, "");
    download(`${stem}.${ENDINGS[this.target()] ?? "nc"}`, new TextEncoder().encode(text));
  }
}

function told({ same, tolerance, more, less, above, below }: Between): string {
  if (same) return say("partsSame", { tolerance: figure(tolerance, 3) });
  const values = { more: figure(more, 2), above: figure(above?.by ?? 0, 3), less: figure(less, 2), below: figure(below?.by ?? 0, 3) };
  return say("partsDiffer", values);
}

function verdictOf(translation: Translation | undefined): [TextName | "", string] {
  if (!translation) return ["", ""];
  if (translation.output !== undefined) {
    return translation.report?.verification ? ["verified", "good"] : ["notVerified", "ask"];
  }
  return (translation.report?.questions.length ?? 0) > 0 ? ["questionsOpen", "ask"] : ["refused", "bad"];
}
