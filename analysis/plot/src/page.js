"use strict";
// The second part of a report's script: draws on the canvases of the page, and links moments, legs and
// blocks. What needs no page is in reading.js.
(() => {
  const { readCurve, readProgram, lowerBound, valueAt, legAt, pointOf, placeAt, legsOf, timesOf, project,
    distance, marks, multiples, clockMarks, powerMarks, number, clock, rows } = ncc;

  const ROW = 18;
  const NAMES = { r: "rapid", f: "feed", a: "arc", h: "hole", ".": "stands", x: "hidden" };
  const [LEFT, RIGHT, GAP, BOTTOM] = [74, 60, 14, 40];

  function start() {
    const data = JSON.parse(document.getElementById("data").textContent);
    const programs = data.programs.map(readProgram);
    const pair = programs.length > 1;
    const begin = Math.min(...programs.map((p) => p.begin));
    const end = Math.max(begin + 1e-3, ...programs.map((p) => p.end));
    const state = { shown: 0, lines: null, moment: null, span: [begin, end], legs: [], times: [] };
    const tip = document.getElementById("tip");
    const styles = {
      line(context, ink) {
        context.strokeStyle = ink.color;
        context.lineWidth = ink.width;
        context.setLineDash(ink.dash);
      },
    };

    function fit(canvas) {
      const ratio = window.devicePixelRatio || 1;
      const [wide, tall] = [canvas.clientWidth, canvas.clientHeight];
      if (canvas.width !== Math.round(wide * ratio) || canvas.height !== Math.round(tall * ratio)) {
        canvas.width = Math.round(wide * ratio);
        canvas.height = Math.round(tall * ratio);
      }
      const context = canvas.getContext("2d");
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.clearRect(0, 0, wide, tall);
      context.font = "12px system-ui, sans-serif";
      return [context, wide, tall];
    }

    const waiting = new Set();
    /** Draws again what changes: the charts, one view, or all. */
    function redraw(...which) {
      if (!waiting.size) {
        requestAnimationFrame(() => {
          const now = [...waiting];
          waiting.clear();
          for (const one of now) one === charts ? drawCharts() : drawView(one);
        });
      }
      for (const one of which.length ? which : [charts, ...views]) waiting.add(one);
    }

    // Choosing ------------------------------------------------------------------------------------

    function choose(program, lines, moment, scroll) {
      const other = program !== state.shown;
      state.shown = program;
      state.lines = lines;
      state.moment = moment;
      const way = programs[program].way;
      state.legs = lines ? legsOf(way, lines) : [];
      state.times = timesOf(way, state.legs, programs[program].begin);
      if (other) showSource();
      if (scroll && lines) scrollTo(lines[0]);
      paintRows();
      redraw();
    }

    function chooseLeg(program, leg, moment, scroll) {
      const way = programs[program].way;
      if (leg < 0 || !way.first[leg]) return choose(program, null, moment, false);
      const lines = [way.first[leg], way.last[leg]].sort((a, b) => a - b);
      choose(program, lines, moment, scroll);
    }

    function lineText(program, leg) {
      const { way, source } = programs[program];
      if (leg < 0) return "";
      const [a, b] = [way.first[leg], way.last[leg]];
      const at = lowerBound(source.numbers, b);
      const text = source.numbers[at] === b ? source.lines[at] : "";
      if (!b) return "";
      return a === b ? `line ${b}: ${text}` : `lines ${a} to ${b}: \u2026 ${text}`;
    }

    function hide() {
      tip.hidden = true;
    }

    function showTip(event, text) {
      tip.textContent = text;
      tip.hidden = false;
      const [x, y] = [event.clientX + 14, event.clientY + 14];
      tip.style.left = `${Math.min(x, window.innerWidth - tip.offsetWidth - 4)}px`;
      tip.style.top = `${Math.min(y, window.innerHeight - tip.offsetHeight - 4)}px`;
    }

    // Source --------------------------------------------------------------------------------------

    const list = document.getElementById("source");
    let listed = [];
    function showSource() {
      listed = rows(programs[state.shown].source);
      list.textContent = "";
      const inner = document.createElement("div");
      inner.style.cssText = `position:relative;height:${listed.length * ROW}px`;
      list.append(inner);
      for (const [i, button] of [...document.querySelectorAll("#tabs button")].entries()) {
        button.setAttribute("aria-pressed", String(i === state.shown));
      }
      paintRows();
    }

    function paintRows() {
      const inner = list.firstChild;
      if (!inner) return;
      const first = Math.max(0, Math.floor(list.scrollTop / ROW) - 10);
      const last = Math.min(listed.length, Math.ceil((list.scrollTop + list.clientHeight) / ROW) + 10);
      inner.textContent = "";
      for (let i = first; i < last; i++) {
        const row = listed[i];
        const element = document.createElement("div");
        element.className = row.gap ? "row gap" : "row";
        element.style.top = `${i * ROW}px`;
        const name = document.createElement("b");
        name.textContent = row.gap ? "\u22ee" : row.line;
        element.append(name, row.gap ? `${row.gap} ${row.gap > 1 ? "lines" : "line"}` : row.text);
        const on = !row.gap && state.lines && row.line >= state.lines[0] && row.line <= state.lines[1];
        if (on) element.classList.add("on");
        if (!row.gap) element.onclick = () => chooseLine(row.line);
        inner.append(element);
      }
    }

    function chooseLine(line) {
      const { way, begin } = programs[state.shown];
      const legs = legsOf(way, [line, line]);
      const moment = legs.length ? timesOf(way, [legs[0]], begin)[0][0] : null;
      choose(state.shown, [line, line], moment, false);
    }

    function scrollTo(line) {
      const at = listed.findIndex((row) => row.line >= line);
      if (at < 0) return;
      const top = at * ROW;
      if (top < list.scrollTop || top > list.scrollTop + list.clientHeight - 2 * ROW) {
        list.scrollTop = top - list.clientHeight / 2;
      }
    }

    list.onscroll = paintRows;
    list.onkeydown = (event) => {
      const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (!step) return;
      event.preventDefault();
      const lines = listed.filter((row) => !row.gap).map((row) => row.line);
      const at = state.lines ? lowerBound(lines, state.lines[step > 0 ? 1 : 0]) + step : 0;
      const line = lines[Math.min(lines.length - 1, Math.max(0, at))];
      if (line !== undefined) {
        chooseLine(line);
        scrollTo(line);
      }
    };
    if (pair) {
      const tabs = document.getElementById("tabs");
      programs.forEach((program, i) => {
        const button = document.createElement("button");
        button.textContent = program.name;
        button.onclick = () => choose(i, null, state.moment, false);
        tabs.append(button);
      });
    }

    // Charts --------------------------------------------------------------------------------------

    const charts = document.getElementById("charts");
    const tools = [...new Set(programs.flatMap((p) => p.tools.map((tool) => tool[0])))];
    const ink = (i) => (pair ? data.inks.pair[i] : data.inks.curve);
    const panels = [];
    const curves = (title, tall, of) =>
      panels.push({ title, tall, curves: programs.map((p, i) => ({ line: of(p), ink: ink(i) })) });
    curves("Spindle (rev/min)", 110, (p) => p.speed);
    panels.push({ title: "Tool", tall: Math.min(220, Math.max(44, tools.length * 20 + 6)), tools });
    curves(`Feed (${data.feed})`, 120, (p) => p.feed);
    if (pair) {
      const names = [...new Set(programs.flatMap((p) => p.axes.map((axis) => axis.name)))];
      const none = { t: new Float64Array(), v: new Float64Array() };
      for (const name of names) {
        curves(`${name} (${"XYZ".includes(name) ? "mm" : "\u00b0"})`, 90, (p) => p.axes.find((axis) => axis.name === name)?.line ?? none);
      }
      if (data.later) panels.push({ title: "Later by (s)", tall: 80, curves: [{ line: readCurve(data.later), ink: data.inks.curve }] });
    } else {
      for (const [names, unit] of [["XYZ", "mm"], ["ABC", "\u00b0"]]) {
        const shown = programs[0].axes.filter((axis) => names.includes(axis.name));
        if (shown.length) {
          panels.push({
            title: `Position (${unit})`,
            tall: 180,
            curves: shown.map((axis) => ({ name: axis.name, line: axis.line, ink: data.inks.axes[names.indexOf(axis.name)] })),
          });
        }
      }
    }
    for (const panel of panels) if (panel.curves) scale(panel);
    let top = 6;
    for (const panel of panels) {
      panel.top = top;
      top += panel.tall + GAP;
    }
    charts.style.height = `${top - GAP + BOTTOM}px`;

    function scale(panel) {
      let [low, high, least] = [Infinity, -Infinity, Infinity];
      for (const { line } of panel.curves) {
        for (const v of line.v) {
          low = Math.min(low, v);
          high = Math.max(high, v);
          if (v > 0) least = Math.min(least, v);
        }
      }
      if (low > high) [low, high] = [0, 0];
      const most = Math.max(2, panel.tall / 28);
      if (panel.title.startsWith("Feed") && high > 20 * least) {
        panel.title = `Feed (${data.feed}, log)`;
        const floor = Math.log10(least / 1.6);
        panel.at = (v) => (v > 0 ? Math.max(floor, Math.log10(v)) : floor);
        [panel.low, panel.high] = [floor, Math.log10(high * 1.25)];
        panel.marks = powerMarks(least / 1.2, high * 1.25, most).map((v) => [Math.log10(v), number(v, v)]);
        panel.marks.push([floor, "0"]);
        return;
      }
      if (panel.title.startsWith("Later")) {
        const room = Math.max(high - low, 0.01) / 2;
        [low, high] = [Math.min(low, -room), Math.max(high, room)];
      }
      const room = high > low ? (high - low) * 0.08 : Math.max(1, Math.abs(high)) * 0.5;
      panel.at = (v) => v;
      panel.low = low === 0 ? 0 : low - room;
      panel.high = high + room;
      const [at, step] = marks(panel.low, panel.high, most);
      panel.marks = at.map((v) => [v, number(v, step)]);
    }

    const timeAt = (x) => {
      const wide = charts.clientWidth - LEFT - RIGHT;
      return state.span[0] + ((x - LEFT) / wide) * (state.span[1] - state.span[0]);
    };

    function drawCharts() {
      const [context, wide] = fit(charts);
      const across = wide - LEFT - RIGHT;
      if (across < 20) return;
      const [from, to] = state.span;
      const x = (time) => LEFT + ((time - from) / (to - from)) * across;
      const [times, step] = clockMarks(from, to, Math.max(2, across / 90));
      panels.forEach((panel, n) => {
        const { top, tall } = panel;
        context.setLineDash([]);
        context.lineWidth = 1;
        context.save();
        context.beginPath();
        context.rect(LEFT, top, across, tall);
        context.clip();
        context.fillStyle = "#ffe9a8";
        for (const [a, b] of state.times) {
          if (b >= from && a <= to) context.fillRect(x(a) - 0.5, top, Math.max(1.5, x(b) - x(a) + 1), tall);
        }
        context.strokeStyle = "#dddddd";
        for (const time of times) line(context, x(time), top, x(time), top + tall);
        if (panel.curves) drawCurves(context, panel, x);
        else drawTools(context, panel, x);
        if (state.moment !== null) {
          context.setLineDash([]);
          context.lineWidth = 1;
          context.strokeStyle = "#000000";
          line(context, x(state.moment), top, x(state.moment), top + tall);
        }
        context.restore();
        if (panel.curves?.[0]?.name) nameCurves(context, panel);
        context.setLineDash([]);
        context.lineWidth = 1;
        context.strokeStyle = "#666666";
        line(context, LEFT, top, LEFT, top + tall);
        line(context, LEFT, top + tall, LEFT + across, top + tall);
        context.fillStyle = "#222222";
        context.textBaseline = "middle";
        context.textAlign = "right";
        if (panel.curves) {
          for (const [v, text] of panel.marks) context.fillText(text, LEFT - 8, yOf(panel, v));
        } else {
          panel.tools.forEach((name, row) => {
            const each = Math.ceil(14 / (tall / panel.tools.length));
            if (row % each === 0) context.fillText(name, LEFT - 8, top + ((row + 0.5) / panel.tools.length) * tall);
          });
        }
        context.save();
        context.translate(12, top + tall / 2);
        context.rotate(-Math.PI / 2);
        context.textAlign = "center";
        context.fillText(panel.title, 0, 0);
        context.restore();
        if (n + 1 < panels.length) return;
        context.textAlign = "center";
        for (const time of times) context.fillText(clock(time, step, end), x(time), top + tall + 12);
        context.fillText(end < 180 ? "Time (s)" : "Time (h:mm:ss)", LEFT + across / 2, top + tall + 30);
      });
    }

    function line(context, x0, y0, x1, y1) {
      context.beginPath();
      context.moveTo(x0, y0);
      context.lineTo(x1, y1);
      context.stroke();
    }

    const yOf = (panel, v) => panel.top + panel.tall * (1 - (v - panel.low) / (panel.high - panel.low));

    function drawCurves(context, panel, x) {
      context.strokeStyle = "#dddddd";
      for (const [v] of panel.marks) line(context, LEFT, yOf(panel, v), charts.clientWidth, yOf(panel, v));
      panel.curves.forEach((curve) => {
        const { t, v } = curve.line;
        const first = Math.max(0, lowerBound(t, state.span[0]) - 1);
        styles.line(context, curve.ink);
        context.beginPath();
        for (let at = first; at < t.length; at++) {
          context.lineTo(x(t[at]), yOf(panel, panel.at(v[at])));
          if (t[at] > state.span[1]) break;
        }
        context.stroke();
      });
    }

    function nameCurves(context, panel) {
      panel.curves.forEach((curve, i) => {
        const [left, y] = [charts.clientWidth - RIGHT + 8, panel.top + 12 + 18 * i];
        styles.line(context, curve.ink);
        line(context, left, y, left + 24, y);
        context.fillStyle = "#222222";
        context.textAlign = "left";
        context.textBaseline = "middle";
        context.fillText(curve.name, left + 30, y);
      });
    }

    function drawTools(context, panel, x) {
      const row = panel.tall / panel.tools.length;
      programs.forEach((program, n) => {
        context.fillStyle = ink(n).color;
        const slot = (row * 0.76) / programs.length;
        for (const [name, from, to] of program.tools) {
          const top = panel.top + panel.tools.indexOf(name) * row + row * 0.12 + n * slot;
          context.fillRect(x(from), top, Math.max(1, x(to) - x(from)), slot);
        }
      });
    }

    zoom(charts, () => charts, {
      at: (event, factor) => {
        const time = timeAt(event.offsetX);
        const [a, b] = state.span.map((v) => time + (v - time) * factor);
        if (b - a < 1e-3) return;
        state.span = [Math.max(begin, a), Math.min(end, b)];
      },
      by: (dx) => {
        const moved = (-dx / (charts.clientWidth - LEFT - RIGHT)) * (state.span[1] - state.span[0]);
        const off = Math.max(begin - state.span[0], Math.min(end - state.span[1], moved));
        state.span = state.span.map((v) => v + off);
      },
      all: () => (state.span = [begin, end]),
      click: (event) => {
        const time = Math.min(end, Math.max(begin, timeAt(event.offsetX)));
        chooseLeg(state.shown, legAt(programs[state.shown].way, time), time, true);
      },
      hover: (event) => {
        const time = timeAt(event.offsetX);
        if (time < begin || time > end) return hide();
        const shown = programs.map((p, i) => {
          const of = (curve, step) => number(valueAt(curve, time) ?? 0, step);
          const tool = p.tools.find((one) => one[1] <= time && time < one[2]);
          const axes = p.axes.map((axis) => `${axis.name} ${of(axis.line, 0.001)}`).join("  ");
          const name = pair ? `${p.name}\n` : "";
          return `${name}${tool ? tool[0] + "  " : ""}S ${of(p.speed, 1)}  F ${of(p.feed, 1)}\n${axes}\n${lineText(i, legAt(p.way, time))}`;
        });
        showTip(event, [clock(time, 0.001, end) + (end < 180 ? " s" : ""), ...shown].join("\n"));
      },
    });

    // Views ---------------------------------------------------------------------------------------

    const kinds = programs.map(({ way }) => {
      const of = { r: [], f: [], a: [], h: [] };
      for (let i = 0; i < way.kinds.length; i++) if (!way.again[i]) of[way.kinds[i]]?.push(i);
      return of;
    });
    const views = ["plan", "isometric"].map((name) => {
      const canvas = document.getElementById(name);
      const points = programs.map(({ way }) => {
        const out = new Float64Array(2 * (way.kinds.length + 1));
        if (way.start) out.set(project(name, way.start), 0);
        for (let i = 0; i < way.kinds.length; i++) out.set(project(name, pointOf(way, i)), 2 * i + 2);
        return out;
      });
      const view = { name, canvas, points, scale: 1, middle: [0, 0] };
      view.all = () => {
        let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
        points.forEach((list, n) => {
          if (!programs[n].way.start) return;
          for (let i = 0; i < list.length; i += 2) {
            left = Math.min(left, list[i]);
            right = Math.max(right, list[i]);
            low = Math.min(low, list[i + 1]);
            high = Math.max(high, list[i + 1]);
          }
        });
        if (left > right) [left, right, low, high] = [0, 0, 0, 0];
        const [wide, tall] = [Math.max(right - left, 1e-3), Math.max(high - low, 1e-3)];
        view.middle = [(left + right) / 2, (low + high) / 2];
        // Room for the numbers of the grid, or for the directions in the lower corner.
        const [beside, below] = name === "plan" ? [84, 84] : [48, 120];
        view.scale = Math.min((canvas.clientWidth - beside) / wide, (canvas.clientHeight - below) / tall, 200);
        if (name !== "plan") view.middle[1] -= 36 / view.scale;
      };
      view.at = (x, y) => [
        canvas.clientWidth / 2 + (x - view.middle[0]) * view.scale,
        canvas.clientHeight / 2 - (y - view.middle[1]) * view.scale,
      ];
      view.back = (x, y) => [
        view.middle[0] + (x - canvas.clientWidth / 2) / view.scale,
        view.middle[1] - (y - canvas.clientHeight / 2) / view.scale,
      ];
      view.nearest = (event) => {
        const p = view.back(event.offsetX, event.offsetY);
        let best = { away: 8 / view.scale, program: state.shown, leg: -1, part: 0 };
        programs.forEach(({ way }, n) => {
          const list = points[n];
          for (let i = 0; i < way.kinds.length; i++) {
            if (!"rfah".includes(way.kinds[i])) continue;
            const [away, part] = distance(p, [list[2 * i], list[2 * i + 1]], [list[2 * i + 2], list[2 * i + 3]]);
            const nearer = away < best.away - 1e-9;
            if (nearer) best = { away, program: n, leg: i, part };
          }
        });
        const { begin: first, way } = programs[best.program];
        const from = best.leg > 0 ? way.ends[best.leg - 1] : first;
        best.time = best.leg < 0 ? null : from + best.part * (way.ends[best.leg] - from);
        return best;
      };
      zoom(canvas, () => view, {
        at: (event, factor) => {
          const [x, y] = view.back(event.offsetX, event.offsetY);
          view.scale = Math.min(1e6, Math.max(1e-4, view.scale / factor));
          const [nx, ny] = view.back(event.offsetX, event.offsetY);
          view.middle = [view.middle[0] + x - nx, view.middle[1] + y - ny];
        },
        by: (dx, dy) => (view.middle = [view.middle[0] - dx / view.scale, view.middle[1] + dy / view.scale]),
        all: view.all,
        click: (event) => {
          const { program, leg, time } = view.nearest(event);
          if (leg >= 0) chooseLeg(program, leg, time, true);
          else choose(state.shown, null, null, false);
        },
        hover: (event) => {
          const { program, leg, time } = view.nearest(event);
          if (leg < 0) return hide();
          const { way } = programs[program];
          const at = placeAt(way, time, programs[program].begin);
          const place = at.map((v, i) => `${"XYZ"[i]} ${number(v, 0.001)}`).join("  ");
          const name = pair ? `${programs[program].name}\n` : "";
          showTip(event, `${name}${NAMES[way.kinds[leg]]}, ${clock(time, 0.001, end)}${end < 180 ? " s" : ""}\n${place}\n${lineText(program, leg)}`);
        },
      });
      return view;
    });

    function drawView(view) {
      const [context, wide, tall] = fit(view.canvas);
      if (wide < 20) return;
      grid(view, context, wide, tall);
      programs.forEach((program, n) => {
        for (const kind of "rfah") {
          const own = data.inks.strokes[kind];
          styles.line(context, !pair && program.way.kinds.length > 4000 ? { ...own, width: own.width * 0.5 } : pair ? { ...own, color: data.inks.pair[n].color, width: Math.min(3, data.inks.pair[n].width) } : own);
          strokeLegs(view, context, n, kinds[n][kind]);
        }
        context.setLineDash([]);
        context.lineWidth = 1.2;
        context.strokeStyle = pair ? data.inks.pair[n].color : data.inks.strokes.h.color;
        const radius = program.holes.length > 400 ? 2.5 : 4;
        for (const hole of program.holes) {
          const [x, y] = view.at(...project(view.name, hole));
          if (x < -9 || y < -9 || x > wide + 9 || y > tall + 9) continue;
          context.beginPath();
          context.arc(x, y, radius, 0, 2 * Math.PI);
          context.stroke();
        }
      });
      const { way } = programs[state.shown];
      if (state.legs.length) {
        context.setLineDash([]);
        context.lineWidth = 7;
        context.strokeStyle = "rgba(255, 196, 0, 0.55)";
        strokeLegs(view, context, state.shown, state.legs.filter((i) => "rfah".includes(way.kinds[i])));
      }
      for (const program of programs) {
        if (!program.way.start) continue;
        const count = program.way.kinds.length;
        diamond(context, view.at(...project(view.name, program.way.start)));
        square(context, view.at(...project(view.name, pointOf(program.way, count - 1))));
      }
      if (state.moment !== null && way.start) {
        const at = placeAt(way, state.moment, programs[state.shown].begin);
        const [x, y] = view.at(...project(view.name, at));
        context.beginPath();
        context.arc(x, y, 5, 0, 2 * Math.PI);
        context.fillStyle = "#ffffff";
        context.fill();
        context.lineWidth = 2;
        context.strokeStyle = "#000000";
        context.stroke();
      }
    }

    /** Draws legs. Those out of sight, and steps too small to see, are left out; a path is stroked in
     *  parts, as a long one takes far more than its share of time. */
    function strokeLegs(view, context, n, legs) {
      const list = view.points[n];
      const [left, low] = view.at(0, 0);
      const { scale } = view;
      const [wide, tall] = [view.canvas.clientWidth, view.canvas.clientHeight];
      const least = legs.length > 5000 ? 0.8 : 0;
      let before = -2;
      let [x, y, parts, last] = [0, 0, 0, false];
      context.lineJoin = "bevel";
      context.beginPath();
      for (const leg of legs) {
        const [x0, y0] = [left + list[2 * leg] * scale, low - list[2 * leg + 1] * scale];
        const [x1, y1] = [left + list[2 * leg + 2] * scale, low - list[2 * leg + 3] * scale];
        const out = (x0 < -9 && x1 < -9) || (y0 < -9 && y1 < -9) || (x0 > wide + 9 && x1 > wide + 9) || (y0 > tall + 9 && y1 > tall + 9);
        if (out) continue;
        if (before !== leg - 1) {
          if (last) context.lineTo(...last);
          context.moveTo(x0, y0);
          [x, y] = [x0, y0];
        }
        before = leg;
        if (Math.abs(x1 - x) + Math.abs(y1 - y) < least) {
          last = [x1, y1];
          continue;
        }
        last = false;
        context.lineTo(x1, y1);
        [x, y] = [x1, y1];
        if (++parts % 256 === 0) {
          context.stroke();
          context.beginPath();
          context.moveTo(x1, y1);
        }
      }
      if (last) context.lineTo(...last);
      context.stroke();
    }

    function diamond(context, [x, y]) {
      context.setLineDash([]);
      context.lineWidth = 1.5;
      context.strokeStyle = "#000000";
      context.beginPath();
      for (const [dx, dy] of [[0, -7], [7, 0], [0, 7], [-7, 0]]) context.lineTo(x + dx, y + dy);
      context.closePath();
      context.stroke();
    }

    function square(context, [x, y]) {
      context.fillStyle = "#000000";
      context.fillRect(x - 3, y - 3, 6, 6);
    }

    /** Of a plan the grid in mm; of an isometric view the three directions and a length. */
    function grid(view, context, wide, tall) {
      context.setLineDash([]);
      context.lineWidth = 1;
      context.textBaseline = "middle";
      const [low, high] = [view.back(0, tall), view.back(wide, 0)];
      const [, step] = marks(0, Math.max(wide, tall) / view.scale, Math.max(wide, tall) / 64);
      context.strokeStyle = "#e4e4e4";
      context.fillStyle = "#444444";
      if (view.name === "plan") {
        const [xs, ys] = [multiples(low[0], high[0], step), multiples(low[1], high[1], step)];
        for (const x of xs) line(context, view.at(x, 0)[0], 0, view.at(x, 0)[0], tall);
        for (const y of ys) line(context, 0, view.at(0, y)[1], wide, view.at(0, y)[1]);
        context.textAlign = "center";
        for (const x of xs) {
          const [at] = view.at(x, 0);
          if (at > 60 && at < wide - 20) context.fillText(number(x, step), at, tall - 9);
        }
        context.textAlign = "left";
        for (const y of ys) if (view.at(0, y)[1] < tall - 24) context.fillText(number(y, step), 4, view.at(0, y)[1]);
        context.fillText("mm", 4, tall - 9);
        return;
      }
      const long = step * view.scale;
      context.strokeStyle = "#444444";
      for (const [name, p] of [["X", [1, 0, 0]], ["Y", [0, 1, 0]], ["Z", [0, 0, 1]]]) {
        const [x, y] = project("isometric", p);
        const [ex, ey] = [24 + x * 32, tall - 40 - y * 32];
        line(context, 24, tall - 40, ex, ey);
        context.textAlign = "center";
        context.fillText(name, ex + x * 10, ey - y * 10);
      }
      line(context, 90, tall - 14, 90 + long, tall - 14);
      line(context, 90, tall - 18, 90, tall - 10);
      line(context, 90 + long, tall - 18, 90 + long, tall - 10);
      context.textAlign = "left";
      context.fillText(`${number(step, step)} mm`, 96 + long, tall - 14);
    }

    // Wheel, drag, click --------------------------------------------------------------------------

    function zoom(element, drawn, on) {
      let last = null;
      let moved = 0;
      element.addEventListener("wheel", (event) => {
        event.preventDefault();
        on.at(event, Math.exp(Math.max(-0.5, Math.min(0.5, event.deltaY * 0.002))));
        redraw(drawn());
      }, { passive: false });
      element.addEventListener("pointerdown", (event) => {
        last = [event.clientX, event.clientY];
        moved = 0;
        element.setPointerCapture(event.pointerId);
      });
      element.addEventListener("pointermove", (event) => {
        if (!last) return on.hover(event);
        const [dx, dy] = [event.clientX - last[0], event.clientY - last[1]];
        moved += Math.abs(dx) + Math.abs(dy);
        last = [event.clientX, event.clientY];
        if (moved < 4) return;
        tip.hidden = true;
        on.by(dx, dy);
        redraw(drawn());
      });
      element.addEventListener("pointerup", (event) => {
        if (last && moved < 4) on.click(event);
        last = null;
      });
      element.addEventListener("pointercancel", () => (last = null));
      element.addEventListener("pointerleave", () => hide());
      element.addEventListener("dblclick", () => {
        on.all();
        redraw(drawn());
      });
    }

    function legend() {
      const box = document.getElementById("legend");
      const used = new Set(programs.flatMap((p) => [...new Set(p.way.kinds)]));
      const entry = (text, draw) => {
        const span = document.createElement("span");
        const canvas = document.createElement("canvas");
        canvas.style.cssText = "width:32px;height:16px";
        span.append(canvas, text);
        box.append(span);
        draw(fit(canvas)[0]);
      };
      const sample = (ink) => (context) => {
        styles.line(context, ink);
        line(context, 0, 8, 32, 8);
      };
      if (pair) programs.forEach((p, i) => entry(p.name, sample({ ...data.inks.pair[i], width: Math.min(3, data.inks.pair[i].width) })));
      for (const kind of "rfah") {
        if (used.has(kind) && (!pair || kind === "r")) {
          entry(NAMES[kind], sample(pair ? { ...data.inks.strokes.r, color: "#000000" } : data.inks.strokes[kind]));
        }
      }
      entry("start", (context) => diamond(context, [16, 8]));
      entry("end", (context) => square(context, [16, 8]));
      const off = Math.max(...programs.map((p) => p.way.off));
      if (off > 0) box.append(`views: true to ${number(off, off / 10)} mm`);
    }

    showSource();
    legend();
    views.forEach((view) => view.all());
    new ResizeObserver(() => redraw()).observe(document.getElementById("pictures"));
    new ResizeObserver(paintRows).observe(list);
    redraw();
  }

  start();
})();
