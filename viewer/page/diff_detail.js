// ---- diff_detail.js: one piece of knowledge, side by side.

// How the chosen piece reads in each run, how sure each was, and where it came from.
// `open(key)` makes a button's action of choosing another piece, nothing where there is no such piece.
function showDetail(pane, item, data, open) {
  pane.replaceChildren();
  if (!item) {
    pane.append(el("h2", { text: "How does it read in each?" }),
      el("p", { class: "note", text: "Choose a piece: it is shown here as A and B have it, condition by condition." }));
    return;
  }
  const kind = kindOf(item);
  pane.append(
    el("p", { class: "kind-line " + kind }, mark(signOf(item)), el("b", { text: KIND_WORDS.get(kind) }), NODE_WORDS[item.kind],
      fateOf(item) ? el("span", { class: "fate", text: fateOf(item) }) : null),
    el("h2", { class: "name", text: titleOf(item) }),
    el("p", { class: "say" }, ...(item.say ? sentence(item.say.replace(/"([^"]*)"/g, "\u201c$1\u201d")) : ["Both have it, equal in what it says, in evidence and in origin."])),
    besideTable(item, open), ...guardsFold(item));
  if (item.kind !== "composite_state") {
    pane.append(factsTable(item));
    const curves = curvesPicture(item, data);
    if (curves) pane.append(el("h3", {}, "How sure was each over time? ", el("span", { text: "A round, B square" })), curves);
  }
}

// What stands above a column: how that side calls the piece, or what is nearest to it there.
function sideHead(name, side, near, open) {
  if (side) {
    return el("th", { scope: "col" }, letter(name), " ", el("b", { text: side.title }),
      el("span", { class: "ids" }, side.id + (side.state ? " on " + side.state : "") + (side.target ? ", of " + side.target : "")));
  }
  if (near) {
    const click = open(near.key);
    return el("th", { scope: "col" }, letter(name), " does not have it. Nearest: ",
      click ? el("button", { type: "button", class: "link", on: { click } }, el("b", { text: near.title })) : el("b", { text: near.title }),
      el("span", { class: "ids", text: near.id }));
  }
  return el("th", { scope: "col" }, letter(name), " has nothing like it");
}

function besideTable(item, open) {
  const rows = item.rows.filter((row) => row[0] !== "guard" || shownGuard(item, row));
  return el("table", { class: "beside" },
    el("caption", { class: "unseen", text: "The piece part by part, A beside B" }),
    el("thead", {}, el("tr", {}, sideHead("A", item.left, item.near, open), sideHead("B", item.right, item.near, open))),
    el("tbody", {}, ...rows.map((row) => besideRow(row, item))));
}
function besideRow([role, status, left, right, variables], item) {
  const cell = (text, side, own) => {
    if (!text) return el("td", { class: "without" }, el("span", { class: "unseen", text: "nothing" }));
    const words = withVariables(text, variables);
    const tone = status === "changed" ? "changed" : status === (side === "A" ? "left" : "right") && (item.near || own) ? side.toLowerCase() : "";
    const marked = tone && (item.near || (item.left && item.right));
    return el("td", { class: own ? null : "other-side" }, ...(marked ? [el("mark", { class: tone }, ...words)] : words),
      marked ? el("span", { class: "unseen", text: tone === "changed" ? " (another number)" : ` (only in ${side})` }) : null);
  };
  const part = { "condition": "lhs", "left side": "lhs", "right side": "rhs", "guard": "guards" }[role];
  return el("tr", { class: part }, cell(left, "A", Boolean(item.left)), cell(right, "B", Boolean(item.right)));
}
// Computations explain something where they differ.
const shownGuard = (item, row) => row[1] !== "same" && Boolean(item.near || (item.left && item.right));
function guardsFold(item) {
  const rows = item.rows.filter((row) => row[0] === "guard" && !shownGuard(item, row));
  if (!rows.length) return [];
  return [el("details", { class: "computes" }, el("summary", { text: plural(rows.length, "computation") + (item.left && item.right ? ", the same" : "") }),
    el("div", { class: "lines" }, ...rows.flatMap((row) => [el("span", {}), el("span", {}), el("code", {}, ...withVariables(row[2] || row[3], row[4]))])))];
}

function factsTable(item) {
  const { left, right } = item;
  const rows = [];
  const add = (name, text, always) => {
    const [a, b] = [left, right].map((side) => (side ? text(side) : null));
    if (!always && !(left && right && a !== b)) return;
    const differs = left && right && a !== b;
    const cell = (value, side) => el("td", {}, value === null ? "\u2013" : differs ? el("mark", { class: side }, value) : value);
    rows.push(el("tr", {}, el("th", { scope: "row", text: name }), cell(a, "a"), cell(b, "b")));
  };
  add("confidence", (side) => sureText(side.sure), true);
  add("evidence", (side) => `right ${countText(side.positive)} of ${countText(side.total)}`, true);
  add("came by", (side) => side.how, true);
  if (item.aspects.includes("derivation")) add("made from", (side) => side.from || "nothing");
  else if ((left && left.from) || (right && right.from)) add("made from", (side) => side.from || "nothing", true);
  add("strength", (side) => (side.strong ? "confirmed" : "open"));
  add("state", sideState, stateOf(item) !== "active");
  add("copies", (side) => String(side.copies));
  return el("table", { class: "facts" }, el("caption", { class: "unseen", text: "Evidence and origin" }),
    el("thead", {}, el("tr", {}, el("td", {}), el("th", { scope: "col" }, letter("A")), el("th", { scope: "col" }, letter("B")))),
    el("tbody", {}, ...rows));
}

// Confidence against time, a step for each outcome.
function curvesPicture(item, data) {
  const sides = [["a", item.left, data.left.end], ["b", item.right, data.right.end]]
    .filter(([, side]) => side && side.curve && side.curve.some((step) => Number.isFinite(step[1])));
  if (!sides.length) return null;
  const width = 480, height = 134, left = 30, right = 66, top = 16, bottom = 22;
  const end = Math.max(...sides.map(([, , last]) => last), 1);
  const X = (us) => left + (us / end) * (width - left - right);
  const Y = (value) => top + (1 - Math.min(1, Math.max(0, value))) * (height - top - bottom);
  const said = sides.map(([name, side]) => `${name.toUpperCase()} ends at ${sureText(side.sure)} after ${plural(side.curve.length, "step")}`).join(", ");
  const picture = svg("svg", { class: "curves", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": said });
  for (const value of [0, 0.5, 1]) {
    picture.append(svg("path", { class: "grid", d: `M${left} ${Y(value)}H${width - right}` }),
      svg("text", { x: left - 6, y: Y(value) + 4, "text-anchor": "end", text: value === 0.5 ? ".5" : String(value) }));
  }
  for (const share of [0, 0.25, 0.5, 0.75, 1]) {
    picture.append(svg("text", { x: X(end * share), y: height - 6, "text-anchor": "middle", text: String(Number((end * share / 1e6).toPrecision(3))) + (share === 1 ? " s" : "") }));
  }
  const ends = sides.map(([, side]) => side.sure);
  const close = ends.length === 2 && Math.abs(Y(ends[0]) - Y(ends[1])) < 12;
  sides.forEach(([name, side, last], i) => {
    const steps = side.curve.filter((step) => Number.isFinite(step[1]));
    // Where both run along one line, each stays to be seen.
    const shift = sides.length === 2 ? (i ? 1.5 : -1.5) : 0;
    let path = "";
    const marks = [];
    steps.forEach(([us, value], n) => {
      const x = X(us), y = Y(value) + shift;
      path += n ? `H${x.toFixed(1)}V${y.toFixed(1)}` : `M${x.toFixed(1)} ${y.toFixed(1)}`;
      if (steps.length <= 40) marks.push(name === "a" ? svg("circle", { cx: x, cy: y, r: 3 }) : svg("rect", { x: x - 3, y: y - 3, width: 6, height: 6 }));
    });
    const higher = ends.length === 2 && (ends[0] > ends[1] || (ends[0] === ends[1])) === (i === 0);
    const labelY = Y(steps[steps.length - 1][1]) + 4 + (close ? (higher ? -7 : 7) : 0);
    picture.append(svg("g", { class: name }, svg("path", { d: path + `H${X(last).toFixed(1)}` }), ...marks,
      svg("text", { x: width - right + 8, y: labelY, text: `${name.toUpperCase()} ${sureText(side.sure)}` })));
  });
  return picture;
}
