// The list of problems under the editor: a click goes to the place.

import type { Problem } from "../engine/documents";
import type { Checked } from "../session";
import { byId, el } from "../ui/dom";
import { say } from "../ui/texts";

/** So many are listed; the editor marks all. */
const MOST = 500;
const SEVERITIES = ["error", "warning", "note"] as const;

export class ProblemList {
  private readonly list = byId("problems-list");
  private readonly head = byId("problems-head");

  constructor(private readonly goTo: (problem: Problem) => void) {
    this.head.addEventListener("click", () => this.toggle(this.list.hidden === true));
  }

  show(checked: Checked): void {
    const { problems, notChecked, told } = checked;
    const counts = SEVERITIES.map((severity): [string, number] => [
      severity,
      problems.filter((one) => one.severity === severity).length,
    ]);
    const dots = counts.filter(([, count]) => count > 0).map(([severity, count]) => dot(severity, String(count)));
    if (told) dots.push(dot("error", ""));
    const none = problems.length === 0 && !told ? [say("noProblems")] : [];
    byId("problems-count").replaceChildren(...dots, ...none);
    const rows = problems.slice(0, MOST).map((problem) => this.row(problem));
    if (told) rows.unshift(el("li", { class: "said" }, el("pre", {}, told)));
    const left = notChecked.map(({ what, why }) => `${what} (${why})`).join("; ");
    if (left) rows.push(el("li", { class: "said" }, `${say("notChecked")}: ${left}`));
    this.list.replaceChildren(...rows);
  }

  private toggle(open: boolean): void {
    this.list.hidden = !open;
    this.head.setAttribute("aria-expanded", String(open));
  }

  private row(problem: Problem): HTMLElement {
    const { severity, place, message, advice, code } = problem;
    const text = el("span", {}, message, el("span", { class: "label" }, place.label));
    text.append(...advice.map((one) => el("span", { class: "advice" }, one)));
    const button = el(
      "button",
      { onclick: () => this.goTo(problem), "data-line": place.line },
      dot(severity, ""),
      el("span", { class: "at" }, String(place.line)),
      text,
      el("span", { class: "id" }, code),
    );
    return el("li", {}, button);
  }
}

function dot(severity: string, text: string): HTMLElement {
  const name = say(severity as (typeof SEVERITIES)[number]);
  return el("span", { class: `dot ${severity}`, title: name, role: "img", "aria-label": `${text} ${name}`.trim() }, text);
}
