// The moment of the program that the page shows, and its going on. Nothing runs while it stands.

import { pieceAt, shareAt, type Path } from "../engine/path";
import { Signal } from "../ui/signal";

/** Times real time. */
export const SPEEDS = [0.1, 1000] as const;

/** Where the program is. */
export interface Now {
  /** Seconds. */
  time: number;
  /** The piece that has begun last; -1 before all. */
  piece: number;
  /** How much of it is done, 0 to 1. */
  share: number;
}

const START: Now = { time: 0, piece: -1, share: 0 };

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
    if (!path || path.pieces === 0) return this.now.set(START);
    const at = Math.min(Math.max(0, time), path.seconds);
    const piece = at >= path.seconds ? path.pieces - 1 : pieceAt(path, at);
    this.now.set({ time: at, piece, share: at >= path.seconds ? 1 : shareAt(path, piece, at) });
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
    const { piece, share } = this.now.get();
    if (direction > 0) {
      let to = share >= 1 || piece < 0 ? piece + 1 : piece;
      if (to >= path.pieces) return;
      while (to + 1 < path.pieces && path.line[to + 1] === path.line[to]) to += 1;
      return this.endOf(to);
    }
    let to = Math.max(0, piece);
    while (to > 0 && path.line[to - 1] === path.line[to]) to -= 1;
    if (to === 0) this.seek(0);
    else this.endOf(to - 1);
  }

  /** To the next move by another tool. */
  nextTool(): void {
    this.playing.set(false);
    const { path } = this;
    if (!path) return;
    const from = Math.max(0, this.now.get().piece);
    const next = path.tool.findIndex((tool, at) => at > from && tool !== path.tool[from]);
    this.seek(next < 0 ? path.seconds : (path.t0[next] as number));
  }

  /** To where a piece is done. Pieces that take no time have their moment in common, so that the piece is stated. */
  endOf(piece: number): void {
    const time = this.path?.t1[piece];
    if (time !== undefined) this.now.set({ time, piece, share: 1 });
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
  const at = Math.max(0, now.piece);
  const share = now.piece < 0 ? 0 : now.share;
  const mix = (from: Float32Array, to: Float32Array) => {
    const [a, b] = [from[at] ?? 0, to[at] ?? 0];
    return a + (b - a) * share;
  };
  return [mix(path.x0, path.x1), mix(path.y0, path.y1), mix(path.z0, path.z1)];
}

/** How many moves are over. */
export function movesOver(path: Path, { piece, share }: Now): number {
  if (piece < 0) return 0;
  const own = path.move[piece] ?? 0;
  const over = share >= 1 && path.move[piece + 1] !== own;
  return over ? own : own - 1;
}
