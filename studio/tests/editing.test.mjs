// Commands of the editor: to a name's meaning, another name, layout and block numbers.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { MACRO, SQUARE } from "./programs.mjs";
import { line, ready, type } from "./browser.mjs";
import { tests, value } from "./pages.mjs";

const { page, both } = tests();

const text = (own) => own.locator("#editor").evaluate((host) => [...host.shadowRoot.querySelectorAll(".cm-line")].map((one) => one.textContent).join("\n"));

/** Puts the cursor into a text of a line. */
async function put(own, row, words) {
  const place = own.locator("#editor .cm-line", { hasText: row }).first();
  const box = await place.evaluate((element, wanted) => {
    const range = document.createRange();
    const walk = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
    let [all, from] = ["", element.textContent.lastIndexOf(wanted)];
    for (let node = walk.nextNode(); node; all += node.textContent, node = walk.nextNode()) {
      if (all.length <= from && from < all.length + node.textContent.length) {
        range.setStart(node, from - all.length);
        range.setEnd(node, from - all.length + 1);
      }
    }
    const { left, top, height } = range.getBoundingClientRect();
    return { x: left + 2, y: top + height / 2 };
  }, words);
  return box;
}

both("F12, Ctrl+click and a button lead from a call, a jump and a loop's end to what is meant", {}, async (own) => {
  await type(own, MACRO);
  // What is told under the pointer lies over the lines before: it goes when the pointer does.
  const leave = () => own.mouse.move(900, 300);
  const at = async (row, words) => (await own.mouse.click(...Object.values(await put(own, row, words))), leave());
  await at("M98 P2000", "P2000");
  await own.keyboard.press("F12");
  await own.waitForFunction(() => document.querySelector("#editor").shadowRoot.querySelector(".cm-activeLineGutter").textContent === "12");
  await own.keyboard.press("F12");
  await own.waitForFunction(() => document.querySelector("#editor").shadowRoot.querySelector(".cm-activeLineGutter").textContent === "10");
  const jump = await put(own, "GOTO10", "10");
  await own.keyboard.down("Control");
  await own.mouse.click(jump.x, jump.y);
  await own.keyboard.up("Control");
  await own.waitForFunction(() => document.querySelector("#editor").shadowRoot.querySelector(".cm-activeLineGutter").textContent === "7");
  await at("END1", "END1");
  await own.keyboard.press("End");
  await own.click("#go-to");
  await own.waitForFunction(() => document.querySelector("#editor").shadowRoot.querySelector(".cm-activeLineGutter").textContent === "14");
  await at("G0 X0.", "G0");
  await own.click("#go-to");
  await own.waitForFunction(() => /No name at the cursor/.test(document.querySelector("#editor-told").textContent));
});

both("F2 gives a variable another name at all places, as one step back", {}, async (own) => {
  await type(own, MACRO);
  const before = await text(own);
  await own.mouse.click(...Object.values(await put(own, "LE3", "#100")));
  await own.keyboard.press("F2");
  const dialog = own.locator("#editor-dialog[open]");
  await dialog.waitFor();
  assert.match(await value(own, "#editor-dialog-title"), /100: 5 places Other files that use it are not changed\./);
  await own.keyboard.type("#101");
  await own.keyboard.press("Enter");
  await dialog.waitFor({ state: "detached" });
  assert.equal((await text(own)).match(/#101/g).length, 5);
  assert.equal((await text(own)).replaceAll("#101", "#100"), before);
  await own.keyboard.press("Control+z");
  assert.equal(await text(own), before);
  await ready(own);
});

page("a name that cannot be shown to be complete keeps its name, with the reason", {}, async (own) => {
  await type(own, MACRO.replace("S100 M3\n", "S100 M3\n#[99+2]=1\n"));
  const before = await text(own);
  await own.mouse.click(...Object.values(await put(own, "LE3", "#100")));
  await own.click("#rename-name");
  await own.locator("#editor-dialog[open]").waitFor();
  await own.keyboard.type("#102");
  await own.keyboard.press("Enter");
  const wrong = own.locator("#editor-dialog .wrong", { hasText: "computed number of a variable" });
  await wrong.waitFor();
  assert.equal(await text(own), before);
  await own.keyboard.press("Escape");
  assert.ok(!(await own.isVisible("#editor-dialog")));
});

both("a program is laid out and renumbered, each as one step back", {}, async (own) => {
  await type(own, SQUARE.replace("G1 Z-2. F300.", "g1z-2.f300."));
  const before = await text(own);
  await own.click("#lay-out");
  await own.waitForFunction(() => /Lines changed/.test(document.querySelector("#editor-told").textContent));
  assert.match(await text(own), /\nG01 Z-2\. F300\.\n/);
  await own.keyboard.press("Control+z");
  assert.equal(await text(own), before);
  await own.click("#renumber");
  await own.getByLabel("First number").fill("100");
  await own.getByLabel("Step").fill("5");
  await own.keyboard.press("Enter");
  await own.waitForFunction(() => /Lines changed/.test(document.querySelector("#editor-told").textContent));
  assert.match(await text(own), /\nN100 G21[^]*\nN105 T1/);
  await own.locator("#editor .cm-content").focus();
  await own.keyboard.press("Control+z");
  assert.equal(await text(own), before);
  await own.keyboard.press("Shift+Alt+F");
  await own.waitForFunction(() => document.querySelector("#editor").shadowRoot.textContent.includes("G01 Z-2."));
});

page("a phone has the commands as buttons", { width: 390, height: 780, hasTouch: true, isMobile: true }, async (own) => {
  await type(own, MACRO);
  await own.locator("#editor .cm-line", { hasText: "M98 P2000" }).tap();
  await own.tap("#go-to");
  await own.waitForFunction(() => document.querySelector("#editor").shadowRoot.querySelector(".cm-activeLineGutter").textContent === "12");
  assert.ok((await own.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  assert.equal(await line(own), 12);
});

const PHONE = { width: 390, height: 780, hasTouch: true, isMobile: true };
for (const [name, options] of [["light", {}], ["dark", { colorScheme: "dark" }], ["a phone", PHONE]]) {
  page(`axe finds nothing in the dialog, the modes and the moves: ${name}`, options, async (own) => {
    await own.evaluate(readFileSync(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8"));
    const look = () => own.evaluate(async () => (await axe.run()).violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.target).join(" ")}`));
    await type(own, MACRO.replace("#100=1", "#100=1 (<b>)"));
    await own.locator("#editor .cm-line", { hasText: "LE3" }).click();
    await own.click("#rename-name");
    await own.locator("#editor-dialog[open]").waitFor();
    assert.deepEqual(await look(), []);
    await own.keyboard.press("Escape");
    await own.locator("#editor .cm-line", { hasText: "G1 Y#1" }).click();
    await own.click("#block-modes");
    await own.locator('#editor .about[role="status"]').waitFor();
    assert.deepEqual(await look(), []);
    await own.click(options === PHONE ? '#phone [data-goto="translate"]' : "#tab-translate");
    await own.selectOption("#to", "siemens");
    await ready(own);
    await own.locator("#moves-box summary").click();
    await own.click("#moves-compare");
    await own.waitForFunction(() => /same|·|→|off|only/.test(document.querySelector("#moves-told").textContent));
    assert.deepEqual(await look(), []);
  });
}
