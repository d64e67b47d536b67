// Holds the engine in WebAssembly against its native build: the same requests, the same codes and outputs.
//
//   node engine/compare.mjs ncc_engine.wasm requests.ndjson
//
// The requests are those that `--example corpus` has done, with a hash of every output.

import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { basename } from "node:path";

const [wasm, requests] = process.argv.slice(2);
const module = new WebAssembly.Module(readFileSync(wasm));
const encoder = new TextEncoder();
const decoder = new TextDecoder();

/** The five functions of an instance, with bytes instead of places in its memory. */
function engine() {
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
    put: (name, bytes) => api.ncc_put(...given(encoder.encode(name)), ...given(bytes)),
    run: (request) => api.ncc_run(...given(encoder.encode(JSON.stringify(request)))),
    outputs: () =>
      JSON.parse(decoder.decode(back(0))).map(([name], index) => [name, back(index + 1)]),
    clear: () => api.ncc_clear(),
  };
}

// Outputs that are not compared. The engine of a page makes no page of a comparison: the studio shows the document itself. The
// drawn path has places by sine and cosine, of which the last bit depends on the system; what is cut does not.
const OTHERS = { diff: "page", simulate: "path" };

const sha256 = (bytes) => createHash("sha256").update(bytes).digest("hex");
let one = engine();
let done = 0;
const wrong = [];
for (const line of readFileSync(requests, "utf8").split("\n").filter(Boolean)) {
  const { path, request, code, outputs } = JSON.parse(line);
  done += 1;
  let found;
  try {
    one.clear();
    one.put(basename(path), readFileSync(path));
    const given = one.run(request);
    found = { code: given, outputs: Object.fromEntries(one.outputs().map(([name, bytes]) => [name, sha256(bytes)])) };
  } catch (error) {
    found = { trap: String(error) };
    // An instance that has trapped is thrown away.
    one = engine();
  }
  delete outputs[OTHERS[request.verb]];
  delete found.outputs?.[OTHERS[request.verb]];
  const same =
    found.code === code &&
    Object.keys(outputs).length === Object.keys(found.outputs).length &&
    Object.entries(outputs).every(([name, hash]) => found.outputs[name] === hash);
  if (!same) wrong.push(`${path} ${JSON.stringify(request)}\n  native ${code} ${JSON.stringify(outputs)}\n  wasm ${JSON.stringify(found)}`);
}
wrong.slice(0, 20).forEach((text) => console.log(text));
console.log(`${done} requests, ${done - wrong.length} the same, ${wrong.length} others`);
process.exit(wrong.length === 0 && done > 0 ? 0 : 1);
