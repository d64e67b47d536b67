// Names at places of the picture: elements over it, put where their places are seen.

import { byId, el } from "../ui/dom";
import { seenAt, type Eye, type Point } from "./pick";

export class Labels {
  private readonly all = new Map<string, [HTMLElement, Point]>();

  /** A name at a place, or none any more. */
  put(key: string, text: string, at: Point | undefined): void {
    const known = this.all.get(key);
    if (!at) {
      known?.[0].remove();
      this.all.delete(key);
      return;
    }
    const place = known?.[0] ?? el("span", { class: `tag ${key.replace(/\W.*/, "")}` });
    place.textContent = text;
    if (!known) byId("labels").append(place);
    this.all.set(key, [place, at]);
  }

  /** Takes away all whose keys begin so. */
  clear(prefix: string): void {
    for (const key of [...this.all.keys()]) if (key.startsWith(prefix)) this.put(key, "", undefined);
  }

  draw(eye: Eye): void {
    for (const [place, at] of this.all.values()) {
      const [x, y] = seenAt(eye, at);
      place.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    }
  }
}
