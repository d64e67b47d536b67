// Moves that follow each other merged into one line, where a picture shows no difference: Douglas-Peucker inside blocks of moves that
// look alike. All of it is done in typed arrays, as a program may have millions of moves.

import type { Path } from "../engine/path";

/** A run has so many pieces at most, and takes such a share of all time, which may colour it. */
const [LONGEST, SHARE] = [256, 1 / 64];

/** Gives the first pieces of runs whose points are all at most `tolerance` mm from the line from end to end; a tolerance of 0 leaves each
 * piece alone. Pieces of a run are of one kind and tool, and their feeds are at most `slack` mm/min apart. More runs than `most` give
 * nothing. */
export function runsOf(path: Path, tolerance: number, most = Infinity, slack = 0): Uint32Array | undefined {
  const { pieces } = path;
  const firsts = new Uint32Array(Math.min(pieces, most));
  const ends = new Uint32Array(LONGEST + 1);
  let runs = 0;
  for (let from = 0; from < pieces; ) {
    const end = tolerance > 0 ? blockEnd(path, from, slack) : from + 1;
    // Ends of runs that are not known to be straight enough yet, the nearest on top.
    ends[0] = end;
    for (let open = 1; open > 0; ) {
      const to = ends[open - 1] as number;
      const split = farthest(path, from, to, tolerance);
      if (split > 0) {
        ends[open] = split;
        open += 1;
        continue;
      }
      if (runs === firsts.length) return undefined;
      firsts[runs] = from;
      runs += 1;
      from = to;
      open -= 1;
    }
  }
  return firsts.slice(0, runs);
}

/** First pieces of so many at a time. */
export function evenly(pieces: number, every: number): Uint32Array {
  const firsts = new Uint32Array(Math.ceil(pieces / every));
  for (let at = 0; at < firsts.length; at += 1) firsts[at] = at * every;
  return firsts;
}

/** The end of the pieces from one on that look alike, each of which begins where the one before ended. */
function blockEnd(path: Path, first: number, slack: number): number {
  const { kind, tool, feed, t0, x0, y0, z0, x1, y1, z1 } = path;
  const [ownKind, ownTool, until] = [kind[first], tool[first], (t0[first] as number) + path.seconds * SHARE];
  const limit = Math.min(path.pieces, first + LONGEST);
  let low = feed[first] as number;
  let high = low;
  let at = first + 1;
  for (; at < limit; at += 1) {
    if (kind[at] !== ownKind || tool[at] !== ownTool || (t0[at] as number) > until) break;
    if (x0[at] !== x1[at - 1] || y0[at] !== y1[at - 1] || z0[at] !== z1[at - 1]) break;
    const own = feed[at] as number;
    if (own < low) low = own;
    if (own > high) high = own;
    if (high - low > slack) break;
  }
  return at;
}

/** The piece behind the point that is farthest from the line of a run; 0 where none is too far. A line ends, so that a way there and
 * back is too far from it. */
function farthest(path: Path, from: number, to: number, tolerance: number): number {
  if (to - from < 2) return 0;
  const { x1, y1, z1 } = path;
  const x = path.x0[from] as number;
  const y = path.y0[from] as number;
  const z = path.z0[from] as number;
  const dx = (x1[to - 1] as number) - x;
  const dy = (y1[to - 1] as number) - y;
  const dz = (z1[to - 1] as number) - z;
  const square = dx * dx + dy * dy + dz * dz;
  const inverse = square > 0 ? 1 / square : 0;
  let worst = tolerance * tolerance;
  let found = 0;
  for (let at = from; at < to - 1; at += 1) {
    const px = (x1[at] as number) - x;
    const py = (y1[at] as number) - y;
    const pz = (z1[at] as number) - z;
    const along = (px * dx + py * dy + pz * dz) * inverse;
    const share = along < 0 ? 0 : along > 1 ? 1 : along;
    const ex = px - dx * share;
    const ey = py - dy * share;
    const ez = pz - dz * share;
    const far = ex * ex + ey * ey + ez * ez;
    if (far <= worst) continue;
    worst = far;
    found = at + 1;
  }
  return found;
}
