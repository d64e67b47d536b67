// Translations of the open program on the server: made, looked at, and put from state to state. Who may do that, the server says.

import { download } from "../projects/desk";
import { byId, el } from "../ui/dom";
import { wordsOf } from "./api";
import type { Translated } from "./programs";
import { aboutOf, type Server } from "./server";
import { tell, tellOf } from "./texts";

/** The states that may follow each. */
const NEXT: Record<string, string[]> = {
  draft: ["in-review", "obsolete"],
  "in-review": ["approved", "draft", "obsolete"],
  approved: ["released", "draft", "obsolete"],
  released: ["obsolete"],
  obsolete: ["draft"],
};

export class Translations {
  private readonly make = el("button", { class: "primary", id: "server-translate" });
  private readonly note = el("input", { type: "text", "aria-label": tell("stateMessage"), placeholder: tell("stateMessage"), maxlength: 500 });
  private readonly told = el("p", { id: "translations-told", role: "status" });
  private readonly list = el("ul", { id: "translations-list" });
  private readonly box = el("details", { id: "translations-box", open: true });
  private shown = "";

  constructor(private readonly server: Server) {
    const { desk } = server;
    this.make.addEventListener("click", () => void this.translate());
    const head = el("div", { class: "fields" }, this.make, this.note);
    this.box.append(el("summary", {}, tell("translations")), head, this.told, this.list);
    byId("messages-box").before(this.box);
    desk.onProject(() => this.draw());
    desk.saved.on(() => this.draw());
    // Something may have gone stale, or been put into another state.
    byId("tab-translate").addEventListener("click", () => void this.fill());
    byId("phone").addEventListener("click", () => void this.fill());
  }

  private draw(): void {
    const project = this.server.desk.project;
    const place = project?.server;
    this.box.hidden = !place || place.latest !== undefined;
    if (!project || !place) return;
    this.make.textContent = tell("translateHere", { revision: place.revision });
    this.make.disabled = !project.choices.to && !project.choices.machineTo;
    const key = `${place.program} ${place.revision}`;
    if (key === this.shown) return;
    this.shown = key;
    this.say("");
    void this.fill();
  }

  private say(text: string, bad = false): void {
    this.told.textContent = text;
    this.told.classList.toggle("bad", bad);
  }

  private async translate(): Promise<void> {
    const project = this.server.desk.project;
    const place = project?.server;
    if (!project || !place) return;
    const { to, machineTo, fromOption, toOption, pass } = project.choices;
    if (pass.length > 0) return this.say(tell("noPasses", { pass: pass.join(", ") }), true);
    this.make.disabled = true;
    this.say(this.server.desk.saved.get() === "unsaved" ? tell("saveFirst") : "");
    try {
      await this.server.programs.translate({
        program: place.program,
        revision: place.revision,
        ...(to && { to }),
        ...(machineTo && { machine_to: this.server.nameOf(machineTo) }),
        from_option: fromOption,
        to_option: toOption,
      });
      await this.fill();
    } catch (error) {
      this.say(wordsOf(error), true);
    }
    this.make.disabled = false;
  }

  private async step(one: Translated, state: string): Promise<void> {
    this.say("");
    try {
      await this.server.programs.step(one.id, state, this.note.value);
      this.note.value = "";
    } catch (error) {
      this.say(wordsOf(error), true);
    }
    await this.fill();
  }

  private async fill(): Promise<void> {
    const place = this.server.desk.project?.server;
    if (!place || this.box.hidden) return;
    try {
      const all = await this.server.programs.translations(place.program);
      if (this.server.desk.project?.server?.program !== place.program) return;
      all.sort((a, b) => b.revision - a.revision || b.made.localeCompare(a.made));
      const none = el("li", { class: "dim" }, tell("noTranslations"));
      this.list.replaceChildren(...(all.length > 0 ? all.map((one) => this.row(one)) : [none]));
    } catch (error) {
      this.say(wordsOf(error), true);
    }
  }

  private row(one: Translated): HTMLElement {
    const target = [one.asked.machine_to, one.asked.to].filter(Boolean).join(" · ");
    const stale = one.stale.map((what) => tellOf("stale", what)).join(", ");
    const state = el("span", { class: `state-${one.state}`, "data-state": one.state }, tellOf("state", one.state));
    const fresh = el("span", { class: stale ? "stale" : "dim" }, stale ? tell("isStale", { what: stale }) : tell("upToDate"));
    const about = el("p", {}, el("b", {}, target), " ", state, " ", fresh, el("small", {}, aboutOf(one)));
    const steps = (NEXT[one.state] ?? []).map((next) =>
      el("button", { class: next === "released" || next === "approved" ? "primary" : "", "data-to": next, onclick: () => void this.step(one, next) }, tellOf("to", next)),
    );
    const files = (["output", "report", "certificate"] as const).map((what) =>
      el("button", { "aria-label": `${tell(what)}: ${target}, ${one.revision}`, onclick: () => void this.fetch(one, what) }, tell(what)),
    );
    return el("li", {}, about, el("div", { class: "acts" }, ...steps, ...files));
  }

  private async fetch(one: Translated, what: "output" | "report" | "certificate"): Promise<void> {
    this.say("");
    try {
      const bytes = await this.server.programs.outcome(one.id, what);
      const stem = (this.server.desk.project?.file ?? "program").replace(/\.\w+$/, "");
      download(what === "output" ? `${stem}-${one.asked.to ?? one.asked.machine_to ?? "translated"}.nc` : `${stem}-${what}.json`, bytes);
    } catch (error) {
      this.say(wordsOf(error), true);
    }
  }
}
