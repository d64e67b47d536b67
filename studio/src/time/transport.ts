// The bar of time: buttons, the scrubber over bands of tools, the speed.

import type { Alarm } from "../engine/part";
import { isRapid, type Path } from "../engine/path";
import { byId, icon } from "../ui/dom";
import { clock, figure, say } from "../ui/texts";
import { SPEEDS, type Now, type Player } from "./player";

export class Transport {
  private readonly scrub = byId<HTMLInputElement>("scrub");
  private readonly speed = byId<HTMLInputElement>("speed");
  private readonly bands = byId<HTMLCanvasElement>("bands");
  private path: Path | undefined;
  private alarms: readonly Alarm[] = [];

  constructor(private readonly player: Player) {
    const on = (id: string, does: () => void) => byId(id).addEventListener("click", does);
    on("play", () => player.toggle());
    on("to-start", () => player.seek(0));
    on("to-end", () => player.seek(Infinity));
    on("step-back", () => player.step(-1));
    on("step-forward", () => player.step(1));
    on("next-tool", () => player.nextTool());
    this.scrub.addEventListener("input", () => {
      player.playing.set(false);
      player.seek(Number(this.scrub.value));
    });
    this.scrub.addEventListener("keydown", (event) => this.key(event));
    this.speed.addEventListener("input", () => player.speed.set(this.given()));
    player.playing.on((playing) => {
      const button = byId("play");
      button.replaceChildren(icon(playing ? "pause" : "play"));
      button.setAttribute("aria-label", say(playing ? "pause" : "play"));
      button.title = `${say(playing ? "pause" : "play")} (Ctrl+Shift+Enter)`;
    });
    player.speed.on((speed) => {
      this.speed.value = String(Math.log10(speed));
      byId<HTMLOutputElement>("speed-shown").value = `${figure(speed, speed < 10 ? 1 : 0)} ×`;
    });
    player.now.on((now) => this.show(now));
    new ResizeObserver(() => this.draw()).observe(this.bands.parentElement as HTMLElement);
  }

  setPath(path: Path | undefined): void {
    this.path = path;
    this.scrub.max = String(path?.seconds || 1);
    this.scrub.disabled = !path || path.pieces === 0;
    this.show(this.player.now.get());
    this.draw();
  }

  setAlarms(alarms: readonly Alarm[]): void {
    this.alarms = alarms;
    this.draw();
  }

  /** Bands of tools over the time, with alarms; rapid moves are faint. */
  draw(): void {
    const { bands, path } = this;
    const ratio = devicePixelRatio;
    const width = Math.max(1, Math.round(bands.clientWidth * ratio));
    [bands.width, bands.height] = [width, Math.max(1, Math.round(bands.clientHeight * ratio))];
    const pen = bands.getContext("2d");
    if (!pen) return;
    const style = getComputedStyle(document.documentElement);
    pen.fillStyle = style.getPropertyValue("--edge");
    pen.fillRect(0, 0, width, bands.height);
    if (!path || path.seconds === 0) return;
    const inks = Array.from({ length: 8 }, (_, at) => style.getPropertyValue(`--c-tool-${at}`));
    let from = 0;
    for (let at = 1; at <= path.pieces; at += 1) {
      const goesOn = at < path.pieces && path.tool[at] === path.tool[from] && isRapid(path.kind[at]) === isRapid(path.kind[from]);
      if (goesOn) continue;
      const x = ((path.t0[from] as number) / path.seconds) * width;
      const end = ((path.t1[at - 1] as number) / path.seconds) * width;
      pen.globalAlpha = isRapid(path.kind[from]) ? 0.35 : 1;
      pen.fillStyle = inks[(path.tool[from] as number) % 8] ?? "";
      if (end - x > 0.05) pen.fillRect(x, 0, Math.max(end - x, 0.5), bands.height);
      from = at;
    }
    pen.globalAlpha = 1;
    for (const { time, severity } of this.alarms) {
      pen.fillStyle = style.getPropertyValue(`--${severity}`);
      pen.fillRect((time / path.seconds) * width - ratio, 0, 2 * ratio, bands.height);
    }
  }

  private show(now: Now): void {
    const total = this.player.seconds;
    this.scrub.value = String(now.time);
    this.scrub.setAttribute("aria-valuetext", `${clock(now.time)} / ${clock(total)}`);
    byId<HTMLOutputElement>("clock").value = `${clock(now.time)} / ${clock(total)}`;
  }

  private given(): number {
    const [least, most] = SPEEDS;
    return Math.min(most, Math.max(least, Number((10 ** Number(this.speed.value)).toPrecision(2))));
  }

  private key(event: KeyboardEvent): void {
    const does = {
      ArrowRight: () => this.player.step(1),
      ArrowLeft: () => this.player.step(-1),
      Home: () => this.player.seek(0),
      End: () => this.player.seek(Infinity),
    }[event.key];
    if (!does) return;
    event.preventDefault();
    does();
  }
}
