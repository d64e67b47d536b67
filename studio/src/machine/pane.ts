// The machine's pane: the picture where WebGL 2 is, its buttons, and what stands over it.

import { movesOf, type Path } from "../engine/path";
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
  private shown = 15;
  private future = true;

  constructor(
    private readonly player: Player,
    private readonly picked: (line: number) => void,
  ) {
    this.view = hasWebgl() ? this.open() : undefined;
    this.wire();
    if (!this.view) this.tell(say("noWebgl"), "");
  }

  setPath(path: Path | undefined, told: string): void {
    const again = this.path !== undefined;
    this.path = path;
    this.view?.setPath(path, again);
    byId("canvas").dataset.moves = String(path?.moves ?? 0);
    this.setTold(path, told);
    this.setNow(path, this.player.now.get());
  }

  /** Why there is no picture, as the compiler says it. */
  setTold(path: Path | undefined, told: string): void {
    if (!this.view) return;
    if (path) return path.moves === 0 ? this.tell(say("noMoves"), "") : this.tell("", "");
    if (told) this.tell(say("noPath"), told);
    else this.tell("", "");
  }

  setNow(path: Path | undefined, now: Now): void {
    this.readout.show(path, now);
    if (path) this.view?.setNow(now.move, now.share, placeOf(path, now));
  }

  /** Marks the path of a line. */
  mark(line: number): void {
    this.view?.setMarked(line, line);
    byId("canvas").dataset.marked = String(line);
  }

  /** Brings the program to where a line is done. */
  runTo(line: number): void {
    const moves = this.path && movesOf(this.path, line);
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
      picked: (move) => {
        const line = move >= 0 ? this.path?.line[move] : undefined;
        if (line === undefined) return this.mark(-1);
        this.mark(line);
        this.player.playing.set(false);
        this.player.endOf(move);
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
