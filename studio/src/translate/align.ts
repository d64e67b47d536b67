// Source and translation side by side: scrolled together, and a click in one marks what belongs to it in the other. Which
// lines belong together, the compiler says (the output `lines` of the verb `translate`).

import type { Editor } from "../editor/editor";

/** A scroll that this page has made itself is over after so long, ms. */
const OWN = 150;

export class Aligned {
  /** Of each line of the translation the line of the source, 0 where the source says nothing of it. */
  private lines: Uint32Array = new Uint32Array();
  private together = true;
  private leads: Editor | undefined;
  private until = 0;

  constructor(
    private readonly source: Editor,
    private readonly output: Editor,
  ) {
    source.onScroll(() => this.scrolled(source, output, (line) => this.toOutput(line)));
    output.onScroll(() => this.scrolled(output, source, (line) => this.toSource(line)));
  }

  setLines(lines: Uint32Array | undefined): void {
    this.lines = lines ?? new Uint32Array();
    this.source.markPairs([]);
    this.output.markPairs([]);
  }

  setTogether(on: boolean): void {
    this.together = on;
    if (on) this.scrolled(this.source, this.output, (line) => this.toOutput(line));
  }

  /** Marks a line of the source, and the lines that were made of it. */
  markSource(line: number): void {
    const own: number[] = [];
    this.lines.forEach((source, at) => source === line && own.push(at + 1));
    this.source.markPairs(own.length > 0 ? [line] : []);
    this.output.markPairs(own, this.visible);
  }

  /** Marks a line of the translation, and the one that it was made of, with all that was made of that. */
  markOutput(line: number): void {
    const source = this.lines[line - 1] ?? 0;
    if (source === 0) {
      this.source.markPairs([]);
      return this.output.markPairs([line]);
    }
    this.markSource(source);
    this.source.markPairs([source], true);
  }

  private get visible(): boolean {
    return this.output.isVisible;
  }

  /** The first line that was made of one of the source, or of the next that something was made of. */
  private toOutput(line: number): number {
    let [best, least] = [1, Infinity];
    this.lines.forEach((source, at) => {
      if (source < line || source >= least) return;
      [best, least] = [at + 1, source];
    });
    return least === Infinity ? this.lines.length : best;
  }

  /** The line of the source that one was made of, or of the last before it. */
  private toSource(line: number): number {
    for (let at = line - 1; at >= 0; at -= 1) if (this.lines[at]) return this.lines[at] as number;
    return 1;
  }

  private scrolled(from: Editor, to: Editor, find: (line: number) => number): void {
    const now = performance.now();
    if (!this.together || this.lines.length === 0 || !this.visible || (this.leads === to && now < this.until)) return;
    [this.leads, this.until] = [from, now + OWN];
    to.scrollTo(find(from.topLine));
  }
}
