// The modes of a program as columns of changes: the output `modes` of the verbs `path` and `simulate`, which says what each
// column is (`ncc_driver::simulate::modes`). What is active in a block or a move is looked up, never listed for each.

/** A mode that is known, in the words of the program's dialect. */
export interface Active {
  /** One of the names that the engine has for modes. */
  mode: string;
  text: string;
  /** Whether it is the last that was changed, or one of those. */
  changed: boolean;
}

/** A run of the spindle from one speed to another; they are negative counter-clockwise. */
export interface Run {
  /** Seconds; the same where nothing says how long it takes. */
  from: number;
  to: number;
  before: number;
  after: number;
}

type Point = [number, number, number];

const TYPES = { u8: Uint8Array, u32: Uint32Array, f64: Float64Array };

interface Head {
  modes: string[];
  texts: string[];
  columns: { name: string; type: keyof typeof TYPES; offset: number; count: number }[];
}

/** How many of rising values are at most this one. */
function upTo(values: ArrayLike<number>, most: number): number {
  let [low, high] = [0, values.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((values[middle] as number) <= most) low = middle + 1;
    else high = middle;
  }
  return low;
}

export class Modes {
  readonly runs: Run[];
  private readonly names: string[];
  private readonly texts: string[];
  private readonly columns: Record<string, ArrayLike<number>>;
  /** Places of each mode's changes. */
  private readonly changes: number[][];

  constructor(bytes: Uint8Array) {
    const end = bytes.indexOf(10);
    const head = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end))) as Head;
    const column = ({ name, type, offset, count }: Head["columns"][number]): [string, ArrayLike<number>] => {
      const [Type, at] = [TYPES[type], end + 1 + offset];
      return [name, new Type(bytes.slice(at, at + count * Type.BYTES_PER_ELEMENT).buffer)];
    };
    this.names = head.modes;
    this.texts = head.texts;
    this.columns = Object.fromEntries(head.columns.map(column));
    this.changes = head.modes.map(() => []);
    Array.from(this.column("change_mode")).forEach((mode, at) => this.changes[mode]?.push(at));
    const runs = ["from", "to", "before", "after"].map((name) => this.column(`spindle_${name}`));
    this.runs = Array.from(runs[0] ?? [], (_, at) => {
      const [from = 0, to = 0, before = 0, after = 0] = runs.map((own) => own[at] ?? 0);
      return { from, to, before, after };
    });
  }

  /** What is active behind a line, as it is passed first; nothing where it executes nothing. */
  ofLine(line: number): Active[] | undefined {
    const count = this.column("line_changes")[upTo(this.column("line"), line) - 1] ?? 0;
    return count > 0 ? this.after(count - 1, undefined) : undefined;
  }

  /** What is active in a move. */
  ofMove(move: number): Active[] {
    const moves = this.column("change_move");
    const count = upTo(moves, move);
    return this.after(count, moves[count - 1]);
  }

  /** A place of the part in the active work offset; and in the machine, as far as it is known what leads there. */
  places(move: number, at: Point): { work: Point; machine: (number | undefined)[] } {
    const own = upTo(this.column("shift_move"), move) - 1;
    const known = this.column("shift_known")[own] ?? 0;
    const shift = (name: string, axis: number) => this.column(`${name}_${"xyz"[axis]}`)[own] ?? 0;
    return {
      work: at.map((value, axis) => value + shift("offset", axis)) as Point,
      machine: at.map((value, axis) => ((known >> axis) & 1 ? value + shift("shift", axis) : undefined)),
    };
  }

  /** Where rotary axes are in a move of which a share is done; nothing where none ever moves. */
  turns(move: number, share: number): Point | undefined {
    const moves = this.column("turn_move");
    if (moves.length === 0) return undefined;
    const own = Math.max(0, upTo(moves, move) - 1);
    const of = (at: number) => ["a", "b", "c"].map((axis) => this.column(`turn_${axis}`)[at] ?? 0) as Point;
    const [to, from] = [of(own), of(Math.max(0, own - 1))];
    return moves[own] === move ? (to.map((value, axis) => (from[axis] ?? 0) + (value - (from[axis] ?? 0)) * share) as Point) : to;
  }

  private after(count: number, last: number | undefined): Active[] {
    const [texts, moves] = [this.column("change_text"), this.column("change_move")];
    return this.names.flatMap((mode, at) => {
      const own = this.changes[at] ?? [];
      const change = own[upTo(own, count - 1) - 1];
      const text = change === undefined ? undefined : this.texts[(texts[change] ?? 0) - 1];
      return text === undefined ? [] : [{ mode, text, changed: moves[change as number] === last }];
    });
  }

  private column(name: string): ArrayLike<number> {
    return this.columns[name] ?? [];
  }
}
