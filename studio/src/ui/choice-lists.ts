// The lists of dialects and machines: what the compiler knows.

import type { Listed } from "../engine/documents";
import type { Desk } from "../projects/desk";
import type { Choices } from "../projects/project";
import { ANSWERS } from "../projects/zip";
import type { Session } from "../session";
import type { StatedSide } from "../setup/stated";
import { byId, el } from "./dom";
import { say } from "./texts";

/** Dialects for looking at the compiler itself; nobody's machine reads them. */
const INTERNAL = ["ir"];

const LISTS = [
  ["from", "from"],
  ["machine", "machine"],
  ["to", "to"],
  ["machine-to", "machineTo"],
] as const;

export class ChoiceLists {
  constructor(
    private readonly session: Session,
    private readonly desk: Desk,
  ) {
    for (const [id, choice] of LISTS) {
      const list = byId<HTMLSelectElement>(id);
      list.addEventListener("change", () => void this.desk.choose((project) => (project.choices[choice] = list.value)));
    }
    session.project.on((project) => project && this.show(project.choices));
    session.dialect.on(() => this.fill());
    session.stated.on(() => this.fill());
  }

  /** Fills the lists anew: what is recognised stands in them. */
  fill(): void {
    const { dialects, machines } = this.session;
    const own = this.session.dialect.get();
    const title = dialects.find((one) => one.id === own)?.title;
    const recognised = title ? say("recognised", { name: title }) : say("automatic");
    const shown = dialects.filter((one) => !INTERNAL.includes(one.id));
    // What the project file states holds where nothing is chosen.
    const stated = this.session.stated.get();
    const dialect = (side: StatedSide | null | undefined) => {
      const found = dialects.find((one) => one.id === side?.dialect)?.title;
      return found && `${ANSWERS}: ${found}`;
    };
    const machine = (side: StatedSide | null | undefined) => side?.name && `${ANSWERS}: ${machines.find((one) => one.id === side.name)?.title ?? side.name}`;
    put("from", [["auto", dialect(stated?.machine) ?? recognised], ...pairs(shown)]);
    put("machine", [["", machine(stated?.machine) || say("noMachine")], ...pairs(machines)]);
    put("to", [["", dialect(stated?.to) ?? "–"], ...pairs(shown)]);
    put("machine-to", [["", machine(stated?.to) || say("noMachine")], ...pairs(machines)]);
    const project = this.session.project.get();
    if (project) this.show(project.choices);
  }

  private show(choices: Choices): void {
    for (const [id, choice] of LISTS) byId<HTMLSelectElement>(id).value = choices[choice];
  }
}

function pairs(listed: Listed[]): [string, string][] {
  return listed.map(({ id, title }) => [id, title]);
}

function put(id: string, options: [string, string][]): void {
  byId(id).replaceChildren(...options.map(([value, text]) => el("option", { value }, text)));
}
