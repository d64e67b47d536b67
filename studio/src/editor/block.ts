// What is active in a block: under the pointer with what its word means, and by a key or a button at the cursor.

import { StateEffect, StateField, type Extension } from "@codemirror/state";
import { EditorView, keymap, showTooltip, type Tooltip } from "@codemirror/view";
import type { Active } from "../engine/modes";
import { el } from "../ui/dom";
import { modesTable } from "../ui/modes";
import { say } from "../ui/texts";

/** What is active behind a line; nothing where it is not executed, or the text is newer than what is known of it. */
export type AskModes = (line: number) => Active[] | undefined;

const show = StateEffect.define<Tooltip | null>();

const field = StateField.define<Tooltip | null>({
  create: () => null,
  update(value, transaction) {
    const effect = transaction.effects.find((one) => one.is(show));
    if (effect) return effect.value as Tooltip | null;
    return transaction.docChanged || transaction.selection ? null : value;
  },
  provide: (own) => showTooltip.from(own),
});

/** Tells what is active in the block of the cursor, or takes that away. */
export function toggleBlock(view: EditorView, ask: AskModes): boolean {
  if (view.state.field(field)) return hide(view);
  const { head } = view.state.selection.main;
  const line = view.state.doc.lineAt(head);
  const active = ask(line.number);
  const dom = el("div", { class: "about", role: "status" }, active ? modesTable(active) : say("noModes"));
  view.dispatch({ effects: show.of({ pos: head, above: true, create: () => ({ dom }) }) });
  return true;
}

function hide(view: EditorView): boolean {
  if (!view.state.field(field)) return false;
  view.dispatch({ effects: show.of(null) });
  return true;
}

export function blockModes(ask: AskModes): Extension {
  return [
    field,
    keymap.of([
      { key: "Mod-i", run: (view) => toggleBlock(view, ask), preventDefault: true },
      { key: "Escape", run: hide },
    ]),
    EditorView.domEventHandlers({ blur: (_, view) => void hide(view) }),
  ];
}
