// Lines drawn without a vertex: each vertex pulls its line, a move or several, out of a texture by its number. A line is two texels:
// start and what `look` of the paths packs, then end and feed. To show another moment changes three numbers.

export const TEXELS = 2;
/** Lines in a row of the texture, and in one texture. */
export const ROW = 1024;
export const CHUNK = ROW * 1024;
/** So many moments of a path have colours of their own. */
export const MOMENTS = 8191;

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
/** Number of the first line of this texture, and the line that is under way. */
uniform int base;
uniform int now;
/** How much of the line under way is done, and how much of it will be after the move under way. */
uniform float share;
uniform float until;
/** Pixels of the picture, and width of a line in them; 0 draws lines of the device. */
uniform vec2 size;
uniform float width;
/** Whether these are the marked lines. */
uniform int marked;
/** Bits of the kinds that are shown. */
uniform int shown;
uniform int future;
uniform vec3 kinds[4];
uniform vec3 tools[8];
uniform vec3 mark;
/** As COLOURINGS of the paths have it. */
uniform int colouring;
/** Least and greatest feed, then height. */
uniform vec4 range;
${SCALE}

out float along;
out float dash;
out float height;
out vec3 place;
flat out int number;
flat out vec3 tone;
flat out vec2 ends;
flat out vec2 faint;

void main() {
  int corners = width > 0.0 ? 6 : 2;
  int own = gl_VertexID / corners;
  int corner = gl_VertexID - own * corners;
  int x = (own % ${ROW}) * ${TEXELS};
  int y = own / ${ROW};
  vec4 from = texelFetch(moves, ivec2(x, y), 0);
  vec4 to = texelFetch(moves, ivec2(x + 1, y), 0);
  int look = int(from.w);
  int kind = look & 7;
  bool rapid = kind == 0 || kind == 4;
  number = base + own;
  tone = kinds[kind & 3];
  if (colouring == 1) tone = tools[(look >> 4) & 7];
  if (colouring == 2) tone = tools[(look >> 7) & 7];
  if (colouring == 3 && !rapid) tone = scale((to.w - range.x) / max(range.y - range.x, 1e-6));
  if (colouring == 5) tone = scale(float(look >> 10) / ${MOMENTS}.0);
  if (marked == 1) tone = mark;
  bool hidden = (shown & (1 << (kind & 3))) == 0 || (future == 0 && number > now);
  vec4 a = projectionMatrix * modelViewMatrix * vec4(from.xyz, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(to.xyz, 1.0);
  vec2 way = (b.xy - a.xy) * size * 0.5;
  float pixels = length(way);
  bool ahead = corners == 2 ? corner == 1 : corner == 1 || corner == 2 || corner == 4;
  along = ahead ? 1.0 : 0.0;
  place = ahead ? to.xyz : from.xyz;
  // One move has the colour of its end, several have those of all heights on their way.
  height = (look & 8) == 0 ? to.z : place.z;
  // Rapid moves are dashed.
  dash = rapid && marked == 0 && pixels > 9.0 ? along * pixels : 0.0;
  float passed = float(now - number);
  ends = vec2(passed + share, future == 0 ? passed + until : 1.0);
  // A rapid move says less than a cut.
  faint = marked == 1 ? vec2(0.0) : vec2(rapid ? 0.25 : 0.0, 0.72);
  gl_Position = ahead ? b : a;
  if (width > 0.0) {
    vec2 side = pixels > 0.001 ? vec2(-way.y, way.x) / pixels : vec2(0.0, 1.0);
    vec2 end = pixels > 0.001 ? way / pixels * (ahead ? 0.5 : -0.5) : vec2(ahead ? 0.5 : -0.5, 0.0);
    float half_ = width * 0.5;
    bool left = corner == 2 || corner == 4 || corner == 5;
    gl_Position.xy += (side * (left ? half_ : -half_) + end * half_) * 2.0 / size;
  }
  if (marked == 1) gl_Position.z -= 0.002;
  if (number > now) gl_Position.z += 0.001;
  if (hidden) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
`;

/** Graphics by software take as long for what is done at each pixel as for all the rest: a picture with a section, or colours by height,
 * defines it. */
const VARYINGS = /* glsl */ `${HEAD}
in float along;
in float dash;
in float height;
in vec3 place;
flat in int number;
flat in vec3 tone;
/** How much of the line is done, and how much is shown. */
flat in vec2 ends;
/** How much of the ground shows through what is done, and through the rest. */
flat in vec2 faint;
/** A section keeps what lies below its plane: a direction, and how far along it. */
uniform vec4 section;
out vec4 ink;

bool isHidden() {
#ifdef SECTION
  if (dot(section.xyz, place) > section.w) return true;
#endif
  return along > ends.y;
}
`;

export const FRAGMENT = /* glsl */ `${VARYINGS}
uniform vec3 ground;
uniform vec4 range;
uniform int marked;
${SCALE}
void main() {
  if (isHidden() || mod(dash, 9.0) > 5.5) discard;
  vec3 own = tone;
#ifdef DEPTH
  if (marked == 0) own = scale((height - range.z) / max(range.w - range.z, 1e-6));
#endif
  ink = vec4(mix(own, ground, along > ends.x ? faint.y : faint.x), 1.0);
}
`;

/** The number of the line as a colour; black is none. */
export const PICK = /* glsl */ `${VARYINGS}
void main() {
  if (isHidden()) discard;
  int id = number + 1;
  ink = vec4(float(id & 255), float((id >> 8) & 255), float((id >> 16) & 255), 255.0) / 255.0;
}
`;
