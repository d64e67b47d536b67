// Pictures of the studio, each of a program of the corpus: `node make.mjs FOLDER [NAME]`, with NCC naming the binary.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { crc32, deflateSync } from "node:zlib";
import { service, studio } from "../../studio/tests/binary.mjs";
import { begin, open, ready } from "../../studio/tests/browser.mjs";

const [folder, only] = process.argv.slice(2);
/** Bytes of a picture at most. */
const MOST = 150_000;

/** Drags the moment to a share of the program. */
const moment = (page, share) =>
  page.locator("#scrub").evaluate((scrub, share) => {
    scrub.value = String(Number(scrub.max) * share);
    scrub.dispatchEvent(new Event("input", { bubbles: true }));
  }, share);

/** A picture in at most 256 colours: a third of its bytes, and nobody sees it. */
async function fewer(page, shot) {
  const [width, height, text] = await page.evaluate(async (source) => {
    const image = new Image();
    image.src = source;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const pen = canvas.getContext("2d");
    pen.drawImage(image, 0, 0);
    const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
    let text = "";
    for (let at = 0; at < data.length; at += 8192) text += String.fromCharCode(...data.subarray(at, at + 8192));
    return [canvas.width, canvas.height, btoa(text)];
  }, `data:image/png;base64,${shot.toString("base64")}`);
  const pixels = Buffer.from(text, "base64");
  const rounded = Uint32Array.from({ length: width * height }, (_, at) => {
    const [red, green, blue] = [0, 1, 2].map((channel) => pixels[at * 4 + channel] >> 2);
    return (red << 12) | (green << 6) | blue;
  });
  const counts = new Map();
  for (const colour of rounded) counts.set(colour, (counts.get(colour) ?? 0) + 1);
  const parts = (colour) => [colour >> 12, (colour >> 6) & 63, colour & 63];
  const often = [...counts].sort((a, b) => b[1] - a[1]).map(([colour]) => colour);
  // The most frequent ones, then those that differ most from what is there: a small dot keeps its colour.
  const palette = often.slice(0, 192);
  const distance = (a, b) => parts(a).reduce((sum, value, channel) => sum + (value - parts(b)[channel]) ** 2, 0);
  const rest = often.slice(192).filter((colour) => counts.get(colour) > 3);
  const far = rest.map((colour) => Math.min(...palette.map((one) => distance(one, colour))));
  while (palette.length < 256 && rest.length > 0) {
    const next = rest[far.indexOf(Math.max(...far))];
    palette.push(next);
    rest.forEach((colour, at) => (far[at] = Math.min(far[at], distance(next, colour))));
    if (Math.max(...far) === 0) break;
  }
  const nearest = (colour) => {
    const far = palette.map((one) => distance(one, colour));
    return far.indexOf(Math.min(...far));
  };
  const places = new Map([...counts.keys()].map((colour) => [colour, nearest(colour)]));
  // Each row begins with the number of its filter: none.
  const rows = Buffer.alloc((width + 1) * height);
  rounded.forEach((colour, at) => (rows[at + 1 + Math.floor(at / width)] = places.get(colour)));
  const head = Buffer.from([...bytes4(width), ...bytes4(height), 8, 3, 0, 0, 0]);
  const colours = Buffer.from(palette.flatMap((colour) => parts(colour).map((value) => Math.round((value * 255) / 63))));
  const chunks = [["IHDR", head], ["PLTE", colours], ["IDAT", deflateSync(rows, { level: 9 })], ["IEND", Buffer.alloc(0)]];
  return Buffer.concat([Buffer.from("\x89PNG\r\n\x1a\n", "latin1"), ...chunks.map(([name, data]) => chunk(name, data))]);
}

const bytes4 = (value) => [24, 16, 8, 0].map((shift) => (value >>> shift) & 255);

/** A part of a PNG: its length, name, bytes and check. */
function chunk(name, data) {
  const named = Buffer.concat([Buffer.from(name), data]);
  return Buffer.concat([Buffer.from(bytes4(data.length)), named, Buffer.from(bytes4(crc32(named)))]);
}

const PICTURES = [
  {
    name: "studio-machine",
    program: "corpus/fanuc/pocket-spiral.nc",
    size: { width: 1180, height: 640 },
    act: async (page) => {
      await page.click("#charts-toggle");
      await moment(page, 0.5);
    },
  },
  {
    name: "studio-translate",
    program: "corpus/fanuc/bolt-circle-macro.nc",
    size: { width: 1180, height: 600 },
    act: async (page) => {
      await page.click("#tab-translate");
      await page.selectOption("#to", "siemens");
      await page.waitForTimeout(300);
      await ready(page);
      await page.click("#charts-toggle");
    },
  },
  {
    name: "studio-server",
    program: "corpus/fanuc/bolt-circle-macro.nc",
    stored: true,
    size: { width: 1180, height: 640 },
    act: async (page) => {
      await page.click("#projects-open");
      await page.locator("#server-list .take", { hasText: "bolt-circle" }).click();
      await page.locator("#server-about").waitFor();
      await ready(page);
      await page.click("#charts-toggle");
      await page.click("#tab-translate");
      await page.selectOption("#to", "siemens");
      await page.waitForTimeout(300);
      await ready(page);
      await page.click("#server-translate");
      await page.click('[data-to="in-review"]');
      await page.click('[data-to="approved"]');
      await page.locator('[data-to="released"]').waitFor();
    },
  },
  {
    name: "studio-phone",
    program: "corpus/fanuc/pocket-spiral.nc",
    size: { width: 390, height: 780 },
    act: async (page) => {
      await page.click('#phone [data-goto="machine"]');
      await moment(page, 0.6);
    },
  },
];

const world = await begin();
for (const { name, program, stored, size, act } of PICTURES.filter((one) => !only || one.name === only)) {
  const server = await (stored ? service() : studio(program));
  if (stored) {
    const where = "/api/v1/programs?folder=flanges&name=bolt-circle.nc&dialect=fanuc&message=from+the+floor";
    await server.ask("POST", where, readFileSync(program, "utf8"), { "content-type": "text/plain" });
  }
  const { page, context } = await open(world, { address: server.address, ...size });
  await act(page);
  // Until nothing moves any more.
  await page.waitForTimeout(1500);
  const path = join(folder, `${name}.png`);
  const bytes = await fewer(page, await page.screenshot());
  await context.close();
  server.end();
  console.log(`${path}: ${bytes.length} bytes`);
  if (bytes.length > MOST) throw new Error(`${path} is larger than ${MOST} bytes`);
  writeFileSync(path, bytes);
}
await world.end();
