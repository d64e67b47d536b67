// A test with a page of its own, over one host or over both; a file of tests calls `tests` once.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { begin, open } from "./browser.mjs";
import { NCC } from "./binary.mjs";

export function tests() {
  let world;
  before(async () => (world = await begin()));
  after(() => world.end());

  /** A test with a page of its own, which must tell no error. */
  function page(name, options, body) {
    const skip = options.host === "loopback" ? !NCC && "NCC names no binary" : !process.env.STUDIO_SITE && "STUDIO_SITE names no page";
    test(name, { skip }, async () => {
      const opened = await open(world, options);
      try {
        await body(opened.page, opened);
        assert.deepEqual(opened.faults, []);
      } finally {
        await opened.context.close();
      }
    });
  }

  /** A test over both hosts of the engine. */
  function both(name, options, body) {
    page(name, options, body);
    page(`${name} (loopback)`, { ...options, host: "loopback" }, body);
  }

  return { page, both, world: () => world };
}

export const value = (own, selector) => own.locator(selector).textContent();
