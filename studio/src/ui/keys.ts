// Keys of the whole page. None is a letter alone where somebody types.

import type { Editor } from "../editor/editor";
import type { Desk } from "../projects/desk";
import type { Player } from "../time/player";

export interface Reach {
  desk: Desk;
  player: Player;
  editor: Editor;
  projects(): void;
  toLine(line: number): void;
}

/** Keys with Ctrl (or Cmd); `^` is Shift. */
function table({ desk, player, editor, projects, toLine }: Reach): Record<string, () => void> {
  return {
    s: () => void desk.saveNow(),
    o: projects,
    "^Enter": () => player.toggle(),
    ".": () => player.step(1),
    ",": () => player.step(-1),
    Enter: () => toLine(editor.cursor),
  };
}

export function wireKeys(reach: Reach): void {
  const keys = table(reach);
  addEventListener(
    "keydown",
    (event) => {
      const key = `${event.shiftKey ? "^" : ""}${event.key}`;
      const does = event.ctrlKey || event.metaKey ? keys[key] : undefined;
      if (!does || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      does();
    },
    { capture: true },
  );
}
