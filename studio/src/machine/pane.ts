// The machine's pane: the picture where WebGL 2 is, its buttons, and what stands over it.

import type { Cut, Heights } from "../engine/part";
import { leaning, piecesOf, type Path } from "../engine/path";
import { placeOf, type Now, type Player } from "../time/player";
import { byId, el } from "../ui/dom";
import { wireToggle } from "../ui/layout";
import { figure, say, type TextName } from "../ui/texts";
import { showLegend, tintOf } from "./legend";
import { LookCard } from "./look-card";
import { MeasureCard } from "./measure-card";
import { COLOURINGS, type Colouring } from "./paths";
import { endsOf, meet, snap } from "./pick";
import { Readout, drawCompass } from "./readout";
import { SectionCard } from "./section-card";
import { planeOf, type Section } from "./section";
import { MachineView, drawingOn, type Picked, type Side } from "./view";

const NAMES: Record<Colouring, TextName> = {
  kind: "byKind",
  tool: "byTool",
  operation: "byOperation",
  feed: "byFeed",
  depth: "byDepth",
  time: "byTime",
};

export class MachinePane {
  private readonly view: MachineView | undefined;
  private readonly readout = new Readout();
  private path: Path | undefined;
  private cut: Cut | undefined;
  private heights: Heights | undefined;
  private colouring: Colouring = "kind";
  private section: Section | undefined;
  private readonly sectionCard: SectionCard | undefined;
  private readonly measureCard: MeasureCard | undefined;
  private readonly lookCard: LookCard | undefined;
  private shown = 15;
  private future = true;
  private part = true;

  constructor(
    private readonly player: Player,
    private readonly picked: (line: number) => void,
  ) {
    this.view = this.open();
    const { view } = this;
    if (view) {
      const show = (section: Section | undefined) => {
        this.section = section;
        view.setSection(section);
      };
      this.sectionCard = new SectionCard(show, (axis) => view.direction.getComponent(axis) < -1e-3);
      this.measureCard = new MeasureCard(
        () => (this.path ? placeOf(this.path, this.player.now.get()) : undefined),
        (places) => view.setMeasured(places),
      );
      this.lookCard = new LookCard(() => ownColour(), (look) => view.setLook(look), this.timing(view));
    }
    this.wire();
    if (!this.view) this.tell(say("noWebgl"), "");
  }

  setPath(path: Path | undefined, cut: Cut | undefined, told: string): void {
    const again = this.path !== undefined;
    this.path = path;
    this.cut = cut;
    this.heights = undefined;
    this.view?.setPath(path, cut, again);
    this.view?.setStock(this.part && cut !== undefined);
    this.sectionCard?.setCut(cut);
    this.measureCard?.setCut(cut);
    this.recolour();
    byId("canvas").dataset.pieces = String(path?.pieces ?? 0);
    this.setTold(path, told);
    this.setNow(path, this.player.now.get());
  }

  /** The part at the moment that is shown. */
  setPart(part: Heights | undefined): void {
    if (!part || !this.view) return;
    this.heights = part;
    this.view.stock.show(part);
    this.tint();
    this.sectionCard?.setPart(part);
    this.view.draw();
    // What a test, or a user's script, can see of the part.
    const { last } = part;
    let cut = 0;
    // Not `for … of`, which takes twenty times as long.
    for (let cell = 0; cell < last.length; cell += 1) if (last[cell]) cut += 1;
    byId("canvas").dataset.cut = String(cut);
    byId("canvas").dataset.faces = String(part.faces.length / 4);
    byId("canvas").dataset.shown = String(Number(byId("canvas").dataset.shown ?? 0) + 1);
  }

  /** Files of triangles that fixtures are made of, by their names. */
  setBodies(bodies: ReadonlyMap<string, Uint8Array>): void {
    this.view?.setBench(bodies);
  }

  /** Why there is no picture, as the compiler says it. */
  setTold(path: Path | undefined, told: string): void {
    if (!this.view) return;
    byId("part-told").textContent = path ? told.trim() : "";
    if (path) return this.tell(path.pieces === 0 ? say("noMoves") : "", "");
    this.tell(told ? say("noPath") : "", told);
  }

  /** `partComes`: the part at that moment is on its way. */
  setNow(path: Path | undefined, now: Now, partComes = false): void {
    const tool = path && this.cut?.tools[path.tool[Math.max(0, now.piece)] ?? 0];
    this.readout.show(path, now, tool);
    if (!path) return;
    this.view?.setTool(tool);
    this.view?.setNow(now.piece, now.share, placeOf(path, now), leaning(path, now.piece), partComes);
  }

  /** Marks the path of a line, and what its moves left on the part. */
  mark(line: number): void {
    this.view?.setMarked(line, line);
    const pieces = this.path && piecesOf(this.path, line);
    const [first, last] = pieces ? pieces.map((at) => this.path?.move[at] ?? -1) : [-1, -1];
    this.view?.stock.setMarked(first ?? -1, last ?? -1);
    byId("canvas").dataset.marked = String(line);
  }

  /** Brings the program to where a line is done. */
  runTo(line: number): void {
    const moves = this.path && piecesOf(this.path, line);
    this.player.playing.set(false);
    if (moves) this.player.endOf(moves[1]);
  }

  restyle(): void {
    this.view?.restyle();
    this.lookCard?.show();
  }

  draw(): void {
    this.view?.draw();
  }

  /** How long a picture takes, as far as it was timed, ms. */
  get lasts(): number {
    return this.view?.lasted ?? 0;
  }

  private open(): MachineView | undefined {
    const canvas = byId<HTMLCanvasElement>("canvas");
    const drawing = drawingOn(canvas);
    if (!drawing) return undefined;
    return new MachineView(canvas, drawing, {
      picked: (what, pixel) => {
        if (this.measureCard?.active) return this.measure(what, pixel);
        if (!what || !this.path) return this.mark(-1);
        const piece = "piece" in what ? what.piece : this.path.move.lastIndexOf(what.move);
        const line = this.path.line[piece];
        if (!line) return this.mark(-1);
        this.mark(line);
        this.player.playing.set(false);
        this.player.endOf(piece);
        this.picked(line);
      },
      drawn: (view) => {
        drawCompass(view.camera);
        byId("scale").textContent = this.scale(view);
        byId("frame-time").textContent = view.timed ? this.spent(view) : "";
        byId("canvas").dataset.frames = String(view.frames);
        byId("canvas").dataset.smoothed = String(view.smoothed);
        byId("canvas").dataset.fineness = `${view.stock.stride} ${view.paths.fineness}`;
        byId("canvas").dataset.middle = JSON.stringify(view.middle);
        byId("canvas").dataset.scale = String(view.scale);
      },
    });
  }

  /** What the picture shows: the grid's step, the cells of the part, and how far lines may be from the path where that is seen. */
  private scale(view: MachineView): string {
    const all = [say("grid", { size: view.step })];
    const { raw } = this.cut ?? {};
    if (raw) all.push(say("cells", { across: raw.cells[0], along: raw.cells[1], size: figure(raw.cell, 3) }));
    if (view.paths.fineness > 1) all.push(say("thinned", { size: figure(view.paths.fineness / 2, 0) }));
    return all.join(" · ");
  }

  private spent(view: MachineView): string {
    const spent = Math.max(view.spent, 0.1);
    return this.perSecond ? `${figure(1000 / spent, 0)} ${say("perSecond")}` : `${figure(spent, 1)} ms`;
  }

  private perSecond = false;

  /** The button that has each picture timed; a click on the figure changes between time and pictures a second. */
  private timing(view: MachineView): HTMLElement {
    const button = el("button", { id: "timing", class: "chip", "aria-pressed": "false" }, say("frameTime"));
    button.addEventListener("click", () => {
      view.timed = !view.timed;
      button.setAttribute("aria-pressed", String(view.timed));
      byId("frame-time").hidden = !view.timed;
      view.draw();
    });
    byId("frame-time").addEventListener("click", () => {
      this.perSecond = !this.perSecond;
      byId("frame-time").textContent = this.spent(view);
    });
    return button;
  }

  /** A place that was clicked while measuring. */
  private measure(what: Picked, pixel: [number, number]): void {
    const { view, cut, heights, path } = this;
    if (!view || !cut || !heights) return;
    const plane = planeOf(this.section);
    const keeps = (at: [number, number, number]) => at[0] * plane.x + at[1] * plane.y + at[2] * plane.z <= plane.w + 1e-6;
    const ends = what && "piece" in what && path ? endsOf(path, what.piece) : [];
    const met = meet(view.eye, pixel, cut, heights, keeps);
    const found = snap(view.eye, pixel, cut, heights, met, ends);
    if (found) this.measureCard?.take(found);
  }

  private recolour(): void {
    this.view?.setColouring(this.colouring);
    showLegend(this.colouring, this.path, this.cut);
    this.tint();
  }

  private tint(): void {
    const { view, path, heights, colouring, cut } = this;
    if (!view || !path || !heights) return;
    const tint = tintOf(colouring, path, heights.last);
    if (tint) view.stock.setTint(tint, tintOf(colouring, path, view.stock.faces.lasts) ?? tint);
    if (colouring === "depth") view.stock.setColouring(3, path.box.low[2], Math.max(path.box.high[2], cut?.raw.high[2] ?? 0));
    else view.stock.setColouring(colouring === "kind" ? 0 : colouring === "tool" || colouring === "operation" ? 1 : 2);
    view.draw();
  }

  /** Shows picture, plan, or both; one is always there. */
  private views(solid: boolean, plan: boolean): void {
    if (!solid && !plan) return;
    byId("picture").dataset.views = solid && plan ? "both" : plan ? "plan" : "solid";
    byId("plan").hidden = !plan;
    byId("view-3d").setAttribute("aria-pressed", String(solid));
    byId("view-2d").setAttribute("aria-pressed", String(plan));
    this.view?.resize();
    this.view?.fit();
    if (plan) this.view?.plan.fit();
  }

  private wire(): void {
    for (const button of document.querySelectorAll<HTMLElement>("[data-side]")) {
      button.addEventListener("click", () => this.view?.look(button.dataset.side as Side));
    }
    byId("fit").addEventListener("click", () => {
      this.view?.fit();
      this.view?.plan.fit();
    });
    const on = (id: string) => byId(id).getAttribute("aria-pressed") === "true";
    byId("view-3d").addEventListener("click", () => this.views(!on("view-3d"), on("view-2d")));
    byId("view-2d").addEventListener("click", () => this.views(on("view-3d"), !on("view-2d")));
    for (const button of document.querySelectorAll<HTMLElement>("#legend [data-kind]")) {
      button.id = `kind-${button.dataset.kind}`;
      wireToggle(button.id, (on) => {
        const bit = 1 << Number(button.dataset.kind);
        this.shown = on ? this.shown | bit : this.shown & ~bit;
        this.show();
      });
    }
    wireToggle("part", (on) => {
      this.part = on;
      this.view?.setStock(on && this.cut !== undefined);
    });
    wireToggle("future", (on) => {
      this.future = on;
      this.show();
    });
    const list = byId<HTMLSelectElement>("colouring");
    list.append(...COLOURINGS.map((value) => el("option", { value }, say(NAMES[value]))));
    list.addEventListener("change", () => {
      this.colouring = list.value as Colouring;
      this.recolour();
    });
    byId("canvas").addEventListener("keydown", (event) => this.key(event));
  }

  private show(): void {
    this.view?.paths.setShown(this.shown, this.future);
    this.view?.draw();
  }

  /** Keys while the picture has the focus: sides by their first digit, a fit, blocks by arrows. */
  private key(event: KeyboardEvent): void {
    const does: Record<string, () => void> = {
      "1": () => this.view?.look("iso"),
      "2": () => this.view?.look("top"),
      "3": () => this.view?.look("front"),
      "4": () => this.view?.look("right"),
      f: () => this.view?.fit(),
      " ": () => this.player.toggle(),
      ArrowRight: () => this.player.step(1),
      ArrowLeft: () => this.player.step(-1),
      "+": () => this.view?.zoom(1.25),
      "-": () => this.view?.zoom(0.8),
      "5": () => byId("view-2d").click(),
      x: () => this.sectionCard?.toggle(0),
      y: () => this.sectionCard?.toggle(1),
      z: () => this.sectionCard?.toggle(2),
      "[": () => this.sectionCard?.move(-1),
      "]": () => this.sectionCard?.move(1),
      "{": () => this.sectionCard?.move(-10),
      "}": () => this.sectionCard?.move(10),
      m: () => byId("measure-toggle").click(),
      Enter: () => this.measureCard?.active && this.measureCard.atTool(),
    };
    const one = does[event.key];
    if (!one || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    one();
  }

  private tell(head: string, text: string): void {
    const place = byId("picture-told");
    place.hidden = !head;
    (place.querySelector("strong") as HTMLElement).textContent = head;
    (place.querySelector("pre") as HTMLElement).textContent = text.trim();
  }
}

/** The page's colour of what is cut, as `#rrggbb`. */
function ownColour(): string {
  return getComputedStyle(document.documentElement).getPropertyValue("--part-cut").trim();
}
