// The machine's pane: the picture where WebGL 2 is, its buttons, and what stands over it.

import type { Cut, Heights } from "../engine/part";
import { piecesOf, type Path } from "../engine/path";
import { placeOf, type Now, type Player } from "../time/player";
import { byId, el } from "../ui/dom";
import { wireToggle } from "../ui/layout";
import { say } from "../ui/texts";
import type { Colouring } from "./paths";
import { Readout, drawCompass } from "./readout";
import { MachineView, hasWebgl, type Side } from "./view";

const COLOURINGS = [
  ["kind", "byKind"],
  ["tool", "byTool"],
  ["feed", "byFeed"],
  ["depth", "byDepth"],
] as const;

export class MachinePane {
  private readonly view: MachineView | undefined;
  private readonly readout = new Readout();
  private path: Path | undefined;
  private cut: Cut | undefined;
  /** Place of the tool of each move. */
  private tools = new Uint16Array();
  private shown = 15;
  private future = true;
  private part = true;

  constructor(
    private readonly player: Player,
    private readonly picked: (line: number) => void,
  ) {
    this.view = hasWebgl() ? this.open() : undefined;
    this.wire();
    if (!this.view) this.tell(say("noWebgl"), "");
  }

  setPath(path: Path | undefined, cut: Cut | undefined, told: string): void {
    const again = this.path !== undefined;
    this.path = path;
    this.cut = cut;
    this.tools = new Uint16Array((path?.move[path.pieces - 1] ?? 0) + 1);
    for (let at = 0; at < (path?.pieces ?? 0); at += 1) this.tools[path?.move[at] ?? 0] = path?.tool[at] ?? 0;
    this.view?.setPath(path, cut, again);
    this.view?.stock.setVisible(this.part && cut !== undefined);
    byId("canvas").dataset.pieces = String(path?.pieces ?? 0);
    this.setTold(path, told);
    this.setNow(path, this.player.now.get());
  }

  /** The part at the moment that is shown. */
  setPart(part: Heights | undefined): void {
    if (!part || !this.view) return;
    this.view.stock.show(part, (move) => this.tools[move] ?? 0);
    this.view.draw();
    // What a test, or a user's script, can see of the part.
    byId("canvas").dataset.cut = String(part.last.reduce((count, move) => count + Number(move > 0), 0));
  }

  /** Why there is no picture, as the compiler says it. */
  setTold(path: Path | undefined, told: string): void {
    if (!this.view) return;
    byId("part-told").textContent = path ? told.trim() : "";
    if (path) return this.tell(path.pieces === 0 ? say("noMoves") : "", "");
    this.tell(told ? say("noPath") : "", told);
  }

  setNow(path: Path | undefined, now: Now): void {
    const tool = path && this.cut?.tools[path.tool[Math.max(0, now.piece)] ?? 0];
    this.readout.show(path, now, tool);
    if (!path) return;
    this.view?.setTool(tool);
    this.view?.setNow(now.piece, now.share, placeOf(path, now));
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
  }

  draw(): void {
    this.view?.draw();
  }

  private open(): MachineView {
    return new MachineView(byId<HTMLCanvasElement>("canvas"), {
      picked: (what) => {
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
        byId("scale").textContent = say("grid", { size: view.step });
        byId("canvas").dataset.frames = String(view.frames);
      },
    });
  }

  private wire(): void {
    for (const button of document.querySelectorAll<HTMLElement>("[data-side]")) {
      button.addEventListener("click", () => this.view?.look(button.dataset.side as Side));
    }
    byId("fit").addEventListener("click", () => this.view?.fit());
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
      this.view?.stock.setVisible(on && this.cut !== undefined);
      this.view?.draw();
    });
    wireToggle("future", (on) => {
      this.future = on;
      this.show();
    });
    const list = byId<HTMLSelectElement>("colouring");
    list.append(...COLOURINGS.map(([value, text]) => el("option", { value }, say(text))));
    list.addEventListener("change", () => this.view?.setColouring(list.value as Colouring));
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
