// Dialogs of a program of the server: its revisions, and two texts where somebody else was first.

import { Editor } from "../editor/editor";
import type { Colours } from "../engine/documents";
import { el, icon } from "../ui/dom";
import { wordsOf } from "./api";
import { differing } from "./differing";
import type { Conflict, Server } from "./server";
import { moment, say, tell, tellOf } from "./texts";
import type { Program } from "./programs";

/** A dialog with a head; it goes when it is closed. */
function dialogOf(id: string, title: string, ...content: HTMLElement[]): HTMLDialogElement {
  const close = el("button", { "aria-label": say("close"), onclick: () => made.close() }, icon("close"));
  const made: HTMLDialogElement = el("dialog", { id, "aria-labelledby": `${id}-title` }, el("header", {}, el("h2", { id: `${id}-title` }, title), close), ...content);
  made.addEventListener("close", () => made.remove());
  made.addEventListener("click", (event) => event.target === made && made.close());
  document.body.append(made);
  made.showModal();
  return made;
}

/** The revisions of the open program. */
export async function showRevisions(server: Server): Promise<void> {
  const project = server.desk.project;
  const place = project?.server;
  if (!project || !place) return;
  const list = el("ul", { id: "revisions-list" });
  const wrong = el("p", { class: "wrong", role: "alert" });
  const more = el("button", { class: "further", hidden: true }, tell("more"));
  const dialog = dialogOf("revisions-dialog", `${tell("revisions")}: ${project.name}`, list, more, wrong);
  const open = (revision: number) => {
    dialog.close();
    void server.tries(() => server.openProgram(place.program, { revision }));
  };
  const restore = (revision: number) => {
    dialog.close();
    void server.restore(revision);
  };
  const row = (one: Program): HTMLElement => {
    const isLatest = one.revision === (place.latest ?? place.revision) && list.childElementCount === 0;
    const head = [String(one.revision), tellChange(one.change), ...(isLatest ? [tell("latest")] : [])].join(" · ");
    const take = el("button", { class: "take", onclick: () => open(one.revision) });
    take.append(el("b", {}, head), el("small", {}, `${one.author} · ${moment(one.made)}`), ...(one.message ? [el("span", {}, one.message)] : []));
    const again = el("button", { "aria-label": `${tell("restore")}: ${one.revision}`, onclick: () => restore(one.revision) }, tell("restore"));
    return el("li", { class: one.revision === place.revision ? "current" : "" }, take, ...(isLatest ? [] : [again]));
  };
  const fill = async (before?: number) => {
    try {
      const { revisions, next } = await server.programs.revisions(place.program, before);
      for (const one of revisions) list.append(row(one));
      more.hidden = next === null;
      more.onclick = () => void fill(next ?? undefined);
    } catch (error) {
      wrong.textContent = wordsOf(error);
    }
  };
  await fill();
}

function tellChange(change: string): string {
  switch (change) {
    case "created":
    case "text":
    case "details":
    case "deleted":
      return tell(change);
    default:
      return tellOf("change", change);
  }
}

export type AskColours = (doc: object, first: number, lines: number) => Promise<Colours | undefined>;

/** Asks what shall become of two texts. */
export function showConflict(server: Server, conflict: Conflict, colours: AskColours): void {
  const { theirs, text, mine, base } = conflict;
  const values = { author: theirs.author, name: theirs.name, when: moment(theirs.made), revision: theirs.revision, own: base };
  const both = el("div", { id: "both", hidden: true });
  const see = () => {
    if (!both.hidden || text === undefined) return;
    both.hidden = false;
    dialog.classList.add("wide-dialog");
    const [own, other] = differing(mine, text);
    const pane = (name: string, words: string, lines: number[]) => {
      const host = el("div", { class: "code" });
      both.append(el("section", { "aria-label": name }, el("h3", {}, name), host));
      const editor = new Editor(host, { label: name, readOnly: true, colours, words: () => Promise.resolve(undefined) });
      editor.open(words);
      editor.markPairs(lines, true);
    };
    pane(tell("mine"), mine, own);
    pane(tell("theirs", { revision: theirs.revision }), text, other);
    both.append(el("p", { role: "status" }, tell("linesDiffer", { count: Math.max(own.length, other.length) })));
  };
  const does = (name: string, act: () => void, primary = false) => el("button", { class: primary ? "primary" : "", autofocus: primary, onclick: act }, name);
  const end = (act: () => Promise<void>) => () => {
    dialog.close();
    void act();
  };
  const acts = [
    ...(text === undefined ? [] : [does(tell("seeBoth"), see)]),
    does(tell("keepMine"), end(() => server.keepMine(conflict)), true),
    ...(text === undefined ? [] : [does(tell("takeTheirs"), end(() => server.takeTheirs(conflict)))]),
    does(tell("editOn"), () => dialog.close()),
  ];
  const why = el("p", {}, tell(text === undefined ? "goneHow" : "changedHow", values), ...(theirs.message ? [el("q", {}, theirs.message)] : []));
  const dialog = dialogOf("conflict-dialog", tell("changed"), why, el("div", { class: "acts" }, ...acts), both);
  dialog.addEventListener("close", () => server.conflict.set(undefined));
}
