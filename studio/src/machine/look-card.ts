// The card of material and light. What is chosen is kept in the browser.

import { stored, storeItem } from "../projects/store";
import { el } from "../ui/dom";
import { say, type TextName } from "../ui/texts";
import { card, row } from "./cards";

export interface Look {
  material: string;
  /** `#rrggbb`; empty for the page's own. */
  colour: string;
  /** 0 to 1. */
  metalness: number;
  roughness: number;
  wire: boolean;
  /** Degrees: from +X towards +Y, and above the level. */
  azimuth: number;
  elevation: number;
  /** 0 to 2. */
  brightness: number;
}

const PLAIN: Look = { material: "plain", colour: "", metalness: 0, roughness: 0.6, wire: false, azimuth: 238, elevation: 52, brightness: 1 };

/** Colours as they look under white light; metals return theirs in highlights. */
const MATERIALS: [string, TextName, Partial<Look>][] = [
  ["plain", "plain", { colour: "", metalness: 0, roughness: 0.6 }],
  ["aluminium", "aluminium", { colour: "#c9ced3", metalness: 0.8, roughness: 0.35 }],
  ["steel", "steel", { colour: "#8f969c", metalness: 0.9, roughness: 0.45 }],
  ["brass", "brass", { colour: "#c8a24a", metalness: 0.9, roughness: 0.3 }],
  ["plastic", "plastic", { colour: "#2f6fb5", metalness: 0, roughness: 0.25 }],
  ["wood", "wood", { colour: "#b98a56", metalness: 0, roughness: 0.95 }],
];

const SLIDERS: [keyof Look & ("metalness" | "roughness" | "azimuth" | "elevation" | "brightness"), TextName, number, number, number][] = [
  ["metalness", "metalness", 0, 1, 0.05],
  ["roughness", "roughness", 0, 1, 0.05],
  ["azimuth", "lightFrom", 0, 360, 5],
  ["elevation", "lightAbove", 0, 90, 5],
  ["brightness", "brightness", 0, 2, 0.05],
];

const KEY = "ncc-look";

export class LookCard {
  private look: Look = read();
  private readonly material = el("select", { id: "material", "aria-label": say("material") });
  private readonly colour = el("input", { type: "color", "aria-label": say("colour") });
  private readonly sliders = new Map<string, HTMLInputElement>();
  private readonly wire = el("button", { class: "chip" }, say("wireframe"));

  constructor(
    private readonly own: () => string,
    private readonly changed: (look: Look) => void,
    ...more: Node[]
  ) {
    const custom: [string, TextName] = ["custom", "custom"];
    this.material.append(...[...MATERIALS, custom].map(([value, text]) => el("option", { value }, say(text))));
    this.material.addEventListener("change", () => {
      const found = MATERIALS.find(([name]) => name === this.material.value);
      this.put({ ...(found?.[2] ?? {}), material: this.material.value });
    });
    this.colour.addEventListener("input", () => this.put({ colour: this.colour.value, material: "custom" }));
    for (const [name, text, min, max, step] of SLIDERS) {
      const input = el("input", { type: "range", min, max, step, "aria-label": say(text) });
      const ofMaterial = name === "metalness" || name === "roughness";
      input.addEventListener("input", () => this.put({ [name]: input.valueAsNumber, ...(ofMaterial && { material: "custom" }) }));
      this.sliders.set(name, input);
    }
    this.wire.addEventListener("click", () => this.put({ wire: !this.look.wire }));
    const reset = el("button", { class: "chip" }, say("reset"));
    reset.addEventListener("click", () => this.put(PLAIN));
    const rows = SLIDERS.map(([name, text]) => row(say(text), this.sliders.get(name) as HTMLElement));
    card("look", "look", () => undefined, row(say("material"), this.material), row(say("colour"), this.colour), ...rows, el("div", { class: "row" }, this.wire, reset, ...more));
    this.show();
  }

  /** The page's colours are others. */
  show(): void {
    const { look } = this;
    this.material.value = look.material;
    this.colour.value = look.colour || this.own();
    for (const [name] of SLIDERS) (this.sliders.get(name) as HTMLInputElement).value = String(look[name]);
    this.wire.setAttribute("aria-pressed", String(look.wire));
    this.changed(look);
  }

  private put(change: Partial<Look>): void {
    this.look = { ...this.look, ...change };
    storeItem(KEY, JSON.stringify(this.look));
    this.show();
  }
}

/** What was kept, as far as it is of the form. */
function read(): Look {
  try {
    const kept = JSON.parse(stored(KEY) ?? "{}") as Record<string, unknown>;
    const fits = Object.entries(PLAIN).filter(([name, value]) => typeof kept[name] === typeof value);
    const look: Look = { ...PLAIN, ...Object.fromEntries(fits.map(([name]) => [name, kept[name]])) };
    return /^(#[0-9a-f]{6})?$/.test(look.colour) ? look : PLAIN;
  } catch {
    return PLAIN;
  }
}

/** Where the light comes from, as a direction. */
export function sunOf({ azimuth, elevation }: Look): [number, number, number] {
  const [around, above] = [azimuth, elevation].map((degrees) => (degrees * Math.PI) / 180) as [number, number];
  return [Math.cos(around) * Math.cos(above), Math.sin(around) * Math.cos(above), Math.sin(above)];
}
