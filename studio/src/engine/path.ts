// The moves of a program as columns, each a typed array: what the verb `path` gives. Never one object a move.
//
//     {"moves":2,"columns":[["kind","u8",0],["line","u32",4],…]}    a line of JSON, then the columns
//
// Offsets count from the byte behind the line. Lengths are mm in machine coordinates, times seconds, feeds mm/min.

/** Kinds of moves. */
export const enum Kind {
  Rapid = 0,
  Feed = 1,
  /** A straight piece of an arc, clockwise. */
  Clockwise = 2,
  /** A straight piece of an arc, counter-clockwise. */
  Counterclockwise = 3,
}

/** Names and types of the columns. */
const COLUMNS = {
  kind: Uint8Array,
  line: Uint32Array,
  x0: Float32Array,
  y0: Float32Array,
  z0: Float32Array,
  x1: Float32Array,
  y1: Float32Array,
  z1: Float32Array,
  t0: Float64Array,
  t1: Float64Array,
  feed: Float32Array,
  spindle: Float32Array,
  tool: Uint16Array,
};

type Columns = { readonly [Name in keyof typeof COLUMNS]: InstanceType<(typeof COLUMNS)[Name]> };

/** The moves, in the order of their times. */
export interface Path extends Columns {
  readonly moves: number;
  /** When the program is over. */
  readonly seconds: number;
  /** Corners of the box around all ends, and around those of feed moves where there are any. */
  readonly box: Box;
}

export interface Box {
  readonly low: readonly [number, number, number];
  readonly high: readonly [number, number, number];
}

interface Head {
  moves: number;
  columns: { name: string; type: string; offset: number }[];
}

/** Reads the output of the verb. */
export function readPath(bytes: Uint8Array): Path {
  const end = bytes.indexOf(10);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end))) as Head;
  const found: Record<string, unknown> = {};
  for (const [name, Type] of Object.entries(COLUMNS)) {
    const column = head.columns.find((one) => one.name === name);
    if (!column) throw new Error(`path: no column ${name}`);
    const at = end + 1 + column.offset;
    // A copy begins where its type may.
    found[name] = new Type(bytes.slice(at, at + head.moves * Type.BYTES_PER_ELEMENT).buffer);
  }
  const columns = found as unknown as Columns;
  const seconds = head.moves > 0 ? (columns.t1[head.moves - 1] ?? 0) : 0;
  return { ...columns, moves: head.moves, seconds, box: boxOf(columns, head.moves) };
}

function boxOf(columns: Columns, moves: number): Box {
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  const feeds = columns.kind.some((kind) => kind !== Kind.Rapid);
  const sides = [
    [columns.x0, columns.x1],
    [columns.y0, columns.y1],
    [columns.z0, columns.z1],
  ] as const;
  for (const [axis, [from, to]] of sides.entries()) {
    for (let at = 0; at < moves; at += 1) {
      if (feeds && columns.kind[at] === Kind.Rapid) continue;
      const [a, b] = [from[at] ?? 0, to[at] ?? 0];
      low[axis] = Math.min(low[axis] as number, a, b);
      high[axis] = Math.max(high[axis] as number, a, b);
    }
  }
  return moves > 0 ? { low, high } : { low: [0, 0, 0], high: [100, 100, 0] };
}

/** The move at a time: the last that has begun; -1 before all. */
export function moveAt(path: Path, time: number): number {
  let [low, high] = [0, path.moves];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((path.t0[middle] as number) <= time) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** How much of a move is done at a time, 0 to 1. */
export function shareAt(path: Path, move: number, time: number): number {
  const [from, to] = [path.t0[move] ?? 0, path.t1[move] ?? 0];
  return to > from ? Math.min(1, Math.max(0, (time - from) / (to - from))) : 1;
}

/** First and last move of the first pass through a line; nothing where it moves nothing. */
export function movesOf(path: Path, line: number): [number, number] | undefined {
  const first = path.line.indexOf(line);
  if (first < 0) return undefined;
  let last = first;
  while (last + 1 < path.moves && path.line[last + 1] === line) last += 1;
  return [first, last];
}
