// The engine as WebAssembly in a worker. To cancel is to end the worker and to start another of the same module.

import { Answer, Cancelled, type Engine, type Request } from "./engine";
import type { Source, ToHost, ToWorker } from "./wire";

interface Pending {
  done(answer: Answer): void;
  failed(error: Error): void;
}

export class WorkerHost implements Engine {
  private worker: Worker;
  private readonly files = new Map<string, Uint8Array>();
  private readonly pending = new Map<number, Pending>();
  private last = 0;
  private module: WebAssembly.Module | undefined;
  private begun!: { done(module: WebAssembly.Module): void; failed(error: Error): void };
  /** Gives the module, and fails where it does not come; what is asked before waits for it. */
  readonly started = new Promise<WebAssembly.Module>((done, failed) => (this.begun = { done, failed }));

  constructor(
    private readonly url: string,
    from: Source,
  ) {
    this.worker = this.start(from);
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

  private start(from: Source): Worker {
    const worker = new Worker(this.url, { type: "module" });
    worker.onmessage = (event: MessageEvent<ToHost>) => {
      const message = event.data;
      if (message.kind === "failed") return this.restart(new Error(message.reason));
      if (message.kind === "started") {
        this.module = message.module;
        return this.begun.done(message.module);
      }
      const one = this.pending.get(message.id);
      this.pending.delete(message.id);
      one?.done(new Answer(message.code, new Map(message.outputs)));
    };
    worker.onerror = (event) => this.restart(new Error(event.message));
    const port = from instanceof MessagePort ? from : from instanceof WebAssembly.Module ? undefined : from.to;
    worker.postMessage({ kind: "start", from } satisfies ToWorker, port ? [port] : []);
    return worker;
  }

  private restart(error: Error): void {
    this.worker.terminate();
    if (this.module) {
      this.worker = this.start(this.module);
      for (const [name, bytes] of this.files) this.tell({ kind: "put", name, bytes });
    } else {
      this.begun.failed(error);
    }
    const failed = [...this.pending.values()];
    this.pending.clear();
    failed.forEach((one) => one.failed(error));
  }
}
