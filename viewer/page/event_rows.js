// ---- event_rows.js: events as rows, and as trees of causes and effects that unfold.

// The sentence of an event; filled in when it is decoded.
function eventSentence(app, event) {
  const span = el("span", { class: "sentence" });
  const now = app.log.textNow(event);
  if (now !== undefined) span.append(...sentence(now));
  else app.log.text(event).then((text) => span.replaceChildren(...sentence(text)));
  return span;
}

// A row that selects what the event is about and goes to its moment.
function eventRow(app, event, { note = "", picture = true } = {}) {
  const failed = app.log.failed(event);
  const button = el("button", { type: "button", class: (failed ? "fail" : "") + (app.log.imagined(event) ? " imagined" : ""),
    on: { click: () => app.open(event) } });
  const words = el("span", { class: "what" }, mark(failed ? "cross" : app.log.mark(event), failed ? "fail" : ""),
    el("span", {}, eventSentence(app, event), note ? el("span", { class: "quiet", text: note }) : ""));
  const at = app.log.time(event);
  button.dataset.event = event;
  button.append(words, el("time", { text: secondsText(at) }));
  if (picture) app.log.text(event).then((text) => { const small = thumbnail(app, at, text); if (small) button.prepend(small); });
  return button;
}

// What an event led to that is worth a line; what lies between is looked through.
function effectsWorthALine(log, event) {
  const seen = new Set([event]);
  const open = [event];
  const out = [];
  while (open.length && seen.size < 5000) {
    for (const effect of log.effects(open.pop())) {
      if (seen.has(effect)) continue;
      seen.add(effect);
      if (log.worthALine(effect)) out.push(effect); else open.push(effect);
    }
  }
  return out.sort((a, b) => a - b);
}

// A tree below the events `roots`, each followed by next(event). The first levels are open, as far as a screen
// holds them; an event is unfolded at the place nearest to the root, and named elsewhere.
function eventTree(app, roots, next, { open = 12, picture = true } = {}) {
  const shown = new Set(roots);
  const nodeOf = (event, repeated) => {
    const children = repeated ? [] : next(event);
    const item = el("li", {});
    const line = el("div", { class: "line" });
    if (children.length) {
      const twist = el("button", { type: "button", class: "twist", "aria-expanded": "false", "aria-label": "Unfold",
        on: { click: () => { if (item.lastElementChild.tagName === "UL") fold(); else unfold(); } } },
      svg("svg", { class: "mark", "aria-hidden": "true" }, svg("use", { href: "#i-fold" })));
      const label = (text) => { twist.setAttribute("aria-expanded", String(text === "Fold")); twist.setAttribute("aria-label", text); };
      const fold = () => { item.lastElementChild.remove(); label("Unfold"); };
      const unfold = () => {
        const list = el("ul", {});
        for (const child of children) {
          const known = shown.has(child);
          shown.add(child);
          list.append(nodeOf(child, known));
        }
        item.append(list);
        label("Fold");
        return [...list.children];
      };
      item.unfold = unfold;
      line.append(twist);
    } else {
      line.append(el("span", { class: "twist" }));
    }
    line.append(eventRow(app, event, { note: repeated ? " (see above)" : "", picture }));
    item.append(line);
    return item;
  };
  const tree = el("ul", { class: "tree" });
  const waiting = roots.map((event) => nodeOf(event, false));
  tree.append(...waiting);
  for (let room = open; waiting.length && room > 0;) {
    const node = waiting.shift();
    if (!node.unfold) continue;
    const below = node.unfold();
    room -= below.length;
    waiting.push(...below);
  }
  return tree;
}
