// The outline over the editor: the stretches of a program by their tools, with their times. Where a tool is called, the
// compiler's colours say: there is no second reading of words here.

import type { Colours } from "../engine/documents";
import type { Cut } from "../engine/part";
import type { Path } from "../engine/path";
import { shapeName } from "../setup/pane";
import { byId, el } from "../ui/dom";
import { clock, figure, say } from "../ui/texts";

/** Moves by one tool, one behind the other. */
export interface Section {
  /** Place of the tool in the list of tools. */
  tool: number;
  /** The line that calls it, or that of its first move, counted from 1. */
  line: number;
  /** The last line before the next section. */
  end: number;
  /** Seconds of its beginning and its end. */
  from: number;
  to: number;
}

/** Asks for the colours of some lines of the program. */
export type AskLines = (first: number, lines: number) => Promise<Colours | undefined>;

/** So many lines before a tool's first move are looked through for its call. */
const REACH = 60;

/** The stretches of a path by its tools. */
export function sectionsOf(path: Path): Section[] {
  const found: Section[] = [];
  let from = 0;
  for (let at = 1; at <= path.pieces; at += 1) {
    if (at < path.pieces && path.tool[at] === path.tool[from]) continue;
    found.push({
      tool: path.tool[from] ?? 0,
      line: path.line[from] ?? 0,
      end: path.line[at - 1] ?? 0,
      from: path.t0[from] ?? 0,
      to: path.t1[at - 1] ?? 0,
    });
    from = at;
  }
  return found;
}

/** Moves the beginning of each section to the first tool word between it and the one before. */
async function called(sections: Section[], ask: AskLines): Promise<Section[]> {
  const found: Section[] = [];
  for (const [at, section] of sections.entries()) {
    const before = sections[at - 1]?.end ?? 0;
    const first = Math.max(before + 1, section.line - REACH);
    const colours = first <= section.line ? await ask(first, section.line - first + 1) : undefined;
    found.push({ ...section, line: (colours && toolLine(colours)) ?? section.line });
  }
  return found.map((section, at) => {
    const next = found[at + 1]?.line ?? 0;
    return next > section.line ? { ...section, end: next - 1 } : section;
  });
}

/** The first line with a tool word. */
function toolLine({ kinds, stretches }: Colours): number | undefined {
  const wanted = kinds.indexOf("tool");
  for (let at = 0; at < stretches.length; at += 4) if (stretches[at + 3] === wanted) return stretches[at];
  return undefined;
}

export class Outline {
  private readonly list = byId("outline-list");
  private readonly head = byId("outline-head");
  private asked = 0;

  constructor(
    private readonly ask: AskLines,
    private readonly goTo: (section: Section) => void,
    /** The sections are others: they can be folded. */
    private readonly changed: (sections: Section[]) => void,
  ) {
    this.head.addEventListener("click", () => {
      this.list.hidden = !this.list.hidden;
      this.head.setAttribute("aria-expanded", String(!this.list.hidden));
    });
  }

  async show(path: Path | undefined, cut: Cut | undefined): Promise<void> {
    const own = ++this.asked;
    const sections = path ? await called(sectionsOf(path), this.ask) : [];
    if (own !== this.asked) return;
    byId("outline").hidden = sections.length === 0;
    byId("outline-count").textContent = String(sections.length);
    this.list.replaceChildren(...sections.map((section) => this.row(section, cut)));
    this.changed(sections);
  }

  private row(section: Section, cut: Cut | undefined): HTMLElement {
    const { line, from, to } = section;
    const tool = cut?.tools[section.tool];
    const name = typeof tool?.number === "number" ? `T${tool.number}` : "–";
    const guessed = tool?.known === "guess" || tool?.shape_guessed;
    const what = tool ? `${shapeName(tool.shape)} ⌀ ${guessed ? "≈ " : ""}${figure(tool.diameter, 2)} mm` : "";
    const button = el(
      "button",
      { onclick: () => this.goTo(section), "data-line": line },
      el("span", {}, el("i", { class: `band band-${section.tool % 8}` }), name),
      el("span", { class: "at" }, String(line)),
      el("span", guessed ? { class: "guess", title: say("guess") } : {}, what),
      el("span", { class: "figure", title: say("begins") }, clock(from)),
      el("span", { class: "figure", title: say("lasts") }, clock(to - from)),
    );
    return el("li", {}, button);
  }
}
