// Translation side by side, answers in a project file, and the moves of two programs.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { NCC, studio } from "./binary.mjs";
import { line, open, pixels, ready, type } from "./browser.mjs";
import { ASKS, SQUARE, long } from "./programs.mjs";
import { tests, value } from "./pages.mjs";

const { page, both, world } = tests();

async function translate(own, to = "siemens") {
  await own.click("#tab-translate");
  await own.selectOption("#to", to);
  await ready(own);
}

const pairs = (own, host) => own.locator(`${host} .cm-line.pair`).allTextContents();

both("a click in the source marks what was made of it, and a click in the translation its source", {}, async (own) => {
  await type(own, SQUARE);
  await translate(own);
  await own.locator("#editor .cm-line", { hasText: "G2 X30." }).click();
  assert.match((await pairs(own, "#output")).join(), /G2 X30/);
  assert.deepEqual(await pairs(own, "#editor"), ["G2 X30. Y20. I5. J0."]);
  await own.locator("#output .cm-line", { hasText: "CYCLE81" }).first().click();
  assert.match((await pairs(own, "#editor")).join(), /G81 X25\./);
  // What heads the output comes from no line.
  await own.locator("#output .cm-line").first().click();
  assert.deepEqual(await pairs(own, "#editor"), []);
});

both("source and translation are scrolled together, until the button says no", {}, async (own) => {
  await type(own, long(400));
  await translate(own);
  const top = (host) =>
    own.locator(host).evaluate((element) => {
      const scroller = element.shadowRoot.querySelector(".cm-scroller");
      const from = scroller.getBoundingClientRect().top;
      const lines = [...element.shadowRoot.querySelectorAll(".cm-line")];
      return lines.find((one) => one.getBoundingClientRect().bottom > from + 3)?.textContent ?? "";
    });
  const scroll = async (host, by) => {
    await own.locator(host).evaluate((element, way) => (element.shadowRoot.querySelector(".cm-scroller").scrollTop = way), by);
    await own.waitForTimeout(500);
  };
  const x = (text) => /X(-?[\d.]+)/.exec(text)?.[1];
  await scroll("#editor", 3000);
  assert.equal(Number(x(await top("#output"))), Number(x(await top("#editor"))));
  await scroll("#output", 1500);
  assert.equal(Number(x(await top("#output"))), Number(x(await top("#editor"))));
  const before = await top("#editor");
  await own.click("#together");
  await scroll("#output", 4500);
  assert.equal(await top("#editor"), before);
});

page("an answer that is clicked stands in the project's ncc.toml, and one that is taken back does not", {}, async (own) => {
  await type(own, ASKS);
  await translate(own);
  await own.locator("#questions button", { hasText: /^-5 mm$/ }).click();
  await own.waitForFunction(() => /Written to ncc\.toml/.test(document.querySelector("#answers-told").textContent));
  const stored = () =>
    own.evaluate(async () => {
      const open = indexedDB.open("ncc-studio");
      await new Promise((done) => (open.onsuccess = done));
      const all = open.result.transaction("projects").objectStore("projects").getAll();
      await new Promise((done) => (all.onsuccess = done));
      return all.result.map((one) => one.answers).find(Boolean);
    });
  assert.match(await stored(), /\[programs\.machine\]\ndialect = "fanuc"\noptions = \{ decimal_point = "calculator" \}/);
  await own.locator("#choices .chip").first().click();
  await ready(own);
  await own.waitForTimeout(300);
  assert.doesNotMatch(await stored(), /decimal_point/);
});

test("ncc studio: answers go into the folder's ncc.toml, and the command line translates by it", { skip: !NCC && "NCC names no binary" }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "ncc-studio-"));
  const [file, answers] = [join(folder, "part.nc"), join(folder, "ncc.toml")];
  writeFileSync(file, ASKS);
  writeFileSync(answers, '# ours\n[[programs]]\nfiles = "old/*.nc"\nmachine = "haas-vf2"\n');
  const server = await studio(folder);
  try {
    const { page: own, context, faults } = await open(world(), { address: server.address });
    // The file of answers is no program.
    assert.equal(await value(own, "#project-name"), "part.nc");
    await translate(own);
    // Two controls fit this text: which one it is for is the first answer.
    await own.selectOption("#from", "fanuc");
    await ready(own);
    await own.locator("#questions button", { hasText: /^-5 mm$/ }).click();
    await own.waitForFunction(() => /Written to ncc\.toml/.test(document.querySelector("#answers-told").textContent));
    assert.match(readFileSync(answers, "utf8"), /^# ours\n[^]*decimal_point = "calculator"/);
    await ready(own);
    const shown = await own.locator("#output .cm-content").textContent();
    assert.match(shown, /G1 Z-5/);
    const output = execFileSync(NCC, ["translate", "part.nc"], { cwd: folder, stdio: ["ignore", "pipe", "ignore"] }).toString();
    assert.match(output, /G1 Z-5/);
    writeFileSync(answers, '[[programs]]\nfiles = "*.nc"\nmachine = "fanuc-vmc"\n');
    await own.locator("#choices .chip").first().click();
    await own.waitForFunction(() => /and others/.test(document.querySelector("#answers-told").textContent));
    assert.doesNotMatch(readFileSync(answers, "utf8"), /siemens/);
    assert.deepEqual(faults, []);
    await context.close();
  } finally {
    server.end();
  }
  assert.ok(existsSync(answers));
});

both("the moves of a program and its translation are the same", {}, async (own) => {
  await type(own, SQUARE);
  await translate(own);
  await own.locator("#moves-box summary").click();
  await own.click("#moves-compare");
  await own.waitForFunction(() => document.querySelector("#moves-told").textContent === "The moves are the same");
  assert.ok((await pixels(own, "#moves-picture", { feed: "--c-move-feed" })).feed > 50);
});

page("differences to another project are listed and drawn, and a click leads to the block", {}, async (own) => {
  await own.click("#projects-open");
  const buffer = Buffer.from(SQUARE.replace("X50.\nY0.", "X44.\nY0.").replace("F200.", "F250."));
  await own.setInputFiles('#projects-dialog input[type="file"]', { name: "other.nc", mimeType: "text/plain", buffer });
  await ready(own);
  await own.click("#projects-open");
  await own.fill("#projects-dialog .new input", "Mine");
  await own.keyboard.press("Enter");
  await own.waitForFunction(() => document.querySelector("#project-name").textContent === "Mine");
  await type(own, SQUARE);
  await own.click("#tab-translate");
  await own.locator("#moves-box summary").click();
  await own.locator("#moves-other option", { hasText: "other" }).waitFor({ state: "attached" });
  await own.selectOption("#moves-other", { label: "other" });
  await own.click("#moves-compare");
  const row = own.locator("#moves-list button", { hasText: "6 mm off" }).first();
  await row.waitFor();
  assert.ok((await own.locator("#moves-list button").count()) >= 2);
  const inks = { mine: "--c-move-feed", other: "--c-move-clockwise", mark: "--mark" };
  const before = await pixels(own, "#moves-picture", inks);
  assert.ok(before.mine > 50 && before.other > 10 && before.mark === 0, JSON.stringify(before));
  await row.click();
  assert.equal(await line(own), 9);
  assert.ok((await pixels(own, "#moves-picture", inks)).mark > 50);
});
