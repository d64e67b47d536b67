// The editor of a program: CodeMirror in a shadow root, whose style sheets need no inline style of the page.

import { completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, isolateHistory } from "@codemirror/commands";
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
import { blockModes, toggleBlock, type AskModes } from "./block";
import { coloured, recolour, type AskColours } from "./colours";
import { folding, foldsOf, setFolds } from "./folding";
import { look } from "./look";
import { explained, type AskWords } from "./words";

export interface Wiring {
  label: string;
  colours: AskColours;
  words: AskWords;
  modes?: AskModes;
  readOnly?: boolean;
  /** The user changed the text. */
  changed?(): void;
  /** The user put the cursor into another line. */
  cursor?(line: number): void;
  /** The user asks for a name's meaning, or for another name. */
  goTo?(): void;
  rename?(): void;
  layOut?(): void;
}

const setNow = StateEffect.define<number>();
const setPairs = StateEffect.define<readonly number[]>();
const pairMark = Decoration.line({ class: "pair" });
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

/** Lines that belong to what is marked in another text. */
const pairField = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, { changes, effects, state: { doc } }) {
    const effect = effects.find((one) => one.is(setPairs));
    if (!effect) return value.map(changes);
    const lines = (effect.value as readonly number[]).filter((line) => line > 0 && line <= doc.lines);
    return Decoration.set(lines.map((line) => pairMark.range(doc.line(line).from)));
  },
  provide: (own) => EditorView.decorations.from(own),
});

export class Editor {
  private view: EditorView;
  private readonly root: ShadowRoot;
  private line = 0;
  private now = 0;
  private locked = false;

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

  /** The line of the cursor, and its column, in units of UTF-16 from 0. */
  get place(): { line: number; column: number } {
    const { head } = this.view.state.selection.main;
    const line = this.view.state.doc.lineAt(head);
    return { line: line.number, column: head - line.from };
  }

  /** Takes another text over, as one step that can be undone; gives how many lines are others. */
  replace(text: string): number {
    if (this.locked) return 0;
    const { doc } = this.view.state;
    const lines = text.split("\n");
    const changes: { from: number; to: number; insert: string }[] = [];
    if (lines.length === doc.lines) {
      // The cursor, folds and marks of other lines stay where they are.
      for (const [at, insert] of lines.entries()) {
        const { from, to, text: own } = doc.line(at + 1);
        if (own !== insert) changes.push({ from, to, insert });
      }
    } else if (text !== doc.toString()) {
      changes.push({ from: 0, to: doc.length, insert: text });
    }
    if (changes.length > 0) this.view.dispatch({ changes, userEvent: "input.compiler", annotations: isolateHistory.of("full") });
    return changes.length;
  }

  /** Another text, with a history of its own; of one that is `locked` nothing is changed. */
  open(text: string, locked = false): void {
    this.now = 0;
    this.locked = locked;
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

  /** Tells what is active in the block of the cursor. */
  showBlock(): void {
    this.view.focus();
    toggleBlock(this.view, this.wiring.modes ?? (() => undefined));
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

  /** Marks lines that belong to what is marked elsewhere; `shows` brings the first into view. */
  markPairs(lines: readonly number[], shows = false): void {
    const { doc } = this.view.state;
    const effects: StateEffect<unknown>[] = [setPairs.of(lines)];
    const first = lines[0] ?? 0;
    if (shows && first > 0 && first <= doc.lines) {
      effects.push(EditorView.scrollIntoView(doc.line(first).from, { y: "nearest", yMargin: 40 }));
    }
    this.view.dispatch({ effects });
  }

  get isVisible(): boolean {
    return this.view.dom.offsetParent !== null || this.view.dom.getClientRects().length > 0;
  }

  /** The first line that is seen. */
  get topLine(): number {
    const { scrollDOM, documentPadding, state } = this.view;
    return state.doc.lineAt(this.view.lineBlockAtHeight(scrollDOM.scrollTop - documentPadding.top + 2).from).number;
  }

  /** Brings a line to the top. */
  scrollTo(line: number): void {
    const { doc } = this.view.state;
    const { from } = doc.line(Math.min(Math.max(1, line), doc.lines));
    this.view.dispatch({ effects: EditorView.scrollIntoView(from, { y: "start", yMargin: 0 }) });
  }

  onScroll(does: () => void): void {
    this.view.scrollDOM.addEventListener("scroll", does, { passive: true });
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
    const { label, colours, words, modes = () => undefined, readOnly = false, changed, cursor } = this.wiring;
    const { goTo, rename, layOut } = this.wiring;
    const runs = (does: (() => void) | undefined) => () => (does?.(), does !== undefined);
    const extensions: Extension[] = [
      lineNumbers(),
      highlightActiveLineGutter(),
      highlightActiveLine(),
      drawSelection(),
      history(),
      search({ top: true }),
      highlightSelectionMatches(),
      keymap.of([
        { key: "F12", run: runs(goTo) },
        { key: "F2", run: runs(rename) },
        { key: "Shift-Alt-f", run: runs(layOut) },
      ]),
      EditorView.domEventHandlers({
        mousedown: (event, view) => {
          if (!goTo || !(event.ctrlKey || event.metaKey) || event.button !== 0) return false;
          const at = view.posAtCoords({ x: event.clientX, y: event.clientY });
          if (at === null) return false;
          view.dispatch({ selection: { anchor: at }, userEvent: "select.pointer" });
          goTo();
          return true;
        },
      }),
      keymap.of([...completionKeymap, ...defaultKeymap, ...historyKeymap, ...searchKeymap]),
      EditorState.readOnly.of(readOnly || this.locked),
      EditorView.contentAttributes.of({
        "aria-label": label,
        tabindex: "0",
        spellcheck: "false",
        autocapitalize: "characters",
      }),
      nowField,
      pairField,
      coloured(colours),
      explained(words, modes),
      blockModes(modes),
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
