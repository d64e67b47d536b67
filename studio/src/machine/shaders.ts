// The moves drawn without a vertex: each vertex pulls its move out of a texture by its number. A move is three texels:
// start and kind, end and line, then tool, feed and the moment when it begins. To show another moment changes two numbers.

export const TEXELS = 3;
/** Moves in a row of the texture, and in one texture. */
export const ROW = 1024;
export const CHUNK = ROW * 1024;

const HEAD = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
`;

export const VERTEX = /* glsl */ `${HEAD}
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform sampler2D moves;
/** Number of the first move of this texture, and of the move that is under way. */
uniform int base;
uniform int now;
/** Pixels of the picture, and width of a line in them; 0 draws lines of the device. */
uniform vec2 size;
uniform float width;
/** First and last marked line. */
uniform vec2 marked;
/** Bits of the kinds that are shown. */
uniform int shown;
uniform int future;

out float along;
out float pixels;
flat out int kind;
flat out int number;
flat out int isMarked;
flat out vec4 more;
flat out float depth;

void main() {
  int corners = width > 0.0 ? 6 : 2;
  int own = gl_VertexID / corners;
  int corner = gl_VertexID - own * corners;
  int x = (own % ${ROW}) * ${TEXELS};
  int y = own / ${ROW};
  vec4 from = texelFetch(moves, ivec2(x, y), 0);
  vec4 to = texelFetch(moves, ivec2(x + 1, y), 0);
  more = texelFetch(moves, ivec2(x + 2, y), 0);
  kind = int(from.w);
  number = base + own;
  isMarked = int(to.w >= marked.x && to.w <= marked.y);
  depth = to.z;
  bool hidden = (shown & (1 << (kind & 3))) == 0 || (future == 0 && number > now);
  vec4 a = projectionMatrix * modelViewMatrix * vec4(from.xyz, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(to.xyz, 1.0);
  vec2 way = (b.xy - a.xy) * size * 0.5;
  pixels = length(way);
  bool ahead = corners == 2 ? corner == 1 : corner == 1 || corner == 2 || corner == 4;
  along = ahead ? 1.0 : 0.0;
  gl_Position = ahead ? b : a;
  if (width > 0.0) {
    vec2 side = pixels > 0.001 ? vec2(-way.y, way.x) / pixels : vec2(0.0, 1.0);
    vec2 end = pixels > 0.001 ? way / pixels * (ahead ? 0.5 : -0.5) : vec2(ahead ? 0.5 : -0.5, 0.0);
    float half_ = (isMarked == 1 ? width * 1.9 : width) * 0.5;
    bool left = corner == 2 || corner == 4 || corner == 5;
    gl_Position.xy += (side * (left ? half_ : -half_) + end * half_) * 2.0 / size;
  }
  if (isMarked == 1) gl_Position.z -= 0.002;
  if (number > now) gl_Position.z += 0.001;
  if (hidden) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
`;

const VARYINGS = /* glsl */ `${HEAD}
in float along;
in float pixels;
flat in int kind;
flat in int number;
flat in int isMarked;
flat in vec4 more;
flat in float depth;
uniform int now;
uniform float share;
uniform float width;
out vec4 ink;
`;

export const FRAGMENT = /* glsl */ `${VARYINGS}
uniform vec3 kinds[4];
uniform vec3 tools[8];
uniform vec3 mark;
uniform vec3 ground;
/** 0 by kind, 1 by tool, 2 by feed, 3 by depth. */
uniform int colouring;
/** Least and greatest feed, then height. */
uniform vec4 range;

/** Blue, green, yellow, red: light enough for both grounds. */
vec3 scale(float at) {
  float x = clamp(at, 0.0, 1.0) * 3.0;
  vec3 a = vec3(0.23, 0.44, 0.88);
  vec3 b = vec3(0.15, 0.67, 0.52);
  vec3 c = vec3(0.90, 0.68, 0.18);
  vec3 d = vec3(0.84, 0.29, 0.25);
  return x < 1.0 ? mix(a, b, x) : x < 2.0 ? mix(b, c, x - 1.0) : mix(c, d, x - 2.0);
}

void main() {
  // Rapid moves are dashed.
  bool rapid = kind == 0 || kind == 4;
  if (rapid && isMarked == 0 && mod(along * pixels, 9.0) > 5.5 && pixels > 9.0) discard;
  vec3 own = kinds[kind & 3];
  if (colouring == 1) own = tools[int(more.x) & 7];
  if (colouring == 2 && !rapid) own = scale((more.y - range.x) / max(range.y - range.x, 1e-6));
  if (colouring == 3) own = scale((depth - range.z) / max(range.w - range.z, 1e-6));
  if (isMarked == 1) own = mark;
  bool done = number < now || (number == now && along <= share);
  float faint = done || isMarked == 1 ? 0.0 : 0.72;
  // A rapid move says less than a cut.
  if (rapid && done && isMarked == 0) faint = 0.25;
  ink = vec4(mix(own, ground, faint), 1.0);
}
`;

/** The number of the move as a colour; black is none. */
export const PICK = /* glsl */ `${VARYINGS}
void main() {
  int id = number + 1;
  ink = vec4(float(id & 255), float((id >> 8) & 255), float((id >> 16) & 255), 255.0) / 255.0;
}
`;
