// ---- graph.js: the model graph at the cursor. Places come from the writer and depend on the final knowledge only;
// a band opens by moving the bands below it.

function graphPane(app) {
  const { graph, pieces } = app.report;
  const { log } = app;
  const box = $("graph");
  const map = $("minimap");
  let chosen = null;          // the selected subject, with its details
  let opened = -1;            // the band that the selection opened
  const unfolded = new Set(); // bands that were unfolded by hand
  const folded = new Set();   // and folded by hand
  let zoom = 1;
  let tops = [];              // where each band begins; -1 for one that is hidden
  let total = 0;              // height of all
  let parts = [];             // what changes with time: functions of t
  let found = new Set();
  let picture = null, columns = null;
  const drawn = new Map();    // band -> its group

  const bandOfId = new Map();
  graph.bands.forEach((band, i) => band.cards.forEach((card) => {
    for (const id of [card.subject, card.id]) if (id && !bandOfId.has(id)) bandOfId.set(id, i);
  }));
  const learned = pieces.filter(([, own]) => own).map(([number]) => app.subjectByNumber(number));
  const isOpen = (i) => (unfolded.has(i) || i === opened) && !folded.has(i);
  const formOf = (i) => (isOpen(i) ? graph.bands[i].open : graph.bands[i].folded);

  // ---- what is shown: by origin, state, confidence, use, and how far from the selection
  const USUAL = { given: true, learned: true, analogy: true, vetoes: true, retired: true, later: true, sure: 0, tried: false, around: 0 };
  const show = { ...USUAL };
  const controls = new Map();   // name of a choice -> its control
  // In the address: what differs from what is usual: "given:0,sure:0.75".
  const keepShow = () => app.keep("show", Object.keys(USUAL).filter((name) => show[name] !== USUAL[name]).map((name) => name + ":" + Number(show[name])).join(","));
  function restoreShow(text) {
    Object.assign(show, USUAL);
    for (const part of text.split(",")) {
      const [name, value] = part.split(":");
      const control = controls.get(name);
      const number = Number.parseFloat(value);
      if (!control || !Number.isFinite(number)) continue;
      if (typeof USUAL[name] === "boolean") show[name] = number !== 0;
      else if ([...control.options].some((option) => Number(option.value) === number)) show[name] = number;
    }
    for (const [name, control] of controls) if (typeof USUAL[name] === "boolean") control.checked = show[name]; else control.value = String(show[name]);
    keepShow();
  }
  let near = null;            // ids within the chosen distance of the selection
  const numberOf = (card) => app.numbers.get(card.subject);
  function passes(card) {
    if (!card.subject) return true;
    const { mark: sign, strong, born, gone } = card;
    if (near && !near.has(card.subject)) return false;
    if (sign === "given" && !show.given) return false;
    if (sign === "analogy" && !show.analogy) return false;
    if (sign === "learned" && !show.learned) return false;
    if (!show.retired && gone !== undefined && gone <= app.t) return false;
    if (!show.later && born > app.t) return false;
    const number = numberOf(card);
    if (card.kind === "requirement" || card.kind === "state" || card.kind === "again" || card.kind === "condition") {
      if (strong && !show.vetoes) return false;
      if (number !== undefined && app.report.subjects.kind[number] === "requirement") {
        if (show.sure > 0 && (log.sureAt(number, app.t) ?? 0) < show.sure) return false;
        if (show.tried && log.sure.start[number + 1] - log.sure.start[number] < 2) return false;
      }
    }
    return true;
  }
  const filtered = () => near || !show.given || !show.learned || !show.analogy || !show.vetoes || !show.retired || !show.later || show.sure > 0 || show.tried;
  const shownCards = new Map();   // band -> which of its cards are shown; only while something is hidden
  function applyFilter() {
    shownCards.clear();
    near = show.around && app.selected ? neighbours(app.selected, show.around) : null;
    if (!filtered()) return 0;
    let hidden = 0;
    graph.bands.forEach((band, i) => {
      // A composite state goes with its requirement model; a causal model stays while one of its conditions does.
      const pass = band.cards.map((card) => (card.kind === "model" ? true : passes(card)));
      const veto = new Set(band.cards.filter((card, k) => card.kind === "requirement" && !pass[k]).map((card) => card.subject));
      const shown = band.cards.map((card, k) => pass[k] && !(card.kind !== "model" && veto.has(card.subject)));
      const conditions = band.cards.some((card) => card.kind !== "model");
      const any = conditions ? band.cards.some((card, k) => card.kind !== "model" && shown[k]) : band.cards.some((card) => passes(card));
      band.cards.forEach((card, k) => { if (card.kind === "model" && (!any || (near && !near.has(card.subject) && !conditions))) shown[k] = false; });
      hidden += band.cards.filter((card, k) => card.kind === "requirement" && !shown[k]).length;
      shownCards.set(i, shown);
    });
    return hidden;
  }
  // What can be reached from a card over so many links: the models that a condition allows, what was derived from what,
  // the same composite state elsewhere.
  function neighbours(id, depth) {
    const links = new Map();
    const link = (a, b) => { if (!a || !b || a === b) return; for (const [x, y] of [[a, b], [b, a]]) { if (!links.has(x)) links.set(x, new Set()); links.get(x).add(y); } };
    const states = new Map();
    for (const band of graph.bands) {
      for (const edge of band.edges) link(band.cards[edge.from].subject, band.cards[edge.to].subject);
      for (const card of band.cards) {
        if (!card.id || card.id === card.subject) continue;
        if (states.has(card.id)) link(states.get(card.id), card.subject); else states.set(card.id, card.subject);
      }
    }
    // A composite state stands in the graph with its requirement model.
    const reached = new Set([id, ...graph.bands.flatMap((band) => band.cards.filter((card) => card.id === id).map((card) => card.subject))]);
    let edge = [...reached];
    for (let i = 0; i < depth; ++i) {
      edge = edge.flatMap((one) => [...(links.get(one) || [])]).filter((one) => !reached.has(one) && reached.add(one));
    }
    return reached;
  }

  // ---- places: a band opens, closes or hides by moving the bands below it
  function draw() {
    const hidden = applyFilter();
    $("graph-hidden").textContent = hidden ? `${hidden} hidden` : "";
    let y = 2;
    tops = graph.bands.map((band, i) => {
      const shown = shownCards.get(i);
      if (shown && !shown.some((on) => on)) return -1;
      const top = y;
      y += formOf(i).height + graph.band_gap;
      return top;
    });
    total = y;
    columns = svg("svg", { class: "graph heads", viewBox: `0 0 ${graph.width + 2} 20` });
    const heads = ["when this holds (CST)", "how sure (M_req)", "doing this brings that (CM)"];
    heads.forEach((text, i) => {
      const ring = i === 1;
      columns.append(svg("text", { class: "column", y: 14, text,
        x: ring ? graph.ring_column[0] + graph.ring_column[1] / 2 - 10 : graph.columns[i],
        "text-anchor": ring ? "middle" : "start" }));
    });
    picture = svg("svg", { class: "graph", role: "group", "aria-label": "Model graph", viewBox: `0 0 ${graph.width + 2} ${total}` });
    drawn.clear();
    parts = [];
    box.replaceChildren(graph.bands.length ? columns : "", graph.bands.length ? picture : el("p", { class: "empty", text: "Nothing was known in this run." }));
    setZoom();
    drawSight();
  }
  function setZoom() {
    for (const one of [picture, columns]) {
      one.style.width = zoom === 1 ? "" : usualWidth() * zoom + "px";
      one.style.minWidth = one.style.maxWidth = zoom === 1 ? "" : "none";
    }
    sidewaysChanged();
  }
  const usualWidth = () => clamp(box.clientWidth - 28, 500, 720);
  // Pixels a unit of the drawing.
  const unit = () => (picture.getBoundingClientRect().width || usualWidth() * zoom) / (graph.width + 2);

  // The bands in sight, and a screen above and below.
  function drawSight() {
    if (!picture || !graph.bands.length) return;
    const u = unit();
    const from = (box.scrollTop - box.clientHeight) / u, to = (box.scrollTop + 2 * Math.max(box.clientHeight, 300)) / u;
    const want = new Set();
    tops.forEach((top, i) => { if (top >= 0 && top + formOf(i).height >= from && top <= to) want.add(i); });
    for (const [i, { group, own }] of drawn) {
      if (want.has(i)) continue;
      group.remove();
      drawn.delete(i);
      parts = parts.filter((part) => !own.has(part));
    }
    for (const i of [...want].sort((a, b) => a - b)) {
      if (drawn.has(i)) continue;
      const before = parts;
      parts = [];
      const group = drawBand(graph.bands[i], formOf(i), isOpen(i), tops[i], i);
      drawn.set(i, { group, own: new Set(parts) });
      for (const part of parts) part(app.t);
      parts = before.concat(parts);
      const next = [...drawn.keys()].filter((other) => other > i).sort((a, b) => a - b)[0];
      picture.insertBefore(group, next === undefined ? null : drawn.get(next).group);
    }
    showSelected();
    drawMap();
  }
  let waiting = 0;
  const later = (action) => { if (!waiting) waiting = requestAnimationFrame(() => { waiting = 0; action(); }); };
  box.addEventListener("scroll", () => later(drawSight));
  const sidewaysChanged = showSideways(box.parentElement, box);
  new ResizeObserver(() => { if (app.view === "knowledge" && picture) { setZoom(); later(drawSight); } }).observe(box);

  // Zoom keeps what is pointed at where it is.
  function zoomTo(value, clientX, clientY) {
    const rect = picture.getBoundingClientRect();
    const u = unit();
    const pointX = (clientX - rect.left) / u, pointY = (clientY - rect.top) / u;
    zoom = clamp(value, 0.15, 3);
    if (Math.abs(zoom - 1) < 0.02) zoom = 1;
    setZoom();
    const now = picture.getBoundingClientRect();
    box.scrollLeft += now.left + pointX * unit() - clientX;
    box.scrollTop += now.top + pointY * unit() - clientY;
    drawSight();
  }
  function zoomBy(by) {
    const pane = box.getBoundingClientRect();
    zoomTo(zoom * by, pane.left + pane.width / 2, pane.top + pane.height / 2);
  }
  box.addEventListener("wheel", (event) => {
    if (!event.ctrlKey) return;
    event.preventDefault();
    zoomTo(zoom * (event.deltaY < 0 ? 1.15 : 1 / 1.15), event.clientX, event.clientY);
  }, { passive: false });
  function fit() {
    zoom = 1;
    setZoom();
    zoom = clamp(Math.min(1, (box.clientHeight - 36) / (total * unit())), 0.15, 1);
    setZoom();
    box.scrollTo(0, 0);
    drawSight();
  }

  // ---- the map: all bands at a glance, and which part is in sight
  function drawMap() {
    const small = total * unit() <= box.clientHeight + 4;
    map.hidden = small;
    if (small) return;
    const ratio = devicePixelRatio || 1;
    const w = 40, h = Math.max(80, box.clientHeight - 8);
    if (map.width !== Math.round(w * ratio) || map.height !== Math.round(h * ratio)) { map.width = Math.round(w * ratio); map.height = Math.round(h * ratio); map.style.height = h + "px"; }
    const pen = map.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, w, h);
    const sy = h / total, sx = (w - 4) / (graph.width + 2);
    const ink = { now: themeColour("edge"), later: themeColour("line"), asked: themeColour("ask"), found: themeColour("ink") };
    tops.forEach((top, i) => {
      if (top < 0) return;
      const form = formOf(i);
      const shown = shownCards.get(i);
      graph.bands[i].cards.forEach((card, k) => {
        if (shown && !shown[k]) return;
        const [x, y, cw, ch] = form.cards[k];
        const mine = card.subject === app.selected || card.id === app.selected;
        pen.fillStyle = mine ? ink.asked : found.has(card.subject) || found.has(card.id) ? ink.found : app.t < card.born || (card.gone !== undefined && app.t >= card.gone) ? ink.later : ink.now;
        pen.fillRect(2 + x * sx, (top + y) * sy, Math.max(1, cw * sx), Math.max(mine ? 2.5 : 0.8, ch * sy - 0.5));
      });
    });
    const u = unit();
    pen.strokeStyle = ink.asked;
    pen.lineWidth = 1.5;
    pen.strokeRect(0.75, clamp(box.scrollTop / u * sy, 0, h) + 0.75, w - 1.5, Math.max(6, box.clientHeight / u * sy) - 1.5);
  }
  // A colour of the theme as the browser has worked it out.
  const probe = el("span", { class: "probe" });
  box.append(probe);
  function themeColour(name) {
    if (!probe.isConnected) document.body.append(probe);
    probe.dataset.colour = name;
    return getComputedStyle(probe).color;
  }
  function mapTo(event) {
    const rect = map.getBoundingClientRect();
    box.scrollTop = (event.clientY - rect.top) / rect.height * total * unit() - box.clientHeight / 2;
  }
  map.addEventListener("pointerdown", (event) => { map.setPointerCapture(event.pointerId); mapTo(event); });
  map.addEventListener("pointermove", (event) => { if (event.buttons) mapTo(event); });

  // ---- tools
  function tools() {
    const button = (text, title, action) => el("button", { type: "button", class: "tool", title, "aria-label": title, text, on: { click: action } });
    const check = (name, text) => {
      const input = el("input", { type: "checkbox", checked: show[name] });
      controls.set(name, input);
      input.addEventListener("change", () => { show[name] = input.checked; keepShow(); draw(); });
      return el("label", {}, input, " " + text);
    };
    const choice = (label, name, options) => {
      const select = el("select", { "aria-label": label }, ...options.map(([value, text]) => el("option", { value: String(value), text })));
      controls.set(name, select);
      select.addEventListener("change", () => { show[name] = Number(select.value); keepShow(); draw(); pane.showTime(app.t); });
      return el("label", {}, label + " ", select);
    };
    const menu = el("details", { class: "kinds" }, el("summary", {}, "Show"), el("div", { class: "kind-list" },
      check("given", "given"), check("learned", "learned"), check("analogy", "made by analogy"), check("vetoes", "vetoes"),
      check("retired", "retired by now"), check("later", "learned later"), check("tried", "only what was tried"),
      choice("sure at least", "sure", [[0, "any"], [0.5, "0.5"], [0.75, "0.75"], [0.9, "0.9"]]),
      choice("around the selection", "around", [[0, "all"], [1, "1 link"], [2, "2 links"], [3, "3 links"]]),
      el("p", {}, el("button", { type: "button", class: "link", text: "unfold all", on: { click: () => { folded.clear(); graph.bands.forEach((_, i) => unfolded.add(i)); draw(); } } }), " ",
        el("button", { type: "button", class: "link", text: "fold all", on: { click: () => { unfolded.clear(); opened = -1; draw(); } } }))));
    document.addEventListener("pointerdown", (event) => { if (!menu.contains(event.target)) menu.open = false; });
    $("graph-tools").append(el("span", { id: "graph-hidden", class: "hidden-count" }), menu,
      button("\u2212", "Smaller", () => zoomBy(1 / 1.25)), button("+", "Larger", () => zoomBy(1.25)), button("fit", "Fit all into the pane", fit));
  }

  function drawBand(band, form, isOpenNow, top, index) {
    const shown = shownCards.get(index);
    const on = (k) => !shown || shown[k];
    const group = svg("g", { class: isOpenNow ? "open" : "", transform: `translate(0 ${top})` });
    if (band.title) group.append(svg("text", { class: "note", x: graph.columns[0], y: 12, text: band.title }));
    if (band.cards.some((card) => card.kind === "state")) group.append(foldMark(form, isOpenNow, index));
    band.edges.forEach((edge, i) => { if (on(edge.from) && on(edge.to)) group.append(drawEdge(band, edge, form, i, isOpenNow)); });
    band.cards.forEach((card, i) => { if (on(i)) group.append(drawCard(card, form.cards[i], isOpenNow)); });
    if (band.hidden > 0) {
      group.append(svg("text", { class: "note", x: graph.columns[0], y: form.height - graph.hidden_height / 2 + 4,
        text: `+ ${band.hidden} more, found by search` }));
    }
    return group;
  }
  // Unfolds or folds a band by hand, in the margin on its right.
  function foldMark(form, isOpenNow, index) {
    const y = Math.min(...form.cards.map(([, top]) => top)) + 8, x = graph.columns[0] - 9;
    const toggle = () => {
      if (isOpenNow) { unfolded.delete(index); folded.add(index); } else { folded.delete(index); unfolded.add(index); }
      draw();
    };
    return svg("g", { class: "fold-mark", role: "button", tabindex: "0", "aria-label": isOpenNow ? "Fold" : "Unfold", "aria-expanded": String(isOpenNow),
      on: { click: toggle, keydown: (event) => { if (event.key === "Enter") { event.preventDefault(); toggle(); } } } },
    svg("rect", { class: "area", x: x - 8, y: y - 8, width: 16, height: 18, rx: 3 }),
    svg("path", { d: isOpenNow ? `M${x - 3} ${y - 1}l3 3l3 -3` : `M${x - 1} ${y - 3}l3 3l-3 3` }));
  }

  // A card that can be selected; `live(t)` brings it up to date.
  function item(card, rect, body, live, more) {
    const [x, y, w, h] = rect;
    const ring = card.kind === "requirement";
    const note = "learned at " + secondsText(card.born);
    const placeholder = svg("g", { class: "placeholder" },
      ring ? "" : svg("rect", { class: "slot", x: x + 0.5, y: y + 0.5, width: w - 1, height: h - 1, rx: 6 }),
      ring ? "" : svg("text", { class: "note", x: x + 12, y: y + h / 2 + 4, text: note }));
    const group = svg("g", { class: "item" + (more ? " " + more : ""), tabindex: "0", role: "button" },
      svg("title", { text: labelOf(card) }), svg("g", { class: "body" }, body), placeholder);
    group.dataset.subject = card.subject;
    group.dataset.id = card.id;
    // A card of a composite state is that, beside the ring of its requirement model.
    const choose = () => { const id = card.kind === "state" || card.kind === "again" ? card.id : card.subject; if (id) app.select(id); };
    group.addEventListener("click", choose);
    group.addEventListener("keydown", (event) => {
      if (event.key === "Enter") { event.preventDefault(); choose(); refocus(card); }
    });
    const number = numberOf(card);
    parts.push((t) => {
      group.classList.toggle("later", t < card.born);
      group.classList.toggle("phased", number !== undefined && log.phasedOutAt(number, t) && !(card.gone !== undefined && t >= card.gone));
      group.classList.toggle("gone", card.gone !== undefined && t >= card.gone);
      if (live) live(t);
    });
    return group;
  }
  function labelOf(card) {
    const number = numberOf(card);
    return [card.id, number === undefined ? "" : app.report.subjects.title[number], card.strong ? "veto" : ""].filter((word) => word).join(", ");
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

  // One line of words, the pruned ones struck.
  function foldedState(card, rect) {
    const [x, y, w, h] = rect;
    const middle = y + h / 2 + 4;
    const star = card.mark === "analogy";
    const start = x + 12 + (star ? 16 : 0);
    const idWidth = card.id ? widthOf(card.id, 11.5) + 16 : 0;
    const text = svg("text", { x: start, y: middle });
    let room = w - (start - x) - idWidth - 8;
    const brief = card.brief.length ? card.brief : card.lines;
    // Whole words, as many as there is room for; the others are counted.
    const rest = (count) => (count ? " \u00b7 +" + count : "");
    brief.every((line, i) => {
      const lead = i ? " \u00b7 " : "";
      const left = room - widthOf(lead, 12) - widthOf(rest(brief.length - i - 1), 12);
      const words = fitted(line.text, left, 12);
      if (i && words !== line.text) {
        text.append(rest(brief.length - i));
        return false;
      }
      room -= widthOf(lead + words, 12);
      if (lead) text.append(lead);
      text.append(svg("tspan", { class: line.cut ? "cut" : null }, ...withVariables(words, line.vars, "tspan")));
      return true;
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
      const bindings = chosen && chosen.id === card.subject ? app.bindings(chosen, t) : null;
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

  // How sure, as an arc and a number; a veto is barred.
  function requirementRing(card, rect, isOpen) {
    const [x, y, w, h] = rect;
    const cx = x + w / 2, cy = y + h / 2, r = w / 2 - 1.5;
    const arc = svg("circle", { class: "ring-arc", cx, cy, r, pathLength: 100, transform: `rotate(-90 ${cx} ${cy})` });
    const sure = svg("text", { class: "sure", x: cx, y: cy + (isOpen ? 4.5 : 3.5) });
    const body = [svg("circle", { class: "ring-bed", cx, cy, r }), arc, sure];
    const slant = r * 0.7;
    if (card.strong) body.push(svg("path", { class: "bar", d: `M${cx + slant} ${cy - slant}l5 -5M${cx - slant} ${cy + slant}l-5 5` }));
    body.push(isOpen ? svg("text", { class: "gid", x: cx, y: y + h + 14, "text-anchor": "middle", text: card.id })
      : svg("text", { class: "gid", x: x - 6, y: cy - 4, "text-anchor": "end", text: card.id }));
    // At the ring's own height, under the link to it: over or under a ring it could be a word of the next one.
    if (card.strong) body.push(svg("text", { class: "gid never", x: x - 6, y: cy + 13, "text-anchor": "end", text: "never" }));
    const number = numberOf(card);
    return item(card, rect, body, (t) => {
      const value = number === undefined ? 0 : log.sureAt(number, t) ?? 0;
      arc.setAttribute("stroke-dasharray", `${value * 100} 100`);
      sure.textContent = value >= 0.995 ? "1.0" : sureText(value).replace(/^0/, "");
    }, card.strong ? "veto" : "");
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
    const number = numberOf(card);
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
      let low = 0, high = card.outcomes.length;
      while (low < high) {
        const middle = (low + high) >> 1;
        if (card.outcomes[middle][0] <= t) low = middle + 1; else high = middle;
      }
      if (number !== undefined && log.phasedOutAt(number, t)) note.textContent = "phased out";
      else if (low) note.replaceChildren(`came true ${card.outcomes[low - 1][1]} of ${low}`, svg("title", { text: ", of what it predicted, silently too; its evidence also counts what it was learned from" }));
      else note.textContent = "not yet tried";
    });
  }

  function drawEdge(band, edge, form, index, isOpen) {
    const { cubic, points, mark: [mx, my] } = form.edges[index];
    if (!points.length) return svg("g", {});
    const from = band.cards[edge.from], to = band.cards[edge.to];
    const derived = edge.kind === "derived";
    const d = cubic ? `M${points[0].join(" ")}C${points.slice(1).map((p) => p.join(" ")).join(" ")}`
      : roundedPath(points);
    const veto = edge.kind === "enables" && from.strong;
    const line = svg("path", { class: "link" + (derived ? " derived" : "") + (veto ? " veto" : ""), d });
    const [ex, ey] = points[points.length - 1];
    const group = svg("g", {}, line);
    let arrow = null, star = null, note = null;
    if (edge.kind !== "requires") {
      // What allows ends in an arrow, what forbids in a bar.
      arrow = veto ? svg("path", { class: "stop", d: `M${ex - 2} ${ey - 6}v12` }) : svg("path", { class: "arrow", d: `M${ex} ${ey}l-7 -3.5v7Z` });
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
      node.classList.toggle("found", found.has(node.dataset.subject) || found.has(node.dataset.id));
    }
    for (const node of box.querySelectorAll("g")) if (node.showSelected) node.showSelected(app.selected);
  }

  // The selected cards come into view, if the pane scrolls.
  function bringIntoView(band) {
    // A band far away is not drawn yet.
    if (band !== undefined && band >= 0 && !drawn.has(band) && tops[band] >= 0) { box.scrollTop = tops[band] * unit() - 40; drawSight(); }
    const cards = [...box.querySelectorAll(".item.selected")].map((node) => node.getBoundingClientRect()).filter((r) => r.height);
    if (!cards.length || box.scrollHeight <= box.clientHeight) return;
    const pane = box.getBoundingClientRect();
    const top = Math.min(...cards.map((r) => r.top)), bottom = Math.max(...cards.map((r) => r.bottom));
    if (bottom > pane.bottom - 12) box.scrollTop += bottom - pane.bottom + 24;
    else if (top < pane.top + 24) box.scrollTop -= pane.top - top + 32;
  }

  tools();
  const pane = {
    restore(state) {
      const before = JSON.stringify(show);
      restoreShow(state.get("show") || "");
      if (app.view === "knowledge" && JSON.stringify(show) !== before) draw();
    },
    showSelection(subject) {
      chosen = subject;
      const related = [subject.id, ...(subject.detail.requirements || []), subject.detail.model || ""];
      // Of a prediction or goal: the group of the model behind it.
      const band = related.map((id) => bandOfId.get(id)).find((one) => one !== undefined);
      if (band !== undefined && band !== opened) { opened = band; folded.delete(band); draw(); } else if (show.around) draw();
      showSelected();
      for (const part of parts) part(app.t);
      if (app.view === "knowledge") bringIntoView(band);
    },
    showView(view) {
      if (view !== "knowledge") return;
      draw();
      pane.showTime(app.t);
      if (chosen) bringIntoView(opened);
    },
    showTime(t) {
      if (app.view !== "knowledge") return;
      if (!show.retired || !show.later || show.sure > 0) draw();
      for (const part of parts) part(t);
      later(drawMap);
      const count = learned.filter((piece) => piece.born <= t).length;
      $("graph-title").textContent = "What it knew at " + app.clock;
      const frame = app.frameWords;
      const until = app.frames[app.frame + 1] ?? Infinity;
      const gone = learned.filter((piece) => piece.gone !== null && piece.gone <= t).length;
      const soon = learned.filter((piece) => piece.born > t && piece.born < until).length;
      $("graph-part").textContent = frame ? frame.name + ", up to this moment" : "";
      $("graph-count").textContent = `${count} of ${learned.length} pieces learned` + (gone ? `, ${gone} given up` : "") + (soon ? `, ${soon} more in this frame` : "");
    },
    markFound(ids) {
      found = ids;
      showSelected();
      if (app.view === "knowledge") drawMap();
    },
  };
  return app.add(pane);
}
