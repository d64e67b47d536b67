// Cards over the picture: each has a button in the strip that shows and hides it.

import { byId, el, icon } from "../ui/dom";
import { say, type TextName } from "../ui/texts";

/** A card with its heading; `changed` is told when it is shown or hidden. */
export function card(name: string, title: TextName, changed: (shown: boolean) => void, ...children: Node[]): HTMLElement {
  const button = byId<HTMLButtonElement>(`${name}-toggle`);
  const shut = el("button", { "aria-label": `${say("close")}: ${say(title)}` });
  shut.append(icon("close"));
  const head = el("header", {}, el("h2", {}, say(title)), shut);
  const made = el("section", { id: `${name}-card`, class: "card", "aria-label": say(title), hidden: true }, head, ...children);
  byId("cards").append(made);
  const put = (shown: boolean) => {
    made.hidden = !shown;
    button.setAttribute("aria-pressed", String(shown));
    changed(shown);
  };
  button.setAttribute("aria-pressed", "false");
  button.setAttribute("aria-controls", made.id);
  button.addEventListener("click", () => put(Boolean(made.hidden)));
  shut.addEventListener("click", () => {
    put(false);
    button.focus();
  });
  return made;
}

/** Whether a card is shown. */
export const isOpen = (name: string): boolean => document.getElementById(`${name}-card`)?.hidden === false;

/** Shows or hides a card, as its button does. */
export function toggleCard(name: string, shown: boolean): void {
  if (isOpen(name) !== shown) byId(`${name}-toggle`).click();
}

/** A labelled row of a card. */
export function row(label: string, ...inputs: (Node | string)[]): HTMLElement {
  return el("label", { class: "row" }, el("span", {}, label), ...inputs);
}
