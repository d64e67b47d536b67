// Projects in the browser's database, texts apart from what is told of them, so that a list needs no texts.
// Where a browser keeps nothing, they live as long as the page, which is told.

import type { Project } from "./project";

const NAME = "ncc-studio";
const CURRENT = "ncc-current";

function asked<T>(request: IDBRequest<T>): Promise<T> {
  return new Promise((done, failed) => {
    request.onsuccess = () => done(request.result);
    request.onerror = () => failed(request.error ?? new Error("database"));
  });
}

function open(): Promise<IDBDatabase> {
  const request = indexedDB.open(NAME, 1);
  request.onupgradeneeded = () => {
    request.result.createObjectStore("projects", { keyPath: "id" });
    request.result.createObjectStore("texts");
  };
  return asked(request);
}

export class Store {
  private constructor(private readonly database: IDBDatabase | undefined) {}

  private readonly projects = new Map<string, Project>();
  private readonly texts = new Map<string, string>();

  static async open(): Promise<Store> {
    try {
      return new Store(await open());
    } catch {
      return new Store(undefined);
    }
  }

  /** Whether anything outlives the page. */
  get keeps(): boolean {
    return this.database !== undefined;
  }

  /** All projects, the last changed first. */
  async list(): Promise<Project[]> {
    const all = this.database
      ? await asked<Project[]>(this.database.transaction("projects").objectStore("projects").getAll())
      : [...this.projects.values()];
    return all.sort((a, b) => b.changed - a.changed);
  }

  async get(id: string): Promise<[Project, string] | undefined> {
    if (!this.database) {
      const project = this.projects.get(id);
      return project && [structuredClone(project), this.texts.get(id) ?? ""];
    }
    const both = this.database.transaction(["projects", "texts"]);
    const project = asked<Project | undefined>(both.objectStore("projects").get(id));
    const text = asked<string | undefined>(both.objectStore("texts").get(id));
    const found = await project;
    return found && [found, (await text) ?? ""];
  }

  /** Keeps a project, with its text where that is given. */
  async put(project: Project, text?: string): Promise<void> {
    if (!this.database) {
      this.projects.set(project.id, structuredClone(project));
      if (text !== undefined) this.texts.set(project.id, text);
      return;
    }
    const both = this.database.transaction(["projects", "texts"], "readwrite");
    both.objectStore("projects").put(project);
    if (text !== undefined) both.objectStore("texts").put(text, project.id);
    await new Promise<void>((done, failed) => {
      both.oncomplete = () => done();
      both.onabort = () => failed(both.error ?? new Error("database"));
    });
  }

  async remove(id: string): Promise<void> {
    this.projects.delete(id);
    this.texts.delete(id);
    if (!this.database) return;
    const both = this.database.transaction(["projects", "texts"], "readwrite");
    await Promise.all([
      asked(both.objectStore("projects").delete(id)),
      asked(both.objectStore("texts").delete(id)),
    ]);
  }

  /** The project that was open last. */
  get current(): string | null {
    return stored(CURRENT);
  }

  set current(id: string) {
    storeItem(CURRENT, id);
  }
}

/** A small setting; none where the browser keeps nothing. */
export function stored(name: string): string | null {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
}

export function storeItem(name: string, value: string): void {
  try {
    localStorage.setItem(name, value);
  } catch {
    // It holds for this page alone.
  }
}
