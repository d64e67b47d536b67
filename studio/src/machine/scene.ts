// What stands around the path: a grid on the lowest plane, the axes of the zero, and the tool.

import {
  BoxGeometry,
  Color,
  CylinderGeometry,
  DirectionalLight,
  DoubleSide,
  Group,
  HemisphereLight,
  LatheGeometry,
  Mesh,
  MeshLambertMaterial,
  Vector2,
  type Material,
  type Object3D,
} from "three";
import { STLLoader } from "three/addons/loaders/STLLoader.js";
import type { Fixture, Tool } from "../engine/part";
import type { Box } from "../engine/path";
import { isOfLines, linesOf } from "./lines";

/** A step of 1, 2 or 5 and zeros, so that about so many fit in. */
export function stepFor(length: number, count: number): number {
  const raw = Math.max(length, 1e-3) / count;
  const ten = 10 ** Math.floor(Math.log10(raw));
  return ten * ([1, 2, 5, 10].find((factor) => factor * ten >= raw) ?? 10);
}

/** A grid around a box; `step` mm between its lines. */
export function gridOf(box: Box, ink: Color): { grid: Mesh; step: number } {
  const [x0, y0, z] = box.low;
  const [x1, y1] = box.high;
  const step = stepFor(Math.max(x1 - x0, y1 - y0), 12);
  const low = (value: number) => Math.floor(value / step - 1) * step;
  const high = (value: number) => Math.ceil(value / step + 1) * step;
  const [left, right, front, back] = [low(x0), high(x1), low(y0), high(y1)];
  const points: number[] = [];
  for (let x = left; x <= right + step / 2; x += step) points.push(x, front, z, x, back, z);
  for (let y = front; y <= back + step / 2; y += step) points.push(left, y, z, right, y, z);
  return { grid: linesOf(points, ink), step };
}

/** The axes of the zero, so long. */
export function axesOf(length: number): Group {
  const group = new Group();
  const ends = [
    ["#d8463c", length, 0, 0],
    ["#2f9e57", 0, length, 0],
    ["#2f76dc", 0, 0, length],
  ] as const;
  for (const [ink, x, y, z] of ends) group.add(linesOf([0, 0, 0, x, y, z], new Color(ink)));
  return group;
}

/** A tool with its tip in the origin: what cuts, and shank and holder as far as they are known. */
export function toolBody(tool: Tool): Group {
  const radius = Math.max(...tool.outline.map(([own]) => own), 1e-3);
  const foot = Math.max(...tool.outline.map(([, height]) => height));
  const long = Math.max(foot, tool.flute ?? Math.max(radius * 6, 20));
  const group = new Group();
  const points = tool.outline.map(([own, height]) => new Vector2(own, height));
  group.add(turned([...points, new Vector2(radius, long), new Vector2(0, long)], "#d8a33c", 0.5));
  const { shank, holder } = tool;
  const from = holder ? Math.max(holder[1], long) : long + 20;
  if (shank !== undefined && from > long) group.add(cylinder(shank / 2, long, from, "#8b949c"));
  if (holder) group.add(cylinder(holder[0] / 2, holder[1], holder[1] + Math.max(holder[0], 20), "#4f5962"));
  return group;
}

function cylinder(radius: number, from: number, to: number, color: string): Mesh {
  return turned([[0, from], [radius, from], [radius, to], [0, to]].map(([r, z]) => new Vector2(r, z)), color, 0.65);
}

/** A body of revolution of pairs of radius and height. */
function turned(outline: Vector2[], color: string, opacity: number): Mesh {
  const material = new MeshLambertMaterial({ color, transparent: true, opacity, depthWrite: false });
  const body = new Mesh(new LatheGeometry(outline, 40), material);
  // A lathe turns about Y; the tool stands along Z.
  body.rotation.x = Math.PI / 2;
  return body;
}

/** The edges of a box, dashed; each begins with a dash, so that edges over each other are one. */
export function frameOf(box: Box, color: Color, dash: number): Mesh {
  const [low, high] = [box.low, box.high];
  const points: number[] = [];
  for (let axis = 0; axis < 3; axis += 1) {
    for (let corner = 0; corner < 4; corner += 1) {
      const ends = [low, high].map((end) => {
        const at = [0, 0, 0];
        at[axis] = end[axis] as number;
        at[(axis + 1) % 3] = (corner & 1 ? high : low)[(axis + 1) % 3] as number;
        at[(axis + 2) % 3] = (corner & 2 ? high : low)[(axis + 2) % 3] as number;
        return at;
      });
      points.push(...ends.flat());
    }
  }
  return linesOf(points, color, { dash });
}

/** What holds the part: a box, a cylinder, or a body of triangles. */
export function heldBody(fixture: Fixture, stl: ArrayBuffer | undefined, color: Color): Group {
  const { low, high, form } = fixture;
  const size = [0, 1, 2].map((axis) => (high[axis] as number) - (low[axis] as number)) as [number, number, number];
  const middle = [0, 1, 2].map((axis) => ((high[axis] as number) + (low[axis] as number)) / 2) as [number, number, number];
  const group = new Group();
  const material = new MeshLambertMaterial({ color, transparent: true, opacity: 0.75, side: DoubleSide });
  if (form === "body" && stl) {
    const geometry = new STLLoader().parse(stl);
    // Many files state no normals.
    geometry.computeVertexNormals();
    group.add(new Mesh(geometry, material));
    return group;
  }
  const round = form === "cylinder";
  const body = new Mesh(round ? new CylinderGeometry(size[0] / 2, size[0] / 2, size[2], 48) : new BoxGeometry(...size), material);
  if (round) body.rotation.x = Math.PI / 2;
  body.position.set(...middle);
  group.add(body);
  return group;
}

export function lights(): Group {
  const group = new Group();
  const sun = new DirectionalLight("#ffffff", 1.6);
  sun.position.set(-1, -2, 3);
  group.add(new HemisphereLight("#ffffff", "#8a8f98", 1.6), sun);
  return group;
}

/** Frees what a drawing holds on the graphics card. */
export function free(drawing: Object3D): void {
  drawing.traverse((child) => {
    if (!(child instanceof Mesh)) return;
    child.geometry.dispose();
    if (!isOfLines(child.material)) (child.material as Material).dispose();
  });
}
