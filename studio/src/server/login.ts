// The form of a user's name and password. It stands over the page, which stays as it is.

import { el } from "../ui/dom";
import { wordsOf, Refused, type Api, type Session } from "./api";
import { tell } from "./texts";

/** Asks until the server has begun a session. */
export function enter(api: Api): Promise<Session> {
  return new Promise((done) => {
    const user = el("input", { type: "text", name: "user", autocomplete: "username", required: true, autofocus: true });
    const password = el("input", { type: "password", name: "password", autocomplete: "current-password", required: true });
    const wrong = el("p", { class: "wrong", role: "alert" });
    const button = el("button", { class: "primary", type: "submit" }, tell("login"));
    const send = async (event: Event) => {
      event.preventDefault();
      button.disabled = true;
      wrong.textContent = "";
      try {
        const session = await api.logIn(user.value, password.value);
        dialog.remove();
        done(session);
      } catch (error) {
        wrong.textContent = error instanceof Refused && error.status === 401 ? tell("wrongLogin") : wordsOf(error);
        password.value = "";
        password.focus();
      }
      button.disabled = false;
    };
    const dialog = el(
      "dialog",
      { id: "login", "aria-labelledby": "login-title" },
      el("header", {}, el("h2", { id: "login-title" }, tell("login"))),
      el(
        "form",
        { class: "stack", onsubmit: (event) => void send(event) },
        el("p", { class: "dim" }, tell("loginWhy")),
        el("label", {}, tell("user"), user),
        el("label", {}, tell("password"), password),
        button,
      ),
      wrong,
    );
    // Without a session there is nothing to go back to.
    dialog.addEventListener("cancel", (event) => event.preventDefault());
    dialog.addEventListener("keydown", (event) => event.key === "Escape" && event.preventDefault());
    document.body.append(dialog);
    dialog.showModal();
  });
}
