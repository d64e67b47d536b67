// The page put together: who tells whom.

import { Editor } from "./editor/editor";
import { Editing } from "./editor/editing";
import { Outline } from "./editor/outline";
import { ProblemList } from "./editor/problems";
import type { Colours } from "./engine/documents";
import { TooOld, hostName, loopbackToken, openEngines } from "./engine/host";
import { MachinePane } from "./machine/pane";
import { PART_COMES } from "./machine/view";
import { Desk, download } from "./projects/desk";
import { ProjectsDialog, wireDrop } from "./projects/dialog";
import { EXAMPLES, type Example } from "./projects/examples";
import { Folder } from "./projects/folder";
import { Store, stored } from "./projects/store";
import { Api } from "./server/api";
import { Bar } from "./server/bar";
import { showConflict, showRevisions } from "./server/dialogs";
import { ServerList } from "./server/list";
import { enter } from "./server/login";
import { Room } from "./server/room";
import { Server } from "./server/server";
import { Translations } from "./server/translations";
import { Session } from "./session";
import { SetupPane } from "./setup/pane";
import { Charts } from "./time/charts";
import { Player, movesOver } from "./time/player";
import { Transport } from "./time/transport";
import { TranslatePane } from "./translate/pane";
import { ChoiceLists } from "./ui/choice-lists";
import { byId } from "./ui/dom";
import { wireKeys } from "./ui/keys";
import { Panes, fillWords, showTheme, wireLanguage, wireSplit, wireTheme, wireToggle } from "./ui/layout";
import { chooseLanguage, say } from "./ui/texts";

// The compiler is on its way while the page is built; a failure is told where it is waited for.
const api = SERVER && hostName() === "serve" ? new Api(enter) : undefined;
const coming = openEngines(SERVER && api ? (room) => new Room(api, room) : undefined);
coming.catch(() => undefined);

const language = chooseLanguage(stored("ncc-language"));
fillWords();
wireLanguage(language);
wireSplit();
showTheme();
// The frame is seen before the rest is made.
await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));

const session = new Session();
const player = new Player();
let follow = true;
/** Whether the user put the moment somewhere: then a new path leaves it there. */
let placed = false;

/** Colours of lines of a text in the program's dialect. */
function colours(doc: object, first: number, lines: number): Promise<Colours | undefined> {
  const from = session.project.get()?.choices.from ?? "auto";
  return session.colours(doc, from === "auto" ? session.dialect.get() || from : from, first, lines);
}

const editor = new Editor(byId("editor"), {
  label: say("program"),
  colours,
  words: () => {
    const from = session.project.get()?.choices.from ?? "auto";
    return session.words(from === "auto" ? session.dialect.get() : from);
  },
  // Behind a change nothing is known of the text until it was executed again.
  modes: (line) => (session.idle.get() ? session.path.get()?.modes?.ofLine(line) : undefined),
  changed: () => {
    desk.changed();
    session.change();
  },
  cursor: (line) => {
    machine?.mark(line);
    translate.markSource(line);
  },
  goTo: () => void editing.goTo(),
  rename: () => void editing.rename(),
  layOut: () => void editing.layOut(),
});
const token = loopbackToken();
const folder = token === undefined ? undefined : new Folder(token);
const desk = new Desk(await Store.open(), session, editor, folder);
const server = SERVER && api ? new Server(api, desk, session, editor) : undefined;
if (SERVER && server) {
  desk.remote = server;
  // The server's limit.
  session.mostCells = 2048;
  new Bar(server, () => void showRevisions(server));
  server.conflict.on((conflict) => conflict && showConflict(server, conflict, colours));
}
const editing = new Editing(session, editor, desk);
const problems = new ProblemList(({ place: { line, column }, time }) => {
  editor.goTo(line, column);
  editor.focus();
  machine?.mark(line);
  if (time === undefined) return;
  player.playing.set(false);
  player.seek(time);
});
const outline = new Outline(
  (first, lines) => colours(editor.doc, first, lines),
  ({ line, from }) => {
    editor.goTo(line);
    editor.focus();
    player.playing.set(false);
    player.seek(from);
  },
  (sections) => editor.setSections(sections),
);
const charts = new Charts(byId("charts"), (time) => {
  player.playing.set(false);
  player.seek(time);
});
const transport = new Transport(player);
let machine: MachinePane | undefined;

/** The picture, made for the first program: until a browser has a context for it the page does nothing else. */
function picture(): void {
  if (machine) return;
  machine = new MachinePane(player, (line) => {
    editor.goTo(line);
    panes.show("machine", document.body.dataset.pane === "machine" ? "machine" : "editor");
  });
  machine.setBodies(new Map(Object.entries(session.project.get()?.bodies ?? {})));
}

const translate = new TranslatePane(session, desk, editor);
if (SERVER && server) new Translations(server);
new SetupPane(session, desk);
const lists = new ChoiceLists(session, desk);
const panes = new Panes((tab, pane) => {
  const looks = tab === "translate";
  if (looks !== session.translates.get()) {
    session.translates.set(looks);
    if (looks) session.change();
  }
  if (pane === "time") charts.draw();
  machine?.draw();
});
const dialog = new ProjectsDialog(desk, language, SERVER && server ? new ServerList(server) : undefined);

byId("projects-open").addEventListener("click", () => void dialog.open());
byId("cancel").addEventListener("click", () => session.cancel());
byId("export").addEventListener("click", () => {
  const id = desk.project?.id;
  if (id) void desk.file(id).then((file) => file && download(...file));
});
wireToggle("follow", (on) => (follow = on));
wireToggle("charts-toggle", (on) => {
  byId("charts-pane").hidden = !on;
  charts.draw();
});
byId("block-modes").addEventListener("click", () => editor.showBlock());
wireDrop((files) => void dialog.drop(files));
wireKeys({ desk, player, editor, projects: () => void dialog.open(), toLine: (line) => machine?.runTo(line) });
wireTheme(() => {
  machine?.restyle();
  charts.draw();
  transport.draw();
  translate.draw();
});

session.project.on((project) => {
  machine?.setBodies(new Map(Object.entries(project?.bodies ?? {})));
  byId("project-name").textContent = project?.name ?? "";
  document.title = project ? `${project.name} · ncc studio` : "ncc studio";
});
desk.saved.on((state) => (byId("save-state").textContent = say(state)));
session.state.on((state) => {
  const place = byId("state");
  place.dataset.state = state;
  place.textContent = say(state);
  byId("cancel").hidden = state !== "working";
});
session.idle.on((idle) => (byId("state").dataset.idle = String(idle)));
session.checked.on((checked) => {
  problems.show(checked);
  editor.setProblems(checked.problems);
});
session.dialect.on(() => editor.recolour());
session.path.on((path) => {
  void outline.show(path, session.cut);
  transport.setPath(path);
  player.open(path, placed);
  charts.setPath(path);
  if (path) picture();
  machine?.setPath(path, session.cut, session.pathTold.get());
  transport.setAlarms(session.cut?.alarms ?? []);
});
session.pathTold.on((told) => {
  if (told) picture();
  machine?.setTold(session.path.get(), told);
});
let marking = 0;
/** Whether the part has come, and its picture alone is waited for. */
let due = false;

/** The moment in editor and charts: while a part is on its way, after its picture. To scroll takes as long as to draw. */
function mark(): void {
  clearTimeout(marking);
  marking = 0;
  due = false;
  const [path, now] = [session.path.get(), player.now.get()];
  charts.setTime(now.time, now.piece, now.share);
  // The end of a program is where a page begins: no line is marked then.
  const line = path && placed && now.piece >= 0 ? (path.line[now.piece] ?? 0) : 0;
  editor.markNow(line, follow);
}

session.part.on((part) => {
  machine?.setPart(part);
  // While a program plays the next part may come sooner: the first of them counts.
  if (!marking || due) return;
  due = true;
  clearTimeout(marking);
  // The browser shows a picture in about the time that it takes.
  marking = window.setTimeout(mark, 2 * (machine?.lasts ?? 0));
});
player.now.on((now) => {
  const path = session.path.get();
  placed = player.seconds > 0 && now.time < player.seconds;
  if (path) void session.seek(movesOver(path, now));
  machine?.setNow(path, now, session.seeks);
  if (!session.seeks) return mark();
  // While a program plays, moments follow each other faster than parts.
  marking ||= window.setTimeout(mark, PART_COMES);
});

await desk.begin().catch(() => desk.example(EXAMPLES[0] as Example));
try {
  const engines = await coming;
  await session.start(engines, () => editor.text);
  // Without them the machines that come with ncc can be chosen.
  await server?.listMachines().catch(() => undefined);
  lists.fill();
  editor.recolour();
} catch (error) {
  picture();
  session.state.set("failed");
  session.checked.set({ problems: [], notChecked: [], told: `${say(error instanceof TooOld ? "tooOld" : hostName() === "worker" ? "noEngine" : "noAnswer")}\n${String(error)}` });
}
if ("serviceWorker" in navigator && hostName() === "worker") {
  void navigator.serviceWorker.register("sw.js").catch(() => undefined);
}
