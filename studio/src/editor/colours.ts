// Colours of words. What a word is, the compiler's lexers say (the verb `colours`, some lines at a time): there is no
// second table of words here. Between a key and the answer, colours move with their text.

import { StateEffect, StateField, type Extension, type Range, type Text } from "@codemirror/state";
import { Decoration, EditorView, ViewPlugin, type DecorationSet, type ViewUpdate } from "@codemirror/view";
import type { Colours } from "../engine/documents";

/** Asks for the colours of lines of a text, counted from 1; nothing where there is no compiler yet. */
export type AskColours = (text: Text, first: number, lines: number) => Promise<Colours | undefined>;

const put = StateEffect.define<DecorationSet>();
/** Colours are wanted anew: the dialect is another, or the compiler is there. */
export const recolour = StateEffect.define<null>();

const field = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    let now = value.map(transaction.changes);
    for (const effect of transaction.effects) if (effect.is(put)) now = effect.value;
    return now;
  },
  provide: (own) => EditorView.decorations.from(own),
});

const marks = new Map<string, Decoration>();

function mark(kind: string): Decoration {
  const found = marks.get(kind) ?? Decoration.mark({ class: `c-${kind}` });
  marks.set(kind, found);
  return found;
}

/** Lines above and below the window that are coloured as well. */
const MARGIN = 30;

class Painter {
  private waiting = 0;
  private asking = false;

  constructor(
    private readonly view: EditorView,
    private readonly ask: AskColours,
  ) {
    this.later();
  }

  update(update: ViewUpdate): void {
    const wanted = update.transactions.some((one) => one.effects.some((effect) => effect.is(recolour)));
    if (update.docChanged || update.viewportChanged || wanted) this.later();
  }

  destroy(): void {
    clearTimeout(this.waiting);
  }

  private later(): void {
    if (this.asking) return void (this.waiting ||= -1);
    clearTimeout(this.waiting);
    this.waiting = window.setTimeout(() => void this.paint(), 15);
  }

  private async paint(): Promise<void> {
    this.waiting = 0;
    this.asking = true;
    const { doc } = this.view.state;
    const { from, to } = this.view.viewport;
    const first = Math.max(1, doc.lineAt(from).number - MARGIN);
    const last = Math.min(doc.lines, doc.lineAt(to).number + MARGIN);
    const colours = await this.ask(doc, first, last - first + 1).catch(() => undefined);
    this.asking = false;
    if (colours && this.view.state.doc === doc) this.view.dispatch({ effects: put.of(this.set(colours)) });
    if (this.waiting) {
      this.waiting = 0;
      this.later();
    }
  }

  private set(colours: Colours): DecorationSet {
    const { doc } = this.view.state;
    const { stretches, kinds } = colours;
    const ranges: Range<Decoration>[] = [];
    for (let at = 0; at + 3 < stretches.length; at += 4) {
      const [number, start, end, kind] = stretches.slice(at, at + 4) as [number, number, number, number];
      if (number > doc.lines) break;
      const line = doc.line(number);
      const [from, to] = [line.from + start, Math.min(line.from + end, line.to)];
      if (from < to) ranges.push(mark(kinds[kind] ?? "").range(from, to));
    }
    return Decoration.set(ranges, true);
  }
}

export function coloured(ask: AskColours): Extension {
  return [field, ViewPlugin.define((view) => new Painter(view, ask))];
}
