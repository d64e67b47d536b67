// A raw part or a fixture in the form of the command line, as fields: by its letters, whatever their order. A file of triangles
// has none, nor has what the compiler would refuse.
//
//     X0:100 Y0:60 Z-20:0    a block
//     D50 X10 Y10 Z-30:0     a cylinder along Z; without X and Y its axis is at zero

export type Form = "block" | "cylinder";

/** Fields of a form, in the order of the command line. */
export const FIELDS: Record<Form, string[]> = {
  block: ["X−", "X+", "Y−", "Y+", "Z−", "Z+"],
  cylinder: ["D", "X", "Y", "Z−", "Z+"],
};

const WORD = /^([DXYZ])([^:]+)(?::([^:]+))?$/i;
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** The form of a stated body and its numbers, in the order of the fields, mm. */
export function readBody(text: string): [Form, number[]] | undefined {
  const words: Record<string, string[]> = {};
  for (const word of text.split(/[ ,]/).filter(Boolean)) {
    const [, letter = "", ...ends] = WORD.exec(word) ?? [];
    const given = ends.filter((end) => end !== undefined);
    if (!letter || words[letter.toUpperCase()] || !given.every((end) => NUMBER.test(end))) return undefined;
    words[letter.toUpperCase()] = given;
  }
  const { D, X, Y, Z } = words;
  const form = D ? "cylinder" : "block";
  const ends = D ? [D, X ?? ["0"], Y ?? ["0"], Z] : [X, Y, Z];
  const counts = D ? [1, 1, 1, 2] : [2, 2, 2];
  if (!ends.every((own, at) => own?.length === counts[at])) return undefined;
  return [form, ends.flat().map(Number)];
}

/** A body as the command line has it. */
export function writeBody(form: Form, numbers: number[]): string {
  const [a, b, c, d, e, f] = numbers;
  return form === "block" ? `X${a}:${b} Y${c}:${d} Z${e}:${f}` : `D${a} X${b} Y${c} Z${d}:${e}`;
}

/** Numbers that were computed, to a thousandth. */
export function rounded(numbers: number[]): number[] {
  return numbers.map((value) => Number(value.toFixed(3)));
}
