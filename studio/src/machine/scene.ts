// What stands around the path: a grid on the lowest plane, the axes of the zero, and the tool.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  Group,
  HemisphereLight,
  LatheGeometry,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  Vector2,
  type Material,
  type Object3D,
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

/** A tool with its tip in the origin, of its shape and diameter. What is not known of it (flutes, shank, holder) is not drawn. */
export function toolBody(shape: string, diameter: number): Group {
  const radius = Math.max(diameter / 2, 1e-3);
  const length = Math.max(diameter * 3, 20);
  // From the tip up: pairs of radius and height.
  const outline = [new Vector2(0, 0)];
  if (shape === "ball" || shape === "lollipop") {
    for (let at = 1; at <= 12; at += 1) {
      const angle = (at / 12) * (Math.PI / 2);
      outline.push(new Vector2(radius * Math.sin(angle), radius * (1 - Math.cos(angle))));
    }
  } else if (shape === "drill") {
    // A point of 118 degrees is drawn: the common one.
    outline.push(new Vector2(radius, radius / Math.tan((59 * Math.PI) / 180)));
  } else if (shape === "chamfer") {
    outline.push(new Vector2(radius, radius));
  } else {
    outline.push(new Vector2(radius, 0));
  }
  outline.push(new Vector2(radius, length), new Vector2(0, length));
  const material = new MeshLambertMaterial({ color: "#d8a33c", transparent: true, opacity: 0.85, side: DoubleSide });
  const body = new Mesh(new LatheGeometry(outline, 40), material);
  // A lathe turns about Y; the tool stands along Z.
  body.rotation.x = Math.PI / 2;
  const group = new Group();
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
    if (!(child instanceof LineSegments || child instanceof Mesh)) return;
    child.geometry.dispose();
    (child.material as Material).dispose();
  });
}
