// The 2-D plan: the moves from above and the frame of the raw part, beside the picture or in its place. It is drawn by the
// picture's renderer and copied, so that the graphics card holds everything once.

import { OrthographicCamera } from "three";
import type { Box } from "../engine/path";
import { byId } from "../ui/dom";

export class Plan {
  readonly camera = new OrthographicCamera();
  readonly canvas = byId<HTMLCanvasElement>("plan");
  private middle: [number, number] = [0, 0];
  /** Pixels a mm. */
  private scale = 1;
  private readonly pen = this.canvas.getContext("2d") as CanvasRenderingContext2D;
  private box: Box | undefined;

  constructor(
    private readonly draw: () => void,
    private readonly picked: (x: number, y: number) => void,
  ) {
    this.camera.up.set(0, 1, 0);
    this.wire();
  }

  get shown(): boolean {
    return !this.canvas.hidden && this.canvas.clientWidth > 0;
  }

  /** mm of a pixel, without end where nobody sees it. */
  get pixel(): number {
    return this.shown ? 1 / this.scale : Infinity;
  }

  /** Looks at a box; keeps place and scale where there is one already, unless all of it is wanted. */
  open(box: Box, fit = this.box === undefined): void {
    this.box = box;
    if (fit) this.fit();
  }

  fit(): void {
    const { box } = this;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!box || width === 0) return;
    this.middle = [(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2];
    this.scale = Math.min(width / Math.max(box.high[0] - box.low[0], 1e-3), height / Math.max(box.high[1] - box.low[1], 1e-3)) * 0.86;
    this.draw();
  }

  /** The camera for a picture of so many pixels. */
  prepare(): [number, number] {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const { camera, scale } = this;
    const [half, tall] = [width / 2 / scale, height / 2 / scale];
    [camera.left, camera.right, camera.bottom, camera.top] = [-half, half, -tall, tall];
    const top = (this.box?.high[2] ?? 0) + 1000;
    camera.position.set(...this.middle, top);
    [camera.near, camera.far] = [0.1, top - (this.box?.low[2] ?? 0) + 2000];
    camera.rotation.set(0, 0, 0);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return [width, height];
  }

  /** Takes over what the renderer has drawn, of which a part of so many pixels is the plan. */
  copy(from: HTMLCanvasElement, width: number, height: number): void {
    if (this.canvas.width !== width || this.canvas.height !== height) [this.canvas.width, this.canvas.height] = [width, height];
    // The renderer counts rows from below.
    this.pen.drawImage(from, 0, from.height - height, width, height, 0, 0, width, height);
  }

  zoom(by: number, x = this.canvas.clientWidth / 2, y = this.canvas.clientHeight / 2): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const [right, up] = [(x - width / 2) / this.scale, (height / 2 - y) / this.scale];
    // The place under the pointer stays there.
    this.middle[0] += right * (1 - 1 / by);
    this.middle[1] += up * (1 - 1 / by);
    this.scale *= by;
    this.draw();
  }

  private pan(x: number, y: number): void {
    this.middle[0] -= x / this.scale;
    this.middle[1] += y / this.scale;
    this.draw();
  }

  private wire(): void {
    const { canvas } = this;
    let [moved, apart] = [0, 0];
    const down = new Map<number, [number, number]>();
    canvas.addEventListener("pointerdown", (event) => {
      down.set(event.pointerId, [event.clientX, event.clientY]);
      canvas.setPointerCapture(event.pointerId);
      [moved, apart] = [0, 0];
    });
    canvas.addEventListener("pointermove", (event) => {
      const last = down.get(event.pointerId);
      if (!last) return;
      const [x, y] = [event.clientX - last[0], event.clientY - last[1]];
      down.set(event.pointerId, [event.clientX, event.clientY]);
      moved += Math.hypot(x, y);
      this.pan(x / down.size, y / down.size);
      if (down.size !== 2) return;
      const [[ax, ay], [bx, by]] = [...down.values()] as [[number, number], [number, number]];
      const now = Math.hypot(ax - bx, ay - by);
      if (apart > 0) this.zoom(now / apart);
      apart = now;
    });
    const up = (event: PointerEvent) => {
      if (down.delete(event.pointerId) && moved < 4 && event.type === "pointerup") this.picked(event.offsetX, event.offsetY);
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(1.0015 ** -event.deltaY, event.offsetX, event.offsetY);
    });
    canvas.addEventListener("keydown", (event) => {
      const step = 40;
      const does: Record<string, () => void> = {
        ArrowLeft: () => this.pan(step, 0),
        ArrowRight: () => this.pan(-step, 0),
        ArrowUp: () => this.pan(0, step),
        ArrowDown: () => this.pan(0, -step),
        "+": () => this.zoom(1.25),
        "-": () => this.zoom(0.8),
        f: () => this.fit(),
      };
      const one = does[event.key];
      if (!one || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      one();
    });
  }
}
