// The part: a grid of the map's cells, displaced by its heights in the vertex shader, with walls at the border. To show
// another moment is to upload the heights; nothing is built anew.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DataTexture,
  DoubleSide,
  FloatType,
  GLSL3,
  Mesh,
  NearestFilter,
  RawShaderMaterial,
  RedFormat,
  Vector2,
  type IUniform,
} from "three";
import type { Cut, Heights } from "../engine/part";

const VERTEX = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform sampler2D heights;
uniform ivec2 cells;
uniform vec2 low;
uniform float cell;
uniform float bottom;
/** Cells between two points. */
uniform int stride;
uniform ivec2 points;
out vec3 place;
out vec2 at;
/** Which way the surface looks, and how near a wall of the border is. */
out vec3 face;
out float border;
flat out int isGone;

float heightAt(ivec2 own) {
  return max(texelFetch(heights, clamp(own, ivec2(0), cells - 1), 0).r, bottom);
}

void main() {
  // A ring around the cells stands on the floor: the walls.
  int across = points.x + 2;
  ivec2 own = ivec2(gl_VertexID % across, gl_VertexID / across) - 1;
  ivec2 point = clamp(own, ivec2(0), points - 1);
  ivec2 inside = min(point * stride, cells - 1);
  float height = texelFetch(heights, inside, 0).r;
  isGone = int(height < -1e20);
  bool wall = own != point;
  place = vec3(low + (vec2(inside) + 0.5) * cell, wall || isGone == 1 ? bottom : height);
  // The outer half of a cell at the border belongs to the part.
  place.xy += (vec2(greaterThanEqual(own, points - 1)) - vec2(lessThanEqual(own, ivec2(0)))) * 0.5 * cell;
  at = vec2(inside);
  border = float(wall);
  // Over two points to each side, so that the steps of a wall between cells are not seen.
  int reach = 2 * stride;
  float x = heightAt(inside - ivec2(reach, 0)) - heightAt(inside + ivec2(reach, 0));
  float y = heightAt(inside - ivec2(0, reach)) - heightAt(inside + ivec2(0, reach));
  face = vec3(x, y, 2.0 * float(reach) * cell);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D last;
uniform sampler2D heights;
uniform vec3 raw;
uniform vec3 cut;
uniform vec3 tools[8];
uniform int byTool;
uniform vec2 marked;
uniform vec3 mark;
uniform vec3 sun;
uniform vec3 eye;
in vec3 place;
in vec2 at;
in vec3 face;
in float border;
flat in int isGone;
out vec4 ink;

void main() {
  if (isGone == 1) discard;
  vec3 normal = normalize(border > 0.001 ? cross(dFdx(place), dFdy(place)) : face);
  if (dot(normal, eye) < 0.0) normal = -normal;
  // Move and tool of a cell: moves in whole numbers, the tool's ink in the fraction.
  float number = texelFetch(last, ivec2(at + 0.5), 0).r;
  float touched = step(0.5, number);
  vec3 own = mix(raw, cut, touched);
  if (byTool == 1 && touched > 0.5) own = mix(own, tools[int(fract(number) * 8.0 + 0.5) & 7], 0.55);
  float move = floor(number);
  if (move >= marked.x && move <= marked.y) own = mix(own, mark, 0.65);
  float lit = max(dot(normal, sun), 0.0);
  float shine = pow(max(dot(reflect(-sun, normal), eye), 0.0), 24.0) * 0.14 * touched * smoothstep(0.3, 0.8, normal.z);
  float side = 0.5 + 0.5 * normal.z;
  ink = vec4(own * (0.50 + 0.16 * side + 0.42 * lit) + shine, 1.0);
}
`;

/** The move that cut a cell as a colour; what is transparent by half says that it is a move, not a piece. */
const PICK = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D last;
in vec3 place;
in vec2 at;
flat in int isGone;
out vec4 ink;
void main() {
  if (isGone == 1) discard;
  int id = int(floor(texelFetch(last, ivec2(at + 0.5), 0).r));
  ink = vec4(float(id & 255), float((id >> 8) & 255), float((id >> 16) & 255), 128.0) / 255.0;
}
`;

export class StockView {
  readonly drawn: Mesh<BufferGeometry, RawShaderMaterial>;
  readonly pick: Mesh<BufferGeometry, RawShaderMaterial>;
  private readonly uniforms: Record<string, IUniform> = {
    heights: { value: null },
    last: { value: null },
    cells: { value: new Vector2() },
    low: { value: new Vector2() },
    cell: { value: 1 },
    stride: { value: 1 },
    points: { value: new Vector2() },
    bottom: { value: 0 },
    raw: { value: new Color() },
    cut: { value: new Color() },
    tools: { value: Array.from({ length: 8 }, () => new Color()) },
    byTool: { value: 0 },
    marked: { value: new Vector2(-1, -1) },
    mark: { value: new Color() },
    sun: { value: [-0.33, -0.52, 0.79] },
    eye: { value: [0, 0, 1] },
  };
  private cells: [number, number] = [0, 0];

  constructor() {
    const make = (fragmentShader: string) => {
      const { uniforms } = this;
      const material = new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader: VERTEX,
        fragmentShader,
        uniforms,
        side: DoubleSide,
        // Moves along a face are seen on it.
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 2,
      });
      const mesh = new Mesh(new BufferGeometry(), material);
      mesh.frustumCulled = false;
      mesh.visible = false;
      return mesh;
    };
    this.drawn = make(FRAGMENT);
    this.pick = make(PICK);
  }

  /** Another part, or none. */
  open(cut: Cut | undefined): void {
    this.drawn.visible = this.pick.visible = cut !== undefined;
    if (!cut) return;
    const { cells, cell, low } = cut.raw;
    this.uniforms.cells!.value.set(...cells);
    this.uniforms.low!.value.set(low[0], low[1]);
    this.uniforms.cell!.value = cell;
    this.uniforms.bottom!.value = low[2];
    if (this.cells[0] === cells[0] && this.cells[1] === cells[1]) return;
    this.cells = cells;
    for (const name of ["heights", "last"]) {
      (this.uniforms[name]!.value as DataTexture | null)?.dispose();
      const texture = new DataTexture(new Float32Array(cells[0] * cells[1]), ...cells, RedFormat, FloatType);
      texture.minFilter = texture.magFilter = NearestFilter;
      texture.unpackAlignment = 4;
      this.uniforms[name]!.value = texture;
    }
    this.rebuild();
  }

  /** Fewer points, for a device that draws slowly; false where there are few already. */
  coarser(): boolean {
    if (this.uniforms.stride!.value >= 4) return false;
    this.uniforms.stride!.value *= 2;
    this.rebuild();
    return true;
  }

  private rebuild(): void {
    const stride = this.uniforms.stride!.value as number;
    const [across, along] = this.cells.map((cells) => Math.ceil((cells - 1) / stride) + 1) as [number, number];
    this.uniforms.points!.value.set(across, along);
    const index = new BufferAttribute(triangles(across + 2, along + 2), 1);
    for (const mesh of [this.drawn, this.pick]) {
      mesh.geometry.dispose();
      mesh.geometry = new BufferGeometry();
      mesh.geometry.setIndex(index);
    }
  }

  /** The part at a moment; `toolOf` gives the place of a move's tool. */
  show(part: Heights, toolOf: (move: number) => number): void {
    const heights = this.uniforms.heights!.value as DataTexture;
    const last = this.uniforms.last!.value as DataTexture;
    const target = heights.image.data as unknown as Float32Array;
    if (target.length !== part.heights.length) return;
    for (let at = 0; at < target.length; at += 1) {
      const height = part.heights[at] as number;
      target[at] = height > -1e20 ? height : -1e30;
    }
    const moves = last.image.data as unknown as Float32Array;
    for (let at = 0; at < moves.length; at += 1) {
      const move = part.last[at] as number;
      moves[at] = move === 0 ? 0 : move + (toolOf(move) % 8) / 8;
    }
    heights.needsUpdate = last.needsUpdate = true;
  }

  setVisible(on: boolean): void {
    this.drawn.visible = this.pick.visible = on && this.cells[0] > 0;
  }

  setMarked(first: number, last: number): void {
    this.uniforms.marked!.value.set(first, last);
  }

  setByTool(on: boolean): void {
    this.uniforms.byTool!.value = Number(on);
  }

  /** Where the eye is, as a direction. */
  setEye(x: number, y: number, z: number): void {
    this.uniforms.eye!.value = [x, y, z];
  }

  setInks(ink: (name: string) => Color): void {
    this.uniforms.raw!.value = ink("--part-raw");
    this.uniforms.cut!.value = ink("--part-cut");
    this.uniforms.mark!.value = ink("--c-move-marked");
    this.uniforms.tools!.value = Array.from({ length: 8 }, (_, at) => ink(`--c-tool-${at}`));
  }
}

/** Two triangles for each square of a grid of so many points. */
function triangles(across: number, along: number): Uint32Array {
  const index = new Uint32Array((across - 1) * (along - 1) * 6);
  let at = 0;
  for (let row = 0; row + 1 < along; row += 1) {
    for (let column = 0; column + 1 < across; column += 1) {
      const corner = row * across + column;
      index.set([corner, corner + 1, corner + across, corner + 1, corner + across + 1, corner + across], at);
      at += 6;
    }
  }
  return index;
}
