// What the page and its worker tell each other.

import type { Request } from "./engine";

/** To the worker. */
export type ToWorker =
  | { kind: "start"; from: Source }
  | { kind: "put"; name: string; bytes: Uint8Array }
  | { kind: "run"; id: number; request: Request };

/** Where a worker has the engine's module from: the server, from where `to` has it too; another worker; or the page. */
export type Source = { url: string; to: MessagePort } | MessagePort | WebAssembly.Module;

/** From the worker; after `failed` it is of no more use. */
export type ToHost =
  | { kind: "started"; module: WebAssembly.Module }
  | { kind: "done"; id: number; code: number; outputs: [string, Uint8Array][] }
  | { kind: "failed"; reason: string };
