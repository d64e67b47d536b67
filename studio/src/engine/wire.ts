// What the page and its worker tell each other.

import type { Request } from "./engine";

/** To the worker. */
export type ToWorker =
  | { kind: "start"; module: WebAssembly.Module }
  | { kind: "put"; name: string; bytes: Uint8Array }
  | { kind: "run"; id: number; request: Request };

/** From the worker; after `failed` it is of no more use. */
export type ToHost =
  | { kind: "done"; id: number; code: number; outputs: [string, Uint8Array][] }
  | { kind: "failed"; reason: string };
