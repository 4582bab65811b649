// ---- lanes.js: everything over one time scale, with the one cursor that drags anywhere.

const LANE = { axis: 22, phase: 20, row: 23, marks: 21, curve: 21, barHeight: 18, pad: 12, right: 44, curves: 5 };

function lanesPane(app) {
  const { clock, lanes, pieces, subjects } = app.report;
  const box = $("lanes");
  const labels = el("div", { class: "lane-labels" });
  const field = svg("svg", { class: "lane-field" });
  const scroll = el("div", { class: "lanes-scroll" }, el("div", { class: "lanes" }, labels, field));
  box.append(scroll);

  const span = Math.max(clock.end - clock.start, clock.period, 1);
  let scale = 1;      // pixels a microsecond
  let curves = [];    // ids of the drawn curves
  let cursor, cursorText, cursorBox, past;
  const X = (t) => LANE.pad + (t - clock.start) * scale;
  const T = (x) => clock.start + (x - LANE.pad) / scale;

  // The selected model and those that changed most, in order of creation.
  function chooseCurves(selected) {
    const all = pieces.filter((piece) => subjects[piece.subject].confidence.length);
    const change = (piece) => {
      const steps = subjects[piece.subject].confidence;
      return Math.max(...steps.map((s) => s.sure)) - Math.min(...steps.map((s) => s.sure));
    };
    const moved = all.filter((piece) => change(piece) > 0 && piece.subject !== selected)
      .sort((a, b) => change(b) - change(a) || a.born - b.born);
    const mine = all.filter((piece) => piece.subject === selected);
    const others = moved.slice(0, LANE.curves - mine.length);
    const shown = new Set([...mine, ...others].map((piece) => piece.subject));
    return { shown: all.filter((piece) => shown.has(piece.subject)), more: moved.length - others.length };
  }

  // Bars of one lane may not overlap: the next free row takes what does not fit.
  function rowsOf(bars) {
    const ends = [];
    return bars.map((bar) => {
      let row = ends.findIndex((end) => end <= bar.from);
      if (row < 0) row = ends.push(0) - 1;
      ends[row] = Math.max(bar.to, bar.from + 1);
      return row;
    });
  }

  function draw() {
    const style = getComputedStyle(labels);
    const labelWidth = parseFloat(style.width) || 136;
    const room = Math.max(200, box.clientWidth - labelWidth - LANE.pad - LANE.right);
    const frames = Math.max(1, app.frames.length);
    scale = Math.max(room, frames * (frames > 200 ? 14 : 44)) / span;
    const width = LANE.pad + span * scale + LANE.right;
    labels.replaceChildren();
    const back = [], front = [];
    let y = 0;
    const label = (text, height, more) => {
      const node = el("div", { class: more && more.class, title: more && more.title }, more && more.child ? more.child : text);
      node.style.top = y + (height - 20) / 2 + "px";
      labels.append(node);
      return node;
    };

    label("Time", LANE.axis);
    y += LANE.axis;
    if (lanes.phases.length) {
      label("Phase", LANE.phase);
      for (const phase of lanes.phases) front.push(phaseBar(phase, y));
      y += LANE.phase + 2;
    }
    const lane = (name, bars, shape) => {
      if (!bars.length) return;
      const rows = rowsOf(bars);
      label(name, LANE.row);
      bars.forEach((bar, i) => front.push(laneBar(bar, y + rows[i] * LANE.row, shape)));
      y += LANE.row * (Math.max(...rows) + 1);
    };
    lane("Goals", lanes.goals, "left");
    lane("Commands", lanes.commands, "");
    lane("Predictions", lanes.predictions, "right");
    const marks = (name, list, sign) => {
      if (!list.length) return;
      label(name, LANE.marks);
      list.forEach((entry, i) => front.push(laneMark(entry, list[i + 1], y, sign)));
      y += LANE.marks;
    };
    marks(lanes.taught_label, lanes.taught, "learned");
    marks("Learned: analogy", lanes.analogy, "analogy");

    const chosen = chooseCurves(app.selected);
    curves = chosen.shown;
    if (curves.length) {
      y += 4;
      front.push(svg("line", { class: "grid", x1: 0, x2: width, y1: y + 0.5, y2: y + 0.5 }));
      y += 4;
      for (const piece of curves) {
        const selected = piece.subject === app.selected;
        const button = el("button", { type: "button", class: selected ? "selected" : "", text: "Sure: " + piece.text,
          title: "How sure: " + piece.text, on: { click: () => app.select(piece.subject) } });
        button.dataset.subject = piece.subject;
        const node = label("", LANE.curve, { child: button });
        // Where the curve begins late, its name may reach over the free field.
        const free = width <= box.clientWidth - labelWidth + 1 ? X(subjects[piece.subject].confidence[0].at) - 44 : 0;
        node.style.width = labelWidth - 20 + Math.max(0, free) + "px";
        node.style.right = "auto";
        front.push(curve(piece, y, selected));
        y += LANE.curve;
      }
      if (chosen.more > 0) {
        label(`+${chosen.more} more`, 18, { class: "quiet" });
        y += 18;
      }
    }
    const height = y + 2;
    past = svg("rect", { class: "past", x: 0, y: LANE.axis, height: height - LANE.axis, width: 0 });
    back.push(past, ...ticks(height, width));
    cursorText = svg("text", { y: 14 });
    cursorBox = svg("rect", { y: 0, height: 20, rx: 4 });
    cursor = svg("g", { class: "cursor", tabindex: "0", role: "slider", "aria-label": "Moment" },
      svg("line", { y1: 18, y2: height }), cursorBox, cursorText);
    field.replaceChildren(...back, ...front, cursor);
    field.setAttribute("width", width);
    field.setAttribute("height", height);
    field.setAttribute("viewBox", `0 0 ${width} ${height}`);
    labels.style.height = height + "px";
    cursor.setAttribute("aria-valuemin", clock.start / 1e6);
    cursor.setAttribute("aria-valuemax", clock.end / 1e6);
  }

  function ticks(height, width) {
    const out = [];
    const pixels = clock.period * scale || 60;
    const every = Math.max(1, Math.ceil(36 / pixels));
    const marks = app.frames.filter((_, i) => i % every === 0);
    const end = app.frames[app.frames.length - 1] + clock.period;
    if (end <= clock.end && app.frames.length % every === 0) marks.push(end);
    marks.forEach((at, i) => {
      const x = Math.round(X(at)) + 0.5;
      if (x > width) return;
      out.push(svg("line", { class: "grid", x1: x, x2: x, y1: LANE.axis, y2: height }),
        svg("text", { class: "tick", x, y: 15, text: tickText(at) + (i === 0 ? " s" : "") }));
    });
    return out;
  }

  function phaseBar(phase, y) {
    const x = X(phase.from) + 1.5, w = Math.max(2, X(phase.to) - X(phase.from) - 3);
    return svg("g", {}, svg("title", { text: phase.text }), svg("rect", { class: "phase", x, y: y + 2, width: w, height: 16 }),
      svg("text", { x: x + 5, y: y + 14, text: fitted(phase.text, w - 10, 11.5) }));
  }

  // A goal's tag points left, a prediction's right, a command is a plain bar.
  function laneBar(bar, y, shape) {
    const x = X(bar.from) + 1.5, w = Math.max(4, X(Math.max(bar.to, bar.from)) - X(bar.from) - 3);
    const top = y + 2.5, h = LANE.barHeight, tip = Math.min(7, w / 3);
    const d = shape === "left" ? `M${x} ${top + h / 2}l${tip} ${-h / 2}H${x + w}v${h}H${x + tip}Z`
      : shape === "right" ? `M${x} ${top}H${x + w - tip}l${tip} ${h / 2}l${-tip} ${h / 2}H${x}Z`
        : `M${x} ${top}h${w}v${h}h${-w}Z`;
    const failed = bar.outcome === "failed" || bar.refused;
    const decided = bar.outcome === "true" || failed;
    const signRoom = decided && w > 22 ? 10 : 0;
    const left = x + (shape === "left" ? tip + 1 : 4);
    const words = fitted(bar.text, x + w - left - signRoom - (shape === "right" ? tip - 3 : 2), 11);
    const state = { true: ", came true", failed: ", failed", open: "" }[bar.outcome] || (bar.refused ? ", refused" : "");
    const title = (bar.full || bar.text) + ", " + secondsText(bar.from) + " to " + secondsText(bar.to) + state;
    return selectable(bar.subject, title, (failed ? "failed " : "") + (bar.by || ""), bar.from,
      svg("path", { class: "bar", d }), svg("text", { x: left, y: top + 13, text: words }),
      signRoom ? signAt(failed ? "cross" : "check", x + w - (shape === "right" ? tip + 1 : 8), top + h / 2, 10, "mark") : "");
  }

  function laneMark(entry, next, y, sign) {
    const x = X(entry.at), end = next ? X(next.at) - 8 : X(clock.end) + LANE.right;
    const middle = y + LANE.marks / 2;
    const words = firstFitting([entry.text, entry.short], end - x - 9, 11);
    return selectable(entry.subject, entry.text + ", " + secondsText(entry.at), "", entry.at,
      svg("rect", { class: "focus", x: x - 8, y: middle - 9, width: 16 + (words ? widthOf(words, 11) + 4 : 0), height: 18, rx: 4 }),
      signAt(sign, x, middle, sign === "analogy" ? 13 : 12, "sign"),
      words ? svg("text", { class: "note", x: x + 9, y: middle + 4, text: words }) : "");
  }

  function curve(piece, y, selected) {
    const steps = subjects[piece.subject].confidence;
    const low = y + LANE.curve - 4.5, high = y + 4.5;
    const Y = (sure) => low + (high - low) * clamp((sure - 0.5) / 0.5, 0, 1);
    let d = "";
    const dots = [];
    steps.forEach((step, i) => {
      d += i ? `H${X(step.at)}V${Y(step.sure)}` : `M${X(step.at)} ${Y(step.sure)}`;
      dots.push(svg("circle", { class: "dot", cx: X(step.at), cy: Y(step.sure), r: 2.2 }));
    });
    const last = steps[steps.length - 1];
    if (!last.deleted) d += `H${X(clock.end)}`;
    const first = X(steps[0].at);
    return selectable(piece.subject, "How sure: " + piece.text, "curve-item " + (selected ? "selected" : ""), null,
      svg("rect", { class: "focus", x: first - 36, y, width: Math.max(60, X(clock.end) - first + 70), height: LANE.curve, rx: 4 }),
      svg("path", { class: "curve", d }), ...dots,
      first > 44 ? svg("text", { x: first - 7, y: Y(steps[0].sure) + 4, "text-anchor": "end", text: sureText(steps[0].sure) }) : "",
      last.deleted ? svg("text", { x: X(last.at) + 7, y: Y(last.sure) + 4, text: "deleted" })
        : svg("text", { x: X(clock.end) + 9, y: Y(last.sure) + 4, text: sureText(last.sure) }));
  }

  function selectable(subject, title, more, at, ...children) {
    const group = svg("g", { class: ("item " + more).trim(), tabindex: at === null ? "-1" : "0", role: "button", "aria-label": title },
      svg("title", { text: title }), ...children);
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
    if (event.clientX > field.getBoundingClientRect().left) press(event);
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
    if (field.clientWidth <= seen) return;
    if (x < scroll.scrollLeft + 24 || x > scroll.scrollLeft + seen - 24) scroll.scrollLeft = x - seen / 3;
  }

  draw();
  let width = box.clientWidth;
  new ResizeObserver(() => {
    if (box.clientWidth === width) return;
    width = box.clientWidth;
    draw();
    showSelected();
    pane.showTime(app.t);
  }).observe(box);
  const pane = {
    showTime(t) {
      const x = X(t);
      cursor.setAttribute("transform", `translate(${x} 0)`);
      cursor.setAttribute("aria-valuenow", t / 1e6);
      cursor.setAttribute("aria-valuetext", clockText(t));
      cursorText.textContent = clockText(t);
      const wide = widthOf(cursorText.textContent, 11.5) + 14;
      cursorBox.setAttribute("x", -wide / 2);
      cursorBox.setAttribute("width", wide);
      // At the edges the tag stays inside.
      const limit = Number(field.getAttribute("width"));
      const shift = clamp(0, wide / 2 - x, Math.max(wide / 2 - x, limit - x - wide / 2));
      cursorBox.setAttribute("transform", `translate(${shift} 0)`);
      cursorText.setAttribute("transform", `translate(${shift} 0)`);
      past.setAttribute("width", Math.max(0, x));
      if (!dragging) keepInView(x);
    },
    showSelection() { draw(); showSelected(); },
  };
  return app.add(pane);
}
