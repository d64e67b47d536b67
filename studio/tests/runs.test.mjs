// Moves merged into lines: each point is near its line, and what must not be merged is not.

import assert from "node:assert/strict";
import { before, test } from "node:test";
import { build } from "esbuild";
import { fileURLToPath } from "node:url";

let runsOf, evenly, Paths;
before(async () => {
  const resolveDir = fileURLToPath(new URL("../src/machine", import.meta.url));
  const stdin = { contents: 'export * from "./runs"; export { Paths } from "./paths";', resolveDir };
  const { outputFiles } = await build({ stdin, bundle: true, format: "esm", write: false });
  ({ runsOf, evenly, Paths } = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`));
});

/** A path through points, a second a piece; `change` may make its pieces others. */
function through(points, change = () => {}) {
  const pieces = points.length - 1;
  const column = (axis, from) => Float32Array.from({ length: pieces }, (_, at) => points[at + from][axis]);
  const [x0, y0, z0, x1, y1, z1] = [0, 1].flatMap((from) => [0, 1, 2].map((axis) => column(axis, from)));
  const path = { pieces, x0, y0, z0, x1, y1, z1, seconds: pieces * 100, t0: Float64Array.from({ length: pieces }, (_, at) => at) };
  Object.assign(path, { kind: new Uint8Array(pieces).fill(1), tool: new Uint16Array(pieces), feed: new Float32Array(pieces).fill(500) });
  change(path);
  return path;
}

const straight = (count) => Array.from({ length: count + 1 }, (_, at) => [at, 0, 0]);
const list = (...given) => [...runsOf(...given)];

/** How far a point is from a line that ends, by trying places on it. */
function away(point, from, to) {
  const far = (share) => Math.hypot(...point.map((value, axis) => value - from[axis] - (to[axis] - from[axis]) * share));
  let [low, high] = [0, 1];
  for (let tries = 0; tries < 60; tries += 1) {
    const [a, b] = [low + (high - low) / 3, high - (high - low) / 3];
    if (far(a) < far(b)) high = b;
    else low = a;
  }
  return Math.min(far(0), far(1), far((low + high) / 2));
}

test("each point of a move is within the tolerance of the line that stands for it, and each move is in one line", () => {
  let seed = 7;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647 - 0.5;
  const shapes = {
    walk: (at, last) => last.map((value) => value + random() * 0.3),
    spiral: (at) => [Math.cos(at / 20) * (5 + at / 90), Math.sin(at / 20) * (5 + at / 90), Math.sin(at / 300)],
    rows: (at) => [Math.floor(at / 50) % 2 ? 50 - (at % 50) : at % 50, Math.floor(at / 50) / 5, Math.sin(at / 9) / 8],
  };
  for (const [name, shape] of Object.entries(shapes)) {
    const points = [[0, 0, 0]];
    for (let at = 1; at <= 4000; at += 1) points.push(shape(at, points.at(-1)));
    const path = through(points);
    for (const tolerance of [0.02, 0.2, 2]) {
      const firsts = list(path, tolerance);
      assert.equal(firsts[0], 0);
      assert.ok(firsts.every((first, at) => at === 0 || first > firsts[at - 1]), name);
      assert.ok(firsts.at(-1) < path.pieces);
      if (tolerance > 0.1) assert.ok(firsts.length < path.pieces / 2, `${name}: ${firsts.length} lines`);
      for (const [at, first] of firsts.entries()) {
        const end = (firsts[at + 1] ?? path.pieces) - 1;
        const from = [path.x0[first], path.y0[first], path.z0[first]];
        const to = [path.x1[end], path.y1[end], path.z1[end]];
        for (let piece = first; piece <= end; piece += 1) {
          const far = away([path.x1[piece], path.y1[piece], path.z1[piece]], from, to);
          assert.ok(far <= tolerance * (1 + 1e-6) + 1e-6, `${name}: ${far} mm at ${piece}, not ${tolerance}`);
        }
      }
    }
  }
});

test("a straight way is few lines, and one there and back is never one", () => {
  assert.deepEqual(list(through(straight(200)), 0.01), [0]);
  const long = list(through(straight(2000)), 0.01);
  assert.ok(long.length < 10 && long.length > 1, String(long));
  assert.deepEqual(list(through([[0, 0, 0], [10, 0, 0], [0, 0, 0]]), 0.5), [0, 1]);
  assert.deepEqual(list(through([[0, 0, 0], [5, 0, 0], [10, 0, 0], [7, 0, 0], [4, 0, 0]]), 0.5), [0, 2]);
  assert.deepEqual(list(through([[0, 0, 0], [0, 0, -5], [0, 0, 5]]), 0.5), [0, 1]);
});

test("another kind, tool or feed, a gap, and a long time begin another line", () => {
  const changes = {
    kind: (path) => path.kind.fill(3, 40),
    tool: (path) => path.tool.fill(2, 40),
    feed: (path) => path.feed.fill(501, 40),
    gap: (path) => (path.z0[40] = 1e-3),
    unknown: (path) => (path.z0[40] = path.z1[39] = NaN),
  };
  for (const [name, change] of Object.entries(changes)) assert.ok(list(through(straight(100), change), 0.5).includes(40), name);
  assert.deepEqual(list(through(straight(100), changes.feed), 0.5), [0, 40]);
  assert.deepEqual(list(through(straight(100), changes.feed), 0.5, Infinity, 1), [0]);
  const slow = list(through(straight(128), (path) => (path.seconds = 128)), 0.5);
  assert.ok(slow.length >= 32, `${slow.length} lines, of which each would be a long time`);
});

test("without a tolerance each move is a line, and more lines than wanted are none", () => {
  const path = through(straight(100));
  assert.deepEqual(list(path, 0), Array.from({ length: 100 }, (_, at) => at));
  assert.equal(runsOf(path, 0, 99), undefined);
  assert.equal(runsOf(path, 0, 100).length, 100);
  assert.deepEqual([...evenly(7, 3)], [0, 3, 6]);
});

test("lines are made anew for a nearer eye, few of them, and none where each move is to have its own", () => {
  const paths = new Paths();
  // Rows of waves, whose bends are many.
  const waves = through(Array.from({ length: 200_001 }, (_, at) => [(at % 2000) / 10, Math.floor(at / 2000) + Math.sin(at / 7), 0]));
  const box = { low: [0, -1, 0], high: [200, 101, 0] };
  const lines = () => paths.drawn.children[0].children.reduce((sum, mesh) => sum + mesh.geometry.drawRange.count / 6, 0);
  const path = { ...waves, box, line: Uint32Array.from({ length: waves.pieces }, (_, at) => Math.floor(at / 3)) };
  paths.set(path, true, false);
  assert.equal(paths.see(0.4), true);
  const far = lines();
  assert.ok(far > 1000 && far <= 40_000, String(far));
  assert.equal(paths.fineness, 1);
  for (let at = 0; at < far; at += 40) {
    const [first, last] = paths.piecesOf(at);
    const [from, to] = [[path.x0[first], path.y0[first], 0], [path.x1[last], path.y1[last], 0]];
    for (let piece = first; piece <= last; piece += 1) assert.ok(away([path.x1[piece], path.y1[piece], 0], from, to) < 0.201, "half a pixel");
  }
  assert.equal(paths.coarser(), false);
  assert.equal(paths.see(0.3), false);
  assert.equal(paths.see(0.1), true);
  assert.ok(lines() > far);
  // Each move is far from the next one in such a picture.
  assert.equal(paths.see(1e-4), true);
  assert.ok(lines() <= 40_000 && paths.fineness > 1, `${lines()} lines, ${paths.fineness}`);
  // A path like it is as fine, at once, from wherever the eye is.
  const { fineness } = paths;
  paths.set(path, false, true);
  assert.equal(lines(), 0);
  assert.equal(paths.see(1e-4), true);
  assert.equal(paths.fineness, fineness);
  for (let tries = 0; paths.finer(); tries += 1) {
    const before = lines();
    assert.ok(tries < 5 && paths.see(1e-4));
    assert.ok(lines() >= before);
  }
  assert.equal(lines(), path.pieces);
  assert.equal(paths.fineness, 0);
  assert.equal(paths.see(1e-5), false);
  assert.equal(paths.coarser(), true);
  assert.ok(paths.see(0.4) && lines() === far);
});

test("what is done ends where the tool is on a line of several moves, and marked moves are lines of their own", () => {
  const paths = new Paths();
  const long = straight(6000).map(([x]) => [x < 3000 ? x : 3000 + (x - 3000) / 10, 0, 0]);
  const path = { ...through(long), box: { low: [0, 0, 0], high: [3300, 0, 0] } };
  path.line = Uint32Array.from({ length: path.pieces }, (_, at) => 1 + (at % 2000));
  paths.setNow(2900, 0.5);
  paths.set(path, true, false);
  paths.see(0.5);
  const { now, share, until } = paths.drawn.children[0].children[0].material.uniforms;
  const [first, last] = paths.piecesOf(now.value);
  assert.ok(first <= 2900 && last >= 2900 && last > first);
  const place = (along) => path.x0[first] + along * (path.x1[last] - path.x0[first]);
  assert.ok(Math.abs(place(share.value) - 2900.5) < 0.01, String(place(share.value)));
  assert.ok(Math.abs(place(until.value) - 2901) < 0.01);
  paths.setMarked(7, 8);
  const [marked] = paths.drawn.children[1].children;
  assert.equal(marked.geometry.drawRange.count / 6, 6);
  const { data } = marked.material.uniforms.moves.value.image;
  assert.deepEqual([0, 1, 2, 3].map((at) => data[at * 8]), [6, 7, 2006, 2007]);
  assert.equal(marked.material.uniforms.now.value, 3);
  paths.setMarked(-1, -1);
  assert.equal(paths.drawn.children[1].children.length, 0);
});
