// The triangles of a part's upper surface: few where it is even, many where it is not. A square is two right triangles, and
// each is halved at the middle of its longest side until the picture does not show the difference. Neighbours share that
// middle, so that there are no gaps between them. Points are counted row by row, with two rings around them: the walls are
// between the rings.

/** A grid of points on the cells of a part, as the shaders have it. */
export interface Grid {
  /** Rows of cells of one Y, mm; far below zero where there is no material. */
  heights: Float32Array;
  /** Along X and along Y. */
  cells: readonly [number, number];
  /** Side of a cell, and height of the part's floor, mm. */
  cell: number;
  bottom: number;
  /** Cells between two points. */
  stride: number;
  /** Along X and along Y. */
  points: readonly [number, number];
}

/** How far a triangle may be from the points that it covers. */
export interface Tolerance {
  /** mm */
  height: number;
  /** mm of height a mm of way: the light on a face goes by it. */
  slope: number;
}

/** Points along the side of the largest squares. */
const LARGEST = 64;
/** Heights below are no material. */
const GONE = -1e20;
/** The surface meets the walls so closely, mm: a gap is seen sooner than a slope. */
const AT_WALLS = 1e-5;

/** Memory from one part to the next: the first touch of new memory takes as long as the work. */
let kept = new Float32Array();

/** Three points for each triangle: few, within a tolerance. */
export function few(grid: Grid, tolerance: Tolerance): Uint32Array {
  const surface = new Surface(grid, tolerance).triangles();
  const around = walls(grid.points);
  const index = new Uint32Array(surface.length + around.length);
  index.set(surface);
  index.set(around, surface.length);
  return index;
}

/** Three points for each triangle: two triangles for each square. */
export function all(points: readonly [number, number]): Uint32Array {
  const [across, along] = points;
  const around = walls(points);
  const index = new Uint32Array((across - 1) * (along - 1) * 6 + around.length);
  let at = 0;
  for (let y = 0; y + 1 < along; y += 1)
    for (let x = 0; x + 1 < across; x += 1) at = square(index, at, number(points, x, y), 1, across + 4);
  index.set(around, at);
  return index;
}

function number([across]: readonly [number, number], x: number, y: number): number {
  return (y + 2) * (across + 4) + x + 2;
}

/** Two triangles from a corner, the next one, and those a way further. */
function square(index: Uint32Array, at: number, corner: number, next: number, further: number): number {
  index[at] = corner;
  index[at + 1] = index[at + 3] = corner + next;
  index[at + 2] = index[at + 5] = corner + further;
  index[at + 4] = corner + next + further;
  return at + 6;
}

/** From the inner ring, at the height of the border, to the outer one, on the floor. */
function walls(points: readonly [number, number]): Uint32Array {
  const [across, along] = points;
  const row = across + 4;
  const index = new Uint32Array((across + along - 2) * 12);
  let at = 0;
  for (let x = 0; x + 1 < across; x += 1) {
    at = square(index, at, number(points, x, -1), 1, -row);
    at = square(index, at, number(points, x, along), 1, row);
  }
  for (let y = 0; y + 1 < along; y += 1) {
    at = square(index, at, number(points, -1, y), row, -1);
    at = square(index, at, number(points, across, y), row, 1);
  }
  return index;
}

class Surface {
  /** Points up to the end of the last square; those beyond the border are at the border. */
  private readonly wide: number;
  private readonly high: number;
  /** Of each point the height and both slopes. */
  private readonly height: Float32Array;
  private readonly slopeX: Float32Array;
  private readonly slopeY: Float32Array;
  /** How far a triangle is from the points that it covers if it is not halved at this point, in tolerances. */
  private readonly error: Float32Array;
  private readonly across: number;
  /** The last points along X and along Y. */
  private readonly right: number;
  private readonly top: number;
  private readonly perHeight: number;
  private readonly perSlope: number;
  private index = new Uint32Array(3 * 4096);
  private length = 0;

  constructor(
    private readonly grid: Grid,
    tolerance: Tolerance,
  ) {
    const [across, along] = grid.points;
    [this.across, this.right, this.top] = [across, across - 1, along - 1];
    [this.perHeight, this.perSlope] = [1 / tolerance.height, 1 / tolerance.slope];
    const whole = (points: number) => Math.ceil((points - 1) / LARGEST) * LARGEST + 1;
    [this.wide, this.high] = [whole(across), whole(along)];
    const [points, all] = [across * along, this.wide * this.high];
    if (kept.length < 3 * points + all) kept = new Float32Array(3 * points + all);
    const part = (at: number, length: number) => kept.subarray(at, at + length);
    [this.height, this.slopeX, this.slopeY] = [part(0, points), part(points, points), part(2 * points, points)];
    this.error = part(3 * points, all);
    this.sample();
  }

  triangles(): Uint32Array {
    for (let step = 1; step < LARGEST; step *= 2) {
      this.sides(step);
      this.middles(step);
    }
    const [across, along] = this.grid.points;
    for (let y = 0; y < along - 1; y += LARGEST) {
      for (let x = 0; x < across - 1; x += LARGEST) {
        this.halve(x, y, x + LARGEST, y + LARGEST, x + LARGEST, y);
        this.halve(x + LARGEST, y + LARGEST, x, y, x, y + LARGEST);
      }
    }
    return this.index.slice(0, this.length);
  }

  /** Height and slopes at the points, as the shader of the grid has them. */
  private sample(): void {
    const { heights, cells, cell, bottom, stride, points } = this.grid;
    const { height, slopeX, slopeY } = this;
    const [last, end] = [cells[0] - 1, cells[1] - 1];
    const reach = 2 * stride;
    const per = 1 / (2 * reach * cell);
    let to = 0;
    for (let y = 0; y < points[1]; y += 1) {
      const own = Math.min(y * stride, end);
      const row = own * cells[0];
      const before = Math.max(own - reach, 0) * cells[0];
      const behind = Math.min(own + reach, end) * cells[0];
      for (let x = 0; x < points[0]; x += 1) {
        const column = Math.min(x * stride, last);
        const left = Math.max(heights[row + Math.max(column - reach, 0)] as number, bottom);
        const right = Math.max(heights[row + Math.min(column + reach, last)] as number, bottom);
        const front = Math.max(heights[before + column] as number, bottom);
        const back = Math.max(heights[behind + column] as number, bottom);
        height[to] = heights[row + column] as number;
        slopeX[to] = (left - right) * per;
        slopeY[to] = (front - back) * per;
        to += 1;
      }
    }
  }

  /** Points in the middle of the sides of squares. */
  private sides(step: number): void {
    const { wide, high, error } = this;
    const half = step >> 1;
    for (let y = 0; y < high; y += step) {
      const isOdd = (y / step) & 1;
      for (let x = isOdd ? 0 : step; x < wide; x += 2 * step) {
        const own = isOdd ? this.between(x, y - step, x, y + step, x, y) : this.between(x - step, y, x + step, y, x, y);
        let most = 0;
        if (half) {
          const [above, below, left, right] = [y >= half, y + half < high, x >= half, x + half < wide];
          if (above && left) most = Math.max(most, error[(y - half) * wide + x - half] as number);
          if (above && right) most = Math.max(most, error[(y - half) * wide + x + half] as number);
          if (below && left) most = Math.max(most, error[(y + half) * wide + x - half] as number);
          if (below && right) most = Math.max(most, error[(y + half) * wide + x + half] as number);
        }
        error[y * wide + x] = own + most;
      }
    }
  }

  /** Points in the middle of squares, whose longest side goes from the middle of the next larger square outwards. */
  private middles(step: number): void {
    const { wide, high, error } = this;
    for (let y = step; y < high; y += 2 * step) {
      for (let x = step; x < wide; x += 2 * step) {
        const falls = 2 * step < LARGEST && (((x - step) / (2 * step)) & 1) !== (((y - step) / (2 * step)) & 1);
        const own = falls
          ? this.between(x - step, y + step, x + step, y - step, x, y)
          : this.between(x - step, y - step, x + step, y + step, x, y);
        const at = y * wide + x;
        const most = Math.max(error[at - step] as number, error[at + step] as number, error[at - step * wide] as number, error[at + step * wide] as number);
        error[at] = own + most;
      }
    }
  }

  /** How far a point is from the middle of the longest side whose ends are given, in tolerances. Asked of each point: nothing
   * is allocated here. */
  private between(ax: number, ay: number, bx: number, by: number, x: number, y: number): number {
    const { across, right, top, height, slopeX, slopeY } = this;
    const half = Math.abs(ax - bx || ay - by) / 2;
    if (x + half > right || y + half > top) {
      const outX = beyond(ax, bx, half, right);
      const outY = beyond(ay, by, half, top);
      if (outX === Beyond.All || outY === Beyond.All) return 0;
      if (outX === Beyond.Some || outY === Beyond.Some) return Infinity;
    }
    const a = ay * across + ax;
    const b = by * across + bx;
    const own = y * across + x;
    const low = height[a] as number;
    const high = height[b] as number;
    const here = height[own] as number;
    if (low < GONE || high < GONE || here < GONE) return low < GONE && high < GONE && here < GONE ? 0 : Infinity;
    const apart = Math.abs(here - (low + high) / 2);
    const isWall = ax === bx ? ax === 0 || ax === right : ay === by && (ay === 0 || ay === top);
    if (isWall && apart > AT_WALLS) return Infinity;
    const leanX = Math.abs((slopeX[own] as number) - ((slopeX[a] as number) + (slopeX[b] as number)) / 2);
    const leanY = Math.abs((slopeY[own] as number) - ((slopeY[a] as number) + (slopeY[b] as number)) / 2);
    return Math.max(apart * this.perHeight, (leanX > leanY ? leanX : leanY) * this.perSlope);
  }

  /** A triangle by the ends of its longest side and the corner across: drawn, or halved. */
  private halve(ax: number, ay: number, bx: number, by: number, cx: number, cy: number): void {
    const [across, along] = this.grid.points;
    if (Math.min(ax, bx, cx) >= across - 1 || Math.min(ay, by, cy) >= along - 1) return;
    const [x, y] = [(ax + bx) >> 1, (ay + by) >> 1];
    if (Math.abs(ax - cx) + Math.abs(ay - cy) > 1 && (this.error[y * this.wide + x] as number) > 1) {
      this.halve(cx, cy, ax, ay, x, y);
      this.halve(bx, by, cx, cy, x, y);
      return;
    }
    if (this.length + 3 > this.index.length) {
      const more = new Uint32Array(2 * this.index.length);
      more.set(this.index);
      this.index = more;
    }
    const { points } = this.grid;
    this.index[this.length++] = number(points, ax, ay);
    this.index[this.length++] = number(points, bx, by);
    this.index[this.length++] = number(points, cx, cy);
  }
}

/** How much of two triangles at a longest side lies beyond the last point along an axis. */
const enum Beyond {
  None,
  Some,
  All,
}

function beyond(a: number, b: number, half: number, last: number): Beyond {
  // Across an axis the triangles lie to both sides.
  const [low, high] = a === b ? [a - half, a + half] : [Math.min(a, b), Math.max(a, b)];
  if (low >= last) return Beyond.All;
  // The one within has this border as its side, and the other no width.
  return high <= last || (a === b && a === last) ? Beyond.None : Beyond.Some;
}
