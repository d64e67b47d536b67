// What the colours of path and part mean: swatches of tools and operations, or a scale with its ends.

import type { Cut } from "../engine/part";
import type { Path } from "../engine/path";
import { byId, el } from "../ui/dom";
import { clock, figure, say } from "../ui/texts";
import { Operations, ranges, type Colouring } from "./paths";

/** Swatches at most. */
const MOST = 12;

/** Shows the legend of a colouring; none where colours are those of the buttons above. */
export function showLegend(by: Colouring, path: Path | undefined, cut: Cut | undefined): void {
  const place = byId("colours");
  place.replaceChildren();
  place.hidden = by === "kind" || !path || path.pieces === 0;
  if (place.hidden || !path) return;
  const range = ranges(path);
  const unit = cut?.units === "inch" ? 25.4 : 1;
  const length = unit === 1 ? "mm" : say("inch");
  const digits = unit === 1 ? 0 : 1;
  switch (by) {
    case "feed":
      return place.append(...scale(`${say("feed")}, ${length}/min`, figure(range.x / unit, digits), figure(range.y / unit, digits)));
    case "depth":
      return place.append(...scale(`Z, ${length}`, figure(range.z / unit, digits + 2), figure(range.w / unit, digits + 2)));
    case "time":
      return place.append(...scale(say("time"), clock(0), clock(path.seconds)));
    case "tool":
    case "operation":
      return place.append(...swatches(by, path, cut));
  }
}

function scale(name: string, low: string, high: string): HTMLElement[] {
  return [el("span", {}, name), el("div", { class: "scale" }), el("div", { class: "ends" }, el("span", {}, low), el("span", {}, high))];
}

function swatches(by: "tool" | "operation", path: Path, cut: Cut | undefined): HTMLElement[] {
  const named = (tool: number) => {
    const number = cut?.tools[tool]?.number;
    return number === null || number === undefined ? "T–" : `T${number}`;
  };
  const rows: HTMLElement[] = [];
  const add = (at: number, text: string) => rows.push(el("span", { class: "swatch" }, el("i", { class: `band band-${at % 8}` }), text));
  if (by === "tool") cut?.tools.forEach((_, at) => add(at, named(at)));
  else {
    const operations = new Operations(path);
    let last = -1;
    for (let piece = 0; piece < path.pieces; piece += 1) {
      const own = operations.at(piece);
      if (own !== last) add(own, `${own + 1}: ${named(path.tool[piece] ?? 0)}`);
      last = own;
    }
  }
  const more = rows.length - MOST;
  return more > 0 ? [...rows.slice(0, MOST), el("span", { class: "dim" }, `+ ${more}`)] : rows;
}

/** The tint of each cell, by the move that cut it last; `undefined` where the colouring needs none. */
export function tintOf(by: Colouring, path: Path, last: Uint32Array): Uint8Array | undefined {
  if (by === "kind" || by === "depth") return undefined;
  const moves = path.move[path.pieces - 1] ?? 0;
  const ofMove = new Uint8Array(moves + 1);
  const range = ranges(path);
  const operations = new Operations(path);
  const share = (value: number) => Math.round(255 * Math.min(1, Math.max(0, value)));
  for (let piece = 0; piece < path.pieces; piece += 1) {
    const to = path.move[piece] as number;
    if (by === "tool") ofMove[to] = (path.tool[piece] as number) % 8;
    else if (by === "operation") ofMove[to] = operations.at(piece) % 8;
    else if (by === "feed") ofMove[to] = share(((path.feed[piece] as number) - range.x) / Math.max(range.y - range.x, 1e-6));
    else ofMove[to] = share((path.t0[piece] as number) / Math.max(path.seconds, 1e-6));
  }
  const tint = new Uint8Array(last.length);
  for (let cell = 0; cell < tint.length; cell += 1) tint[cell] = ofMove[last[cell] as number] as number;
  return tint;
}
