// ---- list.js: a list of any length, of which only the rows in sight are in the page.

const LONGEST_SCROLL = 8e6;   // pixels; browsers end somewhere above

// `row(i)` makes the i-th row, `height` pixels high.
class LongList {
  constructor(box, height, row) {
    this.box = box;
    this.height = height;
    this.row = row;
    this.count = 0;
    this.inside = el("div", { class: "long-inside" });
    this.rows = el("div", { class: "long-rows" });
    this.inside.append(this.rows);
    box.append(this.inside);
    box.addEventListener("scroll", () => this.draw());
    new ResizeObserver(() => this.draw()).observe(box);
  }
  // A list beyond the longest scroll goes faster than the finger.
  get total() { return Math.min(this.count * this.height, LONGEST_SCROLL); }
  get room() { return Math.max(1, this.box.clientHeight); }
  get first() {
    const scrollable = Math.max(1, this.total - this.room);
    return this.box.scrollTop / scrollable * Math.max(0, this.count - this.room / this.height);
  }
  set(count) {
    this.count = count;
    this.inside.style.height = this.total + "px";
    this.draw();
  }
  // The row with this position in the middle of what is seen.
  show(i) {
    const most = Math.max(0, this.count - this.room / this.height);
    const top = clamp(i - this.room / this.height / 2 + 0.5, 0, most);
    this.box.scrollTop = most > 0 ? top / most * Math.max(0, this.total - this.room) : 0;
    this.draw();
  }
  inSight(i) { return i >= this.first && i + 1 <= this.first + this.room / this.height; }
  draw() {
    const from = Math.max(0, Math.floor(this.first));
    const to = Math.min(this.count, Math.ceil(this.first + this.room / this.height) + 1);
    const rows = [];
    for (let i = from; i < to; ++i) rows.push(this.row(i));
    this.rows.style.transform = `translateY(${this.box.scrollTop - (this.first - from) * this.height}px)`;
    this.rows.replaceChildren(...rows);
  }
}
