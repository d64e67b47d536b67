// What stands around the path: a grid on the lowest plane, the axes of the zero, and the tool.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  ConeGeometry,
  CylinderGeometry,
  DirectionalLight,
  Group,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
} from "three";
import type { Box } from "../engine/path";

/** A step of 1, 2 or 5 and zeros, so that about so many fit in. */
export function stepFor(length: number, count: number): number {
  const raw = Math.max(length, 1e-3) / count;
  const ten = 10 ** Math.floor(Math.log10(raw));
  return ten * ([1, 2, 5, 10].find((factor) => factor * ten >= raw) ?? 10);
}

/** A grid around a box; `step` mm between its lines. */
export function gridOf(box: Box, ink: Color): { grid: LineSegments; step: number } {
  const [x0, y0, z] = box.low;
  const [x1, y1] = box.high;
  const step = stepFor(Math.max(x1 - x0, y1 - y0), 12);
  const low = (value: number) => Math.floor(value / step - 1) * step;
  const high = (value: number) => Math.ceil(value / step + 1) * step;
  const [left, right, front, back] = [low(x0), high(x1), low(y0), high(y1)];
  const points: number[] = [];
  for (let x = left; x <= right + step / 2; x += step) points.push(x, front, z, x, back, z);
  for (let y = front; y <= back + step / 2; y += step) points.push(left, y, z, right, y, z);
  return { grid: lines(points, ink), step };
}

function lines(points: number[], color: Color): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color }));
}

/** The axes of the zero, so long. */
export function axesOf(length: number): Group {
  const group = new Group();
  const ends = [
    ["#d8463c", length, 0, 0],
    ["#2f9e57", 0, length, 0],
    ["#2f76dc", 0, 0, length],
  ] as const;
  for (const [ink, x, y, z] of ends) group.add(lines([0, 0, 0, x, y, z], new Color(ink)));
  return group;
}

/** A marker where the tool is, its tip in the origin; it is one unit long and says nothing of the tool's size. */
export function toolMarker(): Group {
  const group = new Group();
  const material = new MeshLambertMaterial({ color: "#e0a030", transparent: true, opacity: 0.92 });
  const tip = new Mesh(new ConeGeometry(0.11, 0.3, 24), material);
  tip.rotation.x = -Math.PI / 2;
  tip.position.z = 0.15;
  const shank = new Mesh(new CylinderGeometry(0.11, 0.11, 0.7, 24), material);
  shank.rotation.x = Math.PI / 2;
  shank.position.z = 0.65;
  group.add(tip, shank);
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
export function free(group: Group | LineSegments): void {
  group.traverse((child) => {
    if (!(child instanceof LineSegments)) return;
    child.geometry.dispose();
    (child.material as LineBasicMaterial).dispose();
  });
}
