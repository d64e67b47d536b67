// The set-up: the raw part, and the tools as the compiler knows them. What a user states is a choice of the project, in the
// form of the command line (`--stock`, `--tool`); what nobody states the compiler guesses, and the guess is marked.

import type { Cut, Tool } from "../engine/part";
import type { Desk } from "../projects/desk";
import type { Session } from "../session";
import { byId, el } from "../ui/dom";
import { Bench, bodyOf, bodyText, lengthOf } from "./bench";
import { FIELDS, readBody, rounded, writeBody, type Form } from "./body";
import { clock, figure, say, type TextName } from "../ui/texts";

/** Shapes that can be stated, and what more can be: its name on the command line and its unit. */
const SHAPES: [string, TextName, "corner" | "angle" | "", string][] = [
  ["flat", "flat", "", ""],
  ["ball", "ball", "", ""],
  ["bull-nose", "bullNose", "corner", "mm"],
  ["drill", "drill", "angle", "°"],
  ["chamfer", "chamfer", "angle", "°"],
  ["taper", "taper", "angle", "°"],
  ["lollipop", "lollipop", "", ""],
  ["t-slot", "tSlot", "", ""],
];

/** Where a diameter comes from. */
const KNOWN: Record<string, TextName> = {
  stated: "knownStated",
  profile: "knownProfile",
  comment: "knownComment",
  guess: "guess",
};

const FORMS = ["guess", "block", "cylinder"] as const;

/** A shape in words; the compiler's name where it cannot be stated here. */
export function shapeName(shape: string): string {
  const text = SHAPES.find(([own]) => own === shape)?.[1];
  return text ? say(text) : shape;
}

export class SetupPane {
  constructor(
    private readonly session: Session,
    private readonly desk: Desk,
  ) {
    session.path.on(() => this.show());
    session.project.on(() => this.show());
    session.stated.on(() => this.show());
    desk.setUpTold.on(() => this.show());
  }

  private show(): void {
    const { cut } = this.session;
    const host = byId("setup-pane");
    // A field that somebody types in stays as it is.
    if (host.contains(document.activeElement) && document.activeElement?.matches("input, select")) {
      return document.activeElement.addEventListener("blur", () => this.show(), { once: true });
    }
    const bench = new Bench(this.desk, this.session.project.get(), this.session.setUp);
    const told = el("p", { id: "setup-told", class: "dim" }, this.session.statedTold || this.desk.setUpTold.get());
    host.replaceChildren(this.machine(), this.raw(cut), bench.fixtures(cut), ...(this.hasMachine ? [bench.zero()] : []), this.tools(cut), bench.resolution(this.session.mostCells), told);
  }

  /** The machine, where the bar above has no room for it, and which files of the project file are not at hand. */
  private machine(): HTMLElement {
    const chosen = this.session.project.get()?.choices.machine;
    const all = [{ id: "", title: say("noMachine") }, ...this.session.machines];
    const list = el("select", { "aria-label": say("machine") }, ...all.map(({ id, title }) => el("option", { value: id, selected: id === chosen }, title)));
    list.addEventListener("change", () => void this.desk.choose(({ choices }) => (choices.machine = list.value)));
    const told = this.session.stated.get()?.told ?? [];
    const lacking = told.map((text) => el("p", { class: "guess" }, text));
    const look = { id: "set-up-machine", class: told.length > 0 ? "" : "phone-only" };
    return el("section", look, el("h2", {}, say("machine")), el("div", { class: "phone-only" }, list), ...lacking);
  }

  /** Whether it is known which machine has the part. */
  private get hasMachine(): boolean {
    return Boolean(this.session.project.get()?.choices.machine || this.session.stated.get()?.machine);
  }

  private raw(cut: Cut | undefined): HTMLElement {
    const stated = this.session.setUp?.stock ?? "";
    const [form, numbers] = readBody(stated) ?? [undefined, []];
    const names = form ? FIELDS[form] : [];
    const list = el("select", { "aria-label": say("rawPart") });
    list.append(...FORMS.map((one) => el("option", { value: one, selected: one === (form ?? "guess") }, say(one))));
    // What has no fields, a file of triangles, stands as it is.
    if (stated && !form) list.append(el("option", { value: stated, selected: true }, stated));
    list.addEventListener("change", () => this.stateRaw(beginning(list.value, cut)));
    const inputs = names.map((name, at) => {
      const input = el("input", { type: "number", step: "any", value: numbers[at] ?? 0, "aria-label": `${say("rawPart")} ${name}` });
      input.addEventListener("change", () => form && this.stateRaw(writeBody(form, inputs.map((one) => one.valueAsNumber || 0))));
      return input;
    });
    const fields = inputs.map((input, at) => el("label", {}, names[at] ?? "", input));
    const { raw } = cut ?? {};
    const size = raw ? raw.high.map((high, axis) => figure(high - (raw.low[axis] ?? 0), 1)).join(" × ") : "–";
    const row = el("div", { class: "fields" }, list, ...fields, el("span", { class: "dim" }, `${size} mm`));
    const removed = el("p", { class: "dim" }, cut ? `${say("removed")}: ${figure(cut.removed / 1000, 2)} cm³` : "");
    return el("section", {}, el("h2", {}, say("rawPart")), row, removed);
  }

  private stateRaw(stock: string): void {
    void this.desk.state({ stock });
  }

  private tools(cut: Cut | undefined): HTMLElement {
    const names: TextName[] = ["tool", "shape", "diameter", "detail", "flute", "shank", "holder", "holderFrom", "knownBy", "time", "removed"];
    const head = el("tr", {}, ...names.map((name) => el("th", { scope: "col" }, say(name))));
    const rows = (cut?.tools ?? []).map((tool, at) => this.tool(tool, at));
    // Where a row has no room, each field has its name beside it.
    for (const row of rows) row.querySelectorAll("td").forEach((cell, at) => (cell.dataset.name = say(names[at + 1] as TextName)));
    const table = el("table", {}, el("thead", {}, head), el("tbody", {}, ...rows));
    return el("section", {}, el("h2", {}, say("tools")), el("div", { class: "wide-table" }, table));
  }

  private tool(tool: Tool, at: number): HTMLElement {
    const { number } = tool;
    const name = number === null ? "–" : `T${number}`;
    const stated = this.session.project.get()?.choices.tools[String(number)] ?? "";
    const [, , option, unit] = SHAPES.find(([own]) => own === tool.shape) ?? ["", "", "", ""];
    const detail = option ? lengthOf(stated, option, tool[option]) : "";
    const body = bodyOf(stated, tool);
    const disabled = number === null;
    const shape = el("select", { "aria-label": `${say("shape")} ${name}`, disabled });
    const known = SHAPES.some(([own]) => own === tool.shape) ? SHAPES : [...SHAPES, [tool.shape, "shape", "", ""] as const];
    shape.append(...known.map(([own, text]) => el("option", { value: own, selected: own === tool.shape }, text === "shape" ? own : say(text))));
    const field = (label: TextName, value: string) =>
      el("input", { type: "number", min: 0, step: "any", value, "aria-label": `${say(label)} ${name}`, disabled });
    const diameter = field("diameter", String(Number(tool.diameter.toFixed(3))));
    const more = field("detail", detail);
    more.hidden = !option;
    const state = () => {
      const key = SHAPES.find(([own]) => own === shape.value)?.[2];
      const extra = key && more.value && shape.value === tool.shape ? `,${key}=${more.value}` : "";
      // What has no field here stays as it is known.
      const others = (["corner", "angle", "end_diameter"] as const).filter((own) => own !== key && tool[own] !== undefined);
      const kept = shape.value === tool.shape ? others.map((own) => `,${own}=${tool[own]}`).join("") : "";
      const text = diameter.value ? `${shape.value},${diameter.value}${extra}${kept}${bodyText(lengths, diameter.valueAsNumber)}` : "";
      void this.desk.state({}, { [String(number)]: text });
    };
    // Where a holder begins means nothing without one.
    const lengths = Object.fromEntries(Object.entries(body).map(([key, [label, value]]) => [key, field(label, value)]));
    (lengths.holder_from as HTMLInputElement).disabled ||= !lengths.holder?.value;
    for (const input of [shape, diameter, more, ...Object.values(lengths)]) input.addEventListener("change", state);
    const dot = el("i", { class: `band band-${at % 8}` });
    const guessed = tool.known === "guess";
    // A machine that has no name stands in the project file, with what is stated here.
    const isHere = tool.known === "profile" && this.session.stated.get()?.machine?.name === null && !this.session.project.get()?.choices.machine;
    return el(
      "tr",
      {},
      el("th", { scope: "row" }, dot, name),
      el("td", {}, shape),
      el("td", {}, diameter, " mm"),
      el("td", {}, more, option ? ` ${unit}` : ""),
      ...Object.values(lengths).map((input) => el("td", {}, input)),
      el("td", { class: guessed ? "guess" : "" }, say(isHere ? "knownStated" : (KNOWN[tool.known] ?? "guess"))),
      el("td", { class: "figure" }, clock(tool.cutting)),
      el("td", { class: "figure" }, `${figure(tool.removed / 1000, 2)} cm³`),
    );
  }
}

/** A stated raw part that begins as the guessed one. */
function beginning(form: string, cut: Cut | undefined): string {
  const { low, high } = cut?.raw ?? { low: [0, 0, -20], high: [100, 100, 0] };
  const [x0, y0, z0] = low as [number, number, number];
  const [x1, y1, z1] = high as [number, number, number];
  const across = Math.hypot(x1 - x0, y1 - y0);
  const begin: Record<Form, number[]> = { block: [x0, x1, y0, y1, z0, z1], cylinder: [across, (x0 + x1) / 2, (y0 + y1) / 2, z0, z1] };
  return form === "block" || form === "cylinder" ? writeBody(form, rounded(begin[form])) : "";
}
