// ---- log.js: every event of the run. Kinds, times and what each event speaks of are there at once; causes,
// sentences and fields are decoded when they are asked for. Events are known by their number, from 1.

const SIGN = { chapter: 7, failed: 8, imagined: 16, worthALine: 32, against: 64 };
const CHAPTERS = ["", "goal", "command", "prediction", "learned", "analogy"];

class EventLog {
  constructor(description, bytes, subjectCount) {
    const n = description.count;
    this.count = n;
    this.chunk = description.chunk;
    this.kinds = description.kinds;
    this.marks = description.marks;
    const columns = new ColumnReader(bytes);
    this.kindOf = columns.take(n);
    this.signOf = columns.take(n);
    this.markOf = columns.take(n);
    this.timeOf = new Float64Array(n);
    for (let i = 0, t = 0; i < n; ++i) this.timeOf[i] = t += columns.signed();
    this.simulationOf = new Uint32Array(n);
    for (let i = 0; i < n; ++i) this.simulationOf[i] = columns.unsigned();
    this.inKindOrder = eventsByKind(this.kindOf, this.kinds.length);
    this.mentions = readLists(columns, this.inKindOrder, (_, value) => value);
    this.readSure(columns, subjectCount);
    this.pages = new Map();     // decoded chunks by the name of their block
    this.frameFirst = this.ofKind("FrameStarted");
  }

  kindNumber(name) { return this.kinds.findIndex((kind) => kind.name === name); }
  // Numbers of the events of one kind, in order.
  ofKind(name) {
    const kind = this.kindNumber(name);
    const out = [];
    for (let i = 0; i < this.count; ++i) if (this.kindOf[i] === kind) out.push(i + 1);
    return out;
  }
  kind(event) { return this.kinds[this.kindOf[event - 1]]; }
  time(event) { return this.timeOf[event - 1]; }
  mark(event) { return this.marks[this.markOf[event - 1]]; }
  failed(event) { return (this.signOf[event - 1] & SIGN.failed) !== 0; }
  imagined(event) { return (this.signOf[event - 1] & SIGN.imagined) !== 0; }
  worthALine(event) { return (this.signOf[event - 1] & SIGN.worthALine) !== 0; }
  // Whether it says why something did not happen.
  against(event) { return (this.signOf[event - 1] & SIGN.against) !== 0; }
  chapter(event) { return CHAPTERS[this.signOf[event - 1] & SIGN.chapter]; }
  simulation(event) { return this.simulationOf[event - 1]; }
  // The event that began a simulation; 0 if there is none.
  beginningOf(simulation) { return simulation > 0 ? this.simulationOf.indexOf(simulation) + 1 : 0; }
  // Numbers of the subjects it speaks of, the first most of all.
  subjectsOf(event) { return this.mentions.list.subarray(this.mentions.start[event - 1], this.mentions.start[event]); }

  // First and last event of a frame, by its position.
  ofFrame(frame) {
    const first = this.frameFirst[frame] || 1;
    const next = this.frameFirst[frame + 1];
    return [first, next ? next - 1 : this.count];
  }

  // The events that speak of a subject, in order.
  eventsOf(subject) {
    if (!this.spokenOf) {
      const { start, list } = this.mentions;
      this.spokenOf = invert(this.count, start, list, this.subjectCount);
    }
    return this.spokenOf.list.subarray(this.spokenOf.start[subject], this.spokenOf.start[subject + 1]);
  }

  // ---- confidence

  readSure(columns, subjectCount) {
    this.subjectCount = subjectCount;
    const start = new Uint32Array(subjectCount + 1);
    const at = [], sure = [], bits = [], event = [];
    for (let subject = 0; subject < subjectCount; ++subject) {
      start[subject] = at.length;
      const steps = columns.unsigned();
      for (let i = 0, t = 0, e = 0; i < steps; ++i) {
        at.push(t += columns.signed());
        sure.push(columns.unsigned() / 10000);
        bits.push(columns.take(1)[0]);
        event.push(e += columns.signed());
      }
    }
    start[subjectCount] = at.length;
    this.sure = { start, at, value: sure, bits, event };
  }
  // The steps of a subject's confidence: when, how sure from then on, by which event, what else is true of it.
  confidence(subject) {
    const { start, at, value, bits, event } = this.sure;
    const steps = [];
    for (let i = start[subject]; i < start[subject + 1]; ++i) {
      steps.push({ at: at[i], sure: value[i], event: event[i], failed: (bits[i] & 1) !== 0, deleted: (bits[i] & 2) !== 0,
        strong: (bits[i] & 4) !== 0, phasedOut: (bits[i] & 8) !== 0 });
    }
    return steps;
  }
  // How sure at a time; null before it was known.
  sureAt(subject, t) {
    const step = this.stepAt(subject, t);
    return step < 0 ? null : this.sure.value[step];
  }
  phasedOutAt(subject, t) {
    const step = this.stepAt(subject, t);
    return step >= 0 && (this.sure.bits[step] & 8) !== 0;
  }
  // Position of the last step at or before t; -1 before the first.
  stepAt(subject, t) {
    const { start, at } = this.sure;
    let low = start[subject], high = start[subject + 1];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (at[middle] <= t) low = middle + 1; else high = middle;
    }
    return low > start[subject] ? low - 1 : -1;
  }

  // ---- causes and effects, once loadCauses() is done

  async loadCauses() {
    if (!this.causesLoading) {
      this.causesLoading = blockBytes("log-causes").then((bytes) => {
        this.causesOf = readLists(new ColumnReader(bytes), this.inKindOrder, (event, back) => (back ? event - back : 0));
        const { start, list } = this.causesOf;
        this.effectsOf = invert(this.count, start, list, this.count + 1);
      });
    }
    return this.causesLoading;
  }
  causes(event) {
    const { start, list } = this.causesOf;
    return list.subarray(start[event - 1], start[event]).filter((cause) => cause > 0);
  }
  effects(event) { return this.effectsOf.list.subarray(this.effectsOf.start[event], this.effectsOf.start[event + 1]); }

  // ---- sentences and fields

  // A decoded chunk: sentences by their event's place in the chunk, or the columns of fields of each kind.
  async page(block, decode) {
    let page = this.pages.get(block);
    if (!page) {
      page = { content: null, loading: null };
      page.loading = blockBytes(block).then((bytes) => { page.content = decode(new TextColumnReader(bytes)); });
      this.pages.set(block, page);
      // Not more than a few megabytes of text are kept.
      if (this.pages.size > 48) {
        const oldest = [...this.pages].find(([, old]) => old.content);
        if (oldest) this.pages.delete(oldest[0]);
      }
    }
    await page.loading;
    return page.content;
  }
  get chunks() { return Math.ceil(this.count / this.chunk); }
  chunkOf(event) { return Math.floor((event - 1) / this.chunk); }
  // The events of a chunk, kind by kind: [{ kind, events }, ...].
  kindsOfChunk(chunk) {
    const first = chunk * this.chunk + 1, last = Math.min(first + this.chunk - 1, this.count);
    const { order, start } = eventsByKind(this.kindOf.subarray(first - 1, last), this.kinds.length);
    const out = [];
    for (let kind = 0; kind < this.kinds.length; ++kind) {
      if (start[kind] < start[kind + 1]) out.push({ kind, events: order.subarray(start[kind], start[kind + 1]).map((event) => event + first - 1) });
    }
    return out;
  }
  // The sentences of a chunk, by their event's place in it.
  sentences(chunk) {
    return this.page("text-" + chunk, (columns) => {
      const lines = new Array(this.chunk).fill("");
      for (const { events } of this.kindsOfChunk(chunk)) columns.next(events).forEach((text, i) => { lines[(events[i] - 1) % this.chunk] = text; });
      return lines;
    });
  }
  // The sentence, if it is decoded; undefined otherwise.
  textNow(event) {
    const page = this.pages.get("text-" + this.chunkOf(event));
    return page && page.content ? page.content[(event - 1) % this.chunk] : undefined;
  }
  async text(event) {
    const lines = await this.sentences(this.chunkOf(event));
    return lines[(event - 1) % this.chunk];
  }
  // Sees to it that textNow() knows these events.
  async loadTexts(events) {
    const chunks = new Set();
    for (const event of events) if (this.textNow(event) === undefined) chunks.add(this.chunkOf(event));
    await Promise.all([...chunks].map((chunk) => this.sentences(chunk)));
  }
  // What the event says: [{name, meaning, text, go}] and, of a comparison, its table.
  async fields(event) {
    const chunk = this.chunkOf(event);
    const kinds = await this.page("fields-" + chunk, (columns) => this.kindsOfChunk(chunk).map(({ kind, events }) => {
      const fields = this.kinds[kind].fields.map(() => ({ texts: columns.next(events), links: columns.next(events) }));
      const comparisons = this.kinds[kind].name === "AnalogyCompared" ? columns.next(events) : null;
      return { kind, events, fields, comparisons };
    }));
    const { events, fields, comparisons } = kinds.find((one) => one.kind === this.kindOf[event - 1]);
    const row = events.indexOf(event);
    const out = [];
    this.kind(event).fields.forEach(([name, meaning], i) => {
      const text = fields[i].texts[row];
      if (text !== null) out.push({ name, meaning, text, go: fields[i].links[row] || "" });
    });
    return { fields: out, comparison: comparisons ? JSON.parse(comparisons[row]) : null };
  }
}

// Events (by number, from 1) kind by kind, and where each kind begins.
function eventsByKind(kindOf, kinds) {
  const start = new Uint32Array(kinds + 1);
  for (const kind of kindOf) ++start[kind + 1];
  for (let kind = 0; kind < kinds; ++kind) start[kind + 1] += start[kind];
  const place = start.slice();
  const order = new Uint32Array(kindOf.length);
  for (let i = 0; i < kindOf.length; ++i) order[place[kindOf[i]]++] = i + 1;
  return { order, start };
}
// A list of numbers for each event, written kind by kind: where each list begins, and all of them.
function readLists(columns, { order, start: kindStart }, valueOf) {
  const n = order.length;
  const start = new Uint32Array(n + 1);
  for (const event of order) start[event] = columns.unsigned();
  for (let i = 0; i < n; ++i) start[i + 1] += start[i];
  const list = new Uint32Array(start[n]);
  for (let kind = 0; kind + 1 < kindStart.length; ++kind) {
    let rows = order.subarray(kindStart[kind], kindStart[kind + 1]);
    for (let place = 0; ; ++place) {
      rows = rows.filter((event) => start[event - 1] + place < start[event]);
      if (!rows.length) break;
      let value = 0;
      for (const event of rows) {
        value += columns.signed();
        list[start[event - 1] + place] = valueOf(event, value);
      }
    }
  }
  return { start, list };
}
// Of lists that say what each event names: for each named number, the events that name it, in order.
function invert(n, start, list, size) {
  const begin = new Uint32Array(size + 1);
  for (const value of list) ++begin[value + 1];
  for (let i = 0; i < size; ++i) begin[i + 1] += begin[i];
  const place = begin.slice();
  const out = new Uint32Array(list.length);
  for (let i = 0; i < n; ++i) for (let k = start[i]; k < start[i + 1]; ++k) out[place[list[k]]++] = i + 1;
  return { start: begin, list: out };
}
