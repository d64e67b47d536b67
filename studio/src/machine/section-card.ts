// The card of the section: axis, place by a slider, a number or keys, and which side goes away.

import type { Cut, Heights } from "../engine/part";
import { byId, el } from "../ui/dom";
import { figure, say } from "../ui/texts";
import { card, isOpen, row, toggleCard } from "./cards";
import { areaOf, type Axis, type Section } from "./section";

const AXES = ["X", "Y", "Z"] as const;

export class SectionCard {
  private section: Section = { axis: 1, at: 0, below: true };
  private cut: Cut | undefined;
  private part: Heights | undefined;
  private placed = false;
  private readonly buttons: HTMLButtonElement[];
  private readonly slider = el("input", { type: "range", "aria-label": say("sectionAt") });
  private readonly number = el("input", { type: "number", step: "any", "aria-label": `${say("sectionAt")} mm` });
  private readonly side = el("button", { class: "chip", "aria-pressed": "false" }, say("sectionSide"));
  private readonly area = el("output", { id: "section-area" });

  constructor(
    private readonly changed: (section: Section | undefined) => void,
    /** Whether the eye sees the part from where an axis begins. */
    private readonly fromBelow: (axis: Axis) => boolean,
  ) {
    this.buttons = AXES.map((name, axis) => {
      const button = el("button", { class: "chip", "aria-label": `${say("sectionAcross")} ${name}` }, name);
      button.addEventListener("click", () => this.across(axis as Axis));
      return button;
    });
    for (const input of [this.slider, this.number]) {
      input.addEventListener("input", () => Number.isFinite(input.valueAsNumber) && this.put(input.valueAsNumber, input));
    }
    this.side.addEventListener("click", () => {
      this.section.below = !this.section.below;
      this.show();
    });
    card(
      "section",
      "section",
      () => this.show(),
      el("div", { class: "row", role: "group", "aria-label": say("sectionAcross") }, ...this.buttons, this.side),
      row(say("sectionAt"), this.number, "mm"),
      this.slider,
      el("p", { class: "row dim" }, say("sectionArea"), this.area),
    );
  }

  /** Another part: the plane stays where it is, as far as it is within. */
  setCut(cut: Cut | undefined): void {
    this.cut = cut;
    if (!this.placed) this.middle();
    this.show();
  }

  setPart(part: Heights | undefined): void {
    this.part = part;
    this.tell();
  }

  /** Shows a section across an axis; where there is one across it, takes it away. */
  toggle(axis: Axis): void {
    const own = isOpen("section") && this.section.axis === axis;
    if (!own) this.across(axis);
    toggleCard("section", !own);
  }

  /** Moves the plane by so many cells. */
  move(cells: number): void {
    if (isOpen("section") && this.cut) this.put(this.section.at + cells * this.cut.raw.cell);
  }

  private across(axis: Axis): void {
    this.section.axis = axis;
    // What lies nearer to the eye goes away.
    this.section.below = this.fromBelow(axis);
    this.middle();
    this.show();
  }

  private middle(): void {
    const { low, high } = this.cut?.raw ?? {};
    const { axis } = this.section;
    if (low && high) this.section.at = (low[axis] + high[axis]) / 2;
  }

  private put(at: number, from?: HTMLInputElement): void {
    const { low, high } = this.cut?.raw ?? { low: [0, 0, 0], high: [0, 0, 0] };
    const { axis } = this.section;
    this.section.at = Math.min(high[axis] as number, Math.max(low[axis] as number, at));
    this.placed = true;
    this.show(from);
  }

  private show(from?: HTMLInputElement): void {
    const { axis, at, below } = this.section;
    this.buttons.forEach((button, own) => button.setAttribute("aria-pressed", String(own === axis)));
    this.side.setAttribute("aria-pressed", String(!below));
    const { raw } = this.cut ?? {};
    if (raw) {
      // Its cells give a slider its steps; a row of them is in the middle of a cell.
      [this.slider.min, this.slider.max, this.slider.step] = [raw.low[axis], raw.high[axis], raw.cell / 2].map(String) as [string, string, string];
    }
    if (from !== this.slider) this.slider.value = String(at);
    if (from !== this.number) this.number.value = String(Number(at.toFixed(3)));
    this.changed(isOpen("section") ? { ...this.section } : undefined);
    this.tell();
  }

  private tell(): void {
    const { cut, part } = this;
    const area = cut && part && isOpen("section") ? areaOf(this.section, cut, part) : undefined;
    this.area.textContent = area === undefined ? "–" : `${figure(area, 1)} mm²`;
    byId("canvas").dataset.section = area === undefined ? "" : area.toFixed(2);
  }
}
