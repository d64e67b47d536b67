// The triangles of a part's surface, without a browser: they cover it once, without gaps, and are as near to it as is asked.

import { buildSync } from "esbuild";
import assert from "node:assert/strict";
import test from "node:test";
import { fileURLToPath } from "node:url";

const source = fileURLToPath(new URL("../src/machine/mesh.ts", import.meta.url));
const built = buildSync({ entryPoints: [source], bundle: true, format: "esm", write: false }).outputFiles[0].text;
const { all, few } = await import(`data:text/javascript,${encodeURIComponent(built)}`);

/** A part of so many cells of 0.1 mm, whose heights a function gives by the place of the cell. */
function grid(across, along, stride, heightAt) {
  const heights = Float32Array.from({ length: across * along }, (_, at) => heightAt(at % across, Math.floor(at / across)));
  const points = [across, along].map((cells) => Math.ceil((cells - 1) / stride) + 1);
  return { heights, cells: [across, along], cell: 0.1, bottom: -9, stride, points };
}

/** Place of a point by its number, in points; the rings around are at -1, -2 and beyond the last. */
const placeOf = ({ points: [across] }, number) => [(number % (across + 4)) - 2, Math.floor(number / (across + 4)) - 2];

/** The height at a point. */
function heightOf({ heights, cells, stride }, [x, y]) {
  const cell = (at, count) => Math.min(Math.max(at, 0) * stride, count - 1);
  return heights[cell(y, cells[1]) * cells[0] + cell(x, cells[0])];
}

/** Triangles of the surface and those of the walls, as places. */
function triangles(part, index) {
  const [surface, walls] = [[], []];
  for (let at = 0; at < index.length; at += 3) {
    const corners = [...index.slice(at, at + 3)].map((number) => placeOf(part, number));
    const isWall = corners.some(([x, y]) => x < 0 || y < 0 || x >= part.points[0] || y >= part.points[1]);
    (isWall ? walls : surface).push(corners);
  }
  return { surface, walls };
}

const doubled = ([a, b, c]) => Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));

/** Of each point of the grid, how far the triangle over it is, at most, mm. */
function apart(part, surface) {
  let most = 0;
  const seen = new Set();
  for (const [a, b, c] of surface) {
    const whole = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if (whole === 0) continue;
    const between = (axis) => [Math.min(a[axis], b[axis], c[axis]), Math.max(a[axis], b[axis], c[axis])];
    const [[x0, x1], [y0, y1]] = [between(0), between(1)];
    for (let y = y0; y <= y1; y += 1) {
      for (let x = x0; x <= x1; x += 1) {
        const u = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / whole;
        const v = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / whole;
        if (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9) continue;
        seen.add(y * part.points[0] + x);
        const [ha, hb, hc] = [a, b, c].map((place) => heightOf(part, place));
        const own = heightOf(part, [x, y]);
        const drawn = (1 - u - v) * ha + u * hb + v * hc;
        most = Math.max(most, own === drawn ? 0 : Math.abs(own - drawn));
      }
    }
  }
  assert.equal(seen.size, part.points[0] * part.points[1]);
  return most;
}

/** Each side of a triangle is the side of one other, or lies at the border: a point on another's side would be a gap. */
function hasNoGaps(part, surface) {
  const sides = new Map();
  for (const corners of surface.filter((one) => doubled(one) > 0)) {
    corners.forEach((from, at) => {
      const to = corners[(at + 1) % 3];
      const key = [from, to].map(String).sort().join(" ");
      sides.set(key, (sides.get(key) ?? 0) + 1);
    });
  }
  const [right, top] = part.points.map((points) => points - 1);
  for (const [key, count] of sides) {
    const [[ax, ay], [bx, by]] = key.split(" ").map((place) => place.split(",").map(Number));
    const border = (ax === bx && (ax === 0 || ax === right)) || (ay === by && (ay === 0 || ay === top));
    assert.equal(count, border ? 1 : 2, key);
  }
}

const SHAPES = {
  waves: (x, y) => Math.sin(x / 40) * Math.cos(y / 30),
  pocket: (x, y) => (x > 37 && x < 201 && y > 22 && y < 90 ? -4 : 0),
  steps: (x, y) => Math.floor(x / 7) * 0.3 - Math.floor(y / 11) * 0.2,
  hole: (x, y) => (Math.hypot(x - 120, y - 60) < 30 ? -3e38 : 0.01 * x),
};
const SIZES = [
  [257, 129, 1],
  [300, 200, 2],
  [1000, 70, 4],
  [5, 3, 1],
];
const TOLERANCE = { height: 0.05, slope: 0.04 };

for (const [name, heightAt] of Object.entries(SHAPES)) {
  for (const [across, along, stride] of SIZES) {
    test(`${name}, ${across} by ${along} cells, every ${stride}: near to the part, once, without gaps`, () => {
      const part = grid(across, along, stride, heightAt);
      const { surface } = triangles(part, few(part, TOLERANCE));
      const [wide, high] = part.points.map((points) => points - 1);
      assert.equal(surface.reduce((sum, one) => sum + doubled(one), 0), 2 * wide * high);
      hasNoGaps(part, surface);
      // A step between material and none is one of 3e38 mm.
      assert.ok(apart(part, surface) <= TOLERANCE.height + 1e-6);
    });
  }
}

test("what is even takes few triangles, and all of them are two for each square", () => {
  const part = grid(257, 129, 1, () => -1);
  const { surface, walls } = triangles(part, few(part, TOLERANCE));
  assert.equal(surface.length, 2 * 4 * 2);
  const every = triangles(part, all(part.points));
  assert.equal(every.surface.length, 2 * 256 * 128);
  // Two for each square of a wall.
  assert.deepEqual([walls.length, every.walls.length], [2 * 2 * (256 + 128), 2 * 2 * (256 + 128)]);
});

test("light asks for triangles that height alone does not", () => {
  const part = grid(257, 257, 1, (x) => 0.02 * Math.sin(x / 2));
  const count = (slope) => triangles(part, few(part, { height: 0.5, slope })).surface.length;
  assert.ok(count(0.02) > 10 * count(10), `${count(0.02)} and ${count(10)}`);
});

test("walls meet the surface at each of its points", () => {
  const part = grid(257, 129, 1, (x, y) => Math.sin(x * x + 3 * y * y));
  const { surface, walls } = triangles(part, few(part, { height: 9, slope: 9 }));
  const points = (all) => new Set(all.flat().map(([x, y]) => [Math.min(Math.max(x, 0), 256), Math.min(Math.max(y, 0), 128)].join()));
  const [own, around] = [points(surface), points(walls)];
  assert.equal(around.size, 2 * (256 + 128));
  for (const place of around) assert.ok(own.has(place), place);
});
