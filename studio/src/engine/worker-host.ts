// The engine as WebAssembly in a worker. To cancel is to end the worker and to start another of the same module.

import { Answer, Cancelled, type Engine, type Request } from "./engine";
import type { ToHost, ToWorker } from "./wire";

interface Pending {
  done(answer: Answer): void;
  failed(error: Error): void;
}

/** The engine's module, compiled while it arrives. */
export async function load(url: string): Promise<WebAssembly.Module> {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status}`);
  // A server that does not know the type of WebAssembly's files.
  const typed = answer.headers.get("content-type")?.startsWith("application/wasm");
  return typed ? WebAssembly.compileStreaming(answer) : WebAssembly.compile(await answer.arrayBuffer());
}

export class WorkerHost implements Engine {
  private worker: Worker;
  private readonly files = new Map<string, Uint8Array>();
  private readonly pending = new Map<number, Pending>();
  private last = 0;

  constructor(
    private readonly module: WebAssembly.Module,
    private readonly url: string,
  ) {
    this.worker = this.start();
  }

  get waiting(): number {
    return this.pending.size;
  }

  put(name: string, bytes: Uint8Array): void {
    this.files.set(name, bytes);
    this.tell({ kind: "put", name, bytes });
  }

  run(request: Request): Promise<Answer> {
    const id = ++this.last;
    return new Promise((done, failed) => {
      this.pending.set(id, { done, failed });
      this.tell({ kind: "run", id, request });
    });
  }

  cancel(): void {
    if (this.pending.size > 0) this.restart(new Cancelled());
  }

  private tell(message: ToWorker): void {
    this.worker.postMessage(message);
  }

  private start(): Worker {
    const worker = new Worker(this.url, { type: "module" });
    worker.onmessage = (event: MessageEvent<ToHost>) => {
      const message = event.data;
      if (message.kind === "failed") return this.restart(new Error(message.reason));
      const one = this.pending.get(message.id);
      this.pending.delete(message.id);
      one?.done(new Answer(message.code, new Map(message.outputs)));
    };
    worker.onerror = (event) => this.restart(new Error(event.message));
    worker.postMessage({ kind: "start", module: this.module } satisfies ToWorker);
    return worker;
  }

  private restart(error: Error): void {
    this.worker.terminate();
    this.worker = this.start();
    for (const [name, bytes] of this.files) this.tell({ kind: "put", name, bytes });
    const failed = [...this.pending.values()];
    this.pending.clear();
    failed.forEach((one) => one.failed(error));
  }
}
