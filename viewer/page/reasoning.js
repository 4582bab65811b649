// ---- reasoning.js: what the agent thought in the frame at the cursor: forward, from what was seen to what it
// expected; backward, from what was wanted to the plans it tried in the head, the chosen one and the others.

const CHAIN = ["this happened", "while this held", "so this model applies", "expected", "and then"];
const LOOKED_AT = 200;   // goals of one frame that are drawn as a tree

function reasoningPane(app) {
  const { log } = app;
  const box = $("reasoning");
  let drawn = -1;
  const heading = (text, note) => el("h2", {}, text, note ? el("span", { class: "quiet", text: note }) : "");
  const named = (event, name) => log.kind(event).name === name;

  function draw(frame) {
    drawn = frame;
    const [first, last] = log.ofFrame(frame);
    const events = [];
    for (let event = first; event <= last; ++event) if (!["WorldStateRecorded", "FrameCounted", "FrameStarted"].includes(log.kind(event).name)) events.push(event);
    const parts = [...forward(events), ...learning(events), ...backward(events)];
    box.replaceChildren(...(parts.length ? parts : [el("p", { class: "empty", text: "Nothing was thought in this frame." })]));
    markSelected();
  }
  const cell = (event, more) => {
    const button = el("button", { type: "button", class: "cell" + (log.failed(event) ? " fail" : "") + (more || ""), on: { click: () => app.open(event) } },
      mark(log.failed(event) ? "cross" : log.mark(event), log.failed(event) ? "fail" : ""), eventSentence(app, event));
    button.dataset.event = event;
    return button;
  };

  // ---- forward: input and conditions, the model they allow, what it expects, what came
  function forward(events) {
    const out = [];
    const made = events.filter((event) => named(event, "PredictionMade") && !log.imagined(event));
    const decided = events.filter((event) => named(event, "ChainingDecided") && !log.imagined(event));
    const held = events.filter((event) => named(event, "IcstFound") && !log.imagined(event));
    const allowed = events.filter((event) => named(event, "ImdlPredicted") && !log.imagined(event));
    const came = events.filter((event) => (named(event, "PredictionSucceeded") || named(event, "PredictionFailed") || named(event, "PredictionInvalidated")) && !log.imagined(event));
    if (came.length) {
      out.push(heading("What came of what it had expected?"), el("div", { class: "tree" }, ...came.slice(0, 24).map((event) => el("div", { class: "line" }, eventRow(app, event, { picture: false })))));
      if (came.length > 24) out.push(el("p", { class: "quiet", text: `and ${came.length - 24} more` }));
    }
    if (made.length) {
      const rows = made.slice(0, 24).map((prediction) => {
        const causes = [...log.causes(prediction)];
        const statements = causes.filter((cause) => named(cause, "ImdlPredicted"));
        const states = statements.flatMap((cause) => [...log.causes(cause)].filter((state) => named(state, "IcstFound")));
        const inputs = causes.filter((cause) => ["FactObserved", "ImdlFired", "PredictionMade", "CommandIssued"].includes(log.kind(cause).name));
        const outcome = [...log.effects(prediction)].filter((effect) => ["PredictionSucceeded", "PredictionFailed", "PredictionInvalidated"].includes(log.kind(effect).name));
        const list = (items) => (items.length ? items.slice(0, 4).map((event) => cell(event)) : [el("span", { class: "quiet", text: "\u2013" })]);
        // What denied it stands apart from what allowed it.
        const denies = (event) => [...log.subjectsOf(event)].some((number) => app.isVeto(app.report.subjects.id[number]));
        const against = statements.filter(denies);
        const said = [...list(statements.filter((event) => !denies(event))),
          ...(against.length ? [el("span", { class: "quiet against", text: "and this spoke against it:" }), ...list(against)] : [])];
        return el("tr", {}, ...[list(inputs), list(states), said, [cell(prediction)], list(outcome.slice(0, 1))].map((items, i) => el("td", { "data-question": CHAIN[i] }, ...items)));
      });
      out.push(heading("What did it expect, and why?", `${made.length} ${made.length === 1 ? "prediction" : "predictions"}`),
        el("div", { class: "wide" }, el("table", { class: "chain" }, el("thead", {}, el("tr", {}, ...CHAIN.map((text) => el("th", { text })))), el("tbody", {}, ...rows))));
      if (made.length > 24) out.push(el("p", { class: "quiet", text: `and ${made.length - 24} more` }));
    }
    const silent = decided.filter((event) => ![...log.effects(event)].some((effect) => named(effect, "PredictionMade")) && !made.some((prediction) => {
      const mine = new Set(log.subjectsOf(prediction));
      return mine.has(log.subjectsOf(event)[0]) && Math.abs(prediction - event) <= 3;
    }));
    if (silent.length) {
      out.push(el("details", {}, el("summary", {}, `What did not apply, and why (${silent.length})`),
        el("div", { class: "tree" }, ...silent.slice(0, 40).map((event) => el("div", { class: "line" }, eventRow(app, event, { picture: false }))))));
    }
    if (held.length) {
      out.push(el("details", {}, el("summary", {}, `What held: ${held.length} ${held.length === 1 ? "condition" : "conditions"}; ${allowed.length === 1 ? "1 requirement model" : allowed.length + " requirement models"} spoke for or against a model`),
        el("div", { class: "tree" }, ...[...held, ...allowed].slice(0, 80).map((event) => el("div", { class: "line" }, eventRow(app, event, { picture: false })))),
        held.length + allowed.length > 80 ? el("p", { class: "quiet", text: `and ${held.length + allowed.length - 80} more, in the list of events` }) : ""));
    }
    return out;
  }

  // ---- learning: what it looked for, which causes it considered
  function learning(events) {
    const started = events.filter((event) => named(event, "InductionStarted"));
    if (!started.length) return [];
    const below = (event) => [...log.effects(event)].filter((effect) => ["CauseConsidered", "ModelRejected", "ModelCreated", "CompositeStateCreated"].includes(log.kind(effect).name));
    return [heading("What surprised it, and what did it make of that?"), eventTree(app, started.slice(0, 12), below, { open: 16, picture: false })];
  }

  // ---- backward: goals below the drive, what was not pursued, what was compared, the plans tried
  function backward(events) {
    const nodes = new Map();   // subject number of a goal -> its node
    const inOrder = [];
    const { parent, kind, event: madeBy } = app.report.subjects;
    const node = (goal) => {
      if (nodes.has(goal)) return nodes.get(goal);
      const one = { goal, children: [], rows: [], plans: [] };
      nodes.set(goal, one);
      if (parent[goal] !== null && nodes.size < LOOKED_AT) node(parent[goal]).children.push(one); else inOrder.push(one);
      return one;
    };
    const goalOf = (event) => [...log.subjectsOf(event)].find((number) => kind[number] === "goal");
    const plans = new Map();   // simulation -> plan
    for (const event of events) {
      const name = log.kind(event).name;
      const goal = goalOf(event);
      if (name === "SimulationStarted") {
        const plan = { event, end: 0, why: 0, chosen: 0, steps: [] };
        plans.set(log.simulation(event), plan);
        if (goal !== undefined) node(goal).plans.push(plan);
      } else if (log.imagined(event)) {
        const plan = plans.get(log.simulation(event));
        if (plan && name === "SimulationEnded") plan.end = event; else if (plan) plan.steps.push(event);
      } else if (name === "PlanRejected" || name === "PlanCommitted") {
        const ended = [...log.causes(event)].map((cause) => plans.get(log.simulation(cause))).find((plan) => plan);
        if (ended) { if (name === "PlanCommitted") ended.chosen = event; else ended.why = event; } else if (goal !== undefined) node(goal).rows.push(event);
      } else if (goal !== undefined) {
        if (["GoalSet", "DriveInjected"].includes(name)) { if (nodes.size < LOOKED_AT) node(goal); } else node(goal).rows.push(event);
      }
    }
    const wanted = inOrder.filter((one) => one.children.length || one.plans.length || one.rows.length || log.kind(madeBy[one.goal]).name === "DriveInjected");
    if (!wanted.length) return [];
    const count = plans.size;
    return [heading("What did it want, and how did it look for a way?", count ? `${count} ${count === 1 ? "plan" : "plans"} tried in the head` : ""),
      el("ul", { class: "tree goals" }, ...wanted.map(goalNode))];
  }
  function goalNode(one) {
    const subject = app.subjectByNumber(one.goal);
    const failed = subject.outcome === "failed";
    const button = el("button", { type: "button", class: failed ? "fail" : "", on: { click: () => app.select(subject.id) } },
      el("span", { class: "what" }, mark(failed ? "cross" : "goal", failed ? "fail" : ""), eventSentence(app, subject.event)),
      el("span", { class: "quiet", text: subject.outcome === "true" ? "reached" : failed ? "missed" : "" }));
    button.dataset.subject = subject.id;
    const item = el("li", {}, el("div", { class: "line" }, el("span", { class: "twist" }), button));
    const below = [...one.rows.filter((event) => !["GoalAchieved", "GoalFailed"].includes(log.kind(event).name)).slice(0, 30).map((event) => el("li", {}, el("div", { class: "line" }, el("span", { class: "twist" }), eventRow(app, event, { picture: false })))),
      ...one.plans.map(planNode), ...one.children.map(goalNode)];
    if (below.length) item.append(el("ul", {}, ...below));
    return item;
  }
  // A plan: chosen, or why not; unfolded, what it imagined step by step.
  function planNode(plan) {
    const failed = plan.end && log.failed(plan.end);
    const verdict = plan.chosen ? "chosen" : plan.why || failed ? "" : plan.end ? "would have worked, but was not chosen" : "not chosen";
    // One that would have worked has no cross.
    const summary = el("summary", {}, mark(plan.chosen ? "check" : failed || !plan.end ? "cross" : "goal"), " ", eventSentence(app, plan.event), verdict ? el("b", { text: " " + verdict }) : "");
    summary.dataset.event = plan.event;
    const rows = [...plan.steps, plan.end, plan.why, plan.chosen].filter((event) => event);
    return el("li", {}, el("details", { class: "tried imagined" + (plan.chosen ? " chosen" : "") }, summary,
      el("p", { class: "quiet", text: "In the head, not in the world:" }),
      el("div", { class: "tree" }, ...rows.slice(0, 120).map((event) => el("div", { class: "line" }, eventRow(app, event, { picture: false })))),
      el("button", { type: "button", class: "link", text: "Select this plan", on: { click: () => app.select("#" + plan.event) } })));
  }

  function markSelected() {
    const event = /^#(\d+)$/.exec(app.selected);
    for (const node of box.querySelectorAll("[data-event], [data-subject]")) {
      const on = (event && node.dataset.event === event[1]) || node.dataset.subject === app.selected;
      node.classList.toggle("current", Boolean(on));
      // The plan that was asked for is open.
      if (on && node.tagName === "SUMMARY") node.parentElement.open = true;
      // What lies below a goal is what was asked for.
      if (on && pane.bringSelected) node.scrollIntoView({ block: node.dataset.subject ? "start" : "nearest" });
    }
    pane.bringSelected = false;
  }

  const waiting = new Later();
  let changed = -Infinity;
  const title = $("reasoning-title");
  const pane = {
    bringSelected: false,
    showTime() {
      if (app.view !== "reasoning" || !log.causesOf) return;
      title.textContent = "What it thought at " + app.clock;
      const words = app.frameWords;
      $("reasoning-part").textContent = words ? `${words.name}, all of it: ${words.span}` : "";
      if (app.frame === drawn) return;
      // While time runs or is dragged, a frame is drawn only if it stays.
      waiting.cancel();
      const now = performance.now();
      if (now - changed > 150) draw(app.frame); else waiting.ask(90, () => { if (app.frame !== drawn) draw(app.frame); });
      changed = now;
    },
    showView(view) { if (view === "reasoning") { pane.bringSelected = true; pane.showTime(); markSelected(); } },
    showSelection() { if (app.view === "reasoning") { pane.bringSelected = true; pane.showTime(); markSelected(); } },
  };
  return app.add(pane);
}
