// The engine in a worker: five functions of an instance, with bytes instead of places in its memory.
// Not here: the order of requests (`worker-host`).

import type { ToHost, ToWorker } from "./wire";

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

function done(message: ToWorker): void {
  switch (message.kind) {
    case "start": {
      api = new WebAssembly.Instance(message.module).exports as unknown as Api;
      length = api.ncc_alloc(4);
      return;
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

onmessage = (event: MessageEvent<ToWorker>) => {
  try {
    done(event.data);
  } catch (error) {
    // An instance that has trapped is thrown away, with this worker.
    tell({ kind: "failed", reason: String(error) });
  }
};
