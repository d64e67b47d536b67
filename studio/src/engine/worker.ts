// The engine in a worker: five functions of an instance, with bytes instead of places in its memory.
// Not here: the order of requests (`worker-host`).

import type { Source, ToHost, ToWorker } from "./wire";

interface Api {
  memory: WebAssembly.Memory;
  ncc_alloc(bytes: number): number;
  ncc_put(name: number, nameBytes: number, at: number, bytes: number): void;
  ncc_run(at: number, bytes: number): number;
  ncc_back(number: number, bytes: number): number;
}

const encoder = new TextEncoder();
const decoder = new TextDecoder();
let api: Api | undefined;
let length = 0;

function memory(at: number, bytes: number): Uint8Array {
  return new Uint8Array((api as Api).memory.buffer, at, bytes);
}

/** Bytes in the engine's memory: where, and how many. */
function given(bytes: Uint8Array): [number, number] {
  const at = (api as Api).ncc_alloc(bytes.length);
  memory(at, bytes.length).set(bytes);
  return [at, bytes.length];
}

function back(number: number): Uint8Array {
  const at = (api as Api).ncc_back(number, length);
  const bytes = new DataView((api as Api).memory.buffer).getUint32(length, true);
  return memory(at, bytes).slice();
}

function tell(message: ToHost, transfer: Transferable[] = []): void {
  postMessage(message, { transfer });
}

/** The engine's module, compiled while it arrives. */
async function load(url: string): Promise<WebAssembly.Module> {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status}`);
  // A server that does not know the type of WebAssembly's files.
  const typed = answer.headers.get("content-type")?.startsWith("application/wasm");
  return typed ? WebAssembly.compileStreaming(answer) : WebAssembly.compile(await answer.arrayBuffer());
}

async function moduleOf(from: Source): Promise<WebAssembly.Module> {
  if (from instanceof WebAssembly.Module) return from;
  if (from instanceof MessagePort) return new Promise((done) => (from.onmessage = ({ data }) => done(data)));
  const module = await load(from.url);
  from.to.postMessage(module);
  return module;
}

async function done(message: ToWorker): Promise<void> {
  switch (message.kind) {
    case "start": {
      const module = await moduleOf(message.from);
      api = new WebAssembly.Instance(module).exports as unknown as Api;
      length = api.ncc_alloc(4);
      return tell({ kind: "started", module });
    }
    case "put":
      return api?.ncc_put(...given(encoder.encode(message.name)), ...given(message.bytes));
    case "run": {
      const code = (api as Api).ncc_run(...given(encoder.encode(JSON.stringify(message.request))));
      const names = JSON.parse(decoder.decode(back(0))) as [string, number][];
      const outputs = names.map(([name], index): [string, Uint8Array] => [name, back(index + 1)]);
      tell({ kind: "done", id: message.id, code, outputs }, outputs.map(([, bytes]) => bytes.buffer));
    }
  }
}

/** What was asked before, until it is done: the module is waited for. */
let before = Promise.resolve();

onmessage = (event: MessageEvent<ToWorker>) => {
  // An instance that has trapped is thrown away, with this worker.
  before = before.then(() => done(event.data)).catch((error) => tell({ kind: "failed", reason: String(error) }));
};
