// Folding by tool: a section of the outline is shut from the end of its first line on.

import { codeFolding, foldGutter, foldKeymap, foldService } from "@codemirror/language";
import { EditorState, StateEffect, StateField, type Extension } from "@codemirror/state";
import { keymap } from "@codemirror/view";
import { say } from "../ui/texts";

/** Where a section's first line begins, where that line ends, and where the section does. */
type Fold = [begin: number, from: number, to: number];

export const setFolds = StateEffect.define<readonly Fold[]>();

const folds = StateField.define<readonly Fold[]>({
  create: () => [],
  update(value, { effects, changes, docChanged }) {
    const moved = docChanged ? value.map((one) => one.map((at) => changes.mapPos(at)) as Fold) : value;
    return effects.reduce((now, effect) => (effect.is(setFolds) ? effect.value : now), moved);
  },
});

/** Sections of lines as places in a text; those that it does not have are left out. */
export function foldsOf({ doc }: EditorState, sections: readonly { line: number; end: number }[]): Fold[] {
  const whole = sections.filter(({ line, end }) => line > 0 && line < end && end <= doc.lines);
  return whole.map(({ line, end }) => [doc.line(line).from, doc.line(line).to, doc.line(end).to]);
}

export function folding(): Extension {
  return [
    folds,
    foldService.of((state, from) => {
      const found = state.field(folds).find(([begin, , to]) => begin === from && to > begin);
      return found ? { from: found[1], to: found[2] } : null;
    }),
    codeFolding(),
    foldGutter({
      foldingChanged: ({ transactions }) => transactions.some((one) => one.effects.some((effect) => effect.is(setFolds))),
    }),
    keymap.of(foldKeymap),
    EditorState.phrases.of({
      "Fold line": say("fold"),
      "Unfold line": say("unfold"),
      "Folded lines": say("folded"),
      "Unfolded lines": say("unfolded"),
      "folded code": say("folded"),
      unfold: say("unfold"),
      to: "–",
    }),
  ];
}
