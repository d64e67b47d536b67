// Projects as zip files: out, and in again.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { strFromU8, strToU8, unzipSync, zipSync } from "fflate";
import { ready, type } from "./browser.mjs";
import { SQUARE } from "./programs.mjs";
import { tests, value } from "./pages.mjs";

const { page, both } = tests();

async function take(own, name, buffer) {
  await own.click("#projects-open");
  await own.setInputFiles('#projects-dialog input[type="file"]', { name, mimeType: "application/zip", buffer: Buffer.from(buffer) });
}

async function named(own, name) {
  await own.waitForFunction((wanted) => document.querySelector("#project-name").textContent === wanted, name);
  await ready(own);
}

both("a project goes out as a zip with its choices, and comes in again", {}, async (own) => {
  await own.click("#projects-open");
  await own.fill("#projects-dialog .new input", "Flange");
  await own.keyboard.press("Enter");
  await named(own, "Flange");
  await type(own, SQUARE);
  await own.selectOption("#from", "haas");
  await ready(own);
  await own.click("#projects-open");
  const [download] = await Promise.all([own.waitForEvent("download"), own.getByLabel("Zip: Flange", { exact: true }).click()]);
  assert.equal(download.suggestedFilename(), "Flange.zip");
  const bytes = readFileSync(await download.path());
  const files = unzipSync(bytes);
  assert.deepEqual(Object.keys(files).sort(), ["Flange/Flange.nc", "Flange/studio.json"]);
  assert.equal(strFromU8(files["Flange/Flange.nc"]), SQUARE);
  await own.keyboard.press("Escape");
  await take(own, "Flange.zip", bytes);
  await named(own, "Flange (2)");
  assert.equal(await own.inputValue("#from"), "haas");
  assert.match(await own.locator("#editor .cm-content").textContent(), /SQUARE/);
  await own.click("#projects-open");
  const [all] = await Promise.all([own.waitForEvent("download"), own.click("#export-all")]);
  const names = Object.keys(unzipSync(readFileSync(await all.path())));
  assert.ok(names.includes("Flange (2)/Flange.nc") && names.includes("Flange/Flange.nc"), names.join());
});

page("a zip of programs makes a project of each, and what is no zip is told", {}, async (own) => {
  const evil = '{"name":"<img src=x onerror=window.evil=1>","file":"a.nc","choices":{"from":7,"tools":{"1":["x"]},"pass":"x"}}';
  const zip = zipSync({ "job/a.nc": strToU8(SQUARE), "job/studio.json": strToU8(evil), "../../b.nc": strToU8("%\nO2\nM30\n%\n"), "__MACOSX/._a": strToU8("x") });
  await take(own, "job.zip", zip);
  await named(own, "b");
  await own.click("#projects-open");
  await own.locator("#projects-list b", { hasText: /^b$/ }).waitFor();
  const names = await own.locator("#projects-list b").allTextContents();
  assert.ok(names.includes("<img src=x onerror=window.evil=1>") && names.includes("b"), names.join());
  assert.equal(await own.evaluate(() => window.evil), undefined);
  await own.keyboard.press("Escape");
  await take(own, "broken.zip", Buffer.concat([Buffer.from(zip.slice(0, 40)), Buffer.from("nothing")]));
  await own.locator("#projects-dialog .wrong", { hasText: "broken.zip" }).waitFor();
  assert.equal(await value(own, "#project-name"), "b");
});

/** The first list of projects comes late: the example that opens by itself waits for it. */
const LATE = `{
  const own = IDBObjectStore.prototype.getAll;
  let first = true;
  IDBObjectStore.prototype.getAll = function (...given) {
    const request = own.apply(this, given);
    if (!first) return request;
    first = false;
    return {
      set onsuccess(done) { request.onsuccess = () => setTimeout(() => (done(), (window.isLate = true)), 2500); },
      set onerror(failed) { request.onerror = failed; },
      get result() { return request.result; },
    };
  };
}`;

both("a program that is taken while the page opens stays, though the example comes later", {
  script: LATE,
  early: async (own) => {
    await take(own, "early.zip", zipSync({ "early.nc": strToU8(SQUARE) }));
    await own.waitForFunction(() => window.isLate);
  },
}, async (own) => {
  await own.waitForTimeout(300);
  assert.equal(await value(own, "#project-name"), "early");
  assert.match(await own.locator("#editor .cm-content").textContent(), /SQUARE/);
  await own.click("#projects-open");
  await own.locator("#projects-list b").first().waitFor();
  assert.deepEqual(await own.locator("#projects-list b").allTextContents(), ["early"]);
});
