// The moves of a program as columns, each a typed array: what the verbs `path` and `simulate` give. Never one object a move.
//
//     {"pieces":2,"columns":[{"name":"t0","type":"f64","offset":0},…]}    a line of JSON, then the columns
//
// Offsets count from the byte behind the line. A piece is a straight move, or as much of an arc as a picture needs. Lengths
// are mm in coordinates of the part, times seconds, feeds mm/min, speeds rev/min.

import { Modes } from "./modes";

/** Kinds of pieces. */
export const enum Kind {
  Rapid = 0,
  Feed = 1,
  /** A piece of an arc, clockwise. */
  Clockwise = 2,
  /** A piece of an arc, counter-clockwise. */
  Counterclockwise = 3,
  /** A rapid move to an unknown height. */
  Away = 4,
}

/** Names and types of the columns. */
const COLUMNS = {
  kind: Uint8Array,
  /** Counted from 1; 0 if not known. */
  line: Uint32Array,
  /** Number of the move, counted from 1. */
  move: Uint32Array,
  x0: Float32Array,
  y0: Float32Array,
  z0: Float32Array,
  x1: Float32Array,
  y1: Float32Array,
  z1: Float32Array,
  t0: Float64Array,
  t1: Float64Array,
  feed: Float32Array,
  speed: Float32Array,
  /** Place of the tool in the list of tools. */
  tool: Uint16Array,
};

type Columns = { readonly [Name in keyof typeof COLUMNS]: InstanceType<(typeof COLUMNS)[Name]> };

/** The pieces, in the order of their times. */
export interface Path extends Columns {
  readonly pieces: number;
  /** When the last one is over. */
  readonly seconds: number;
  /** Corners of the box around what cuts, or around all where nothing does. */
  readonly box: Box;
  /** What is active in its blocks and moves. */
  readonly modes: Modes | undefined;
  /** Of each piece 0, or the number of the tilted plane on which the tool stands, from 1; of a path without any, nothing. */
  readonly tilt: Uint16Array | undefined;
  /** The axes of the tilted planes: the rows of a matrix, whose third column is the direction of the tool, from its tip. */
  readonly tilts: readonly (readonly number[])[];
}

/** The direction of the tool in a piece, from its tip. */
export function leaning(path: Path, piece: number): [number, number, number] {
  const axes = path.tilts[(path.tilt?.[piece] ?? 0) - 1];
  return axes ? [axes[2] as number, axes[5] as number, axes[8] as number] : [0, 0, 1];
}

export interface Box {
  readonly low: readonly [number, number, number];
  readonly high: readonly [number, number, number];
}

interface Head {
  pieces: number;
  columns: { name: string; type: string; offset: number }[];
  tilts?: number[][];
}

/** Whether a kind does not cut. */
export function isRapid(kind: number | undefined): boolean {
  return kind === Kind.Rapid || kind === Kind.Away;
}

/** Reads the outputs `path` and `modes`. */
export function readPath(bytes: Uint8Array, modes: Uint8Array | undefined): Path {
  const end = bytes.indexOf(10);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end))) as Head;
  const found: Record<string, unknown> = {};
  const read = (name: string, Type: (typeof COLUMNS)[keyof typeof COLUMNS]) => {
    const column = head.columns.find((one) => one.name === name);
    if (!column) return undefined;
    const at = end + 1 + column.offset;
    // Columns begin where their type may, so that they are read in place; of an answer that does not, in a copy.
    const fits = (bytes.byteOffset + at) % Type.BYTES_PER_ELEMENT === 0;
    const [buffer, from] = fits ? [bytes.buffer, bytes.byteOffset + at] : [bytes.slice(at, at + head.pieces * Type.BYTES_PER_ELEMENT).buffer, 0];
    return new Type(buffer as ArrayBuffer, from, head.pieces);
  };
  for (const [name, Type] of Object.entries(COLUMNS)) {
    found[name] = read(name, Type);
    if (!found[name]) throw new Error(`path: no column ${name}`);
  }
  const tilt = read("tilt", Uint16Array) as Uint16Array | undefined;
  const columns = found as unknown as Columns;
  const seconds = head.pieces > 0 ? (columns.t1[head.pieces - 1] ?? 0) : 0;
  return { ...columns, pieces: head.pieces, seconds, box: boxOf(columns, head.pieces), modes: modes && new Modes(modes), tilt, tilts: head.tilts ?? [] };
}

function boxOf(columns: Columns, pieces: number): Box {
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  const cuts = columns.kind.some((kind) => !isRapid(kind));
  const sides = [
    [columns.x0, columns.x1],
    [columns.y0, columns.y1],
    [columns.z0, columns.z1],
  ] as const;
  for (const [axis, [from, to]] of sides.entries()) {
    for (let at = 0; at < pieces; at += 1) {
      if (cuts && isRapid(columns.kind[at])) continue;
      const [a, b] = [from[at] ?? 0, to[at] ?? 0];
      low[axis] = Math.min(low[axis] as number, a, b);
      high[axis] = Math.max(high[axis] as number, a, b);
    }
  }
  return pieces > 0 ? { low, high } : { low: [0, 0, 0], high: [100, 100, 0] };
}

/** The piece at a time: the last that has begun; -1 before all. */
export function pieceAt(path: Path, time: number): number {
  let [low, high] = [0, path.pieces];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((path.t0[middle] as number) <= time) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** How much of a piece is done at a time, 0 to 1. */
export function shareAt(path: Path, piece: number, time: number): number {
  const [from, to] = [path.t0[piece] ?? 0, path.t1[piece] ?? 0];
  return to > from ? Math.min(1, Math.max(0, (time - from) / (to - from))) : 1;
}

/** First and last piece of the first pass through a line; nothing where it moves nothing. */
export function piecesOf(path: Path, line: number): [number, number] | undefined {
  const first = path.line.indexOf(line);
  if (first < 0) return undefined;
  let last = first;
  while (last + 1 < path.pieces && path.line[last + 1] === line) last += 1;
  return [first, last];
}
