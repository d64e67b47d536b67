// The page's frame: words in its elements, light and dark, the split, tabs, panes of a phone.

import { stored, storeItem } from "../projects/store";
import { byId, icon, type Icon } from "./dom";
import { say, type Language, type TextName } from "./texts";

/** Puts words and icons where the page names them. */
export function fillWords(): void {
  for (const place of document.querySelectorAll<HTMLElement>("[data-say]")) {
    place.textContent = say(place.dataset.say as TextName);
  }
  for (const place of document.querySelectorAll<HTMLElement>("[data-label]")) {
    const text = say(place.dataset.label as TextName);
    place.setAttribute("aria-label", text);
    if (place instanceof HTMLButtonElement) place.title = text;
  }
  for (const place of document.querySelectorAll<HTMLElement>("[data-title]")) {
    place.title = say(place.dataset.title as TextName);
  }
  for (const place of document.querySelectorAll<HTMLElement>("[data-icon]")) {
    place.prepend(icon(place.dataset.icon as Icon));
  }
}

const system = matchMedia("(prefers-color-scheme: dark)");

/** Light or dark: the system's, until the button was used. */
export function showTheme(): void {
  const dark = (stored("ncc-theme") ?? (system.matches ? "dark" : "light")) === "dark";
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  byId("theme").replaceChildren(icon(dark ? "sun" : "moon"));
}

/** The button, and the system's changes. */
export function wireTheme(changed: () => void): void {
  const show = () => {
    showTheme();
    changed();
  };
  byId("theme").addEventListener("click", () => {
    storeItem("ncc-theme", document.documentElement.dataset.theme === "dark" ? "light" : "dark");
    show();
  });
  system.addEventListener("change", show);
  show();
}

export function wireLanguage(language: Language): void {
  byId("language").addEventListener("click", () => {
    storeItem("ncc-language", language === "pt" ? "en" : "pt");
    location.reload();
  });
}

/** The line between the editor and the rest: a pointer or arrow keys move it. */
export function wireSplit(): void {
  const split = byId("split");
  const put = (share: number) => {
    const percent = Math.min(75, Math.max(15, share));
    byId("work").style.setProperty("--left", `${percent.toFixed(1)}%`);
    split.setAttribute("aria-valuenow", percent.toFixed(0));
    storeItem("ncc-split", String(percent));
  };
  put(Number(stored("ncc-split") ?? 38));
  split.addEventListener("pointerdown", (event) => {
    split.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  split.addEventListener("pointermove", (event) => {
    if (split.hasPointerCapture(event.pointerId)) put((event.clientX / innerWidth) * 100);
  });
  split.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: -2, ArrowRight: 2 }[event.key];
    if (by) put(Number(split.getAttribute("aria-valuenow")) + by);
  });
}

const TABS = ["machine", "setup", "translate"] as const;
export type Tab = (typeof TABS)[number];
export type Pane = "editor" | "time" | Tab;

/** Tabs beside the editor, and the panes of a phone. */
export class Panes {
  private tab: Tab = "machine";

  constructor(private readonly changed: (tab: Tab, pane: Pane) => void) {
    for (const tab of TABS) {
      const button = byId(`tab-${tab}`);
      button.addEventListener("click", () => this.show(tab, tab));
      button.addEventListener("keydown", (event) => {
        const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (!by) return;
        const other = TABS[(TABS.indexOf(tab) + by + TABS.length) % TABS.length] as Tab;
        this.show(other, other);
        byId(`tab-${other}`).focus();
      });
    }
    for (const button of document.querySelectorAll<HTMLElement>("#phone [data-goto]")) {
      const pane = button.dataset.goto as Pane;
      const tab = TABS.find((one) => one === pane);
      button.addEventListener("click", () => this.show(tab ?? this.tab, pane));
    }
    this.show("machine", "editor");
  }

  show(tab: Tab, pane: Pane): void {
    this.tab = tab;
    document.body.dataset.pane = pane;
    for (const one of TABS) {
      byId(`tab-${one}`).setAttribute("aria-selected", String(one === tab));
      byId(`tab-${one}`).tabIndex = one === tab ? 0 : -1;
      byId(`${one}-pane`).hidden = one !== tab;
    }
    for (const button of document.querySelectorAll<HTMLElement>("#phone [data-goto]")) {
      if (button.dataset.goto === pane) button.setAttribute("aria-current", "page");
      else button.removeAttribute("aria-current");
    }
    this.changed(tab, pane);
  }
}

/** A button that is on or off. */
export function wireToggle(id: string, changed: (on: boolean) => void): void {
  const button = byId(id);
  button.addEventListener("click", () => {
    const on = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(on));
    changed(on);
  });
}
