// The editor of a program: CodeMirror in a shadow root, whose style sheets need no inline style of the page.

import { completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { lintGutter, setDiagnostics, type Diagnostic } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { EditorState, StateEffect, StateField, type Extension, type Text } from "@codemirror/state";
import {
  Decoration,
  EditorView,
  drawSelection,
  highlightActiveLine,
  highlightActiveLineGutter,
  keymap,
  lineNumbers,
  type DecorationSet,
} from "@codemirror/view";
import type { Place, Problem } from "../engine/documents";
import { el } from "../ui/dom";
import { coloured, recolour, type AskColours } from "./colours";
import { folding, foldsOf, setFolds } from "./folding";
import { look } from "./look";
import { explained, type AskWords } from "./words";

export interface Wiring {
  label: string;
  colours: AskColours;
  words: AskWords;
  readOnly?: boolean;
  /** The user changed the text. */
  changed?(): void;
  /** The user put the cursor into another line. */
  cursor?(line: number): void;
}

const setNow = StateEffect.define<number>();
const nowMark = Decoration.line({ class: "now" });

/** The line that the program is at. */
const nowField = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    let now = value.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (!effect.is(setNow)) continue;
      const { doc } = transaction.state;
      const line = effect.value;
      now = line > 0 && line <= doc.lines ? Decoration.set(nowMark.range(doc.line(line).from)) : Decoration.none;
    }
    return now;
  },
  provide: (own) => EditorView.decorations.from(own),
});

export class Editor {
  private view: EditorView;
  private readonly root: ShadowRoot;
  private line = 0;
  private now = 0;

  constructor(
    parent: HTMLElement,
    private readonly wiring: Wiring,
  ) {
    this.root = parent.attachShadow({ mode: "open" });
    this.view = new EditorView({ root: this.root, parent: this.root, state: this.state("") });
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  get doc(): Text {
    return this.view.state.doc;
  }

  get lines(): number {
    return this.view.state.doc.lines;
  }

  /** The line of the cursor. */
  get cursor(): number {
    return this.view.state.doc.lineAt(this.view.state.selection.main.head).number;
  }

  /** Another text, with a history of its own. */
  open(text: string): void {
    this.now = 0;
    this.view.setState(this.state(text));
    this.line = 1;
  }

  /** Colours are asked for anew. */
  recolour(): void {
    this.view.dispatch({ effects: recolour.of(null) });
  }

  /** Puts the cursor into a line and shows it. */
  goTo(line: number, column = 1): void {
    const { doc } = this.view.state;
    const at = doc.line(Math.min(Math.max(1, line), doc.lines));
    this.line = at.number;
    const anchor = Math.min(at.from + column - 1, at.to);
    this.view.dispatch({ selection: { anchor }, effects: EditorView.scrollIntoView(at.from, { y: "center" }) });
  }

  focus(): void {
    this.view.focus();
  }

  /** Marks the line that the program is at; 0 is none. */
  markNow(line: number, follow: boolean): void {
    const { doc } = this.view.state;
    if (line === this.now || line > doc.lines) return;
    this.now = line;
    const effects: StateEffect<unknown>[] = [setNow.of(line)];
    if (follow && line > 0) effects.push(EditorView.scrollIntoView(doc.line(line).from, { y: "nearest", yMargin: 60 }));
    this.view.dispatch({ effects });
  }

  /** Sections of lines that can be folded. */
  setSections(sections: readonly { line: number; end: number }[]): void {
    this.view.dispatch({ effects: setFolds.of(foldsOf(this.view.state, sections)) });
  }

  /** Shows problems at their places. */
  setProblems(problems: readonly Problem[]): void {
    const { doc } = this.view.state;
    const diagnostics = problems.filter((one) => one.place.line <= doc.lines).map((one) => this.diagnostic(one));
    diagnostics.sort((a, b) => a.from - b.from);
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics));
  }

  private diagnostic(problem: Problem): Diagnostic {
    const [from, to] = this.range(problem.place);
    return {
      from,
      to,
      severity: problem.severity === "note" ? "info" : problem.severity,
      message: problem.message,
      renderMessage: () =>
        el(
          "div",
          {},
          el("strong", {}, problem.message),
          el("div", {}, problem.place.label),
          ...problem.advice.map((text) => el("div", { class: "advice" }, text)),
          el("div", { class: "code" }, problem.code),
        ),
    };
  }

  /** A place in the editor's units; an empty one is a character wide. */
  private range(place: Place): [number, number] {
    const line = this.view.state.doc.line(place.line);
    const unit = (column: number) => [...line.text].slice(0, column - 1).join("").length;
    const from = Math.min(line.from + unit(place.column), Math.max(line.from, line.to - 1));
    return [from, Math.max(Math.min(line.from + unit(place.end_column), line.to), Math.min(from + 1, line.to))];
  }

  private state(doc: string): EditorState {
    const { label, colours, words, readOnly = false, changed, cursor } = this.wiring;
    const extensions: Extension[] = [
      lineNumbers(),
      highlightActiveLineGutter(),
      highlightActiveLine(),
      drawSelection(),
      history(),
      search({ top: true }),
      highlightSelectionMatches(),
      keymap.of([...completionKeymap, ...defaultKeymap, ...historyKeymap, ...searchKeymap]),
      EditorState.readOnly.of(readOnly),
      EditorView.contentAttributes.of({
        "aria-label": label,
        tabindex: "0",
        spellcheck: "false",
        autocapitalize: "characters",
      }),
      nowField,
      coloured(colours),
      explained(words),
      look,
      EditorView.updateListener.of((update) => {
        if (update.docChanged && !readOnly) changed?.();
        if (!update.selectionSet && !update.docChanged) return;
        const line = this.cursor;
        const byUser = update.transactions.some((one) => one.isUserEvent("select") || one.docChanged);
        if (line !== this.line && byUser) cursor?.(line);
        this.line = line;
      }),
    ];
    if (!readOnly) extensions.push(lintGutter(), folding());
    return EditorState.create({ doc, extensions });
  }
}
