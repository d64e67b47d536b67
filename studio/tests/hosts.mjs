// Tests of the page over the hosts of its engine, for a file of tests.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { NCC } from "./binary.mjs";
import { begin, open } from "./browser.mjs";

/** What registers tests: over the worker alone, and over both hosts. Each has a page of its own, which must tell no error. */
export function hosts() {
  let world;
  before(async () => (world = await begin()));
  after(() => world.end());
  const page = (name, options, body) => {
    const missing = options.host === "loopback" ? !NCC && "NCC names no binary" : !process.env.STUDIO_SITE && "STUDIO_SITE names no page";
    test(name, { skip: missing }, async () => {
      const opened = await open(world, options);
      try {
        await body(opened.page, opened);
        assert.deepEqual(opened.faults, []);
      } finally {
        await opened.context.close();
      }
    });
  };
  const both = (name, options, body) => {
    page(name, options, body);
    page(`${name} (loopback)`, { ...options, host: "loopback" }, body);
  };
  return { page, both };
}
