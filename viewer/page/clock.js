// ---- clock.js: one clock, one selection, kept in the address of the page.

class App {
  constructor(report) {
    this.report = report;
    this.panes = [];
    this.t = report.clock.start;
    this.selected = "";
    this.playing = 0;
    this.saving = 0;
    this.frames = report.clock.frames.length ? report.clock.frames : [report.clock.start];
  }

  // Panes have any of: showTime(t), showSelection(id).
  add(pane) { this.panes.push(pane); return pane; }

  go(t) {
    this.t = clamp(t, this.report.clock.start, this.report.clock.end);
    for (const pane of this.panes) if (pane.showTime) pane.showTime(this.t);
    this.save();
  }
  get frame() {
    const start = lastAt(this.frames, this.t, (at) => at);
    return Math.max(0, this.frames.indexOf(start));
  }
  // Frame starts, and the very end, are where the steps lead.
  step(by) {
    const n = this.frame;
    if (by < 0 && this.t > this.frames[n]) this.go(this.frames[n]);
    else this.go(this.frames[clamp(n + by, 0, this.frames.length - 1)]);
  }

  subject(id) {
    const real = this.report.aliases[id] || id;
    return Object.hasOwn(this.report.subjects, real) ? this.report.subjects[real] : null;
  }
  select(id) {
    const subject = this.subject(id);
    if (!subject) return;
    this.selected = subject.id;
    for (const pane of this.panes) if (pane.showSelection) pane.showSelection(subject);
    this.go(this.t);
  }
  // What the variables of the selection stand for now.
  bindings(subject, t) {
    let found = null;
    for (const use of subject.uses || []) if (use[0] <= t && t < use[1]) found = use[2];
    return found;
  }

  toggle() {
    if (this.playing) {
      clearInterval(this.playing);
      this.playing = 0;
    } else {
      if (this.t >= this.frames[this.frames.length - 1]) this.go(this.frames[0]);
      const stills = this.report.film.stills.map((still) => still.at);
      const stops = [...new Set([...this.frames, ...stills])].sort((a, b) => a - b);
      // A frame a second, faster where there are many.
      const frameMs = clamp(60000 / this.frames.length, 120, 1000);
      const pause = Math.max(40, frameMs * this.frames.length / stops.length);
      this.playing = setInterval(() => {
        const next = stops.find((stop) => stop > this.t);
        if (next === undefined) this.toggle(); else this.go(next);
      }, pause);
    }
    for (const pane of this.panes) if (pane.showPlaying) pane.showPlaying(this.playing !== 0);
  }

  // Browsers take no more than a few changes of address a second.
  save() {
    clearTimeout(this.saving);
    this.saving = setTimeout(() => {
      const state = new URLSearchParams({ t: tickText(this.t), sel: this.selected });
      if (this.theme) state.set("th", this.theme);
      history.replaceState(null, "", "#" + state);
    }, 200);
  }
  restore() {
    const state = new URLSearchParams(location.hash.slice(1));
    this.setTheme(state.get("th") === "dark" || state.get("th") === "light" ? state.get("th") : "");
    const seconds = Number.parseFloat(state.get("t"));
    if (Number.isFinite(seconds)) this.t = clamp(seconds * 1e6, this.report.clock.start, this.report.clock.end);
    const wanted = state.get("sel") || "";
    const chosen = this.subject(wanted) ? wanted : this.selected || this.firstChoice();
    if (!Number.isFinite(seconds) && !this.selected) this.t = this.firstMoment(this.subject(chosen));
    this.select(chosen);
    this.go(this.t);
  }
  // Where nobody chose: the first thing made by analogy, else the first learned, else anything.
  firstChoice() {
    const { lanes, pieces, subjects } = this.report;
    const first = lanes.analogy[0] || lanes.taught[0] || pieces[0];
    return first ? first.subject : Object.keys(subjects)[0] || "";
  }

  // Where nobody said when: the first time that experience spoke about the chosen thing, else when it came about.
  firstMoment(subject) {
    if (!subject) return this.report.clock.start;
    const spoken = (subject.confidence || [])[1];
    return spoken ? spoken.at : Math.max(subject.born, this.report.clock.start);
  }

  setTheme(theme) {
    this.theme = theme;
    const dark = theme ? theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    document.documentElement.dataset.theme = dark ? "dark" : "light";
  }
}
