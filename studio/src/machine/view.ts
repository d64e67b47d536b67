// The picture of the machine: three.js, an orthographic camera that goes around, and a drawing only when something changed.

import {
  Color,
  Group,
  OrthographicCamera,
  Scene,
  Vector3,
  WebGLRenderTarget,
  WebGLRenderer,
  type LineSegments,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Cut, Tool } from "../engine/part";
import type { Box, Path } from "../engine/path";
import { Paths, corner, type Colouring } from "./paths";
import { axesOf, free, gridOf, lights, toolBody } from "./scene";
import { StockView } from "./stock";

export type Side = "iso" | "top" | "front" | "right";

/** Where the eye is, seen from the part, and what is up. */
const SIDES: Record<Side, [Vector3, Vector3]> = {
  iso: [new Vector3(-1, -1.4, 1.1), new Vector3(0, 0, 1)],
  top: [new Vector3(0, 0, 1), new Vector3(0, 1, 0)],
  front: [new Vector3(0, -1, 0), new Vector3(0, 0, 1)],
  right: [new Vector3(1, 0, 0), new Vector3(0, 0, 1)],
};

const NO_PATH: Box = { low: [0, 0, 0], high: [100, 100, 20] };
/** Pixels around a pointer that are looked through for a move. */
const REACH = 9;
/** So many pictures are timed, and one that takes longer is slow, ms. */
const [TRIALS, SLOW] = [5, 60];

/** What is under the pointer: a piece of the path, or the move that cut the part there last. */
export type Picked = { piece: number } | { move: number } | undefined;

export interface Watcher {
  /** The user clicked. */
  picked(what: Picked): void;
  /** The picture was drawn. */
  drawn(view: MachineView): void;
}

export class MachineView {
  readonly paths = new Paths();
  readonly stock = new StockView();
  readonly camera = new OrthographicCamera();
  /** mm between the grid's lines. */
  step = 10;
  /** How often the picture was drawn. */
  frames = 0;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly pickScene = new Scene();
  private readonly target = new WebGLRenderTarget(REACH, REACH);
  private readonly controls: OrbitControls;
  private tool = new Group();
  private toolName = "";
  private readonly surroundings = new Group();
  private box: Box = NO_PATH;
  private asked = false;
  private trials = TRIALS;
  private fitted = false;
  private unfitted = false;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly watcher: Watcher,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.scene.add(this.surroundings, this.stock.drawn, this.paths.drawn, this.tool, lights());
    this.pickScene.add(this.stock.pick, this.paths.pick);
    this.pickScene.background = new Color(0);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.draw());
    this.tool.visible = false;
    this.restyle();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement as HTMLElement);
    this.wire();
  }

  /** Another path with its part, or none. */
  setPath(path: Path | undefined, cut: Cut | undefined, keepEye: boolean): void {
    this.paths.set(path);
    this.stock.open(cut);
    const box = path && path.pieces > 0 ? path.box : NO_PATH;
    this.box = cut ? around(box, cut.raw) : box;
    this.tool.visible = Boolean(path && path.pieces > 0);
    this.surround();
    if (!keepEye || !this.fitted) this.look("iso");
    this.fitted = Boolean(path);
    this.draw();
  }

  setNow(move: number, share: number, place: [number, number, number]): void {
    this.paths.setNow(move, share);
    this.tool.position.set(...place);
    this.draw();
  }

  /** The tool that is in. */
  setTool(tool: Tool | undefined): void {
    const name = tool ? `${tool.shape} ${tool.diameter}` : "";
    if (name === this.toolName) return;
    this.toolName = name;
    free(this.tool);
    this.tool.clear();
    if (tool) this.tool.add(toolBody(tool.shape, tool.diameter));
    this.draw();
  }

  setMarked(first: number, last: number): void {
    this.paths.setMarked(first, last);
    this.draw();
  }

  setColouring(by: Colouring): void {
    this.paths.setColouring(by);
    this.stock.setByTool(by === "tool");
    this.draw();
  }

  /** Looks from a side, with all of the path in the picture. */
  look(side: Side): void {
    const [from, up] = SIDES[side];
    // The controls take what is up once; a view from above has the same turned.
    const eye = side === "top" ? new Vector3(0, -1e-4, 1) : from;
    this.camera.up.copy(side === "top" ? new Vector3(0, 0, 1) : up);
    this.controls.target.copy(this.centre());
    this.camera.position.copy(this.controls.target).addScaledVector(eye.clone().normalize(), this.reach() * 4);
    this.camera.lookAt(this.controls.target);
    this.fit();
  }

  /** Brings all of the path into the picture, from where the eye is. */
  fit(): void {
    // A picture that nobody sees has no size to fit into yet.
    this.unfitted = this.canvas.clientWidth === 0;
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    this.controls.target.copy(this.centre());
    this.camera.position.copy(this.controls.target).addScaledVector(direction, this.reach() * 4);
    this.camera.near = 0.01;
    this.camera.far = this.reach() * 8 + 10;
    this.camera.lookAt(this.controls.target);
    this.camera.updateMatrixWorld();
    const { low, high } = this.box;
    let [wide, tall] = [1e-3, 1e-3];
    for (const x of [low[0], high[0]])
      for (const y of [low[1], high[1]])
        for (const z of [low[2], high[2]]) {
          const seen = new Vector3(x, y, z).applyMatrix4(this.camera.matrixWorldInverse);
          wide = Math.max(wide, Math.abs(seen.x));
          tall = Math.max(tall, Math.abs(seen.y));
        }
    const { right, top } = this.camera;
    this.camera.zoom = Math.min(right / wide, top / tall) * 0.8;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  /** Comes nearer, or goes away. */
  zoom(by: number): void {
    this.camera.zoom *= by;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** The page's colours are others. */
  restyle(): void {
    const style = getComputedStyle(document.documentElement);
    const ink = (name: string) => new Color().setStyle(style.getPropertyValue(name).trim() || "#888").convertLinearToSRGB();
    this.paths.setInks(ink);
    this.stock.setInks(ink);
    this.renderer.setClearColor(new Color(style.getPropertyValue("--ground").trim()), 1);
    this.surround();
    this.draw();
  }

  /** Draws soon, once for all that changed until then. */
  draw(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      if (this.canvas.clientWidth === 0) return;
      const eye = this.camera.position.clone().sub(this.controls.target).normalize();
      this.stock.setEye(eye.x, eye.y, eye.z);
      this.render();
      this.frames += 1;
      this.watcher.drawn(this);
    });
  }

  /** Draws; the first pictures of a part are timed, and where they take too long the part has fewer points. */
  private render(): void {
    const began = performance.now();
    this.renderer.render(this.scene, this.camera);
    if (this.trials === 0 || !this.stock.drawn.visible) return;
    this.trials -= 1;
    const gl = this.renderer.getContext();
    // To read a pixel is to wait until it is there.
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    // The first one compiles and uploads.
    if (this.trials < TRIALS - 1 && performance.now() - began > SLOW && this.stock.coarser()) this.draw();
  }

  /** What is under a place of the picture, in its pixels. */
  under(x: number, y: number): Picked {
    const { clientWidth, clientHeight } = this.canvas;
    const half = (REACH - 1) / 2;
    this.camera.setViewOffset(clientWidth, clientHeight, x - half, y - half, REACH, REACH);
    this.paths.setPickSize(REACH);
    this.renderer.setRenderTarget(this.target);
    this.renderer.render(this.pickScene, this.camera);
    const pixels = new Uint8Array(REACH * REACH * 4);
    this.renderer.readRenderTargetPixels(this.target, 0, 0, REACH, REACH, pixels);
    this.renderer.setRenderTarget(null);
    this.camera.clearViewOffset();
    let [best, found]: [number, Picked] = [Infinity, undefined];
    for (let at = 0; at < REACH * REACH; at += 1) {
      const [red, green, blue, alpha] = pixels.subarray(at * 4, at * 4 + 4) as unknown as [number, number, number, number];
      const id = red + green * 256 + blue * 65536;
      const part = alpha < 200;
      // A line is thin: it comes before what lies around it.
      const far = Math.hypot((at % REACH) - half, Math.floor(at / REACH) - half) + (part ? REACH : 0);
      if (id > 0 && far < best) [best, found] = [far, part ? { move: id } : { piece: id - 1 }];
    }
    return found;
  }

  private wire(): void {
    let down: [number, number] = [0, 0];
    this.canvas.addEventListener("pointerdown", (event) => (down = [event.offsetX, event.offsetY]));
    this.canvas.addEventListener("pointerup", (event) => {
      const moved = Math.hypot(event.offsetX - down[0], event.offsetY - down[1]);
      if (event.button === 0 && moved < 4) this.watcher.picked(this.under(event.offsetX, event.offsetY));
    });
    this.canvas.addEventListener("webglcontextrestored", () => this.draw());
  }

  private centre(): Vector3 {
    return corner(this.box.low).add(corner(this.box.high)).multiplyScalar(0.5);
  }

  /** Half the box's diagonal, and more than nothing. */
  private reach(): number {
    return Math.max(5, corner(this.box.high).distanceTo(corner(this.box.low)) / 2);
  }

  private surround(): void {
    for (const child of [...this.surroundings.children] as (Group | LineSegments)[]) {
      free(child);
      this.surroundings.remove(child);
    }
    const style = getComputedStyle(document.documentElement);
    const { grid, step } = gridOf(this.box, new Color(style.getPropertyValue("--grid").trim()));
    this.step = step;
    this.surroundings.add(grid, axesOf(step * 1.5));
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement as HTMLElement;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    const tall = 100;
    [this.camera.top, this.camera.bottom] = [tall, -tall];
    [this.camera.left, this.camera.right] = [(-tall * width) / height, (tall * width) / height];
    this.camera.updateProjectionMatrix();
    this.paths.setSize(width, height, 1);
    if (this.unfitted) this.fit();
    this.draw();
  }
}

/** A box around two. */
function around(a: Box, b: Box): Box {
  const axes = [0, 1, 2] as const;
  const [x0, y0, z0] = axes.map((axis) => Math.min(a.low[axis], b.low[axis])) as [number, number, number];
  const [x1, y1, z1] = axes.map((axis) => Math.max(a.high[axis], b.high[axis])) as [number, number, number];
  return { low: [x0, y0, z0], high: [x1, y1, z1] };
}

/** Whether the browser draws with WebGL 2. */
export function hasWebgl(): boolean {
  return document.createElement("canvas").getContext("webgl2") !== null;
}
