// The picture of the machine: sections, measuring, material, colours, plan, what is on the machine.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { drawn, line, pixels, placeOf, ready, type } from "./browser.mjs";
import { tests, value } from "./pages.mjs";
import { STL, SQUARE, long } from "./programs.mjs";

const { page, both } = tests();
const data = (own, name) => own.getAttribute("#canvas", `data-${name}`);

/** A slot 10 mm wide and 4 mm deep along X through the middle of a block of 80 × 40 × 20 mm. */
const SLOT = `%
O0201 (SLOT)
G21 G17 G90 G94 G40 G49 G80
T1 M6 (FLAT D=10.)
G54 G0 X-50. Y0. S3000 M3
G43 H1 Z20.
Z-4.
G1 X50. F500.
G0 Z20.
T2 M6 (DRILL D=6.)
G0 X20. Y12. S2000 M3
G43 H2 Z10.
G1 Z-8. F150.
G0 Z20.
T1 M6
G0 X-20. Y12.
G43 H1 Z10.
G1 Z-2. F900.
G0 Z20.
M5
M30
%
`;

/** Opens the slot in its block. */
async function slot(own, program = SLOT) {
  await type(own, program);
  await own.click("#tab-setup");
  await own.getByLabel("Raw part", { exact: true }).selectOption("block");
  await own.waitForTimeout(200);
  await ready(own);
  for (const [name, size] of [["X−", -40], ["X+", 40], ["Y−", -20], ["Y+", 20], ["Z−", -20], ["Z+", 0]]) {
    await own.getByLabel(`Raw part ${name}`).fill(String(size));
    await own.keyboard.press("Tab");
    await own.waitForTimeout(250);
    await ready(own);
  }
  await own.click("#tab-machine");
  await own.waitForTimeout(200);
}

both("a section is filled, has the area of the cut face, and moves by slider, number and keys", {}, async (own) => {
  await slot(own);
  const inks = { face: "--part-face" };
  // The tool has nearly that colour in places.
  const none = (await pixels(own, "#canvas", inks)).face;
  await own.click('[data-side="right"]');
  await own.click("#section-toggle");
  await own.getByRole("button", { name: "Section across X" }).click();
  // 40 × 20 mm less the slot of 10 × 4 mm.
  const area = async () => Number(await data(own, "section"));
  assert.ok(Math.abs((await area()) - 760) < 4, String(await area()));
  for (const kind of [0, 1]) await own.click(`#kind-${kind}`);
  const filled = (await pixels(own, "#canvas", inks)).face;
  assert.ok(filled > none + 5_000, `${filled}, ${none} without`);
  // At the hole of 6 mm: a cone of 118 degrees on a cylinder, and no slot beside it changes.
  await own.getByLabel("Place mm").fill("20");
  const cone = 9 / Math.tan((59 * Math.PI) / 180);
  const hole = 6 * 8 - cone;
  assert.ok(Math.abs((await area()) - (760 - hole)) < 4, `${await area()} for ${760 - hole}`);
  const before = await own.getByLabel("Place mm").inputValue();
  await own.locator("#canvas").focus();
  await own.keyboard.press("]");
  assert.notEqual(await own.getByLabel("Place mm").inputValue(), before);
  await own.getByLabel("Place", { exact: true }).focus();
  await own.keyboard.press("Home");
  assert.equal(Number(await own.getByLabel("Place mm").inputValue()), -40);
  await own.locator("#canvas").focus();
  await own.keyboard.press("z");
  await own.getByLabel("Place mm").fill("-1");
  // All but slot, hole and the round pocket of the first tool.
  const level = 80 * 40 - 80 * 10 - Math.PI * 9 - Math.PI * 25;
  assert.ok(Math.abs((await area()) - level) < 12, `${await area()} for ${level}`);
  await own.keyboard.press("z");
  await own.waitForTimeout(100);
  await own.locator("#canvas").focus();
  await own.keyboard.press("z");
  assert.ok(!(await own.isVisible("#section-card")));
  assert.ok((await pixels(own, "#canvas", inks)).face < filled / 3);
});

/** As `SLOT`, 12 mm deep and 8 mm wide, and a T-slot cutter along its bottom. */
const UNDERCUT = `%
O0202 (UNDERCUT)
(T1 D=8. CR=0. - FLAT END MILL)
(T2 D=16. CR=0. - T-SLOT MILL)
G21 G17 G90 G94 G40 G49 G80
T1 M6
G54 G0 X-50. Y0. S3000 M3
G43 H1 Z20.
Z-12.
G1 X50. F500.
G0 Z20.
T2 M6
G0 X-60. Y0. S2000 M3
G43 H2 Z20.
Z-12.
G1 X60. F150.
G0 Z20.
M5
M30
%
`;

both("an undercut is seen from the side, in a section, in its area and under the pointer", {}, async (own) => {
  await slot(own, UNDERCUT);
  await own.click("#to-end");
  await ready(own);
  await own.waitForFunction(() => Number(document.querySelector("#canvas").dataset.faces) > 10);
  assert.ok(Number(await data(own, "faces")) < 5_000, await data(own, "faces"));
  for (const kind of [0, 1]) await own.click(`#kind-${kind}`);
  // From the right end one looks through the block where the slot is, and beside it where the disc was.
  await own.click('[data-side="right"]');
  const open = async () => (await pixels(own, "#canvas", { ground: "--ground" })).ground;
  const after = await open();
  const scale = Number(await data(own, "scale"));
  const thick = Number(await data(own, "tool").then((tool) => JSON.parse(tool)[1]));
  await own.click("#section-toggle");
  await own.getByRole("button", { name: "Section across X" }).click();
  const area = async () => Number(await data(own, "section"));
  // 40 × 20 mm less a slot of 8 × 12 mm and twice 4 mm beside it, as high as the disc is thick.
  assert.ok(Math.abs((await area()) - (800 - 96 - 8 * thick)) < 4, `${await area()}, disc of ${thick}`);
  await own.click("#section-toggle");
  await own.selectOption("#colouring", "tool");
  await own.click('[data-side="iso"]');
  // The wall that the disc has left has the second tool's colour, and leads to its block.
  const [x, y] = await placeOf(own, "", { spread: 45, green: 0.8 });
  await own.mouse.click(x, y);
  assert.equal(await line(own), 16);
  // Without the disc the block hides what was seen beside the slot.
  await own.click('[data-side="right"]');
  await type(own, UNDERCUT.replace("G1 X60. F150.\n", ""));
  await own.click("#to-end");
  await ready(own);
  await own.waitForFunction(() => document.querySelector("#canvas").dataset.faces === "0");
  const hidden = (after - (await open())) / scale ** 2;
  // Lines of the grid and the axes are seen there, too.
  assert.ok(hidden > 0.8 * 8 * thick && hidden < 1.02 * 8 * thick, `${hidden} mm² for ${8 * thick}`);
});

/** A hole from the right, along X. */
const TILTED = `%
O0203 (TILTED)
(T1 D=8. - DRILL)
G21 G17 G90 G94 G40 G49 G80
T1 M6
G54 G0 X-10. Y0. S1000 M3
G68.2 X0. Y0. Z0. I90. J90. K0.
G53.1
G43 H1 Z20.
G0 X0. Y-10. Z20.
G1 Z-10. F100.
G0 Z20.
G69
M5
M30
%
`;

both("the tool leans on a tilted plane, and what it takes there is drawn", {}, async (own) => {
  await type(own, TILTED);
  await own.click("#to-start");
  await ready(own);
  assert.equal(await data(own, "leans"), "0.0000 0.0000 1.0000");
  await own.click("#to-end");
  await ready(own);
  const [x, y, z] = (await data(own, "leans")).split(" ").map(Number);
  assert.deepEqual([x, y, z], [1, 0, 0]);
  await own.waitForFunction(() => Number(document.querySelector("#canvas").dataset.faces) > 10);
});

both("places on the part are measured: edges and cells by clicks, numbers, and where the tool is", {}, async (own) => {
  await slot(own);
  await own.click('[data-side="top"]');
  for (const kind of [0, 1]) await own.click(`#kind-${kind}`);
  await own.click("#measure-toggle");
  const box = await own.locator("#canvas").boundingBox();
  // The widest that is seen of the part, from its pixels: 80 mm.
  const scale = await own.evaluate(() => document.querySelector("#canvas").dataset.scale);
  const at = (x, y) => [box.x + box.width / 2 + x * Number(scale), box.y + box.height / 2 - y * Number(scale)];
  await own.mouse.click(...at(10, 5.3));
  await own.mouse.click(...at(10, -5.3));
  const [dx, dy, dz] = (await data(own, "measured")).split(" ").map(Number);
  assert.ok(Math.abs(dx) < 0.2 && Math.abs(dy + 10) < 0.2, `${dx} ${dy} ${dz}`);
  assert.match(await value(own, "#measure-card"), /edge/);
  await own.mouse.click(...at(30, 0));
  await own.mouse.click(...at(30, 15));
  const [, , up] = (await data(own, "measured")).split(" ").map(Number);
  assert.ok(Math.abs(up - 4) < 0.01, String(up));
  for (const [name, typed] of [["A X", 1], ["A Y", 2], ["A Z", 3], ["B X", 4], ["B Y", 6], ["B Z", 3]]) {
    await own.getByLabel(name, { exact: true }).fill(String(typed));
    await own.keyboard.press("Tab");
  }
  assert.match(await value(own, "#measured"), /5\.000 mm.*3\.000 mm.*4\.000 mm.*0\.000 mm/);
  await own.click("#to-start");
  await own.click("#step-forward");
  await own.getByRole("button", { name: "B: At the tool" }).click();
  assert.match(await own.locator("#measure-card").textContent(), /tool/);
  assert.equal(await own.locator(".tag.place").count(), 2);
  await own.locator("#canvas").focus();
  await own.keyboard.press("m");
  assert.equal(await own.locator(".tag.place").count(), 0);
});

page("lengths are measured in the program's unit", {}, async (own) => {
  await type(own, SQUARE.replace("G21", "G20").replaceAll(/([XYZIJR])(-?[\d.]+)/g, (_, letter, size) => `${letter}${(Number(size) / 25.4).toFixed(4)}`));
  await own.click("#measure-toggle");
  for (const name of ["A X", "B X"]) {
    await own.getByLabel(name, { exact: true }).fill(name === "B X" ? "1" : "0");
    await own.keyboard.press("Tab");
  }
  assert.match(await value(own, "#measured"), /1\.0000 inch/);
  assert.match(await data(own, "measured"), /^1\.0000 /);
});

page("material and light: presets, wireframe, own colour, kept in the browser", {}, async (own) => {
  await slot(own);
  for (const kind of [0, 1]) await own.click(`#kind-${kind}`);
  await own.click('[data-side="top"]');
  const inks = { brass: "#b5914a", blue: "#2f6fb5" };
  const plain = await pixels(own, "#canvas", inks);
  await own.click("#look-toggle");
  await own.selectOption("#material", "plastic");
  const plastic = await pixels(own, "#canvas", inks);
  assert.ok(plastic.blue > plain.blue + 3_000, JSON.stringify([plain, plastic]));
  await own.getByRole("button", { name: "Wireframe" }).click();
  const wire = await pixels(own, "#canvas", inks);
  assert.ok(wire.blue < plastic.blue * 0.7 && wire.blue > 200, JSON.stringify(wire));
  await own.getByRole("button", { name: "Wireframe" }).click();
  await own.getByLabel("Brightness").focus();
  await own.keyboard.press("Home");
  assert.ok((await pixels(own, "#canvas", inks)).blue < plastic.blue * 0.5);
  await own.reload();
  await ready(own);
  assert.equal(await own.inputValue("#material"), "plastic");
  await own.click("#look-toggle");
  await own.getByRole("button", { name: "Reset" }).click();
  assert.equal(await own.inputValue("#material"), "plain");
});

both("path and part have colours by tool, operation, feed, depth and time, with a legend", {}, async (own) => {
  await slot(own);
  await own.click('[data-side="top"]');
  const inks = { zero: "--c-tool-0", one: "--c-tool-1", two: "--c-tool-2", low: "--scale-0", high: "--scale-3" };
  await own.click("#part");
  const by = async (name) => {
    await own.selectOption("#colouring", name);
    return pixels(own, "#canvas", inks);
  };
  const kind = await by("kind");
  const tool = await by("tool");
  assert.ok(tool.one > kind.one + 20 && tool.two === kind.two, JSON.stringify([kind, tool]));
  assert.match(await value(own, "#colours"), /T1T2/);
  const operation = await by("operation");
  assert.ok(operation.two > kind.two, JSON.stringify(operation));
  assert.match(await value(own, "#colours"), /1: T12: T23: T1/);
  const feed = await by("feed");
  assert.match(await value(own, "#colours"), /Feed, mm\/min150900/);
  assert.notDeepEqual(feed, kind);
  await by("depth");
  assert.match(await value(own, "#colours"), /Z, mm-8\.00/);
  const time = await by("time");
  assert.match(await value(own, "#colours"), /Time0:00\.0\d/);
  assert.ok(time.low > kind.low, JSON.stringify(time));
  // The part by time: the slot is early and nearly blue, what is cut late is red.
  await own.click("#part");
  for (const kind of [0, 1]) await own.click(`#kind-${kind}`);
  const plain = await by("kind");
  assert.ok(!(await own.isVisible("#colours")));
  const cut = await by("time");
  assert.ok(cut.zero > plain.zero + 5_000 && cut.one > plain.one + 500, JSON.stringify([plain, cut]));
});

both("the plan shows the moves from above with the frame of the raw part, alone and beside the picture", {}, async (own) => {
  await type(own, SQUARE);
  assert.ok(!(await own.isVisible("#plan")));
  await own.click("#view-2d");
  assert.ok((await own.isVisible("#plan")) && (await own.isVisible("#canvas")));
  const inks = { feed: "--c-move-feed", rapid: "--c-move-rapid", frame: "--dim" };
  const seen = await pixels(own, "#plan", inks);
  assert.ok(seen.feed > 150 && seen.frame > 60, JSON.stringify(seen));
  const [left, right] = [await own.locator("#plan").boundingBox(), await own.locator("#canvas").boundingBox()];
  assert.ok(Math.abs(left.width - right.width) < 2 && left.x + left.width <= right.x + 1);
  await own.locator("#plan").focus();
  for (let at = 0; at < 4; at += 1) await own.keyboard.press("+");
  assert.notDeepEqual(await pixels(own, "#plan", inks), seen);
  await own.keyboard.press("f");
  // The ring of the focus has nearly the colour of a feed.
  await own.locator("#plan").blur();
  assert.ok(Math.abs((await pixels(own, "#plan", inks)).feed - seen.feed) < seen.feed * 0.2);
  await own.click("#view-3d");
  assert.ok(!(await own.isVisible("#canvas")));
  assert.ok((await pixels(own, "#plan", inks)).feed > 300);
  await own.click("#view-2d");
  assert.ok(await own.isVisible("#plan"), "one view is always there");
  await own.click("#view-3d");
  await own.locator("#canvas").focus();
  await own.keyboard.press("5");
  assert.ok(!(await own.isVisible("#plan")));
});

page("the time of a picture is shown on wish, and nothing is drawn while nothing changes", {}, async (own) => {
  await own.click("#look-toggle");
  assert.ok(!(await own.isVisible("#frame-time")));
  await own.click("#timing");
  await own.waitForFunction(() => /ms$/.test(document.querySelector("#frame-time").textContent));
  await own.click("#frame-time");
  assert.match(await value(own, "#frame-time"), /\/s$/);
  await own.click("#section-toggle");
  await own.click("#view-2d");
  await own.waitForTimeout(600);
  const frames = await data(own, "frames");
  await own.waitForTimeout(1200);
  assert.equal(await data(own, "frames"), frames);
});

page("by software a picture has smooth edges once nothing moves, and a quarter of the pixels until then", {}, async (own) => {
  await drawn(own);
  const calm = () => own.evaluate(() => [document.querySelector("#canvas")].map(({ width, clientWidth, dataset }) => [width / clientWidth, dataset.rough, Number(dataset.smoothed)])[0]);
  const [, , smoothed] = await calm();
  assert.deepEqual(await calm(), [2, undefined, smoothed]);
  const moving = await own.evaluate(async () => {
    const canvas = document.querySelector("#canvas");
    const { frames } = canvas.dataset;
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "+" }));
    while (canvas.dataset.frames === frames) await new Promise(requestAnimationFrame);
    return [canvas.dataset.rough, getComputedStyle(canvas).objectFit];
  });
  assert.deepEqual(moving, ["", "none"]);
  await drawn(own);
  assert.deepEqual(await calm(), [2, undefined, smoothed + 1]);
});

both("many moves are lines for several where the device draws slowly, and a click finds its move all the same", {}, async (own) => {
  await type(own, long(20_000));
  await drawn(own);
  // Nothing is lost that the picture could show, and nothing is said.
  assert.match(await data(own, "fineness"), / [01]$/);
  assert.doesNotMatch(await value(own, "#scale"), / px/);
  await type(own, long(310_000));
  // So many bends are more than such a device draws to half a pixel.
  await own.waitForFunction(() => /path within [1-9]\d* px/.test(document.querySelector("#scale").textContent));
  assert.match(await data(own, "fineness"), / (?:[248]|[1-9]\d+)$/);
  assert.equal(await data(own, "pieces"), "310002");
  await own.click("#part");
  await own.click('[data-side="top"]');
  const at = await placeOf(own, "--c-move-feed");
  await own.mouse.click(...at);
  const line = Number(await data(own, "marked"));
  assert.ok(line > 6, String(line));
  // Its end is where the click was: the tool is there now.
  const box = await own.locator("#canvas").boundingBox();
  const scale = Number(await data(own, "scale"));
  const [x, y] = await Promise.all(["x", "y"].map(async (axis) => Number(await value(own, `#now-${axis}`))));
  const middle = await own.evaluate(() => JSON.parse(document.querySelector("#canvas").dataset.middle));
  const seen = [box.x + box.width / 2 + (x - middle[0]) * scale, box.y + box.height / 2 - (y - middle[1]) * scale];
  assert.ok(Math.hypot(seen[0] - at[0], seen[1] - at[1]) < 8, `${seen} for ${at}`);
});

page("how fine the device can draw is known from the first pictures, before anybody seeks", {}, async (own) => {
  const before = Number(await data(own, "frames"));
  await type(own, long(310_000));
  await own.waitForFunction((count) => Number(document.querySelector("#canvas").dataset.frames) >= count + 3, before);
  await own.waitForTimeout(2500);
  const fineness = await data(own, "fineness");
  const frames = Number(await data(own, "frames"));
  for (const share of [0.5, 0.1, 0.9]) {
    await own.locator("#scrub").evaluate((scrub, at) => {
      scrub.value = String(at * scrub.max);
      scrub.dispatchEvent(new Event("input", { bubbles: true }));
    }, share);
    await own.waitForTimeout(1200);
  }
  assert.ok(Number(await data(own, "frames")) > frames);
  assert.equal(await data(own, "fineness"), fineness);
});

both("an edit brings one part, and the picture as fine as it was", {}, async (own) => {
  await type(own, SLOT);
  await own.locator("#editor .cm-content").click();
  await own.keyboard.press("Control+Home");
  await own.waitForTimeout(2500);
  // Without those that only smooth the edges, by software, once nothing moves.
  const pictures = async () => Number(await data(own, "frames")) - Number(await data(own, "smoothed"));
  const [shown, before, fineness] = [Number(await data(own, "shown")), await pictures(), await data(own, "fineness")];
  await own.evaluate(() => {
    window.compiled = 0;
    const { compileShader } = WebGL2RenderingContext.prototype;
    WebGL2RenderingContext.prototype.compileShader = function (...given) {
      window.compiled += 1;
      return compileShader.apply(this, given);
    };
  });
  await own.keyboard.press("Enter");
  await own.waitForFunction((before) => Number(document.querySelector("#canvas").dataset.shown) > before, shown);
  await ready(own);
  await own.waitForTimeout(1500);
  assert.equal(Number(await data(own, "shown")), shown + 1);
  assert.equal(await data(own, "fineness"), fineness);
  // The cursor, the part, and what the mark of a line may need: no row of pictures on trial.
  const count = (await pictures()) - before;
  assert.ok(count >= 1 && count <= 3, String(count));
  assert.equal(await own.evaluate(() => window.compiled), 0);
});

const PHONE = { width: 390, height: 780, hasTouch: true, isMobile: true };
for (const [name, options] of [["wide and light", {}], ["wide and dark", { colorScheme: "dark" }], ["a phone", PHONE]]) {
  page(`axe finds nothing in the cards and the plan: ${name}`, options, async (own) => {
    await own.evaluate(readFileSync(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8"));
    if (options === PHONE) await own.click('#phone [data-goto="machine"]');
    const look = () => own.evaluate(async () => (await axe.run()).violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.target).join(" ")}`));
    for (const card of ["section", "measure", "look"]) {
      await own.click(`#${card}-toggle`);
      assert.deepEqual(await look(), [], card);
      if (options === PHONE) {
        const wide = await own.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(wide <= PHONE.width, `${card}: ${wide}`);
      }
      await own.click(`#${card}-toggle`);
    }
    await own.click("#view-2d");
    assert.deepEqual(await look(), []);
  });
}

both("fixtures are stated, drawn, kept, and a tool that touches one is told", {}, async (own) => {
  await slot(own);
  const inks = { fixture: "#6b61a0" };
  const none = (await pixels(own, "#canvas", inks)).fixture;
  await own.click("#tab-setup");
  await own.getByRole("button", { name: "Add a block" }).click();
  await ready(own);
  for (const [name, size] of [["Z+", 5], ["X−", 41], ["X+", 60]]) {
    await own.getByLabel(`Fixture 1 ${name}`).fill(String(size));
    await own.keyboard.press("Tab");
    await own.waitForTimeout(250);
    await ready(own);
  }
  assert.ok((await own.locator("#problems-list").textContent()).includes("fixture"), await own.locator("#problems-list").textContent());
  await own.click("#tab-machine");
  const one = (await pixels(own, "#canvas", inks)).fixture;
  assert.ok(one > none + 400, `${one}, ${none} without`);
  await own.click("#tab-setup");
  await own.getByRole("button", { name: "Delete: Fixture 1" }).click();
  await own.waitForTimeout(250);
  await ready(own);
  await own.setInputFiles('#fixtures input[type="file"]', { name: "clamp.stl", mimeType: "model/stl", buffer: Buffer.from(STL) });
  await own.waitForTimeout(250);
  await ready(own);
  assert.match(await value(own, "#fixtures"), /clamp\.stl/);
  assert.ok((await own.locator("#problems-list").textContent()).includes("fixture"), await own.locator("#problems-list").textContent());
  await own.click("#tab-machine");
  const body = (await pixels(own, "#canvas", inks)).fixture;
  assert.ok(body > none + 50, `${body}, ${none} without`);
  if ((await own.locator("#save-state").textContent()) !== "Saved") await own.waitForFunction(() => document.querySelector("#save-state").textContent === "Saved");
});

both("shank and holder of a tool are stated and drawn, and zeros of work offsets are named", {}, async (own) => {
  await slot(own);
  assert.deepEqual(await own.locator(".tag.zero").allTextContents(), ["G54"]);
  await own.click('[data-side="front"]');
  const inks = { ground: "--ground" };
  // The tool stands above what is fitted into the picture.
  const away = async () => {
    await own.locator("#canvas").focus();
    await own.keyboard.press("f");
    for (let at = 0; at < 5; at += 1) await own.keyboard.press("-");
  };
  await away();
  const none = (await pixels(own, "#canvas", inks)).ground;
  await own.click("#tab-setup");
  for (const [label, size] of [["Flutes T1", 20], ["Shank ⌀ T1", 12], ["Holder ⌀ T1", 40], ["Holder from T1", 30]]) {
    await own.getByLabel(label).fill(String(size));
    await own.keyboard.press("Tab");
    await own.waitForTimeout(250);
    await ready(own);
  }
  // What was stated before one length is whole is not lost while the next is typed.
  assert.equal(await own.getByLabel("Holder ⌀ T1").inputValue(), "40");
  await own.click("#tab-machine");
  await away();
  const seen = await own.evaluate(() => document.querySelector("#canvas").dataset.tool);
  assert.deepEqual(JSON.parse(seen).slice(1), [20, 12, [40, 30]]);
  // Shank and holder hide some of the ground.
  const left = (await pixels(own, "#canvas", inks)).ground;
  assert.ok(left < none - 1_000, `${left} of ${none}`);
});

page("cells of the part are chosen, and the picture tells them", {}, async (own) => {
  await type(own, SQUARE);
  await own.waitForFunction(() => /part 1024 × 1024 cells of 0\.07\d mm/.test(document.querySelector("#scale").textContent));
  await own.click("#tab-setup");
  await own.selectOption("#cells", "256");
  await own.waitForTimeout(250);
  await ready(own);
  await own.click("#tab-machine");
  await own.waitForFunction(() => /256 × 256/.test(document.querySelector("#scale").textContent));
});
