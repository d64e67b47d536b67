// A path as drawings: a texture and a mesh without vertices for each million of lines. A line is a move; for a device that draws slowly
// it is several, where the picture shows no difference.

import {
  BufferGeometry,
  Color,
  DataTexture,
  FloatType,
  GLSL3,
  Group,
  LineSegments,
  Mesh,
  NearestFilter,
  RGBAFormat,
  RawShaderMaterial,
  DoubleSide,
  Vector2,
  Vector3,
  Vector4,
  type IUniform,
} from "three";
import { isRapid, type Path } from "../engine/path";
import { evenly, runsOf } from "./runs";
import { CHUNK, FRAGMENT, MOMENTS, PICK, ROW, TEXELS, VERTEX } from "./shaders";

/** Moves up to which lines have some width; of more they are lines of the device, half of the work or less. */
const WIDE = 300_000;

export const COLOURINGS = ["kind", "tool", "operation", "feed", "depth", "time"] as const;
export type Colouring = (typeof COLOURINGS)[number];

/** So many lines are drawn in the time of a picture by a device that draws slowly, and so few moves take it no time. */
const [FEW, NO_TIME] = [40_000, 4_000];
/** So many marked moves are drawn. */
const MARKED = 100_000;
/** Width of a line, of a marked one, and of one that a pointer meets, in pixels. */
const [WIDTH, THICK, MET] = [1.6, 3.04, 7];
/** Steps of half a pixel: a picture does not show the least, and the greatest is as wide as all of it. */
const [LEAST, GREATEST] = [1 / 256, 4096];

/** First and last pieces of lines. */
interface Lines {
  first: Uint32Array;
  last: Uint32Array;
}
const NONE: Lines = { first: new Uint32Array(), last: new Uint32Array() };

/** Uniforms that all pieces have in common. */
function shared(): Record<string, IUniform> {
  return {
    now: { value: -1 },
    share: { value: 0 },
    until: { value: 1 },
    size: { value: new Vector2(1, 1) },
    width: { value: WIDTH },
    marked: { value: 0 },
    shown: { value: 15 },
    future: { value: 1 },
    kinds: { value: [0, 1, 2, 3].map(() => new Color()) },
    tools: { value: Array.from({ length: 8 }, () => new Color()) },
    mark: { value: new Color() },
    ground: { value: new Color() },
    colouring: { value: 0 },
    range: { value: new Vector4(0, 1, 0, 1) },
    scales: { value: [0, 1, 2, 3].map(() => new Color()) },
    section: { value: new Vector4(0, 0, 0, 1) },
  };
}

export class Paths {
  /** What is seen, and what a pointer is looked up in. */
  readonly drawn = new Group();
  readonly pick = new Group();
  private readonly plain = new Group();
  private readonly thick = new Group();
  private readonly uniforms = shared();
  private readonly pickUniforms = shared();
  private readonly markUniforms = { ...this.uniforms, marked: { value: 1 }, width: { value: THICK }, now: { value: -1 }, until: { value: 1 } };
  private readonly materials = {
    drawn: new Materials(this.uniforms, FRAGMENT),
    pick: new Materials(this.pickUniforms, PICK),
    marked: new Materials(this.markUniforms, FRAGMENT),
  };
  private path: Path | undefined;
  private lines: Lines = NONE;
  /** Numbers of marked lines of the program, and their pieces. */
  private marks: [number, number] = [-1, -1];
  private marked = NONE.first;
  /** The piece under way and how much of it is done. */
  private now: [number, number] = [-1, 0];
  /** How far moves may be from a line that stands for them, in halves of a pixel, 0 where each has its own: as wished, and as it is where
   * that would be more lines than `most`. */
  private wished = 1;
  private step = 1;
  private most = FEW;
  /** mm a pixel that the lines were made for, 0 if they have to be made. */
  private made = 0;

  constructor() {
    this.drawn.add(this.plain, this.thick);
  }

  /** Another path, for a device that draws slowly or may do so; one that is like the last is drawn as finely. */
  set(path: Path | undefined, slow: boolean, alike: boolean): void {
    this.path = path;
    this.lines = NONE;
    this.made = 0;
    clear(this.plain);
    clear(this.pick);
    this.setMarked(...this.marks);
    if (!path) return;
    this.uniforms.range!.value = ranges(path);
    // Where there are many, few are drawn until it is known how quick the device is.
    if (!alike) this.wish(path.pieces <= NO_TIME || (path.pieces <= WIDE && !slow) ? 0 : 1, FEW);
  }

  /** How far the path may be from the lines that are drawn, in halves of a pixel; 0 where each move is a line. */
  get fineness(): number {
    return this.step && Math.max(1, this.step);
  }

  /** A device that draws slowly has fewer lines, each of several moves; false where there are few already. */
  coarser(): boolean {
    if (this.lines.first.length <= NO_TIME || (this.wished >= 1 && this.most === FEW)) return false;
    this.wish(1, FEW);
    return true;
  }

  /** More lines, about four times at most; false where each move has its own. */
  finer(): boolean {
    if (this.wished === 0 || !this.path) return false;
    const most = 4 * this.lines.first.length;
    this.wish(most < this.path.pieces && this.step > LEAST ? this.step / 16 : 0, most);
    return true;
  }

  private wish(step: number, most: number): void {
    this.wished = step;
    this.most = step > 0 ? most : Infinity;
    this.made = 0;
  }

  /** Before a picture whose pixels are so many mm wide: makes the lines anew where that, or the eye, asks for it. Whether it did so. */
  see(pixel: number): boolean {
    const far = pixel / this.made;
    if (!this.path || (this.made > 0 && (this.wished === 0 || (far >= 0.5 && far <= 4)))) return false;
    this.made = pixel;
    this.lines = this.linesOf(this.path, pixel / 2);
    this.build(this.path);
    return true;
  }

  private linesOf(path: Path, half: number): Lines {
    const { x: slowest, y: fastest } = this.uniforms.range!.value as Vector4;
    // Colours of feeds are kept as long as the rest is as fine as the picture.
    const runs = () => runsOf(path, this.step * half, this.most, (Math.max(0, this.step - 1) / 64) * (fastest - slowest));
    this.step = this.wished;
    let first = runs();
    while (!first && this.step < GREATEST) {
      this.step *= 2;
      first = runs();
    }
    // Moves of other kinds, or apart, are left: a line is then so many of them.
    first ??= evenly(path.pieces, Math.ceil(path.pieces / this.most));
    return { first, last: first.length === path.pieces ? first : first.map((_, at) => (first[at + 1] ?? path.pieces) - 1) };
  }

  private build(path: Path): void {
    clear(this.plain);
    clear(this.pick);
    const count = this.lines.first.length;
    const wide = path.pieces <= WIDE;
    this.uniforms.width!.value = wide ? WIDTH : 0;
    this.pickUniforms.width!.value = wide ? MET : 0;
    const operations = new Operations(path);
    for (let base = 0; base < count; base += CHUNK) {
      const lines = { first: this.lines.first.subarray(base, base + CHUNK), last: this.lines.last.subarray(base, base + CHUNK) };
      const own = { moves: { value: textureOf(path, lines, operations) }, base: { value: base } };
      this.plain.add(piece(wide, lines.first.length, this.materials.drawn.at(base / CHUNK, own)));
      this.pick.add(piece(wide, lines.first.length, this.materials.pick.at(base / CHUNK, own)));
    }
    this.setNow(...this.now);
  }

  setSection(plane: Vector4): void {
    this.uniforms.section!.value = this.pickUniforms.section!.value = plane;
    const on = plane.x !== 0 || plane.y !== 0 || plane.z !== 0;
    Object.values(this.materials).forEach((one) => one.define("SECTION", on));
  }

  setNow(piece: number, share: number): void {
    this.now = [piece, share];
    this.markUniforms.now.value = lastUpTo(this.marked, piece);
    const line = lastUpTo(this.lines.first, piece);
    const [done, until] = [share, 1].map((share) => (this.path && line >= 0 ? alongOf(this.path, this.piecesOf(line), piece, share) : share));
    for (const uniforms of [this.uniforms, this.pickUniforms]) {
      uniforms.now!.value = line;
      uniforms.share!.value = done;
      uniforms.until!.value = until;
    }
  }

  /** Marks lines of the program: each of their moves is a thick line of its own. */
  setMarked(first: number, last: number): void {
    this.marks = [first, last];
    clear(this.thick);
    this.marked = this.path && first > 0 ? piecesBetween(this.path, first, last) : NONE.first;
    if (this.path && this.marked.length > 0) {
      const texture = textureOf(this.path, { first: this.marked, last: this.marked }, new Operations(this.path));
      this.thick.add(piece(true, this.marked.length, this.materials.marked.at(0, { moves: { value: texture }, base: { value: 0 } })));
    }
    this.setNow(...this.now);
  }

  /** First and last piece of a line that is drawn. */
  piecesOf(line: number): [number, number] {
    return [this.lines.first[line] ?? 0, this.lines.last[line] ?? 0];
  }

  setShown(bits: number, future: boolean): void {
    this.uniforms.shown!.value = this.pickUniforms.shown!.value = bits;
    this.uniforms.future!.value = this.pickUniforms.future!.value = Number(future);
  }

  setColouring(by: Colouring): void {
    this.uniforms.colouring!.value = COLOURINGS.indexOf(by);
    [this.materials.drawn, this.materials.marked].forEach((one) => one.define("DEPTH", by === "depth"));
  }

  setSize(width: number, height: number, ratio: number): void {
    this.uniforms.size!.value.set(width / ratio, height / ratio);
  }

  setPickSize(pixels: number): void {
    this.pickUniforms.size!.value.set(pixels, pixels);
  }

  /** Colours, by the names of the page's variables. */
  setInks(ink: (name: string) => Color): void {
    const kinds = ["rapid", "feed", "clockwise", "counterclockwise"].map((name) => ink(`--c-move-${name}`));
    this.uniforms.kinds!.value = kinds;
    this.uniforms.tools!.value = Array.from({ length: 8 }, (_, at) => ink(`--c-tool-${at}`));
    this.uniforms.scales!.value = [0, 1, 2, 3].map((at) => ink(`--scale-${at}`));
    this.uniforms.mark!.value = ink("--c-move-marked");
    this.uniforms.ground!.value = ink("--ground");
  }
}

function clear(group: Group): void {
  for (const child of [...group.children] as Mesh<BufferGeometry, RawShaderMaterial>[]) {
    (child.material.uniforms.moves?.value as DataTexture).dispose();
    child.geometry.dispose();
    group.remove(child);
  }
}

/** Place of the last of ascending numbers that is not greater than one; -1 where all are. */
function lastUpTo(all: Uint32Array, value: number): number {
  let [low, high] = [0, all.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((all[middle] as number) <= value) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** How far along the line from its first piece to its last one the tool is, when a share of a piece is done. */
function alongOf(path: Path, [first, last]: [number, number], piece: number, share: number): number {
  if (first === last) return share;
  let [done, all] = [0, 0];
  for (const [from, to] of [[path.x0, path.x1], [path.y0, path.y1], [path.z0, path.z1]] as const) {
    const begin = from[first] as number;
    const way = (to[last] as number) - begin;
    const own = from[piece] as number;
    done += (own + ((to[piece] as number) - own) * share - begin) * way;
    all += way * way;
  }
  return all > 0 ? Math.min(1, Math.max(0, done / all)) : 1;
}

/** Pieces of lines of the program, in their order. */
function piecesBetween(path: Path, first: number, last: number): Uint32Array {
  const found: number[] = [];
  for (let at = 0; at < path.pieces && found.length < MARKED; at += 1) {
    const line = path.line[at] as number;
    if (line >= first && line <= last) found.push(at);
  }
  return Uint32Array.from(found);
}

/** Operations of a path: each call of a tool begins one. Asked in the order of the pieces. */
export class Operations {
  private piece = 0;
  private operation = 0;

  constructor(private readonly path: Path) {}

  /** The operation of a piece that is not before the last one asked. */
  at(piece: number): number {
    for (; this.piece < piece; this.piece += 1) {
      if (this.path.tool[this.piece] !== this.path.tool[this.piece + 1]) this.operation += 1;
    }
    return this.operation;
  }
}

function textureOf(path: Path, { first, last }: Lines, operations: Operations): DataTexture {
  const { kind, tool, feed, t0, x0, y0, z0, x1, y1, z1 } = path;
  const rows = Math.ceil(first.length / ROW);
  const data = new Float32Array(rows * ROW * TEXELS * 4);
  const moments = MOMENTS / Math.max(path.seconds, 1e-6);
  for (let own = 0; own < first.length; own += 1) {
    const [from, end, to] = [first[own] as number, last[own] as number, own * TEXELS * 4];
    // All of it is less than 2^23, so that a float has it as it is.
    const look = (kind[from] as number) + 8 * Number(end > from) + 16 * ((tool[from] as number) & 7) + 128 * (operations.at(from) & 7);
    data[to] = x0[from] as number;
    data[to + 1] = y0[from] as number;
    data[to + 2] = z0[from] as number;
    data[to + 3] = look + 1024 * Math.min(MOMENTS, Math.round((t0[from] as number) * moments));
    data[to + 4] = x1[end] as number;
    data[to + 5] = y1[end] as number;
    data[to + 6] = z1[end] as number;
    data[to + 7] = feed[from] as number;
  }
  // Without NEAREST, textures of floats read as zeros, and no error says so.
  const texture = new DataTexture(data, ROW * TEXELS, rows, RGBAFormat, FloatType);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  // The graphics card has it now; a second copy here would cost as much as all columns of the path.
  texture.onUpdate = () => ((texture.image as { data: unknown }).data = null);
  return texture;
}

/** Materials of pieces by their places. One stays for the paths that follow: to compile its shaders takes longer than a picture. */
class Materials {
  private readonly all: RawShaderMaterial[] = [];
  private readonly defines: Record<string, number> = {};

  constructor(
    private readonly uniforms: Record<string, IUniform>,
    private readonly fragmentShader: string,
  ) {}

  /** That of a piece, with uniforms of its own. */
  at(piece: number, own: Record<string, IUniform>): RawShaderMaterial {
    const { uniforms, fragmentShader, defines } = this;
    const material = (this.all[piece] ??= new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: VERTEX,
      fragmentShader,
      uniforms: { ...uniforms },
      defines,
      side: DoubleSide,
    }));
    Object.assign(material.uniforms, own);
    return material;
  }

  /** Whether pictures need what a name stands for. */
  define(name: "SECTION" | "DEPTH", on: boolean): void {
    if (on === name in this.defines) return;
    if (on) this.defines[name] = 1;
    else delete this.defines[name];
    for (const material of this.all) material.needsUpdate = true;
  }
}

/** A piece of so many lines, of some width or of the device. */
function piece(wide: boolean, lines: number, material: RawShaderMaterial): Mesh | LineSegments {
  const geometry = new BufferGeometry();
  geometry.setDrawRange(0, lines * (wide ? 6 : 2));
  const made = wide ? new Mesh(geometry, material) : new LineSegments(geometry, material);
  // It has no vertices that a box could be made of.
  made.frustumCulled = false;
  return made;
}

/** Least and greatest feed and height of what cuts. */
export function ranges(path: Path): Vector4 {
  let [low, high] = [Infinity, -Infinity];
  for (let at = 0; at < path.pieces; at += 1) {
    const feed = path.feed[at] as number;
    if (isRapid(path.kind[at]) || feed <= 0) continue;
    low = Math.min(low, feed);
    high = Math.max(high, feed);
  }
  const { low: bottom, high: top } = path.box;
  return new Vector4(Number.isFinite(low) ? low : 0, high > 0 ? high : 0, bottom[2], top[2]);
}

/** A corner of a box as a vector. */
export function corner(of: readonly [number, number, number]): Vector3 {
  return new Vector3(...of);
}
