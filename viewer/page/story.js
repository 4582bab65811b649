// ---- story.js: what happened, a row an event, filtered by kind or by words.

const STORY_KINDS = [["all", "All", ""], ["goal", "Goals", "goal"], ["command", "Commands", "command"],
  ["prediction", "Predictions", "prediction"], ["learned", "Learned", "learned"], ["analogy", "Analogy", "analogy"]];

function storyPane(app) {
  const list = $("story");
  let kind = "all";
  let words = "";

  const rows = app.report.story.map((row) => {
    const item = el("li", { class: row.failed ? "fail" : "" },
      el("button", { type: "button", on: { click: () => choose(row) } },
        el("time", { text: secondsText(row.at) }),
        mark(row.failed ? "cross" : row.mark, row.failed ? "fail" : ""),
        el("span", {}, ...sentence(row.text))));
    return { ...row, item, search: row.text.toLowerCase() };
  });
  const none = el("li", { class: "none", text: "Nothing of this kind happened." });
  list.append(...rows.map((row) => row.item), none);

  function choose(row) {
    if (row.subject) app.select(row.subject);
    app.go(row.at);
  }
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

  function matches(row) {
    // What was learned by analogy was learned, too.
    const fits = kind === "all" || row.kind === kind || (kind === "learned" && row.kind === "analogy" && !row.rejected);
    return fits && (!words || row.search.includes(words));
  }
  const pane = {
    filter(id) {
      kind = id;
      for (const [name, chip] of chips) chip.setAttribute("aria-pressed", String(name === id));
      $("left").classList.remove("folded");
      $("fold").setAttribute("aria-expanded", "true");
      pane.refresh();
    },
    search(text) { words = text.toLowerCase(); pane.refresh(); },
    refresh() {
      let before = null, shown = 0;
      for (const row of rows) {
        row.item.hidden = !matches(row);
        if (row.item.hidden) continue;
        const when = secondsText(row.at);
        row.item.classList.toggle("again", when === before);
        before = when;
        ++shown;
      }
      none.hidden = shown > 0;
      pane.showTime(app.t);
    },
    showTime(t) {
      const start = app.frames[app.frame];
      const end = app.frames[app.frame + 1] ?? Infinity;
      let first = null;
      for (const row of rows) {
        const on = row.at >= start && row.at < end;
        row.item.classList.toggle("on", on);
        row.item.classList.toggle("later", row.at > t && !on);
        if (on && !row.item.hidden && !first) first = row.item;
      }
      if (first) list.scrollTop = first.offsetTop - 4;
    },
  };
  pane.filter("all");
  return app.add(pane);
}

// What is known of each thing now; fills the space under the film when the story is folded.
function objectsPane(app) {
  const body = el("tbody", {});
  const table = el("table", {}, el("thead", {}, el("tr", {}, el("th", { text: "thing" }), el("th", { text: "now" }))), body);
  $("left").append(el("div", { class: "objects" }, table));
  return app.add({
    showTime(t) {
      body.replaceChildren(...app.report.objects.map((object) => {
        const now = new Map();
        for (const change of object.changes) if (change.at <= t) now.set(change.attribute, change.value);
        const text = [...now].map(([attribute, value]) => attribute + " " + value).join(", ");
        return el("tr", {}, el("td", {}, el("button", { type: "button", class: "link", text: object.name, on: { click: () => app.select("thing:" + object.name) } }), " " + object.what), el("td", { text }));
      }));
    },
  });
}
