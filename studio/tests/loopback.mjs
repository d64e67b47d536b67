// What the binary serves, as far as the page sees it: the same files with the other host in their head, and the engine behind
// requests with a token. The engine is the WebAssembly one, in this process.

import { readFileSync } from "node:fs";
import { join } from "node:path";

export const TOKEN = "a-token-of-tests";

/** The five functions of an instance, with bytes instead of places in its memory. */
function engine(module) {
  const api = new WebAssembly.Instance(module).exports;
  const memory = (at, bytes) => new Uint8Array(api.memory.buffer, at, bytes);
  const given = (bytes) => {
    const at = api.ncc_alloc(bytes.length);
    memory(at, bytes.length).set(bytes);
    return [at, bytes.length];
  };
  const length = api.ncc_alloc(4);
  const back = (number) => {
    const at = api.ncc_back(number, length);
    return memory(at, new DataView(api.memory.buffer).getUint32(length, true)).slice();
  };
  return {
    put: (name, bytes) => api.ncc_put(...given(Buffer.from(name)), ...given(bytes)),
    run(request) {
      const code = api.ncc_run(...given(request));
      const outputs = JSON.parse(Buffer.from(back(0)).toString());
      const head = Buffer.from(`${JSON.stringify({ code, outputs })}\n`);
      return Buffer.concat([head, ...outputs.map((_, index) => back(index + 1))]);
    },
  };
}

/** The list of programs: none. What the binary does with a folder is tested with the binary. */
function list(answer) {
  answer.writeHead(200, { "content-type": "application/json" });
  answer.end(JSON.stringify({ folder: "empty", open: true, programs: [], stamp: "0" }));
}

/** Answers requests to `/engine/…` and for the page itself; others it leaves alone. */
export function loopback(folder) {
  const module = new WebAssembly.Module(readFileSync(join(folder, "engine.wasm")));
  const rooms = new Map();
  return async (request, answer) => {
    if (request.url === "/") {
      const page = readFileSync(join(folder, "index.html"), "utf8");
      answer.writeHead(200, { "content-type": "text/html; charset=utf-8" });
      answer.end(page.replace('name="ncc-host" content="worker"', 'name="ncc-host" content="loopback"'));
      return true;
    }
    if (request.url === "/programs") return (list(answer), true);
    // Nothing ever changes.
    if (request.url.startsWith("/programs?")) return true;
    const found = /^\/engine\/(\w+)\/(run|files\/(.*))$/.exec(request.url);
    if (!found) return false;
    const parts = [];
    for await (const part of request) parts.push(part);
    if (request.headers.authorization !== `Bearer ${TOKEN}`) {
      answer.writeHead(401).end();
      return true;
    }
    const [, room, what, name] = found;
    if (!rooms.has(room)) rooms.set(room, engine(module));
    const body = Buffer.concat(parts);
    if (what === "run") answer.writeHead(200, { "content-type": "application/octet-stream" }).end(rooms.get(room).run(body));
    else {
      rooms.get(room).put(decodeURIComponent(name), body);
      answer.writeHead(204).end();
    }
    return true;
  };
}
