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

/** Dialect and machine of a side as the compiler is asked for them to be written. */
export function sideOf(dialect: string, machine: string, stated: StatedSide | null | undefined): { dialect: string; machine: string } {
  const own = stated && !machine && (!dialect || dialect === "auto" || dialect === stated.dialect) ? stated : undefined;
  return { dialect: own?.dialect ?? dialect, machine: machine || (own?.name ?? "") };
}
