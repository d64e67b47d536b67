// Elements. Text goes in as text, never as HTML: names and programs are others' words.

type Props = Record<string, string | number | boolean | ((event: Event) => void) | undefined>;

/** An element with attributes, listeners (`onclick`) and children. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  props: Props = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (typeof value === "function") made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== undefined) made.setAttribute(name, String(value));
  }
  made.append(...children);
  return made;
}

/** The element with an id, which the page has. */
export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no element ${id}`);
  return found as T;
}

/** Outlines of icons, in a square of 16. */
const ICONS = {
  play: "M5 3.2v9.6l7.5-4.8z",
  pause: "M4.5 3.5h2.5v9h-2.5zM9 3.5h2.5v9h-2.5z",
  next: "M4 3.5l6 4.5-6 4.5zM11 3.5h1.6v9h-1.6z",
  previous: "M12 3.5l-6 4.5 6 4.5zM3.4 3.5h1.6v9h-1.6z",
  start: "M3 3.5h1.6v9h-1.6zM13 3.5l-4.4 4.5 4.4 4.5zM8.8 3.5l-4.4 4.5 4.4 4.5z",
  end: "M11.4 3.5h1.6v9h-1.6zM3 3.5l4.4 4.5-4.4 4.5zM7.2 3.5l4.4 4.5-4.4 4.5z",
  tool: "M6 1.5h4v4h-1v5l-1 4-1-4v-5h-1z",
  sun: "M8 5a3 3 0 100 6 3 3 0 000-6zM7.4 1h1.2v2.4h-1.2zM7.4 12.6h1.2v2.4h-1.2zM1 7.4h2.4v1.2h-2.4zM12.6 7.4h2.4v1.2h-2.4zM2.6 3.5l.9-.9 1.7 1.7-.9.9zM10.8 11.7l.9-.9 1.7 1.7-.9.9zM3.5 13.4l-.9-.9 1.7-1.7.9.9zM11.7 5.2l-.9-.9 1.7-1.7.9.9z",
  moon: "M6.2 1.8a6.3 6.3 0 108 8 5.2 5.2 0 01-8-8z",
  leave: "M2 2h7v1.4h-5.6v9.2h5.6v1.4h-7zM10.4 4.6l3.400 3.400-3.400 3.400-1-1 1.700-1.700h-5.100v-1.400h5.100l-1.700-1.700z",
  folder: "M1.5 3h4.6l1.4 1.6h7v8.4h-13z",
  plus: "M7.2 3h1.6v4.2h4.2v1.6h-4.2v4.2h-1.6v-4.2h-4.2v-1.6h4.2z",
  close: "M3.6 4.7l1.1-1.1 3.3 3.3 3.3-3.3 1.1 1.1-3.3 3.3 3.3 3.3-1.1 1.1-3.3-3.3-3.3 3.3-1.1-1.1 3.3-3.3z",
  fit: "M2 2h4v1.4h-2.6v2.6h-1.4zM10 2h4v4h-1.4v-2.6h-2.6zM2 10h1.4v2.6h2.6v1.4h-4zM12.6 10h1.4v4h-4v-1.4h2.6z",
  save: "M7.3 2h1.4v6l2.2-2.2 1 1-3.9 3.9-3.9-3.9 1-1 2.2 2.2zM2.5 11h1.4v1.8h8.2v-1.8h1.4v3.2h-11z",
  follow: "M7.3 1h1.4v2.1a5 5 0 014.2 4.2h2.1v1.4h-2.1a5 5 0 01-4.2 4.2v2.1h-1.4v-2.1a5 5 0 01-4.2-4.2h-2.1v-1.4h2.1a5 5 0 014.2-4.2zM8 4.4a3.6 3.6 0 100 7.2 3.6 3.6 0 000-7.2z",
  section: "M2 3.500h5v9h-5zM9 2h1.400v12h-1.400zM12 4.500h2.500v1.400h-2.500zM12 7.300h2.500v1.400h-2.500zM12 10.100h2.500v1.400h-2.500z",
  measure: "M1.500 5.500h13v5h-13zM2.900 6.900v2.200h1.200v-1.100h1.200v1.100h1.300v-2.200h1.200v2.200h1.300v-1.100h1.200v1.100h1.300v-2.200z",
  look: "M8 1.500a6.500 6.500 0 100 13 6.500 6.500 0 000-13zM8 2.900v10.200a5.100 5.100 0 010-10.200z",
  chart: "M2 2h1.4v10.6h10.6v1.4h-12zM5 9.6l2.6-3.6 2.2 2 3-4.4 1.1.8-3.9 5.7-2.2-2-1.7 2.3z",
  language: "M8 1.5a6.5 6.5 0 100 13 6.5 6.5 0 000-13zM8 2.9c.8 0 1.7 1.6 1.9 4h-3.8c.2-2.4 1.1-4 1.9-4zM5.8 3.4c-.6 1-.9 2.2-1 3.5h-1.8a5.1 5.1 0 012.8-3.5zM10.2 3.4a5.1 5.1 0 012.8 3.5h-1.8c-.1-1.300-.4-2.5-1-3.500zM3 8.300h1.800c.1 1.500.4 2.800 1 3.800a5.100 5.100 0 01-2.800-3.800zM6.100 8.300h3.800c-.2 2.900-1.100 4.800-1.900 4.800s-1.700-1.900-1.900-4.800zM11.200 8.300h1.800a5.100 5.100 0 01-2.800 3.800c.6-1 .9-2.300 1-3.800z",
} as const;

export type Icon = keyof typeof ICONS;

/** An icon, hidden from readers: its button has the name. */
export function icon(name: Icon): SVGSVGElement {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  svg.setAttribute("viewBox", "0 0 16 16");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(space, "path");
  path.setAttribute("d", ICONS[name]);
  svg.append(path);
  return svg;
}
