// What the page knows of its program, and the work that keeps it true: after a change the program is checked and executed,
// and translated while somebody looks. Work that a change overtakes is given up. Not here: elements.

import { Cancelled, type Answer, type Engine, type Request } from "./engine/engine";
import type { Colours, Findings, Listed, Problem, Report } from "./engine/documents";
import type { Words } from "./editor/words";
import type { Engines } from "./engine/host";
import { readBetween, readCut, readHeights, type Between, type Cut, type Heights } from "./engine/part";
import { readPath, type Path } from "./engine/path";
import { bytesOf, type Choices, type Project } from "./projects/project";
import { ANSWERS } from "./projects/zip";
import { setUpOf, sideOf, SIDES, type SetUp, type Side, type SideName, type Stated } from "./setup/stated";
import { Signal } from "./ui/signal";

/** What a check has found. */
export interface Checked {
  problems: Problem[];
  notChecked: { what: string; why: string }[];
  /** What the compiler says where it cannot check: no dialect is recognised, a program for a lathe. */
  told: string;
}

export interface Translation {
  /** The program, if it is released. */
  output: string | undefined;
  /** Of each of its lines the line of the source, 0 where the source says nothing of it. */
  lines: Uint32Array | undefined;
  report: Report | undefined;
  messages: string;
}

/** A program that the open one is held against. */
export interface Other {
  name: string;
  bytes: Uint8Array;
  from: string;
  machine: string;
  options: Record<string, string>;
}

export type State = "loading" | "ready" | "working" | "failed";

const NOTHING: Checked = { problems: [], notChecked: [], told: "" };

/** So long a change waits for the next one, ms: at least, and at most. */
const [SOON, LATE] = [90, 900];
/** Work that has run so long is given up for newer work; what is younger ends sooner than another engine starts. */
const YOUNG = 250;
/** A part that takes longer is slow, ms. */
const SLOW = 400;
/** Cells along the longer side of the part: where cutting is quick, and where it is not. */
const [FINE, COARSE] = [1024, 512];
/** So many cells are lowered in about ten seconds. */
const MUCH = 2e10;

export class Session {
  readonly state = new Signal<State>("loading");
  /** Whether all is done: nothing runs, and no change waits. */
  readonly idle = new Signal(false);
  readonly project = new Signal<Project | undefined>(undefined);
  /** The dialect that the program is read in. */
  readonly dialect = new Signal("");
  readonly checked = new Signal<Checked>(NOTHING);
  /** What the program's `ncc.toml` states, and what the compiler says where that has faults. */
  readonly stated = new Signal<Stated | undefined>(undefined);
  statedTold = "";
  /** Puts profiles of machines that the compiler does not have itself. */
  putMachines: (engine: Engine, choices: Choices) => Promise<void> = () => Promise.resolve();
  /** Gives a file that lies beside the program. */
  beside: (name: string) => Promise<Uint8Array | undefined> = () => Promise.resolve(undefined);
  readonly path = new Signal<Path | undefined>(undefined);
  /** Why there is no path, or no part. */
  readonly pathTold = new Signal("");
  /** What the program cuts, told with its path; and the part as it is shown. */
  cut: Cut | undefined;
  readonly part = new Signal<Heights | undefined>(undefined);
  readonly translation = new Signal<Translation | undefined>(undefined);
  /** Whether somebody looks at the translation. */
  readonly translates = new Signal(false);
  /** Cells along the longer side of the part, at most. */
  mostCells = 4096;
  dialects: Listed[] = [];
  machines: Listed[] = [];

  private engines: Engines | undefined;
  private text: () => string = () => "";
  private generation = 0;
  private timer = 0;
  private began = 0;
  private lasted = 0;
  private cutLasted = 0;
  private readonly known = new Map<string, Promise<Words | undefined>>();
  private seeking = false;
  /** The reading that `stated` tells of, or will: what a newer one overtakes tells nothing. */
  private reading: { key: string; beside: Map<string, Uint8Array | undefined>; done: Promise<void> } | undefined;
  /** The program that calls others of its folder. */
  private calls = "";
  private wantedMoves = Infinity;
  private shownMoves = Infinity;
  /** Texts that the quick engine has, by their files. */
  private readonly coloured = new Map<string, object>();

  /** The engines are there. */
  async start(engines: Engines, text: () => string): Promise<void> {
    this.text = text;
    const lists = ["dialects", "machines"].map((verb) => engines.quick.run({ verb }));
    const [dialects, machines] = await Promise.all(lists);
    this.dialects = dialects?.json<Listed[]>("document") ?? [];
    this.machines = machines?.json<Listed[]>("document") ?? [];
    this.engines = engines;
    this.began = performance.now();
    this.state.set("ready");
    this.change();
  }

  /** The text or a choice is another. */
  change(): void {
    this.generation += 1;
    this.idle.set(false);
    clearTimeout(this.timer);
    const wait = Math.min(LATE, Math.max(SOON, this.lasted * 0.25));
    this.timer = window.setTimeout(() => void this.work(), wait);
  }

  /** The engines whose work takes its time; on a server they are one. */
  private get working(): Set<Engine> {
    return new Set(this.engines && [this.engines.check, this.engines.heavy]);
  }

  private get all(): Engine[] {
    return this.engines ? [this.engines.quick, ...this.working] : [];
  }

  /** Another project is open: nothing of the one before holds. */
  reset(): void {
    this.checked.set(NOTHING);
    this.cut = undefined;
    this.path.set(undefined);
    this.part.set(undefined);
    this.pathTold.set("");
    this.translation.set(undefined);
    this.dialect.set("");
    this.statedTold = "";
    this.reading = undefined;
    this.stated.set(undefined);
    this.calls = "";
    // A program of another folder is no program that this one calls.
    this.all.forEach((one) => one.clear?.());
    this.coloured.clear();
    this.change();
  }

  /** Gives up what runs. */
  cancel(): void {
    clearTimeout(this.timer);
    this.generation += 1;
    this.working.forEach((one) => one.cancel());
    this.state.set("ready");
  }

  /** Colours of some lines of a text that is the program, or the translation. */
  async colours(text: object, from: string, first: number, lines: number): Promise<Colours | undefined> {
    const quick = this.engines?.quick;
    if (!quick) return undefined;
    const file = `colours-${from}`;
    if (this.coloured.get(file) !== text) {
      this.coloured.set(file, text);
      quick.put(file, new TextEncoder().encode(String(text)));
    }
    const answer = await quick.run({ verb: "colours", file, from, first, lines });
    return answer.json<Colours>("document");
  }

  /** The words of a dialect; they are asked for once. */
  words(dialect: string): Promise<Words | undefined> {
    const quick = this.engines?.quick;
    if (!quick || !dialect) return Promise.resolve(undefined);
    const found = this.known.get(dialect) ?? quick.run({ verb: "words", dialect }).then((answer) => answer.json<Words>("document"));
    this.known.set(dialect, found);
    return found;
  }

  /** Asks about the text as it is now; what nobody can answer yet is not answered. */
  async ask(verb: string, more: Record<string, unknown>): Promise<Answer | undefined> {
    const [project, quick] = [this.project.get(), this.engines?.quick];
    if (!project || !quick) return undefined;
    quick.put(project.file, bytesOf(project, this.text()));
    await this.putMachines(quick, project.choices);
    return quick.run({ verb, ...this.request(project), ...more });
  }

  /** The same, with other files beside the text, which are empty again afterwards: of those that its `ncc.toml` names there is no
   * need. */
  async askAmong(files: [id: string, name: string, bytes: Uint8Array][], verb: string, more: Record<string, unknown>): Promise<Answer | undefined> {
    const [quick, stored] = [this.engines?.quick, this.project.get()?.server];
    if (stored && quick?.called) {
      await quick.called(stored.program);
      return this.ask(verb, more);
    }
    const others = files.filter(([, name]) => !this.reading?.beside.has(name));
    for (const [, name, bytes] of others) quick?.put(name, bytes);
    try {
      return await this.ask(verb, more);
    } finally {
      for (const [, name] of others) quick?.put(name, new Uint8Array());
    }
  }

  /** What is set up for the open program: what was chosen, and else what its `ncc.toml` states. */
  get setUp(): SetUp | undefined {
    const choices = this.project.get()?.choices;
    return choices && setUpOf(choices, this.stated.get());
  }

  /** The text of a project file with what was chosen for the program, or with parts of its set-up alone; `answers` is the one
   * that there is, `without` an option that is taken back. */
  async answers(answers: string | undefined, set?: Partial<SetUp> & { tools?: string[] }, without?: readonly [SideName, string]): Promise<Answer | undefined> {
    const [project, quick] = [this.project.get(), this.engines?.quick];
    if (!project || !quick) return undefined;
    const sides = SIDES.map((side) => sideOf(side, project.choices, this.stated.get()));
    const [own, target] = sides as [Side, Side];
    if (without) delete (without[0] === "fromOption" ? own : target).options[without[1]];
    const file = project.disk?.name ?? project.file;
    quick.put(file, bytesOf(project, this.text()));
    if (answers !== undefined) quick.put(ANSWERS, new TextEncoder().encode(answers));
    const known = answers === undefined ? {} : { project: ANSWERS };
    const side = { ...given({ from: own.dialect, machine_from: own.machine }), from_option: own.options };
    if (set) {
      const table = set.table === undefined ? {} : { table: set.table ? [Number(set.table)] : [] };
      // A tool stands with a machine.
      return quick.run({ verb: "project", file, ...known, ...set, ...table, ...(set.tools && side) });
    }
    const to = { ...given({ to: target.dialect, machine_to: target.machine }), to_option: target.options };
    return quick.run({ verb: "project", file, ...known, ...side, ...to });
  }

  /** Cuts the program and its translation from one raw part; their difference, or why it is unknown. */
  async compare(to: string): Promise<Between | string | undefined> {
    const [project, heavy] = [this.project.get(), this.engines?.heavy];
    const output = this.translation.get()?.output;
    if (!project || !heavy || output === undefined) return undefined;
    const own = this.generation;
    const file = `translated-${project.file}`;
    heavy.put(file, new TextEncoder().encode(output));
    const { choices } = project;
    const { machine, options } = sideOf("toOption", choices, this.stated.get());
    const compare = { file, ...given({ from: to, machine }), from_option: options };
    const one = { ...this.request(project), ...bench(choices) };
    try {
      const answer = await heavy.run({ verb: "simulate", ...one, cells: this.cells(choices), compare });
      return own === this.generation ? (readBetween(answer) ?? answer.text("messages")) : undefined;
    } catch (error) {
      if (error instanceof Cancelled) return undefined;
      return String(error);
    }
  }

  /** What two programs do, held against each other; and the way of the other one. */
  async compareMoves(other: Other): Promise<[Answer, Answer] | undefined> {
    const [project, heavy] = [this.project.get(), this.engines?.heavy];
    if (!project || !heavy) return undefined;
    heavy.put(other.name, other.bytes);
    const one = this.request(project);
    const { from, machine, options } = other;
    const b = { file: other.name, ...given({ from, machine }), from_option: options };
    try {
      return [await heavy.run({ verb: "diff", a: one, b }), await heavy.run({ verb: "path", ...b })];
    } catch (error) {
      if (error instanceof Cancelled) return undefined;
      throw error;
    }
  }

  /** Cells along the longer side: what was chosen, or as many as are cut soon enough, by the last path and its tools. */
  private cells({ cells }: Choices): number {
    const [path, cut] = [this.path.get(), this.cut];
    if (cells > 0 || !path || !cut) return cells || FINE;
    const cell = (cut.raw.cell * Math.max(...cut.raw.cells)) / FINE;
    const of = cut.tools.map((tool) => (tool.diameter / cell) ** 2);
    let work = 0;
    for (let piece = 0; piece < path.pieces; piece += 1) work += of[path.tool[piece] as number] ?? 0;
    return work > MUCH ? COARSE : FINE;
  }

  private async work(): Promise<void> {
    const [project, engines] = [this.project.get(), this.engines];
    if (!project || !engines) return;
    const { heavy } = engines;
    const working = [...this.working];
    if (working.some((one) => one.waiting > 0)) {
      if (performance.now() - this.began < YOUNG) {
        this.timer = window.setTimeout(() => void this.work(), 40);
        return;
      }
      working.forEach((one) => one.cancel());
    }
    const own = this.generation;
    this.began = performance.now();
    this.state.set("working");
    try {
      const bytes = bytesOf(project, this.text());
      for (const one of working) {
        one.put(project.file, bytes);
        await this.putMachines(one, project.choices);
      }
      for (const [name, bytes] of Object.entries(project.bodies ?? {})) heavy.put(name, bytes);
      if (project.server && this.calls === project.id) await heavy.called?.(project.server.program);
      await this.readStated(project);
      await this.steps(engines, project, () => own === this.generation);
      if (own === this.generation) {
        this.lasted = performance.now() - this.began;
        this.state.set("ready");
        this.idle.set(true);
      }
    } catch (error) {
      if (error instanceof Cancelled || own !== this.generation) return;
      // The answer of the other engine would replace it.
      this.generation += 1;
      this.checked.set({ ...NOTHING, told: error instanceof Error ? error.message : String(error) });
      this.state.set("failed");
    }
  }

  /** Reads what the program's project file states, where that is another one. */
  async readStated(project: Project): Promise<void> {
    const { engines } = this;
    const key = project.answers === undefined ? "" : `${project.id} ${project.answers}`;
    if (!engines) return;
    if (key === this.reading?.key) return this.reading.done;
    const beside = new Map<string, Uint8Array | undefined>();
    const own = { key, beside, done: Promise.resolve() };
    this.reading = own;
    own.done = this.readAnew(engines, project, beside, () => own === this.reading);
    // One that failed is begun again.
    own.done.catch(() => own === this.reading && (this.reading = undefined));
    return own.done;
  }

  /** Files beside the program may be others: where one that its `ncc.toml` names is, all is read again. */
  async lookBeside(): Promise<void> {
    const { reading } = this;
    for (const [name, bytes] of reading?.beside ?? []) {
      const now = await this.beside(name);
      if (reading !== this.reading) return;
      if (isSame(bytes, now)) continue;
      // One that is gone does not stay in the engines.
      if (!now) this.all.forEach((one) => one.put(name, new Uint8Array()));
      this.reading = undefined;
      return this.change();
    }
  }

  private async readAnew(engines: Engines, project: Project, beside: Map<string, Uint8Array | undefined>, current: () => boolean): Promise<void> {
    const ask = async () => {
      const answer = await engines.quick.run({ verb: "stated", file: project.file, project: ANSWERS });
      return [answer.json<Stated>("document"), answer.code === 0 ? "" : answer.text("messages").trim()] as const;
    };
    const put = (name: string, bytes: Uint8Array) => this.all.forEach((one) => one.put(name, bytes));
    let [stated, told]: readonly [Stated | undefined, string] = [undefined, ""];
    if (project.answers !== undefined) {
      put(ANSWERS, new TextEncoder().encode(project.answers));
      [stated, told] = await ask();
      for (const name of stated?.files ?? []) beside.set(name, await this.beside(name));
      // A newer reading has its own text in the engines.
      if (!current()) return;
      const found = [...beside].filter((file): file is [string, Uint8Array] => file[1] !== undefined);
      found.forEach(([name, bytes]) => put(name, bytes));
      if (found.length > 0) [stated, told] = await ask();
    }
    if (!current() || project.id !== this.project.get()?.id) return;
    this.statedTold = told;
    this.stated.set(stated);
  }

  /** Fields of a program that is executed. */
  private request({ file, choices }: Project): Omit<Request, "verb"> {
    const { from, machine, fromOption } = choices;
    const project = this.stated.get() ? ANSWERS : "";
    return { file, ...given({ from, machine, project }), from_option: fromOption };
  }

  private async steps({ check, heavy }: Engines, project: Project, current: () => boolean): Promise<void> {
    const own = this.request(project);
    const one = { ...own, ...zero(project.choices) };
    // A part that takes its time comes later: until then the one before stands with the new path.
    const early = this.cutLasted > SLOW ? heavy.run({ verb: "path", ...one }) : undefined;
    let checking = check.run({ verb: "check", ...one });
    const show = (answer: Answer) => (current() ? this.tellCheck(answer) : undefined);
    let checked = checking.then(show);
    // A failure is reported at the `await` of its answer, which may come later.
    [early, checked].forEach((one) => void one?.catch(() => undefined));
    const path = await early;
    if (!current()) return;
    const bytes = path?.bytes("path");
    if (bytes) this.path.set(readPath(bytes, path?.bytes("modes")));
    if (project.server && heavy.called && this.calls !== project.id && lacksCalled(await checking)) {
      this.calls = project.id;
      // A folder that is too large, or gone, has nothing to call: the program says so.
      await heavy.called(project.server.program).catch(() => undefined);
      checking = check.run({ verb: "check", ...one });
      checked = checking.then(show);
      checked.catch(() => undefined);
      if (!current()) return;
    }
    const began = performance.now();
    const cut = await heavy.run({ verb: "simulate", ...one, ...bench(project.choices), cells: this.cells(project.choices) });
    this.cutLasted = performance.now() - began;
    if (!current()) return;
    this.tellCut(cut);
    await checked;
    if (!current()) return;
    this.tellAlarms();
    if (!this.translates.get()) return this.translation.set(undefined);
    if (!project.choices.to && !project.choices.machineTo && !this.stated.get()?.to) return this.translation.set(undefined);
    const translated = await heavy.run({ verb: "translate", ...own, ...translation(project.choices), map: true });
    if (!current()) return;
    const output = translated.bytes("output");
    this.translation.set({
      output: output && new TextDecoder().decode(output),
      lines: linesOf(translated.bytes("lines")),
      report: translated.json<Report>("report"),
      messages: translated.text("messages"),
    });
  }

  private tellCheck(answer: Answer): void {
    const program = answer.json<Findings>("findings")?.programs[0];
    this.dialect.set(program?.dialect ?? "");
    if (!program) return this.checked.set({ ...NOTHING, told: answer.text("messages") });
    const problems = program.findings.map(({ id, ...rest }) => ({ code: id, ...rest }));
    this.checked.set({ problems, notChecked: program.not_checked, told: "" });
  }

  private tellCut(answer: Answer): void {
    const bytes = answer.bytes("path");
    this.cut = readCut(answer);
    this.shownMoves = this.wantedMoves = Infinity;
    this.pathTold.set(this.cut ? "" : answer.text("messages"));
    this.path.set(bytes && readPath(bytes, answer.bytes("modes")));
    this.part.set(readHeights(answer));
  }

  private tellAlarms(): void {
    const alarms = (this.cut?.alarms ?? []).map(({ id, ...rest }) => ({ code: id, ...rest }));
    const checked = this.checked.get();
    if (alarms.length > 0) this.checked.set({ ...checked, problems: [...alarms, ...checked.problems] });
  }

  /** Whether a part is on its way. */
  get seeks(): boolean {
    return this.seeking;
  }

  /** Shows the part after so many moves; while one is on its way, the last that is wanted waits. */
  async seek(moves: number): Promise<void> {
    // A new part comes as all moves leave it.
    const path = this.path.get();
    this.wantedMoves = path && moves >= (path.move[path.pieces - 1] ?? 0) ? Infinity : moves;
    const heavy = this.engines?.heavy;
    if (!heavy || !this.part.get() || this.seeking) return;
    this.seeking = true;
    const own = this.generation;
    try {
      while (this.wantedMoves !== this.shownMoves && own === this.generation) {
        const wanted = this.wantedMoves;
        const answer = await heavy.run({ verb: "seek", moves: Math.min(wanted, 2 ** 31) });
        if (own !== this.generation) return;
        this.shownMoves = wanted;
        const heights = readHeights(answer);
        if (heights) this.part.set(heights);
      }
    } catch (error) {
      if (!(error instanceof Cancelled)) throw error;
    } finally {
      this.seeking = false;
    }
  }
}

/** Whether a program calls one that is not at hand. */
function lacksCalled(answer: Answer): boolean {
  return answer.text("findings").includes("NC0811");
}

function isSame(one: Uint8Array | undefined, other: Uint8Array | undefined): boolean {
  return one?.length === other?.length && (one ?? []).every((byte, at) => byte === other?.[at]);
}

function linesOf(bytes: Uint8Array | undefined): Uint32Array | undefined {
  return bytes && new Uint32Array(bytes.slice().buffer);
}

function given(entries: Record<string, string | undefined>): Record<string, string> {
  return Object.fromEntries(Object.entries(entries).filter(([, value]) => value)) as Record<string, string>;
}

/** Fields of what it cuts, and with what. */
function bench({ stock, tools, fixtures, table }: Choices): Record<string, unknown> {
  const stated = Object.entries(tools).map(([number, text]) => `${number}=${text}`);
  return { ...given({ stock }), tools: stated, fixtures, ...(table && { table: Number(table) }) };
}

/** Where the zero of the part lies on the machine. */
function zero({ zero }: Choices): { zero?: number[] } {
  return zero.length === 3 ? { zero: zero.map(Number) } : {};
}

/** Fields of a translation; the machine of the program has another name there. */
function translation({ to, machine, machineTo, toOption, pass }: Choices): Record<string, unknown> {
  return { machine: undefined, ...given({ to, machine_from: machine, machine_to: machineTo }), to_option: toOption, pass };
}
