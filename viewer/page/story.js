// ---- story.js: what happened, a row an event, filtered by kind or by words.

const STORY_KINDS = [["all", "All", ""], ["goal", "Goals", "goal"], ["command", "Commands", "command"],
  ["prediction", "Predictions", "prediction"], ["learned", "Learned", "learned"], ["analogy", "Analogy", "analogy"]];

const STORY_WINDOW = 240;   // rows that are in the page at once

function storyPane(app) {
  const list = $("story");
  const { log } = app;
  let kind = "all";
  let words = "";
  let shown = [];      // events of the story that the filter leaves
  let first = 0;       // position in `shown` of the first row in the page
  let rows = [];
  let scrolling = false;

  const told = [];
  for (let event = 1; event <= log.count; ++event) if (log.chapter(event)) told.push(event);

  const chips = new Map();
  for (const [id, text, sign] of STORY_KINDS) {
    const chip = el("button", { type: "button", class: "chip", on: { click: () => pane.filter(id) } }, sign ? mark(sign) : "", text);
    chips.set(id, chip);
    $("chips").append(chip);
  }
  $("fold").addEventListener("click", () => {
    const folded = $("left").classList.toggle("folded");
    $("fold").setAttribute("aria-expanded", String(!folded));
  });

  function ofKind(event) {
    const chapter = log.chapter(event);
    // What was learned by analogy was learned, too.
    return kind === "all" || chapter === kind || (kind === "learned" && chapter === "analogy" && madeSomething(event));
  }
  const madeSomething = (event) => [...log.subjectsOf(event)].some((number) => app.report.subjects.event[number] > event && app.report.subjects.mark[number] === "analogy"
    && app.report.subjects.kind[number] === "requirement");

  function row(event) {
    const failed = log.failed(event);
    const at = log.time(event);
    const item = el("li", { class: failed ? "fail" : "" },
      el("button", { type: "button", on: { click: () => app.open(event) } },
        el("time", { text: secondsText(at) }), mark(failed ? "cross" : log.mark(event), failed ? "fail" : ""), eventSentence(app, event)));
    item.dataset.event = event;
    return { event, at, item };
  }
  // The rows around a position; the rest is said, and a click away.
  function drawAround(position) {
    first = clamp(position - STORY_WINDOW / 2, 0, Math.max(0, shown.length - STORY_WINDOW));
    const last = Math.min(shown.length, first + STORY_WINDOW);
    rows = shown.slice(first, last).map(row);
    const more = (count, text, to) => (count > 0 ? el("li", { class: "more" }, el("button", { type: "button", text: `${count} ${text}`, on: { click: () => { drawAround(to); showNow(); } } })) : "");
    let before = null;
    for (const one of rows) {
      const when = secondsText(one.at);
      one.item.classList.toggle("again", when === before);
      before = when;
    }
    list.replaceChildren(...[more(first, "earlier", first), ...rows.map((one) => one.item), more(shown.length - last, "later", last),
      shown.length ? "" : el("li", { class: "none", text: words ? "No sentence of the story has these words." : "Nothing of this kind happened." })].filter((node) => node));
  }
  function showNow() {
    const start = app.frames[app.frame];
    const end = app.frames[app.frame + 1] ?? Infinity;
    let current = null;
    for (const one of rows) {
      const on = one.at >= start && one.at < end;
      one.item.classList.toggle("on", on);
      one.item.classList.toggle("later", one.at > app.t && !on);
      if (on && !current) current = one.item;
    }
    return current;
  }

  const pane = {
    filter(id) {
      pane.choose(id);
      app.keep("story", id === "all" ? "" : id);
    },
    restore(state) {
      const wanted = STORY_KINDS.map(([id]) => id).find((id) => id === state.get("story")) || "all";
      app.more.set("story", wanted === "all" ? "" : wanted);
      if (wanted !== kind) pane.choose(wanted);
    },
    choose(id) {
      kind = id;
      for (const [name, chip] of chips) chip.setAttribute("aria-pressed", String(name === id));
      $("left").classList.remove("folded");
      $("fold").setAttribute("aria-expanded", "true");
      pane.refresh();
    },
    async search(text) {
      words = text.toLowerCase();
      // Words are looked for where sentences are decoded already; a long run is searched in the list of events.
      if (words && told.length < 20000) await log.loadTexts(told);
      pane.refresh();
    },
    refresh() {
      shown = told.filter((event) => ofKind(event) && (!words || (log.textNow(event) || "").toLowerCase().includes(words)));
      drawAround(positionAt(app.t));
      pane.showTime(app.t);
    },
    showTime(t) {
      const position = positionAt(app.frames[app.frame]);
      if (shown.length > STORY_WINDOW && (position < first || position >= first + rows.length)) drawAround(position);
      const current = showNow();
      // Where it stands is asked once a frame, after everything has changed: the answer makes the browser lay out the page.
      if (current && !scrolling) requestAnimationFrame(() => { scrolling = false; const row = list.querySelector("li.on"); if (row) list.scrollTop = row.offsetTop - 4; });
      scrolling = scrolling || Boolean(current);
    },
  };
  // The first row of the story at or after t.
  function positionAt(t) {
    let low = 0, high = shown.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (log.time(shown[middle]) < t) low = middle + 1; else high = middle;
    }
    return low;
  }
  pane.choose("all");
  return app.add(pane);
}

// What was seen of a thing last, up to a time: attribute -> change.
function knownOf(object, t) {
  const now = new Map();
  for (const change of object.changes) { if (change.at > t) break; now.set(change.attribute, change); }
  return now;
}

// What is known of each thing now; fills the space under the film when the story is folded.
function objectsPane(app) {
  const body = el("tbody", {});
  const table = el("table", {}, el("thead", {}, el("tr", {}, el("th", { text: "thing" }), el("th", { text: "now" }))), body);
  $("left").append(el("div", { class: "objects" }, table));
  return app.add({
    showTime(t) {
      body.replaceChildren(...app.report.objects.map((object) => {
        const text = [...knownOf(object, t)].map(([attribute, { value }]) => attribute + " " + value).join(", ");
        return el("tr", {}, el("td", {}, el("button", { type: "button", class: "link", text: object.name, on: { click: () => app.select("thing:" + object.name) } }), " " + object.what), el("td", { text }));
      }));
    },
  });
}
