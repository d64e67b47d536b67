// What lies under the upper surface of a part with undercuts: its hollows, and the faces of the blocks around them. The grid of
// heights leaves out the cells that the faces cover.

import {
  DataTexture,
  DoubleSide,
  FloatType,
  GLSL3,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  NearestFilter,
  RGFormat,
  RawShaderMaterial,
  RedFormat,
  RedIntegerFormat,
  UnsignedByteType,
  UnsignedIntType,
  type IUniform,
} from "three";
import type { Heights } from "../engine/part";

/** Ends of hollows in a row of their texture. */
const ROW = 1024;

/** Whether a cell is covered by faces, and the hollows of a cell. */
export const HOLLOWS = /* glsl */ `
/** Of each cell: 1 where faces cover it, twice the number of its hollows, 32 times the place of the first. */
uniform highp usampler2D hollowed;
/** The lower and the upper end of each hollow. */
uniform highp sampler2D hollows;
uniform bool hasHollows;
/** The move that cut the hollows of each cell last. */
uniform highp usampler2D hollowLast;

bool isCovered(ivec2 own) {
  return hasHollows && (texelFetch(hollowed, own, 0).r & 1u) == 1u;
}

bool isHollow(ivec2 own, float height) {
  uint packed = texelFetch(hollowed, own, 0).r;
  int first = int(packed >> 5);
  int count = int((packed >> 1) & 15u);
  for (int n = first; n < first + count; n += 1) {
    vec2 ends = texelFetch(hollows, ivec2(n % ${ROW}, n / ${ROW}), 0).rg;
    if (height > ends.x && height < ends.y) return true;
  }
  return false;
}
`;

/** Who made what is seen of a face: the cell of a wall is the one before it, which was emptied. */
export const MAKER = /* glsl */ `
flat in int side;
bool isOutside(ivec2 own) {
  return any(lessThan(own, ivec2(0))) || any(greaterThanEqual(own, cells));
}
ivec2 makerCell(ivec2 own) {
  return own + (side == 2 ? ivec2(0, -1) : side == 3 ? ivec2(1, 0) : side == 4 ? ivec2(0, 1) : side == 5 ? ivec2(-1, 0) : ivec2(0));
}
bool isBelow(ivec2 own, float height) {
  return side == 1 || height < texelFetch(heights, own, 0).r - 0.001;
}
uint maker(ivec2 own, float height) {
  if (isOutside(own)) return 0u;
  return isBelow(own, height) ? texelFetch(hollowLast, own, 0).r : texelFetch(last, own, 0).r;
}
`;

/** One face of blocks in a row. The varyings are those of the grid. */
const vertex = (map: string) => /* glsl */ `
precision highp float;
precision highp int;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
${map}
/** The cell, the side and the length, the two heights. */
in uvec4 own;
out vec3 place;
out vec2 at;
out vec3 face;
out float border;
flat out int isGone;
flat out int side;

void main() {
  int corner = gl_VertexID < 3 ? gl_VertexID : gl_VertexID - 2;
  vec2 part = vec2(corner & 1, corner >> 1);
  side = int(own.y & 255u);
  float row = float(own.y >> 8);
  vec2 between = uintBitsToFloat(own.zw);
  vec2 first = vec2(int(own.x) % cells.x, int(own.x) / cells.x);
  // Up and down, front and back, right and left.
  bool flat_ = side < 2;
  bool goesY = side == 3 || side == 5;
  vec2 within = flat_ ? vec2(part.x * row, part.y) : goesY ? vec2(side == 3 ? 1.0 : 0.0, part.x * row) : vec2(part.x * row, side == 4 ? 1.0 : 0.0);
  float height = flat_ ? between.x : mix(between.x, between.y, part.y);
  place = vec3(low + (first + within) * cell, height);
  at = first - 0.5 + (flat_ ? within : goesY ? vec2(0.5, within.y) : vec2(within.x, 0.5));
  face = side == 0 ? vec3(0.0, 0.0, 1.0) : vec3(0.0);
  // Up is lit as the grid is.
  border = side == 0 ? 0.0 : 1.0;
  isGone = 0;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
}
`;

export class Faces {
  readonly drawn: Mesh<InstancedBufferGeometry, RawShaderMaterial>;
  readonly pick: Mesh<InstancedBufferGeometry, RawShaderMaterial>;
  /** What the grid and the cut face must know. */
  readonly own: Record<string, IUniform> = {
    hollowed: { value: null },
    hollows: { value: null },
    hasHollows: { value: false },
    hollowLast: { value: null },
    hollowTint: { value: null },
  };

  /** `part` are the grid's uniforms, and the fragment shaders are its own. */
  constructor(part: Record<string, IUniform>, map: string, fragment: string, pick: string) {
    const make = (fragmentShader: string) => {
      const material = new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader: vertex(map),
        fragmentShader,
        defines: { FACES: 1 },
        uniforms: part,
        side: DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 2,
      });
      const mesh = new Mesh(new InstancedBufferGeometry(), material);
      mesh.frustumCulled = false;
      mesh.visible = false;
      return mesh;
    };
    Object.assign(part, this.own);
    for (const [name, own] of nothing()) this.put(name, own);
    this.drawn = make(fragment);
    this.pick = make(pick);
  }

  /** The move that cut the hollows of each cell last; empty of a part without. */
  lasts = new Uint32Array();

  /** Whether there are any. */
  get some(): boolean {
    return this.own.hasHollows!.value as boolean;
  }

  /** The part at a moment; `cells` along X and along Y. */
  show({ hollows, covered, faces }: Heights, cells: [number, number]): void {
    if (!covered.length && !this.some) return;
    this.own.hasHollows!.value = covered.length > 0;
    this.lasts = new Uint32Array(covered.length);
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("own", new InstancedBufferAttribute(faces, 4));
    geometry.instanceCount = faces.length / 4;
    geometry.setDrawRange(0, 6);
    this.drawn.geometry.dispose();
    this.drawn.geometry = this.pick.geometry = geometry;
    if (!covered.length) {
      for (const [name, own] of nothing()) this.put(name, own);
      return;
    }
    const packed = Uint32Array.from(covered);
    const ends = new Float32Array(2 * ROW * Math.max(1, Math.ceil(hollows.count / ROW)));
    for (let n = 0; n < hollows.count; n += 1) {
      ends.set([hollows.low(n), hollows.high(n)], 2 * n);
      const cell = hollows.cell(n);
      this.lasts[cell] = hollows.last(n);
      const before = packed[cell] as number;
      // Of a cell with more than fifteen the rest is drawn as material.
      if (before < 2) packed[cell] = before + 2 + 32 * n;
      else if (((before >> 1) & 15) < 15) packed[cell] = before + 2;
    }
    this.put("hollowed", new DataTexture(packed, ...cells, RedIntegerFormat, UnsignedIntType));
    this.put("hollowLast", new DataTexture(this.lasts, ...cells, RedIntegerFormat, UnsignedIntType));
    this.put("hollows", new DataTexture(ends, ROW, ends.length / 2 / ROW, RGFormat, FloatType));
  }

  /** As the grid's, of the hollows. */
  setTint(tint: Uint8Array, cells: [number, number]): void {
    this.put("hollowTint", new DataTexture(tint, ...cells, RedFormat, UnsignedByteType));
  }

  /** Takes the place of the texture that was there. */
  private put(name: string, own: DataTexture): void {
    (this.own[name]!.value as DataTexture | null)?.dispose();
    own.minFilter = own.magFilter = NearestFilter;
    own.unpackAlignment = 1;
    own.needsUpdate = true;
    this.own[name]!.value = own;
  }

  setVisible(on: boolean): void {
    this.drawn.visible = this.pick.visible = on && this.some;
  }
}

/** Textures of a part without hollows: a texture that is missing would be of the wrong type for its shader. */
function nothing(): [string, DataTexture][] {
  const integer = () => new DataTexture(new Uint32Array(1), 1, 1, RedIntegerFormat, UnsignedIntType);
  return [
    ["hollowed", integer()],
    ["hollowLast", integer()],
    ["hollows", new DataTexture(new Float32Array(2), 1, 1, RGFormat, FloatType)],
    ["hollowTint", new DataTexture(new Uint8Array(1), 1, 1, RedFormat, UnsignedByteType)],
  ];
}
