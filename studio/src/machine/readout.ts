// What stands over the picture: where the tool is, the axes' directions, the grid's step.

import { Vector3, type Camera } from "three";
import type { Tool } from "../engine/part";
import { isRapid, type Path } from "../engine/path";
import { placeOf, type Now } from "../time/player";
import { byId, el } from "../ui/dom";
import { clock, figure, say } from "../ui/texts";

const KINDS = ["rapid", "feedMove", "clockwise", "counterclockwise", "away"] as const;

const SHORT = ["X", "Y", "Z", "F", "block"];

/** The read-out: place in machine coordinates, feed, spindle, tool, block. */
export class Readout {
  private readonly values = new Map<string, HTMLElement>();

  constructor() {
    const rows = ["X", "Y", "Z", "", "F", "S", "T", "Ø", "", "block", "move", "time"];
    const names: Record<string, string> = { block: say("line"), move: "", time: say("time") };
    for (const row of rows) {
      if (!row) {
        byId("readout").append(el("div", { class: "gap more" }));
        continue;
      }
      // A small screen has no room for all of it.
      const look = SHORT.includes(row) ? "" : "more";
      const value = el("dd", { id: `now-${row.toLowerCase()}`, class: look }, "–");
      this.values.set(row, value);
      byId("readout").append(el("dt", { class: look }, names[row] ?? row), value);
    }
  }

  show(path: Path | undefined, now: Now, tool: Tool | undefined): void {
    const put = (row: string, text: string) => {
      const value = this.values.get(row);
      if (value && value.textContent !== text) value.textContent = text;
    };
    if (!path || path.pieces === 0) return [...this.values.keys()].forEach((row) => put(row, "–"));
    const at = Math.max(0, now.piece);
    placeOf(path, now).forEach((value, axis) => put("XYZ"[axis] as string, figure(value, 3)));
    const rapid = isRapid(path.kind[at]);
    put("F", rapid ? "–" : figure(path.feed[at] ?? 0, 0));
    put("S", figure(path.speed[at] ?? 0, 0));
    // The number in a list of tools is the compiler's; the shop's is the tool's own.
    put("T", tool ? (tool.number === null ? "–" : String(tool.number)) : "–");
    put("Ø", tool ? `${tool.known === "guess" ? "≈ " : ""}${figure(tool.diameter, 1)}` : "–");
    put("block", String(path.line[at] ?? 0));
    put("move", say(KINDS[path.kind[at] ?? 0] ?? "rapid"));
    put("time", clock(now.time));
  }
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
