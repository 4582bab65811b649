// ---- lanes.js: everything over one time scale, with the one cursor that drags anywhere.

const LANE = { axis: 22, phase: 20, row: 23, marks: 21, curve: 21, barHeight: 18, pad: 12, right: 44, curves: 5, rows: 5, bars: 260, frame: 24 };

function lanesPane(app) {
  const { clock, lanes, pieces } = app.report;
  const { log } = app;
  const box = $("lanes");
  const labels = el("div", { class: "lane-labels" });
  const field = svg("svg", { class: "lane-field" });
  const scroll = el("div", { class: "lanes-scroll", tabindex: "-1" }, el("div", { class: "lanes" }, labels, field));
  box.append(scroll);
  const sidewaysChanged = showSideways(box, scroll);

  const span = Math.max(clock.end - clock.start, clock.period, 1);
  let scale = 1;      // pixels a microsecond
  let zoom = 1;       // of the scale that the length of the run suggests
  let curves = [];    // the drawn curves: subject numbers
  let cursor, cursorText, cursorBox, past;
  let still = [];     // drawn once: where each lane stands
  let width = 0, height = 0;
  const X = (t) => LANE.pad + (t - clock.start) * scale;
  const T = (x) => clock.start + (x - LANE.pad) / scale;

  // The bars of a lane as rows of the page's data, in order of their beginning.
  function barsOf(lane) {
    const bars = lane.from.map((from, i) => ({ from, to: lane.to[i], text: lanes.texts[lane.text[i]], full: lanes.texts[lane.full[i]],
      subject: app.report.subjects.id[lane.subject[i]], outcome: ["open", "true", "failed"][lane.sign[i] & 3], by: lane.sign[i] & 4 ? "teacher" : "agent", row: 0 }));
    bars.sort((a, b) => a.from - b.from);
    // Bars of one lane may not overlap: the next free row takes what does not fit; the last row takes all the rest.
    const ends = [];
    for (const bar of bars) {
      let row = ends.findIndex((end) => end <= bar.from);
      if (row < 0) row = ends.length < LANE.rows ? ends.push(0) - 1 : LANE.rows - 1;
      ends[row] = Math.max(ends[row], bar.to, bar.from + 1);
      bar.row = row;
    }
    return { bars, rows: Math.max(1, ends.length), longest: Math.max(0, ...chunked(bars, (bar) => bar.to - bar.from)) };
  }
  const withId = (text, number) => text + (app.isCalledLikeAnother(number) ? ", " + app.report.subjects.id[number] : "");
  const marksOf = (lane) => lane.from.map((at, i) => ({ at, short: lanes.texts[lane.text[i]], text: withId(lanes.texts[lane.full[i]], lane.subject[i]), subject: app.report.subjects.id[lane.subject[i]] }))
    .sort((a, b) => a.at - b.at);
  /** @type {[string, { bars: any[], rows: number, longest: number }, string][]} */
  const LANES = [["Goals", barsOf(lanes.goals), "left"], ["Commands", barsOf(lanes.commands), ""], ["Predictions", barsOf(lanes.predictions), "right"]];
  const MARKS = [["Learned", marksOf(lanes.learned), "learned"], ["Made by analogy", marksOf(lanes.analogy), "analogy"]];

  // The selected model and those that changed most, in order of creation.
  const changing = pieces.map(([number], order) => {
    const { start, value } = log.sure;
    let low = 1, high = 0;
    for (let i = start[number]; i < start[number + 1]; ++i) { low = Math.min(low, value[i]); high = Math.max(high, value[i]); }
    return { number, order, change: high - low };
  }).filter((piece) => piece.change > 0).sort((a, b) => b.change - a.change || a.order - b.order);
  function chooseCurves(selected) {
    const mine = pieces.findIndex(([number]) => number === selected);
    const others = changing.filter((piece) => piece.number !== selected).slice(0, LANE.curves - (mine < 0 ? 0 : 1));
    const shown = others.map((piece) => [piece.order, piece.number]);
    if (mine >= 0 && log.sure.start[selected + 1] > log.sure.start[selected]) shown.push([mine, selected]);
    return { shown: shown.sort((a, b) => a[0] - b[0]).map(([, number]) => number), more: Math.max(0, changing.length - shown.length) };
  }

  // What changes with the selection or the width: where the lanes stand.
  function draw() {
    const style = getComputedStyle(labels);
    const labelWidth = parseFloat(style.width) || 136;
    const room = Math.max(200, box.clientWidth - labelWidth - LANE.pad - LANE.right);
    const frames = Math.max(1, app.frames.length);
    // The whole run is in sight while a frame has room for a word or at least a sign; else the field scrolls.
    const usual = room / frames >= LANE.frame ? room : frames * (frames > 200 ? 14 : 44);
    zoom = clamp(zoom, room / usual, 8);
    scale = usual * zoom / span;
    width = LANE.pad + span * scale + LANE.right;
    labels.replaceChildren();
    still = [];
    let y = 0;
    const label = (text, high, more) => {
      const node = el("div", { class: more && more.class, title: more && more.title }, more && more.child ? more.child : text);
      node.style.top = y + (high - 20) / 2 + "px";
      labels.append(node);
      return node;
    };

    label("", LANE.axis, { child: el("span", { class: "lane-zoom" }, "Time ",
      ...[["\u2212", "Shorter", 1 / 1.6], ["+", "Longer", 1.6]].map(([text, title, by]) => el("button", { type: "button", title: title + " time scale", "aria-label": title + " time scale", text, on: { click: () => zoomBy(by) } }))) });
    y += LANE.axis;
    if (lanes.phases.length) {
      label("Phase", LANE.phase);
      const top = y;
      still.push((from, to) => lanes.phases.filter((phase) => phase.to >= from && phase.from <= to).map((phase) => phaseBar(phase, top)));
      y += LANE.phase + 2;
    }
    for (const [name, { bars, rows, longest }, shape] of LANES) {
      if (!bars.length) continue;
      label(name, LANE.row);
      const top = y;
      still.push((from, to) => barsIn(bars, longest, from, to, top, rows, shape));
      y += LANE.row * rows;
    }
    for (const [name, list, sign] of MARKS) {
      if (!list.length) continue;
      label(name, LANE.marks);
      const top = y;
      still.push((from, to) => {
        const out = [];
        let free = -Infinity;
        for (let i = firstAfter(list, from - 200 / scale, (entry) => entry.at); i < list.length && list[i].at <= to; ++i) {
          // Where they are dense, only as many as can be told apart.
          if (X(list[i].at) < free) continue;
          let next = i + 1;
          while (next < list.length && list[next].at === list[i].at) ++next;
          out.push(laneMark(list[i], next - i, list[next], top, sign));
          free = X(list[i].at) + 3;
        }
        return out;
      });
      y += LANE.marks;
    }

    const selected = app.numbers.get(app.selected);
    const chosen = chooseCurves(selected);
    curves = chosen.shown;
    if (curves.length) {
      y += 4;
      const line = y;
      still.push(() => [svg("line", { class: "grid", x1: 0, x2: width, y1: line + 0.5, y2: line + 0.5 })]);
      y += 2;
      label("How sure", 18, { class: "quiet" });
      y += 18;
      for (const number of curves) {
        const one = app.subjectByNumber(number);
        const own = number === selected;
        const button = el("button", { type: "button", class: own ? "selected" : "", text: app.isCalledLikeAnother(number) ? one.id + " " + one.title : one.title,
          title: "How sure: " + one.id + ", " + one.title, on: { click: () => app.select(one.id) } });
        button.dataset.subject = one.id;
        const node = label("", LANE.curve, { child: button });
        // Where the curve begins late, its name may reach over the free field.
        const free = width <= box.clientWidth - labelWidth + 1 ? X(log.confidence(number)[0].at) - 44 : 0;
        node.style.width = labelWidth - 20 + Math.max(0, free) + "px";
        node.style.right = "auto";
        const top = y;
        still.push((from, to) => [curve(one, top, own, from, to)]);
        y += LANE.curve;
      }
      if (chosen.more > 0) {
        label(`+${chosen.more} more`, 18, { class: "quiet" });
        y += 18;
      }
    }
    height = y + 2;
    past = svg("rect", { class: "past", x: 0, y: LANE.axis, height: height - LANE.axis, width: 0 });
    cursorText = svg("text", { y: 14 });
    cursorBox = svg("rect", { y: 0, height: 20, rx: 4 });
    cursor = svg("g", { class: "cursor", tabindex: "0", role: "slider", "aria-label": "Moment" },
      svg("line", { y1: 18, y2: height }), cursorBox, cursorText);
    field.setAttribute("width", width);
    field.setAttribute("height", height);
    field.setAttribute("viewBox", `0 0 ${width} ${height}`);
    labels.style.height = height + "px";
    cursor.setAttribute("aria-valuemin", clock.start / 1e6);
    cursor.setAttribute("aria-valuemax", clock.end / 1e6);
    drawSight();
    sidewaysChanged();
  }

  // What is in sight, and a little beside it.
  function drawSight() {
    const focused = document.activeElement && field.contains(document.activeElement) ? document.activeElement.dataset.subject || "cursor" : "";
    const from = T(scroll.scrollLeft - 300), to = T(scroll.scrollLeft + scroll.clientWidth + 300);
    field.replaceChildren(past, ...ticks(from, to), ...still.flatMap((part) => part(from, to)), cursor);
    field.dataset.from = String(from);
    field.dataset.to = String(to);
    showSelected();
    if (focused === "cursor") cursor.focus();
    else if (focused) { const same = [...field.querySelectorAll(".item")].find((node) => node.dataset.subject === focused && node.tabIndex === 0); if (same) same.focus(); }
  }
  let waiting = 0;
  scroll.addEventListener("scroll", () => {
    const from = T(scroll.scrollLeft), to = T(scroll.scrollLeft + scroll.clientWidth);
    if (waiting || (from >= Number(field.dataset.from) && to <= Number(field.dataset.to))) return;
    waiting = requestAnimationFrame(() => { waiting = 0; drawSight(); });
  });
  // The time scale changes around the cursor, or around what is pointed at.
  function zoomBy(by, x = X(app.t) - scroll.scrollLeft) {
    const at = T(scroll.scrollLeft + x);
    zoom *= by;
    draw();
    scroll.scrollLeft = X(at) - x;
    drawSight();
    pane.showTime(app.t);
  }
  field.addEventListener("wheel", (event) => {
    if (!event.ctrlKey) return;
    event.preventDefault();
    zoomBy(event.deltaY < 0 ? 1.25 : 0.8, event.clientX - scroll.getBoundingClientRect().left - labels.offsetWidth);
  }, { passive: false });

  // The bars between two times; where there are too many to be told apart, how dense they are.
  function barsIn(bars, longest, from, to, top, rows, shape) {
    const first = firstAfter(bars, from - longest, (bar) => bar.from);
    const last = firstAfter(bars, to, (bar) => bar.from);
    const inSight = [];
    for (let i = first; i < last; ++i) if (bars[i].to >= from) inSight.push(bars[i]);
    if (inSight.length <= LANE.bars) return inSight.map((bar) => laneBar(bar, top + bar.row * LANE.row, shape));
    const step = 4;
    const counts = new Map();
    const failed = new Map();
    for (const bar of inSight) {
      const column = Math.floor(X(bar.from) / step);
      counts.set(column, (counts.get(column) || 0) + 1);
      if (bar.outcome === "failed") failed.set(column, (failed.get(column) || 0) + 1);
    }
    const most = Math.max(...counts.values());
    const high = LANE.row * rows - 4;
    const path = (map) => [...map].map(([column, count]) => { const h = Math.max(1.5, high * count / most); return `M${column * step} ${top + 2 + high - h}h${step - 1}v${h}h${1 - step}Z`; }).join("");
    return [svg("g", {}, svg("title", { text: `${inSight.length} here; a longer time scale shows each` }), svg("path", { class: "density", d: path(counts) }), svg("path", { class: "density failed", d: path(failed) }))];
  }

  function ticks(from, to) {
    const out = [];
    const pixels = clock.period * scale || 60;
    let every = 1;
    for (const step of [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 20000, 50000, 100000]) { every = step; if (step * pixels >= 36) break; }
    const first = Math.ceil(frameAt(app.frames, from) / every) * every;
    const marks = [];
    for (let i = first; i < app.frames.length && app.frames[i] <= to; i += every) marks.push([app.frames[i], i === 0]);
    const end = app.frames[app.frames.length - 1] + clock.period;
    if (end <= clock.end && end <= to && app.frames.length % every === 0) marks.push([end, false]);
    for (const [at, begins] of marks) {
      const x = Math.round(X(at)) + 0.5;
      if (x > width) break;
      out.push(svg("line", { class: "grid", x1: x, x2: x, y1: LANE.axis, y2: height }),
        svg("text", { class: "tick", x, y: 15, text: tickText(at) + (begins ? " s" : "") }));
    }
    return out;
  }

  function phaseBar(phase, y) {
    const short = phase.text.split(": ").pop();   // "the teacher commands", "teacher"
    const x = X(phase.from) + 1.5, w = Math.max(2, X(phase.to) - X(phase.from) - 3);
    return svg("g", {}, svg("title", { text: phase.text }), svg("rect", { class: "phase", x, y: y + 2, width: w, height: 16 }),
      svg("text", { x: x + 5, y: y + 14, text: firstFitting([phase.text, short, short.split(" ")[1] || short], w - 7, 11.5) }));
  }

  // A goal's tag points left, a prediction's right, a command is a plain bar.
  function laneBar(bar, y, shape) {
    const x = X(bar.from) + 1.5, w = Math.max(4, X(Math.max(bar.to, bar.from)) - X(bar.from) - 3);
    const top = y + 2.5, h = LANE.barHeight, tip = Math.min(7, w / 3);
    const d = shape === "left" ? `M${x} ${top + h / 2}l${tip} ${-h / 2}H${x + w}v${h}H${x + tip}Z`
      : shape === "right" ? `M${x} ${top}H${x + w - tip}l${tip} ${h / 2}l${-tip} ${h / 2}H${x}Z`
        : `M${x} ${top}h${w}v${h}h${-w}Z`;
    const failed = bar.outcome === "failed";
    const decided = bar.outcome === "true" || failed;
    const signRoom = decided && w > 12 ? 10 : 0;
    const left = x + (shape === "left" ? tip + 1 : 4);
    const room = x + w - left - (shape === "right" ? tip - 3 : 2);
    // Too short for words, a tag keeps the sign of what came of it, or its first letter.
    const words = firstFitting(shape === "right" ? [bar.text, lastResort(bar.text)] : [bar.text], room - signRoom, 11) || (!signRoom && w > 9 ? Array.from(bar.text)[0] || "" : "");
    const state = { true: ", came true", failed: shape === "" ? ", refused" : ", failed", open: "" }[bar.outcome];
    const title = (bar.full || bar.text) + ", " + secondsText(bar.from) + " to " + secondsText(bar.to) + state;
    return selectable(bar.subject, title, (failed ? "failed " : "") + (shape === "" ? bar.by : ""), bar.from,
      svg("path", { class: "bar", d }), svg("text", { x: left, y: top + 13, text: words }),
      signRoom ? signAt(failed ? "cross" : "check", words ? left + room - 5 : x + w / 2, top + h / 2, 10, "mark") : "");
  }

  // What came at one time is one sign, with how many it stands for.
  function laneMark(entry, count, next, y, sign) {
    const x = X(entry.at), end = next ? X(next.at) - 8 : X(clock.end) + LANE.right;
    const middle = y + LANE.marks / 2;
    const words = count > 1 ? firstFitting([count + " pieces", "\u00d7" + count], end - x - 9, 11) : firstFitting([entry.text, entry.short], end - x - 9, 11);
    return selectable(entry.subject, entry.text + (count > 1 ? ` and ${count - 1} more` : "") + ", " + secondsText(entry.at), "", entry.at,
      svg("rect", { class: "focus", x: x - 8, y: middle - 9, width: 16 + (words ? widthOf(words, 11) + 4 : 0), height: 18, rx: 4 }),
      signAt(sign, x, middle, sign === "analogy" ? 13 : 12, "sign"),
      words ? svg("text", { class: "note", x: x + 9, y: middle + 4, text: words }) : "");
  }

  function curve(one, y, selected, from, to) {
    const all = log.confidence(one.number);
    const start = Math.max(0, firstAfter(all, from, (step) => step.at) - 1);
    const end = Math.min(all.length, firstAfter(all, to, (step) => step.at) + 1);
    const steps = all.slice(start, end);
    const low = y + LANE.curve - 4.5, high = y + 4.5;
    const Y = (sure) => low + (high - low) * clamp((sure - 0.5) / 0.5, 0, 1);
    let d = "";
    const dots = [];
    steps.forEach((step, i) => {
      d += i ? `H${X(step.at)}V${Y(step.sure)}` : `M${X(step.at)} ${Y(step.sure)}`;
      if (steps.length < 120) dots.push(svg("circle", { class: "dot", cx: X(step.at), cy: Y(step.sure), r: 2.2 }));
    });
    const last = all[all.length - 1];
    if (!last.deleted && end === all.length) d += `H${X(clock.end)}`;
    const first = X(all[0].at);
    return selectable(one.id, "How sure: " + app.titleOf(one.number), "curve-item " + (selected ? "selected" : ""), null,
      svg("rect", { class: "focus", x: first - 36, y, width: Math.max(60, X(clock.end) - first + 70), height: LANE.curve, rx: 4 }),
      svg("path", { class: "curve", d }), ...dots,
      first > 44 ? svg("text", { x: first - 7, y: Y(all[0].sure) + 4, "text-anchor": "end", text: sureText(all[0].sure) }) : "",
      last.deleted ? svg("text", { x: X(last.at) + 7, y: Y(last.sure) + 4, text: "given up" })
        : svg("text", { x: X(clock.end) + 9, y: Y(last.sure) + 4, text: sureText(last.sure) }));
  }

  function selectable(subject, title, more, at, ...children) {
    const group = svg("g", { class: ("item " + more).trim(), tabindex: at === null ? "-1" : "0", role: "button" }, svg("title", { text: title }), ...children);
    group.dataset.subject = subject;
    group.addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault();
      app.select(subject);
      if (at !== null) app.go(at);
      const same = [...field.querySelectorAll(".item")].find((node) => node.dataset.subject === subject && node.tabIndex === 0);
      if (same) same.focus();
    });
    return group;
  }

  // Dragging snaps to a tenth of a frame, and to frames where those are near.
  function snapped(t) {
    const start = lastAt(app.frames, t, (at) => at) ?? clock.start;
    const part = Math.round((t - start) / clock.period * 10) / 10;
    const near = part < 0.25 ? 0 : part > 0.75 ? 1 : part;
    return start + near * clock.period;
  }
  let dragging = false, moved = false, pressed = null, downX = 0;
  const timeOf = (event) => snapped(T(event.clientX - field.getBoundingClientRect().left));
  function press(event) {
    if (event.button !== 0) return;
    dragging = true;
    moved = false;
    downX = event.clientX;
    pressed = event.target.closest("[data-subject]");
    field.setPointerCapture(event.pointerId);
    if (!pressed) app.go(timeOf(event));
  }
  field.addEventListener("pointerdown", press);
  // Where a name reaches over the field, a drag that begins on it is a drag.
  labels.addEventListener("pointerdown", (event) => {
    if (event.clientX > labels.getBoundingClientRect().right) press(event);
  });
  field.addEventListener("pointermove", (event) => {
    if (!dragging) return;
    if (Math.abs(event.clientX - downX) > 3) moved = true;
    if (moved) app.go(timeOf(event));
  });
  field.addEventListener("pointerup", (event) => {
    if (!dragging) return;
    dragging = false;
    if (moved || !pressed) return;
    const timed = pressed.tabIndex === 0 && pressed instanceof SVGElement;
    app.select(pressed.dataset.subject);
    if (timed) app.go(timeOf(event));
  });
  field.addEventListener("pointercancel", () => { dragging = false; });

  function showSelected() {
    for (const node of field.querySelectorAll(".item")) {
      node.classList.toggle("selected", node.dataset.subject === app.selected);
    }
  }
  // A long run is wider than the pane: the cursor stays in view.
  function keepInView(x) {
    const seen = scroll.clientWidth - labels.offsetWidth;
    if (width <= seen) return;
    if (x < scroll.scrollLeft + 24 || x > scroll.scrollLeft + seen - 24) scroll.scrollLeft = x - seen / 3;
  }

  draw();
  let drawnFor = box.clientWidth;
  new ResizeObserver(() => {
    if (box.clientWidth === drawnFor) return;
    drawnFor = box.clientWidth;
    draw();
    pane.showTime(app.t);
  }).observe(box);
  // On paper the whole time has to fit.
  matchMedia("print").addEventListener("change", (event) => {
    zoom = event.matches ? 0 : 1;
    draw();
    pane.showTime(app.t);
  });
  const pane = {
    showTime(t) {
      const x = X(t);
      cursor.setAttribute("transform", `translate(${x} 0)`);
      cursor.setAttribute("aria-valuenow", t / 1e6);
      cursor.setAttribute("aria-valuetext", app.clock);
      cursorText.textContent = app.clock;
      const wide = widthOf(cursorText.textContent, 11.5) + 14;
      cursorBox.setAttribute("x", -wide / 2);
      cursorBox.setAttribute("width", wide);
      // At the edges the tag stays inside.
      const limit = width;
      const shift = clamp(0, wide / 2 - x, Math.max(wide / 2 - x, limit - x - wide / 2));
      cursorBox.setAttribute("transform", `translate(${shift} 0)`);
      cursorText.setAttribute("transform", `translate(${shift} 0)`);
      past.setAttribute("width", Math.max(0, x));
      if (!dragging) keepInView(x);
    },
    showSelection() { draw(); },
  };
  return app.add(pane);
}

// Of a prediction in a word or two what is left where there is room for one: "at s1" is "s1", "not [s1]" is "not".
const lastResort = (text) => (text.startsWith("not ") ? "not" : text.replace(/^[^\s[(]+ /u, ""));

// Where in a list, ordered by `at`, the entries after t begin.
function firstAfter(list, t, at) {
  let low = 0, high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (at(list[middle]) < t) low = middle + 1; else high = middle;
  }
  return low;
}
// The largest value of each thousand; functions take no more arguments than so many.
function chunked(list, value) {
  const out = [];
  for (let i = 0; i < list.length; i += 1000) out.push(Math.max(...list.slice(i, i + 1000).map(value)));
  return out;
}
