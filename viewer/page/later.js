// ---- later.js: what is done a little later, and counts as on its way until then.

// An action put off by some milliseconds. Asked again before that, only the last asked for is done.
class Later {
  constructor() {
    this.timer = 0;
    /** @type {(value?: any) => void} */
    this.end = () => {};
  }
  ask(delay, action) {
    this.cancel();
    busyWith(new Promise((resume) => {
      this.end = resume;
      this.timer = setTimeout(() => { action(); resume(); }, delay);
    }));
  }
  cancel() {
    clearTimeout(this.timer);
    this.end();
  }
}
