// Forms of the engine's documents, as far as the page reads them.

/** Of the verb `dialects`, and of `machines`, which has their dialects. */
export interface Listed {
  id: string;
  title: string;
  dialect?: string;
}

/** A stretch of a line; lines and columns count from 1, a column is a character. */
export interface Place {
  line: number;
  column: number;
  end_column: number;
  text: string;
  label: string;
}

export interface Problem {
  code: string;
  severity: "error" | "warning" | "note";
  message: string;
  place: Place;
  advice: string[];
  /** When it happens, seconds, where that is known. */
  time?: number;
}

/** Of the verb `check`. */
export interface Findings {
  programs: {
    dialect: string;
    findings: (Omit<Problem, "code"> & { id: string })[];
    not_checked: { what: string; why: string }[];
  }[];
}

export interface Question {
  code: string;
  question: string;
  place: Place;
  answers: { option: string; result: string; taken: boolean }[];
}

/** Of the verb `translate`. */
export interface Report {
  result: string;
  source: { dialect: string };
  verification: { worlds: number; events: number } | null;
  questions: Question[];
  diagnostics: Problem[];
}

/** Of the verb `colours`: four numbers a stretch (line, first column, the one behind, kind). */
export interface Colours {
  dialect: string;
  kinds: string[];
  stretches: number[];
}
