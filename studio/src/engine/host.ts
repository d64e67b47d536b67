// Which host the page has: the binary that serves it says so in the page's head; a static page has a worker.
//
// There are three engines: one for what the eye waits for (colours), one that checks, and one that cuts and translates. Work of
// the last two takes its time, and is cancelled for newer work.

import type { Engine } from "./engine";
import { Loopback, withToken } from "./loopback";
import { WorkerHost } from "./worker-host";

export interface Engines {
  quick: Engine;
  check: Engine;
  heavy: Engine;
}

/** A module of one function that makes a vector: `i32.const 0`, `i8x16.splat`. */
const VECTOR = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11];

/** The browser lacks what the engine's module needs. */
export class TooOld extends Error {}

const WARM = "%\nO1\nG21 G17 G90 G94 G40 G49 G80\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG1 X1. F100.\nM30\n%\n";

/** The engines, warm: browsers compile a function when it first runs. `rooms` makes those of `ncc serve`. */
export async function openEngines(rooms?: (room: string) => Engine): Promise<Engines> {
  const token = loopbackToken();
  const remote = rooms ?? (token === undefined ? undefined : (own: string) => new Loopback(withToken(token), `engine/${own}`));
  if (remote) {
    const own = room();
    const heavy = remote(`${own}-heavy`);
    // A server works for many: what one of them asks is done one after the other.
    return { quick: remote(`${own}-quick`), check: rooms ? heavy : remote(`${own}-check`), heavy };
  }
  if (!WebAssembly.validate(new Uint8Array(VECTOR))) throw new TooOld("WebAssembly SIMD");
  // Workers fetch and compile while the page has its own work, and hand the module on without it.
  const { port1, port2 } = new MessageChannel();
  const quick = new WorkerHost("worker.js", { url: "engine.wasm", to: port1 });
  const heavy = new WorkerHost("worker.js", port2);
  const bytes = new TextEncoder().encode(WARM);
  const file = "warm.nc";
  for (const engine of [quick, heavy]) engine.put(file, bytes);
  const warm = [
    quick.run({ verb: "colours", file, first: 1, lines: 9 }),
    heavy.run({ verb: "check", file, from: "fanuc" }),
    heavy.run({ verb: "simulate", file, from: "fanuc", cells: 16 }),
  ];
  // What goes wrong here goes wrong again with the program, and is told then.
  warm.forEach((one) => void one.catch(() => undefined));
  const [module] = await Promise.all([quick.started, heavy.started]);
  return { quick, check: new WorkerHost("worker.js", module), heavy };
}

/** Who serves the page: `worker` (any web server), `loopback` (`ncc studio`) or `serve` (`ncc serve`). */
export function hostName(): string {
  return document.querySelector<HTMLMetaElement>('meta[name="ncc-host"]')?.content ?? "";
}

/** The token of the binary that serves the page, if one does. */
export function loopbackToken(): string | undefined {
  return hostName() === "loopback" ? (new URLSearchParams(location.hash.slice(1)).get("token") ?? "") : undefined;
}

/** A name for this tab's engines; it outlives a reload, so that engines do not gather. */
function room(): string {
  const name = "ncc-room";
  const known = sessionStorage.getItem(name) ?? Math.random().toString(36).slice(2, 12);
  sessionStorage.setItem(name, known);
  return known;
}
