// Figures of the page, measured in headless Chromium that draws by software: `.ci/figures` runs it.
//
//   NCC=BINARY STUDIO_SITE=FOLDER CHROMIUM=BROWSER node studio/tests/figures.mjs [RUNS]
//
// Both hosts of the engine are measured in turn, in worlds without a cache; files come from this machine, so that no figure has
// the time of a network in it. A figure is printed, with a `>` where it is over what is asked, and fails nothing; one that could
// not be measured does. Each measurement looks at what the page shows: a page that failed, or shows another program, has none.

import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { NCC, studio } from "./binary.mjs";
import { begin, drawn, open, ready } from "./browser.mjs";

const RUNS = Number(process.argv[2] ?? 5);
/** The large program takes longer. */
const LARGE_RUNS = Math.min(RUNS, 3);
/** How long a picture is waited for, ms. */
const LONGEST = 120_000;
/** Where seeks lead, in parts of the program's time: near and far, forwards and back. */
const SEEKS = [0.9, 0.5, 0.51, 0.1, 0.75, 0.74, 0.3, 0.95];

const HOSTS = [...(process.env.STUDIO_SITE ? ["worker"] : []), ...(NCC ? ["loopback"] : [])];
const TITLES = { worker: "static page", loopback: "ncc studio" };

/** Figures in the order of the table: a name, the most that is asked, a unit with digits, and the values by host. */
const figures = [];
function figure(name, asked, unit, digits = 2) {
  const made = { name, asked, unit, digits, values: { worker: [], loopback: [] } };
  figures.push(made);
  return made;
}
const bundle = figure("static bundle, gzip -9", 3.5, "MB");
const paint = figure("first paint", 1, "s");
const engine = figure("engine ready", 1.5, "s");
const first = figure("first program drawn", undefined, "s");
/** Until a part is drawn, and how much of that until the page has it: the rest is the time of drawing by software. */
const both = (name, asked, unit, digits) => [figure(name, asked, unit, digits), figure("  until the page has the part", undefined, unit, digits)];
const SIZES = [
  { lines: 1_000, opened: both("1,000 lines opened", undefined, "s"), redrawn: both("1,000 lines redrawn after a key", 0.5, "s") },
  { lines: 60_143, opened: both("60,143 lines opened", 2, "s"), redrawn: both("60,143 lines redrawn after a key", 2, "s") },
];
const large = both("1,000,000 moves opened, timed, cut", 10, "s");
const seek = both("1,000,000 moves, a seek", 100, "ms", 0);
const moves = figure("a move in the page's arrays", 60, "bytes", 1);
const all = figure("a move in all of the page's memory", undefined, "bytes", 1);

const HEAD = ["%", "O0103", "G21 G17 G90 G94 G40 G49 G80", "T1 M6 (BALL D=6.)", "G54 G0 X0. Y0. S9000 M3", "G43 H1 Z10."];
const TAIL = ["G0 Z10.", "M5", "M30", "%"];
/** Moves that are none of surfacing: to its first place and height, and away. */
const AROUND = 2;

/** A program of surfacing with so many short feed moves, to and fro over a wavy square of 100 mm. */
function surface(count) {
  const lines = [...HEAD];
  const wide = Math.ceil(Math.sqrt(count));
  const rows = Math.ceil(count / wide);
  for (let at = 0; at < count; at += 1) {
    const [row, step] = [Math.floor(at / wide), at % wide];
    const x = (100 * (row % 2 ? wide - 1 - step : step)) / (wide - 1);
    const y = (100 * row) / (rows - 1);
    const z = -3 + Math.sin(x / 9) * Math.cos(y / 7);
    lines.push(`G1 X${x.toFixed(3)} Y${y.toFixed(3)} Z${z.toFixed(3)}${at ? "" : " F2000."}`);
  }
  return [...lines, ...TAIL, ""].join("\n");
}

/**
 * Runs in the page before all else. A key in the editor, a file or the scrubber begins a watch, which ends when the page is idle,
 * shows the part anew, and the picture with it is through the graphics; `figures.drawn` then gives ms since the last of them until
 * then, and until the page had the part.
 */
function watch() {
  const own = (window.figures = { ready: undefined, drawn: undefined });
  const data = (name) => document.querySelector(name)?.dataset ?? {};
  const observe = (look) => {
    const observer = new MutationObserver(() => look(observer));
    observer.observe(document, { subtree: true, attributeFilter: ["data-state", "data-idle", "data-shown", "data-frames"] });
  };
  observe((observer) => {
    if (data("#state").state !== "ready") return;
    own.ready = performance.now();
    observer.disconnect();
  });
  const through = async () => {
    const gl = document.querySelector("#canvas").getContext("webgl2");
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    while (gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) await new Promise((done) => setTimeout(done, 1));
    return performance.now();
  };
  /** Begun again, the watch before is over. */
  const redrawn = (from) =>
    new Promise((done, failed) => {
      const watching = (own.watching = {});
      const before = data("#canvas").shown;
      let [frames, had] = [];
      observe((observer) => {
        if (watching !== own.watching) return observer.disconnect();
        const { state, idle } = data("#state");
        if (state === "failed") {
          observer.disconnect();
          return failed(new Error(document.querySelector("#problems-list").textContent));
        }
        const canvas = data("#canvas");
        if (canvas.shown === before) return;
        // The next picture is the first with the new part.
        frames ??= canvas.frames ?? "0";
        had ??= performance.now();
        if (canvas.frames === undefined || canvas.frames === frames || idle !== "true") return;
        observer.disconnect();
        through().then((now) => done([now - from, had - from]), failed);
      });
    });
  const begun = (from) => {
    own.drawn = redrawn(from);
    own.drawn.catch(() => undefined);
  };
  addEventListener("keydown", (event) => event.target.id === "editor" && begun(event.timeStamp), true);
  addEventListener("change", (event) => event.target.type === "file" && begun(performance.now()), true);
  addEventListener("input", (event) => event.target.id === "scrub" && begun(performance.now()), true);
  // The example that a new world opens has no key: it counts from the page's beginning.
  begun(0);
}

/** Nothing runs, and the picture stays as it is. */
async function calm(page) {
  await ready(page);
  await drawn(page);
}

/** Gives what `figures.drawn` does, of a program of so many pieces whose part has 1024 × 1024 cells. */
async function shown(page, pieces) {
  const late = new Promise((_, failed) => setTimeout(failed, LONGEST, new Error(`no picture in ${LONGEST} ms`)).unref());
  const spent = await Promise.race([page.evaluate(() => window.figures.drawn), late]);
  if (!spent?.every((one) => one > 0)) throw new Error("nothing was watched");
  const [now, scale] = await page.evaluate(() => [document.querySelector("#canvas").dataset.pieces, document.querySelector("#scale").textContent]);
  if (pieces !== undefined && Number(now) !== pieces) throw new Error(`${now} pieces, not ${pieces}`);
  if (pieces !== undefined && !scale.includes("1024 × 1024 cells")) throw new Error(scale);
  return spent;
}

/** What one measurement has found; it counts when the page had no fault until its end. */
const found = [];
const keep = (figures, ...values) => figures.forEach((own, at) => found.push([own, values[at]]));
const seconds = (all) => all.map((ms) => ms / 1000);

/** Opens a file as a user does. */
async function take(page, file, pieces) {
  await page.click("#projects-open");
  await page.setInputFiles('#projects-dialog input[type="file"]', file);
  const spent = await shown(page, pieces);
  await calm(page);
  return spent;
}

/**
 * Bytes of the page's array buffers without copies of the program's text, and of all that the page holds: its heap, and what
 * arrays and texts have beside it. Memory of the graphics, and of the engine in its worker or its binary, is none of the page's.
 */
async function memory(page, text) {
  const session = await page.context().newCDPSession(page);
  let json = "";
  session.on("HeapProfiler.addHeapSnapshotChunk", ({ chunk }) => (json += chunk));
  // It collects what is unused first.
  await session.send("HeapProfiler.takeHeapSnapshot", { reportProgress: false });
  await session.detach();
  const { snapshot, nodes, strings } = JSON.parse(json);
  const fields = snapshot.meta.node_fields;
  const [name, size] = [fields.indexOf("name"), fields.indexOf("self_size")];
  const buffer = strings.indexOf("system / JSArrayBufferData");
  let [arrays, held] = [0, 0];
  for (let at = 0; at < nodes.length; at += fields.length) {
    held += nodes[at + size];
    if (nodes[at + name] === buffer && nodes[at + size] !== text) arrays += nodes[at + size];
  }
  if (buffer < 0 || arrays === 0) throw new Error("the page has no arrays");
  return [arrays, held];
}

/** A first visit. */
async function visit(page) {
  const [spent] = await shown(page);
  const [painted, came] = await page.evaluate(() => [
    performance.getEntriesByType("paint").find((one) => one.name === "first-contentful-paint")?.startTime,
    window.figures.ready,
  ]);
  if (!painted || !came) throw new Error("no paint, or no engine");
  keep([paint, engine, first], ...seconds([painted, came, spent]));
}

/** A program is opened, and a block written into it, key by key. */
async function edit(page, { file, count, opened, redrawn }) {
  keep(opened, ...seconds(await take(page, file, count + AROUND)));
  await page.locator("#editor .cm-content").click();
  await page.keyboard.press("Control+Home");
  for (let line = 0; line < HEAD.length; line += 1) await page.keyboard.press("ArrowDown");
  await page.keyboard.press("End");
  await calm(page);
  await page.keyboard.type("\nX9.5", { delay: 60 });
  keep(redrawn, ...seconds(await shown(page, count + AROUND + 1)));
}

/** The large program is opened after a small one with as many cells, and the scrubber moved in it. */
async function surfacing(page, { file, count, bytes }, small) {
  await take(page, small.file, small.count + AROUND);
  const before = await memory(page, bytes);
  keep(large, ...seconds(await take(page, file, count + AROUND)));
  const after = await memory(page, bytes);
  keep([moves, all], ...after.map((bytes, at) => (bytes - before[at]) / (count - small.count)));
  const cells = () => page.getAttribute("#canvas", "data-cut");
  for (const share of SEEKS) {
    const cut = await cells();
    await page.locator("#scrub").evaluate((scrub, at) => {
      scrub.value = String(at * scrub.max);
      scrub.dispatchEvent(new Event("input", { bubbles: true }));
    }, share);
    keep(seek, ...(await shown(page, count + AROUND)));
    if ((await cells()) === cut) throw new Error(`a seek to ${share} has changed nothing`);
    await calm(page);
  }
}

const world = await begin();
const folder = mkdtempSync(join(tmpdir(), "ncc-figures-"));
let failures = 0;

/** Does one measurement in a world of its own, over each host. */
async function measure(name, body) {
  for (const host of HOSTS) {
    console.error(`${name}, ${TITLES[host]}`);
    found.length = 0;
    const context = await world.browser.newContext({ viewport: { width: 1280, height: 800 }, locale: "en-US" });
    let binary;
    try {
      // One binary refuses more than some pages that are new.
      if (host === "loopback") binary = await studio(mkdtempSync(join(folder, "studio-")));
      // A page without an engine is known at once.
      const early = (page) => shown(page);
      const { page, faults } = await open({ ...world, binary }, { host, context, script: watch, early });
      await body(page);
      if (faults.length > 0) throw new Error(faults.join("\n"));
      for (const [own, value] of found) own.values[host].push(value);
    } catch (error) {
      failures += 1;
      console.error(`${name}, ${TITLES[host]}: NOT MEASURED: ${error.message}`);
    } finally {
      await context.close();
      binary?.end();
    }
  }
}

function program(name, count) {
  const text = surface(count);
  const file = join(folder, name);
  writeFileSync(file, text);
  return { file, count, bytes: text.length };
}

/** A row of the table, its widths by column. */
const row = (cells) => cells.map((cell, at) => (at === 0 ? cell.padEnd(40) : cell.padStart(at % 3 === 2 ? 13 : 9))).join("");

function table() {
  console.log(row(["", "asked", ...Object.values(TITLES).flatMap((title) => [title, "best", "worst"])]));
  for (const { name, asked, unit, digits, values } of figures) {
    const cells = Object.values(values).flatMap((own) => {
      if (own.length === 0) return ["-", "", ""];
      const sorted = own.toSorted((a, b) => a - b);
      const median = sorted[sorted.length >> 1];
      const over = asked !== undefined && median > asked ? "> " : "";
      return [over + median.toFixed(digits), sorted[0].toFixed(digits), sorted.at(-1).toFixed(digits)];
    });
    console.log(row([`${name}, ${unit}`, asked === undefined ? "" : String(asked), ...cells]));
  }
}

try {
  const site = process.env.STUDIO_SITE;
  const files = site ? readdirSync(site, { recursive: true, withFileTypes: true }).filter((one) => one.isFile()) : [];
  const packed = files.map((one) => execFileSync("gzip", ["-9c", join(one.parentPath ?? one.path, one.name)], { maxBuffer: 1e8 }).length);
  if (site) bundle.values.worker.push(packed.reduce((sum, bytes) => sum + bytes, 0) / 1e6);
  const sizes = SIZES.map((size) => ({ ...size, ...program(`${size.lines}.nc`, size.lines - HEAD.length - TAIL.length) }));
  const million = program("million.nc", 1_000_000);
  for (let run = 0; run < RUNS; run += 1) {
    await measure("a first visit", visit);
    for (const size of sizes) await measure(`${size.lines} lines`, (page) => edit(page, size));
    if (run < LARGE_RUNS) await measure("a million moves", (page) => surfacing(page, million, sizes[0]));
  }
} finally {
  await world.end();
  rmSync(folder, { recursive: true, force: true });
}
table();
process.exitCode = failures > 0 || HOSTS.length < 2 ? 1 : 0;
