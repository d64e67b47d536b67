// Where a ray meets the part, and which place near there is meant: the end of a move, the edge of a wall, the centre of a cell.

import { Vector3, type Camera } from "three";
import type { Cut, Heights } from "../engine/part";
import type { Path } from "../engine/path";

export type Point = [number, number, number];

export interface Snapped {
  at: Point;
  /** What it is: the end of a move, an edge, a cell. */
  kind: "end" | "edge" | "cell" | "typed" | "tool";
}

/** Pixels from which a place takes the pointer. */
const REACH = 10;
/** A wall is where heights of neighbours differ by so many cells: steeper than 56 degrees. */
const STEEP = 1.5;
/** Cells around a place that are looked through for a wall, at most. */
const AROUND = 24;

/** A view of the part: its camera, and the pixels of its picture. */
export interface Eye {
  camera: Camera;
  width: number;
  height: number;
}

/** A place in pixels of the picture. */
export function seenAt({ camera, width, height }: Eye, at: Point): [number, number] {
  const seen = new Vector3(...at).project(camera);
  return [((seen.x + 1) / 2) * width, ((1 - seen.y) / 2) * height];
}

/** The cell in which the ray under a pixel meets the part, and the place; nothing beside it. `keeps` are places that a section leaves. */
export function meet(eye: Eye, pixel: [number, number], { raw }: Cut, part: Heights, keeps: (at: Point) => boolean): { at: Point; cell: number } | undefined {
  const ends = [-1, 1].map((depth) =>
    new Vector3((pixel[0] / eye.width) * 2 - 1, 1 - (pixel[1] / eye.height) * 2, depth).unproject(eye.camera).toArray(),
  ) as [Point, Point];
  const [from, to] = ends;
  const [across, along] = raw.cells;
  const low: Point = raw.low;
  const high: Point = [low[0] + across * raw.cell, low[1] + along * raw.cell, raw.high[2] + 1e-6];
  const way = to.map((value, axis) => value - (from[axis] as number)) as Point;
  let [first, last] = [0, 1];
  for (const axis of [0, 1, 2] as const) {
    if (Math.abs(way[axis]) < 1e-12) {
      if (from[axis] < low[axis] || from[axis] > high[axis]) return undefined;
      continue;
    }
    const [a, b] = [(low[axis] - from[axis]) / way[axis], (high[axis] - from[axis]) / way[axis]];
    first = Math.max(first, Math.min(a, b));
    last = Math.min(last, Math.max(a, b));
  }
  if (first > last) return undefined;
  const place = (t: number) => from.map((value, axis) => value + (way[axis] as number) * t) as Point;
  // A quarter of a cell at a time, seen from above; straight down there is one step.
  const flat = Math.hypot(way[0], way[1]) * (last - first);
  const steps = Math.max(1, Math.ceil((flat / raw.cell) * 4));
  for (let step = 0; step <= steps; step += 1) {
    const at = place(first + ((last - first) * step) / steps);
    if (!keeps(at)) continue;
    const column = Math.min(across - 1, Math.max(0, Math.floor((at[0] - low[0]) / raw.cell)));
    const row = Math.min(along - 1, Math.max(0, Math.floor((at[1] - low[1]) / raw.cell)));
    const cell = row * across + column;
    const height = part.heights[cell] as number;
    if ((at[2] > height || part.hollows.has(cell, at[2])) && !(steps === 1 && height > low[2])) continue;
    const top: Point = steps === 1 ? [at[0], at[1], height] : at;
    return { at: top, cell };
  }
  return undefined;
}

/** The place that is meant near where a ray met the part. `ends` are ends of a move under the pointer. */
export function snap(eye: Eye, pixel: [number, number], cut: Cut, part: Heights, met: { at: Point; cell: number } | undefined, ends: Point[]): Snapped | undefined {
  const far = (at: Point) => {
    const [x, y] = seenAt(eye, at);
    return Math.hypot(x - pixel[0], y - pixel[1]);
  };
  // Of places over each other the one that the eye sees.
  const depth = (at: Point) => new Vector3(...at).project(eye.camera).z;
  const nearest = (places: Point[]) => {
    let [best, found]: [number, Point | undefined] = [REACH, undefined];
    for (const place of places) {
      const own = far(place);
      if (own < best - 0.25 || (found && own < best + 0.25 && depth(place) < depth(found))) [best, found] = [own, place];
    }
    return found;
  };
  const end = nearest(ends);
  if (end) return { at: end, kind: "end" };
  if (!met) return undefined;
  const edge = nearest(edges(cut, part, met.cell));
  if (edge) return { at: edge, kind: "edge" };
  const [x, y] = centre(cut, met.cell);
  const height = part.heights[met.cell] as number;
  // In a hollow the place itself is meant.
  const under = part.hollows.of(met.cell);
  return { at: [x, y, under[0] < under[1] && met.at[2] < height ? met.at[2] : height], kind: "cell" };
}

function centre({ raw }: Cut, cell: number): [number, number] {
  const [across] = raw.cells;
  return [raw.low[0] + ((cell % across) + 0.5) * raw.cell, raw.low[1] + (Math.floor(cell / across) + 0.5) * raw.cell];
}

/** Places on the edges of walls around a cell, above and below. */
function edges(cut: Cut, part: Heights, cell: number): Point[] {
  const { raw } = cut;
  const [across, along] = raw.cells;
  const [column, row] = [cell % across, Math.floor(cell / across)];
  const height = (x: number, y: number) => {
    // Beside the part lies nothing: its border is a wall.
    const inside = x >= 0 && y >= 0 && x < across && y < along;
    return inside ? Math.max(raw.low[2], part.heights[y * across + x] as number) : raw.low[2];
  };
  const found: Point[] = [];
  for (let y = Math.max(-1, row - AROUND); y <= Math.min(along - 1, row + AROUND); y += 1) {
    for (let x = Math.max(-1, column - AROUND); x <= Math.min(across - 1, column + AROUND); x += 1) {
      const own = height(x, y);
      const [right, behind] = [height(x + 1, y), height(x, y + 1)];
      const border: [number, number] = [raw.low[0] + (x + 1) * raw.cell, raw.low[1] + (y + 1) * raw.cell];
      const middle: [number, number] = [border[0] - raw.cell / 2, border[1] - raw.cell / 2];
      if (Math.abs(own - right) > STEEP * raw.cell) found.push([border[0], middle[1], own], [border[0], middle[1], right]);
      if (Math.abs(own - behind) > STEEP * raw.cell) found.push([middle[0], border[1], own], [middle[0], border[1], behind]);
    }
  }
  return found;
}

/** Start and end of a piece. */
export function endsOf(path: Path, piece: number): Point[] {
  const at = (...columns: Float32Array[]) => columns.map((column) => column[piece] ?? 0) as Point;
  return [at(path.x0, path.y0, path.z0), at(path.x1, path.y1, path.z1)];
}
