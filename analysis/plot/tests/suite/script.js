"use strict";
// Tests of the functions of a report's script that need no page. Arguments: the folder of the script,
// the data of a report.
const assert = require("node:assert");
const { execFileSync } = require("node:child_process");
const path = require("node:path");
const [, , folder, text] = process.argv;
for (const file of ["reading.js", "page.js"]) execFileSync(process.execPath, ["--check", path.join(folder, file)]);
const ncc = require(path.join(folder, "reading.js"));

const program = ncc.readProgram(JSON.parse(text).programs[0]);
const { way } = program;
assert.deepStrictEqual(ncc.placeAt(way, 9.5, 0), [0, 20, 5]);
const middle = ncc.placeAt(way, 11.5, 0);
assert.ok(Math.abs(middle[0] - 20) < 1e-6 && Math.abs(middle[2] - 2) < 1e-6);
assert.strictEqual(way.first[ncc.legAt(way, 11.5)], 4);
assert.strictEqual(ncc.valueAt(program.speed, 8.999), 0);
assert.strictEqual(ncc.valueAt(program.speed, 9), 1263);
// From a block to its legs, from there to its time, and back to the block.
const legs = ncc.legsOf(way, [5, 5]);
assert.strictEqual(legs.length, 128);
const times = ncc.timesOf(way, legs, 0);
assert.strictEqual(times.length, 1);
assert.ok(Math.abs(times[0][0] - 13.5) < 1e-3 && Math.abs(times[0][1] - 19.5) < 1e-3);
assert.strictEqual(way.last[ncc.legAt(way, 15)], 5);
assert.strictEqual(program.source.lines[4], "(</script><b>&amp;\"'<!--)");
assert.deepStrictEqual(ncc.legsOf(way, [99, 99]), []);

assert.deepStrictEqual(ncc.rows({ total: 9, numbers: [2, 3, 7], lines: ["a", "b", "c"] }), [
  { gap: 1 }, { line: 2, text: "a" }, { line: 3, text: "b" }, { gap: 3 }, { line: 7, text: "c" }, { gap: 2 },
]);
assert.deepStrictEqual(ncc.marks(-108, 108, 6), [[-100, -50, 0, 50, 100], 50]);
assert.strictEqual(ncc.clockMarks(0, 7300, 10)[1], 900);
assert.strictEqual(ncc.clock(3723, 60, 7300), "1:02:03");
assert.strictEqual(ncc.number(-15000.25, 0.01), "\u221215\u202f000.25");
assert.deepStrictEqual(ncc.distance([1, 1], [0, 0], [2, 0]), [1, 0.5]);
const empty = { way: { start: null, kinds: "", ends: [], first: [], last: [] } };
assert.strictEqual(ncc.placeAt(empty.way, 1, 0), null);
assert.strictEqual(ncc.legAt(empty.way, 1), -1);
assert.strictEqual(ncc.valueAt({ t: [], v: [] }, 1), null);
