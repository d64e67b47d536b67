// Straight lines around the part, a pixel of the page wide. Those of the device are a pixel of its own: of a picture with several
// of them in one of the page little of a line would be left.

import { Color, DoubleSide, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, RawShaderMaterial, Vector2, Vector4 } from "three";

const VERTEX = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
/** The picture, in pixels of the page. */
uniform vec2 size;
in vec3 from;
in vec3 to;
/** mm from the beginning of the line. */
out float along;

void main() {
  bool ahead = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  bool left = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
  vec4 a = projectionMatrix * modelViewMatrix * vec4(from, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(to, 1.0);
  vec2 way = (b.xy - a.xy) * size;
  float far = length(way);
  vec2 side = far > 0.001 ? vec2(-way.y, way.x) / far : vec2(0.0, 1.0);
  along = ahead ? distance(from, to) : 0.0;
  gl_Position = ahead ? b : a;
  gl_Position.xy += side * (left ? 1.0 : -1.0) / size;
}
`;

const FRAGMENT = /* glsl */ `
precision highp float;
uniform vec3 tone;
/** mm of a dash and of what follows it, which is open; 0 for none. */
uniform float dash;
in float along;
out vec4 ink;

void main() {
  if (dash > 0.0 && mod(along, 1.7 * dash) > dash) discard;
  ink = vec4(tone, 1.0);
}
`;

/** Lines between pairs of points, six numbers each; where `dash` is given, each begins with a dash of so many mm. */
export function linesOf(points: number[], color: Color, dash = 0): Mesh<InstancedBufferGeometry, RawShaderMaterial> {
  const ends = (first: number) => new InstancedBufferAttribute(Float32Array.from(points.filter((_, at) => Math.floor(at / 3) % 2 === first)), 3);
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute("from", ends(0));
  geometry.setAttribute("to", ends(1));
  geometry.instanceCount = points.length / 6;
  geometry.setDrawRange(0, 6);
  const size = new Vector2();
  const uniforms = { size: { value: size }, tone: { value: color.clone().convertLinearToSRGB() }, dash: { value: dash } };
  const material = new RawShaderMaterial({ glslVersion: GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, side: DoubleSide });
  const made = new Mesh(geometry, material);
  // Its points are none of those that a box is made of.
  made.frustumCulled = false;
  const viewport = new Vector4();
  made.onBeforeRender = (renderer) => {
    renderer.getViewport(viewport);
    size.set(viewport.z, viewport.w);
  };
  return made;
}
