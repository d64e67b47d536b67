// The card that measures: two places, by clicks on the part, by numbers, or where the tool is; between them distance and axes.

import type { Cut } from "../engine/part";
import { byId, el } from "../ui/dom";
import { figure, say } from "../ui/texts";
import { card, isOpen } from "./cards";
import type { Point, Snapped } from "./pick";

const INCH = 25.4;
const NAMES = ["A", "B"] as const;
const AXES = ["X", "Y", "Z"] as const;

export class MeasureCard {
  private readonly places: (Snapped | undefined)[] = [undefined, undefined];
  private readonly inputs: HTMLInputElement[][];
  private readonly kinds: HTMLElement[];
  private readonly result = el("dl", { id: "measured" });
  private readonly unsure = el("p", { class: "dim" });
  private cut: Cut | undefined;
  /** The place that comes next. */
  private next: 0 | 1 = 0;

  constructor(
    private readonly tool: () => Point | undefined,
    private readonly changed: (places: (Point | undefined)[]) => void,
  ) {
    this.kinds = NAMES.map(() => el("small", { class: "dim" }));
    this.inputs = NAMES.map((name, own) =>
      AXES.map((axis) => {
        const input = el("input", { type: "number", step: "any", placeholder: axis, "aria-label": `${name} ${axis}` });
        input.addEventListener("change", () => this.typed(own as 0 | 1));
        return input;
      }),
    );
    const rows = NAMES.map((name, own) => {
      const here = el("button", { class: "chip", "aria-label": `${name}: ${say("atTool")}` }, say("atTool"));
      here.addEventListener("click", () => this.atTool(own as 0 | 1));
      return el("div", { class: "row place" }, el("b", {}, name), ...(this.inputs[own] ?? []), here, this.kinds[own] as HTMLElement);
    });
    const clear = el("button", { class: "chip" }, say("clear"));
    clear.addEventListener("click", () => this.clear());
    card("measure", "measure", () => this.show(), el("p", { class: "dim" }, say("measureHow")), ...rows, el("div", { role: "status" }, this.result), this.unsure, clear);
  }

  setCut(cut: Cut | undefined): void {
    this.cut = cut;
    this.show();
  }

  get active(): boolean {
    return isOpen("measure");
  }

  /** A place that was clicked, or where the tool is. */
  take(place: Snapped, own: 0 | 1 = this.next): void {
    this.places[own] = place;
    this.next = own === 0 ? 1 : 0;
    this.show();
  }

  atTool(own: 0 | 1 = this.next): void {
    const at = this.tool();
    if (at) this.take({ at, kind: "tool" }, own);
  }

  private get unit(): number {
    return this.cut?.units === "inch" ? INCH : 1;
  }

  private typed(own: 0 | 1): void {
    const at = (this.inputs[own] ?? []).map((input) => (input.valueAsNumber || 0) * this.unit) as Point;
    this.take({ at, kind: "typed" }, own);
  }

  private clear(): void {
    this.places.fill(undefined);
    this.next = 0;
    this.show();
  }

  private show(): void {
    const { unit } = this;
    const [name, digits] = unit === 1 ? ["mm", 3] : [say("inch"), 4];
    for (const [own, place] of this.places.entries()) {
      this.inputs[own]?.forEach((input, axis) => {
        if (input !== document.activeElement || place?.kind !== "typed") input.value = place ? String(Number(((place.at[axis] ?? 0) / unit).toFixed(digits))) : "";
      });
      (this.kinds[own] as HTMLElement).textContent = place ? say(`snap_${place.kind}`) : "";
    }
    const [a, b] = this.places;
    const between = a && b ? (AXES.map((_, axis) => ((b.at[axis] ?? 0) - (a.at[axis] ?? 0)) / unit) as Point) : undefined;
    const value = (length: number | undefined) => (length === undefined ? "–" : `${figure(length, digits)} ${name}`);
    const rows: [string, number | undefined][] = [
      [say("distance"), between && Math.hypot(...between)],
      ...AXES.map((axis, at): [string, number | undefined] => [`Δ${axis}`, between?.[at]]),
    ];
    this.result.replaceChildren(...rows.flatMap(([label, length]) => [el("dt", {}, label), el("dd", {}, value(length))]));
    // A place on the part is known to the cell it lies in.
    const rough = this.places.some((place) => place?.kind === "cell" || place?.kind === "edge");
    this.unsure.textContent = rough && this.cut ? say("measureUnsure", { by: figure(this.cut.raw.cell / 2 / unit, digits), unit: name }) : "";
    byId("canvas").dataset.measured = between ? between.map((length) => length.toFixed(4)).join(" ") : "";
    this.changed(this.active ? this.places.map((place) => place?.at) : []);
  }
}
