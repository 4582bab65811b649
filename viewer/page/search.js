// ---- search.js: `/` finds ids, names, values and words: in what can be selected at once, in what is said as it is
// read through; F3 or Enter goes on to the next.

function searchPane(app, story, graph, events) {
  const input = $("query"), results = $("results");
  const { id: ids, title: titles } = app.report.subjects;
  const texts = ids.map((id, number) => (id + " " + titles[number]).toLowerCase());
  let found = [];
  let at = -1;

  function search() {
    const words = input.value.trim().toLowerCase();
    story.search(words);
    at = -1;
    found = [];
    if (words) texts.forEach((text, number) => { if (text.includes(words)) found.push(number); });
    // What begins with the words comes first.
    const rank = (number) => (ids[number].toLowerCase() === words ? 0 : ids[number].toLowerCase().startsWith(words) || titles[number].toLowerCase().startsWith(words) ? 1 : 2);
    const ranked = [[], [], []];
    for (const number of found) ranked[rank(number)].push(number);
    found = ranked.flat();
    graph.markFound(new Set(found.map((number) => ids[number])));
    results.hidden = !words;
    const rows = found.slice(0, 12).map((number, i) => {
      const subject = app.subjectByNumber(number);
      return el("li", {}, el("button", { type: "button", on: { click: () => choose(i) } },
        mark(subject.mark), el("span", { text: subject.title }), el("span", { class: "id", text: subject.id })));
    });
    const event = /^#(\d+)$/.exec(words);
    if (event && app.subject(words) && !found.length) rows.push(el("li", {}, el("button", { type: "button", on: { click: () => { results.hidden = true; app.select(words); app.go(app.log.time(Number(event[1]))); } } }, mark("seen"), el("span", { text: "event " + words }))));
    else if (!found.length) rows.push(el("li", { class: "none", text: "Nothing has this name." }));
    if (found.length > 12) rows.push(el("li", { class: "none", text: `and ${found.length - 12} more` }));
    if (words) {
      rows.push(el("li", { class: "every" }, el("button", { type: "button", on: { click: () => { results.hidden = true; events.find(words); } } },
        mark("seen"), el("span", {}, "Events that say \u201c", el("b", { text: input.value.trim() }), "\u201d"))));
    }
    results.replaceChildren(...rows);
  }
  function choose(i) {
    results.hidden = true;
    at = i;
    const subject = app.subjectByNumber(found[i]);
    app.select(subject.id);
    if (app.t < subject.born) app.go(subject.born);
  }
  function leave() {
    input.value = "";
    search();
    input.blur();
  }
  // On to the next find, or back; around at the ends.
  function next(by) {
    if (!found.length) return;
    choose(at < 0 ? (by > 0 ? 0 : found.length - 1) : (at + by + found.length) % found.length);
  }
  input.addEventListener("input", search);
  for (const again of ["focus", "click"]) input.addEventListener(again, () => { if (input.value) results.hidden = false; });
  input.addEventListener("keydown", (event) => {
    if (event.key === "Escape") { event.preventDefault(); leave(); }
    if (event.key === "Enter") { event.preventDefault(); next(event.shiftKey ? -1 : 1); }
    if (event.key === "ArrowDown") { const first = results.querySelector("button"); if (first) { event.preventDefault(); first.focus(); } }
  });
  results.addEventListener("keydown", (event) => {
    const all = [...results.querySelectorAll("button")];
    const here = all.indexOf(document.activeElement);
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      event.preventDefault();
      event.stopPropagation();
      const to = here + (event.key === "ArrowDown" ? 1 : -1);
      if (to < 0) input.focus(); else if (all[to]) all[to].focus();
    }
    if (event.key === "Escape") { event.stopPropagation(); leave(); }
  });
  document.addEventListener("pointerdown", (event) => { if (!event.target.closest(".search")) results.hidden = true; });
  return { focus() { input.focus(); input.select(); }, leave, next };
}
