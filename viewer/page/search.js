// ---- search.js: `/` finds ids, objects and words in what can be selected, and narrows the story.

function searchPane(app, story, graph) {
  const input = $("query"), results = $("results");
  const entries = Object.values(app.report.subjects).map((subject) => ({
    subject, text: (subject.id + " " + subject.title + " " + (subject.definition || []).map((part) => part.label).join(" ")).toLowerCase() }));
  let found = [];

  function search() {
    const words = input.value.trim().toLowerCase();
    story.search(words);
    found = words ? entries.filter((entry) => entry.text.includes(words)) : [];
    graph.markFound(new Set(found.map((entry) => entry.subject.id)));
    results.hidden = !words;
    const rows = found.slice(0, 12).map(({ subject }) => el("li", {}, el("button", { type: "button", on: { click: () => choose(subject) } },
      mark(subject.mark), el("span", { text: subject.title }), el("span", { class: "id", text: subject.id }))));
    if (!found.length) rows.push(el("li", { class: "none", text: "Nothing of this name; the story shows what holds the words." }));
    if (found.length > 12) rows.push(el("li", { class: "none", text: `and ${found.length - 12} more` }));
    results.replaceChildren(...rows);
  }
  function choose(subject) {
    results.hidden = true;
    app.select(subject.id);
    if (app.t < subject.born) app.go(subject.born);
  }
  function leave() {
    input.value = "";
    search();
    input.blur();
  }
  input.addEventListener("input", search);
  input.addEventListener("focus", () => { if (input.value) results.hidden = false; });
  input.addEventListener("keydown", (event) => {
    if (event.key === "Escape") { event.preventDefault(); leave(); }
    if (event.key === "Enter" && found.length) {
      event.preventDefault();
      const exact = found.find((entry) => entry.subject.id === input.value.trim());
      choose((exact || found[0]).subject);
    }
  });
  document.addEventListener("pointerdown", (event) => { if (!event.target.closest(".search")) results.hidden = true; });
  return { focus() { input.focus(); input.select(); }, leave };
}
