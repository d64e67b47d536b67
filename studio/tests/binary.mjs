// The binary that serves the page: started on a folder, ended with the tests. NCC names it; without, its tests are skipped.

import { spawn } from "node:child_process";

export const NCC = process.env.NCC;

/** Serves a folder; gives the page's address, with the token, and what ends it. */
export async function studio(folder) {
  const child = spawn(NCC, ["studio", folder, "--no-open"], { stdio: ["ignore", "pipe", "pipe"] });
  const address = await new Promise((done, failed) => {
    let said = "";
    const hear = (text) => {
      said += text;
      const found = /http:\/\/\S+#token=\w+/.exec(said);
      if (found) done(found[0]);
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("error", failed);
    child.on("exit", () => failed(new Error(said)));
  });
  return { address, end: () => child.kill() };
}
