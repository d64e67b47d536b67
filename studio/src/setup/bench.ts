// What else is set up: fixtures around the part, shank and holder of a tool, and how fine the part is cut.

import type { Cut, Tool } from "../engine/part";
import type { Desk } from "../projects/desk";
import type { Project } from "../projects/project";
import { el } from "../ui/dom";
import { say, type TextName } from "../ui/texts";
import { FIELDS, readBody, rounded, writeBody } from "./body";
import type { SetUp } from "./stated";

const CELLS = [0, 256, 512, 1024, 2048, 4096];
const AXES = ["X", "Y", "Z"] as const;

export class Bench {
  constructor(
    private readonly desk: Desk,
    private readonly project: Project | undefined,
    private readonly setUp: SetUp | undefined,
  ) {}

  /** The list of fixtures, each by its numbers or its file. */
  fixtures(cut: Cut | undefined): HTMLElement {
    const all = this.setUp?.fixtures ?? [];
    const rows = all.map((text, at) => this.fixture(text, at));
    const add = (name: TextName, make: () => void) => {
      const button = el("button", { class: "chip" }, say(name));
      button.addEventListener("click", make);
      return button;
    };
    const { low, high } = cut?.raw ?? { low: [0, 0, -20], high: [50, 50, 0] };
    const [x, y0, y1, z0, z1] = [high[0], low[1], high[1], low[2], high[2]] as [number, number, number, number, number];
    // A jaw along the part, as high as its middle.
    const jaw = writeBody("block", rounded([x, x + 20, y0, y1, z0, (z0 + z1) / 2]));
    const middle = (y0 + y1) / 2;
    const clamp = writeBody("cylinder", rounded([20, x + 15, middle, z0, z1 + 10]));
    const file = el("input", { type: "file", accept: ".stl", "aria-label": say("fixtureFile"), class: "unseen", tabindex: -1 });
    file.addEventListener("change", () => void this.take(file.files?.[0]));
    const buttons = el("div", { class: "held" }, add("addBlock", () => this.put([...all, jaw])), add("addCylinder", () => this.put([...all, clamp])), add("addStl", () => file.click()), file);
    const table = el("input", { type: "number", step: "any", value: this.setUp?.table ?? "", "aria-label": say("table"), placeholder: "–" });
    table.addEventListener("change", () => void this.desk.state({ table: table.value }));
    const level = el("div", { class: "held" }, el("label", {}, say("table"), table, "mm"));
    return el("section", { id: "fixtures" }, el("h2", {}, say("fixtures")), ...rows, buttons, level);
  }

  /** Where the zero of the part lies on the machine: with it the travel is shown and checked. */
  zero(): HTMLElement {
    const chosen = this.project?.choices.zero ?? [];
    const inputs = AXES.map((axis, at) => el("input", { type: "number", step: "any", value: chosen[at] ?? "", "aria-label": `${say("zeroOnMachine")} ${axis}`, placeholder: "–" }));
    const state = () => {
      const zero = inputs.map((input) => input.value);
      // One that is not whole says nothing yet.
      const all = zero.filter(Boolean).length;
      if (all === 3 || all === 0) void this.desk.choose(({ choices }) => (choices.zero = all === 3 ? zero : []));
    };
    for (const input of inputs) input.addEventListener("change", state);
    const fields = inputs.map((input, at) => el("label", {}, AXES[at] ?? "", input));
    return el("section", { id: "zero" }, el("h2", {}, say("zeroOnMachine")), el("div", { class: "held" }, ...fields, "mm"), el("p", { class: "dim" }, say("zeroMeans")));
  }

  /** How fine the part is cut: at most so many cells along its longer side. */
  resolution(most: number): HTMLElement {
    const chosen = this.project?.choices.cells ?? 0;
    const list = el("select", { id: "cells", "aria-label": say("resolution") });
    list.append(...CELLS.filter((cells) => cells <= most).map((cells) => el("option", { value: cells, selected: cells === chosen }, cells ? say("cellsAlong", { cells }) : say("cellsAutomatic"))));
    list.addEventListener("change", () => void this.desk.choose(({ choices }) => (choices.cells = Number(list.value))));
    return el("section", {}, el("h2", {}, say("resolution")), list);
  }

  private fixture(text: string, at: number): HTMLElement {
    const [form, numbers] = readBody(text) ?? [undefined, []];
    const names = form ? FIELDS[form] : [];
    const label = say("fixtureNumber", { number: at + 1 });
    const inputs = names.map((name, own) => {
      const input = el("input", { type: "number", step: "any", value: numbers[own] ?? 0, "aria-label": `${label} ${name}` });
      input.addEventListener("change", () => {
        if (form) this.replace(at, writeBody(form, inputs.map((one) => one.valueAsNumber || 0)));
      });
      return input;
    });
    const fields = inputs.map((input, own) => el("label", {}, names[own] ?? "", input));
    const remove = el("button", { class: "chip", "aria-label": `${say("remove")}: ${label}` }, say("remove"));
    remove.addEventListener("click", () => this.replace(at));
    return el("div", { class: "held" }, el("b", {}, form ? label : text), ...fields, remove);
  }

  private replace(at: number, ...by: string[]): void {
    const all = [...(this.setUp?.fixtures ?? [])];
    all.splice(at, 1, ...by);
    this.put(all);
  }

  private put(fixtures: string[]): void {
    void this.desk.state({ fixtures });
  }

  private async take(file: File | undefined): Promise<void> {
    if (!file) return;
    const bytes = new Uint8Array(await file.arrayBuffer());
    await this.desk.choose((project) => {
      project.bodies = { ...project.bodies, [file.name]: bytes };
    }, false);
    this.put([...(this.setUp?.fixtures ?? []), file.name]);
  }
}

/** A length or an angle of a tool: as it was chosen, and else as it is known. */
export function lengthOf(stated: string, key: string, known: number | undefined): string {
  return new RegExp(`\\b${key}=([\\d.]+)`).exec(stated)?.[1] ?? (known === undefined ? "" : String(known));
}

/** Lengths of a tool's body: their names on the command line, in words, and their values. */
export function bodyOf(stated: string, tool: Tool): Record<string, [TextName, string]> {
  const value = (key: string, known: number | undefined) => lengthOf(stated, key, known);
  return {
    flute: ["flute", value("flute", tool.flute)],
    shank: ["shank", value("shank", tool.shank)],
    holder: ["holder", value("holder", tool.holder?.[0])],
    holder_from: ["holderFrom", value("holder_from", tool.holder?.[1])],
  };
}

/** They as the command line has them. A shank means nothing without flutes, nor a holder without its place: what is missing is
 * what is usual, until somebody states it. */
export function bodyText(inputs: Record<string, HTMLInputElement>, diameter: number): string {
  const stated = (key: string) => inputs[key]?.valueAsNumber || undefined;
  const [shank, holder] = [stated("shank"), stated("holder")];
  const flute = stated("flute") ?? (shank && diameter * 3);
  const from = holder && (stated("holder_from") ?? (flute ?? diameter * 3) + 10);
  const all = { flute, shank, holder, holder_from: from };
  return Object.entries(all).map(([key, value]) => (value ? `,${key}=${value}` : "")).join("");
}
