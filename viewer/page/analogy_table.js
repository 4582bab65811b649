// ---- analogy_table.js: a known condition beside the situation it was compared with, component by component.

function comparisonLine(one) {
  return one.source + (one.object ? " for " + one.object : "") + ` at ${secondsText(one.at)}: ${one.matched + one.achievable}/${one.total}, ` + one.verdict;
}

function comparisonTable(app, one) {
  const words = { matched: ["check", "kept"], achievable: ["goal", "can be brought about"], missed: ["cross", one.accepted ? "pruned" : "missing"] };
  const found = (row) => (row.facts.length
    ? el("button", { type: "button", class: "link plain", title: "Where it was seen", text: row.found, on: { click: () => app.select(row.facts[0]) } }) : row.found);
  return el("table", { class: "comparison" }, el("thead", {}, el("tr", {}, el("th", { text: "condition" }), el("th", { text: one.object ? "found for " + one.object : "found" }), el("th", {}, el("span", { class: "unseen", text: "what came of it" })))),
    el("tbody", {}, ...one.rows.map((row) => el("tr", { class: row.status === "missed" ? "missed" : "" },
      el("td", {}, ...conditionLine({ ...row.condition, cut: row.condition.cut && one.accepted })), el("td", {}, found(row)),
      el("td", {}, mark(words[row.status][0]), words[row.status][1])))));
}

function comparisonVerdict(one) {
  const share = `${one.matched + one.achievable}/${one.total}`;
  const text = [...(one.bindings ? [`With ${one.bindings}; what this leaves open may differ. `] : []), el("b", { text: `\u03c8 = ${share} = ${one.psi}, ${one.verdict}` })];
  if (one.above && one.accepted) text.push(` (above ${one.above})`);
  text.push(".");
  if (one.accepted && one.source_sure) text.push(` Starts at ${one.psi} \u00d7 ${one.source_sure} (${one.requirement}) = ${one.confidence}.`);
  text.push(` Jaccard ${one.jaccard}.`);
  return el("p", { class: "verdict" }, ...text);
}
