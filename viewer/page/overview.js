// ---- overview.js: the first screen: what was the task, was it reached, what was learned, what went wrong.

function overviewPane(app) {
  const { drives, pieces, film } = app.report;
  const { log } = app;
  const box = $("overview");
  const heading = (text, note) => el("h2", {}, text, note ? el("span", { class: "quiet", text: note }) : "");
  const wide = film.stills.length > 0;

  function driveCard(drive, i) {
    const subject = app.subjectByNumber(drive.subject);
    const failed = subject.outcome === "failed", reached = subject.outcome === "true";
    const done = drive.commands.map((number) => app.subjectByNumber(number));
    const words = reached ? "reached at " + secondsText(drive.until) : failed ? "not reached by " + secondsText(drive.until) : "still open";
    const go = () => { app.select(subject.id); app.go(reached || failed ? drive.until : drive.from); };
    return el("li", { class: "drive" + (failed ? " fail" : "") },
      el("button", { type: "button", class: "drive-button", on: { click: go } },
        wide ? thumbnail(app, reached || failed ? drive.until : drive.from, subject.title + " " + drive.title, "still") : "",
        el("span", { class: "drive-title" }, mark(failed ? "cross" : reached ? "check" : "goal", failed ? "fail" : ""), el("b", { text: `${i + 1}. ${drive.title}` })),
        el("span", { class: "quiet", text: `wanted at ${secondsText(drive.from)}, ${words}` })),
      el("p", { class: "quiet" }, done.length ? "by " : "nothing was done for it",
        ...done.slice(0, 4).flatMap((command, k) => [k ? ", " : "", el("button", { type: "button", class: "link plain", text: command.title, on: { click: () => { app.select(command.id); app.go(command.born); } } })]),
        done.length > 4 ? ` and ${done.length - 4} more` : ""),
      el("p", {}, el("button", { type: "button", class: "link", text: "how it looked for a way", on: { click: () => { app.go(drive.from); app.select(subject.id); app.setView("reasoning"); } } })));
  }

  function pieceRow([number]) {
    const subject = app.subjectByNumber(number);
    const steps = log.confidence(number);
    const last = steps[steps.length - 1];
    // A change of state is a step, too, but no test.
    const tried = steps.filter((step) => log.kind(step.event).name === "EvidenceUpdated").length;
    const sure = !last ? "" : last.deleted ? "given up at " + secondsText(last.at) : last.phasedOut ? "phased out" : sureText(last.sure);
    return el("tr", { class: last && last.deleted ? "gone" : "" },
      el("td", {}, el("button", { type: "button", class: "link plain", on: { click: () => { app.select(subject.id); app.go(subject.born); } } }, mark(subject.mark), capitalised(subject.title), " ", el("span", { class: "id", text: subject.id })),
        // What tells it from others that are called the same.
        app.isCalledLikeAnother(number) ? el("span", { class: "quiet apart", text: "if " + app.conditionsOf(subject.id).join(", ") }) : ""),
      el("td", { text: secondsText(subject.born) }), el("td", { text: tried > 0 ? String(tried) : "" }), el("td", {}, el("b", { text: sure })));
  }

  // What went wrong, most telling first: goals missed, predictions that failed, commands refused; then what was
  // given up, which often is how it went right again.
  function troubles() {
    const order = ["GoalFailed", "PredictionFailed", "CommandRefused", "ModelStateChanged"];
    const out = [];
    for (let event = 1; event <= log.count; ++event) {
      if (log.imagined(event)) continue;
      const kind = order.indexOf(log.kind(event).name);
      if (kind < 0) continue;
      const [subject] = log.subjectsOf(event);
      // Predictions of requirement models, and goals on the way, are not counted in the heading either.
      if ((kind === 0 || kind === 1) && !log.chapter(event)) continue;
      // Coming back into use is none.
      if (kind === 3 && (subject === undefined || !(stepOf(event).deleted || stepOf(event).phasedOut))) continue;
      out.push({ event, kind });
    }
    return out.sort((a, b) => a.kind - b.kind || a.event - b.event).map((one) => one.event);
  }

  // What a change of state did to the model.
  function stepOf(event) {
    const [number] = log.subjectsOf(event);
    return log.confidence(number).find((step) => step.event === event) || {};
  }

  // What an id in the sentence is about.
  function about(event) {
    if (log.kind(event).name !== "ModelStateChanged") return "";
    const [number] = log.subjectsOf(event);
    return number === undefined ? "" : " (" + app.report.subjects.title[number] + ")";
  }

  const troubleRow = (event) => el("div", { class: "line" }, eventRow(app, event, { note: about(event) }));
  // Several that were given up, in one line that opens.
  function retirements(events) {
    const rows = el("div", { class: "tree" });
    const [first, last] = [events[0], events[events.length - 1]].map((event) => secondsText(log.time(event)));
    const details = el("details", { class: "retired" },
      el("summary", { text: `${events.length} pieces of knowledge were given up` + (first === last ? " at " + first : `, from ${first} to ${last}`) }), rows);
    details.addEventListener("toggle", () => { if (details.open && !rows.childElementCount) rows.append(...events.slice(0, 200).map(troubleRow)); });
    return details;
  }

  const learned = pieces.filter(([, own]) => own);
  const givenUp = learned.filter(([number]) => app.subjectByNumber(number).gone !== null).length;
  const happened = troubles();
  const givenUpLater = happened.filter((event) => log.kind(event).name === "ModelStateChanged" && stepOf(event).deleted);
  const folded = new Set(givenUpLater.length > 2 ? givenUpLater : []);
  const wrong = happened.filter((event) => !folded.has(event));
  const reached = drives.filter((drive) => drive.outcome === 1).length;
  const shownPieces = learned.slice(0, 40), shownWrong = wrong.slice(0, 10);
  box.append(...[
    app.report.story ? el("p", { class: "told", text: app.report.story }) : "",
    heading("What was to be done?", drives.length ? `${reached} of ${drives.length} reached` : "nothing was asked of it"),
    el("ol", { class: "drives" + (wide ? "" : " plain") }, ...drives.slice(0, 24).map(driveCard)),
    drives.length > 24 ? el("p", { class: "quiet", text: `and ${drives.length - 24} more, in the lane of goals` }) : "",
    heading("What went wrong?", happened.length ? `${happened.length} ${happened.length === 1 ? "event" : "events"}` : ""),
    happened.length ? el("div", { class: "tree" }, ...shownWrong.map(troubleRow))
      : el("p", { class: "quiet", text: "Nothing: no goal was missed, no prediction failed, no command was refused." }),
    wrong.length > shownWrong.length ? el("p", { class: "quiet", text: `and ${wrong.length - shownWrong.length} more` }) : "",
    folded.size ? retirements([...folded]) : "",
    heading("What was learned?", `${learned.length} ${learned.length === 1 ? "piece" : "pieces"} of knowledge` + (givenUp ? `, ${givenUp} given up` : "")),
    learned.length ? el("table", { class: "pieces" }, el("thead", {}, el("tr", {}, el("th", { text: "when this works" }), el("th", { text: "learned" }), el("th", { text: "tried", title: "How often it was put to the test since; what it was learned from is not counted" }), el("th", { text: "sure at the end" }))),
      el("tbody", {}, ...shownPieces.map(pieceRow))) : "",
    learned.length > shownPieces.length ? el("p", { class: "quiet", text: `and ${learned.length - shownPieces.length} more, under Knowledge` }) : "",
  ].filter((node) => node));
  return app.add({});
}
