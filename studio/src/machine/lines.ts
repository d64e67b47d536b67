// Straight lines around the part, a pixel of the page wide. Those of the device are a pixel of its own: of a picture with several
// of them in one of the page little of a line would be left.

import { Color, DoubleSide, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, RawShaderMaterial, Vector2 } from "three";

const VERTEX = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
/** The picture, in pixels of the page. */
uniform vec2 size;
in vec3 from;
in vec3 to;
/** Its colour; mm of a dash and of what follows it, which is open, 0 for none. */
in vec4 look;
/** mm from the beginning of the line. */
out float along;
flat out vec4 shown;

void main() {
  bool ahead = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  bool left = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
  vec4 a = projectionMatrix * modelViewMatrix * vec4(from, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(to, 1.0);
  vec2 way = (b.xy - a.xy) * size;
  float far = length(way);
  vec2 side = far > 0.001 ? vec2(-way.y, way.x) / far : vec2(0.0, 1.0);
  along = ahead ? distance(from, to) : 0.0;
  shown = look;
  gl_Position = ahead ? b : a;
  gl_Position.xy += side * (left ? 1.0 : -1.0) / size;
}
`;

const FRAGMENT = /* glsl */ `
precision highp float;
in float along;
flat in vec4 shown;
out vec4 ink;

void main() {
  float dash = shown.a;
  if (dash > 0.0 && mod(along, 1.7 * dash) > dash) discard;
  ink = vec4(shown.rgb, 1.0);
}
`;

/** One for all lines, and one for those that nothing hides: to compile shaders takes longer than a picture. */
const [PLAIN, OVER] = [true, false].map((depthTest) => {
  const uniforms = { size: { value: new Vector2() } };
  return new RawShaderMaterial({ glslVersion: GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, side: DoubleSide, depthTest });
}) as [RawShaderMaterial, RawShaderMaterial];

/** Lines between pairs of points, six numbers each; where `dash` is given, each begins with a dash of so many mm. */
export function linesOf(points: number[], color: Color, { dash = 0, over = false } = {}): Mesh<InstancedBufferGeometry> {
  const count = points.length / 6;
  const ends = (first: number) => Float32Array.from(points.filter((_, at) => Math.floor(at / 3) % 2 === first));
  const { r, g, b } = color.clone().convertLinearToSRGB();
  const look = Float32Array.from({ length: 4 * count }, (_, at) => [r, g, b, dash][at % 4] as number);
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute("from", new InstancedBufferAttribute(ends(0), 3));
  geometry.setAttribute("to", new InstancedBufferAttribute(ends(1), 3));
  geometry.setAttribute("look", new InstancedBufferAttribute(look, 4));
  geometry.instanceCount = count;
  geometry.setDrawRange(0, 6);
  const made = new Mesh(geometry, over ? OVER : PLAIN);
  // Its points are none of those that a box is made of.
  made.frustumCulled = false;
  return made;
}

/** The next picture has so many pixels of the page. */
export function setLinesSize(width: number, height: number): void {
  for (const material of [PLAIN, OVER]) material.uniforms.size!.value.set(width, height);
}

/** Whether a material is that of lines, which stays for the next ones. */
export function isOfLines(material: object): boolean {
  return material === PLAIN || material === OVER;
}
