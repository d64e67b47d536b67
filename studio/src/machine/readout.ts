// What stands over the picture: where the tool is, the axes' directions, the grid's step.

import { Vector3, type Camera } from "three";
import type { Tool } from "../engine/part";
import type { Active } from "../engine/modes";
import { Kind, isRapid, type Path } from "../engine/path";
import { placeOf, type Now } from "../time/player";
import { byId, el } from "../ui/dom";
import { modeElement } from "../ui/modes";
import { clock, figure, say } from "../ui/texts";

const KINDS = ["rapid", "feedMove", "clockwise", "counterclockwise", "away"] as const;

const SHORT = ["X", "Y", "Z", "A", "B", "C", "F", "S", "T", "block", "codes"];
const LINEAR = ["X", "Y", "Z"];
const ROTARY = ["A", "B", "C"];
const ROWS = ["head", ...LINEAR, ...ROTARY, "", "F", "S", "T", "Ø", "", "coolant", "offsets", "codes", "", "block", "move", "time"];

/** Modes that have a row of their own, or stand among others; what has a number of its own is left out of the codes. */
const OFFSETS = ["work-offset", "length-offset", "compensation"];
const APART = [...OFFSETS, "coolant", "feed", "speed", "tool", "spindle"];

/** The read-out: places in the work offset and in the machine, feed, spindle, tool, modes, block. */
export class Readout {
  private readonly values = new Map<string, HTMLElement>();
  private shownModes = "";

  constructor() {
    const names: Record<string, string> = {
      head: "",
      block: say("line"),
      move: "",
      time: say("time"),
      coolant: say("modeCoolant"),
      offsets: say("offsets"),
      codes: say("codes"),
    };
    for (const row of ROWS) {
      if (!row) {
        byId("readout").append(el("div", { class: "gap more" }));
        continue;
      }
      // A small screen has no room for all of it.
      const look = SHORT.includes(row) ? "" : "more";
      const wide = !["head", ...LINEAR, ...ROTARY].includes(row);
      const id = `now-${row.toLowerCase()}`;
      const name = el("dt", { class: look }, names[row] ?? row);
      const value = el("dd", { id, class: `${look}${wide ? " wide-value" : ""}` }, "–");
      this.values.set(row, value);
      byId("readout").append(name, value);
      if (wide) continue;
      const machine = el("dd", { id: `${id}-machine`, class: `${look} of-machine` }, row === "head" ? say("machine") : "–");
      this.values.set(`${row} machine`, machine);
      byId("readout").append(machine);
    }
    this.put("head", say("part"));
    ROTARY.forEach((axis) => this.hide(axis, true));
  }

  show(path: Path | undefined, now: Now, tool: Tool | undefined): void {
    const put = (row: string, text: string) => this.put(row, text);
    if (!path || path.pieces === 0) {
      this.modes([], false);
      return [...this.values.keys()].filter((row) => !row.startsWith("head")).forEach((row) => put(row, "–"));
    }
    const at = Math.max(0, now.piece);
    this.places(path, now);
    const rapid = isRapid(path.kind[at]);
    put("F", rapid ? "–" : figure(path.feed[at] ?? 0, 0));
    const active = path.modes?.ofMove(path.move[at] ?? 0) ?? [];
    const spindle = active.find((one) => one.mode === "spindle")?.text ?? "";
    put("S", `${figure(path.speed[at] ?? 0, 0)} ${spindle}`.trim());
    // The number in a list of tools is the compiler's; the shop's is the tool's own.
    put("T", tool ? (tool.number === null ? "–" : String(tool.number)) : "–");
    put("Ø", tool ? `${tool.known === "guess" ? "≈ " : ""}${figure(tool.diameter, 1)}` : "–");
    this.modes(active, true);
    put("block", String(path.line[at] ?? 0));
    put("move", say(KINDS[path.kind[at] ?? 0] ?? "rapid"));
    put("time", clock(now.time));
  }

  /** Where the tool is, in the active work offset and in the machine. */
  private places(path: Path, now: Now): void {
    const at = Math.max(0, now.piece);
    const move = path.move[at] ?? 0;
    const part = placeOf(path, now);
    const places = path.modes?.places(move, part) ?? { work: part, machine: [undefined, undefined, undefined] };
    // Of such a move nobody knows how high it is.
    const high = path.kind[at] === Kind.Away;
    byId("readout").classList.toggle("no-machine", places.machine.every((one) => one === undefined));
    LINEAR.forEach((axis, n) => {
      const known = !(high && axis === "Z");
      const machine = known ? places.machine[n] : undefined;
      this.put(axis, known ? figure(places.work[n] ?? 0, 3) : "–");
      this.put(`${axis} machine`, machine === undefined ? "–" : figure(machine, 3));
    });
    const turns = path.modes?.turns(move, shareOfMove(path, now));
    ROTARY.forEach((axis, n) => {
      this.hide(axis, !turns);
      if (turns) this.put(axis, figure(turns[n] ?? 0, 3));
    });
  }

  private modes(active: Active[], known: boolean): void {
    const offset = active.find((one) => one.mode === "work-offset");
    this.put("head", offset?.text ?? say("part"));
    const shown = JSON.stringify(active);
    if (shown === this.shownModes && known) return;
    this.shownModes = shown;
    const rows = {
      coolant: (one: Active) => one.mode === "coolant",
      offsets: (one: Active) => OFFSETS.includes(one.mode),
      codes: (one: Active) => !APART.includes(one.mode),
    };
    for (const [row, of] of Object.entries(rows)) {
      const own = active.filter(of).map((one) => modeElement(one));
      this.values.get(row)?.replaceChildren(...(own.length > 0 ? own.flatMap((one) => [one, " "]) : ["–"]));
    }
    for (const [row, mode] of [["F", "feed"], ["S", "speed"], ["T", "tool"]] as const) {
      const changed = active.some((one) => one.mode === mode && one.changed);
      this.values.get(row)?.classList.toggle("changed", changed);
    }
  }

  private put(row: string, text: string): void {
    const value = this.values.get(row);
    if (value && value.textContent !== text) value.textContent = text;
  }

  private hide(row: string, hidden: boolean): void {
    const value = this.values.get(row);
    if (!value || value.hidden === hidden) return;
    const machine = this.values.get(`${row} machine`);
    for (const one of [value.previousElementSibling as HTMLElement, value, machine]) if (one) one.hidden = hidden;
  }
}

/** How much of a move is done, of which an arc has several pieces. */
function shareOfMove(path: Path, now: Now): number {
  const at = Math.max(0, now.piece);
  let [first, last] = [at, at];
  while (first > 0 && path.move[first - 1] === path.move[at]) first -= 1;
  while (last + 1 < path.pieces && path.move[last + 1] === path.move[at]) last += 1;
  const [from, to] = [path.t0[first] ?? 0, path.t1[last] ?? 0];
  if (now.piece < 0) return 0;
  return to > from ? Math.min(1, Math.max(0, (now.time - from) / (to - from))) : now.share;
}

const AXES = [
  ["X", "#d8463c", new Vector3(1, 0, 0)],
  ["Y", "#2f9e57", new Vector3(0, 1, 0)],
  ["Z", "#3f82e6", new Vector3(0, 0, 1)],
] as const;

/** The directions of the axes, as the camera sees them. */
export function drawCompass(camera: Camera): void {
  const space = "http://www.w3.org/2000/svg";
  const turned = AXES.map(([name, ink, axis]) => ({
    name,
    ink,
    seen: axis.clone().transformDirection(camera.matrixWorldInverse),
  }));
  // What is nearer lies over what is farther.
  turned.sort((a, b) => a.seen.z - b.seen.z);
  const drawn = turned.flatMap(({ name, ink, seen }) => {
    const line = document.createElementNS(space, "line");
    const [x, y] = [(seen.x * 20).toFixed(1), (-seen.y * 20).toFixed(1)];
    Object.entries({ x1: "0", y1: "0", x2: x, y2: y, stroke: ink }).forEach((one) => line.setAttribute(...one));
    const text = document.createElementNS(space, "text");
    const [left, top] = [(seen.x * 28).toFixed(1), (-seen.y * 28).toFixed(1)];
    Object.entries({ x: left, y: top, fill: ink }).forEach((one) => text.setAttribute(...one));
    text.textContent = name;
    return [line, text];
  });
  byId("compass").replaceChildren(...drawn);
}
