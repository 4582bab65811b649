// ---- inspector.js: what the selected thing says, how sure, what was compared, why it exists, what it led to.

function inspectorPane(app) {
  const box = $("inspector");
  let live = [];

  const heading = (text, note, id) => el("h3", { id }, text, note ? el("span", { text: note }) : "");
  const block = (...children) => el("div", { class: "block" }, ...children);

  function draw(subject) {
    live = [];
    const sections = [definition(subject), facts(subject), life(subject), outcome(subject), requirements(subject), plans(subject),
      comparisons(subject), why(subject), led(subject)];
    box.replaceChildren(top(subject), ...sections.filter((section) => section));
    box.scrollTop = 0;
  }

  function top(subject) {
    const failed = subject.outcome === "failed";
    const jump = el("span", { class: "jump" });
    for (const [id, text, there] of [["compared", "compared", subject.compared], ["why", "why", subject.why.nodes.length > 1],
      ["led", "led to", subject.led.nodes.length]]) {
      if (!there) continue;
      jump.append(el("button", { type: "button", class: "link", text,
        on: { click: () => { const target = $("part-" + id); if (target) target.scrollIntoView({ block: "start" }); } } }));
    }
    const big = el("span", { class: "big" });
    if (subject.confidence && subject.confidence.length) live.push((t) => showSure(big, subject, t));
    return el("div", { class: "top" },
      el("div", { class: "kind" }, mark(failed ? "cross" : subject.mark, failed ? "fail" : ""), el("span", { text: (subject.kind === "thing" ? "" : subject.id + ", ") + subject.note }), jump),
      el("div", { class: "row" }, el("h2", { text: subject.title }), big));
  }
  function showSure(big, subject, t) {
    const step = lastAt(subject.confidence, t, (s) => s.at);
    if (!step) { big.replaceChildren(el("small", { text: "not yet learned" })); return; }
    if (step.deleted) { big.replaceChildren(el("small", { text: "deleted at " + secondsText(step.at) })); return; }
    big.replaceChildren(sureText(step.sure), el("small", { text: "sure at " + secondsText(t) }));
  }

  // ---- what it says
  function definition(subject) {
    const out = [];
    if (subject.say) out.push(el("p", { class: "say" }, ...withVariables(subject.say, subject.vars)));
    if (subject.definition) {
      const rows = subject.definition.map((part) => el("div", { class: part.side },
        el("span", { class: "label" + (/_\d/.test(part.label) ? " id" : "") },
          part.subject ? el("button", { type: "button", class: "link", text: part.label, on: { click: () => app.select(part.subject) } }) : part.label),
        el("span", { class: "lines" + (part.lines.length < 2 ? " one" : "") }, ...part.lines.map((line) => el("span", {}, ...conditionLine(line))))));
      if (subject.kind === "requirement" || subject.kind === "model") {
        const now = el("span", {});
        rows.push(el("div", { class: "now" }, el("span", { class: "label", text: "now" }), now));
        live.push((t) => showBindings(now, subject, t));
      }
      out.push(el("div", { class: "definition" }, ...rows));
    }
    return out.length ? block(...out) : null;
  }
  function showBindings(node, subject, t) {
    const bindings = app.bindings(subject, t);
    if (!bindings || !bindings.length) { node.replaceChildren(el("span", { class: "quiet", text: "bound to nothing at this moment" })); return; }
    node.replaceChildren(...bindings.flatMap(([name, value], i) => [i ? ", " : "", el("span", { class: "var", text: name }), " = ", el("b", { text: value })]));
  }

  // ---- of a thing: what is known of it now
  function facts(subject) {
    if (subject.kind !== "thing") return null;
    const object = app.report.objects.find((one) => one.name === subject.name);
    if (!object) return null;
    const body = el("tbody", {});
    live.push((t) => {
      const now = new Map();
      for (const change of object.changes) if (change.at <= t) now.set(change.attribute, change);
      body.replaceChildren(...[...now].map(([attribute, change]) => el("tr", {}, el("td", { text: attribute }),
        el("td", { text: change.value }), el("td", { text: secondsText(change.at) }))));
    });
    return block(object.what ? el("p", { class: "say", text: object.what }) : "", heading("What is known of it now?", "since"), el("table", {}, body));
  }

  // ---- how sure
  function life(subject) {
    const steps = subject.confidence;
    if (!steps || !steps.length) return null;
    const { clock } = app.report;
    const width = 376, left = 30, right = 306, top = 22, bottom = 70;
    const floor = Math.min(0.5, Math.floor(Math.min(...steps.map((s) => s.sure)) * 4) / 4);
    const X = (t) => left + (right - left) * (t - clock.start) / Math.max(1, clock.end - clock.start);
    const Y = (v) => bottom - (bottom - top) * (v - floor) / (1 - floor);
    const picture = svg("svg", { class: "life", viewBox: `0 0 ${width} 92`, role: "img", "aria-label": "Confidence over time" });
    for (const value of [floor, (1 + floor) / 2, 1]) {
      picture.append(svg("line", { class: "grid", x1: left, x2: right, y1: Y(value), y2: Y(value) }),
        svg("text", { x: left - 6, y: Y(value) + 4, "text-anchor": "end", text: String(Number(value.toFixed(2))).replace(/^0\./, ".") }));
    }
    const every = Math.ceil(app.frames.length / 9);
    for (let i = 0; i < app.frames.length; i += every) {
      const at = app.frames[i];
      picture.append(svg("text", { x: X(at), y: 88, "text-anchor": "middle", text: tickText(at) + (i ? "" : " s") }));
    }
    const now = svg("line", { class: "now", y1: 6, y2: bottom + 4 });
    picture.append(now);
    let d = "";
    steps.forEach((step, i) => { d += i ? `H${X(step.at)}V${Y(step.sure)}` : `M${X(step.at)} ${Y(step.sure)}`; });
    if (!steps[steps.length - 1].deleted) d += `H${right}`;
    picture.append(svg("path", { class: "step", d }));
    steps.forEach((step, i) => picture.append(i === 0 && subject.mark === "analogy" ? signAt("analogy", X(step.at), Y(step.sure), 14, "star")
      : svg("circle", { class: "dot" + (step.failed ? " fail" : ""), cx: X(step.at), cy: Y(step.sure), r: 3.5 })));
    // The first and the last value always, the others where there is air between them.
    const last = steps.length - 1;
    let free = -Infinity;
    steps.forEach((step, i) => {
      const x = X(step.at), y = Y(step.sure);
      if (i === 0) {
        const room = x - left > 110;
        // Above, where the curve soon falls.
        const falls = i < last && steps[i + 1].sure < step.sure && X(steps[i + 1].at) < x + 110;
        picture.append(room ? value(x - 12, y + 4, "end", step, x - left - 14)
          : value(x, falls || y + 18 > bottom ? y - 8 : y + 18, "start", step, 110));
        free = room ? x - 8 : x + 110;
      } else if (i === last) {
        picture.append(svg("text", { class: "value", x: right + 10, y: y + 2 }, svg("tspan", { text: sureText(step.sure) })),
          svg("text", { class: "value", x: right + 10, y: y + 16, text: fitted(step.deleted ? "deleted" : step.why, width - right - 12, 11.5) }));
      } else if (x > free && X(steps[last].at) - x > 40) {
        const room = Math.min(X(steps[i + 1].at), right) - x - 8;
        picture.append(value(x + 6, y - 7, "start", step, room));
        free = x + 60;
      }
    });
    live.push((t) => { now.setAttribute("x1", X(t)); now.setAttribute("x2", X(t)); });
    return block(heading("How sure was it?", "confidence, moved by evidence"), picture);
  }
  function value(x, y, anchor, step, room) {
    const number = sureText(step.sure);
    return svg("text", { class: "value", x, y, "text-anchor": anchor }, svg("title", { text: step.why }), svg("tspan", { text: number }),
      " " + fitted(step.why, room - widthOf(number + " ", 12), 11.5));
  }

  // ---- goals and predictions: what came of it
  function outcome(subject) {
    if (!subject.result) return null;
    const failed = subject.outcome === "failed";
    const sign = failed ? "cross" : subject.outcome === "true" ? "check" : null;
    return block(heading("What came of it?"), el("p", { class: "verdict" + (failed ? " fail" : "") },
      sign ? mark(sign, failed ? "fail" : "") : "", " ", el("b", { class: failed ? "fail" : "", text: subject.result })));
  }
  function requirements(subject) {
    if (!subject.requirements || !subject.requirements.length) return null;
    const title = subject.kind === "prediction" ? "What said so?" : "When does it work?";
    return block(heading(title), el("div", { class: "tree" }, ...subject.requirements.map((entry) => {
      const button = el("button", { type: "button", on: { click: () => app.select(entry.subject) } },
        el("span", { class: "what" }, mark(entry.mark), el("span", {}, el("b", { text: entry.subject }), " " + entry.text)),
        el("time", { text: secondsText(entry.at) }));
      return button;
    })));
  }
  function plans(subject) {
    if (!subject.plans) return null;
    const rows = subject.plans.map((plan) => el("tr", { class: plan.committed ? "" : "missed" },
      el("td", { text: plan.text }), el("td", { text: plan.score }),
      el("td", {}, mark(plan.outcome === "reached" ? "check" : "cross"), plan.committed ? "chosen" : plan.outcome.replaceAll("_", " "))));
    return block(heading("What was tried in the head?"), el("table", {},
      el("thead", {}, el("tr", {}, el("th", { text: "commands" }), el("th", { text: "sure" }), el("th", {}))), el("tbody", {}, ...rows)));
  }

  // ---- what was compared
  function comparisons(subject) {
    if (!subject.compared) return null;
    const [first, ...others] = subject.made_by_comparison ? subject.compared : [null, ...subject.compared];
    const parts = [];
    if (first) {
      parts.push(heading("What was compared?", first.source + " with the scene, " + secondsText(first.at), "part-compared"),
        comparisonTable(first), verdict(first));
    } else {
      parts.push(heading("What was it compared with?", "", "part-compared"));
    }
    for (const other of others) {
      const fold = el("details", {}, el("summary", {}, comparisonLine(other)), comparisonTable(other), verdict(other));
      parts.push(fold);
    }
    return block(...parts);
  }
  function comparisonLine(one) {
    return one.source + (one.object ? " for " + one.object : "") + ` at ${secondsText(one.at)}: ${one.matched + one.achievable}/${one.total}, ` + one.verdict;
  }
  function comparisonTable(one) {
    const words = { matched: ["check", "kept"], achievable: ["goal", "can be brought about"], missed: ["cross", one.accepted ? "pruned" : "missing"] };
    return el("table", {}, el("thead", {}, el("tr", {}, el("th", { text: "condition" }), el("th", { text: one.object ? "found for " + one.object : "found" }), el("th", {}))),
      el("tbody", {}, ...one.rows.map((row) => el("tr", { class: row.status === "missed" ? "missed" : "" },
        el("td", {}, ...conditionLine({ ...row.condition, cut: row.condition.cut && one.accepted })), el("td", { text: row.found }),
        el("td", {}, mark(words[row.status][0]), words[row.status][1])))));
  }
  function verdict(one) {
    const share = `${one.matched + one.achievable}/${one.total}`;
    const text = [el("b", { text: `\u03c8 = ${share} = ${one.psi}, ${one.verdict}` })];
    if (one.above && one.accepted) text.push(` (above ${one.above})`);
    text.push(".");
    if (one.accepted && one.source_sure) text.push(` Starts at ${one.psi} \u00d7 ${one.source_sure} (${one.requirement}) = ${one.confidence}.`);
    text.push(` Jaccard ${one.jaccard}.`);
    return el("p", { class: "verdict" }, ...text);
  }

  // ---- why, and what it led to
  function why(subject) {
    const data = subject.why;
    if (data.nodes.length < 2) return null;
    const root = el("ol", { class: "tree" });
    const lists = [root];
    for (const [event, depth, sign] of data.nodes) {
      const node = { depth, more: sign === 2 };
      const item = el("li", {}, causeRow(event, sign === 1));
      if (node.more) item.append(el("div", { class: "more", text: "and what led to that" }));
      if (!lists[node.depth]) {
        lists[node.depth] = el("ul", {});
        lists[node.depth - 1].lastElementChild.append(lists[node.depth]);
      }
      lists[node.depth].append(item);
      lists.length = node.depth + 1;
    }
    const rest = data.cut ? el("p", { class: "verdict quiet", text: `The whole tree: aerascope why RUN #${subject.event}` }) : null;
    const title = { goal: subject.outcome === "open" ? "Why is it wanted?" : "Why did it end so?", command: "Why was it done?",
      prediction: subject.outcome === "open" ? "Why was it expected?" : "Why did it end so?" }[subject.kind] || "Why does it exist?";
    return block(heading(title, `${data.levels} levels, ${data.first} first ${data.first === 1 ? "cause" : "causes"}`, "part-why"), root, rest);
  }
  function led(subject) {
    const data = subject.led;
    if (!data.nodes.length) return null;
    const rest = data.left_out ? el("p", { class: "verdict quiet", text: `and ${data.left_out} more` }) : null;
    return block(heading(subject.kind === "thing" ? "What happened with it?" : "What did it lead to?", "", "part-led"),
      el("ol", { class: "tree" }, ...data.nodes.map(([event]) => el("li", {}, causeRow(event)))), rest);
  }
  function causeRow(event, toldAbove) {
    const node = app.report.events[event];
    const still = lastAt(app.report.film.stills, node.at, (s) => s.at);
    const button = el("button", { type: "button", class: node.failed ? "fail" : "", title: "#" + event,
      on: { click: () => { if (node.subject) app.select(node.subject); app.go(node.at); } } });
    if (still) button.append(thumbnail(still, node.text));
    button.append(el("span", { class: "what" }, mark(node.failed ? "cross" : node.mark, node.failed ? "fail" : ""),
      el("span", {}, ...sentence(node.text), toldAbove ? el("span", { class: "quiet", text: " (see above)" }) : "")), el("time", { text: secondsText(node.at) }));
    return button;
  }

  // The still around the thing last named, enlarged.
  function thumbnail(still, text) {
    const image = el("img", { alt: "" });
    showImage(image, still.image);
    const named = text.split(/[^\p{L}\p{N}_]+/u).filter((word) => Object.hasOwn(still.objects, word)).pop();
    if (named) {
      const { outline, label } = still.objects[named];
      const middle = (first) => {
        const values = outline.filter((_, i) => i % 2 === first);
        return values.length ? (Math.min(...values) + Math.max(...values)) / 2 : label[first];
      };
      const zoom = 2.4;
      const { width, height } = app.report.film;
      image.style.width = image.style.height = zoom * 100 + "%";
      image.style.left = clamp(50 - zoom * 100 * middle(0) / width, 100 - zoom * 100, 0) + "%";
      image.style.top = clamp(50 - zoom * 100 * middle(1) / height, 100 - zoom * 100, 0) + "%";
    }
    return el("span", { class: "thumb" }, image);
  }

  return app.add({
    showSelection(subject) { draw(subject); },
    showTime(t) { for (const part of live) part(t); },
  });
}
