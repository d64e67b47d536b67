// Columns of a path as curves that are no longer than a screen is wide: of each slice of time, its least and greatest value.

import type { Path } from "../engine/path";

export type Curve = [times: number[], values: number[]];

/** How many slices: two points each are more than a screen has pixels. */
const SLICES = 1200;

/** A curve of what moves have at their beginning and end. */
export function curve(path: Path, from: ArrayLike<number>, to: ArrayLike<number>): Curve {
  const { pieces, seconds, t0, t1 } = path;
  if (pieces <= SLICES) {
    const times: number[] = [];
    const values: number[] = [];
    for (let at = 0; at < pieces; at += 1) {
      times.push(t0[at] as number, t1[at] as number);
      values.push(from[at] as number, to[at] as number);
    }
    return [times, values];
  }
  return sliced(path, from, to, seconds / SLICES);
}

function sliced(path: Path, from: ArrayLike<number>, to: ArrayLike<number>, width: number): Curve {
  const times: number[] = [];
  const values: number[] = [];
  let slice = -1;
  let [low, high, rises] = [0, 0, true];
  const end = () => {
    if (slice < 0) return;
    const time = slice * width;
    times.push(time, time + width / 2);
    values.push(...(rises ? [low, high] : [high, low]));
  };
  for (let at = 0; at < path.pieces; at += 1) {
    const [a, b] = [from[at] as number, to[at] as number];
    const own = Math.floor((path.t1[at] as number) / width);
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
