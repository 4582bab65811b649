// ---- base.js: words and numbers for people.

// A mark inside a drawing, its middle at x, y.
function signAt(name, x, y, size, more) {
  return svg("svg", { class: more, x: x - size / 2, y: y - size / 2, width: size, height: size, "aria-hidden": "true" },
    svg("use", { href: "#m-" + name }));
}

// The same for a line that a generalisation pruned: struck.
function conditionLine(line) {
  const parts = withVariables(line.text, line.vars);
  return line.cut ? [el("s", {}, ...parts)] : parts;
}
// With a capital in front, unless the first word is a name such as grab_type_2.
function capitalised(text) {
  return /[_0-9]/.test(text.split(" ")[0]) ? text : text.charAt(0).toUpperCase() + text.slice(1);
}

// Seconds with just the decimals that the sampling period needs.
let timeDecimals = 1;
function setTimeDecimals(periodUs) {
  timeDecimals = 1;
  for (const [step, decimals] of [[100000, 1], [10000, 2], [1000, 3]]) {
    if (periodUs > 0 && periodUs % step === 0) { timeDecimals = decimals; return; }
  }
  if (periodUs > 0) timeDecimals = 3;
}
const clockText = (us) => (us / 1e6).toFixed(timeDecimals) + " s";
// The same of a moment within a frame, which may have more.
const momentText = (us) => (us / 1e6).toFixed(Math.max(timeDecimals, (tickText(us).split(".")[1] || "").length)) + " s";
// Of an event, to the millisecond; what is finer would not help.
const secondsText = (us) => String(Number((us / 1e6).toFixed(3))) + " s";
const tickText = (us) => String(Number((us / 1e6).toFixed(3)));
// What is no number (the file may say so) is null here.
const sureText = (value) => (Number.isFinite(value) ? value.toFixed(2) : "not a number");
const shortNumber = (value) => (Number.isFinite(value) ? String(Number(value.toFixed(2))) : "not a number");
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

// The last item of a list, ordered by `at`, that is not after t; undefined before the first.
function lastAt(list, t, at) {
  let low = 0, high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (at(list[middle]) <= t) low = middle + 1; else high = middle;
  }
  return list[low - 1];
}

// Text that does not fit is cut at its end; a last number stays, since it tells names apart ("grab_1", "grab_2").
const ruler = document.createElement("canvas").getContext("2d");
const widths = new Map();   // "pixels text" -> width: the same few texts are asked for again and again
let rulerFont = "";
function widthOf(text, pixels) {
  const key = pixels + " " + text;
  const known = widths.get(key);
  if (known !== undefined) return known;
  if (!rulerFont) rulerFont = getComputedStyle(document.body).fontFamily;
  ruler.font = pixels + "px " + rulerFont;
  const { width } = ruler.measureText(text);
  if (widths.size > 20000) widths.clear();
  widths.set(key, width);
  return width;
}
function fitted(text, room, pixels) {
  if (widthOf(text, pixels) <= room) return text;
  const letters = Array.from(text);
  const tail = /\d$/.test(text) ? letters[letters.length - 1] : "";
  for (let keep = letters.length - 1; keep >= 2; --keep) {
    const short = letters.slice(0, keep).join("").trimEnd() + "\u2026" + tail;
    if (widthOf(short, pixels) <= room) return short;
  }
  return "";
}
// The first of several wordings that fits whole, else the last one cut.
function firstFitting(texts, room, pixels) {
  const whole = texts.find((text) => widthOf(text, pixels) <= room);
  return whole === undefined ? fitted(texts[texts.length - 1], room, pixels) : whole;
}
