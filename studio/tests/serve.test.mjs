// Programs of `ncc serve` in the page: found, opened, saved as revisions, translated; and the form of the login.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { strToU8, unzipSync, zipSync } from "fflate";
import { NCC, service } from "./binary.mjs";
import { begin, open, paste, ready, type } from "./browser.mjs";
import { value } from "./pages.mjs";
import { ASKS, SQUARE } from "./programs.mjs";

let world;
before(async () => (world = await begin()));
after(() => world.end());

/** A test with a server and a page of its own. Requests that are refused are told by the browser; the page tells no other error. */
function serves(name, options, body) {
  test(`ncc serve: ${name}`, { skip: !NCC && "NCC names no binary" }, async () => {
    const server = await service();
    const { stored, routes, ...rest } = options;
    const context = await world.browser.newContext({ viewport: { width: 1280, height: 800 }, locale: "en-US", acceptDownloads: true, ...rest });
    try {
      await stored?.(server);
      await routes?.(context, server);
      const { page, faults } = await open(world, { address: server.address, context, early: rest.early });
      await body(page, server, context);
      assert.deepEqual(faults.filter((text) => !text.startsWith("Failed to load resource")), []);
    } finally {
      await context.close();
      server.end();
    }
  });
}

/** Keeps a program on the server. */
function keep(server, path, text = SQUARE, more = "&dialect=fanuc") {
  const at = path.lastIndexOf("/");
  const query = new URLSearchParams({ folder: path.slice(0, Math.max(0, at)), name: path.slice(at + 1) });
  return server.ask("POST", `/api/v1/programs?${query}${more}`, text, { "content-type": "text/plain" });
}

const change = (server, { id }, text, message = "") => server.ask("PUT", `/api/v1/programs/${id}/text?message=${encodeURIComponent(message)}`, text, { "content-type": "text/plain" });

async function listed(own) {
  await own.click("#projects-open");
  await own.locator("#server-list li").first().waitFor();
}

async function named(own, name) {
  await own.waitForFunction((wanted) => document.querySelector("#project-name").textContent === wanted, name);
  await ready(own);
}

/** Opens a program from the list. */
async function take(own, name) {
  await listed(own);
  await own.locator("#server-list .take", { hasText: name }).click();
  await named(own, name);
}

const tells = (own, text, place = "#server-told") => own.locator(place, { hasText: text }).waitFor();
const names = (own) => own.locator("#server-list b").allTextContents();
const content = (own) => own.locator("#editor .cm-content").textContent();
const square = (server) => keep(server, "plates/square.nc", SQUARE, "&dialect=fanuc&message=from+the+floor");
const EDITED = SQUARE.replace("(SQUARE)", "(EDITED)");
const THEIRS = SQUARE.replace("(SQUARE)", "(THEIRS)");

serves("a first visit shows an example that the server cuts", {}, async (own) => {
  assert.equal(await value(own, "#project-name"), "pocket-spiral");
  assert.ok(Number(await own.getAttribute("#canvas", "data-cut")) > 1000);
  assert.ok(!(await own.isVisible("#server-bar")));
});

serves("work is cancelled, and the next one is done", {}, async (own) => {
  const isRun = (request) => /-heavy\/run$/.test(request.url());
  await own.locator("#editor .cm-content").click();
  await own.keyboard.press("Control+a");
  const begun = own.waitForRequest(isRun);
  await paste(own, "%\nO1\nG21 G90 G17 G40 G80\n#1=0\nWHILE[#1LT9000000]DO1\nG1 X[#1/1000] F100.\n#1=#1+1\nEND1\nM30\n%\n");
  await begun;
  // Its connection goes, and the server's work with it.
  const gone = own.waitForEvent("requestfailed", isRun);
  await own.click("#cancel");
  await gone;
  await own.locator("#cancel").waitFor({ state: "hidden" });
  await type(own, SQUARE);
  assert.match(await value(own, "#problems-count"), /Nothing found|[0-9]/);
});

serves("programs are found by folder and name, and opened with dialect and machine", {
  stored: async (server) => {
    for (const path of ["top.nc", "plates/square.nc", "plates/ring.nc", "shafts/left/key.nc"]) await keep(server, path, SQUARE, "&dialect=haas&machine=haas-vf2");
  },
}, async (own) => {
  await listed(own);
  assert.deepEqual(await names(own), ["top.nc", "ring.nc", "square.nc", "key.nc"]);
  assert.deepEqual(await own.locator("#server-list .folder").allTextContents(), ["Top folder", "plates", "shafts/left"]);
  await own.selectOption("#server-folder", { label: "plates (2)" });
  await own.locator("#server-list b", { hasText: "key.nc" }).waitFor({ state: "detached" });
  assert.deepEqual(await names(own), ["ring.nc", "square.nc"]);
  await own.fill("#server-search", "SQ");
  await own.locator("#server-list b", { hasText: "ring.nc" }).waitFor({ state: "detached" });
  await own.locator("#server-list .take").click();
  await named(own, "square.nc");
  assert.equal(await own.inputValue("#from"), "haas");
  assert.equal(await own.inputValue("#machine"), "haas-vf2");
  assert.match(await value(own, "#server-about"), /^plates\/square\.nc revision 1 · ana/);
  assert.match(await content(own), /SQUARE/);
  assert.ok(await own.isDisabled("#server-save"));
  // The last one is open again after a reload.
  await own.reload();
  await named(own, "square.nc");
});

serves("a machine that the server keeps is chosen, and kept with the program", {
  stored: async (server) => {
    await square(server);
    const profile = (await server.ask("GET", "/api/v1/machines/haas-vf2")).replaceAll("haas-vf2", "own-vf2").replace(/^title = .*$/m, 'title = "Our own VF-2"');
    await server.ask("PUT", "/api/v1/machines/own-vf2", profile, { "content-type": "application/toml" });
  },
}, async (own, server) => {
  await take(own, "square.nc");
  await own.selectOption("#from", "haas");
  await own.selectOption("#machine", { label: "Our own VF-2" });
  await ready(own);
  assert.doesNotMatch(await value(own, "#problems-list"), /no machine/);
  await own.keyboard.press("Control+s");
  await tells(own, "Saved as revision 2");
  const { programs } = await server.ask("GET", "/api/v1/programs");
  assert.deepEqual([programs[0].machine, programs[0].dialect, programs[0].change], ["own-vf2", "haas", "details"]);
  await own.reload();
  await named(own, "square.nc");
  assert.equal(await own.inputValue("#machine"), "machine own-vf2");
  assert.match(await own.locator("#machine option:checked").textContent(), /Our own VF-2/);
});

const CALLS = SQUARE.replace(/T2 M6[^]*M5\n/, "M98 P2000\nM5\n");
const CALLED = "%\nO2000\nG0 X25. Y35.\nG1 Z-3. F150.\nG0 Z10.\nM99\n%\n";

serves("a called program of its folder is executed with it, as it is now", {
  stored: async (server) => {
    await keep(server, "plates/calls.nc", CALLS);
    await keep(server, "other/O2000.nc", CALLED.replace("Z-3.", "Z-9."));
  },
}, async (own, server) => {
  await take(own, "calls.nc");
  assert.match(await value(own, "#problems-list"), /NC0811|NC0217/);
  assert.equal(await own.getAttribute("#canvas", "data-pieces"), "0");
  const called = await keep(server, "plates/O2000.nc", CALLED);
  await type(own, CALLS.replace("(SQUARE)", "(AGAIN)"));
  assert.doesNotMatch(await value(own, "#problems-list"), /NC0811|NC0217/);
  const pieces = Number(await own.getAttribute("#canvas", "data-pieces"));
  assert.ok(pieces > 0);
  await change(server, called, CALLED.replace("G0 Z10.", "G0 Z10.\nX0. Y0."));
  await type(own, CALLS.replace("(SQUARE)", "(ONCE MORE)"));
  assert.equal(Number(await own.getAttribute("#canvas", "data-pieces")), pieces + 1);
  await own.locator("#editor .cm-line", { hasText: "M98" }).click();
  await own.keyboard.press("F12");
  await named(own, "O2000.nc");
});

serves("an edited program is saved as a revision with a message, and not before", { stored: square }, async (own, server) => {
  await take(own, "square.nc");
  await type(own, EDITED);
  await own.waitForTimeout(800);
  assert.equal(await value(own, "#save-state"), "Not saved");
  const revisions = async () => (await server.ask("GET", `/api/v1/programs/${(await server.ask("GET", "/api/v1/programs")).programs[0].id}/revisions`)).revisions;
  assert.equal((await revisions()).length, 1);
  // What was typed outlives the page, and may be discarded.
  await own.reload();
  await named(own, "square.nc");
  assert.match(await content(own), /EDITED/);
  await tells(own, "Unsaved text of this browser");
  await own.locator("#server-told button").click();
  await own.locator("#editor .cm-line", { hasText: "(SQUARE)" }).waitFor();
  await type(own, EDITED);
  await own.fill("#server-message", "deeper pocket");
  await own.keyboard.press("Control+s");
  await tells(own, "Saved as revision 2");
  assert.equal(await value(own, "#save-state"), "Saved");
  const [last] = await revisions();
  assert.deepEqual([last.revision, last.message, last.author, last.change], [2, "deeper pocket", "ana", "text"]);
  assert.equal(await own.inputValue("#server-message"), "");
});

serves("where someone else was first, both are seen, and one's own goes on top", { stored: square }, async (own, server) => {
  const [program] = (await server.ask("GET", "/api/v1/programs")).programs;
  await take(own, "square.nc");
  await type(own, EDITED);
  await change(server, program, THEIRS.replace("F150.", "F140."), "another feed");
  await own.keyboard.press("Control+s");
  const dialog = own.locator("#conflict-dialog");
  await dialog.waitFor();
  assert.match(await dialog.textContent(), /ana changed square\.nc .* revision 2\. Yours comes from revision 1\. Nothing was saved\./);
  assert.match(await dialog.textContent(), /another feed/);
  await dialog.locator("button", { hasText: "See both" }).click();
  await dialog.locator(".cm-line.pair", { hasText: "(EDITED)" }).waitFor();
  await dialog.locator(".cm-line.pair", { hasText: "(THEIRS)" }).waitFor();
  // The lines between those that differ are the same.
  assert.equal(await dialog.locator(".cm-line.pair").count(), 4);
  await dialog.locator("button", { hasText: "Keep mine" }).click();
  await tells(own, "Saved as revision 3");
  assert.equal(await server.ask("GET", `/api/v1/programs/${program.id}/text`), EDITED);
  // The next time theirs is taken; one's own text is a step back.
  await type(own, SQUARE.replace("(SQUARE)", "(MINE)"));
  await change(server, program, THEIRS);
  await own.keyboard.press("Control+s");
  await dialog.locator("button", { hasText: "Take theirs" }).click();
  await own.locator("#editor .cm-line", { hasText: "(THEIRS)" }).waitFor();
  await own.locator("#save-state", { hasText: /^Saved$/ }).waitFor();
  assert.match(await value(own, "#server-about"), /revision 4/);
  await own.locator("#editor .cm-content").click();
  await own.keyboard.press("Control+z");
  await own.locator("#editor .cm-line", { hasText: "(MINE)" }).waitFor();
  // One that was deleted meanwhile is restored with one's own text.
  await server.ask("DELETE", `/api/v1/programs/${program.id}`);
  await own.keyboard.press("Control+s");
  await dialog.locator("p", { hasText: "deleted square.nc" }).waitFor();
  await dialog.locator("button", { hasText: "Keep mine" }).click();
  await tells(own, "Saved as revision 7");
  assert.match(await server.ask("GET", `/api/v1/programs/${program.id}/text`), /MINE/);
});

serves("a program is made, moved, deleted and restored", { stored: square }, async (own, server) => {
  await listed(own);
  await own.fill("#server-new", "shafts/left/key");
  await own.keyboard.press("Enter");
  await named(own, "key.nc");
  assert.match(await value(own, "#server-about"), /^shafts\/left\/key\.nc revision 1/);
  await listed(own);
  await own.getByLabel("Rename or move: shafts/left/key.nc").click();
  await own.keyboard.insertText("plates/square.nc");
  await own.keyboard.press("Enter");
  await tells(own, "There is already a program of this name in this folder.", "#server-list-told");
  await own.getByLabel("Rename or move: shafts/left/key.nc").click();
  await own.keyboard.insertText("shafts/ring.nc");
  await own.keyboard.press("Enter");
  await own.getByLabel("Delete: shafts/ring.nc").waitFor();
  own.on("dialog", (dialog) => dialog.accept());
  await own.getByLabel("Delete: plates/square.nc").click();
  await own.getByLabel("Delete: plates/square.nc").waitFor({ state: "detached" });
  assert.deepEqual(await names(own), ["ring.nc"]);
  await own.click("#server-deleted");
  await own.getByLabel("Restore: plates/square.nc").click();
  await own.locator("#server-list", { hasText: "No deleted programs here." }).waitFor();
  await own.click("#server-deleted");
  await own.getByLabel("Delete: plates/square.nc").waitFor();
  await own.keyboard.press("Escape");
  // The open one is saved under its new name.
  assert.equal(await value(own, "#project-name"), "ring.nc");
  await type(own, EDITED);
  await own.click("#server-save");
  await tells(own, "Saved as revision 3");
  const paths = (await server.ask("GET", "/api/v1/programs")).programs.map(({ folder, name }) => `${folder}/${name}`);
  assert.deepEqual(paths, ["plates/square.nc", "shafts/ring.nc"]);
});

serves("revisions are listed, looked at and restored", {
  stored: async (server) => {
    const made = await square(server);
    await change(server, made, EDITED, "second");
  },
}, async (own, server) => {
  await take(own, "square.nc");
  await own.click("#server-revisions");
  const rows = own.locator("#revisions-list li");
  await rows.nth(1).waitFor();
  assert.match(await rows.nth(0).textContent(), /2 · text · latest.*ana.*second/);
  assert.match(await rows.nth(1).textContent(), /1 · created.*ana.*from the floor/);
  await rows.nth(1).locator(".take").click();
  await tells(own, "Revision 1 of 2, read only", "#server-about");
  await ready(own);
  assert.match(await content(own), /\(SQUARE\)/);
  await own.locator("#editor .cm-content").click();
  await own.keyboard.type("X");
  await own.click("#lay-out");
  await own.waitForTimeout(300);
  assert.match(await content(own), /^%O0100 \(SQUARE\)/);
  await own.click("#server-latest");
  await own.locator("#editor .cm-line", { hasText: "(EDITED)" }).waitFor();
  await own.click("#server-revisions");
  await own.getByLabel("Restore: 1").click();
  await tells(own, "Restored as revision 3");
  await own.locator("#editor .cm-line", { hasText: "(SQUARE)" }).waitFor();
  const [program] = (await server.ask("GET", "/api/v1/programs")).programs;
  assert.deepEqual([program.revision, program.change], [3, "restored"]);
});

serves("files are taken in, dropped too, and given out", { stored: square }, async (own, server) => {
  const file = (name, text) => ({ name, mimeType: "text/plain", buffer: Buffer.from(text) });
  await listed(own);
  const zip = zipSync({ "job/left/a.nc": strToU8("%\nO1\nM30\n%\n"), "../b.nc": strToU8("%\nO2\nM30\n%\n") });
  await own.setInputFiles('#server-section input[type="file"]', [file("square.nc", EDITED), file("new.nc", THEIRS), { name: "job.zip", mimeType: "application/zip", buffer: Buffer.from(zip) }, { name: "broken.zip", mimeType: "application/zip", buffer: Buffer.from(zip.slice(0, 40)) }]);
  const form = own.locator("#server-import form");
  await form.locator("b", { hasText: "Import 4 files" }).waitFor();
  await tells(own, "No zip with programs: broken.zip", "#server-list-told");
  await form.getByLabel("Folder").fill("plates");
  await form.getByLabel("What was changed").fill("taken in");
  await form.locator('button[type="submit"]').click();
  await tells(own, "Imported: 3", "#server-list-told");
  assert.match(await value(own, "#server-list-told"), /plates\/square\.nc: There is already a program of this name/);
  assert.deepEqual(await names(own), ["b.nc", "new.nc", "square.nc", "a.nc"]);
  assert.deepEqual(await own.locator("#server-list .folder").allTextContents(), ["plates", "plates/job/left"]);
  const { programs } = await server.ask("GET", "/api/v1/programs?name=new");
  assert.deepEqual([programs[0].message, programs[0].folder], ["taken in", "plates"]);
  const [download] = await Promise.all([own.waitForEvent("download"), own.click("#server-zip")]);
  const files = unzipSync(readFileSync(await download.path()));
  assert.deepEqual(Object.keys(files).sort(), ["plates/b.nc", "plates/job/left/a.nc", "plates/new.nc", "plates/square.nc"]);
  assert.deepEqual(Buffer.from(files["plates/new.nc"]), Buffer.from(THEIRS));
  await own.keyboard.press("Escape");
  const data = await own.evaluateHandle((text) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], "dropped.nc"));
    return transfer;
  }, SQUARE);
  await own.dispatchEvent("body", "dragenter", { dataTransfer: data });
  await own.dispatchEvent("body", "drop", { dataTransfer: data });
  await form.locator("b", { hasText: "Import dropped.nc" }).waitFor();
  await form.locator('button[type="submit"]').click();
  await named(own, "dropped.nc");
  // A project of the browser goes to the server by the same form.
  await listed(own);
  await own.getByLabel("To the server: pocket-spiral").click();
  await form.getByLabel("Folder").fill("examples");
  await form.locator('button[type="submit"]').click();
  await named(own, "pocket-spiral.nc");
  assert.match(await value(own, "#server-about"), /^examples\//);
});

serves("a translation is made, released and stale", { stored: square }, async (own, server) => {
  await take(own, "square.nc");
  await own.click("#tab-translate");
  await own.selectOption("#to", "siemens");
  await ready(own);
  await tells(own, "No translations of this program", "#translations-list");
  await own.click("#server-translate");
  const row = own.locator("#translations-list li");
  const state = (word) => row.locator("[data-state]", { hasText: word }).waitFor();
  await state("Draft");
  assert.match(await row.textContent(), /siemens.*up to date.*revision 1/);
  const [download] = await Promise.all([own.waitForEvent("download"), row.getByLabel(/^Program: siemens/).click()]);
  assert.match(readFileSync(await download.path(), "utf8"), /CYCLE81/);
  await row.locator('[data-to="in-review"]').click();
  await state("In review");
  await row.locator('[data-to="approved"]').click();
  await state("Approved");
  // What is no more the program's translation is not released, and the server says why.
  const [program] = (await server.ask("GET", "/api/v1/programs")).programs;
  await change(server, program, EDITED);
  await row.locator('[data-to="released"]').click();
  await tells(own, "it is stale: changed since are program", "#translations-told");
  await row.locator(".stale", { hasText: "stale: the program" }).waitFor();
  await own.reload();
  await named(own, "square.nc");
  await own.click("#tab-translate");
  assert.equal(await value(own, "#server-translate"), "Translate revision 2 on the server");
  await own.click("#server-translate");
  await own.locator("#translations-list li").nth(1).waitFor();
  for (const [to, word] of [["in-review", "In review"], ["approved", "Approved"], ["released", "Released"]]) {
    await row.first().locator(`[data-to="${to}"]`).click();
    await row.first().locator("[data-state]", { hasText: word }).waitFor();
  }
  const { states } = await server.ask("GET", `/api/v1/translations/${(await server.ask("GET", "/api/v1/translations?state=released")).translations[0].id}/states`);
  assert.deepEqual(states.map((one) => one.state), ["in-review", "approved", "released"]);
});

serves("an open question is told, and its answer goes to the server", { stored: (server) => keep(server, "asks.nc", ASKS) }, async (own) => {
  await take(own, "asks.nc");
  await own.click("#tab-translate");
  await own.selectOption("#to", "siemens");
  await ready(own);
  await own.click("#server-translate");
  await tells(own, "a question is open", "#translations-told");
  await own.locator("#questions button", { hasText: /^-5 mm$/ }).click();
  await ready(own);
  assert.equal(await value(own, "#answers-told"), "Kept in this browser.");
  await own.click("#server-translate");
  await own.locator("#translations-list [data-state]", { hasText: "Draft" }).waitFor();
});

/** A server that asks for a login, as `/api/v1/session` has it: `ana` with `right`. */
function guarded(state) {
  return async (context) => {
    const told = (route, status, body) => route.fulfill({ status, contentType: status < 400 ? "application/json" : "application/problem+json", body: JSON.stringify(body) });
    const problem = (status, name, title) => ({ type: `urn:ncc:problem:${name}`, title, status, detail: "" });
    const session = () => ({ user: state.user ?? null, login: "needed", rights: [], csrf: state.user ? "proof" : "" });
    await context.route("**/api/v1/**", (route) => {
      const request = route.request();
      if (!state.user) return told(route, 401, problem(401, "login", "log in"));
      if (request.method() !== "GET" && request.headers()["x-ncc-csrf"] !== "proof") return told(route, 403, problem(403, "forbidden", "no"));
      return route.continue();
    });
    await context.route("**/api/v1/session", (route) => {
      const request = route.request();
      if (request.method() === "DELETE") {
        state.user = undefined;
        return route.fulfill({ status: 204 });
      }
      if (request.method() === "POST") {
        const { user, password } = request.postDataJSON();
        if (password !== "right") return told(route, 401, problem(401, "login", "user or password is wrong"));
        state.user = user;
      }
      return told(route, 200, session());
    });
  };
}

async function logIn(own, password = "right", user = "ana") {
  await own.locator("#login").waitFor();
  await own.getByLabel("User").fill(user);
  await own.getByLabel("Password").fill(password);
  await own.keyboard.press("Enter");
}

const state = {};
serves("a login is asked for, a session that ends loses no text, and one logs out", {
  stored: square,
  routes: guarded(state),
  early: async (own) => {
    await own.locator("#login").waitFor();
    // There is no way around it.
    await own.keyboard.press("Escape");
    await own.keyboard.press("Escape");
    await logIn(own, "wrong");
    await tells(own, "User or password is wrong.", "#login .wrong");
    assert.equal(await own.getByLabel("Password").inputValue(), "");
    await logIn(own);
    await own.locator("#login").waitFor({ state: "detached" });
  },
}, async (own, server) => {
  await take(own, "square.nc");
  assert.match(await value(own, "#log-out"), /Log out ana/);
  await type(own, EDITED);
  state.user = undefined;
  await own.keyboard.press("Control+s");
  await logIn(own);
  await tells(own, "Saved as revision 2");
  assert.match(await content(own), /EDITED/);
  assert.equal((await server.ask("GET", "/api/v1/programs")).programs[0].revision, 2);
  await own.click("#log-out");
  await own.locator("#login").waitFor();
  assert.doesNotMatch(await content(own), /EDITED/);
});

serves("accounts of the service log in, and what their rights do not include is told", {
  stored: async (server) => {
    await square(server);
    server.account("root", "admin", "the first account");
    server.account("rita", "reader", "a long password");
    server.account("ed", "editor", "another password");
  },
  early: async (own) => {
    await own.locator("#login").waitFor();
    await own.waitForTimeout(300);
    await logIn(own, "a long password", "rita");
  },
}, async (own) => {
  await take(own, "square.nc");
  await type(own, EDITED);
  await own.keyboard.press("Control+s");
  await tells(own, "You may not do this.");
  assert.equal(await value(own, "#save-state"), "Not saved");
  await own.click("#log-out");
  await logIn(own, "another password", "ed");
  await own.locator("#login").waitFor({ state: "detached" });
  await ready(own);
  await take(own, "square.nc");
  // What rita typed is hers.
  assert.match(await content(own), /\(SQUARE\)/);
  await type(own, THEIRS);
  await own.keyboard.press("Control+s");
  await tells(own, "Saved as revision 2");
  assert.match(await value(own, "#server-about"), /revision 2 · ed/);
});

serves("a server that is gone is told, and nothing typed is lost", { stored: square }, async (own, server, context) => {
  await take(own, "square.nc");
  await type(own, EDITED);
  await context.setOffline(true);
  await own.keyboard.press("Control+s");
  await tells(own, "The server does not answer. Your text is kept in this browser.");
  assert.equal(await value(own, "#save-state"), "Not saved");
  await context.setOffline(false);
  await own.keyboard.press("Control+s");
  await tells(own, "Saved as revision 2");
});

serves("a hostile program and name are text", {}, async (own, server) => {
  const evil = '<img src=x onerror="window.evil=1">';
  await keep(server, `${evil}/${evil}.nc`, `(${evil})\n${evil}\nG1 ${evil}\n`, `&message=${encodeURIComponent(evil)}`);
  await take(own, `${evil}.nc`);
  await own.click("#server-revisions");
  await own.locator("#revisions-list li").waitFor();
  await own.waitForTimeout(200);
  assert.equal(await own.evaluate(() => window.evil), undefined);
  assert.equal(await own.locator("#work img, dialog img").count(), 0);
});

const PHONE = { viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true };

for (const [name, options] of [["light", {}], ["dark, in Portuguese", { colorScheme: "dark", locale: "pt-BR" }], ["a phone", PHONE]]) {
  serves(`axe finds nothing, and nothing is cut off: ${name}`, { stored: square, ...options }, async (own, server) => {
    await own.evaluate(readFileSync(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8"));
    const look = async (place) => {
      const found = await own.evaluate(async () => (await axe.run()).violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.target).join(" ")}`));
      assert.deepEqual(found, [], place);
      const wide = await own.locator("dialog[open], #server-bar, #server-section, #translations-box").evaluateAll((all) => all.filter((one) => one.scrollWidth > one.clientWidth).map((one) => one.id));
      assert.deepEqual(wide, [], place);
    };
    await listed(own);
    await own.setInputFiles('#server-section input[type="file"]', { name: "new.nc", mimeType: "text/plain", buffer: Buffer.from(SQUARE) });
    await own.locator("#server-import form").waitFor();
    await look("the list");
    await own.locator("#server-list .take").first().click();
    await named(own, "square.nc");
    await type(own, EDITED);
    await look("the program");
    await own.click("#server-revisions");
    await own.locator("#revisions-list li").waitFor();
    await look("the revisions");
    await own.keyboard.press("Escape");
    const [program] = (await server.ask("GET", "/api/v1/programs")).programs;
    await change(server, program, THEIRS, "theirs");
    await own.click("#server-save");
    await own.locator("#conflict-dialog .acts button").first().click();
    await own.locator("#conflict-dialog .cm-line.pair").first().waitFor();
    await look("two texts");
    await own.keyboard.press("Escape");
    await own.click(options === PHONE ? '#phone [data-goto="translate"]' : "#tab-translate");
    await own.selectOption("#to", "siemens");
    await ready(own);
    await own.click("#server-translate");
    await own.locator("#translations-list [data-state]").waitFor();
    await look("the translations");
  });
}

const guest = {};
serves("axe finds nothing in the form of the login", { routes: guarded(guest), early: async (own) => {
  await own.locator("#login").waitFor();
  await own.evaluate(readFileSync(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8"));
  assert.deepEqual(await own.evaluate(async () => (await axe.run("#login")).violations.map((one) => one.id)), []);
  await logIn(own);
} }, async (own) => {
  assert.equal(await own.locator("#login").count(), 0);
});
