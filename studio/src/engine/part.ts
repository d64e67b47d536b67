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
  return { heights: new Float32Array(aligned(heights)), last: new Uint32Array(aligned(last)) };
}

/** The bytes in a buffer of their own. */
function aligned(bytes: Uint8Array): ArrayBuffer {
  const whole = bytes.byteOffset === 0 && bytes.byteLength === bytes.buffer.byteLength;
  return (whole ? bytes.buffer : bytes.slice().buffer) as ArrayBuffer;
}
