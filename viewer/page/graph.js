// ---- graph.js: the model graph at the cursor. Places come from the writer and depend on the final knowledge only;
// a band opens by moving the bands below it.

function graphPane(app) {
  const { graph, pieces, subjects } = app.report;
  const box = $("graph");
  let open = -1;
  let parts = [];  // what changes with time: functions of t

  const bandOf = (id) => graph.bands.findIndex((band) => band.cards.some((card) => card.subject === id || card.id === id));
  const learned = pieces.filter((piece) => piece.learned);

  function draw() {
    parts = [];
    let y = 2;
    const picture = svg("svg", { class: "graph" });
    const columns = svg("svg", { class: "graph heads", viewBox: `0 0 ${graph.width + 2} 20` });
    const heads = ["when this holds (CST)", "how sure (M_req)", "doing this brings that (CM)"];
    heads.forEach((text, i) => {
      const ring = i === 1;
      columns.append(svg("text", { class: "column", y: 14, text,
        x: ring ? graph.ring_column[0] + graph.ring_column[1] / 2 - 10 : graph.columns[i],
        "text-anchor": ring ? "middle" : "start" }));
    });
    graph.bands.forEach((band, index) => {
      const isOpen = index === open;
      const form = isOpen ? band.open : band.folded;
      picture.append(drawBand(band, form, isOpen, y));
      y += form.height + graph.band_gap;
    });
    picture.setAttribute("viewBox", `0 0 ${graph.width + 2} ${y}`);
    picture.setAttribute("role", "group");
    picture.setAttribute("aria-label", "Model graph");
    box.replaceChildren(graph.bands.length ? columns : "", graph.bands.length ? picture : el("p", { class: "empty", text: "Nothing was known in this run." }));
    showSelected();
  }

  function drawBand(band, form, isOpen, top) {
    const group = svg("g", { class: isOpen ? "open" : "", transform: `translate(0 ${top})` });
    if (band.title) group.append(svg("text", { class: "note", x: graph.columns[0], y: 12, text: band.title }));
    band.edges.forEach((edge, i) => group.append(drawEdge(band, edge, form, i, isOpen)));
    band.cards.forEach((card, i) => group.append(drawCard(card, form.cards[i], isOpen)));
    if (band.hidden > 0) {
      group.append(svg("text", { class: "note", x: graph.columns[0], y: form.height - graph.hidden_height / 2 + 4,
        text: `+ ${band.hidden} more, found by search` }));
    }
    return group;
  }

  // A card that can be selected; `live(t)` brings it up to date.
  function item(card, rect, body, live) {
    const [x, y, w, h] = rect;
    const ring = card.kind === "requirement";
    const note = "learned at " + secondsText(card.born);
    const placeholder = svg("g", { class: "placeholder" },
      ring ? "" : svg("rect", { class: "slot", x: x + 0.5, y: y + 0.5, width: w - 1, height: h - 1, rx: 6 }),
      ring ? "" : svg("text", { class: "note", x: x + 12, y: y + h / 2 + 4, text: note }));
    const group = svg("g", { class: "item", tabindex: ring ? "-1" : "0", role: "button",
      "aria-label": [card.id, card.title].filter(Boolean).join(", ") },
      svg("g", { class: "body" }, body), placeholder);
    group.dataset.subject = card.subject;
    group.dataset.id = card.id;
    const choose = () => { if (card.subject) app.select(card.subject); };
    group.addEventListener("click", choose);
    group.addEventListener("keydown", (event) => {
      if (event.key === "Enter") { event.preventDefault(); choose(); refocus(card); }
    });
    parts.push((t) => {
      group.classList.toggle("later", t < card.born);
      group.classList.toggle("gone", card.gone !== undefined && t >= card.gone);
      if (live) live(t);
    });
    return group;
  }
  // Selecting may redraw the graph; the keyboard stays where it was.
  function refocus(card) {
    const same = [...box.querySelectorAll(".item")].find((node) => node.dataset.id === card.id && node.tabIndex === 0);
    if (same) same.focus();
  }

  function drawCard(card, rect, isOpen) {
    if (card.kind === "requirement") return requirementRing(card, rect, isOpen);
    if (card.kind === "model") return modelCard(card, rect, isOpen);
    if (card.kind === "unknown") return unknownCard(card, rect);
    return isOpen && card.kind !== "again" ? openState(card, rect) : foldedState(card, rect);
  }

  function unknownCard(card, [x, y, w, h]) {
    return svg("g", {}, svg("rect", { class: "slot", x: x + 0.5, y: y + 0.5, width: w - 1, height: h - 1, rx: 6 }),
      svg("text", { class: "note", x: x + 12, y: y + h / 2 + 4, text: card.id + " is not in this run" }));
  }

  const frame = (rect, name) => svg("rect", { class: name, x: rect[0] + 0.5, y: rect[1] + 0.5, width: rect[2] - 1,
    height: rect[3] - 1, rx: 6 });

  // One line of words, the dropped ones struck.
  function foldedState(card, rect) {
    const [x, y, w, h] = rect;
    const middle = y + h / 2 + 4;
    const star = card.mark === "analogy";
    const start = x + 12 + (star ? 16 : 0);
    const idWidth = card.id ? widthOf(card.id, 11.5) + 16 : 0;
    const text = svg("text", { x: start, y: middle });
    let room = w - (start - x) - idWidth - 8;
    const brief = card.brief.length ? card.brief : card.lines;
    brief.forEach((line, i) => {
      const lead = i ? " \u00b7 " : "";
      const words = fitted(line.text, room - widthOf(lead, 12), 12);
      if (!words) return;
      room -= widthOf(lead + words, 12);
      if (lead) text.append(lead);
      text.append(svg("tspan", { class: line.cut ? "cut" : null }, ...withVariables(words, line.vars, "tspan")));
    });
    text.append(svg("title", { text: card.lines.map((line) => line.text + (line.cut ? " (pruned)" : "")).join("\n") }));
    return item(card, rect, [frame(rect, "card"),
      star ? signAt("analogy", x + 18, y + h / 2, 12, "star") : "",
      text, svg("text", { class: "gid", x: x + w - 12, y: middle, "text-anchor": "end", text: card.id })]);
  }

  function openState(card, rect) {
    const [x, y, w] = rect;
    const note = svg("text", { class: "note", x: x + w - 12, y: y + 18, "text-anchor": "end" });
    const body = [frame(rect, "card"), svg("text", { class: "gid", x: x + 12, y: y + 18, text: card.id }), note,
      svg("line", { class: "rule", x1: x + 12, x2: x + w - 12, y1: y + graph.head_height - 1.5, y2: y + graph.head_height - 1.5 })];
    const room = Math.max(1, card.room || card.lines.length);
    const shown = card.lines.length > room ? card.lines.slice(0, room - 1) : card.lines;
    const columns = cellColumns(shown, w - 24);
    shown.forEach((line, i) => {
      const base = y + graph.head_height + i * graph.line_height + 20;
      // Without a relation ("H hand") the value takes its place.
      const cells = !columns ? [line.text] : line.cells[1] ? line.cells : [line.cells[0], line.cells[2]];
      cells.forEach((cell, c) => {
        const at = columns ? columns[c] : 0;
        const last = c === cells.length - 1;
        const width = (last ? w - 24 : columns[c + 1] - 6) - at - (line.cut && last ? 44 : 0);
        body.push(svg("text", { class: line.cut ? "cutline" : null, x: x + 12 + at, y: base },
          svg("title", { text: line.text }), svg("tspan", { class: line.cut ? "cut" : null }, ...withVariables(fitted(cell, width, 12), line.vars, "tspan"))));
      });
      if (line.cut) body.push(svg("text", { class: "note", x: x + w - 12, y: base, "text-anchor": "end", text: "pruned" }));
    });
    if (shown.length < card.lines.length) {
      body.push(svg("text", { class: "note", x: x + 12, y: y + graph.head_height + shown.length * graph.line_height + 20,
        text: `+ ${card.lines.length - shown.length} more` }));
    }
    const made = { given: "given", made: "made at " }[card.origin] || card.origin + " at ";
    return item(card, rect, body, (t) => {
      const subject = subjects[card.subject];
      const bindings = subject && app.selected === card.subject ? app.bindings(subject, t) : null;
      const shownBinding = bindings && bindings.length ? bindings.filter(([, value]) => /^[\p{L}_]/u.test(value)) : [];
      const text = shownBinding.length ? shownBinding.map(([name, value]) => name + " = " + value).join(", ")
        : card.origin === "given" ? "given" : made + secondsText(card.born);
      note.textContent = fitted(text, w - 40 - widthOf(card.id, 12), 11.5);
      note.classList.toggle("bound", shownBinding.length > 0);
    });
  }
  // Subject, relation and value stand in columns where they fit.
  function cellColumns(lines, width) {
    if (!lines.every((line) => line.cells)) return null;
    const widest = (c) => Math.max(0, ...lines.map((line) => widthOf(line.cells[c], 12)));
    const first = Math.min(widest(0) + 12, width / 3), second = first + widest(1) + 12;
    return second + Math.min(widest(2), 40) <= width ? [0, first, second] : null;
  }

  function requirementRing(card, rect, isOpen) {
    const [x, y, w, h] = rect;
    const cx = x + w / 2, cy = y + h / 2, r = w / 2 - 1.5;
    const arc = svg("circle", { class: "ring-arc", cx, cy, r, pathLength: 100, transform: `rotate(-90 ${cx} ${cy})` });
    const sure = svg("text", { class: "sure", x: cx, y: cy + (isOpen ? 4.5 : 3.5) });
    const body = [svg("circle", { class: "ring-bed", cx, cy, r }), arc, sure];
    if (isOpen) body.push(svg("text", { class: "gid", x: cx, y: y + h + 14, "text-anchor": "middle", text: card.id }));
    return item(card, rect, body, (t) => {
      const step = lastAt(subjects[card.subject].confidence, t, (s) => s.at);
      const value = step ? step.sure : 0;
      arc.setAttribute("stroke-dasharray", `${value * 100} 100`);
      sure.textContent = value >= 0.995 ? "1.0" : value.toFixed(2).slice(1);
    });
  }

  function modelCard(card, rect, isOpen) {
    const [x, y, w, h] = rect;
    const head = isOpen ? graph.head_height : 0;
    const half = (h - head) / 2;
    const clip = (top, name, round) => svg("path", { class: name,
      d: round === "bottom" ? `M${x + 0.5} ${top}H${x + w - 0.5}V${top + half - 6}q0 6 -6 6H${x + 6.5}q-6 0 -6 -6Z`
        : round === "top" ? `M${x + 0.5} ${top + half}V${top + 6}q0 -6 6 -6H${x + w - 6.5}q6 0 6 6V${top + half}Z`
          : `M${x + 0.5} ${top}H${x + w - 0.5}V${top + half}H${x + 0.5}Z` });
    const line = (text, top, room) => svg("text", { x: x + 12, y: top + half / 2 + 4 },
      svg("title", { text }), ...withVariables(fitted(text, room, 12.5), card.vars, "tspan"));
    const note = svg("text", { class: "note", x: x + w - 12, y: y + 18, "text-anchor": "end" });
    const room = (label) => w - 36 - widthOf(label, 12);
    const body = [isOpen ? frame(rect, "card") : "", clip(y + head, "lhs", isOpen ? "" : "top"), clip(y + head + half, "rhs", "bottom"),
      frame(rect, "frame")];
    if (isOpen) {
      body.push(svg("text", { class: "gid", x: x + 12, y: y + 18, text: card.id }), note,
        line(card.lhs, y + head, room("if done")), line(card.rhs, y + head + half, room("then")),
        svg("text", { class: "note", x: x + w - 12, y: y + head + half / 2 + 4, "text-anchor": "end", text: "if done" }),
        svg("text", { class: "note", x: x + w - 12, y: y + head + half * 1.5 + 4, "text-anchor": "end", text: "then" }));
    } else {
      body.push(line(card.lhs, y, room(card.id)), line(card.rhs, y + half, w - 24),
        svg("text", { class: "gid", x: x + w - 12, y: y + half / 2 + 4, "text-anchor": "end", text: card.id }));
    }
    return item(card, rect, body, (t) => {
      const past = card.outcomes.filter(([at]) => at <= t);
      const right = past.filter(([, good]) => good).length;
      note.textContent = past.length ? `came true ${right} of ${past.length}` : "not yet tried";
    });
  }

  function drawEdge(band, edge, form, index, isOpen) {
    const { cubic, points, mark: [mx, my] } = form.edges[index];
    if (!points.length) return svg("g", {});
    const from = band.cards[edge.from], to = band.cards[edge.to];
    const derived = edge.kind === "derived";
    const d = cubic ? `M${points[0].join(" ")}C${points.slice(1).map((p) => p.join(" ")).join(" ")}`
      : roundedPath(points);
    const line = svg("path", { class: "link" + (derived ? " derived" : ""), d });
    const [ex, ey] = points[points.length - 1];
    const group = svg("g", {}, line);
    let arrow = null, star = null, note = null;
    if (edge.kind !== "requires") {
      arrow = svg("path", { class: "arrow", d: `M${ex} ${ey}l-7 -3.5v7Z` });
      group.append(arrow);
    }
    if (derived) {
      // Surface under the star, so that the dashes do not run through it.
      group.append(svg("circle", { class: "gap", cx: mx, cy: my, r: 8 }));
      star = signAt("analogy", mx, my, isOpen ? 14 : 12, "star");
      if (isOpen || !to.brief) group.append(star);
      else group.lastChild.remove();
      const [nx, ny, nw, nh] = form.notes[index] || [0, 0, 0, 0];
      if (nw) {
        note = svg("text", { class: "note", x: nx, y: ny + nh / 2 + 4, text: fitted(edge.text, nw, 11.5) }, svg("title", { text: edge.text }));
        group.append(note);
      }
    }
    parts.push((t) => { group.style.display = t < Math.max(from.born, to.born) ? "none" : ""; });
    const subject = derived ? to.subject : edge.kind === "requires" ? to.subject : from.subject;
    group.dataset.subject = subject;
    group.showSelected = (selected) => {
      const on = selected === subject && isOpen;
      const name = derived ? "selected" : edge.kind === "requires" ? "to-state" : "to-model";
      for (const node of [line, arrow, star]) if (node) node.classList.toggle(name, on);
    };
    return group;
  }
  // Corners of a polyline, rounded by 6.
  function roundedPath(points) {
    let d = `M${points[0].join(" ")}`;
    for (let i = 1; i + 1 < points.length; ++i) {
      const [x, y] = points[i];
      const toward = ([px, py]) => {
        const length = Math.hypot(px - x, py - y) || 1;
        const r = Math.min(6, length / 2) / length;
        return `${x + (px - x) * r} ${y + (py - y) * r}`;
      };
      d += `L${toward(points[i - 1])}Q${x} ${y} ${toward(points[i + 1])}`;
    }
    return d + `L${points[points.length - 1].join(" ")}`;
  }

  function showSelected() {
    for (const node of box.querySelectorAll(".item")) {
      node.classList.toggle("selected", node.dataset.subject === app.selected || node.dataset.id === app.selected);
    }
    for (const node of box.querySelectorAll("g")) if (node.showSelected) node.showSelected(app.selected);
  }

  // The selected cards come into view, if the pane scrolls.
  function bringIntoView() {
    const cards = [...box.querySelectorAll(".item.selected")].map((node) => node.getBoundingClientRect()).filter((r) => r.height);
    if (!cards.length || box.scrollHeight <= box.clientHeight) return;
    const pane = box.getBoundingClientRect();
    const top = Math.min(...cards.map((r) => r.top)), bottom = Math.max(...cards.map((r) => r.bottom));
    if (bottom > pane.bottom - 12) box.scrollTop += bottom - pane.bottom + 24;
    else if (top < pane.top + 24) box.scrollTop -= pane.top - top + 32;
  }

  draw();
  return app.add({
    showSelection(subject) {
      let band = bandOf(subject.id);
      // Of a prediction or goal: the group of the model behind it.
      if (band < 0) for (const other of subject.requirements || []) if (band < 0) band = bandOf(other.subject);
      if (band >= 0 && band !== open) { open = band; draw(); }
      showSelected();
      bringIntoView();
    },
    showTime(t) {
      for (const part of parts) part(t);
      const count = learned.filter((piece) => piece.born <= t).length;
      $("graph-title").textContent = "What it knew at " + clockText(t);
      $("graph-count").textContent = `${count} of ${learned.length} pieces learned`;
    },
    markFound(ids) {
      for (const node of box.querySelectorAll(".item")) {
        node.classList.toggle("found", ids.has(node.dataset.subject) || ids.has(node.dataset.id));
      }
    },
  });
}
