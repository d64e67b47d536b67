// A section through the part along an axis: what lies beyond its plane is not drawn, and the cut face is filled. The face is one
// rectangle; each point of it is in the part where the grid that is drawn is higher than it, so that face and part meet.

import {
  BufferGeometry,
  Color,
  DoubleSide,
  GLSL3,
  Mesh,
  RawShaderMaterial,
  Vector4,
  type IUniform,
} from "three";
import type { Cut, Heights } from "../engine/part";
import { HOLLOWS } from "./hollows";
import { MAP } from "./stock";

export type Axis = 0 | 1 | 2;

/** A plane across an axis. */
export interface Section {
  axis: Axis;
  /** mm */
  at: number;
  /** Whether what lies below is taken away, not what lies above. */
  below: boolean;
}

const VERTEX = /* glsl */ `
precision highp float;
precision highp int;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
${MAP}
uniform float top;
/** Number of the axis, and where the plane is. */
uniform int axis;
uniform float plane;
out vec3 place;

void main() {
  int corner = gl_VertexID < 3 ? gl_VertexID : gl_VertexID - 2;
  vec2 side = vec2(corner & 1, corner >> 1);
  vec3 least = vec3(low, bottom);
  vec3 size = vec3(vec2(cells) * cell, top - bottom);
  vec3 share = axis == 0 ? vec3(0.0, side) : axis == 1 ? vec3(side.x, 0.0, side.y) : vec3(side, 0.0);
  place = least + share * size;
  place[axis] = plane;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D heights;
${MAP}
${HOLLOWS}
uniform vec3 face;
uniform vec3 hatch;
uniform float ratio;
in vec3 place;
out vec4 ink;

/** Height of what is drawn; far below where there is nothing, as in a hollow at a height. */
float surface(vec2 at, float height) {
  vec2 grid = clamp((at - low) / cell - 0.5, vec2(0.0), vec2(cells - 1));
  ivec2 own = ivec2(grid + 0.5);
  if (isCovered(own)) return isHollow(own, height) ? -1e30 : texelFetch(heights, own, 0).r;
  ivec2 point = clamp(ivec2(grid / float(stride)), ivec2(0), max(points - 2, ivec2(0)));
  ivec2 first = min(point * stride, cells - 1);
  ivec2 second = min((point + 1) * stride, cells - 1);
  vec2 part = (grid - vec2(first)) / max(vec2(second - first), vec2(1.0));
  float a = texelFetch(heights, first, 0).r;
  float b = texelFetch(heights, ivec2(second.x, first.y), 0).r;
  float c = texelFetch(heights, ivec2(first.x, second.y), 0).r;
  float d = texelFetch(heights, second, 0).r;
  // A triangle is gone where its last corner is.
  if (c < -1e20) return -1e30;
  a = max(a, bottom);
  b = max(b, bottom);
  d = max(d, bottom);
  return part.x + part.y <= 1.0 ? a + (b - a) * part.x + (c - a) * part.y : d + (c - d) * (1.0 - part.x) + (b - d) * (1.0 - part.y);
}

void main() {
  if (surface(place.xy, place.z) < place.z) discard;
  bool line = mod((gl_FragCoord.x + gl_FragCoord.y) / ratio, 9.0) < 1.2;
  ink = vec4(line ? hatch : face, 1.0);
}
`;

/** The cut face. Its textures and cells are those of the part. */
export class CutFace {
  readonly drawn: Mesh<BufferGeometry, RawShaderMaterial>;
  private readonly own: Record<string, IUniform> = {
    top: { value: 0 },
    axis: { value: 0 },
    plane: { value: 0 },
    face: { value: new Color() },
    hatch: { value: new Color() },
  };

  constructor(part: Record<string, IUniform>) {
    const geometry = new BufferGeometry();
    geometry.setDrawRange(0, 6);
    // The part's uniforms are shared as they are: they change with it.
    const uniforms = Object.assign(this.own, part);
    const material = new RawShaderMaterial({ glslVersion: GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, side: DoubleSide });
    this.drawn = new Mesh(geometry, material);
    this.drawn.frustumCulled = false;
    this.drawn.visible = false;
  }

  show(section: Section | undefined, cut: Cut | undefined): void {
    this.drawn.visible = section !== undefined && cut !== undefined;
    if (!section || !cut) return;
    this.own.axis!.value = section.axis;
    this.own.plane!.value = section.at;
    this.own.top!.value = cut.raw.high[2];
  }

  setInks(ink: (name: string) => Color): void {
    this.own.face!.value = ink("--part-face");
    this.own.hatch!.value = ink("--part-hatch");
  }
}

/** What is kept, as the shaders have it: places with `dot(xyz, place) <= w`. */
export function planeOf(section: Section | undefined): Vector4 {
  if (!section) return new Vector4(0, 0, 0, 1);
  const sign = section.below ? -1 : 1;
  const plane = new Vector4(0, 0, 0, section.at * sign);
  plane.setComponent(section.axis, sign);
  return plane;
}

/** Area of the cut face, mm²: of cells in a row, or of those that reach the plane. */
export function areaOf({ axis, at }: Section, { raw }: Cut, { heights, hollows }: Heights): number {
  const [across, along] = raw.cells;
  const floor = raw.low[2];
  let sum = 0;
  if (axis === 2) {
    if (at < floor) return 0;
    for (let cell = 0; cell < heights.length; cell += 1) sum += Number((heights[cell] as number) >= at);
    for (let n = 0; n < hollows.count; n += 1) sum -= Number(hollows.low(n) < at && hollows.high(n) > at);
    return sum * raw.cell * raw.cell;
  }
  const line = Math.floor((at - raw.low[axis]) / raw.cell);
  if (line < 0 || line >= (axis === 0 ? across : along)) return 0;
  const [first, step, count] = axis === 0 ? [line, across, along] : [line * across, 1, across];
  for (let n = 0; n < count; n += 1) {
    const cell = first + n * step;
    sum += Math.max(0, (heights[cell] as number) - floor) - hollows.above(cell, floor);
  }
  return sum * raw.cell;
}
