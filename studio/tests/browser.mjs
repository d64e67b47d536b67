// What the tests of the page share: the browser, a page that is ready, pixels.

import { chromium } from "playwright-core";
import { existsSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { NCC, studio } from "./binary.mjs";
import { serve } from "./server.mjs";

const WAYS = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

/** The browser, and the static page on a port of its own. */
export async function begin() {
  // Without the engine as WebAssembly there is the binary alone.
  const site = process.env.STUDIO_SITE ? await serve(process.env.STUDIO_SITE) : undefined;
  const binary = NCC ? await studio(mkdtempSync(join(tmpdir(), "ncc-studio-"))) : undefined;
  const executablePath = WAYS.find((way) => way && existsSync(way));
  const browser = await chromium.launch({
    executablePath,
    args: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"],
  });
  const end = async () => {
    await browser.close();
    binary?.end();
    await site?.close();
  };
  return { site, binary, browser, end };
}

/** A page in a world of its own. `early` is done before the page is ready. `faults` are errors that it told: each is a failure. */
export async function open({ site, binary, browser }, options = {}) {
  const { host = "worker", address, width = 1280, height = 800, path = "", context: given, script, early, ...rest } = options;
  const context =
    given ?? (await browser.newContext({ viewport: { width, height }, locale: "en-US", acceptDownloads: true, ...rest }));
  const page = await context.newPage();
  const faults = [];
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  if (script) await page.addInitScript(script);
  await page.goto(address ?? (host === "worker" ? site.url + path : binary.address));
  await early?.(page);
  await ready(page);
  return { page, context, faults };
}

/** Waits until the compiler has done what it was asked, and nothing waits for it. */
export async function ready(page) {
  await page.waitForSelector('#state[data-state="ready"][data-idle="true"]', { state: "attached", timeout: 60_000 });
}

/** Puts another text into the editor, as a user pastes it. */
export async function type(page, text) {
  await page.locator("#editor .cm-content").click();
  await page.keyboard.press("Control+a");
  await paste(page, text);
  await page.waitForTimeout(200);
  await ready(page);
}

/** Pastes at the cursor. */
export function paste(page, text) {
  return page.locator("#editor .cm-content").evaluate((content, own) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData("text/plain", own);
    content.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
  }, text);
}

/** The line of the cursor, as the gutter shows it. */
export const line = async (page) => Number(await page.locator("#editor .cm-activeLineGutter").first().textContent());

/** Waits until the picture stays as it is, three seconds at most: by software a fine part takes longer than a moment. */
export async function drawn(page) {
  const frames = () =>
    page.evaluate(async () => {
      const canvas = document.querySelector("#canvas");
      const gl = canvas?.getContext("webgl2");
      // All until here is drawn when the fence is passed; to read a pixel would empty the picture that a screenshot takes.
      const fence = gl?.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
      gl?.flush();
      while (fence && gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) await new Promise((done) => setTimeout(done, 20));
      return canvas?.dataset.frames;
    });
  let before = await frames();
  for (let tries = 0; tries < 10; tries += 1) {
    await page.waitForTimeout(300);
    const now = await frames();
    if (now === before) return;
    before = now;
  }
}

/** How many pixels of an element are near each colour. */
export async function pixels(page, selector, colours) {
  await drawn(page);
  const shot = await page.locator(selector).screenshot();
  return page.evaluate(
    async ([source, wanted]) => {
      const image = new Image();
      image.src = source;
      await image.decode();
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [image.width, image.height];
      const pen = canvas.getContext("2d");
      pen.drawImage(image, 0, 0);
      const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
      const found = Object.fromEntries(Object.keys(wanted).map((name) => [name, 0]));
      const style = getComputedStyle(document.documentElement);
      const parts = Object.entries(wanted).map(([name, variable]) => {
        pen.fillStyle = variable.startsWith("--") ? style.getPropertyValue(variable).trim() : variable;
        pen.fillRect(0, 0, 1, 1);
        return [name, pen.getImageData(0, 0, 1, 1).data];
      });
      for (let at = 0; at < data.length; at += 4)
        for (const [name, own] of parts)
          if ([0, 1, 2].every((channel) => Math.abs(data[at + channel] - own[channel]) < 26)) found[name] += 1;
      return found;
    },
    [`data:image/png;base64,${shot.toString("base64")}`, colours],
  );
}

/**
 * A place on the picture where a colour is, in the page's pixels: that of a variable, or one with so much more red than blue and at most
 * this share of green in it.
 */
export async function placeOf(page, variable, hue) {
  await drawn(page);
  const shot = await page.locator("#canvas").screenshot();
  const at = await page.evaluate(
    async ([source, name, hue]) => {
      const image = new Image();
      image.src = source;
      await image.decode();
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [image.width, image.height];
      const pen = canvas.getContext("2d");
      pen.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
      pen.fillRect(0, 0, 1, 1);
      const own = pen.getImageData(0, 0, 1, 1).data;
      pen.drawImage(image, 0, 0);
      const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
      const isNear = (colour) => colour.every((part, channel) => Math.abs(part - own[channel]) < 16);
      const isOf = ([r, g, b]) => r - b > hue.spread && g < hue.green * r;
      const fits = hue ? isOf : isNear;
      const all = [];
      for (let at = 0; at < data.length; at += 4) if (fits([data[at], data[at + 1], data[at + 2]])) all.push(at / 4);
      const middle = all[Math.floor(all.length / 2)];
      return middle === undefined ? undefined : [middle % canvas.width, Math.floor(middle / canvas.width)];
    },
    [`data:image/png;base64,${shot.toString("base64")}`, variable, hue],
  );
  const box = await page.locator("#canvas").boundingBox();
  return at && [box.x + at[0], box.y + at[1]];
}
