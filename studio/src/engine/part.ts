// The part that a program cuts: what the verb `simulate` tells of it, and its heights.

import type { Answer } from "./engine";
import type { Problem } from "./documents";

type Point = [number, number, number];

export interface Tool {
  /** Nothing for the tool at the start, and for one with a name. */
  number: number | null;
  shape: string;
  /** mm */
  diameter: number;
  /** Where the diameter comes from: `stated`, `profile`, `comment`, `guess`. */
  known: string;
  shape_guessed: boolean;
  /** mm, of a bull-nose; degrees, of a drill, a chamfer or a taper. */
  corner?: number;
  angle?: number;
  /** Diameter of the flat end of a chamfer mill, mm. */
  end_diameter?: number;
  /** Radius and height above the tip of what cuts, mm, from the axis outwards. */
  outline: [number, number][];
  /** Length of what cuts, and diameter above that, mm, where they are known. */
  flute?: number;
  shank?: number;
  /** Diameter, and height above the tip where it begins, mm. */
  holder?: [number, number];
  /** mm³ */
  removed: number;
  /** Seconds at feed. */
  cutting: number;
}

export interface Alarm extends Omit<Problem, "code" | "time"> {
  id: string;
  kind: string;
  /** Seconds. */
  time: number;
  at: Point;
  guessed: boolean;
}

/** What holds the part: the box around it. */
export interface Fixture {
  /** As it was stated; a file's name of a body. */
  name: string;
  form: "block" | "cylinder" | "body";
  low: Point;
  high: Point;
}

/** A program's entry in the document of `simulate`. */
export interface Cut {
  raw: {
    form: string;
    low: Point;
    high: Point;
    guessed: boolean;
    /** Along X and along Y. */
    cells: [number, number];
    /** Side of a cell, mm. */
    cell: number;
  };
  units: "mm" | "inch";
  fixtures?: Fixture[];
  /** Zeros of work offsets; that of the first cut is the origin. */
  zeros: { name: string; at: Point }[];
  /** Where the axes of the machine go, least and greatest coordinates, where that is known. */
  travel?: [Point, Point];
  tools: Tool[];
  removed: number;
  alarms: Alarm[];
}

/** Heights of the part, rows of one Y, the least Y first; and the move that cut last, 0 for none. */
export interface Heights {
  heights: Float32Array;
  last: Uint32Array;
  hollows: Hollows;
  /** Of each cell 1 where `faces` have the surface; empty of a part without hollows. */
  covered: Uint8Array;
  /** Four words each: the cell, the side (up, down, front, right, back, left) and 256 times the length, from and to which height. */
  faces: Uint32Array;
}

/** Spaces without material under the upper surface, cell by cell, the lowest first. */
export class Hollows {
  private readonly ends: Float32Array;

  /** Four words each: the cell, the move that cut last there, the lower and the upper end. */
  constructor(private readonly words: Uint32Array) {
    this.ends = new Float32Array(words.buffer);
  }

  get count(): number {
    return this.words.length / 4;
  }

  cell(n: number): number {
    return this.words[4 * n] as number;
  }

  /** Of the hollows of its cell: the move that cut last there. */
  last(n: number): number {
    return this.words[4 * n + 1] as number;
  }

  /** mm */
  low(n: number): number {
    return this.ends[4 * n + 2] as number;
  }

  /** mm */
  high(n: number): number {
    return this.ends[4 * n + 3] as number;
  }

  /** Those of a cell: the first, and behind the last. */
  of(cell: number): [number, number] {
    let [first, behind] = [0, this.count];
    while (first < behind) {
      const middle = (first + behind) >> 1;
      if (this.cell(middle) < cell) first = middle + 1;
      else behind = middle;
    }
    while (behind < this.count && this.cell(behind) === cell) behind += 1;
    return [first, behind];
  }

  /** Whether a place of a cell is in one. */
  has(cell: number, height: number): boolean {
    const [first, behind] = this.of(cell);
    for (let n = first; n < behind; n += 1) if (height > this.low(n) && height < this.high(n)) return true;
    return false;
  }

  /** mm of them in a cell above a level. */
  above(cell: number, level: number): number {
    const [first, behind] = this.of(cell);
    let sum = 0;
    for (let n = first; n < behind; n += 1) sum += Math.max(0, this.high(n) - Math.max(level, this.low(n)));
    return sum;
  }
}

/** What lies between the parts of two programs, in the document of `simulate`. */
export interface Between {
  /** What only the first has, and only the second, mm³. */
  more: number;
  less: number;
  above: { by: number } | null;
  below: { by: number } | null;
  /** mm */
  tolerance: number;
  same: boolean;
}

export function readBetween(answer: Answer): Between | undefined {
  return answer.json<{ between?: Between }>("document")?.between;
}

export function readCut(answer: Answer): Cut | undefined {
  return answer.json<{ programs: Cut[] }>("document")?.programs[0];
}

export function readHeights(answer: Answer): Heights | undefined {
  const [heights, last] = [answer.bytes("heights"), answer.bytes("last")];
  if (!heights || !last) return undefined;
  const words = (name: string) => new Uint32Array(aligned(answer.bytes(name) ?? new Uint8Array()));
  return {
    heights: new Float32Array(aligned(heights)),
    last: new Uint32Array(aligned(last)),
    hollows: new Hollows(words("hollows")),
    covered: answer.bytes("covered") ?? new Uint8Array(),
    faces: words("faces"),
  };
}

/** The bytes in a buffer of their own. */
function aligned(bytes: Uint8Array): ArrayBuffer {
  const whole = bytes.byteOffset === 0 && bytes.byteLength === bytes.buffer.byteLength;
  return (whole ? bytes.buffer : bytes.slice().buffer) as ArrayBuffer;
}
