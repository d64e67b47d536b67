// What a program's `ncc.toml` states: shown, used, changed; programs in other files; the zero of the part on its machine.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { strFromU8, strToU8, unzipSync, zipSync } from "fflate";
import { NCC, studio } from "./binary.mjs";
import { line, open, ready, type } from "./browser.mjs";
import { tests, value } from "./pages.mjs";
import { ASKS, SQUARE, STL } from "./programs.mjs";

const { both, world } = tests();
const data = (own, name) => own.getAttribute("#canvas", `data-${name}`);

const STATED = `# ours
[[programs]]
files = "square.nc"
stock = "X-20:60 Y-20:60 Z-15:0"
fixtures = ["X60:70 Y-20:60 Z-15:-5"]
table = -15.5
to = "haas-vf2"

[programs.machine]
dialect = "fanuc"
options = { decimal_point = "calculator" }

[[programs.machine.tool]]
number = 1
shape = "ball"
diameter = 8
`;

async function take(own, name, files) {
  await own.click("#projects-open");
  const zip = zipSync(Object.fromEntries(Object.entries(files).map(([path, text]) => [path, strToU8(text)])));
  await own.setInputFiles('#projects-dialog input[type="file"]', { name: "files.zip", mimeType: "application/zip", buffer: Buffer.from(zip) });
  await own.waitForFunction((wanted) => document.querySelector("#project-name").textContent === wanted, name);
  await ready(own);
}

/** What the file states is in the fields, and the part is cut by it. */
async function isShown(own) {
  await own.click("#tab-setup");
  const field = (name) => own.getByLabel(name, { exact: true });
  await own.waitForFunction(() => document.querySelector('[aria-label="Raw part X+"]')?.value === "60");
  assert.equal(await field("Raw part").inputValue(), "block");
  assert.equal(await field("Fixture 1 X+").inputValue(), "70");
  assert.equal(await field("Table at Z").inputValue(), "-15.5");
  assert.equal(await field("Diameter T1").inputValue(), "8");
  assert.equal(await field("Shape T1").inputValue(), "ball");
  const first = (list) => own.locator(`${list} option:checked`).textContent();
  assert.match(await first("#from"), /^ncc\.toml: .*Fanuc/);
  await own.click("#tab-translate");
  assert.match(await first("#machine-to"), /^ncc\.toml: .*Haas/);
  await ready(own);
  await own.locator("#verdict.good").waitFor();
  assert.match(await value(own, "#choices"), /decimal_point = calculator/);
  await own.click("#tab-setup");
}

/** Other values go into the file, where all else stays. */
async function change(own, text) {
  const told = async (label, fill) => {
    const before = await text();
    await own.getByLabel(label, { exact: true }).fill(fill);
    await own.keyboard.press("Tab");
    for (let tries = 0; tries < 50 && (await text()) === before; tries += 1) await own.waitForTimeout(100);
    await ready(own);
    return text();
  };
  assert.match(await told("Raw part X+", "65"), /^# ours\n[^]*stock = "X-20:65 Y-20:60 Z-15:0"\n/);
  assert.match(await told("Table at Z", ""), /^(?![^]*table = )/);
  const all = await told("Diameter T1", "6");
  assert.match(all, /shape = "ball"\ndiameter = 6/);
  assert.match(all, /decimal_point = "calculator"/);
  assert.match(all, /to = "haas-vf2"/);
  assert.match(await value(own, "#setup-told"), /^Written to ncc\.toml/);
  assert.equal(await own.getByLabel("Raw part X+", { exact: true }).inputValue(), "65");
}

both("what a project's ncc.toml states is shown and used, and what is changed goes into it", {}, async (own) => {
  await take(own, "square", { "square/square.nc": SQUARE, "square/ncc.toml": STATED });
  await isShown(own);
  await change(own, async () => {
    await own.click("#projects-open");
    const [download] = await Promise.all([own.waitForEvent("download"), own.getByLabel("Zip: square", { exact: true }).click()]);
    await own.keyboard.press("Escape");
    return strFromU8(unzipSync(readFileSync(await download.path()))["square/ncc.toml"]);
  });
});

both("bodies in ncc.toml are read by their letters, and what has no fields stands as it is", {}, async (own) => {
  const row = '[[programs]]\nfiles = "square.nc"\nstock = "Z-20:0, D90"\nfixtures = ["Z-15:-5 X60:70 Y-20:60", "X60:70 Y0:9"]\n';
  await take(own, "square", { "square/square.nc": SQUARE, "square/ncc.toml": row });
  await own.click("#tab-setup");
  const fields = (names) => Promise.all(names.map((name) => own.getByLabel(name, { exact: true }).inputValue()));
  await own.getByLabel("Raw part D", { exact: true }).waitFor();
  assert.deepEqual(await fields(["D", "X", "Y", "Z−", "Z+"].map((name) => `Raw part ${name}`)), ["90", "0", "0", "-20", "0"]);
  assert.deepEqual(await fields(["X−", "X+", "Y−", "Y+", "Z−", "Z+"].map((name) => `Fixture 1 ${name}`)), ["60", "70", "-20", "60", "-15", "-5"]);
  assert.match(await value(own, "#fixtures"), /X60:70 Y0:9/);
});

both("an ncc.toml with faults is told, and the program is read without it", {}, async (own) => {
  await take(own, "square", { "square/square.nc": SQUARE, "square/ncc.toml": "[[programs]\n" });
  await own.click("#tab-setup");
  await own.locator("#setup-told", { hasText: "ncc.toml" }).waitFor();
  assert.equal(await own.getByLabel("Raw part", { exact: true }).inputValue(), "guess");
});

both("files that ncc.toml names and that are not at hand are told in the set-up", {}, async (own) => {
  const row = '[[programs]]\nfiles = "square.nc"\nmachine = "ours.toml"\nstock = "raw.stl"\n';
  await take(own, "square", { "square/square.nc": SQUARE, "square/ncc.toml": row });
  await own.click("#tab-setup");
  const lines = own.locator("#set-up-machine p");
  await lines.first().waitFor();
  assert.deepEqual(await lines.allTextContents(), ["ours.toml", "raw.stl"].map((name) => `ncc.toml names ${name}, and there is no such file`));
  // The rest is done without them.
  assert.ok(Number(await data(own, "cut")) > 100);
  await take(own, "square-2", { "square-2/square-2.nc": SQUARE });
  await own.click("#tab-setup");
  assert.equal(await own.locator("#set-up-machine").isVisible(), false);
});

both("F12 leads to a called program in another file", {}, async (own) => {
  const main = "%\nO1\nG21 G17 G90 G94 G40 G49 G80 G54\nM98 P2000\nM30\n%\n";
  await take(own, "main", { "sub.nc": "%\n(BORES)\nO2000\nG0 X1.\nM99\n%\n", "main.nc": main });
  await own.locator("#editor .cm-line", { hasText: "M98 P2000" }).click();
  await own.keyboard.press("F12");
  await own.waitForFunction(() => document.querySelector("#project-name").textContent === "sub");
  assert.equal(await line(own), 3);
  await ready(own);
  await own.locator("#editor .cm-line", { hasText: "X1." }).click();
  await own.click("#go-to");
  await own.waitForFunction(() => document.querySelector("#editor-told").textContent !== "");
  assert.equal(await value(own, "#project-name"), "sub");
});

both("the zero of the part on the machine shows its travel, and what leaves it", {}, async (own) => {
  await type(own, SQUARE);
  await own.selectOption("#machine", "fanuc-vmc");
  await own.waitForTimeout(200);
  await ready(own);
  await own.click("#tab-setup");
  for (const [axis, at] of [["X", "-990"], ["Y", "-200"], ["Z", "-300"]]) {
    await own.getByLabel(`Zero of the part on the machine ${axis}`, { exact: true }).fill(at);
    await own.keyboard.press("Tab");
  }
  await own.waitForTimeout(300);
  await ready(own);
  await own.locator("#problems", { hasText: /travel/ }).waitFor({ state: "attached" });
});

test("ncc studio: what ncc.toml states is followed, and no option of before is kept over it", { skip: !NCC && "NCC names no binary" }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "ncc-stated-"));
  const [file, program] = [join(folder, "ncc.toml"), join(folder, "asks.nc")];
  const row = (option) => `[[programs]]\nfiles = "asks.nc"\nstock = "raw.stl"\nmachine = { dialect = "fanuc"${option} }\nto = { dialect = "siemens" }\n`;
  const of = (point) => row(`, options = { decimal_point = "${point}" }`);
  writeFileSync(program, ASKS);
  writeFileSync(join(folder, "raw.stl"), STL);
  writeFileSync(file, of("calculator"));
  const server = await studio(folder);
  try {
    const { page: own, faults, context } = await open(world(), { address: server.address });
    const shows = async (choice, depth, option) => {
      await own.waitForFunction((wanted) => document.querySelector("#choices").textContent.includes(wanted), choice);
      await own.locator("#output .cm-line", { hasText: depth }).waitFor();
      assert.equal((await value(own, "#choices")).includes("decimal_point"), option);
      await ready(own);
    };
    await own.click("#tab-translate");
    await shows("decimal_point = calculator", /Z-5[. ]/, true);
    // The program is another one in the same moment.
    writeFileSync(program, ASKS.replace("X30.5", "X31.5"));
    writeFileSync(file, of("increment"));
    await shows("decimal_point = increment", /Z-0?\.005/, true);
    await own.locator("#editor .cm-line", { hasText: "X31.5" }).waitFor();
    await own.reload();
    await ready(own);
    await own.click("#tab-translate");
    await shows("decimal_point = increment", /Z-0?\.005/, true);
    // What is written states it still; a file of triangles has no fields.
    await own.click("#tab-setup");
    assert.equal(await own.getByLabel("Raw part", { exact: true }).inputValue(), "raw.stl");
    assert.equal(await own.getByLabel("Raw part X+", { exact: true }).count(), 0);
    await own.getByLabel("Table at Z", { exact: true }).fill("-40");
    await own.keyboard.press("Tab");
    await own.locator("#setup-told", { hasText: "Written to ncc.toml" }).waitFor();
    assert.match(readFileSync(file, "utf8"), /stock = "raw.stl"\n[^]*"increment"[^]*table = -40/);
    // Taken back, it does not hold; nor is it in the file.
    await own.click("#tab-translate");
    await own.locator("#choices button", { hasText: "decimal_point" }).click();
    await own.locator("#questions button", { hasText: /^-5 mm$/ }).waitFor();
    assert.doesNotMatch(readFileSync(file, "utf8"), /decimal_point/);
    assert.deepEqual(faults, []);
    await context.close();
  } finally {
    server.end();
  }
});

test("ncc studio: a folder's ncc.toml is read, followed and written", { skip: !NCC && "NCC names no binary" }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "ncc-stated-"));
  const file = join(folder, "ncc.toml");
  writeFileSync(join(folder, "square.nc"), SQUARE);
  writeFileSync(join(folder, "sub.nc"), "%\n(BORES)\nO2000\nG0 X1.\nM99\n%\n");
  writeFileSync(file, STATED);
  const server = await studio(folder);
  try {
    const { page: own, faults, context } = await open(world(), { address: server.address });
    await isShown(own);
    await change(own, async () => readFileSync(file, "utf8"));
    // Somebody else changes it.
    writeFileSync(file, readFileSync(file, "utf8").replace("X-20:65", "X-20:75"));
    await own.waitForFunction(() => document.querySelector('[aria-label="Raw part X+"]')?.value === "75");
    assert.deepEqual(faults, []);
    await context.close();
  } finally {
    server.end();
  }
});
