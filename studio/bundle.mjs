// Bundles the page into a folder: `node bundle.mjs FOLDER [WASM]`. With the engine's WebAssembly the folder is a whole
// static page, kept by a service worker; without, it is what the binary serves and what is committed. Programs on a server are
// the binary's alone: the static page has nothing of them.

import { build } from "esbuild";
import { createHash } from "node:crypto";
import { cpSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [folder, wasm] = process.argv.slice(2);
if (!folder) {
  console.error("usage: node bundle.mjs FOLDER [WASM]");
  process.exit(2);
}
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });

/** Shaders as they are compiled: a page does not read their comments. */
const shaders = {
  name: "shaders",
  setup: ({ onLoad }) =>
    onLoad({ filter: /src.machine.[a-z-]+\.ts$/ }, ({ path }) => {
      const text = readFileSync(path, "utf8");
      const bare = (glsl) => glsl.replace(/\/\*[^]*?\*\/|\/\/.*/g, "").replace(/\s*\n\s*/g, "\n");
      return { contents: text.replace(/\/\* glsl \*\/ `[^`]*`/g, (all) => `\`${bare(all.slice(all.indexOf("`") + 1, -1))}\``), loader: "ts" };
    }),
};
const common = {
  absWorkingDir: here,
  bundle: true,
  minify: true,
  format: "esm",
  target: ["es2022"],
  charset: "utf8",
  legalComments: "eof",
  define: { SERVER: String(!wasm) },
  loader: { ".nc": "text", ".ngc": "text", ".mpf": "text", ".gcode": "text" },
  outdir: folder,
  logLevel: "warning",
  plugins: [shaders],
};
await build({
  ...common,
  entryPoints: { studio: "src/main.ts", worker: "src/engine/worker.ts" },
});
await build({ ...common, entryPoints: { studio: "static/studio.css" } });
for (const file of readdirSync(join(here, "static")).filter((name) => name !== "studio.css")) {
  cpSync(join(here, "static", file), join(folder, file));
}
if (wasm) {
  cpSync(wasm, join(folder, "engine.wasm"));
  const files = readdirSync(folder).sort();
  const hash = createHash("sha256");
  for (const file of files) hash.update(file).update(readFileSync(join(folder, file)));
  const define = { ...common.define, FILES: JSON.stringify([".", ...files]), VERSION: JSON.stringify(hash.digest("hex").slice(0, 16)) };
  await build({ ...common, entryPoints: { sw: "src/offline/sw.ts" }, format: "iife", define });
} else {
  // Git keeps the text as it is on every system.
  writeFileSync(join(folder, ".gitattributes"), "* -text linguist-generated\n");
}
