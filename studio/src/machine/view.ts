// The picture of the machine: three.js, an orthographic camera that goes around, and a drawing only when something changed.

import {
  Color,
  Group,
  OrthographicCamera,
  Scene,
  Vector3,
  Vector4,
  WebGLRenderTarget,
  WebGLRenderer,
  type Object3D,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Cut, Tool } from "../engine/part";
import type { Box, Path } from "../engine/path";
import { Labels } from "./labels";
import { linesOf, setLinesSize } from "./lines";
import { sunOf, type Look } from "./look-card";
import { Paths, corner, type Colouring } from "./paths";
import { endsOf, seenAt, type Eye, type Point } from "./pick";
import { Plan } from "./plan";
import { axesOf, frameOf, free, gridOf, heldBody, lights, toolBody } from "./scene";
import { CutFace, planeOf, type Section } from "./section";
import { StockView } from "./stock";

export type Side = "iso" | "top" | "front" | "right";

/** Where the eye is, seen from the part, and what is up. */
const SIDES: Record<Side, [Vector3, Vector3]> = {
  iso: [new Vector3(-1, -1.4, 1.1), new Vector3(0, 0, 1)],
  top: [new Vector3(0, 0, 1), new Vector3(0, 1, 0)],
  front: [new Vector3(0, -1, 0), new Vector3(0, 0, 1)],
  right: [new Vector3(1, 0, 0), new Vector3(0, 0, 1)],
};

/** The direction of a tool that does not lean. */
const UPRIGHT = new Vector3(0, 0, 1);

const NO_PATH: Box = { low: [0, 0, 0], high: [100, 100, 20] };
/** Pixels around a pointer that are looked through for a move. */
const REACH = 9;
/** A picture that a newer part will change waits so long for it, ms. */
export const PART_COMES = 300;
/** Without smooth edges, a picture that stayed as it is for so long is drawn with them, ms. */
const CALM = 250;
/** So many pictures are timed, and one that takes longer is slow, ms. */
const [TRIALS, SLOW] = [6, 60];

/** What is under the pointer: a piece of the path, or the move that cut the part there last. */
export type Picked = { piece: number } | { move: number } | undefined;

export interface Watcher {
  /** The user clicked, at a place in pixels of the picture. */
  picked(what: Picked, pixel: [number, number]): void;
  /** The picture was drawn. */
  drawn(view: MachineView): void;
}

export class MachineView {
  readonly paths = new Paths();
  readonly stock = new StockView();
  readonly camera = new OrthographicCamera();
  readonly labels = new Labels();
  readonly plan = new Plan(
    () => this.draw(),
    (x, y) => this.watcher.picked(this.under(x, y, this.plan.camera, this.plan.canvas), [x, y]),
  );
  /** Whether the time of each picture is measured, and the last one, ms. */
  timed = false;
  spent = 0;
  /** How long the last picture took that was timed on its own account, ms. */
  lasted = 0;
  /** mm between the grid's lines. */
  step = 10;
  /** How often the picture was drawn, and how often of that for its edges alone. */
  frames = 0;
  smoothed = 0;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly pickScene = new Scene();
  private readonly target = new WebGLRenderTarget(REACH, REACH);
  private readonly controls: OrbitControls;
  private tool = new Group();
  private toolName = "";
  private readonly surroundings = new Group();
  private readonly bench = new Group();
  private readonly measured = new Group();
  private frame: Object3D = new Group();
  private readonly face = new CutFace(this.stock.uniforms);
  private section: Section | undefined;
  private cut: Cut | undefined;
  private look_: Look | undefined;
  private bodies: ReadonlyMap<string, Uint8Array> = new Map();
  private box: Box = NO_PATH;
  private path: Path | undefined;
  private asked = false;
  private late = 0;
  private calm = 0;
  /** Whether the next picture has smooth edges. */
  private fine = false;
  private trials = TRIALS;
  /** Whether it is known that more would be too much. */
  private settled = false;
  /** Whether the device draws slowly, as far as its pictures tell: until then it does. */
  private slow = true;
  private fitted = false;
  private unfitted = false;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly drawing: Drawing,
    private readonly watcher: Watcher,
  ) {
    this.renderer = new WebGLRenderer({ canvas, context: drawing.context });
    this.renderer.setPixelRatio(drawing.smooth ? Math.min(2, devicePixelRatio) : 2);
    this.scene.add(this.surroundings, this.bench, this.stock.drawn, this.stock.faces.drawn, this.face.drawn, this.paths.drawn, this.measured, this.tool, lights());
    this.pickScene.add(this.stock.pick, this.stock.faces.pick, this.paths.pick);
    this.pickScene.background = new Color(0);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.draw());
    this.tool.visible = false;
    this.restyle();
    // A path may come before the observer tells.
    this.resize();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement as HTMLElement);
    this.wire();
  }

  /** Another path with its part, or none. */
  setPath(path: Path | undefined, cut: Cut | undefined, keepEye: boolean): void {
    // After an edit the program is drawn as fast as before.
    const alike = keepEye && isAlike(this.path, path, [this.cut, cut]);
    this.path = path;
    if (!alike) {
      this.trials = TRIALS;
      this.settled = false;
    }
    this.paths.set(path, this.slow, alike);
    this.stock.open(cut, this.slow);
    this.cut = cut;
    this.face.show(this.section, cut);
    const box = path && path.pieces > 0 ? path.box : NO_PATH;
    this.box = cut ? around(box, cut.raw) : box;
    this.tool.visible = Boolean(path && path.pieces > 0);
    this.surround();
    this.setBench(this.bodies);
    this.plan.open(this.box, !keepEye || !this.fitted);
    if (!keepEye || !this.fitted) this.look("iso");
    this.fitted = Boolean(path);
    this.draw();
  }

  /** The piece under way and how much of it is done, where the tip is, and the direction of the tool from there. Where the part
   * comes, too, a device that draws slowly waits for it. */
  setNow(move: number, share: number, place: Point, direction: Point, partComes: boolean): void {
    this.paths.setNow(move, share);
    this.tool.position.set(...place);
    this.tool.quaternion.setFromUnitVectors(UPRIGHT, new Vector3(...direction));
    this.canvas.dataset.leans = direction.map((part) => part.toFixed(4)).join(" ");
    if (!partComes || this.isQuick) return this.draw();
    clearTimeout(this.calm);
    // While a program plays, moments follow each other faster than that: the first of them counts.
    this.late ||= window.setTimeout(() => this.draw(), PART_COMES);
  }

  /** The tool that is in. */
  setTool(tool: Tool | undefined): void {
    const name = tool ? JSON.stringify([tool.outline, tool.flute, tool.shank, tool.holder]) : "";
    if (name === this.toolName) return;
    this.toolName = name;
    this.canvas.dataset.tool = name;
    free(this.tool);
    this.tool.clear();
    if (tool) this.tool.add(toolBody(tool));
    this.draw();
  }

  setMarked(first: number, last: number): void {
    this.paths.setMarked(first, last);
    this.draw();
  }

  setColouring(by: Colouring): void {
    this.paths.setColouring(by);
    this.draw();
  }

  setSection(section: Section | undefined): void {
    this.section = section;
    const plane = planeOf(section);
    this.stock.uniforms.section!.value = plane;
    this.paths.setSection(plane);
    this.face.show(section, this.stock.drawn.visible ? this.cut : undefined);
    this.draw();
  }

  setStock(on: boolean): void {
    this.stock.setVisible(on);
    this.face.show(this.section, on ? this.cut : undefined);
    this.draw();
  }

  /** Material and light. */
  setLook(look: Look): void {
    this.look_ = look;
    const { uniforms } = this.stock;
    uniforms.look!.value = new Vector4(look.metalness, look.roughness, look.brightness, uniforms.look!.value.w);
    uniforms.sun!.value = sunOf(look);
    this.restyle();
  }

  /** What stands around the part on the machine; `bodies` are files of triangles by their names. */
  setBench(bodies: ReadonlyMap<string, Uint8Array>): void {
    this.bodies = bodies;
    for (const child of [...this.bench.children]) {
      free(child);
      this.bench.remove(child);
    }
    this.labels.clear("zero");
    const { cut } = this;
    this.frame = new Group();
    if (cut) {
      const style = getComputedStyle(document.documentElement);
      const ink = (name: string) => new Color(style.getPropertyValue(name).trim());
      this.frame = frameOf(cut.raw, ink("--dim"), this.reach() / 30);
      this.frame.visible = false;
      this.bench.add(this.frame);
      for (const fixture of cut.fixtures ?? []) this.bench.add(heldBody(fixture, bodies.get(fixture.name)?.slice().buffer as ArrayBuffer | undefined, ink("--fixture")));
      if (cut.travel) this.bench.add(frameOf({ low: cut.travel[0], high: cut.travel[1] }, ink("--travel"), this.reach() / 8));
      for (const { name, at } of cut.zeros) {
        const axes = axesOf(this.step);
        axes.position.set(...at);
        this.bench.add(axes);
        this.labels.put(`zero ${name}`, name, at);
      }
    }
    this.draw();
  }

  /** Places that are measured, with the line between them. */
  setMeasured(places: (Point | undefined)[]): void {
    free(this.measured);
    this.measured.clear();
    ["A", "B"].forEach((name, own) => this.labels.put(`place ${name}`, name, places[own]));
    const [a, b] = places;
    if (a && b) {
      const ink = getComputedStyle(document.documentElement).getPropertyValue("--mark").trim();
      const line = linesOf([...a, ...b], new Color(ink), { over: true });
      line.renderOrder = 9;
      this.measured.add(line);
    }
    this.draw();
  }

  /** From the part to the eye. */
  get direction(): Vector3 {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }

  /** What is in the middle of the picture. */
  get middle(): Point {
    return this.controls.target.toArray() as Point;
  }

  /** How the picture sees. */
  get eye(): Eye {
    return { camera: this.camera, width: this.canvas.clientWidth, height: this.canvas.clientHeight };
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
    this.face.setInks(ink);
    const { look_: look } = this;
    if (look?.colour) {
      const own = new Color().setStyle(look.colour).convertLinearToSRGB();
      this.stock.uniforms.cut!.value = own;
      this.stock.uniforms.raw!.value = own.clone().multiplyScalar(0.82);
    }
    this.renderer.setClearColor(new Color(style.getPropertyValue("--ground").trim()), 1);
    this.surround();
    this.setBench(this.bodies);
  }

  /** Draws soon, once for all that changed until then. */
  draw(fine = this.drawing.smooth): void {
    clearTimeout(this.late);
    clearTimeout(this.calm);
    this.late = 0;
    this.fine = fine;
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      if (this.canvas.clientWidth === 0 && !this.plan.shown) return;
      this.canvas.toggleAttribute("data-rough", !this.drawing.smooth && !this.fine);
      const made = this.paths.see(Math.min(this.plan.pixel, this.canvas.clientWidth > 0 ? 1 / this.scale : Infinity));
      const eye = this.direction;
      this.stock.setEye(eye.x, eye.y, eye.z);
      const began = performance.now();
      if (this.plan.shown) this.renderPlan();
      if (this.canvas.clientWidth > 0) this.render(made);
      // Of one with edges smoothed after the others, nobody waits for the next.
      const moves = this.drawing.smooth || !this.fine;
      if (this.timed && moves) {
        this.wait();
        this.spent = performance.now() - began;
      }
      this.labels.draw(this.eye);
      this.frames += 1;
      if (!moves) this.smoothed += 1;
      this.watcher.drawn(this);
      if (!this.fine) this.calm = window.setTimeout(() => this.draw(true), CALM);
    });
  }

  /** Whether pictures cost next to nothing: by software the browser itself takes as long to show one. */
  private get isQuick(): boolean {
    return this.drawing.smooth && !this.slow;
  }

  /** Pixels for each of the page, along a side. By software one, and two once nothing moves. */
  private get ratio(): number {
    return this.drawing.smooth || this.fine ? this.renderer.getPixelRatio() : 1;
  }

  /** Draws the scene into as many pixels of the canvas as the ratio asks. A canvas of another size would take as long as a picture. */
  private fill(camera: OrthographicCamera, width: number, height: number): void {
    const share = this.ratio / this.renderer.getPixelRatio();
    this.paths.setSize(width, height, 1);
    setLinesSize(width, height);
    this.stock.uniforms.ratio!.value = this.ratio;
    this.renderer.setViewport(0, 0, width * share, height * share);
    this.renderer.setScissor(0, 0, width * share, height * share);
    this.renderer.setScissorTest(share < 1);
    this.renderer.render(this.scene, camera);
  }

  /** To read a pixel is to wait until all is drawn. */
  private wait(): void {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Draws; the first pictures of a program follow each other and are timed, so that nobody's seek is the first to find out
   * how fine part and path can be. Of new lines the first picture compiles and uploads. */
  private render(made: boolean): void {
    const began = performance.now();
    this.wireframe();
    this.stock.prepare(1 / this.scale, this.isQuick ? "all" : this.fine ? "few" : "least");
    this.stock.compile();
    this.fill(this.camera, this.canvas.clientWidth, this.canvas.clientHeight);
    if (this.trials === 0 || !this.path) return;
    this.wait();
    if (made) return this.draw();
    this.trials -= 1;
    this.lasted = performance.now() - began;
    if (this.judge(this.lasted)) this.draw();
    else this.trials = 0;
  }

  /** Draws part and path coarser where a picture took too long, and finer where four times as much would not; whether that
   * changed something. */
  private judge(spent: number): boolean {
    const quick = spent * 4 < SLOW;
    if (spent > SLOW || quick) this.slow = !quick;
    if (spent > SLOW) {
      this.settled = true;
      return [this.paths.coarser(), this.stock.coarser(this.cellPixels)].some(Boolean);
    }
    return !this.settled && quick && [this.paths, this.stock].map((one) => one.finer()).some(Boolean);
  }

  /** Pixels of the picture in a mm. */
  get scale(): number {
    return this.camera.zoom * (this.canvas.clientHeight / 200);
  }

  /** How wide a cell of the part is in the picture, in pixels. */
  private get cellPixels(): number {
    return (this.stock.uniforms.cell!.value as number) * this.scale;
  }

  /** Cells between two lines of a wireframe: so many that lines are apart. */
  private wireframe(): void {
    const { uniforms } = this.stock;
    const cell = this.cellPixels;
    uniforms.look!.value.w = this.look_?.wire ? 2 ** Math.max(0, Math.ceil(Math.log2(7 / Math.max(cell, 1e-6)))) : 0;
  }

  /** The plan: moves from above, and the frame of the raw part. */
  private renderPlan(): void {
    const hidden = [this.stock.drawn, this.stock.faces.drawn, this.face.drawn, this.surroundings].filter((one) => one.visible);
    hidden.forEach((one) => (one.visible = false));
    this.frame.visible = true;
    const [width, height] = this.plan.prepare();
    this.fill(this.plan.camera, width, height);
    const { ratio } = this;
    this.plan.copy(this.canvas, Math.floor(width * ratio), Math.floor(height * ratio));
    this.frame.visible = false;
    hidden.forEach((one) => (one.visible = true));
  }

  /** What is under a place of the picture, in its pixels. */
  under(x: number, y: number, camera = this.camera, canvas = this.canvas): Picked {
    const { clientWidth, clientHeight } = canvas;
    const half = (REACH - 1) / 2;
    camera.setViewOffset(clientWidth, clientHeight, x - half, y - half, REACH, REACH);
    this.paths.setPickSize(REACH);
    this.renderer.setRenderTarget(this.target);
    const solid = camera === this.camera && this.stock.drawn.visible;
    this.stock.pick.visible = solid;
    this.stock.faces.pick.visible = solid && this.stock.faces.some;
    this.renderer.render(this.pickScene, camera);
    const pixels = new Uint8Array(REACH * REACH * 4);
    this.renderer.readRenderTargetPixels(this.target, 0, 0, REACH, REACH, pixels);
    this.renderer.setRenderTarget(null);
    camera.clearViewOffset();
    let [best, found]: [number, Picked] = [Infinity, undefined];
    for (let at = 0; at < REACH * REACH; at += 1) {
      const [red, green, blue, alpha] = pixels.subarray(at * 4, at * 4 + 4) as unknown as [number, number, number, number];
      const id = red + green * 256 + blue * 65536;
      const part = alpha < 200;
      // A line is thin: it comes before what lies around it.
      const far = Math.hypot((at % REACH) - half, Math.floor(at / REACH) - half) + (part ? REACH : 0);
      if (id > 0 && far < best) [best, found] = [far, part ? { move: id } : { piece: id - 1 }];
    }
    return found && "piece" in found ? { piece: this.nearest(found.piece, [x, y], { camera, width: clientWidth, height: clientHeight }) } : found;
  }

  /** Of the moves that are drawn as one line, the one that is nearest to a pixel. */
  private nearest(line: number, pixel: [number, number], eye: Eye): number {
    const { path } = this;
    const [first, last] = this.paths.piecesOf(line);
    if (!path || first === last) return first;
    let [best, found] = [Infinity, first];
    for (let piece = first; piece <= last; piece += 1) {
      const far = Math.min(...endsOf(path, piece).map((end) => {
        const [x, y] = seenAt(eye, end);
        return Math.hypot(x - pixel[0], y - pixel[1]);
      }));
      if (far < best) [best, found] = [far, piece];
    }
    return found;
  }

  private wire(): void {
    let down: [number, number] = [0, 0];
    this.canvas.addEventListener("pointerdown", (event) => (down = [event.offsetX, event.offsetY]));
    this.canvas.addEventListener("pointerup", (event) => {
      const moved = Math.hypot(event.offsetX - down[0], event.offsetY - down[1]);
      if (event.button === 0 && moved < 4) this.watcher.picked(this.under(event.offsetX, event.offsetY), [event.offsetX, event.offsetY]);
    });
    // What the graphics card held is made again.
    this.canvas.addEventListener("webglcontextrestored", () => this.setPath(this.path, this.cut, true));
  }

  private centre(): Vector3 {
    return corner(this.box.low).add(corner(this.box.high)).multiplyScalar(0.5);
  }

  /** Half the box's diagonal, and more than nothing. */
  private reach(): number {
    return Math.max(5, corner(this.box.high).distanceTo(corner(this.box.low)) / 2);
  }

  private surround(): void {
    for (const child of [...this.surroundings.children]) {
      free(child);
      this.surroundings.remove(child);
    }
    const style = getComputedStyle(document.documentElement);
    const { grid, step } = gridOf(this.box, new Color(style.getPropertyValue("--grid").trim()));
    this.step = step;
    this.surroundings.add(grid, axesOf(step * 1.5));
  }

  /** The layout is another: picture, plan, or both. */
  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const plan = this.plan.shown ? this.plan.canvas : undefined;
    const wide = Math.max(width, plan?.clientWidth ?? 0);
    const high = Math.max(height, plan?.clientHeight ?? 0);
    if (wide === 0 || high === 0) return;
    this.renderer.setSize(wide, high, false);
    if (width > 0) {
      const tall = 100;
      [this.camera.top, this.camera.bottom] = [tall, -tall];
      [this.camera.left, this.camera.right] = [(-tall * width) / height, (tall * width) / height];
      this.camera.updateProjectionMatrix();
      if (this.unfitted) this.fit();
    }
    this.draw();
  }
}

/** Whether two programs, and parts, take about as long to draw. */
function isAlike(one: Path | undefined, other: Path | undefined, [own, its]: (Cut | undefined)[]): boolean {
  if (!one || !other || String(own?.raw.cells) !== String(its?.raw.cells)) return false;
  return one.pieces <= 2 * other.pieces && other.pieces <= 2 * one.pieces;
}

/** A box around two. */
function around(a: Box, b: Box): Box {
  const axes = [0, 1, 2] as const;
  const [x0, y0, z0] = axes.map((axis) => Math.min(a.low[axis], b.low[axis])) as [number, number, number];
  const [x1, y1, z1] = axes.map((axis) => Math.max(a.high[axis], b.high[axis])) as [number, number, number];
  return { low: [x0, y0, z0], high: [x1, y1, z1] };
}

/** A canvas's context for drawing. */
export interface Drawing {
  context: WebGL2RenderingContext;
  /** Whether edges are smooth in every picture: by software that takes as long as the rest. */
  smooth: boolean;
}

/** Names that browsers have for graphics by software. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** How a canvas is drawn on; nothing where WebGL 2 is missing. */
export function drawingOn(canvas: HTMLCanvasElement): Drawing | undefined {
  const smooth = hasGraphics();
  const context = canvas.getContext("webgl2", { alpha: false, antialias: smooth, powerPreference: "high-performance" });
  return context ? { context, smooth } : undefined;
}

/** Whether the device draws by something else than software, as far as the browser tells. */
function hasGraphics(): boolean {
  const trial = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (!trial) return false;
  const names = trial.getExtension("WEBGL_debug_renderer_info");
  const name = String(trial.getParameter(names?.UNMASKED_RENDERER_WEBGL ?? trial.RENDERER));
  trial.getExtension("WEBGL_lose_context")?.loseContext();
  return !SOFTWARE.test(name);
}
