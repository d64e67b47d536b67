// The page as a user has it, in a browser without a window: what is seen (elements, pixels), and what is kept.

import assert from "node:assert/strict";
import { test } from "node:test";
import { cpSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { drawn, line, open, paste, pixels, placeOf, ready, type } from "./browser.mjs";
import { NCC, studio } from "./binary.mjs";
import { tests, value } from "./pages.mjs";
import { ASKS, SQUARE, long } from "./programs.mjs";
import { serve } from "./server.mjs";

const { page, both, world } = tests();

async function projects(own) {
  await own.click("#projects-open");
  await own.locator("#projects-dialog[open]").waitFor();
}

/** Waits until a project is open, and its work is done. */
async function named(own, name) {
  await own.waitForFunction((wanted) => document.querySelector("#project-name").textContent === wanted, name);
  await ready(own);
}

page("the browser has WebGL 2", {}, async (own) => {
  assert.ok(await own.evaluate(() => document.createElement("canvas").getContext("webgl2") !== null));
});

both("a first visit shows an example, coloured, checked, drawn and cut", {}, async (own) => {
  assert.equal(await value(own, "#project-name"), "pocket-spiral");
  assert.equal(await own.locator("#editor .c-code-g").first().textContent(), "G21");
  assert.ok((await own.locator("#editor .c-comment").count()) > 3);
  assert.match(await own.locator("#from option:checked").textContent(), /^Fanuc/);
  assert.match(await value(own, "#problems-count"), /Nothing found|[0-9]/);
  assert.ok(Number(await own.getAttribute("#canvas", "data-pieces")) > 50);
  assert.ok(Number(await own.getAttribute("#canvas", "data-cut")) > 1000);
  const found = await pixels(own, "#canvas", { feed: "--c-move-feed" });
  assert.ok(found.feed > 300, JSON.stringify(found));
});

page("moves have colours by their kind, and a button hides each", {}, async (own) => {
  await type(own, SQUARE);
  await own.click("#part");
  const inks = { feed: "--c-move-feed", two: "--c-move-clockwise", three: "--c-move-counterclockwise" };
  const all = await pixels(own, "#canvas", inks);
  assert.ok(all.feed > 200 && all.two > 15 && all.three > 15, JSON.stringify(all));
  await own.click("#kind-2");
  assert.equal((await pixels(own, "#canvas", inks)).two, 0);
  await own.click("#kind-1");
  assert.equal((await pixels(own, "#canvas", inks)).feed, 0);
});

page("nothing is drawn while nothing changes", {}, async (own) => {
  // The first pictures are timed, and drawn coarser or finer.
  await own.waitForTimeout(2500);
  const frames = await own.getAttribute("#canvas", "data-frames");
  await own.waitForTimeout(1200);
  assert.equal(await own.getAttribute("#canvas", "data-frames"), frames);
  await own.click('[data-side="top"]');
  await own.waitForFunction((before) => document.querySelector("#canvas").dataset.frames !== before, frames);
});

page("raw part and tools are stated, and the part is another", {}, async (own) => {
  await type(own, SQUARE);
  const cut = async () => Number(await own.getAttribute("#canvas", "data-cut"));
  await own.click("#tab-setup");
  const tools = own.locator("#setup-pane tbody tr");
  assert.equal(await tools.count(), 2);
  const before = await cut();
  await own.getByLabel("Diameter T1").fill("4");
  await own.keyboard.press("Tab");
  await own.waitForTimeout(200);
  await ready(own);
  assert.match(await tools.first().textContent(), /Stated here/);
  const small = await cut();
  assert.ok(small < before * 0.7 && small > 0, `${small} of ${before}`);
  await own.getByLabel("Raw part", { exact: true }).selectOption("cylinder");
  await own.waitForTimeout(200);
  await ready(own);
  assert.equal(await own.locator("#setup-pane .fields input").count(), 5);
  await own.getByLabel("Raw part D").fill("500");
  await own.keyboard.press("Tab");
  await own.waitForTimeout(200);
  await ready(own);
  assert.match(await own.locator("#setup-pane .fields").textContent(), /500.0 × 500.0/);
});

both("a problem stands in its line and in the list, and a click goes there", {}, async (own) => {
  await type(own, SQUARE.replace("Y50.\n", "Y5O.\n"));
  const row = own.locator("#problems-list button").first();
  assert.equal(await row.getAttribute("data-line"), "8");
  assert.ok((await own.locator("#editor .cm-lintRange").count()) > 0);
  await row.click();
  assert.equal(await line(own), 8);
});

page("an alarm of the part is a problem, and a click goes to its moment", {}, async (own) => {
  await projects(own);
  await own.locator("#examples button", { hasText: "dome.nc" }).click();
  await named(own, "dome");
  const row = own.locator("#problems-list button", { hasText: "NC0901" }).first();
  await row.click();
  assert.equal(await line(own), 18);
  const [now, total] = (await value(own, "#clock")).split(" / ");
  assert.notEqual(now, total);
  assert.ok((await pixels(own, "#bands", { alarm: "--warning" })).alarm > 10);
});

both("the outline lists the tools with their times, a click goes to the tool's call, and a tool is folded", {}, async (own) => {
  await type(own, SQUARE);
  const rows = own.locator("#outline-list button");
  await rows.nth(1).waitFor();
  assert.equal(await rows.count(), 2);
  assert.equal(await own.locator('#editor .cm-foldGutter span[title="Fold"]').count(), 2);
  assert.deepEqual(await rows.evaluateAll((all) => all.map((row) => row.dataset.line)), ["4", "18"]);
  assert.match(await rows.nth(1).textContent(), /^T218Drill ⌀ ≈ 6\.00 mm\d:\d\d\.\d0:\d\d\.\d$/);
  await rows.nth(1).click();
  assert.equal(await line(own), 18);
  const [now, total] = (await value(own, "#clock")).split(" / ");
  assert.ok(now !== "0:00.0" && now !== total, now);
  const shut = own.locator("#editor .cm-foldPlaceholder");
  await own.keyboard.press("Control+Shift+BracketLeft");
  assert.equal(await shut.count(), 1);
  await shut.click();
  assert.equal(await shut.count(), 0);
  await own.locator('#editor .cm-foldGutter span[title="Fold"]').first().click();
  assert.equal(await own.locator("#editor .cm-line", { hasText: "Y50." }).count(), 0);
  assert.equal(await own.locator("#editor .cm-line", { hasText: "T2 M6" }).count(), 1);
});

page("a word under the pointer is explained, and words are offered while somebody types", {}, async (own) => {
  await type(own, SQUARE);
  await own.locator("#editor .c-code-g", { hasText: "G43" }).first().hover();
  const about = own.locator("#editor .about");
  await about.waitFor();
  assert.match(await about.textContent(), /USE_TOOL_LENGTH_OFFSET/);
  await own.locator("#editor .cm-line", { hasText: "M5" }).first().click();
  await own.keyboard.press("End");
  await own.keyboard.press("Enter");
  await own.keyboard.type("G8");
  const offers = own.locator("#editor .cm-tooltip-autocomplete li");
  await offers.first().waitFor();
  assert.ok((await offers.allTextContents()).some((text) => text.startsWith("G83")));
  await own.keyboard.press("Escape");
  // What stands behind a word of a letter is its letter's.
  await own.locator("#editor .c-feed").first().hover();
  await about.filter({ hasText: "feed" }).waitFor();
});

page("the line of the cursor is marked in the picture, and a click on a move goes to its line", {}, async (own) => {
  await type(own, SQUARE);
  await own.click("#part");
  await own.click('[data-side="top"]');
  const marked = async () => (await pixels(own, "#canvas", { mark: "--c-move-marked" })).mark;
  // The click into the editor marked a line of the text before this one.
  for (let tries = 0; tries < 30 && (await marked()) > 0; tries += 1) await own.waitForTimeout(100);
  assert.equal(await marked(), 0);
  await own.locator("#editor .cm-line", { hasText: "X50." }).first().click();
  assert.equal(await own.getAttribute("#canvas", "data-marked"), "9");
  assert.ok((await marked()) > 50);
  const at = await placeOf(own, "--c-move-counterclockwise");
  await own.mouse.click(...at);
  assert.equal(await line(own), 16);
  assert.equal(await value(own, "#now-block"), "16");
});

page("a click on the part goes to the block that cut it", {}, async (own) => {
  await type(own, SQUARE);
  for (const kind of [0, 1, 2, 3]) await own.click(`#kind-${kind}`);
  await own.click('[data-side="top"]');
  await own.waitForTimeout(300);
  const box = await own.locator("#canvas").boundingBox();
  const found = new Set();
  for (let x = 0.2; x < 0.8; x += 0.06) {
    await own.mouse.click(box.x + box.width * x, box.y + box.height * 0.5);
    found.add(await own.getAttribute("#canvas", "data-marked"));
  }
  assert.ok(found.has("8") || found.has("10"), [...found].join());
});

both("the part is cut forwards and backwards with the moment", {}, async (own) => {
  await type(own, SQUARE);
  const cut = async () => (await own.waitForTimeout(400), Number(await own.getAttribute("#canvas", "data-cut")));
  const becomes = (cells) => own.waitForFunction((wanted) => document.querySelector("#canvas").dataset.cut === wanted, String(cells));
  const whole = await cut();
  assert.ok(whole > 0);
  await own.click("#to-start");
  await becomes(0);
  for (let at = 0; at < 6; at += 1) await own.click("#step-forward");
  await own.waitForFunction(() => Number(document.querySelector("#canvas").dataset.cut) > 0);
  const some = await cut();
  assert.ok(some > 0 && some < whole, `${some} of ${whole}`);
  await own.click("#to-end");
  await becomes(whole);
});

page("the moment plays, pauses, steps and is dragged", {}, async (own) => {
  await type(own, SQUARE);
  const [, total] = (await value(own, "#clock")).split(" / ");
  await own.click("#to-start");
  assert.match(await value(own, "#clock"), /^0:00\.0 /);
  await own.click("#play");
  await own.waitForTimeout(900);
  await own.click("#play");
  const seconds = Number((await value(own, "#clock")).slice(2, 6));
  assert.ok(seconds > 0.3 && seconds < 3, String(seconds));
  assert.equal(await own.locator("#editor .cm-line.now").count(), 1);
  await own.click("#step-forward");
  const block = await value(own, "#now-block");
  await own.click("#step-forward");
  assert.notEqual(await value(own, "#now-block"), block);
  await own.click("#step-back");
  assert.equal(await value(own, "#now-block"), block);
  await own.click("#next-tool");
  await own.click("#step-forward");
  assert.equal(await value(own, "#now-t"), "2");
  await own.locator("#scrub").focus();
  await own.keyboard.press("Home");
  assert.match(await value(own, "#clock"), /^0:00\.0 /);
  await own.keyboard.press("End");
  assert.equal(await value(own, "#clock"), `${total} / ${total}`);
  await own.locator("#speed").fill("3");
  assert.equal(await value(own, "#speed-shown"), "1000 ×");
  await own.click("#to-start");
  await own.click("#play");
  await own.waitForTimeout(600);
  assert.equal(await value(own, "#clock"), `${total} / ${total}`);
});

page("charts stand on the axis of time, and a click on one goes to the moment", {}, async (own) => {
  await type(own, SQUARE);
  // They are drawn after the part.
  await drawn(own);
  assert.equal(await own.locator("#charts canvas").count(), 3);
  const box = await own.locator("#charts .u-over").first().boundingBox();
  await own.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  const [now, total] = (await value(own, "#clock")).split(" / ").map((text) => text.split(":").reduce((sum, part) => sum * 60 + Number(part), 0));
  assert.ok(Math.abs(now - total / 2) < total * 0.1, `${now} of ${total}`);
  assert.equal(await own.locator("#charts .chart-now:visible").count(), 3);
});

both("a program is translated beside its source, and verified", {}, async (own) => {
  await type(own, SQUARE);
  await own.click("#tab-translate");
  await own.selectOption("#to", "siemens");
  await ready(own);
  assert.equal(await value(own, "#verdict"), "Verified: it does the same");
  assert.match(await own.locator("#output .cm-content").textContent(), /CYCLE81/);
  // Colours come after their text.
  await own.locator("#output .c-code-g").nth(3).waitFor();
  const [download] = await Promise.all([own.waitForEvent("download"), own.click("#translation-export")]);
  assert.match(download.suggestedFilename(), /\.mpf$/);
  assert.match(readFileSync(await download.path(), "utf8"), /M30/);
});

both("the parts of a program and its translation are compared", {}, async (own) => {
  await type(own, SQUARE);
  await own.click("#tab-translate");
  assert.ok(await own.isDisabled("#compare"));
  await own.selectOption("#to", "siemens");
  await ready(own);
  await own.click("#compare");
  await own.waitForFunction(() => /mm/.test(document.querySelector("#compared").textContent));
  assert.equal(await value(own, "#compared"), "Parts the same to 0.001 mm");
});

page("a question is answered by a click, and the answer can be taken back", {}, async (own) => {
  await type(own, ASKS);
  await own.click("#tab-translate");
  await own.selectOption("#to", "siemens");
  await ready(own);
  assert.equal(await value(own, "#verdict"), "Questions to answer");
  await own.locator("#questions button", { hasText: /^-5 mm$/ }).click();
  await ready(own);
  assert.match(await value(own, "#choices"), /decimal_point = calculator/);
  assert.equal(await value(own, "#verdict"), "Verified: it does the same");
  await own.locator("#choices .chip").first().click();
  await ready(own);
  assert.equal(await value(own, "#verdict"), "Questions to answer");
});

page("a refusal is told in the compiler's words, and what to type is a button", {}, async (own) => {
  await own.click("#tab-translate");
  await own.selectOption("#to", "grbl");
  await ready(own);
  assert.equal(await value(own, "#verdict"), "Not translated");
  assert.match(await value(own, "#messages"), /grbl has no assignment/);
  await own.locator("#questions .chip", { hasText: "--pass flatten" }).click();
  await ready(own);
  assert.doesNotMatch(await value(own, "#messages"), /grbl has no assignment/);
});

page("what is typed is there again after a reload", {}, async (own) => {
  await type(own, SQUARE);
  await own.waitForFunction(() => document.querySelector("#save-state").textContent === "Saved");
  await own.reload();
  await ready(own);
  assert.match(await own.locator("#editor .cm-content").textContent(), /SQUARE/);
});

page("projects are made, renamed, copied, deleted, taken in and given out", {}, async (own) => {
  const rows = own.locator("#projects-list li");
  await projects(own);
  await own.fill("#projects-dialog .new input", "Flange");
  await own.keyboard.press("Enter");
  await named(own, "Flange");
  await projects(own);
  assert.equal(await rows.count(), 2);
  await own.getByLabel("Rename: Flange").click();
  await own.keyboard.insertText("Ring");
  await own.keyboard.press("Enter");
  await own.getByLabel("Duplicate: Ring").click();
  await own.getByLabel("Duplicate: Ring (2)").waitFor();
  assert.equal(await rows.count(), 3);
  const [download] = await Promise.all([own.waitForEvent("download"), own.getByLabel("Download: Ring", { exact: true }).click()]);
  assert.equal(download.suggestedFilename(), "Flange.nc");
  own.on("dialog", (dialog) => dialog.accept());
  await own.getByLabel("Delete: Ring (2)").click();
  await own.getByLabel("Delete: Ring (2)").waitFor({ state: "detached" });
  assert.equal(await rows.count(), 2);
  const file = { name: "taken.nc", mimeType: "text/plain", buffer: Buffer.from(SQUARE.replaceAll("\n", "\r\n")) };
  await own.setInputFiles('#projects-dialog input[type="file"]', file);
  await named(own, "taken");
  const [again] = await Promise.all([own.waitForEvent("download"), own.click("#export")]);
  assert.equal(readFileSync(await again.path(), "utf8"), SQUARE.replaceAll("\n", "\r\n"));
  await projects(own);
  await own.locator("#examples button", { hasText: "surface.mpf" }).click();
  await named(own, "surface");
  assert.equal(await own.inputValue("#from"), "siemens");
});

page("a file that is dropped is a project", {}, async (own) => {
  const data = await own.evaluateHandle((text) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], "dropped.nc"));
    return transfer;
  }, SQUARE);
  await own.dispatchEvent("body", "dragenter", { dataTransfer: data });
  assert.ok(await own.isVisible("#drop"));
  await own.dispatchEvent("body", "drop", { dataTransfer: data });
  await named(own, "dropped");
});

page("a text in Western characters keeps its bytes", {}, async (own) => {
  const bytes = Buffer.from("%\r\nO1 (PE\xc7A)\r\nG21\r\nM30\r\n%\r\n", "latin1");
  await projects(own);
  await own.setInputFiles('#projects-dialog input[type="file"]', { name: "latin.nc", mimeType: "text/plain", buffer: bytes });
  await ready(own);
  assert.match(await own.locator("#editor .cm-content").textContent(), /PEÇA/);
  const [download] = await Promise.all([own.waitForEvent("download"), own.click("#export")]);
  assert.deepEqual(readFileSync(await download.path()), bytes);
});

page("a hostile program and name are text", {}, async (own) => {
  const evil = '<img src=x onerror="window.evil=1"><script>window.evil=1</script>';
  await projects(own);
  const file = { name: `${evil.replaceAll("/", "")}.nc`, mimeType: "text/plain", buffer: Buffer.from(`(${evil})\n${evil}\nG1 ${evil}\n`) };
  await own.setInputFiles('#projects-dialog input[type="file"]', file);
  await ready(own);
  await own.selectOption("#from", "fanuc");
  await ready(own);
  await own.locator("#problems-list button").first().hover();
  await projects(own);
  await own.waitForTimeout(200);
  assert.equal(await own.evaluate(() => window.evil), undefined);
  assert.equal(await own.locator("#work img, dialog img").count(), 0);
});

page("light and dark: the system's, then the button's", { colorScheme: "dark" }, async (own) => {
  assert.equal(await own.getAttribute("html", "data-theme"), "dark");
  const dark = await pixels(own, "#canvas", { ground: "--ground" });
  assert.ok(dark.ground > 10_000);
  await own.click("#theme");
  assert.equal(await own.getAttribute("html", "data-theme"), "light");
  assert.ok((await pixels(own, "#canvas", { ground: "--ground" })).ground > 10_000);
  await own.reload();
  await ready(own);
  assert.equal(await own.getAttribute("html", "data-theme"), "light");
});

page("English and Portuguese", { locale: "pt-BR" }, async (own) => {
  assert.equal(await own.getAttribute("html", "lang"), "pt-BR");
  assert.equal(await value(own, "#tab-translate"), "Tradução");
  await own.click("#language");
  await ready(own);
  assert.equal(await value(own, "#tab-translate"), "Translation");
});

for (const locale of ["en-US", "pt-BR"]) {
  page(`in 900 pixels nothing is cut off: ${locale}`, { width: 900, locale }, async (own) => {
    const fits = async (selectors) => {
      const found = await own.locator(selectors).evaluateAll((all) => all.map(({ id, className, scrollWidth, clientWidth }) => [id || className, scrollWidth - clientWidth]));
      assert.ok(found.length > 0);
      assert.deepEqual(found.filter(([, pixels]) => pixels > 0), [], selectors);
    };
    await fits("#top, #machine-pane .strip, #readout, #player");
    await own.click("#tab-setup");
    await fits("#setup-pane, #setup-pane .wide-table");
    await own.click("#tab-translate");
    await fits("#translate-pane .strip");
    await own.click("#projects-open");
    await fits("#projects-dialog");
  });
}

page("keys reach all of it", {}, async (own) => {
  await type(own, SQUARE);
  await own.keyboard.press("Control+Home");
  for (let at = 0; at < 8; at += 1) await own.keyboard.press("ArrowDown");
  await own.keyboard.press("Control+Enter");
  assert.equal(await value(own, "#now-block"), "9");
  await own.keyboard.press("Control+.");
  assert.equal(await value(own, "#now-block"), "10");
  await own.keyboard.press("Control+o");
  await own.locator("#projects-dialog[open]").waitFor();
  assert.ok(await own.isVisible("#projects-dialog"));
  await own.keyboard.press("Escape");
  await own.keyboard.press("Control+Shift+Enter");
  assert.equal(await own.getAttribute("#play", "aria-label"), "Pause");
  await own.keyboard.press("Control+Shift+Enter");
  assert.equal(await own.getAttribute("#play", "aria-label"), "Play");
  await own.locator("#canvas").focus();
  const frames = await own.getAttribute("#canvas", "data-frames");
  await own.keyboard.press("2");
  await own.waitForFunction((before) => document.querySelector("#canvas").dataset.frames !== before, frames);
  await own.locator("#tab-machine").focus();
  await own.keyboard.press("ArrowRight");
  assert.ok(await own.isVisible("#setup-pane"));
  await own.keyboard.press("ArrowRight");
  assert.ok(await own.isVisible("#output"));
});

const PHONE = { width: 390, height: 780, hasTouch: true, isMobile: true };

page("a phone has a pane at a time, with an editor", PHONE, async (own) => {
  await own.setViewportSize(PHONE);
  assert.ok(await own.isVisible("#editor"));
  assert.ok(!(await own.isVisible("#picture")));
  for (const [pane, seen] of [["machine", "#picture"], ["setup", "#setup-pane"], ["time", "#charts"], ["translate", "#output"], ["editor", "#editor"]]) {
    await own.click(`#phone [data-goto="${pane}"]`);
    assert.ok(await own.isVisible(seen), pane);
    const wide = await own.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= PHONE.width, `${pane}: ${wide}`);
  }
  await own.click('#phone [data-goto="machine"]');
  assert.ok((await pixels(own, "#canvas", { feed: "--c-move-feed" })).feed > 50);
});

test("a browser without SIMD in WebAssembly is told that it is too old", async () => {
  const context = await world().browser.newContext({ locale: "en-US" });
  const own = await context.newPage();
  await own.addInitScript(() => (WebAssembly.validate = () => false));
  await own.goto(world().site.url);
  await own.waitForSelector('#state[data-state="failed"]', { state: "attached" });
  assert.match(await value(own, "#problems-list"), /too old for the compiler/);
  await context.close();
});

test("a server without the compiler is told", { skip: !process.env.STUDIO_SITE && "STUDIO_SITE names no page" }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "ncc-studio-"));
  cpSync(process.env.STUDIO_SITE, folder, { recursive: true, filter: (name) => !name.endsWith("engine.wasm") });
  const site = await serve(folder);
  const own = await world().browser.newPage({ locale: "en-US" });
  try {
    await own.goto(site.url);
    await own.locator("#problems", { hasText: /did not load[^]*engine\.wasm: 404/ }).waitFor();
    assert.equal(await own.getAttribute("#state", "data-state"), "failed");
  } finally {
    await own.close();
    await site.close();
  }
});

test("ncc studio: a folder's programs are opened, saved back, and followed", { skip: !NCC && "NCC names no binary" }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "ncc-studio-"));
  const file = join(folder, "part.nc");
  writeFileSync(file, SQUARE);
  const server = await studio(folder);
  try {
    const { page: own, context, faults } = await open(world(), { address: server.address });
    assert.equal(await value(own, "#project-name"), "part.nc");
    await type(own, SQUARE.replace("(SQUARE)", "(TYPED)"));
    await own.waitForFunction(() => document.querySelector("#save-state").textContent === "Saved");
    assert.match(readFileSync(file, "utf8"), /TYPED/);
    writeFileSync(file, SQUARE.replace("(SQUARE)", "(ELSEWHERE)"));
    await own.locator("#editor .cm-line", { hasText: "ELSEWHERE" }).waitFor();
    await ready(own);
    await own.click("#tab-translate");
    await own.selectOption("#to", "siemens");
    await ready(own);
    assert.equal(await value(own, "#verdict"), "Verified: it does the same");
    assert.deepEqual(faults, []);
    await context.close();
  } finally {
    server.end();
  }
});

test("where WebGL 2 is missing, the page says so and does the rest", async () => {
  const script = () => {
    const own = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith("webgl") ? null : own.call(this, kind, ...rest);
    };
  };
  const { page: own, context, faults } = await open(world(), { script });
  assert.match(await value(own, "#picture-told"), /WebGL 2 is missing/);
  assert.equal(await own.locator("#charts canvas").count(), 3);
  assert.deepEqual(faults, []);
  await context.close();
});

test("without a network the page is there again", async () => {
  const { page: own, context } = await open(world());
  await own.evaluate(() => navigator.serviceWorker.ready);
  await context.setOffline(true);
  await own.reload();
  await ready(own);
  assert.ok(Number(await own.getAttribute("#canvas", "data-pieces")) > 50);
  await context.close();
});

test("two tabs on one project: the other one takes over what was saved", async () => {
  const { page: one, context } = await open(world());
  const { page: two } = await open(world(), { context });
  await type(one, SQUARE);
  await two.waitForFunction(() =>
    document.querySelector("#editor").shadowRoot.querySelector(".cm-content").textContent.includes("SQUARE"),
  );
  await context.close();
});

both("a program of 60,000 moves is drawn, and newer work takes the place of older", {}, async (own) => {
  const began = Date.now();
  await type(own, long(60_000));
  assert.equal(await own.getAttribute("#canvas", "data-pieces"), "60002");
  assert.ok(Date.now() - began < 20_000, `${Date.now() - began} ms`);
  for (const letter of "ABC") {
    await paste(own, `(${letter})`);
    await own.waitForTimeout(150);
  }
  await ready(own);
  assert.ok(Number(await own.getAttribute("#canvas", "data-pieces")) >= 60_002);
});

for (const [name, options] of [["wide and light", {}], ["wide and dark", { colorScheme: "dark" }], ["a phone", PHONE]]) {
  page(`axe finds nothing: ${name}`, options, async (own) => {
    await own.evaluate(readFileSync(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8"));
    const look = () => own.evaluate(async () => (await axe.run()).violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.target).join(" ")}`));
    assert.deepEqual(await look(), []);
    for (const pane of ["setup", "translate"]) {
      await own.click(options === PHONE ? `#phone [data-goto="${pane}"]` : `#tab-${pane}`);
      assert.deepEqual(await look(), [], pane);
    }
    await projects(own);
    assert.deepEqual(await look(), []);
  });
}

page("the editor follows while a program plays, however soon one part comes after another", {}, async (own) => {
  await type(own, long(20_000));
  await own.click("#to-start");
  await own.click("#play");
  const lines = await own.evaluate(async () => {
    const found = new Set();
    const editor = document.querySelector("#editor");
    for (let tries = 0; tries < 30; tries += 1) {
      await new Promise((done) => setTimeout(done, 100));
      const line = (editor.shadowRoot ?? editor).querySelector(".cm-line.now") ?? editor.querySelector(".cm-line.now");
      if (line) found.add(line.textContent);
    }
    return found.size;
  });
  await own.click("#play");
  assert.ok(lines >= 4, String(lines));
});
