// The moment of the program that the page shows, and its going on. Nothing runs while it stands.

import { moveAt, shareAt, type Path } from "../engine/path";
import { Signal } from "../ui/signal";

/** Times real time. */
export const SPEEDS = [0.1, 1000] as const;

/** Where the program is. */
export interface Now {
  /** Seconds. */
  time: number;
  /** The move that has begun last; -1 before all. */
  move: number;
  /** How much of it is done, 0 to 1. */
  share: number;
}

const START: Now = { time: 0, move: -1, share: 0 };

export class Player {
  readonly now = new Signal<Now>(START);
  readonly playing = new Signal(false);
  readonly speed = new Signal(1);
  private path: Path | undefined;
  private last = 0;

  /** Another program; the moment goes to its end, where all of it is seen, or stays where somebody put it. */
  open(path: Path | undefined, stay: boolean): void {
    const { time } = this.now.get();
    this.path = path;
    this.playing.set(false);
    this.seek(stay ? time : Infinity);
  }

  get seconds(): number {
    return this.path?.seconds ?? 0;
  }

  seek(time: number): void {
    const { path } = this;
    if (!path || path.moves === 0) return this.now.set(START);
    const at = Math.min(Math.max(0, time), path.seconds);
    const move = at >= path.seconds ? path.moves - 1 : moveAt(path, at);
    this.now.set({ time: at, move, share: at >= path.seconds ? 1 : shareAt(path, move, at) });
  }

  toggle(): void {
    if (this.playing.get()) return this.playing.set(false);
    if (this.seconds === 0) return;
    if (this.now.get().time >= this.seconds) this.seek(0);
    this.playing.set(true);
    this.last = performance.now();
    requestAnimationFrame((now) => this.frame(now));
  }

  /** To the end of the block that follows, or to the beginning of the one before. */
  step(direction: 1 | -1): void {
    this.playing.set(false);
    const { path } = this;
    if (!path) return;
    const { move, share } = this.now.get();
    if (direction > 0) {
      let to = share >= 1 || move < 0 ? move + 1 : move;
      if (to >= path.moves) return;
      while (to + 1 < path.moves && path.line[to + 1] === path.line[to]) to += 1;
      return this.endOf(to);
    }
    let to = Math.max(0, move);
    while (to > 0 && path.line[to - 1] === path.line[to]) to -= 1;
    if (to === 0) this.seek(0);
    else this.endOf(to - 1);
  }

  /** To the next move by another tool. */
  nextTool(): void {
    this.playing.set(false);
    const { path } = this;
    if (!path) return;
    const from = Math.max(0, this.now.get().move);
    const next = path.tool.findIndex((tool, at) => at > from && tool !== path.tool[from]);
    this.seek(next < 0 ? path.seconds : (path.t0[next] as number));
  }

  /** To where a move is done. Moves that take no time have their moment in common, so that the move is stated. */
  endOf(move: number): void {
    const time = this.path?.t1[move];
    if (time !== undefined) this.now.set({ time, move, share: 1 });
  }

  private frame(now: number): void {
    if (!this.playing.get()) return;
    const time = this.now.get().time + ((now - this.last) / 1000) * this.speed.get();
    this.last = now;
    this.seek(time);
    if (time >= this.seconds) return this.playing.set(false);
    requestAnimationFrame((next) => this.frame(next));
  }
}

/** Where the tool is: work in mm, nothing before all moves. */
export function placeOf(path: Path, now: Now): [number, number, number] {
  const at = Math.max(0, now.move);
  const share = now.move < 0 ? 0 : now.share;
  const mix = (from: Float32Array, to: Float32Array) => {
    const [a, b] = [from[at] ?? 0, to[at] ?? 0];
    return a + (b - a) * share;
  };
  return [mix(path.x0, path.x1), mix(path.y0, path.y1), mix(path.z0, path.z1)];
}
