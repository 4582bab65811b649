// ---- inspector.js: what the selected thing says, how sure, what was compared, why it exists, what it led to.

const ROWS_OF_A_LIFE = 16;   // each may need sentences from another part of a long run
const USED_BY_PREDICTION = 0, USED_IN_COMPARISON = 2;   // what bound the variables

function inspectorPane(app) {
  const box = $("inspector");
  let live = [];

  const heading = (text, note, id) => el("h3", { id }, text, note ? el("span", { text: note }) : "");
  const block = (...children) => el("div", { class: "block" }, ...children);

  async function draw(subject) {
    live = [];
    const [compared, against] = await Promise.all([comparisonsOf(subject), reasonsAgainst(subject)]);
    if (app.selected !== subject.id) return;
    const steps = subject.number >= 0 ? app.log.confidence(subject.number) : [];
    (subject.detail.steps || []).forEach(([reason, positive, total], i) => { if (steps[i]) Object.assign(steps[i], { why: reason, positive, total }); });
    subject.confidence = steps;
    const sections = [definition(subject), eventFields(subject), facts(subject), life(subject), outcome(subject), requirements(subject),
      relatives(subject), plans(subject), whyNot(subject, against), comparisons(subject, compared), why(subject), led(subject), happenings(subject)];
    const shown = sections.filter((section) => section);
    if (asked && asked.of !== subject.id) asked = null;
    grown.disconnect();
    box.replaceChildren(top(subject, shown), ...shown);
    for (const section of shown) grown.observe(section);
    box.scrollTop = 0;
    for (const part of live) part(app.t);
    goToAsked();
  }
  async function comparisonsOf(subject) {
    if (subject.detail.comparison) return [subject.detail.comparison];
    const events = (subject.detail.compared || []).slice(0, 24);
    const fields = await Promise.all(events.map((event) => app.log.fields(event)));
    return fields.map((one) => one.comparison).filter((one) => one);
  }

  function top(subject, sections) {
    const failed = subject.outcome === "failed";
    const jump = el("nav", { class: "jump", "aria-label": "Parts" });
    for (const [id, text] of [["part-compared", "compared"], ["part-whynot", "why not"], ["part-why", "why"], ["part-led", "led to"], ["part-life", "life"]]) {
      const target = sections.map((section) => section.querySelector("#" + id)).find((node) => node);
      if (!target) continue;
      jump.append(el("button", { type: "button", class: "link", text, on: { click: () => goTo(target) } }));
    }
    const big = el("span", { class: "big" });
    if (subject.confidence.length) live.push((t) => showSure(big, subject, t));
    return el("div", { class: "top" },
      el("div", { class: "kind" }, mark(failed ? "cross" : subject.mark, failed ? "fail" : ""), el("span", { text: (subject.kind === "thing" ? "" : subject.id + ", ") + subject.detail.note }), jump),
      el("div", { class: "row" }, el("h2", { text: ["requirement", "model", "state"].includes(subject.kind) ? capitalised(subject.title) : subject.title }), big));
  }
  // What is filled in later above the part that was asked for would push it away: it is scrolled to again, until the
  // reader scrolls, or does anything else here. Asked for while another selection is on its way, it is that one's.
  let asked = null;
  function goTo(part) {
    asked = { id: part.id, of: app.selected };
    goToAsked();
  }
  function goToAsked() {
    const part = asked && box.querySelector("#" + asked.id);
    if (part) part.scrollIntoView({ block: "start" });
  }
  const grown = new ResizeObserver(goToAsked);
  for (const touch of ["wheel", "touchstart", "pointerdown", "keydown"]) box.addEventListener(touch, () => { asked = null; }, { passive: true, capture: true });

  function showSure(big, subject, t) {
    const step = lastAt(subject.confidence, t, (s) => s.at);
    if (!step) { big.replaceChildren(el("small", { text: "not yet learned" })); return; }
    if (step.deleted) { big.replaceChildren(el("small", { text: "given up at " + secondsText(step.at) })); return; }
    big.replaceChildren(sureText(step.sure), el("small", { text: "sure at " + secondsText(t) }));
  }

  // ---- what it says
  function definition(subject) {
    const out = [];
    const { say, vars, definition: parts } = subject.detail;
    if (say) out.push(el("p", { class: "say" + (subject.detail.strong ? " veto" : "") }, ...(vars ? withVariables(say, vars) : sentence(say))));
    if (parts) {
      const rows = parts.map((part) => el("div", { class: part.side },
        el("span", { class: "label" + (/_\d/.test(part.label) ? " id" : "") },
          part.subject ? el("button", { type: "button", class: "link", text: part.label, on: { click: () => app.select(part.subject) } }) : part.label),
        el("span", { class: "lines" + (part.lines.length < 2 ? " one" : "") }, ...part.lines.map((line) => el("span", { class: line.anti ? "anti" : null }, ...conditionLine(line))))));
      if (subject.kind === "requirement" || subject.kind === "model") {
        const now = el("span", {});
        const label = el("span", { class: "label" });
        rows.push(el("div", { class: "now" }, label, now));
        live.push((t) => showBindings(label, now, subject, t));
      }
      out.push(el("div", { class: "definition" }, ...rows));
    }
    return out.length ? block(...out) : null;
  }
  function showBindings(label, node, subject, t) {
    const use = app.useAt(subject, t);
    const bindings = use && use[2];
    // What a prediction bound in an earlier frame need not be so now: the outcome is still awaited.
    const frame = app.frames[frameAt(app.frames, t)];
    label.textContent = use && use[3] === USED_BY_PREDICTION && use[0] < frame ? "at " + secondsText(use[0]) : use && use[3] === USED_IN_COMPARISON ? "compared" : "now";
    if (!bindings || !bindings.length) {
      const text = subject.kind === "requirement" ? "not seen to hold at this moment" : "no prediction rests on it at this moment";
      node.replaceChildren(el("span", { class: "quiet", text }));
      return;
    }
    const said = (value) => (app.subject("thing:" + value)
      ? el("button", { type: "button", class: "link plain", on: { click: () => app.select("thing:" + value) } }, el("b", { text: value })) : el("b", { text: value }));
    node.replaceChildren(...bindings.flatMap(([name, value], i) => [i ? ", " : "", el("span", { class: "var", text: name }), " = ", said(value)]));
  }

  // ---- of an event: what it says, field by field
  function eventFields(subject) {
    if (!subject.detail.fields) return null;
    const rows = subject.detail.fields.map((field) => el("tr", { title: field.meaning }, el("td", { class: "quiet", text: field.name }),
      el("td", {}, field.go && app.subject(field.go) ? el("button", { type: "button", class: "link", text: field.text, on: { click: () => app.select(field.go) } }) : field.text)));
    const about = [...app.log.subjectsOf(subject.event)].slice(0, 8).map((number) => app.subjectByNumber(number));
    return block(el("p", { class: "quiet", text: subject.detail.meaning }), about.length ? heading("What is it about?") : "", subjectList(about),
      rows.length ? heading("What is written of it?") : "", rows.length ? el("table", { class: "fields" }, el("tbody", {}, ...rows)) : "");
  }
  // Subjects as rows that can be chosen.
  function subjectList(subjects) {
    if (!subjects.length) return "";
    return el("div", { class: "tree" }, ...subjects.map((one) => el("div", { class: "line" }, el("button", { type: "button", on: { click: () => app.select(one.id) } },
      el("span", { class: "what" }, mark(one.outcome === "failed" ? "cross" : one.mark, one.outcome === "failed" ? "fail" : ""),
        el("span", {}, one.kind === "thing" ? "" : el("b", { text: one.id }), " " + one.title)), el("time", { text: secondsText(one.born) })))));
  }

  // ---- of a thing: what is known of it now
  function facts(subject) {
    if (subject.kind !== "thing") return null;
    const object = app.report.objects.find((one) => "thing:" + one.name === subject.id);
    if (!object) return null;
    const body = el("tbody", {});
    live.push((t) => {
      body.replaceChildren(...[...knownOf(object, t)].map(([attribute, change]) => el("tr", {}, el("td", { text: attribute }),
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
    const picture = svg("svg", { class: "life", viewBox: `0 0 ${width} 92`, role: "group", "aria-label": "Confidence over time" });
    for (let value = floor; value <= 1; value += floor < 0.25 ? 0.5 : 0.25) {
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
    // Each step leads to the event that caused it; where they are dense, the list below does.
    const dots = steps.length > 60 ? steps.filter((step, i) => i === 0 || i === steps.length - 1 || step.failed || step.deleted) : steps;
    dots.forEach((step, i) => picture.append(svg("g", { class: "step-dot", role: "button", tabindex: "0",
      "aria-label": sureText(step.sure) + " at " + secondsText(step.at) + (step.why ? ": " + step.why : ""),
      on: { click: () => { app.go(step.at); app.select("#" + step.event); },
        keydown: (event) => { if (event.key === "Enter") { event.preventDefault(); app.go(step.at); app.select("#" + step.event); } } } },
    svg("circle", { class: "area", cx: X(step.at), cy: Y(step.sure), r: 9 }),
    i === 0 && subject.mark === "analogy" ? signAt("analogy", X(step.at), Y(step.sure), 14, "star")
      : svg("circle", { class: "dot" + (step.failed ? " fail" : ""), cx: X(step.at), cy: Y(step.sure), r: 3.5 }))));
    // The first and the last value always, the others where there is air between them.
    const last = steps.length - 1;
    let free = -Infinity;
    let fallen = left;
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
          svg("text", { class: "value", x: right + 10, y: y + 16 }, svg("title", { text: step.why || "" }), fitted(step.deleted ? "given up" : step.why || "", width - right - 12, 11.5)));
      } else if (step.failed) {
        // In the corner below the fall, where no line runs.
        if (x - fallen > 40) picture.append(value(x - 9, y + 4, "end", step, 0));
        fallen = x;
      } else if (x > free && X(steps[i + 1].at) - x > 34) {
        const room = Math.min(X(steps[i + 1].at), right) - x - 8;
        picture.append(value(x + 6, y - 7, "start", step, room));
        free = x + 60;
      }
    });
    live.push((t) => { now.setAttribute("x1", X(t)); now.setAttribute("x2", X(t)); });
    const counts = el("p", { class: "counts quiet" });
    live.push((t) => {
      const step = lastAt(steps, t, (s) => s.at);
      counts.textContent = !step || step.total === undefined ? ""
        : evidenceText(subject, steps, step) + (step.phasedOut ? " Phased out." : "");
    });
    return block(heading("How sure was it?", "confidence, moved by evidence"), picture, counts);
  }
  // How often it was right, and which part of that it began with: no test stands behind that.
  function evidenceText(subject, steps, step) {
    const count = (positive, total) => `${shortNumber(positive)} of ${shortNumber(total)}`;
    const right = "Evidence: right " + count(step.positive, step.total);
    // Right often enough, a model is confirmed, and its count begins anew; this may happen again.
    let anew = steps.indexOf(step);
    while (anew > 0 && steps[anew].total >= steps[anew - 1].total) --anew;
    if (anew > 0) return `${right}, counted anew since ${secondsText(steps[anew].at)}, as each time it has been right often enough.`;
    const [first] = steps;
    const began = { given: "given", "by analogy": "inherited by analogy" + (subject.detail.derived_from ? " from " + subject.detail.derived_from : "") }[first.why]
      || (subject.detail.strong ? "the failure it was learned from" : "the observation it was learned from");
    if (step.total === first.total) return `${right}, ${began}; not put to the test yet.`;
    if (first.positive === 1 && first.total === 1 && first.why !== "given") return `${right}, ${began} counted as the first.`;
    return `${right}: ${count(first.positive, first.total)} ${began}, ${count(step.positive - first.positive, step.total - first.total)} since.`;
  }
  function value(x, y, anchor, step, room) {
    const number = sureText(step.sure);
    return svg("text", { class: "value", x, y, "text-anchor": anchor }, svg("title", { text: step.why || "" }), svg("tspan", { text: number }),
      " " + fitted(step.why || "", room - widthOf(number + " ", 12), 11.5));
  }

  // ---- goals and predictions: what came of it
  function outcome(subject) {
    const { result } = subject.detail;
    if (!result) return null;
    const dropped = subject.kind === "goal" && subject.outcome === "open" && [...app.log.eventsOf(subject.number)].find((event) => app.log.kind(event).name === "GoalDropped");
    if (dropped) return block(heading("What came of it?"), el("div", { class: "tree" }, el("div", { class: "line" }, eventRow(app, dropped, { picture: false }))));
    const failed = subject.outcome === "failed";
    const sign = failed ? "cross" : subject.outcome === "true" ? "check" : null;
    const text = el("b", { class: failed ? "fail" : "", text: result });
    const decided = subject.decided ? el("button", { type: "button", class: "link plain", on: { click: () => app.select("#" + subject.decided) } }, text) : text;
    const line = el("p", { class: "verdict" + (failed ? " fail" : "") }, sign ? mark(sign, failed ? "fail" : "") : "", " ", decided);
    const instead = el("p", { class: "verdict" });
    if (failed && subject.kind === "prediction" && subject.decided) {
      app.log.fields(subject.decided).then(({ fields }) => {
        const seen = fields.find((field) => field.name === "evidence");
        instead.append("Seen instead: ", seen ? el("button", { type: "button", class: "link plain", text: seen.text, on: { click: () => app.select(seen.go) } }) : "nothing in time", ".");
      });
    }
    return block(heading("What came of it?"), line, instead);
  }
  function requirements(subject) {
    const list = (title, ids) => (ids && ids.length ? [heading(title), subjectList(ids.slice(0, 40).map((id) => app.subject(id)).filter((one) => one)),
      ids.length > 40 ? el("p", { class: "verdict quiet", text: `and ${ids.length - 40} more` }) : ""] : []);
    const parts = [...list({ prediction: "What said so?", state: "What is expected where it holds?" }[subject.kind] || "When does it work?", subject.detail.requirements),
      ...list(subject.kind === "state" ? "What is denied where it holds?" : "When does it not work?", subject.detail.vetoes)];
    return parts.length ? block(...parts) : null;
  }
  // Where it comes from and where it belongs: the knowledge generalised, the goal served, sub-goals, commands.
  function relatives(subject) {
    const { nested, derived_from: from, model, sub_goals: subGoals, commands, goal } = subject.detail;
    const parts = [];
    const list = (title, ids) => {
      const known = (ids || []).map((id) => app.subject(id)).filter((one) => one);
      if (known.length) parts.push(heading(title), subjectList(known.slice(0, 24)), known.length > 24 ? el("p", { class: "verdict quiet", text: `and ${known.length - 24} more` }) : "");
    };
    if (nested) {
      parts.push(heading("Which states is it made of?"), el("div", { class: "tree" }, ...nested.map(([id, text]) => el("div", { class: "line" },
        el("button", { type: "button", on: { click: () => app.select(id) } }, el("span", { class: "what" }, mark(app.subject(id).mark), el("span", {}, el("b", { text: id }), " " + text)))))));
    }
    list("Generalised from", from ? [from] : []);
    list("For which goal?", goal ? [goal] : subject.parent !== null && subject.parent !== undefined ? [app.report.subjects.id[subject.parent]] : []);
    list("By which model?", model ? [model] : []);
    list("What was wanted for it?", subGoals);
    list("What was done for it?", commands);
    return parts.length ? block(...parts) : null;
  }
  function plans(subject) {
    const list = subject.detail.plans;
    if (!list) return null;
    const rows = list.map((plan) => el("tr", { class: plan.committed ? "" : "missed" },
      el("td", {}, el("button", { type: "button", class: "link plain", text: plan.text || "nothing to do", title: "What was imagined",
        on: { click: () => { app.go(plan.at); app.select(plan.event); app.setView("reasoning"); } } })), el("td", { text: plan.score }),
      el("td", {}, mark(plan.outcome === "reached" ? "check" : "cross"), plan.committed ? "chosen" : plan.outcome.replaceAll("_", " "))));
    return block(heading("What was tried in the head?", "a click shows it"), el("table", { class: "plans" },
      el("thead", {}, el("tr", {}, el("th", { text: "commands" }), el("th", { text: "sure" }), el("th", {}, el("span", { class: "unseen", text: "what came of it" })))), el("tbody", {}, ...rows)));
  }

  // ---- why something did not happen: what was skipped, rejected, refused or contradicted on the way; and which veto won
  function whyNot(subject, reasons) {
    if (!reasons.length) return null;
    const shown = reasons.slice(0, 16);
    const row = ({ first, last, count }) => el("div", { class: "line" },
      eventRow(app, first, { note: count > 1 ? ` ${count} times, until ${secondsText(app.log.time(last))}` : "" }));
    const vetoes = [...new Set(reasons.flatMap((reason) => reason.vetoes))].map((id) => app.subject(id)).filter((one) => one);
    const title = { failed: "Why not?", true: "What held it up?" }[subject.outcome] || "What spoke against it?";
    return block(heading(title, `${reasons.length} ${reasons.length === 1 ? "reason" : "reasons"}`, "part-whynot"),
      el("div", { class: "tree" }, ...shown.map(row)),
      reasons.length > shown.length ? el("p", { class: "verdict quiet", text: `and ${reasons.length - shown.length} more` }) : "",
      vetoes.length ? heading(vetoes.length === 1 ? "Which veto won?" : "Which vetoes won?") : "", subjectList(vetoes.slice(0, 12)));
  }
  // Each reason with how often it came, the first and the last time.
  async function reasonsAgainst(subject) {
    // What came true in the end may have been held up by a veto before; other detours are no reason.
    const reached = subject.outcome === "true";
    if (!["goal", "prediction", "command"].includes(subject.kind) || (reached && subject.kind !== "goal")) return [];
    const { log } = app;
    const goals = subject.kind === "goal" ? withSubGoals(subject.number) : [subject.number];
    const against = new Set();
    const note = (event) => { if (log.against(event)) against.add(event); };
    for (const number of goals) {
      for (const event of log.eventsOf(number)) {
        note(event);
        // Plans that were tried for a goal do not name it when they end.
        if (subject.kind === "goal") for (const effect of log.effects(event)) note(effect);
      }
    }
    // A promise that was not kept stands behind the event that ended it.
    if (subject.decided) for (const cause of log.causes(subject.decided)) for (const event of [cause, ...log.causes(cause)]) note(event);
    // A plan that did not work is told where it was rejected.
    for (const event of [...against]) if (log.kind(event).name === "PlanRejected") for (const cause of log.causes(event)) against.delete(cause);
    const told = [...against].sort((a, b) => a - b).slice(0, 400);
    await log.loadTexts(told);
    const reasons = new Map();
    for (const event of told) {
      const said = (log.textNow(event) || "").replace(/sim_\d+/g, "");
      const known = reasons.get(said);
      if (known) { known.last = event; known.count += 1; } else reasons.set(said, { first: event, last: event, count: 1 });
    }
    const list = await Promise.all([...reasons.values()].slice(0, 40).map(async (reason) => ({ ...reason, vetoes: await vetoesBehind(reason.first) })));
    return reached ? list.filter((reason) => reason.vetoes.length) : list;
  }
  // The strong requirement models that won against what was wanted, as the event's causes name them.
  async function vetoesBehind(event) {
    const { log } = app;
    const causes = { GoalSkipped: () => [...log.causes(event)], PlanRejected: () => [...log.causes(event)].flatMap((ended) => [...log.causes(ended)]) }[log.kind(event).name];
    const says = { ImdlPredicted: "requirement", ChainingDecided: "winner" };
    const fields = await Promise.all((causes ? causes() : []).filter((cause) => log.kind(cause).name in says)
      .map(async (cause) => (await log.fields(cause)).fields.find((field) => field.name === says[log.kind(cause).name])));
    return fields.map((field) => (field ? field.go : "")).filter((id) => app.isVeto(id));
  }
  function withSubGoals(number) {
    if (!app.subGoals) {
      app.subGoals = new Map();
      app.report.subjects.parent.forEach((parent, child) => {
        if (parent === null) return;
        if (!app.subGoals.has(parent)) app.subGoals.set(parent, []);
        app.subGoals.get(parent).push(child);
      });
    }
    const out = [number];
    for (let i = 0; i < out.length && out.length < 200; ++i) out.push(...(app.subGoals.get(out[i]) || []));
    return out;
  }

  // ---- what was compared
  function comparisons(subject, list) {
    if (!list.length) return null;
    const made = subject.detail.made_by_comparison || subject.kind === "event";
    const [first, ...others] = made ? list : [null, ...list];
    const parts = [];
    if (first) {
      parts.push(heading("What was compared?", first.source + " with the scene, " + secondsText(first.at), "part-compared"),
        comparisonTable(app, first), comparisonVerdict(first));
    } else {
      parts.push(heading("What was it compared with?", "", "part-compared"));
    }
    for (const other of others) {
      parts.push(el("details", {}, el("summary", {}, comparisonLine(other)), comparisonTable(app, other), comparisonVerdict(other)));
    }
    const more = (subject.detail.compared || []).length - list.length;
    if (more > 0) parts.push(el("p", { class: "verdict quiet", text: `and ${more} more` }));
    return block(...parts);
  }

  // ---- why, and what it led to
  function why(subject) {
    const root = subject.decided || subject.event;
    if (subject.kind === "thing" || !app.log.causes(root).length) return null;
    const title = { goal: subject.outcome === "open" ? "Why is it wanted?" : "Why did it end so?", command: "Why was it done?",
      prediction: subject.outcome === "open" ? "Why was it expected?" : "Why did it end so?", event: "Why did it happen?" }[subject.kind] || "Why does it exist?";
    return block(heading(title, "down to what was seen", "part-why"), eventTree(app, [root], (event) => [...app.log.causes(event)]));
  }
  function led(subject) {
    if (subject.kind === "thing") return null;
    const roots = effectsWorthALine(app.log, subject.event);
    if (!roots.length) return null;
    const shown = roots.slice(0, 24);
    return block(heading("What did it lead to?", "", "part-led"), eventTree(app, shown, (event) => effectsWorthALine(app.log, event), { open: 0 }),
      roots.length > shown.length ? el("p", { class: "verdict quiet", text: `and ${roots.length - shown.length} more` }) : "");
  }

  // ---- its life: every event that speaks of it
  function happenings(subject) {
    if (subject.number < 0) return null;
    const events = app.log.eventsOf(subject.number);
    if (!events.length) return null;
    const is = (event, name) => app.log.kind(event).name === name;
    // Of a state when it held; of a thing, too, each value that was seen of it anew; of a model every test.
    const tells = { state: (event) => is(event, "IcstFound") }[subject.kind] || ((event) => app.log.worthALine(event) || is(event, "EvidenceUpdated"));
    const told = [...events.subarray(0, 5000)].filter((event) => !app.log.imagined(event) && tells(event));
    const thing = subject.kind === "thing" && app.report.objects.find((one) => "thing:" + one.name === subject.id);
    const life = thing ? [...new Set([...told, ...thing.changes.map((change) => change.event)])].sort((one, other) => one - other) : told;
    // Of a long life rather the turns than every time it was right.
    const turns = life.length > ROWS_OF_A_LIFE ? life.filter((event) => !is(event, "EvidenceUpdated") || app.log.failed(event)) : life;
    const shown = turns.slice(0, ROWS_OF_A_LIFE);
    const all = thing ? `The ${events.length} events that are about it`
      : events.length === 1 ? "The one event that speaks of it" : `All ${events.length} events that speak of it`;
    return block(heading({ thing: "What happened with it?", state: "When did it hold?" }[subject.kind] || "Its life", "", "part-life"),
      el("div", { class: "tree" }, ...shown.map((event) => el("div", { class: "line" }, eventRow(app, event, { picture: false })))),
      life.length > shown.length ? el("p", { class: "verdict quiet", text: `and ${life.length - shown.length} more` }) : "",
      el("button", { type: "button", class: "link all-events", text: all, title: thing ? "Goals, comparisons, predictions and commands; what is seen of it frame by frame is not among them" : "",
        on: { click: () => { app.about(subject); app.setView("events"); } } }));
  }

  // On a narrow page the selection lies far below what was chosen in: a button leads there while it is out of sight.
  const down = $("to-selection");
  down.addEventListener("click", () => { box.scrollIntoView(); });
  new IntersectionObserver(([seen]) => { down.hidden = seen.isIntersecting; }).observe(box);

  return app.add({
    showSelection(subject) {
      // The name of a thing is what it is.
      down.textContent = "\u2193 " + (subject.kind === "thing" ? subject.title : capitalised(subject.title));
      busyWith(draw(subject));
    },
    showTime(t) { for (const part of live) part(t); },
  });
}
