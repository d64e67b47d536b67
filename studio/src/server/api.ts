// Requests to the server: with a session where it asks for one, and its refusals in words.

import { Signal } from "../ui/signal";
import { tell, tellOf } from "./texts";

/** Of `GET /api/v1/session`. */
export interface Session {
  user: string | null;
  login: "none" | "needed";
  rights: string[];
  csrf: string;
}

/** An error by RFC 9457, as the service writes it. */
interface Problem {
  type?: string;
  title?: string;
  detail?: string;
  help?: string[];
  diagnostics?: { code: string; message: string; place?: { line: number; column: number } | null }[];
  messages?: string;
}

const SESSION = "/api/v1/session";

/** How often a request is sent again where the server has too much to do. */
const TRIES = 5;

/** The server's refusal; its message is for people. */
export class Refused extends Error {
  constructor(
    /** The status of HTTP; 0 where the server does not answer. */
    readonly status: number,
    problem: Problem = {},
  ) {
    super(words(status, problem));
  }
}

/** A refusal in words: what it is, what is wrong, what to do. */
function words(status: number, { type, title, detail, help = [], diagnostics = [], messages }: Problem): string {
  if (status === 0) return tell("noServer");
  if (status === 409 && type?.endsWith(":exists")) return tell("exists");
  const kind = type?.split(":").pop() ?? "";
  const own = status === 403 && kind !== "stranger" ? tell("kind_forbidden") : tellOf("kind", kind);
  const head = own === kind ? (title ?? `HTTP ${status}`) : own;
  const places = diagnostics.map(({ code, message, place }) => `${code}${place ? ` ${place.line}:${place.column}` : ""}: ${message}`);
  const found = places.length > 0 ? places : messages ? [messages.trim()] : [];
  return [head, ...(detail ? [detail] : []), ...help, ...found].join("\n");
}

export interface Sent {
  body?: BodyInit;
  json?: unknown;
  headers?: Record<string, string>;
  signal?: AbortSignal;
  /** It is sent though the page goes away. */
  keepalive?: boolean;
}

export class Api {
  readonly session = new Signal<Session>({ user: null, login: "none", rights: [], csrf: "" });
  private begun: Promise<void> | undefined;
  private entering: Promise<void> | undefined;

  /** `enter` gives a session once its user has logged in. */
  constructor(private readonly enter: (api: Api) => Promise<Session>) {}

  /** Whose programs they are; the form is shown until that is known. */
  async begin(): Promise<void> {
    this.begun ??= this.read().then((session) => {
      this.session.set(session);
      return session.login === "needed" && session.user === null ? this.login() : undefined;
    });
    return this.begun;
  }

  /** Sends a request; fails with `Refused`. */
  async ask(method: string, path: string, sent: Sent = {}): Promise<Response> {
    await this.begin();
    for (let tries = 1; ; tries += 1) {
      const { csrf } = this.session.get();
      const answer = await this.send(method, path, sent);
      if (answer.ok) return answer;
      if (answer.status === 401) await this.login();
      else if ((answer.status === 503 || answer.status === 429) && tries < TRIES) await new Promise((done) => setTimeout(done, 1000 * tries));
      else if (answer.status !== 403 || tries > 1 || (await this.renewed(csrf)) === csrf) throw new Refused(answer.status, await problemOf(answer));
    }
  }

  async json<T>(method: string, path: string, sent: Sent = {}): Promise<T> {
    return (await (await this.ask(method, path, sent)).json()) as T;
  }

  /** Begins a session; fails with `Refused`. */
  async logIn(user: string, password: string): Promise<Session> {
    const answer = await this.send("POST", SESSION, { json: { user, password } });
    if (!answer.ok) throw new Refused(answer.status, await problemOf(answer));
    return (await answer.json()) as Session;
  }

  async logOut(): Promise<void> {
    await this.send("DELETE", SESSION);
  }

  /** Shows the form, once for all requests that wait for it. */
  private login(): Promise<void> {
    const before = this.session.get().user;
    this.entering ??= this.enter(this)
      .then((session) => {
        this.session.set(session);
        // What another user has open is not theirs.
        if (before !== null && before !== session.user) location.reload();
      })
      .finally(() => (this.entering = undefined));
    return this.entering;
  }

  private async read(): Promise<Session> {
    const answer = await this.send("GET", SESSION);
    if (answer.ok) return (await answer.json()) as Session;
    // A server without logins does not have the address.
    if (answer.status === 404) return this.session.get();
    throw new Refused(answer.status, await problemOf(answer));
  }

  /** The proof of the session as it is now: another page of this browser may have begun another one. */
  private async renewed(csrf: string): Promise<string> {
    const session = await this.read().catch(() => undefined);
    if (session && session.csrf !== csrf) this.session.set(session);
    return session?.csrf ?? csrf;
  }

  private async send(method: string, path: string, { body, json, headers, signal, keepalive }: Sent = {}): Promise<Response> {
    const { csrf } = this.session.get();
    const all: Record<string, string> = { ...headers };
    if (csrf && method !== "GET") all["x-ncc-csrf"] = csrf;
    if (json !== undefined) all["content-type"] ??= "application/json";
    const own = json === undefined ? body : JSON.stringify(json);
    try {
      return await fetch(path, { method, headers: all, ...(own !== undefined && { body: own }), ...(signal && { signal }), ...(keepalive && { keepalive }) });
    } catch (error) {
      if (signal?.aborted) throw error;
      throw new Refused(0);
    }
  }
}

async function problemOf(answer: Response): Promise<Problem> {
  return (await answer.json().catch(() => ({}))) as Problem;
}

/** What went wrong, for people. */
export function wordsOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
