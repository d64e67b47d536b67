// Modes as elements: their names in the page's language, their words as the compiler spells them.

import type { Active } from "../engine/modes";
import { el } from "./dom";
import { say, type TextName } from "./texts";

const NAMES: Record<string, TextName> = {
  motion: "modeMotion",
  plane: "modePlane",
  distance: "modeDistance",
  "feed-mode": "modeFeed",
  units: "modeUnits",
  compensation: "modeCompensation",
  "work-offset": "modeWorkOffset",
  "return-level": "modeReturn",
  spindle: "spindle",
  coolant: "modeCoolant",
  "length-offset": "modeLength",
  feed: "feed",
  speed: "speedS",
  tool: "tool",
};

function nameOf(mode: string): string {
  const name = NAMES[mode];
  return name ? say(name) : mode;
}

/** The words of a mode; the last change is marked, for the ear too. */
export function modeElement({ mode, text, changed }: Active): HTMLElement {
  if (!changed) return el("span", { title: nameOf(mode), "data-mode": mode }, text);
  return el("mark", { title: `${nameOf(mode)}: ${say("lastChange")}`, "data-mode": mode }, text);
}

/** All modes with their names. */
export function modesTable(active: Active[]): HTMLElement {
  const rows = active.flatMap(({ mode, text }) => [el("dt", {}, nameOf(mode)), el("dd", { "data-mode": mode }, text)]);
  return el("dl", { class: "modes", "aria-label": say("activeModes") }, ...rows);
}
