// Lines in which two texts differ, by the longest common subsequence of what lies between their common beginning and end.

/** So many steps are looked at; beyond them all lines between are taken to differ. */
const MOST = 4_000_000;

/** The lines of each that the other does not have, counted from 1. */
export function differing(one: string, other: string): [number[], number[]] {
  const [a, b] = [one.split("\n"), other.split("\n")];
  let begin = 0;
  while (begin < a.length && begin < b.length && a[begin] === b[begin]) begin += 1;
  let [endA, endB] = [a.length, b.length];
  while (endA > begin && endB > begin && a[endA - 1] === b[endB - 1]) [endA, endB] = [endA - 1, endB - 1];
  const [rows, columns] = [endA - begin, endB - begin];
  const lines = (from: number, count: number) => Array.from({ length: count }, (_, at) => from + at + 1);
  if (rows * columns > MOST) return [lines(begin, rows), lines(begin, columns)];
  // Lengths of the longest common subsequences of the rests.
  const width = columns + 1;
  const rest = new Uint16Array((rows + 1) * width);
  for (let row = rows - 1; row >= 0; row -= 1) {
    for (let column = columns - 1; column >= 0; column -= 1) {
      const at = row * width + column;
      const isSame = a[begin + row] === b[begin + column];
      rest[at] = isSame ? (rest[at + width + 1] as number) + 1 : Math.max(rest[at + width] as number, rest[at + 1] as number);
    }
  }
  const found: [number[], number[]] = [[], []];
  let [row, column] = [0, 0];
  while (row < rows || column < columns) {
    const at = row * width + column;
    if (row < rows && column < columns && a[begin + row] === b[begin + column]) [row, column] = [row + 1, column + 1];
    else if (column >= columns || (row < rows && (rest[at + width] as number) >= (rest[at + 1] as number))) found[0].push(begin + ++row);
    else found[1].push(begin + ++column);
  }
  return found;
}
