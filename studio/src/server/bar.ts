// The strip above the editor of a program of the server: which revision it is, the message of the next one, save, revisions; and
// whose session it is.

import { byId, el, icon } from "../ui/dom";
import { aboutOf, pathOf, type Server } from "./server";
import { say, tell } from "./texts";

export class Bar {
  private readonly strip = el("div", { id: "server-bar", class: "strip", role: "toolbar", "aria-label": tell("onServer") });
  private readonly about = el("span", { id: "server-about" });
  private readonly message = el("input", { type: "text", id: "server-message", "aria-label": tell("message"), placeholder: tell("message"), maxlength: 500 });
  private readonly save: HTMLButtonElement;
  private readonly told = el("p", { id: "server-told", role: "status" });

  constructor(
    server: Server,
    revisions: () => void,
  ) {
    const { desk, api } = server;
    this.save = el("button", { id: "server-save", title: tell("saveKey"), onclick: () => void server.save() }, say("save"));
    this.message.addEventListener("input", () => (server.message = this.message.value));
    this.message.addEventListener("keydown", (event) => event.key === "Enter" && void server.save());
    const own = this.message;
    const history = el("button", { id: "server-revisions", onclick: revisions }, tell("revisions"));
    const restore = el("button", { id: "server-restore", onclick: () => void server.restore(desk.project?.server?.revision ?? 0) }, tell("restore"));
    const latest = el("button", { id: "server-latest", onclick: () => server.reopen() }, tell("toLatest"));
    this.strip.append(this.about, own, this.save, restore, latest, history);
    byId("editor-bar").before(this.strip, this.told);
    const draw = () => {
      const project = desk.project;
      const place = project?.server;
      this.strip.hidden = !place;
      if (!project || !place) return;
      const isOld = place.latest !== undefined;
      [this.save.hidden, own.hidden, restore.hidden, latest.hidden] = [isOld, isOld, !isOld, !isOld];
      const words = isOld ? tell("older", { revision: place.revision, latest: place.latest ?? 0 }) : aboutOf(place);
      this.about.replaceChildren(el("b", {}, pathOf(place.folder, project.name)), " ", el("span", { class: "dim" }, words));
      own.value = server.message;
    };
    desk.saved.on((state) => {
      draw();
      this.save.disabled = state === "saved" || state === "saving";
      this.save.classList.toggle("primary", state !== "saved");
      this.save.dataset.state = state;
    });
    desk.onProject(draw);
    server.told.on(({ text, bad, act }) => {
      this.told.hidden = text === "";
      this.told.classList.toggle("bad", bad === true);
      this.told.replaceChildren(text, ...(act ? [" ", el("button", { class: "chip", onclick: act[1] }, act[0])] : []));
    });
    const user = el("button", { id: "log-out", hidden: true, onclick: () => void server.logOut() });
    byId("theme").before(user);
    api.session.on((session) => {
      user.hidden = session.login === "none" || session.user === null;
      user.setAttribute("aria-label", `${tell("logout")} ${session.user ?? ""}`);
      user.title = tell("loggedIn", { user: session.user ?? "" });
      user.replaceChildren(icon("leave"), el("span", {}, `${tell("logout")} ${session.user ?? ""}`));
    });
  }
}
