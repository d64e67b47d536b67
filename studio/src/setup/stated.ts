// What a program's `ncc.toml` states, beside what was chosen for it: a choice goes before the file, as an option of the command
// line does. Not here: the form of the file, which the compiler reads and writes.

import type { Choices } from "../projects/project";

/** A machine of a row; one that stands in the row itself has no name. */
export interface StatedSide {
  name: string | null;
  /** Nothing where its profile is not at hand. */
  dialect: string | null;
  options: Record<string, string>;
}

/** Of the verb `stated`. */
export interface Stated {
  machine: StatedSide | null;
  to: StatedSide | null;
  stock: string | null;
  fixtures: string[];
  table: number | null;
  /** Files that it names. */
  files: string[];
  /** Which of them are not at hand, in words. */
  told: string[];
}

/** What is set up on the machine, in the form of the command line; empty where nothing is stated. */
export interface SetUp {
  stock: string;
  fixtures: string[];
  /** Z of the table, mm. */
  table: string;
}

/** What holds: what was chosen, and else what the file states. */
export function setUpOf(choices: Choices, stated: Stated | undefined): SetUp {
  return {
    stock: choices.stock || (stated?.stock ?? ""),
    fixtures: choices.fixtures.length > 0 ? choices.fixtures : (stated?.fixtures ?? []),
    table: choices.table || String(stated?.table ?? ""),
  };
}

/** A side as it holds, and as it is written: what was chosen, and else what the file states. */
export interface Side {
  dialect: string;
  machine: string;
  options: Record<string, string>;
}

export const SIDES = ["fromOption", "toOption"] as const;
/** Which side: its options among the choices. */
export type SideName = (typeof SIDES)[number];

export function sideOf(side: SideName, choices: Choices, stated: Stated | undefined): Side {
  const own = statedOf(side, choices, stated);
  const [dialect, machine] = chosenOf(side, choices);
  return { dialect: own?.dialect ?? dialect, machine: machine || (own?.name ?? ""), options: { ...own?.options, ...choices[side] } };
}

/** Options that were chosen and that the file states alike: they need no choice, and one that stays would hide what the file
 * states later. */
export function needless(side: SideName, choices: Choices, stated: Stated | undefined): string[] {
  const options = statedOf(side, choices, stated)?.options ?? {};
  return Object.keys(options).filter((name) => choices[side][name] === options[name]);
}

/** What the file states of a side, unless another dialect or a machine is chosen. */
function statedOf(side: SideName, choices: Choices, stated: Stated | undefined): StatedSide | undefined {
  const own = side === "fromOption" ? stated?.machine : stated?.to;
  const [dialect, machine] = chosenOf(side, choices);
  return own && !machine && (!dialect || dialect === "auto" || dialect === own.dialect) ? own : undefined;
}

function chosenOf(side: SideName, { from, machine, to, machineTo }: Choices): [dialect: string, machine: string] {
  return side === "fromOption" ? [from, machine] : [to, machineTo];
}
