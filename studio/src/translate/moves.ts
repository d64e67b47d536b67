// The moves of two programs held against each other: the differences that the verb `diff` finds, as a list whose rows lead to
// their places, and both ways seen from above, one over the other.

import type { Answer } from "../engine/engine";
import { isRapid, readPath, type Path } from "../engine/path";
import type { Desk } from "../projects/desk";
import type { Other, Session } from "../session";
import { byId, el } from "../ui/dom";
import { say } from "../ui/texts";

interface Block {
  line: number;
  text: string;
}

interface Difference {
  kind: string;
  title: string;
  a: Block[];
  b: Block[];
}

/** Of the verb `diff`. */
interface Document {
  equal: boolean;
  summary: string;
  differences: Difference[];
  not_listed: number;
}

const TRANSLATION = "";

export class MovesPane {
  private readonly list = byId<HTMLSelectElement>("moves-other");
  private readonly canvas = byId<HTMLCanvasElement>("moves-picture");
  private paths: [Path | undefined, Path | undefined] = [undefined, undefined];
  private shown: Difference | undefined;
  private asked = 0;

  constructor(
    private readonly session: Session,
    private readonly desk: Desk,
    private readonly translated: () => Other | undefined,
    /** Goes to lines of the program, and of the translation where that is the other one. */
    private readonly goTo: (line: number | undefined, other: number | undefined) => void,
  ) {
    byId("moves-compare").addEventListener("click", () => void this.compare());
    byId("moves-box").addEventListener("toggle", () => void this.fill());
    session.project.on(() => this.clear());
    session.translation.on(() => this.clear());
    session.idle.on((idle) => !idle && this.clear());
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  /** The colours are others. */
  draw(): void {
    const pen = this.canvas.getContext("2d");
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    if (!pen || width === 0 || this.canvas.hidden) return;
    [this.canvas.width, this.canvas.height] = [width * devicePixelRatio, height * devicePixelRatio];
    pen.scale(devicePixelRatio, devicePixelRatio);
    const style = getComputedStyle(document.documentElement);
    const ink = (name: string) => style.getPropertyValue(name).trim();
    const place = placing(this.paths, width, height);
    const marked = [new Set(this.shown?.a.map((one) => one.line)), new Set(this.shown?.b.map((one) => one.line))];
    for (const [side, path] of this.paths.entries()) {
      if (!path) continue;
      const own = ink(side === 0 ? "--c-move-feed" : "--c-move-clockwise");
      trace(pen, path, place, own, side === 0 ? 4 : 1.4, () => true);
      const lines = marked[side] as Set<number>;
      if (lines.size > 0) trace(pen, path, place, ink("--mark"), 4, (line) => lines.has(line));
    }
  }

  private clear(): void {
    this.asked += 1;
    this.paths = [undefined, undefined];
    this.shown = undefined;
    this.canvas.hidden = true;
    byId("moves-legend").hidden = true;
    byId("moves-told").textContent = "";
    byId("moves-list").replaceChildren();
  }

  /** The programs that there are to choose from. */
  private async fill(): Promise<void> {
    const others = await this.desk.otherPrograms();
    const chosen = this.list.value;
    const options = others.map(([id, name]) => el("option", { value: id }, name));
    this.list.replaceChildren(el("option", { value: TRANSLATION }, say("translation")), ...options);
    if (others.some(([id]) => id === chosen)) this.list.value = chosen;
  }

  private async other(): Promise<Other | undefined> {
    const id = this.list.value;
    if (id === TRANSLATION) return this.translated();
    const found = await this.desk.otherFile(id);
    return found && { name: `other-${found[0]}`, bytes: found[1], from: found[2], machine: "", options: {} };
  }

  private async compare(): Promise<void> {
    this.clear();
    const own = this.asked;
    const place = byId("moves-told");
    const other = await this.other();
    if (!other) return void (place.textContent = say("noTranslation"));
    place.textContent = say("working");
    const answers = await this.session.compareMoves(other);
    if (own !== this.asked) return;
    if (!answers) return void (place.textContent = "");
    this.show(answers, this.list.value === TRANSLATION);
  }

  private show([diff, path]: [Answer, Answer], isTranslation: boolean): void {
    const place = byId("moves-told");
    const document = diff.json<Document>("document");
    if (!document) return void (place.textContent = diff.text("messages").trim());
    const more = document.not_listed > 0 ? ` (+${document.not_listed})` : "";
    place.textContent = document.equal ? say("movesSame") : `${document.summary}${more}`;
    const rows = document.differences.map((one) => el("li", {}, this.row(one, isTranslation)));
    byId("moves-list").replaceChildren(...rows);
    const bytes = path.bytes("path");
    this.paths = [this.session.path.get(), bytes && readPath(bytes, undefined)];
    this.canvas.hidden = false;
    byId("moves-legend").hidden = false;
    this.canvas.setAttribute("aria-label", `${say("movesOverlaid")}: ${place.textContent}`);
    this.draw();
  }

  private row(one: Difference, isTranslation: boolean): HTMLElement {
    const [a, b] = [one.a[0], one.b[0]];
    const text = (block: Block | undefined) => (block ? `${block.line} │ ${block.text}` : "–");
    const does = () => {
      this.shown = one;
      this.draw();
      this.goTo(a?.line, isTranslation ? b?.line : undefined);
    };
    return el(
      "button",
      { onclick: does, "data-line": a?.line ?? 0 },
      el("b", {}, one.title),
      el("span", { class: "place" }, text(a)),
      el("span", { class: "place" }, text(b)),
    );
  }
}

/** Where X and Y of both ways lie on a picture of this size. */
function placing(paths: (Path | undefined)[], width: number, height: number): (x: number, y: number) => [number, number] {
  const [low, high] = [[Infinity, Infinity], [-Infinity, -Infinity]] as [[number, number], [number, number]];
  for (const path of paths) {
    for (const axis of [0, 1] as const) {
      low[axis] = Math.min(low[axis], path?.box.low[axis] ?? Infinity);
      high[axis] = Math.max(high[axis], path?.box.high[axis] ?? -Infinity);
    }
  }
  const margin = 12;
  const scale = Math.min((width - 2 * margin) / (high[0] - low[0] || 1), (height - 2 * margin) / (high[1] - low[1] || 1));
  const left = (width - (high[0] - low[0]) * scale) / 2;
  const bottom = (height - (high[1] - low[1]) * scale) / 2;
  return (x, y) => [left + (x - low[0]) * scale, height - bottom - (y - low[1]) * scale];
}

function trace(
  pen: CanvasRenderingContext2D,
  path: Path,
  place: (x: number, y: number) => [number, number],
  ink: string,
  width: number,
  of: (line: number) => boolean,
): void {
  pen.strokeStyle = ink;
  for (const rapid of [true, false]) {
    pen.beginPath();
    for (let at = 0; at < path.pieces; at += 1) {
      if (isRapid(path.kind[at]) !== rapid || !of(path.line[at] ?? 0)) continue;
      pen.moveTo(...place(path.x0[at] ?? 0, path.y0[at] ?? 0));
      pen.lineTo(...place(path.x1[at] ?? 0, path.y1[at] ?? 0));
    }
    pen.lineWidth = rapid ? 1 : width;
    pen.setLineDash(rapid ? [3, 3] : []);
    pen.stroke();
  }
}
