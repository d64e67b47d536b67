// Feed, spindle and Z over time, on one axis, with the moment as a line. A drag takes a closer look, a double click all of it.

import uPlot from "uplot";
import type { Path } from "../engine/path";
import { el } from "../ui/dom";
import { figure, say, type TextName } from "../ui/texts";
import { curve, spindle, type Curve } from "./series";

interface Row {
  name: TextName | "Z";
  unit: string;
  ink: string;
  of(path: Path): [ArrayLike<number>, ArrayLike<number>];
  /** Its curve, where that is more than what moves have. */
  curve?(path: Path): Curve;
}

const ROWS: Row[] = [
  { name: "feed", unit: "mm/min", ink: "--c-move-feed", of: (path) => [path.feed, path.feed], curve: (path) => curve(path, path.feed, path.feed, 0) },
  { name: "spindle", unit: "1/min", ink: "--c-move-clockwise", of: (path) => [path.speed, path.speed], curve: spindle },
  { name: "Z", unit: "mm", ink: "--c-move-counterclockwise", of: (path) => [path.z0, path.z1] },
];

interface Chart {
  row: Row;
  box: HTMLElement;
  value: HTMLOutputElement;
  line: HTMLElement;
  plot: uPlot | undefined;
}

export class Charts {
  private readonly charts: Chart[];
  private path: Path | undefined;
  /** The moment: seconds, the piece under way, and how much of it is done. */
  private now: [number, number, number] = [0, -1, 1];
  private later = 0;
  private readonly sync = uPlot.sync("time");

  constructor(
    private readonly host: HTMLElement,
    private readonly seek: (time: number) => void,
  ) {
    this.charts = ROWS.map((row) => {
      const name = row.name === "Z" ? "Z" : say(row.name);
      const value = el("output", {});
      const label = el("div", { class: "chart-name" }, el("b", {}, name), value, el("small", {}, row.unit));
      const plot = el("div", { class: "chart-plot" });
      host.append(el("figure", { class: "chart", "aria-label": `${name}, ${row.unit}` }, label, plot));
      return { row, box: plot, value, line: el("div", { class: "chart-now" }), plot: undefined };
    });
    new ResizeObserver(() => this.draw()).observe(host);
  }

  /** Another path. The part is drawn first: by software lines of charts take as long. */
  setPath(path: Path | undefined): void {
    this.path = path;
    cancelAnimationFrame(this.later);
    this.later = requestAnimationFrame(() => setTimeout(() => this.update()));
  }

  private update(): void {
    const { path } = this;
    if (!path || path.pieces === 0 || !this.charts.every(({ plot }) => plot)) return this.draw();
    for (const { plot, row } of this.charts) plot?.setData(dataOf(row, path));
    this.setTime(...this.now);
  }

  /** Draws all anew: the path, the size or the colours are others. */
  draw(): void {
    const visible = this.host.offsetParent !== null;
    for (const chart of this.charts) {
      chart.plot?.destroy();
      chart.plot = undefined;
      if (this.path && this.path.pieces > 0 && visible) chart.plot = this.plot(chart, this.path);
    }
    this.setTime(...this.now);
  }

  setTime(time: number, piece = -1, share = 1): void {
    this.now = [time, piece, share];
    for (const { plot, line, value, row } of this.charts) {
      if (plot) {
        const x = plot.valToPos(time, "x");
        line.hidden = x < 0 || x > plot.over.clientWidth;
        line.style.transform = `translateX(${x}px)`;
      }
      if (!this.path || piece < 0) {
        value.value = "";
        continue;
      }
      const [from, to] = row.of(this.path).map((column) => column[piece] ?? 0) as [number, number];
      value.value = figure(from + (to - from) * share, row.name === "Z" ? 3 : 0);
    }
  }

  private plot(chart: Chart, path: Path): uPlot {
    const { box, row, line } = chart;
    const last = chart === this.charts.at(-1);
    const style = getComputedStyle(document.documentElement);
    const ink = (name: string) => style.getPropertyValue(name).trim();
    const axis = {
      stroke: ink("--dim"),
      font: "10px system-ui, sans-serif",
      grid: { stroke: ink("--edge"), width: 1 },
      ticks: { show: false },
    };
    const options: uPlot.Options = {
      width: Math.max(80, box.clientWidth),
      height: Math.max(40, box.clientHeight),
      legend: { show: false },
      padding: [6, 16, 0, 0],
      cursor: { sync: { key: this.sync.key }, points: { show: false }, y: false, drag: { x: true, y: false } },
      scales: { x: { time: false } },
      axes: [
        // The last one's axis is that of all.
        { ...axis, size: last ? 16 : 8, gap: 2, values: (_, all) => all.map((value) => (last ? `${value} s` : "")) },
        { ...axis, size: 46, gap: 4, space: 22 },
      ],
      series: [{}, { stroke: ink(row.ink), width: 1.2, points: { show: false } }],
    };
    const plot = new uPlot(options, dataOf(row, path), box);
    plot.over.append(line);
    let down = 0;
    plot.over.addEventListener("pointerdown", (event) => (down = event.clientX));
    plot.over.addEventListener("pointerup", (event) => {
      if (Math.abs(event.clientX - down) > 3) return;
      const from = plot.over.getBoundingClientRect().left;
      this.seek(plot.posToVal(event.clientX - from, "x"));
    });
    return plot;
  }
}

function dataOf(row: Row, path: Path): Curve {
  return row.curve?.(path) ?? curve(path, ...row.of(path));
}
