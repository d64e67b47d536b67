// The compiler, as the page talks to it: files by name, requests as JSON, outputs as bytes.
//
//     engine.put("part.nc", bytes)
//     (await engine.run({ verb: "check", file: "part.nc" })).json("findings")
//
// Hosts have it: `worker-host` (WebAssembly in a worker), `loopback` (the binary that serves the page), and on it rooms of `ncc serve`.
// Not here: what the outputs mean.

/** A request; the engine's `request` has its fields. */
export type Request = { verb: string } & Record<string, unknown>;

/** What a request has made. */
export class Answer {
  constructor(
    /** An exit code of the command line: 0 is done. */
    readonly code: number,
    private readonly outputs: ReadonlyMap<string, Uint8Array>,
  ) {}

  /** An output, if there is one of that name. */
  bytes(name: string): Uint8Array | undefined {
    return this.outputs.get(name);
  }

  /** An output as text; empty if there is none. */
  text(name: string): string {
    const bytes = this.outputs.get(name);
    return bytes ? decoder.decode(bytes) : "";
  }

  /** An output that is JSON. */
  json<T>(name: string): T | undefined {
    const bytes = this.outputs.get(name);
    return bytes ? (JSON.parse(decoder.decode(bytes)) as T) : undefined;
  }
}

const decoder = new TextDecoder();

/** The work was given up, because newer work takes its place. */
export class Cancelled extends Error {}

/** The compiler. */
export interface Engine {
  /** Keeps a file, in the place of another of its name. */
  put(name: string, bytes: Uint8Array): void;
  /** Does a request, after those before it. Fails with `Cancelled`, or where the host cannot do it. */
  run(request: Request): Promise<Answer>;
  /** Gives up what runs and what waits. Files stay. */
  cancel(): void;
  /** How many requests run or wait. */
  readonly waiting: number;
  /** Lets go of all files, where the host has programs that others may have changed. */
  clear?(): void;
  /** Puts what a stored program may call beside it: the programs of its folder, as they are now. */
  called?(program: string): Promise<unknown>;
}
