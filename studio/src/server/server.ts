// The open program of the server: opened, saved as a revision, and what happens where somebody else was first.

import type { Editor } from "../editor/editor";
import type { Engine } from "../engine/engine";
import type { Desk, Remote } from "../projects/desk";
import { bytesOf, projectOf, textOf, type Choices, type OnServer, type Project } from "../projects/project";
import type { Session } from "../session";
import { Signal } from "../ui/signal";
import { Refused, wordsOf, type Api } from "./api";
import { Programs, type Machine, type Program } from "./programs";
import { moment, tell } from "./texts";

/** What stands in front of the names of machines that the server keeps: a program may have the same name. */
const OWN = "machine ";

/** What somebody else has saved meanwhile. */
export interface Conflict {
  theirs: Program;
  /** Their text; none where the program was deleted. */
  text: string | undefined;
  mine: string;
  base: number;
}

/** What is told of the open program, and what may be done about it. */
export interface Told {
  text: string;
  bad?: boolean;
  act?: [name: string, does: () => void];
}

/** How a program is opened. */
interface Opening {
  revision?: number;
  fresh?: boolean;
  asked?: number;
}

const NOTHING: Told = { text: "" };

export class Server implements Remote {
  readonly programs: Programs;
  readonly told = new Signal<Told>(NOTHING);
  readonly conflict = new Signal<Conflict | undefined>(undefined);
  /** The message of the next revision. */
  message = "";
  private saving = false;
  private readonly profiles = new Map<string, Promise<Uint8Array>>();
  /** Machines that the server keeps itself. */
  private machines: Promise<Machine[]> | undefined;
  private owned = new Set<string>();

  constructor(
    readonly api: Api,
    readonly desk: Desk,
    private readonly session: Session,
    private readonly editor: Editor,
  ) {
    this.programs = new Programs(api);
    session.putMachines = (engine, choices) => this.putMachines(engine, choices);
    addEventListener("visibilitychange", () => document.hidden || void this.look().catch(() => undefined));
  }

  /** The id of a program among the browser's projects: drafts are their user's. */
  private key(program: string): string {
    return `server/${this.api.session.get().user ?? ""}/${program}`;
  }

  async open(id: string, asked: number): Promise<boolean> {
    await this.api.begin();
    const own = this.key("");
    if (!id.startsWith(own)) return false;
    const kept = await this.desk.store.get(id);
    const isDraft = kept?.[0].server?.draft === true;
    try {
      const program = id.slice(own.length);
      if (!isDraft && (await this.programs.read(program)).change === "deleted") return false;
      await this.openProgram(program, { asked });
    } catch (error) {
      if (!kept || !isDraft) return false;
      this.desk.show(...kept, asked);
      this.told.set({ text: wordsOf(error), bad: true });
    }
    return true;
  }

  /** Opens a program, or one of its older revisions, which is only looked at; `fresh` is without a text that was not saved. */
  async openProgram(id: string, { revision, fresh = false, asked = this.desk.newlyAsked() }: Opening = {}): Promise<void> {
    if (!fresh) await this.desk.save();
    const [latest] = await Promise.all([this.programs.read(id), this.ownMachines()]);
    this.profiles.clear();
    const isOld = revision !== undefined && revision !== latest.revision;
    const about = isOld ? await this.programs.revision(id, revision) : latest;
    const [made, text] = projectOf(about.name, about.name, await this.programs.text(id, about.revision));
    // What was typed meanwhile.
    if (!fresh) await this.desk.save();
    const kept = isOld ? undefined : await this.desk.store.get(this.key(id));
    const project: Project = {
      ...made,
      id: this.key(id),
      choices: { ...(kept?.[0] ?? made).choices, from: about.dialect ?? "auto", machine: this.choiceOf(about.machine ?? "") },
      server: { ...placed(about), ...(isOld && { latest: latest.revision }) },
    };
    this.told.set(NOTHING);
    this.message = "";
    if (kept?.[0].server?.draft && !fresh) return this.showDraft(kept, project, text, asked);
    if (!isOld) await this.desk.store.put(project, text);
    this.desk.show(project, text, asked);
  }

  /** A text that was not saved goes before that of the server, over the revision that it comes from. */
  private async showDraft([kept, own]: [Project, string], project: Project, text: string, asked: number): Promise<void> {
    const { from, machine } = kept.choices;
    const isSame = own === text && from === project.choices.from && machine === project.choices.machine;
    if (isSame) {
      await this.desk.store.put(project, text);
      return this.desk.show(project, text, asked);
    }
    const now = project.server as OnServer;
    const base = (kept.server as OnServer).revision;
    this.desk.show({ ...kept, name: project.name, file: project.file, server: { ...now, revision: base, draft: true } }, own, asked);
    this.told.set({ text: tell("draft", { revision: now.revision }), act: [tell("dropDraft"), () => this.reopen(true)] });
  }

  /** Opens the program as it is on the server; a failure is told. */
  reopen(fresh = false): void {
    const own = this.desk.project?.server;
    if (own) void this.tries(() => this.openProgram(own.program, { fresh }));
  }

  async tries(work: () => Promise<unknown>): Promise<void> {
    try {
      await work();
    } catch (error) {
      this.told.set({ text: wordsOf(error), bad: true });
    }
  }

  /** Saves the open program as a revision over the one that was read. */
  async save(): Promise<void> {
    const project = this.desk.project;
    const own = project?.server;
    if (!project || !own || own.latest || this.saving) return;
    const text = this.editor.text;
    this.saving = true;
    this.desk.saved.set("saving");
    this.told.set(NOTHING);
    try {
      let now = await this.programs.save(own.program, own.revision, bytesOf(project, text), this.message);
      const [dialect, machine] = [stated(project.choices.from), this.nameOf(project.choices.machine)];
      if (dialect !== own.dialect || machine !== own.machine) {
        const change = { dialect: dialect || null, machine: machine || null, message: this.message };
        now = await this.programs.change(own.program, now.revision, change as Record<string, string | null>);
      }
      const isNew = now.revision !== own.revision;
      this.message = "";
      await this.keep(project, now, text);
      this.told.set({ text: isNew ? tell("savedAs", { revision: now.revision }) : tell("noChange") });
    } catch (error) {
      this.desk.saved.set("unsaved");
      await this.desk.save();
      if (error instanceof Refused && error.status === 412) await this.meet(own, text);
      else this.told.set({ text: wordsOf(error), bad: true });
    } finally {
      this.saving = false;
    }
  }

  /** The open program is a revision of the server by now; what was typed meanwhile is not saved. */
  private async keep(before: Project, now: Program, text: string): Promise<void> {
    const project = this.desk.project;
    if (!project || project.id !== before.id) return;
    const server: OnServer = placed(now);
    const isTyped = this.editor.text !== text;
    const kept: Project = { ...project, name: now.name, file: now.name, server, changed: Date.now() };
    this.session.project.set(kept);
    await this.desk.store.put(kept, text);
    this.desk.saved.set("saved");
    if (isTyped) this.desk.changed();
    else this.desk.tellOthers(kept.id);
  }

  /** Somebody else was first. */
  private async meet({ program, revision }: OnServer, mine: string): Promise<void> {
    const theirs = await this.programs.read(program);
    const project = this.desk.project;
    if (!project || project.server?.program !== program) return;
    const text = theirs.change === "deleted" ? undefined : textOf(project, await this.programs.text(program, theirs.revision));
    this.conflict.set({ theirs, text, mine, base: revision });
  }

  /** Keeps the own text on top of what somebody else has saved. */
  async keepMine({ theirs }: Conflict): Promise<void> {
    const project = this.desk.project;
    if (project?.server?.program !== theirs.id) return;
    this.conflict.set(undefined);
    try {
      const now = theirs.change === "deleted" ? await this.programs.restore(theirs.id, theirs.revision - 1, theirs.revision) : theirs;
      // Name, folder and settings are theirs; the text is one's own.
      this.session.project.set({ ...project, name: now.name, file: now.name, server: { ...placed(now), draft: true } });
    } catch (error) {
      this.told.set({ text: wordsOf(error), bad: true });
      return;
    }
    await this.save();
  }

  /** Takes what somebody else has saved; the own text is one step back. */
  async takeTheirs({ theirs, text }: Conflict): Promise<void> {
    const project = this.desk.project;
    if (project?.server?.program !== theirs.id || text === undefined) return;
    this.conflict.set(undefined);
    const choices = { ...project.choices, from: theirs.dialect ?? "auto", machine: this.choiceOf(theirs.machine ?? "") };
    this.session.project.set({ ...project, choices });
    this.editor.replace(text);
    this.session.change();
    await this.keep(project, theirs, text);
  }

  /** Whether somebody else has saved meanwhile. */
  private async look(): Promise<void> {
    const own = this.desk.project?.server;
    if (!own || own.latest) return;
    const now = await this.programs.read(own.program);
    const here = this.desk.project?.server;
    if (here?.program !== own.program || now.revision === here.revision || this.saving) return;
    const text = tell("movedOn", { author: now.author, revision: now.revision });
    // With a text that is not saved, saving it asks what to do.
    const isDraft = this.desk.saved.get() === "unsaved";
    const take = () => (isDraft ? void this.save() : this.reopen());
    this.told.set({ text, act: [tell(isDraft ? "seeBoth" : "takeIt"), take] });
  }

  /** A program has another name or folder. */
  moved(now: Program): void {
    const project = this.desk.project;
    const own = project?.server;
    if (!project || own?.program !== now.id || own.latest) return;
    // A text over an older revision stays one.
    const revision = own.revision === now.revision - 1 ? now.revision : own.revision;
    const kept = { ...project, name: now.name, file: now.name, server: { ...placed(now), revision, draft: own.draft } };
    this.session.project.set(kept);
    void this.desk.store.put(kept);
    this.session.change();
  }

  /** Ends the session. What is not saved stays, as its user's. */
  async logOut(): Promise<void> {
    await this.desk.save();
    await this.api.logOut();
    location.reload();
  }

  /** Makes the open program again what an older revision has. */
  async restore(number: number): Promise<void> {
    const own = this.desk.project?.server;
    if (!own || (this.desk.saved.get() === "unsaved" && !confirm(tell("restoreSure")))) return;
    try {
      const now = await this.programs.restore(own.program, number, own.latest ?? own.revision);
      await this.openProgram(own.program, { fresh: true });
      this.told.set({ text: tell("restored", { revision: now.revision }) });
    } catch (error) {
      const isLate = error instanceof Refused && error.status === 412;
      this.told.set({ text: isLate ? tell("changedShort") : wordsOf(error), bad: true });
    }
  }

  async others(project: Project): Promise<[id: string, name: string][]> {
    const own = project.server;
    const all = own ? await this.programs.inFolder(own.folder) : [];
    return all.filter((one) => one.id !== own?.program).map((one) => [this.key(one.id), one.name]);
  }

  async file(id: string): Promise<[string, Uint8Array, string] | undefined> {
    const about = await this.programs.read(id.slice(this.key("").length)).catch(() => undefined);
    return about && [about.name, await this.programs.text(about.id, about.revision), about.dialect ?? "auto"];
  }

  /** Machines that the server keeps are among those that can be chosen. */
  async listMachines(): Promise<void> {
    const all = await this.ownMachines();
    this.session.machines.push(...all.map(({ name, title, dialect }) => ({ id: OWN + name, title: title ?? name, ...(dialect && { dialect }) })));
  }

  private ownMachines(): Promise<Machine[]> {
    this.machines ??= this.programs.machines().then((all) => {
      const own = all.filter((one) => !one.ships_with_ncc);
      this.owned = new Set(own.map((one) => one.name));
      return own;
    });
    return this.machines;
  }

  /** The name that a chosen machine has on the server. */
  nameOf(choice: string): string {
    return choice.startsWith(OWN) ? choice.slice(OWN.length) : choice;
  }

  private choiceOf(name: string): string {
    return this.owned.has(name) ? OWN + name : name;
  }

  private async putMachines(engine: Engine, choices: Choices): Promise<void> {
    for (const choice of [choices.machine, choices.machineTo].filter((one) => one.startsWith(OWN))) {
      const found = this.profiles.get(choice) ?? this.programs.profile(this.nameOf(choice));
      this.profiles.set(choice, found);
      // One that is gone is told as a machine that is not there.
      const bytes = await found.catch(() => undefined);
      if (bytes) engine.put(choice, bytes);
    }
  }
}

/** What the page keeps of a program. */
function placed(about: Program): OnServer {
  const { id, folder, revision, dialect, machine, author, made } = about;
  return { program: id, folder, revision, dialect: dialect ?? "", machine: machine ?? "", author, made, draft: false };
}

function stated(from: string): string {
  return from === "auto" ? "" : from;
}

/** A program in words: its revision, by whom and when. */
export function aboutOf({ revision, author, made }: { revision: number; author: string; made: string }): string {
  return tell("about", { revision, author, when: moment(made) });
}

/** A folder and a name. */
export function pathOf(folder: string, name: string): string {
  return folder ? `${folder}/${name}` : name;
}
