// The moves of a path as drawings: a texture and a mesh without vertices for each million of moves.

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
import { CHUNK, FRAGMENT, PICK, ROW, TEXELS, VERTEX } from "./shaders";

/** What lines of some width are drawn up to; more moves are lines of the device, a third of the work. */
const WIDE = 300_000;

export const COLOURINGS = ["kind", "tool", "operation", "feed", "depth", "time"] as const;
export type Colouring = (typeof COLOURINGS)[number];

/** So many lines are drawn in the time of a picture by a device that draws slowly. */
const FEW = 40_000;

/** Uniforms that all pieces have in common. */
function shared(): Record<string, IUniform> {
  return {
    now: { value: -1 },
    share: { value: 0 },
    size: { value: new Vector2(1, 1) },
    width: { value: 1.6 },
    marked: { value: new Vector2(-1, -1) },
    shown: { value: 15 },
    future: { value: 1 },
    kinds: { value: [0, 1, 2, 3].map(() => new Color()) },
    tools: { value: Array.from({ length: 8 }, () => new Color()) },
    mark: { value: new Color() },
    ground: { value: new Color() },
    colouring: { value: 0 },
    range: { value: new Vector4(0, 1, 0, 1) },
    seconds: { value: 1 },
    scales: { value: [0, 1, 2, 3].map(() => new Color()) },
    every: { value: 1 },
    section: { value: new Vector4(0, 0, 0, 1) },
  };
}

export class Paths {
  /** What is seen, and what a pointer is looked up in. */
  readonly drawn = new Group();
  readonly pick = new Group();
  private readonly uniforms = shared();
  private readonly pickUniforms = shared();
  private readonly materials = {
    drawn: materials(this.uniforms, FRAGMENT),
    pick: materials(this.pickUniforms, PICK),
  };
  private path: Path | undefined;

  /** Another path, for a device that draws slowly or may do so; one that is like the last is drawn as finely. */
  set(path: Path | undefined, slow: boolean, alike: boolean): void {
    this.clear();
    this.path = path;
    const pieces = path?.pieces ?? 0;
    if (!path || path.pieces === 0) return;
    this.uniforms.range!.value = ranges(path);
    this.uniforms.seconds!.value = path.seconds;
    const operations = new Operations(path);
    const wide = path.pieces <= WIDE;
    this.uniforms.width!.value = wide ? 1.6 : 0;
    this.pickUniforms.width!.value = wide ? 7 : 0;
    for (let base = 0; base < path.pieces; base += CHUNK) {
      const moves = Math.min(CHUNK, path.pieces - base);
      const own = { moves: { value: textureOf(path, base, moves, operations) }, base: { value: base }, count: { value: moves } };
      this.drawn.add(piece(wide, moves, this.materials.drawn(base / CHUNK, own)));
      this.pick.add(piece(wide, moves, this.materials.pick(base / CHUNK, own)));
    }
    // Where there are many, few are drawn until it is known how quick the device is.
    this.thin(alike ? this.every : wide && !slow ? 1 : Math.ceil(pieces / FEW));
  }

  /** So many moves are one line. */
  get every(): number {
    return this.uniforms.every!.value as number;
  }

  /** A device that draws slowly has fewer lines, each of several moves; false where there are few already. */
  coarser(): boolean {
    const pieces = this.path?.pieces ?? 0;
    if (pieces / this.every <= FEW) return false;
    this.thin(Math.ceil(pieces / FEW));
    return true;
  }

  /** More lines, four times at most; false where each move has its own. */
  finer(): boolean {
    if (this.every === 1) return false;
    this.thin(Math.ceil(this.every / 4));
    return true;
  }

  private thin(every: number): void {
    this.uniforms.every!.value = this.pickUniforms.every!.value = every;
    for (const group of [this.drawn, this.pick]) {
      for (const child of group.children as Mesh<BufferGeometry, RawShaderMaterial>[]) {
        const moves = child.material.uniforms.count!.value as number;
        child.geometry.setDrawRange(0, Math.ceil(moves / every) * (child instanceof Mesh ? 6 : 2));
      }
    }
  }

  setSection(plane: Vector4): void {
    this.uniforms.section!.value = this.pickUniforms.section!.value = plane;
  }

  setNow(move: number, share: number): void {
    this.uniforms.now!.value = this.pickUniforms.now!.value = move;
    this.uniforms.share!.value = share;
  }

  setMarked(first: number, last: number): void {
    this.uniforms.marked!.value.set(first, last);
  }

  setShown(bits: number, future: boolean): void {
    this.uniforms.shown!.value = this.pickUniforms.shown!.value = bits;
    this.uniforms.future!.value = this.pickUniforms.future!.value = Number(future);
  }

  setColouring(by: Colouring): void {
    this.uniforms.colouring!.value = COLOURINGS.indexOf(by);
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

  private clear(): void {
    for (const group of [this.drawn, this.pick]) {
      for (const child of [...group.children] as Mesh<BufferGeometry, RawShaderMaterial>[]) {
        (child.material.uniforms.moves?.value as DataTexture).dispose();
        child.geometry.dispose();
        group.remove(child);
      }
    }
  }
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

function textureOf(path: Path, base: number, moves: number, operations: Operations): DataTexture {
  const rows = Math.ceil(moves / ROW);
  const data = new Float32Array(rows * ROW * TEXELS * 4);
  for (let own = 0; own < moves; own += 1) {
    const [at, to] = [base + own, own * TEXELS * 4];
    data[to] = path.x0[at] as number;
    data[to + 1] = path.y0[at] as number;
    data[to + 2] = path.z0[at] as number;
    data[to + 3] = path.kind[at] as number;
    data[to + 4] = path.x1[at] as number;
    data[to + 5] = path.y1[at] as number;
    data[to + 6] = path.z1[at] as number;
    data[to + 7] = path.line[at] as number;
    data[to + 8] = path.tool[at] as number;
    data[to + 9] = path.feed[at] as number;
    data[to + 10] = path.t0[at] as number;
    data[to + 11] = operations.at(at);
  }
  // Without NEAREST, textures of floats read as zeros, and no error says so.
  const texture = new DataTexture(data, ROW * TEXELS, rows, RGBAFormat, FloatType);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  // The graphics card has it now; a second copy here would cost as much as all columns of the path.
  texture.onUpdate = () => ((texture.image as { data: unknown }).data = null);
  return texture;
}

/** Gives the material of a piece by its place, with uniforms of its own. A material stays for the paths that follow: to compile its
 * shaders takes longer than a picture. */
function materials(uniforms: Record<string, IUniform>, fragmentShader: string): (at: number, own: Record<string, IUniform>) => RawShaderMaterial {
  const all: RawShaderMaterial[] = [];
  return (at, own) => {
    const material = (all[at] ??= new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: VERTEX,
      fragmentShader,
      uniforms: { ...uniforms },
      side: DoubleSide,
    }));
    Object.assign(material.uniforms, own);
    return material;
  };
}

/** A piece of so many moves, lines of some width or lines of the device. */
function piece(wide: boolean, moves: number, material: RawShaderMaterial): Mesh | LineSegments {
  const geometry = new BufferGeometry();
  geometry.setDrawRange(0, moves * (wide ? 6 : 2));
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
