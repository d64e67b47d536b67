// Active modes: of a block in the editor, at a moment in the read-out, and the spindle's runs in its chart.

import assert from "node:assert/strict";
import { SQUARE } from "./programs.mjs";
import { drawn, pixels, ready, type } from "./browser.mjs";
import { tests, value } from "./pages.mjs";

const { page, both } = tests();

/** A mode as the read-out or a tooltip shows it. */
const mode = (own, where, name) => own.locator(`${where} [data-mode="${name}"]`).first().textContent();

both("a block under the pointer tells the modes that are active there", {}, async (own) => {
  await type(own, SQUARE);
  await own.locator("#editor .cm-line", { hasText: "X50." }).first().hover({ position: { x: 8, y: 6 } });
  const about = own.locator("#editor .about .modes");
  await about.waitFor();
  const wanted = { motion: "G01", plane: "G17", distance: "G90", "work-offset": "G54", spindle: "M03", "length-offset": "G43 H1", feed: "F300", tool: "T1" };
  for (const [name, text] of Object.entries(wanted)) assert.equal(await mode(own, "#editor .about", name), text);
});

page("a key and a button tell the modes of the cursor's block, and Escape takes them away", {}, async (own) => {
  await type(own, SQUARE);
  await own.locator("#editor .cm-line", { hasText: "G3 X40." }).click();
  await own.keyboard.press("Control+i");
  const about = own.locator('#editor .about[role="status"]');
  await about.waitFor();
  assert.equal(await mode(own, "#editor .about", "motion"), "G03");
  await own.keyboard.press("Escape");
  await about.waitFor({ state: "detached" });
  await own.locator("#editor .cm-line", { hasText: "O0100" }).click();
  await own.click("#block-modes");
  await about.waitFor();
  assert.match(await about.textContent(), /Nothing is executed here/);
});

both("the read-out has coolant, offsets and codes, with the last change marked", {}, async (own) => {
  await type(own, SQUARE.replace("Y50.\n", "M8 Y50.\n").replace("X20. Y20.\n", "G55 X20. Y20.\n"));
  await own.click("#to-start");
  await own.locator("#editor .cm-line", { hasText: "M8 Y50." }).click();
  await own.keyboard.press("Control+Enter");
  assert.equal(await value(own, "#now-head"), "G54");
  assert.equal((await value(own, "#now-coolant")).trim(), "M08");
  assert.equal(await own.locator("#readout mark").count(), 1);
  assert.equal(await mode(own, "#now-offsets", "length-offset"), "G43 H1");
  assert.match(await value(own, "#now-codes"), /^G01 G17 G90 G94 G21/);
  assert.equal(await value(own, "#now-s"), "3000 M03");
  await own.click("#step-forward");
  assert.equal(await own.locator("#now-coolant mark").count(), 1);
  await own.locator("#editor .cm-line", { hasText: "G55" }).click();
  await own.keyboard.press("Control+Enter");
  assert.equal(await value(own, "#now-head"), "G55");
  assert.equal(await own.locator("#now-offsets mark").textContent(), "G55");
});


page("rotary axes have rows where one moves, and none elsewhere", {}, async (own) => {
  await type(own, SQUARE);
  assert.ok(!(await own.isVisible("#now-a")));
  await type(own, SQUARE.replace("G0 Z10.\nX20.", "G0 Z10.\nA90.\nX20."));
  await own.locator("#editor .cm-line", { hasText: "A90." }).click();
  await own.keyboard.press("Control+Enter");
  assert.ok(await own.isVisible("#now-a"));
  assert.equal(await value(own, "#now-a"), "90.000");
  assert.equal(await value(own, "#now-x-machine"), "–");
});

/** How many of the spindle chart's columns have ink between the speeds, off the axis and off the top. */
async function slope(own) {
  // Charts are drawn after the part.
  await drawn(own);
  return own.evaluate(() => {
    const canvas = document.querySelectorAll("#charts canvas")[1];
    const { data, width, height } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const style = getComputedStyle(document.documentElement).getPropertyValue("--c-move-clockwise").trim();
    const pen = document.createElement("canvas").getContext("2d");
    pen.fillStyle = style;
    pen.fillRect(0, 0, 1, 1);
    const ink = pen.getImageData(0, 0, 1, 1).data;
    const rows = new Map();
    for (let y = 0; y < height; y += 1)
      for (let x = 0; x < width; x += 1) {
        const at = (y * width + x) * 4;
        if ([0, 1, 2].every((channel) => Math.abs(data[at + channel] - ink[channel]) < 40)) rows.set(y, (rows.get(y) ?? new Set()).add(x));
      }
    const all = [...rows.keys()];
    const [top, bottom] = [Math.min(...all), Math.max(...all)];
    const middle = all.filter((y) => y > top + 4 && y < bottom - 4);
    const columns = new Set(middle.flatMap((y) => [...rows.get(y)]));
    return columns.size;
  });
}

both("the spindle runs up and down in slopes where its machine states how long, and in steps elsewhere", {}, async (own) => {
  // Of one speed, so that no line but a slope or a step lies between it and nothing.
  await type(own, SQUARE.replace("S2000", "S3000"));
  assert.ok((await slope(own)) < 8);
  await own.selectOption("#machine", "fanuc-vmc");
  await own.waitForTimeout(200);
  await ready(own);
  // That machine states 1.5 s for each.
  const [, clock] = (await value(own, "#clock")).split(" / ");
  const seconds = clock.split(":").reduce((sum, part) => sum * 60 + Number(part), 0);
  const { width } = await own.locator("#charts .u-over").first().boundingBox();
  const expected = (3 / seconds) * width;
  const columns = await slope(own);
  assert.ok(columns > expected * 0.6 && columns < expected * 1.5 + 6, `${columns} columns of ${expected}`);
  // All charts have one axis.
  await own.locator("#charts .u-over").first().click({ position: { x: width / 3, y: 5 } });
  const places = await own.locator("#charts .chart-now").evaluateAll((all) => all.map((one) => Math.round(one.getBoundingClientRect().left)));
  assert.equal(new Set(places).size, 1, places.join());
});
