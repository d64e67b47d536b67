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
  RedIntegerFormat,
  UnsignedByteType,
  UnsignedIntType,
  Vector2,
  Vector4,
  type IUniform,
} from "three";
import type { Cut, Heights } from "../engine/part";
import { Faces, HOLLOWS, MAKER } from "./hollows";
import { all, few } from "./mesh";
import { SCALE } from "./shaders";

/** Where the cells are, and how the grid that is drawn lies on them. */
export const MAP = /* glsl */ `
uniform ivec2 cells;
uniform vec2 low;
uniform float cell;
uniform float bottom;
/** Cells between two points. */
uniform int stride;
uniform ivec2 points;
`;

/** Light on a face. */
const LIGHT = /* glsl */ `
uniform vec3 sun;
uniform vec3 eye;
/** Metalness, roughness, brightness of the light; cells between two lines of a wireframe, 0 for none. */
uniform vec4 look;

/** How many times its own colour it shows, and its highlight where it was cut. */
vec2 lightOf(vec3 face) {
  vec3 normal = normalize(face);
  if (dot(normal, eye) < 0.0) normal = -normal;
  float lit = max(dot(normal, sun), 0.0);
  // Metal returns its own colour in a highlight and little else; what is rough spreads it.
  float metal = look.x;
  float sharp = exp2(1.0 + 8.0 * (1.0 - look.y));
  float shine = pow(max(dot(reflect(-sun, normal), eye), 0.0), sharp) * (1.0 - look.y) * mix(0.3, 1.1, metal);
  float around = 0.5 + 0.5 * reflect(-eye, normal).z;
  float side = 0.5 + 0.5 * normal.z;
  float matt = 0.50 + 0.16 * side + 0.42 * lit * look.z;
  float mirror = mix(0.35 + 0.45 * lit * look.z, 0.45 + 0.65 * around, 1.0 - look.y);
  return vec2(mix(matt, mirror, metal * 0.8), shine * look.z);
}
`;

const VERTEX = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform sampler2D heights;
${MAP}
${LIGHT}
out vec3 place;
out vec2 at;
/** Light at the point: a device without graphics takes long for what is done at each pixel. */
out vec2 light;
flat out int isGone;

float heightAt(ivec2 own) {
  return max(texelFetch(heights, clamp(own, ivec2(0), cells - 1), 0).r, bottom);
}

void main() {
  // Two rings around the cells are the walls: one at the height of its cells, and one on the floor.
  int across = points.x + 4;
  ivec2 own = ivec2(gl_VertexID % across, gl_VertexID / across) - 2;
  ivec2 point = clamp(own, ivec2(0), points - 1);
  ivec2 outward = own - point;
  ivec2 inside = min(point * stride, cells - 1);
  float height = texelFetch(heights, inside, 0).r;
  isGone = int(height < -1e20);
  bool floor_ = any(greaterThan(abs(outward), ivec2(1)));
  place = vec3(low + (vec2(inside) + 0.5) * cell, floor_ || isGone == 1 ? bottom : height);
  // The outer half of a cell at the border belongs to the part.
  place.xy += (vec2(greaterThanEqual(own, points - 1)) - vec2(lessThanEqual(own, ivec2(0)))) * 0.5 * cell;
  at = vec2(inside);
  // Over two points to each side, so that the steps of a wall between cells are not seen.
  int reach = 2 * stride;
  float x = heightAt(inside - ivec2(reach, 0)) - heightAt(inside + ivec2(reach, 0));
  float y = heightAt(inside - ivec2(0, reach)) - heightAt(inside + ivec2(0, reach));
  light = lightOf(outward == ivec2(0) ? vec3(x, y, 2.0 * float(reach) * cell) : vec3(outward, 0.0));
  gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
}
`;

/** `StockView.compile` defines the colouring and whether a picture has a section, a wireframe or hollows. Graphics by software
 * compute both sides of a branch. */
const FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
uniform usampler2D last;
uniform sampler2D tint;
uniform vec3 raw;
uniform vec3 cut;
uniform vec3 tools[8];
uniform vec2 range;
uniform vec2 marked;
uniform vec3 mark;
uniform vec4 section;
/** Pixels of the picture in one of the page. */
uniform float ratio;
${LIGHT}
${SCALE}
${HOLLOWS}
#ifdef FACES
uniform sampler2D hollowTint;
uniform sampler2D heights;
${MAP}
float heightAt(ivec2 own) {
  return max(texelFetch(heights, clamp(own, ivec2(0), cells - 1), 0).r, bottom);
}
${MAKER}
in vec3 face;
in float border;
#else
in vec2 light;
#endif
in vec3 place;
in vec2 at;
flat in int isGone;
out vec4 ink;

void main() {
  if (isGone == 1) discard;
#ifdef SECTION
  if (dot(section.xyz, place) > section.w) discard;
#endif
#ifdef WIRE
  vec2 net = at / look.w;
  vec2 off = abs(fract(net + 0.5) - 0.5) / max(fwidth(net), vec2(1e-5));
  if (min(off.x, off.y) > 0.7 * ratio) discard;
#endif
  ivec2 own_cell = ivec2(at + 0.5);
#ifdef FACES
  vec3 looks = border > 0.001 ? cross(dFdx(place), dFdy(place)) : face;
  if (border < 0.001 && place.z > heightAt(own_cell) - 0.001) {
    // As the grid has it.
    float x = heightAt(own_cell - ivec2(2, 0)) - heightAt(own_cell + ivec2(2, 0));
    float y = heightAt(own_cell - ivec2(0, 2)) - heightAt(own_cell + ivec2(0, 2));
    looks = vec3(x, y, 4.0 * cell);
  }
  vec2 light = lightOf(looks);
  ivec2 made = makerCell(own_cell);
  uint move = maker(made, place.z);
  float value = 0.0;
  if (!isOutside(made)) value = (isBelow(made, place.z) ? texelFetch(hollowTint, made, 0) : texelFetch(tint, made, 0)).r;
#else
#ifdef HOLLOWS
  // A hair less than is covered, so that no gap is seen between them.
  if (isCovered(ivec2(at + 0.44)) && isCovered(ivec2(at + 0.56))) discard;
#endif
  uint move = texelFetch(last, own_cell, 0).r;
#if COLOURING == 1 || COLOURING == 2
  float value = texelFetch(tint, own_cell, 0).r;
#endif
#endif
  bool touched = move > 0u;
#if COLOURING == 0
  vec3 own = touched ? cut : raw;
#else
#if COLOURING == 1
  vec3 tone = mix(cut, tools[int(value * 255.0 + 0.5) & 7], 0.7);
#elif COLOURING == 2
  vec3 tone = mix(cut, scale(value), 0.8);
#else
  vec3 tone = mix(cut, scale((place.z - range.x) / max(range.y - range.x, 1e-6)), 0.8);
#endif
  vec3 own = touched ? tone : raw;
#endif
  if (float(move) >= marked.x && float(move) <= marked.y) own = mix(own, mark, 0.65);
  float shine = touched ? light.y : 0.0;
  ink = vec4(own * light.x + mix(vec3(1.0), own, look.x) * shine, 1.0);
}
`;

/** The move that cut a cell as a colour; what is transparent by half says that it is a move, not a piece. */
const PICK = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
uniform usampler2D last;
uniform vec4 section;
${HOLLOWS}
#ifdef FACES
uniform sampler2D heights;
${MAP}
${MAKER}
#endif
in vec3 place;
in vec2 at;
flat in int isGone;
out vec4 ink;
void main() {
  if (isGone == 1 || dot(section.xyz, place) > section.w) discard;
#ifdef FACES
  int id = int(maker(makerCell(ivec2(at + 0.5)), place.z));
#else
  if (isCovered(ivec2(at + 0.5))) discard;
  int id = int(texelFetch(last, ivec2(at + 0.5), 0).r);
#endif
  ink = vec4(float(id & 255), float((id >> 8) & 255), float((id >> 16) & 255), 128.0) / 255.0;
}
`;

/** Textures of a part: of each cell the height, the last move, and what colours it. */
const TEXTURES = [
  ["heights", Float32Array, RedFormat, FloatType],
  ["last", Uint32Array, RedIntegerFormat, UnsignedIntType],
  ["tint", Uint8Array, RedFormat, UnsignedByteType],
] as const;

/** Cells along a side of which a part has many. */
const MANY = 700;
/** Cells between two points at most; more only where points stay so near each other in the picture, in pixels. */
const [COARSEST, NEAR] = [4, 2];
/** Triangles are as they were until a pixel is so many times smaller, or larger. */
const [NEARER, FARTHER] = [1.5, 4];
/** Of a picture's pixel, how far a triangle may be from the part; and of its slope, mm a mm: a sixtieth of the light. */
const [SEEN, LIT] = [0.5, 0.04];

export class StockView {
  readonly drawn: Mesh<BufferGeometry, RawShaderMaterial>;
  readonly pick: Mesh<BufferGeometry, RawShaderMaterial>;
  readonly uniforms: Record<string, IUniform> = {
    heights: { value: null },
    last: { value: null },
    tint: { value: null },
    scales: { value: [0, 1, 2, 3].map(() => new Color()) },
    section: { value: new Vector4(0, 0, 0, 1) },
    look: { value: new Vector4(0, 0.6, 1, 0) },
    ratio: { value: 1 },
    range: { value: new Vector2(0, 1) },
    cells: { value: new Vector2() },
    low: { value: new Vector2() },
    cell: { value: 1 },
    stride: { value: 1 },
    points: { value: new Vector2() },
    bottom: { value: 0 },
    raw: { value: new Color() },
    cut: { value: new Color() },
    tools: { value: Array.from({ length: 8 }, () => new Color()) },
    marked: { value: new Vector2(-1, -1) },
    mark: { value: new Color() },
    sun: { value: [-0.33, -0.52, 0.79] },
    eye: { value: [0, 0, 1] },
  };
  /** The part around its hollows. */
  readonly faces = new Faces(this.uniforms, MAP, FRAGMENT, PICK);
  private cells: [number, number] = [0, 0];
  private colouring: 0 | 1 | 2 | 3 = 0;
  private compiled = "";
  private finest = 1;
  /** The pixel that the triangles were made for, mm; 0 for all triangles, and nothing for none. */
  private made: number | undefined;

  constructor() {
    const make = (fragmentShader: string) => {
      const { uniforms } = this;
      const material = new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader: VERTEX,
        fragmentShader,
        defines: {},
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

  /** Another part, or none, for a device that draws slowly or may do so. */
  open(cut: Cut | undefined, slow: boolean): void {
    this.drawn.visible = this.pick.visible = cut !== undefined;
    this.faces.setVisible(false);
    if (!cut) return;
    const { cells, cell, low } = cut.raw;
    this.uniforms.cells!.value.set(...cells);
    this.uniforms.low!.value.set(low[0], low[1]);
    this.uniforms.cell!.value = cell;
    this.uniforms.bottom!.value = low[2];
    if (this.cells[0] === cells[0] && this.cells[1] === cells[1]) return;
    // Of many cells few are drawn until it is known how quick the device is.
    if (slow && Math.max(...cells) > MANY) this.finest = COARSEST;
    this.cells = cells;
    const [across, along] = cells;
    for (const [name, Type, format, type] of TEXTURES) {
      (this.uniforms[name]!.value as DataTexture | null)?.dispose();
      const texture = new DataTexture(new Type(across * along), across, along, format, type);
      texture.minFilter = texture.magFilter = NearestFilter;
      texture.unpackAlignment = name === "tint" ? 1 : 4;
      texture.needsUpdate = true;
      this.uniforms[name]!.value = texture;
    }
    this.setStride(this.stride);
  }

  /** Cells between two points of a picture that stays. */
  get stride(): number {
    return this.finest;
  }

  /** Fewer points, for a device that draws slowly; false where there are few already. A cell is so many pixels wide. */
  coarser(pixels: number): boolean {
    const stride = 2 * this.stride;
    if (stride > COARSEST && stride * pixels > NEAR) return false;
    this.setStride(stride);
    return true;
  }

  /** More points, for a device that draws quickly; false where each cell has its own. */
  finer(): boolean {
    if (this.stride === 1) return false;
    this.setStride(this.stride / 2);
    return true;
  }

  private setStride(stride: number): void {
    this.finest = stride;
    this.made = undefined;
  }

  /** Before a picture whose pixels are so many mm: all triangles, as few as it shows, or the least, for one that soon another follows. */
  prepare(pixel: number, triangles: "all" | "few" | "least"): void {
    const { cell, bottom, heights, stride } = this.uniforms;
    if (!heights!.value) return;
    // The eye came nearer: points that are far from each other now get others between them.
    while (this.finest > COARSEST && this.finest * cell!.value > 2 * NEAR * pixel) this.finer();
    const isRough = triangles === "least" && this.finest > 1 && 2 * this.finest * cell!.value < 2 * NEAR * pixel;
    const wanted = isRough ? 2 * this.finest : this.finest;
    const [made, lies] = [this.made, stride!.value === wanted];
    const fits = triangles === "all" ? made === 0 : made && pixel > made / NEARER && pixel < made * FARTHER;
    if (fits && lies) return;
    this.made = triangles === "all" ? 0 : pixel;
    stride!.value = wanted;
    this.uniforms.points!.value.set(...this.cells.map((cells) => Math.ceil((cells - 1) / wanted) + 1));
    const points = this.uniforms.points!.value.toArray() as [number, number];
    const grid = { heights: heights!.value.image.data, cells: this.cells, cell: cell!.value, bottom: bottom!.value, stride: wanted, points };
    const index = new BufferAttribute(triangles === "all" ? all(points) : few(grid, { height: SEEN * pixel, slope: LIT }), 1);
    for (const mesh of [this.drawn, this.pick]) {
      mesh.geometry.dispose();
      mesh.geometry = new BufferGeometry();
      mesh.geometry.setIndex(index);
    }
  }

  /** The part at a moment: its columns go to the graphics card as they are. */
  show(part: Heights): void {
    for (const [name, own] of [["heights", part.heights], ["last", part.last]] as const) {
      const texture = this.uniforms[name]!.value as DataTexture | null;
      if (!texture || own.length !== this.cells[0] * this.cells[1]) return;
      (texture.image as { data: unknown }).data = own;
      texture.needsUpdate = true;
    }
    // All triangles are the same for each part.
    if (this.made !== 0) this.made = undefined;
    this.faces.show(part, this.cells);
    this.faces.setVisible(this.drawn.visible);
  }

  /** A number for each cell, 0 to 255: of a colour, or a place on the scale. */
  setTint(tint: Uint8Array, ofHollows: Uint8Array): void {
    if (this.faces.some) this.faces.setTint(ofHollows, this.cells);
    const texture = this.uniforms.tint!.value as DataTexture | null;
    if (!texture || tint.length !== this.cells[0] * this.cells[1]) return;
    (texture.image as { data: unknown }).data = tint;
    texture.needsUpdate = true;
  }

  setVisible(on: boolean): void {
    this.drawn.visible = this.pick.visible = on && this.cells[0] > 0;
    this.faces.setVisible(this.drawn.visible);
  }

  setMarked(first: number, last: number): void {
    this.uniforms.marked!.value.set(first, last);
  }

  /** 0 the part's own colour, 1 by the number in the tint, 2 by its place on the scale, 3 by height between two. */
  setColouring(how: 0 | 1 | 2 | 3, low = 0, high = 1): void {
    this.colouring = how;
    this.uniforms.range!.value.set(low, high);
  }

  /** Before a picture: its shaders do what it shows and nothing else. */
  compile(): void {
    const { look, section } = this.uniforms;
    const on = { WIRE: look!.value.w > 0, SECTION: section!.value.toArray().slice(0, 3).some(Boolean), HOLLOWS: this.faces.some };
    const defines = { COLOURING: this.colouring, ...Object.fromEntries(Object.entries(on).filter(([, is]) => is).map(([name]) => [name, 1])) };
    const key = JSON.stringify(defines);
    if (key === this.compiled) return;
    this.compiled = key;
    for (const { material } of [this.drawn, this.faces.drawn]) {
      Object.keys(on).forEach((name) => delete material.defines[name]);
      Object.assign(material.defines, defines);
      material.needsUpdate = true;
    }
  }

  /** Where the eye is, as a direction. */
  setEye(x: number, y: number, z: number): void {
    this.uniforms.eye!.value = [x, y, z];
  }

  setInks(ink: (name: string) => Color): void {
    this.uniforms.raw!.value = ink("--part-raw");
    this.uniforms.cut!.value = ink("--part-cut");
    this.uniforms.mark!.value = ink("--c-move-marked");
    this.uniforms.scales!.value = [0, 1, 2, 3].map((at) => ink(`--scale-${at}`));
    this.uniforms.tools!.value = Array.from({ length: 8 }, (_, at) => ink(`--c-tool-${at}`));
  }
}
