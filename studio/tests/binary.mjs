// The binary that serves the page: started on a folder or a database, ended with the tests. NCC names it; without, its tests are
// skipped.

import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const NCC = process.env.NCC;

/** Starts the binary; gives the address that it tells, and what ends it. */
async function started(args, form) {
  const child = spawn(NCC, args, { stdio: ["ignore", "pipe", "pipe"] });
  const address = await new Promise((done, failed) => {
    let said = "";
    const hear = (text) => {
      said += text;
      const found = form.exec(said);
      if (found) done(found[0].trim());
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("error", failed);
    child.on("exit", () => failed(new Error(said)));
  });
  return { address, end: () => child.kill() };
}

/** Serves a folder; the address has the token. */
export function studio(folder) {
  return started(["studio", folder, "--no-open"], /http:\/\/\S+#token=\w+/);
}

/** The service with a database of its own. `ask` sends a request, and gives its answer's JSON; `account` makes one, and from then on
 * a login is needed. */
export async function service(author = "ana") {
  const folder = mkdtempSync(join(tmpdir(), "ncc-service-"));
  const database = ["--database", join(folder, "ncc.sqlite")];
  const server = await started(["serve", "--listen", "127.0.0.1:0", ...database, "--author", author], /http:\/\/[\d.:]+\s/);
  const account = (name, role, password) => execFileSync(NCC, ["serve", "user", "add", name, "--role", role, ...database], { input: `${password}\n`, stdio: ["pipe", "ignore", "inherit"] });
  const ask = async (method, path, body, headers = {}) => {
    const json = body !== undefined && typeof body !== "string";
    const all = { ...(json && { "content-type": "application/json" }), ...headers };
    const answer = await fetch(server.address + path, { method, headers: all, body: json ? JSON.stringify(body) : body });
    if (!answer.ok) throw new Error(`${method} ${path}: ${answer.status} ${await answer.text()}`);
    return answer.headers.get("content-type")?.startsWith("application/json") ? answer.json() : answer.text();
  };
  const end = () => {
    server.end();
    rmSync(folder, { recursive: true, force: true });
  };
  return { address: server.address, ask, account, end };
}
