// ---- clock.js: one clock, one selection, one view; all three kept in the address of the page.

const VIEWS = ["overview", "knowledge", "reasoning", "events"];

class App {
  /** @param {Report} report @param {EventLog} log */
  constructor(report, log) {
    this.report = report;
    this.log = log;
    this.panes = [];
    this.t = report.clock.start;
    this.selected = "";   // an id
    this.chosen = null;   // the same with its details, once they are decoded
    this.view = "";
    this.theme = "";
    this.playing = 0;
    /** @type {any} */
    this.player = null;   // the film, where it is a video: it plays by itself
    this.saving = 0;
    this.saved = "";
    this.known = location.hash;   // the address as the page wrote or read it last
    this.more = new Map();   // what else panes keep in the address
    this.frames = report.clock.frames.length ? report.clock.frames : [report.clock.start];
    this.numbers = new Map(report.subjects.id.map((id, number) => [id, number]));
    this.details = new Map();
  }

  // Panes have any of: showTime(t), showSelection(subject), showView(name), showPlaying(on), restore(state).
  add(pane) { this.panes.push(pane); return pane; }

  go(t) {
    this.t = clamp(t, this.report.clock.start, this.report.clock.end);
    for (const pane of this.panes) if (pane.showTime) pane.showTime(this.t);
    this.save();
  }
  get frame() { return frameAt(this.frames, this.t); }
  // What the clock shows, everywhere the same; while it runs, not finer than frames need.
  get clock() { return this.playing ? clockText(this.t) : momentText(this.t); }
  // The frame in which the clock stands: "frame 8", "7.0 to 8.0 s"; null where the run has none.
  get frameWords() {
    const { frames, period } = this.report.clock;
    if (!frames.length) return null;
    const from = frames[this.frame], until = frames[this.frame + 1] ?? from + period;
    return { name: "frame " + (this.frame + 1), span: clockText(from).replace(" s", "") + " to " + clockText(until) };
  }
  // Frame starts, and the very end, are where the steps lead.
  step(by) {
    const n = this.frame;
    if (by < 0 && this.t > this.frames[n]) this.go(this.frames[n]);
    else this.go(this.frames[clamp(n + by, 0, this.frames.length - 1)]);
  }

  // ---- what can be selected: the subjects of the report, and every event

  subjectByNumber(number) {
    const { id, title, kind, mark: sign, born, gone, outcome, event, decided, parent } = this.report.subjects;
    return { number, id: id[number], title: title[number], kind: kind[number], mark: sign[number], born: born[number],
      gone: gone[number], outcome: ["open", "true", "failed"][outcome[number]], event: event[number], decided: decided[number],
      parent: parent[number] };
  }
  subject(id) {
    const number = this.numbers.get(id);
    if (number !== undefined) return this.subjectByNumber(number);
    // A simulation is known by the event that began it.
    const simulation = /^sim_(\d+)$/.exec(id);
    const event = /^#(\d+)$/.exec(simulation ? "#" + this.log.beginningOf(Number(simulation[1])) : id);
    if (!event || !(Number(event[1]) >= 1 && Number(event[1]) <= this.log.count)) return null;
    return this.eventSubject(Number(event[1]));
  }
  eventSubject(event) {
    const kind = this.log.kind(event);
    return { number: -1, id: "#" + event, title: kind.title, kind: "event", mark: this.log.mark(event), born: this.log.time(event),
      gone: null, outcome: this.log.failed(event) ? "failed" : "open", event, decided: 0, parent: null };
  }
  // What the inspector shows of it; the same object each time.
  async detail(subject) {
    const id = subject.id;
    if (!this.details.has(id)) this.details.set(id, this.loadDetail(subject));
    return this.details.get(id);
  }
  async loadDetail(subject) {
    if (subject.kind === "event") {
      const [{ fields, comparison }, say] = await Promise.all([this.log.fields(subject.event), this.log.text(subject.event)]);
      return { note: this.log.imagined(subject.event) ? "in the head, at " + secondsText(subject.born) : "at " + secondsText(subject.born),
        say, fields, comparison, meaning: this.log.kind(subject.event).meaning };
    }
    const size = this.report.subjects.block;
    const block = "subjects-" + Math.floor(subject.number / size);
    this.blocks = this.blocks || new Map();
    if (!this.blocks.has(block)) this.blocks.set(block, blockText(block).then((text) => JSON.parse(text)));
    return (await this.blocks.get(block))[subject.number % size];
  }

  async select(id) {
    const subject = this.subject(id);
    if (!subject) return;
    this.selected = subject.id;
    this.save();
    await Promise.all([this.detail(subject).then((detail) => { subject.detail = detail; }), this.log.loadCauses()]);
    if (this.selected !== subject.id) return;
    this.chosen = subject;
    for (const pane of this.panes) if (pane.showSelection) pane.showSelection(subject);
    this.go(this.t);
  }
  // Selects an event and goes to its moment; where it made or decided what it is about, that, whose "why" is the same.
  open(event) {
    const [first] = this.log.subjectsOf(event);
    const { id, event: made, decided } = this.report.subjects;
    const same = first !== undefined && !this.log.imagined(event) && (made[first] === event || decided[first] === event);
    this.go(this.log.time(event));
    return this.select(same ? id[first] : "#" + event);
  }
  // Whether other knowledge is called the same, so that only its id tells it apart.
  isCalledLikeAnother(number) {
    if (!this.calledSo) {
      const { title, kind } = this.report.subjects;
      this.calledSo = new Map();
      title.forEach((text, i) => { if (["requirement", "model", "state"].includes(kind[i])) this.calledSo.set(text, (this.calledSo.get(text) || 0) + 1); });
    }
    return (this.calledSo.get(this.report.subjects.title[number]) || 0) > 1;
  }
  // The conditions of a requirement model, line by line, as the graph has them.
  conditionsOf(id) {
    if (!this.conditions) {
      this.conditions = new Map();
      for (const band of this.report.graph.bands) for (const card of band.cards) if (card.lines && !this.conditions.has(card.subject)) this.conditions.set(card.subject, card.lines.filter((line) => !line.cut).map((line) => line.text));
    }
    return this.conditions.get(id) || [];
  }
  isVeto(id) {
    this.vetoes = this.vetoes || new Set(this.report.graph.bands.flatMap((band) => band.cards.filter((card) => card.strong).map((card) => card.subject)));
    return this.vetoes.has(id);
  }
  // The title, with the id where the title alone would not do.
  titleOf(number) {
    const { id, title } = this.report.subjects;
    return title[number] + (this.isCalledLikeAnother(number) ? ", " + id[number] : "");
  }
  // Where the selection is in use: since when, until when, and what its variables stand for.
  useAt(subject, t) {
    let found = null;
    for (const use of (subject.detail && subject.detail.uses) || []) if (use[0] <= t && t < use[1]) found = use;
    return found;
  }
  // What its variables stand for, but where it was only compared.
  bindings(subject, t) {
    const use = this.useAt(subject, t);
    return use && use[3] !== USED_IN_COMPARISON && use[2];
  }

  setView(name) {
    const view = VIEWS.includes(name) ? name : VIEWS[0];
    if (view === this.view) return;
    this.view = view;
    document.body.dataset.view = view;
    for (const pane of this.panes) if (pane.showView) pane.showView(view);
    this.save();
  }

  toggle() {
    if (this.playing) {
      clearInterval(this.playing);
      this.playing = 0;
      if (this.player) this.player.stop();
    } else {
      if (this.t >= this.frames[this.frames.length - 1]) this.go(this.frames[0]);
      const stills = this.report.film.stills.map((still) => still.at);
      const stops = [...new Set([...this.frames, ...stills])].sort((a, b) => a - b);
      // A frame a second, faster where there are many.
      const frameMs = clamp(60000 / this.frames.length, 120, 1000);
      const pause = Math.max(40, frameMs * this.frames.length / stops.length);
      // A video keeps time itself, where there is one.
      this.playing = this.player && this.player.start() ? -1 : setInterval(() => {
        const next = stops.find((stop) => stop > this.t);
        if (next === undefined) this.toggle(); else this.go(next);
      }, pause);
    }
    for (const pane of this.panes) if (pane.showPlaying) pane.showPlaying(this.playing !== 0);
    if (!this.playing) this.go(this.t);
  }

  // ---- the address

  address() {
    const state = new URLSearchParams({ t: tickText(this.t), sel: this.selected, view: this.view });
    if (this.theme) state.set("th", this.theme);
    for (const [name, value] of this.more) if (value) state.set(name, value);
    return "#" + state;
  }
  // A pane's own part of the address; gone back from like a selection, unless it changes letter by letter.
  keep(name, value) { this.more.set(name, value); this.save(); }
  place() {
    return [this.selected, this.view, ...[...this.more].sort().map(([name, value]) => name + "=" + (name === "words" ? Boolean(value) : value))].join(" ");
  }
  // Browsers take no more than a few changes of address a second. A new selection, view or filter can be gone back from.
  save() {
    clearTimeout(this.saving);
    document.documentElement.dataset.unsaved = "true";
    this.saving = setTimeout(() => {
      delete document.documentElement.dataset.unsaved;
      const place = this.place();
      const address = this.address();
      // Somebody else changed the address: what it asks for comes next, and is not written over.
      if (address === location.hash || location.hash !== this.known) return;
      if (this.saved && this.saved !== place) history.pushState(null, "", address);
      else history.replaceState(null, "", address);
      this.saved = place;
      this.known = location.hash;
    }, 200);
  }
  async restore() {
    this.known = location.hash;
    const state = new URLSearchParams(location.hash.slice(1));
    this.setTheme(state.get("th") === "dark" || state.get("th") === "light" ? state.get("th") : "");
    const seconds = Number.parseFloat(state.get("t"));
    const wanted = state.get("sel") || "";
    const known = this.subject(wanted);
    const chosen = known ? known.id : this.selected || this.firstChoice();
    $("said").textContent = wanted && !known ? `There is no ${wanted.slice(0, 40).replace(/[^\w:#. -]/g, "?")} here.` : "";
    if (Number.isFinite(seconds)) this.t = clamp(seconds * 1e6, this.report.clock.start, this.report.clock.end);
    else if (!this.selected) this.t = this.firstMoment(this.subject(chosen));
    this.saved = "";
    for (const pane of this.panes) if (pane.restore) pane.restore(state);
    // An address from elsewhere that says what or when, but not where, means what was known then.
    this.setView(state.get("view") || (wanted || Number.isFinite(seconds) ? "knowledge" : this.view || "overview"));
    if (chosen !== this.selected || !this.chosen) await this.select(chosen);
    this.saved = this.place();
    this.go(this.t);
  }
  // Where nobody chose: the first goal that was missed, else the first thing made by analogy, else the first learned,
  // else anything.
  firstChoice() {
    const { drives, lanes, pieces, subjects } = this.report;
    const missed = drives.find((drive) => subjects.outcome[drive.subject] === 2);
    const first = [missed && missed.subject, lanes.analogy.subject[0], lanes.learned.subject[0], (pieces[0] || [])[0]].find((number) => number !== undefined);
    return first !== undefined ? subjects.id[first] : subjects.id[0] || (this.log.count ? "#1" : "");
  }
  // Where nobody said when: when the chosen thing failed, else the first time that experience spoke about it, else when it
  // came about.
  firstMoment(subject) {
    if (!subject) return this.report.clock.start;
    if (subject.outcome === "failed" && subject.decided) return this.log.time(subject.decided);
    const [, ...spoken] = subject.number >= 0 ? this.log.confidence(subject.number) : [];
    const telling = spoken.find((step) => step.failed) || spoken[0];
    return telling ? telling.at : Math.max(subject.born, this.report.clock.start);
  }

  setTheme(theme) {
    this.theme = theme;
    showTheme(theme);
  }
}

// The position of the last frame that begins at or before t; 0 before the first.
function frameAt(frames, t) {
  let low = 0, high = frames.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (frames[middle] <= t) low = middle + 1; else high = middle;
  }
  return Math.max(0, low - 1);
}
