"use strict";
// The first part of a report's script: decodes the data of the page and searches it. Plain functions
// without a page, so that they can be tested; drawing is in page.js.
const ncc = (() => {
  // Reading ---------------------------------------------------------------------------------------

  /** Numbers from the differences between them, divided by a unit. */
  function sums(deltas, unit) {
    const out = new Float64Array(deltas.length);
    let sum = 0;
    for (let i = 0; i < deltas.length; i++) out[i] = (sum += deltas[i]) / unit;
    return out;
  }

  function readCurve(curve) {
    return { t: sums(curve.t, 1e4), v: Float64Array.from(curve.v) };
  }

  function readWay(way) {
    const read = {
      start: way.start,
      off: way.off,
      kinds: way.kinds,
      x: sums(way.x, way.perMm),
      y: sums(way.y, way.perMm),
      z: sums(way.z, way.perMm),
      ends: sums(way.ends, 1e4),
      first: sums(way.first, 1),
      last: sums(way.last, 1),
    };
    return { ...read, again: again(read) };
  }

  /** Which rapids go where one has gone before: two dashed lines over each other look like a whole one. */
  function again(way) {
    const seen = new Set();
    return Uint8Array.from(way.kinds, (kind, i) => {
      if (kind !== "r") return 0;
      const ends = [pointOf(way, i - 1).join(), pointOf(way, i).join()].sort().join();
      if (seen.has(ends)) return 1;
      seen.add(ends);
      return 0;
    });
  }

  function readProgram(program) {
    return {
      ...program,
      speed: readCurve(program.speed),
      feed: readCurve(program.feed),
      axes: program.axes.map((axis) => ({ name: axis.name, line: readCurve(axis.line) })),
      way: readWay(program.way),
      source: {
        total: program.source.total,
        numbers: sums(program.source.numbers, 1),
        lines: program.source.numbers.length ? program.source.text.split("\n") : [],
      },
    };
  }

  // Searching -------------------------------------------------------------------------------------

  /** Index of the first value that is not less; the length if there is none. */
  function lowerBound(values, value) {
    let low = 0;
    let high = values.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (values[middle] < value) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Value of a curve at a time; where it jumps, what it jumps to. */
  function valueAt(curve, time) {
    const n = curve.t.length;
    if (!n) return null;
    let at = lowerBound(curve.t, time);
    while (at + 1 < n && curve.t[at + 1] <= time) at++;
    if (at >= n) return curve.v[n - 1];
    if (curve.t[at] === time || at === 0) return curve.v[at];
    const part = (time - curve.t[at - 1]) / (curve.t[at] - curve.t[at - 1]);
    return curve.v[at - 1] + part * (curve.v[at] - curve.v[at - 1]);
  }

  /** The leg that is under way at a time; -1 if there is none. */
  function legAt(way, time) {
    const at = lowerBound(way.ends, time);
    return at < way.ends.length ? at : way.ends.length - 1;
  }

  function pointOf(way, leg) {
    return leg < 0 ? way.start : [way.x[leg], way.y[leg], way.z[leg]];
  }

  /** Where the tool is at a time. */
  function placeAt(way, time, begin) {
    const leg = legAt(way, time);
    if (leg < 0) return way.start;
    const [a, b] = [pointOf(way, leg - 1), pointOf(way, leg)];
    const from = leg > 0 ? way.ends[leg - 1] : begin;
    const long = way.ends[leg] - from;
    const part = long > 0 ? Math.min(1, Math.max(0, (time - from) / long)) : 1;
    return a.map((v, i) => v + part * (b[i] - v));
  }

  /** Legs of a stretch of source lines. */
  function legsOf(way, lines) {
    const legs = [];
    for (let i = 0; i < way.kinds.length; i++) {
      const [a, b] = [Math.min(way.first[i], way.last[i]), Math.max(way.first[i], way.last[i])];
      if (a <= lines[1] && b >= lines[0]) legs.push(i);
    }
    return legs;
  }

  /** Stretches of time of legs, those that touch joined. */
  function timesOf(way, legs, begin) {
    const times = [];
    for (const leg of legs) {
      const [from, to] = [leg > 0 ? way.ends[leg - 1] : begin, way.ends[leg]];
      const last = times[times.length - 1];
      if (last && from - last[1] < 1e-9) last[1] = to;
      else times.push([from, to]);
    }
    return times;
  }

  /** A point on paper, right and up. */
  function project(view, p) {
    if (view === "plan") return [p[0], p[1]];
    return [Math.SQRT1_2 * (p[0] + p[1]), Math.sqrt(1 / 6) * (p[1] - p[0] + 2 * p[2])];
  }

  /** Distance of a point to a line, and at which part of it. */
  function distance(p, a, b) {
    const [x, y] = [b[0] - a[0], b[1] - a[1]];
    const long = x * x + y * y;
    const part = long > 0 ? Math.min(1, Math.max(0, ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / long)) : 0;
    return [Math.hypot(p[0] - a[0] - part * x, p[1] - a[1] - part * y), part];
  }

  // Marks and words -------------------------------------------------------------------------------

  function marks(low, high, most) {
    const rough = Math.max((high - low) / Math.max(1, most), 1e-9);
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((n) => n * power >= rough * (1 - 1e-9));
    return [multiples(low, high, step), step];
  }

  function clockMarks(low, high, most) {
    const steps = [10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 10800, 21600, 43200, 86400];
    const rough = (high - low) / most;
    const step = rough > 5 && steps.find((s) => s >= rough);
    return step ? [multiples(low, high, step), step] : marks(low, high, most);
  }

  function multiples(low, high, step) {
    const out = [];
    const last = Math.floor(high / step + 1e-9);
    for (let n = Math.ceil(low / step - 1e-9); n <= last && out.length < 1000; n++) out.push(n * step);
    return out;
  }

  function powerMarks(low, high, most) {
    for (const digits of [[1, 2, 5], [1, 3], [1]]) {
      const all = [];
      for (let p = Math.floor(Math.log10(low)); p <= Math.ceil(Math.log10(high)); p++) {
        for (const d of digits) if (d * 10 ** p >= low && d * 10 ** p <= high) all.push(d * 10 ** p);
      }
      if (all.length <= most) return all;
    }
    return [];
  }

  function number(value, step) {
    const digits = Math.min(9, Math.max(0, -Math.floor(Math.log10(step))));
    const text = Math.abs(value).toFixed(digits);
    const [whole, fraction] = text.split(".");
    const grouped = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") : whole;
    const sign = value < 0 && /[1-9]/.test(text) ? "\u2212" : "";
    return sign + grouped + (fraction ? "." + fraction : "");
  }

  /** A time: seconds, or h:mm:ss in a long program. */
  function clock(seconds, step, long) {
    if (long < 180) return number(seconds, step);
    const digits = step < 1 ? 1 : 0;
    const all = Math.round(Math.max(0, seconds) * 10 ** digits);
    const whole = Math.floor(all / 10 ** digits);
    const two = (n) => String(n).padStart(2, "0");
    const text = `${Math.floor(whole / 3600)}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
    return digits ? `${text}.${all % 10}` : text;
  }

  /** Stretches of lines that are shown and gaps between them, as rows. */
  function rows(source) {
    const out = [];
    let before = 0;
    for (let i = 0; i < source.numbers.length; i++) {
      if (source.numbers[i] > before + 1) out.push({ gap: source.numbers[i] - before - 1 });
      out.push({ line: source.numbers[i], text: source.lines[i] });
      before = source.numbers[i];
    }
    if (source.total > before) out.push({ gap: source.total - before });
    return out;
  }

  return { sums, readCurve, readWay, readProgram, lowerBound, valueAt, legAt, pointOf, placeAt, legsOf, timesOf,
    project, distance, marks, multiples, clockMarks, powerMarks, number, clock, rows };
})();
if (typeof module !== "undefined") module.exports = ncc;
