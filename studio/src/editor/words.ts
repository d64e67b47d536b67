// What words mean, under the pointer and while somebody types: rows of the dictionary, as the compiler has them (the verb
// `words`), each with who says so.

import { autocompletion, type Completion, type CompletionContext, type CompletionResult } from "@codemirror/autocomplete";
import type { Extension, Transaction } from "@codemirror/state";
import { hoverTooltip, type HoverTooltipSource } from "@codemirror/view";
import { el } from "../ui/dom";
import { modesTable } from "../ui/modes";
import { say } from "../ui/texts";
import type { AskModes } from "./block";

export interface WordRow {
  kind: "code" | "name" | "call" | "address";
  word: string;
  means: string;
  /** By which name it is refused, if it is. */
  refused: string | null;
  sure: boolean;
  source: string;
}

/** Of the verb `words`. */
export interface Words {
  dialect: string;
  words: WordRow[];
  sources: Record<string, string>;
}

/** Asks for the words of the dialect that is read. */
export type AskWords = () => Promise<Words | undefined>;

/** `G01` and `g1` as `G1`; `G05.1` as `G5.1`. */
function plain(word: string): string {
  return word.toUpperCase().replace(/^([A-Z])0+(?=\d)/, "$1");
}

/** A word of a letter and a number, or of several letters. */
const WORD = /[A-Za-z_$][A-Za-z_$0-9]{2,}|[A-Za-z](?=\s*[-+]?[\d.#[=])\s*[-+]?[\d.]*/g;

export function explained(ask: AskWords, modes: AskModes): Extension {
  const about: HoverTooltipSource = async (view, position) => {
    const line = view.state.doc.lineAt(position);
    const match = [...line.text.matchAll(WORD)].find(
      ({ index, 0: text }) => line.from + index <= position && position <= line.from + index + text.length,
    );
    const words = match && (await ask());
    const row = words && rowOf(words, match[0]);
    const active = modes(line.number);
    if (!row && !active) return null;
    const [from, length] = row ? [line.from + match.index, match[0].length] : [line.from, line.length];
    const dom = row ? shown(row, words) : el("div", { class: "about" });
    if (active) dom.append(modesTable(active));
    return { pos: from, end: from + length, above: true, create: () => ({ dom }) };
  };
  // It lies over the lines before: whoever goes on has seen it.
  const hideOn = (transaction: Transaction) => transaction.docChanged || transaction.selection !== undefined;
  const hover = hoverTooltip(about, { hideOn, hoverTime: 450 });
  return [hover, autocompletion({ override: [(context) => complete(context, ask)], icons: false })];
}

/** The row of a word: of a code, a name or a call, else of its letter. */
function rowOf(words: Words, text: string): WordRow | undefined {
  const own = plain(text.trim());
  const whole = words.words.find((row) => row.kind !== "address" && plain(row.word) === own);
  return whole ?? words.words.find((row) => row.kind === "address" && row.word === own[0] && /^[A-Z][^A-Z_$]*$/.test(own));
}

/** What a row says, with its source written out. */
function shown(row: WordRow, words: Words): HTMLElement {
  const key = /^[\w.-]+/.exec(row.source)?.[0] ?? "";
  const source = words.sources[key];
  const parts = [el("strong", {}, row.word), ` ${row.means}`];
  const dom = el("div", { class: "about" }, el("div", {}, ...parts));
  if (row.refused) dom.append(el("div", { class: "refused" }, `${say("refusedWord")}: ${row.refused}`));
  if (!row.sure) dom.append(el("div", { class: "refused" }, say("unsure")));
  dom.append(el("div", { class: "advice" }, row.source));
  if (source) dom.append(el("div", { class: "code" }, `${key}: ${source}`));
  return dom;
}

async function complete(context: CompletionContext, ask: AskWords): Promise<CompletionResult | null> {
  const before = context.matchBefore(/[A-Za-z_$][\w$.]*/);
  if (!before || (before.from === before.to && !context.explicit)) return null;
  const line = context.state.doc.lineAt(before.from);
  // A comment is nobody's code.
  if (/[(;][^)]*$/.test(line.text.slice(0, before.from - line.from))) return null;
  // A letter alone begins any word; names need two.
  const words = await ask();
  if (!words || context.aborted) return null;
  const typed = plain(before.text);
  const options = words.words
    .filter((row) => row.kind !== "address" && !row.refused && plain(row.word).startsWith(typed))
    .map((row): Completion => ({ label: row.word, detail: row.means, info: () => shown(row, words) }));
  // What is typed to its end is no question.
  const finished = options.length === 1 && plain(options[0]?.label ?? "") === typed;
  if (options.length === 0 || finished) return null;
  return { from: before.from, options, filter: false };
}
