// The moves drawn without a vertex: each vertex pulls its move out of a texture by its number. A move is three texels:
// start and kind, end and line, then tool, feed, the moment when it begins, and the operation. To show another moment changes two numbers.

export const TEXELS = 3;
/** Moves in a row of the texture, and in one texture. */
export const ROW = 1024;
export const CHUNK = ROW * 1024;

const HEAD = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
`;

/** Least to greatest by four colours, light enough for both grounds; the page's legend has the same. */
export const SCALE = /* glsl */ `
uniform vec3 scales[4];
vec3 scale(float at) {
  float x = clamp(at, 0.0, 1.0) * 3.0;
  return x < 1.0 ? mix(scales[0], scales[1], x) : x < 2.0 ? mix(scales[1], scales[2], x - 1.0) : mix(scales[2], scales[3], x - 2.0);
}
`;

export const VERTEX = /* glsl */ `${HEAD}
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform sampler2D moves;
/** Number of the first move of this texture, how many it has, and the move that is under way. */
uniform int base;
uniform int count;
uniform int now;
/** A line stands for so many moves: one, or more on a device that draws slowly. */
uniform int every;
/** Pixels of the picture, and width of a line in them; 0 draws lines of the device. */
uniform vec2 size;
uniform float width;
/** First and last marked line. */
uniform vec2 marked;
/** Bits of the kinds that are shown. */
uniform int shown;
uniform int future;
uniform vec3 kinds[4];
uniform vec3 tools[8];
uniform vec3 mark;
/** As COLOURINGS of the paths have it. */
uniform int colouring;
/** Least and greatest feed, then height; and the seconds of all moves. */
uniform vec4 range;
uniform float seconds;
${SCALE}

out float along;
out float pixels;
out vec3 place;
flat out int number;
flat out int isRapid;
flat out int isMarked;
flat out vec3 tone;

void main() {
  int corners = width > 0.0 ? 6 : 2;
  int own = gl_VertexID / corners;
  int corner = gl_VertexID - own * corners;
  own *= every;
  int last = min(own + every, count) - 1;
  int x = (own % ${ROW}) * ${TEXELS};
  int y = own / ${ROW};
  vec4 from = texelFetch(moves, ivec2(x, y), 0);
  vec4 to = texelFetch(moves, ivec2((last % ${ROW}) * ${TEXELS} + 1, last / ${ROW}), 0);
  vec4 more = texelFetch(moves, ivec2(x + 2, y), 0);
  float line = every == 1 ? to.w : texelFetch(moves, ivec2(x + 1, y), 0).w;
  int kind = int(from.w);
  bool rapid = kind == 0 || kind == 4;
  isRapid = int(rapid);
  number = base + own;
  isMarked = int(to.w >= marked.x && line <= marked.y);
  tone = kinds[kind & 3];
  if (colouring == 1) tone = tools[int(more.x) & 7];
  if (colouring == 2) tone = tools[int(more.w) & 7];
  if (colouring == 3 && !rapid) tone = scale((more.y - range.x) / max(range.y - range.x, 1e-6));
  if (colouring == 4) tone = scale((to.z - range.z) / max(range.w - range.z, 1e-6));
  if (colouring == 5) tone = scale(more.z / max(seconds, 1e-6));
  if (isMarked == 1) tone = mark;
  bool hidden = (shown & (1 << (kind & 3))) == 0 || (future == 0 && number > now);
  vec4 a = projectionMatrix * modelViewMatrix * vec4(from.xyz, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(to.xyz, 1.0);
  vec2 way = (b.xy - a.xy) * size * 0.5;
  pixels = length(way);
  bool ahead = corners == 2 ? corner == 1 : corner == 1 || corner == 2 || corner == 4;
  along = ahead ? 1.0 : 0.0;
  place = ahead ? to.xyz : from.xyz;
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
in vec3 place;
flat in int number;
flat in int isRapid;
flat in int isMarked;
flat in vec3 tone;
uniform int now;
uniform int every;
uniform float share;
uniform float width;
/** A section keeps what lies below its plane: a direction, and how far along it. */
uniform vec4 section;
out vec4 ink;
`;

export const FRAGMENT = /* glsl */ `${VARYINGS}
uniform vec3 ground;
void main() {
  if (dot(section.xyz, place) > section.w) discard;
  bool plain = isMarked == 0;
  // Rapid moves are dashed.
  if (isRapid == 1 && plain && mod(along * pixels, 9.0) > 5.5 && pixels > 9.0) discard;
  bool done = along * float(every) <= float(now - number) + share;
  float faint = done || !plain ? 0.0 : 0.72;
  // A rapid move says less than a cut.
  if (isRapid == 1 && done && plain) faint = 0.25;
  ink = vec4(mix(tone, ground, faint), 1.0);
}
`;

/** The number of the move as a colour; black is none. */
export const PICK = /* glsl */ `${VARYINGS}
void main() {
  if (dot(section.xyz, place) > section.w) discard;
  int id = number + 1;
  ink = vec4(float(id & 255), float((id >> 8) & 255), float((id >> 16) & 255), 255.0) / 255.0;
}
`;
