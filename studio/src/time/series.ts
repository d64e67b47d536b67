// Columns of a path as curves that are no longer than a screen is wide: of each slice of time, its least and greatest value.

import type { Path } from "../engine/path";

export type Curve = [times: number[], values: number[]];

/** How many slices: two points each are more than a screen has pixels. */
const SLICES = 1200;

/** When the last move is over, and the spindle has run down. */
function endOf(path: Path): number {
  return Math.max(path.seconds, path.modes?.runs.at(-1)?.to ?? 0);
}

/** A curve of what moves have at their beginning and end; behind the last one is `rest`, or what that had. */
export function curve(path: Path, from: ArrayLike<number>, to: ArrayLike<number>, rest?: number): Curve {
  const [times, values] = ofMoves(path, from, to);
  const end = endOf(path);
  if (end > path.seconds) {
    const last = rest ?? values.at(-1) ?? 0;
    times.push(path.seconds, end);
    values.push(last, last);
  }
  return [times, values];
}

function ofMoves(path: Path, from: ArrayLike<number>, to: ArrayLike<number>): Curve {
  const { pieces, seconds, t0, t1 } = path;
  if (pieces <= SLICES) {
    // All curves begin with the program, so that they have one axis: a spindle runs up before the first move.
    const times: number[] = [0];
    const values: number[] = [from[0] as number];
    for (let at = 0; at < pieces; at += 1) {
      times.push(t0[at] as number, t1[at] as number);
      values.push(from[at] as number, to[at] as number);
    }
    return [times, values];
  }
  return sliced(path, from, to, seconds / SLICES);
}

/** So many changes of speed are drawn one by one; more of them stand as any other column. */
const MOST_RUNS = 4 * SLICES;

/**
 * The spindle's speed: what each move has, and between two of them the runs to another speed, which are slopes where it is
 * stated how long the spindle runs up and down, and steps elsewhere.
 */
export function spindle(path: Path): Curve {
  const runs = path.modes?.runs ?? [];
  const times: number[] = [];
  const values: number[] = [];
  const put = (time: number, value: number) => {
    times.push(Math.max(time, times.at(-1) ?? 0));
    values.push(value);
  };
  put(0, Math.abs(runs[0]?.before ?? path.speed[0] ?? 0));
  let next = 0;
  for (let at = 0; at <= path.pieces; at += 1) {
    const begins = at < path.pieces ? (path.t0[at] as number) : Infinity;
    for (let run = runs[next]; run && run.from <= begins; run = runs[next]) {
      next += 1;
      put(run.from, values.at(-1) ?? 0);
      put(run.from, Math.abs(run.before));
      // It stands still where it turns the other way.
      const share = run.before / (run.before - run.after);
      if (run.before * run.after < 0) put(run.from + (run.to - run.from) * share, 0);
      put(run.to, Math.abs(run.after));
    }
    if (at === path.pieces) break;
    const speed = path.speed[at] as number;
    if (speed !== values.at(-1)) {
      put(begins, values.at(-1) ?? 0);
      put(begins, speed);
    }
    if (times.length > MOST_RUNS) return curve(path, path.speed, path.speed);
  }
  put(endOf(path), values.at(-1) ?? 0);
  return [times, values];
}

function sliced(path: Path, from: ArrayLike<number>, to: ArrayLike<number>, width: number): Curve {
  const times: number[] = [0];
  const values: number[] = [from[0] as number];
  let slice = -1;
  let [low, high, rises] = [0, 0, true];
  const end = () => {
    if (slice < 0) return;
    // Times never go back: a slice may begin before the end of what stands for itself.
    const time = Math.max(slice * width, times.at(-1) ?? 0);
    times.push(time, Math.max(time, (slice + 0.5) * width));
    values.push(...(rises ? [low, high] : [high, low]));
  };
  for (let at = 0; at < path.pieces; at += 1) {
    const [a, b] = [from[at] as number, to[at] as number];
    const [begins, ends] = [path.t0[at] as number, path.t1[at] as number];
    // What is longer than a slice stands for itself.
    if (ends - begins > width) {
      end();
      slice = -1;
      times.push(begins, ends);
      values.push(a, b);
      continue;
    }
    const own = Math.floor(ends / width);
    if (own !== slice) {
      end();
      slice = own;
      [low, high, rises] = [Math.min(a, b), Math.max(a, b), b >= a];
    } else {
      low = Math.min(low, a, b);
      high = Math.max(high, a, b);
    }
  }
  end();
  times.push(path.seconds);
  values.push(to[path.pieces - 1] as number);
  return [times, values];
}
