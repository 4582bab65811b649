// ---- events.js: the list of all events in plain sentences, by kind, by words, by what they speak of.

function eventsPane(app) {
  const { log } = app;
  const box = $("events");
  let about = null;              // a subject
  let words = "";
  let imagined = true;
  let shown = new Uint32Array(0);
  let search = 0;                // of which search the result is awaited
  let current = 0;               // position in `shown` of the event at the cursor

  const count = el("span", { class: "quiet", "aria-live": "polite" });
  const find = el("input", { type: "search", placeholder: "Words in the sentence", "aria-label": "Words in the sentence", spellcheck: "false", autocomplete: "off" });
  const inHead = el("button", { type: "button", class: "chip", "aria-pressed": "true", text: "In the head, too", title: "Show what was only imagined while planning" });
  const aboutChip = el("button", { type: "button", class: "chip", "aria-pressed": "true", hidden: true });
  const kindsButton = el("summary", {}, "All kinds");
  const counts = new Array(log.kinds.length).fill(0);
  for (let i = 0; i < log.count; ++i) ++counts[log.kindOf[i]];
  // The states of the world are for the film; there are many, and they say nothing.
  const usuallyOff = log.kindNumber("WorldStateRecorded");
  const off = new Set([usuallyOff]);
  const boxes = log.kinds.map((kind, number) => {
    const input = el("input", { type: "checkbox", checked: !off.has(number) });
    input.addEventListener("change", () => { if (input.checked) off.delete(number); else off.add(number); keepKinds(); refresh(); });
    const alone = el("button", { type: "button", class: "link", text: "only", "aria-label": "Only " + kind.title.toLowerCase(),
      on: { click: () => { only((one) => one === number); kinds.open = false; } } });
    return { number, input, row: counts[number] ? el("div", { class: "kind-row" },
      el("label", { title: kind.meaning }, input, " " + kind.title, el("span", { class: "quiet", text: " " + counts[number] })), alone) : "" };
  });
  const only = (some) => {
    for (const { number } of boxes) if (some(number)) off.delete(number); else off.add(number);
    showKinds();
    keepKinds();
    refresh();
  };
  const showKinds = () => { for (const { number, input } of boxes) input.checked = !off.has(number); };
  // In the address the kinds that are shown, or with a minus those that are not, by their names; whichever are fewer.
  function keepKinds() {
    const name = (number) => log.kinds[number].name;
    const on = log.kinds.map((_, number) => number).filter((number) => !off.has(number));
    const usual = off.size === 1 && off.has(usuallyOff);
    app.keep("kinds", usual ? "" : !off.size ? "all" : !on.length ? "none" : off.size < on.length ? "-" + [...off].sort((a, b) => a - b).map(name).join(".") : on.map(name).join("."));
  }
  function restoreKinds(text) {
    const named = new Set(text.replace(/^-/, "").split("."));
    off.clear();
    log.kinds.forEach(({ name }, number) => {
      const hidden = !text ? number === usuallyOff : text === "none" || (text !== "all" && named.has(name) === text.startsWith("-"));
      if (hidden) off.add(number);
    });
    showKinds();
  }
  const kinds = el("details", { class: "kinds" }, kindsButton, el("div", { class: "kind-list" },
    el("p", {}, el("button", { type: "button", class: "link", text: "all", on: { click: () => only(() => true) } }), " ",
      el("button", { type: "button", class: "link", text: "none", on: { click: () => only(() => false) } })), ...boxes.map((one) => one.row)));
  const step = (by, text) => el("button", { type: "button", class: "link", text, on: { click: () => goOn(by) } });
  const head = el("div", { class: "events-head" }, find, kinds, inHead, aboutChip, step(-1, "previous"), step(1, "next"), count);
  const scroll = el("div", { class: "events-list", tabindex: "0", role: "region", "aria-label": "Events" });
  box.append(head, scroll);
  document.addEventListener("pointerdown", (event) => { if (!event.target.closest(".kinds")) kinds.open = false; });

  const list = new LongList(scroll, 24, (i) => {
    const event = shown[i];
    const failed = log.failed(event);
    const row = el("button", { type: "button", class: "event-row" + (failed ? " fail" : "") + (log.imagined(event) ? " imagined" : "") + (i === current ? " on" : ""),
      on: { click: () => { app.go(log.time(event)); app.select("#" + event); } } },
    el("time", { text: secondsText(log.time(event)) }), mark(failed ? "cross" : log.mark(event), failed ? "fail" : ""), eventSentence(app, event),
    el("span", { class: "quiet kind-name", text: log.kind(event).title }), el("span", { class: "id", text: "#" + event }));
    row.dataset.event = event;
    if (app.selected === "#" + event) row.setAttribute("aria-current", "true");
    return row;
  });

  inHead.addEventListener("click", () => { imagined = !imagined; inHead.setAttribute("aria-pressed", String(imagined)); app.keep("head", imagined ? "" : "no"); refresh(); });
  aboutChip.addEventListener("click", () => { about = null; app.keep("about", ""); refresh(); });
  const typing = new Later();
  find.addEventListener("input", () => typing.ask(120, () => { words = find.value.trim().toLowerCase(); app.keep("words", words); refresh(); }));
  find.addEventListener("keydown", (event) => { if (event.key === "Enter") { event.preventDefault(); goOn(event.shiftKey ? -1 : 1); } });

  // The events that the filters leave. Words are looked for chunk by chunk, so that the page stays alive, and what is
  // found shows as it comes.
  const refresh = () => busyWith(listFitting());
  async function listFitting() {
    const mine = ++search;
    const anchor = shown[Math.floor(list.first)] || eventAtCursor();
    aboutChip.hidden = !about;
    if (about) aboutChip.textContent = "About " + about.id + " \u2715";
    const hidden = log.kinds.length - boxes.filter((one) => !off.has(one.number)).length;
    kindsButton.textContent = hidden ? `${boxes.filter((one) => !off.has(one.number) && counts[one.number]).length} kinds` : "All kinds";
    const pool = about ? log.eventsOf(about.number) : null;
    const n = pool ? pool.length : log.count;
    const out = new Uint32Array(n);
    let used = 0;
    const fits = (event) => !off.has(log.kindOf[event - 1]) && (imagined || !log.imagined(event));
    const publish = (done) => {
      shown = out.subarray(0, used);
      list.set(used);
      count.textContent = `${used} of ${log.count}` + (done ? "" : " so far");
      if (done) {
        current = positionOf(app.t);
        const selected = selectedNow();
        list.show(selected ? positionOfEvent(selected) : anchor && !words && !about ? positionOfEvent(anchor) : current);
      }
    };
    if (!words) {
      for (let i = 0; i < n; ++i) { const event = pool ? pool[i] : i + 1; if (fits(event)) out[used++] = event; }
      publish(true);
      return;
    }
    let i = 0;
    let since = performance.now();
    while (i < n) {
      const chunk = log.chunkOf(pool ? pool[i] : i + 1);
      const lines = await log.sentences(chunk);
      if (mine !== search) return;
      for (; i < n; ++i) {
        const event = pool ? pool[i] : i + 1;
        if (log.chunkOf(event) !== chunk) break;
        if (fits(event) && (lines[(event - 1) % log.chunk].toLowerCase().includes(words) || words === "#" + event)) out[used++] = event;
      }
      if (performance.now() - since > 200) { publish(false); since = performance.now(); await new Promise((resume) => { setTimeout(resume, 0); }); }
      if (mine !== search) return;
    }
    publish(true);
  }

  // Position of the last shown event that is not after t, and of an event or the next one after it.
  function positionOf(t) {
    let low = 0, high = shown.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (log.time(shown[middle]) <= t) low = middle + 1; else high = middle;
    }
    return Math.max(0, low - 1);
  }
  function positionOfEvent(event) {
    let low = 0, high = shown.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (shown[middle] < event) low = middle + 1; else high = middle;
    }
    return low;
  }
  const eventAtCursor = () => log.ofFrame(app.frame)[0];
  // The selected event, if the cursor stands at its time; else 0.
  function selectedNow() {
    const selected = /^#(\d+)$/.exec(app.selected);
    return selected && log.time(Number(selected[1])) === app.t ? Number(selected[1]) : 0;
  }
  function goOn(by) {
    if (!shown.length) return;
    const selected = /^#(\d+)$/.exec(app.selected);
    const here = selected ? positionOfEvent(Number(selected[1])) : current - (by > 0 ? 1 : 0);
    const to = clamp(here + by, 0, shown.length - 1);
    app.go(log.time(shown[to]));
    app.select("#" + shown[to]);
  }
  app.about = (subject) => { about = subject; app.keep("about", subject.id); refresh(); };

  const filters = () => JSON.stringify([about && about.id, words, imagined, [...off].sort()]);
  let fresh = false;
  const pane = {
    find(text) { find.value = text; words = text.toLowerCase(); app.keep("words", words); app.setView("events"); refresh(); },
    restore(state) {
      const before = filters();
      const subject = app.subject(state.get("about") || "");
      about = subject && subject.number >= 0 ? subject : null;
      words = (state.get("words") || "").toLowerCase();
      find.value = words;
      imagined = state.get("head") !== "no";
      inHead.setAttribute("aria-pressed", String(imagined));
      restoreKinds(state.get("kinds") || "");
      // What the address names and this run does not know is not kept.
      for (const [name, value] of [["about", about ? about.id : ""], ["words", words], ["head", imagined ? "" : "no"]]) app.more.set(name, value);
      keepKinds();
      if (filters() === before) return;
      fresh = false;
      if (app.view === "events") pane.showView("events");
    },
    showView(view) {
      if (view !== "events") return;
      if (!fresh) { fresh = true; refresh(); } else list.draw();
      list.show(current);
    },
    showTime(t) {
      if (app.view !== "events") return;
      current = positionOf(t);
      const selected = selectedNow();
      const here = selected ? positionOfEvent(selected) : current;
      if (list.inSight(here)) list.draw(); else list.show(here);
    },
    showSelection() { if (app.view === "events") list.draw(); },
  };
  return app.add(pane);
}
