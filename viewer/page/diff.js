// ---- diff.js: puts the page of a difference together; selection and filter are kept in its address.

const ROWS_AT_ONCE = 300;

class DiffPage {
  /** @param {Difference} data */
  constructor(data) {
    this.data = data;
    const order = new Map(KINDS.map(([kind], i) => [kind, i]));
    this.items = [...data.items].sort((a, b) => order.get(kindOf(a)) - order.get(kindOf(b)));
    this.all = [...this.items, ...data.same];
    this.byKey = new Map(this.all.map((item) => [item.key, item]));
    this.words = new Map(this.all.map((item) => [item, wordsOf(item)]));
    this.kind = "";
    this.query = "";
    this.theme = "";
    this.chosen = null;
    this.rows = ROWS_AT_ONCE;
  }

  // ---- state

  address() {
    const state = new URLSearchParams();
    if (this.chosen) state.set("sel", this.chosen.key);
    if (this.kind) state.set("kind", this.kind);
    if (this.query) state.set("find", this.query);
    if (this.theme) state.set("th", this.theme);
    return "#" + state;
  }
  save(step) {
    const address = this.address();
    if (address === (location.hash || "#")) return;
    if (step) history.pushState(null, "", address); else history.replaceState(null, "", address);
  }
  restore() {
    const state = new URLSearchParams(location.hash.slice(1));
    const theme = state.get("th");
    this.theme = theme === "light" || theme === "dark" ? theme : "";
    showTheme(this.theme);
    this.kind = KIND_WORDS.has(state.get("kind") || "") ? state.get("kind") : "";
    this.query = state.get("find") || "";
    $("query").value = this.query;
    this.chosen = this.byKey.get(state.get("sel") || "") || this.firstChoice();
    this.showAll();
  }

  // Where nobody chose: what has two sides to compare, first of all another form of the same piece.
  firstChoice() {
    const forms = ["generalised", "specialised", "other_values"];
    return this.items.find((item) => forms.includes(item.change)) || this.items.find((item) => item.near) || this.items[0] || null;
  }

  choose(item) {
    this.chosen = item;
    this.save(true);
    this.showChosen();
    if (matchMedia("(max-width: 760px)").matches) $("detail").scrollIntoView({ block: "start" });
  }
  setKind(kind) {
    this.kind = kind;
    this.rows = ROWS_AT_ONCE;
    this.save(false);
    this.showKinds();
    this.showList();
  }
  step(by) {
    const list = this.shown();
    if (!list.length) return;
    const at = list.indexOf(this.chosen);
    this.choose(list[at < 0 ? 0 : Math.min(list.length - 1, Math.max(0, at + by))]);
    const row = document.querySelector(".piece[aria-current]");
    if (row) row.scrollIntoView({ block: "nearest" });
  }
  // What the list shows, by kind and by words.
  shown() { return this.items.filter((item) => (!this.kind || kindOf(item) === this.kind) && this.found(item)); }
  found(item) { return !this.query || this.words.get(item).includes(this.query.toLowerCase()); }

  showAll() {
    this.showKinds();
    this.showList();
    this.showMap();
    this.showChosen();
  }
  showChosen() {
    for (const node of document.querySelectorAll("[data-key]")) {
      if (this.chosen && node.dataset.key === this.chosen.key) node.setAttribute("aria-current", "true");
      else node.removeAttribute("aria-current");
    }
    showDetail($("detail"), this.chosen, this.data, (key) => {
      const other = this.byKey.get(key);
      return other ? () => this.choose(other) : null;
    });
  }

  // ---- at a glance

  showHead() {
    const { left, right, runs, same } = this.data;
    $("title").textContent = this.verdict();
    const reached = (side) => runs.drives.filter((drive) => drive[side][0] === 1).length;
    const wanted = (side) => runs.drives.filter((drive) => drive[side][0] >= 0).length;
    const some = `${same.length} of ${plural(this.all.length, "piece")} of knowledge ${same.length === 1 ? "is" : "are"} the same in both`;
    const parts = [this.items.length ? some : `All ${plural(same.length, "piece")} of knowledge are the same in both: what they say, evidence, origin`];
    if (runs.drives.length) parts.push(`A reached ${reached(1)} of ${plural(wanted(1), "goal")}, B ${reached(2)} of ${wanted(2)}`);
    $("summary").textContent = parts.join(". ") + ".";
    /** @type {[string, DiffSide][]} */
    const sides = [["A", left], ["B", right]];
    for (const [name, side] of sides) {
      const when = side.whole ? "" : ", as it was at " + side.at;
      $("sides").append(el("dt", {}, letter(name)), el("dd", {}, el("b", { text: side.name }), when,
        el("span", { text: [side.title, ...side.provenance.split("\n")].join(", ") })));
    }
    const warnings = sides.filter(([, side]) => side.warning).map(([name, side]) => `${name}: ${side.warning}`);
    $("warning").textContent = warnings.join(" ");
    $("warning").hidden = !warnings.length;
  }
  // The answer in one line.
  verdict() {
    const count = (kind) => this.items.filter((item) => kindOf(item) === kind).length;
    // What one had and gave up it does not know.
    const given = (kind) => this.items.filter((item) => kindOf(item) === kind && isGivenUp(item)).length;
    const goneA = given("removed"), goneB = given("added");
    const a = count("removed") - goneA, b = count("added") - goneB;
    const alone = (name, known, gone) => (known ? `${name} alone knows ${plural(known, "piece")}${gone ? `, and had ${gone} more that it gave up` : ""}`
      : `${name} alone had ${plural(gone, "piece")}, and gave ${gone === 1 ? "it" : "them"} up`);
    const forms = count("generalised") + count("specialised") + count("other_values");
    const sure = count("confidence");
    if (!this.items.length) return this.data.same.length ? "A and B know the same" : "Neither A nor B knows anything";
    const texts = [];
    if (goneA || goneB) {
      if (a || goneA) texts.push(alone("A", a, goneA));
      if (b || goneB) texts.push(alone("B", b, goneB));
    } else if (a && b) texts.push(`A alone knows ${plural(a, "piece")}, B alone ${b}`);
    else if (a) texts.push(`A knows ${plural(a, "piece")} that B does not`);
    else if (b) texts.push(`B knows ${plural(b, "piece")} that A does not`);
    if (forms) texts.push(`${texts.length ? "B has" : "They know the same things, but B has"} ${forms} in another form`);
    if (sure) texts.push(texts.length ? `${plural(sure, "confidence")} differ${sure === 1 ? "s" : ""}` : `A and B know the same, but are not equally sure of ${plural(sure, "piece")}`);
    if (!texts.length) return "A and B know the same, and are equally sure of it";
    return texts.join("; ");
  }
  showKinds() {
    const rows = KINDS.map(([kind, words]) => {
      const count = this.items.filter((item) => kindOf(item) === kind).length;
      const content = [mark(kind), el("span", { text: words }), el("b", { text: String(count) })];
      if (!count) return el("div", { class: `kind none ${kind}` }, ...content);
      return el("button", { type: "button", class: `kind ${kind}`, "data-kind": kind, "aria-pressed": String(this.kind === kind),
        title: this.kind === kind ? "Show all kinds" : "Show only these",
        on: { click: () => this.setKind(this.kind === kind ? "" : kind) } }, ...content);
    });
    rows.push(el("div", { class: "kind none same" }, mark("same"), el("span", { text: "the same" }), el("b", { text: String(this.data.same.length) })));
    // The focus stays on the kind that was pressed.
    const focused = document.activeElement instanceof HTMLElement ? document.activeElement.dataset.kind : "";
    $("kinds").replaceChildren(...rows);
    if (focused) { const again = $("kinds").querySelector(`[data-kind="${focused}"]`); if (again) again.focus(); }
  }

  showSure() {
    const both = this.all.filter((item) => surer(item) !== null);
    const moved = both.filter((item) => Math.abs(surer(item)) > 1e-9).sort((a, b) => Math.abs(surer(b)) - Math.abs(surer(a)));
    const kept = both.length - moved.length;
    const note = (text) => el("p", { class: "note", text });
    if (!both.length) { $("sure").append(note("There is no model that both know.")); return; }
    if (!moved.length) { $("sure").append(note(`Equally sure of all ${plural(both.length, "model")} that both know.`)); return; }
    $("sure").append(el("div", { class: "scale head", "aria-hidden": "true" }, el("span", { text: "A round, B square" }),
      svg("svg", { viewBox: "0 0 128 14" }, svg("text", { x: 4, y: 11, "font-size": 11, fill: "currentColor", text: "0" }),
        svg("text", { x: 124, y: 11, "font-size": 11, fill: "currentColor", "text-anchor": "end", text: "1" })), el("span", {})));
    const row = (item) => el("button", { type: "button", class: "scale", "data-key": item.key, title: titleOf(item), on: { click: () => this.choose(item) } },
      el("span", { text: titleOf(item) }), this.scale(item), el("span", { class: "by", text: byText(surer(item)) }),
      el("span", { class: "unseen", text: `: A ${sureText(item.left.sure)}, B ${sureText(item.right.sure)}` }));
    $("sure").append(...moved.slice(0, 5).map(row));
    if (moved.length > 5) {
      const more = el("details", {}, el("summary", { text: `${moved.length - 5} more` }));
      more.append(...moved.slice(5, 205).map(row));
      $("sure").append(more);
    }
    if (kept) $("sure").append(note(`Equally sure of ${plural(kept, "other model")}.`));
  }
  scale(item) {
    const X = (value) => 8 + Math.min(1, Math.max(0, value)) * 112;
    const a = X(item.left.sure), b = X(item.right.sure);
    return svg("svg", { viewBox: "0 0 128 14", "aria-hidden": "true" }, svg("path", { class: "rail", d: "M8 7H120" }),
      svg("path", { class: "way", d: `M${a} 7H${b}` }), svg("circle", { cx: a, cy: 7, r: 4 }), svg("rect", { x: b - 4, y: 3, width: 8, height: 8 }));
  }

  showEnds() {
    const { drives } = this.data.runs;
    if (!drives.length) { $("ends").append(el("p", { class: "note", text: "Nothing was wanted of either." })); return; }
    const cell = ([outcome, at]) => {
      if (outcome < 0) return el("td", { text: "not set" });
      const [sign, word] = ENDINGS[outcome];
      return el("td", {}, sign ? mark(sign, outcome === 2 ? "fail" : "") : null,
        el("span", { class: outcome === 2 ? "fail" : outcome === 1 ? "unseen" : null, text: word + (at ? " " : "") }), at);
    };
    const row = ([title, a, b]) => el("tr", {}, el("th", { scope: "row", text: title }), cell(a), cell(b));
    const table = (list) => el("table", { class: "ends" }, el("thead", {}, el("tr", {}, el("th", { scope: "col", text: "wanted" }),
      el("th", { scope: "col" }, letter("A")), el("th", { scope: "col" }, letter("B")))), el("tbody", {}, ...list.map(row)));
    $("ends").append(table(drives.slice(0, 6)));
    if (drives.length > 6) $("ends").append(el("details", {}, el("summary", { text: `${drives.length - 6} more` }), table(drives.slice(6))));
  }

  showInputs() {
    const { settings, files, parting } = this.data.runs;
    const pane = $("inputs");
    if (!settings.length && !files.length) pane.append(el("p", { class: "note", text: "Nothing: the same scenario, seed and parameters." }));
    if (settings.length) {
      const cell = (value, side) => el("td", {}, value === null ? "none" : el("mark", { class: side, text: value || "\u2423" }));
      const row = ([name, a, b]) => el("tr", {}, el("th", { scope: "row", text: name }), cell(a, "a"), cell(b, "b"));
      const table = (list) => el("table", { class: "inputs" }, el("thead", {}, el("tr", {}, el("th", { scope: "col", text: "setting" }),
        el("th", { scope: "col" }, letter("A")), el("th", { scope: "col" }, letter("B")))), el("tbody", {}, ...list.map(row)));
      pane.append(table(settings.slice(0, 5)));
      if (settings.length > 5) pane.append(el("details", {}, el("summary", { text: `${settings.length - 5} more settings` }), table(settings.slice(5))));
    }
    // Files that both have first; what one has alone may be many, such as the meshes of a world.
    for (const file of files) if (file.left && file.right) pane.append(this.fileNote(file));
    for (const side of ["left", "right"]) {
      const alone = files.filter((file) => file[side] && !(file.left && file.right));
      const name = letter(side === "left" ? "A" : "B");
      if (alone.length > 2) pane.append(el("details", {}, el("summary", {}, "Only ", name, ` has ${alone.length} more files`), el("ul", { class: "files" }, ...alone.map((file) => el("li", { text: file.name })))));
      else for (const file of alone) pane.append(el("p", { class: "note" }, "Only ", name, ` has the file ${file.name}.`));
    }
    pane.append(el("h2", { text: "Where do the runs part?" }));
    if (!parting) { pane.append(el("p", { class: "note", text: "Nowhere: the same commands, knowledge and outcomes, frame by frame." })); return; }
    pane.append(el("p", { class: "note", text: `After ${plural(parting.common, "common step")}:` }));
    const step = (name, side) => [letter(name), side ? el("span", {}, `${side.at}, ${side.event}: `, ...sentence(side.say)) : el("span", { text: "no further step" })];
    pane.append(el("div", { class: "steps" }, ...step("A", parting.left), ...step("B", parting.right)));
  }
  fileNote(file) {
    const count = file.lines.length + file.hidden;
    if (!count) return el("p", { class: "note", text: `The file ${file.name} is another one.` });
    const lines = file.lines.flatMap(([side, number, text]) => [letter(side), el("span", { class: "number", text: String(number) }), el("code", { text })]);
    return el("details", {}, el("summary", { text: `${file.name} differs in ${plural(count, "line")}` }),
      el("div", { class: "lines", tabindex: "0", role: "region", "aria-label": `Lines of ${file.name} that differ` }, ...lines),
      file.hidden ? el("p", { class: "note", text: `and ${file.hidden} more` }) : null);
  }

  // ---- the list

  pieceButton(item, brief) {
    const fate = fateOf(item);
    const why = brief ? "" : whyOf(item);
    return el("li", {}, el("button", { type: "button", class: `piece ${kindOf(item)}`, "data-key": item.key,
      "aria-current": item === this.chosen ? "true" : null, on: { click: () => this.choose(item) } },
    mark(signOf(item)),
    el("span", {}, brief ? null : el("span", { class: "line" }, el("b", { text: KIND_WORDS.get(kindOf(item)) }), el("span", {}, ...spaced(idsOf(item)))),
      el("span", { class: "line" }, el("span", { class: "what", text: titleOf(item) }), brief ? el("span", {}, ...spaced(idsOf(item))) : null),
      fate ? el("span", { class: "fate", text: fate }) : null, why ? el("span", { class: "why", text: why }) : null)));
  }
  showList() {
    const list = this.shown();
    const same = this.data.same.filter((item) => this.found(item));
    $("count").textContent = !this.items.length ? "nothing differs"
      : list.length === this.items.length ? plural(list.length, "difference") : `${list.length} of ${plural(this.items.length, "difference")}`;
    $("list").replaceChildren(...list.slice(0, this.rows).map((item) => this.pieceButton(item, false)));
    if (list.length > this.rows) {
      $("list").append(el("li", {}, el("button", { type: "button", class: "more link", text: `Show the other ${list.length - this.rows}`,
        on: { click: () => { this.rows = list.length; this.showList(); } } })));
    }
    if (this.items.length && !list.length) $("list").append(el("li", { class: "note", text: "Nothing of this kind with these words." }));
    $("same").hidden = !this.data.same.length;
    $("same-count").textContent = same.length === this.data.same.length ? `${plural(same.length, "piece")} the same` : `${same.length} of ${plural(this.data.same.length, "piece")} the same`;
    this.fillSame = () => { $("same-list").replaceChildren(...same.map((item) => this.pieceButton(item, true))); };
    if ($("same").open) this.fillSame(); else $("same-list").replaceChildren();
  }

  // ---- the map: each model that makes something happen, with the conditions that allow or forbid it

  groups() {
    const ofLeft = new Map(), ofRight = new Map(), groups = new Map();
    const isHead = (item) => item.kind !== "requirement_model" && item.kind !== "strong_requirement_model";
    for (const item of this.all.filter(isHead)) {
      if (item.left) ofLeft.set(item.left.id, item);
      if (item.right) ofRight.set(item.right.id, item);
      groups.set(item, []);
    }
    const rest = [];
    for (const item of this.all.filter((one) => !isHead(one))) {
      const head = (item.left && ofLeft.get(item.left.target)) || (item.right && ofRight.get(item.right.target));
      (head ? groups.get(head) : rest).push(item);
    }
    // What nothing speaks about, such as drives, is put together in the end.
    const list = [...groups].filter(([head, own]) => own.length || head.kind === "causal_model");
    list.sort(([a], [b]) => (titleOf(a) < titleOf(b) ? -1 : 1));
    const single = [...groups.keys()].filter((head) => !list.some(([other]) => other === head));
    return { list, single, rest };
  }
  chip(item, head) {
    const kind = kindOf(item);
    const text = head ? [el("b", { text: titleOf(item) })] : this.conditions(item);
    const fate = fateOf(item);
    return el("button", { type: "button", class: `chip ${kind}${head ? " head" : " indent"}${isGivenUp(item) ? " given-up" : ""}`, "data-key": item.key,
      "aria-current": item === this.chosen ? "true" : null, on: { click: () => this.choose(item) } },
    mark(signOf(item)), el("span", {}, ...text, fate ? el("span", { class: "fate", text: fate }) : null, el("span", { class: "unseen", text: ", " + KIND_WORDS.get(kind) })), el("span", {}, ...stacked(idsOf(item))));
  }
  // Its conditions in a line; what only one side asks for is set off in pairs.
  conditions(item) {
    const pair = item.left && item.right;
    const own = item.left ? "left" : "right";
    const rows = item.rows.filter((row) => row[0] === "condition" && (pair || row[1] === "same" || row[1] === "changed" || row[1] === own));
    if (!rows.length) return [titleOf(item)];
    const before = [...new Set([item.left, item.right].flatMap((side) => (side ? [side.before || ""] : [])))];
    const seen = before.some((time) => time) ? `seen ${before.map((time) => time || "0 s").join(" or ")} before: ` : "";
    return [(item.kind === "strong_requirement_model" ? "not if " : "") + seen, ...rows.flatMap((row, i) => {
      const text = withVariables(pair ? row[2] || row[3] : (item.left ? row[2] : row[3]), row[4]);
      const only = pair && (row[1] === "left" || row[1] === "right");
      return [i ? " \u00b7 " : "", ...(only ? [el("span", { class: "only" + (row[1] === "left" ? " gone" : "") }, ...text)] : text)];
    })];
  }
  showMap() {
    if ($("map").childElementCount) return;
    if (!this.all.length) { $("map").append(el("p", { class: "note", text: "Neither knows anything." })); return; }
    const { list, single, rest } = this.groups();
    for (const [head, own] of list) this.addGroup(titleOf(head), [head, ...own], (item) => this.chip(item, item === head));
    if (rest.length) this.addGroup("About nothing that either knows", rest, (item) => this.chip(item, false), true);
    if (single.length) this.addGroup("Drives, and what stands by itself", single, (item) => this.chip(item, true), true);
  }
  // Of much knowledge only the names of groups, which open.
  addGroup(title, items, chip, titled) {
    if (this.all.length <= 120) {
      $("map").append(el("div", { class: "group" }, titled ? el("p", { class: "note", text: title }) : null, ...items.map(chip)));
      return;
    }
    const differ = items.filter((item) => item.change !== "same").length;
    const group = el("details", { class: "group" }, el("summary", { text: `${title} (${plural(items.length, "piece")}, ${differ} differ)` }));
    group.addEventListener("toggle", () => { if (group.childElementCount === 1) group.append(...items.map(chip)); });
    $("map").append(group);
  }
}

const spaced = (nodes) => nodes.flatMap((node, i) => (i ? [" ", node] : [node]));
const stacked = (nodes) => nodes.flatMap((node, i) => (i ? [el("br"), node] : [node]));

function listenToKeys(page) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.closest("input")) {
      if (event.key === "Escape") $("query").blur();
      return;
    }
    if (event.target.closest("dialog")) return;
    const action = { j: () => page.step(1), k: () => page.step(-1), "/": () => $("query").focus(), 0: () => page.setKind(""),
      c: () => copyAddress(location.href.split("#")[0] + page.address()), "?": () => $("keys").showModal() }[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

async function start() {
  /** @type {Difference} */
  const data = JSON.parse(await blockText("diff-data"));
  const page = new DiffPage(data);
  document.body.classList.remove("loading");
  page.showHead();
  page.showSure();
  page.showEnds();
  page.showInputs();
  $("same").addEventListener("toggle", () => { if ($("same").open) page.fillSame(); });
  if (!data.items.length) $("same").open = true;
  $("query").addEventListener("input", () => { page.query = $("query").value.trim(); page.rows = ROWS_AT_ONCE; page.save(false); page.showList(); });
  $("theme").addEventListener("click", () => {
    page.theme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    showTheme(page.theme);
    page.save(false);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { if (!page.theme) showTheme(""); });
  $("help").addEventListener("click", () => $("keys").showModal());
  $("copy").addEventListener("click", () => copyAddress(location.href.split("#")[0] + page.address()));
  addEventListener("hashchange", () => page.restore());
  addEventListener("popstate", () => page.restore());
  listenToKeys(page);
  page.restore();
  document.documentElement.dataset.ready = "true";
}

start().catch((error) => {
  document.body.classList.remove("loading");
  $("warning").textContent = "This page could not be opened: " + error.message +
    ". It needs a browser of 2024 or later (DecompressionStream, light-dark).";
  $("warning").hidden = false;
});
