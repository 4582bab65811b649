// ---- diff_parts.js: the kinds of difference, and pieces of knowledge in words.

// In the order in which they are listed; what is only in one comes first.
/** @type {[string, string][]} */
const KINDS = [
  ["removed", "only in A"], ["added", "only in B"], ["generalised", "more general in B"], ["specialised", "more specific in B"],
  ["other_values", "with other numbers"], ["confidence", "other confidence or state"], ["history", "other evidence or origin"],
];
/** @type {Map<string, string>} */
const KIND_WORDS = new Map([...KINDS, ["same", "the same"]]);
const NODE_WORDS = { composite_state: "composite state", causal_model: "causal model", requirement_model: "requirement model",
  strong_requirement_model: "veto", reuse_model: "reuse model", drive_model: "drive model" };
const STATE_WORDS = { active: "active", phased_out: "phased out", deleted: "given up" };
const ENDINGS = [["", "open"], ["check", "reached"], ["cross", "missed"]];

// What kind of difference an item is.
function kindOf(item) {
  if (item.change !== "changed") return item.change;
  return item.aspects.some((aspect) => ["confidence", "strength", "state"].includes(aspect)) ? "confidence" : "history";
}
// How much surer B is than A; null where one of them does not have it or it is no number.
function surer(item) {
  if (!item.left || !item.right || !Number.isFinite(item.left.sure) || !Number.isFinite(item.right.sure)) return null;
  return item.right.sure - item.left.sure;
}
// Of whoever has it; active where A and B differ in it.
function stateOf({ left, right }) {
  const [first, other] = [left || right, right || left].map((side) => side.model_state || "active");
  return first === other ? first : "active";
}
const isGivenUp = (item) => stateOf(item) === "deleted";
const sideState = (side) => STATE_WORDS[side.model_state] + (side.gone ? " at " + side.gone : "");
// "given up at 1.8 s", "phased out"; empty of what is active.
function fateOf(item) {
  const { left, right } = item;
  const state = stateOf(item);
  return state === "active" ? "" : left && right ? STATE_WORDS[state] + " in both" : sideState(left || right);
}
// Its sign, which for a confidence says the direction.
function signOf(item) {
  const kind = kindOf(item);
  const by = surer(item);
  return kind === "confidence" && by ? (by > 0 ? "up" : "down") : kind;
}

const sureText = (value) => (Number.isFinite(value) ? value.toFixed(2) : "not a number");
const countText = (value) => (Number.isFinite(value) ? String(Number(value.toFixed(2))) : "not a number");
const byText = (by) => (by > 0 ? "+" : "\u2212") + Math.abs(by).toFixed(2);
const plural = (count, word) => count + " " + word + (count === 1 ? "" : "s");
const letter = (side) => el("span", { class: "letter " + side.toLowerCase(), text: side });

// The title; of a pair with two titles both.
function titleOf(item) {
  const { left, right } = item;
  return left && right && left.title !== right.title ? left.title + " \u2192 " + right.title : item.title;
}
// What each side calls it: "A mdl_14  B mdl_12".
function idsOf(item) {
  return [["A", item.left], ["B", item.right]].filter(([, side]) => side)
    .map(([name, side]) => el("span", { class: "ids" }, letter(name), " " + side.id));
}

const quoted = (texts) => texts.map((text) => "\u201c" + text + "\u201d").join(", ");
const rowsWith = (item, status) => item.rows.filter((row) => row[1] === status);
const onlyIn = (item, status) => rowsWith(item, status).map((row) => (status === "left" ? row[2] : row[3]));

// Why it is listed, in a few words.
function whyOf(item) {
  const { left, right, near } = item;
  const gone = onlyIn(item, "left"), more = onlyIn(item, "right");
  const values = rowsWith(item, "changed").map((row) => row[2] + " \u2192 " + row[3]);
  switch (kindOf(item)) {
    case "generalised": return "B does not ask for " + quoted(gone);
    case "specialised": return "B also asks for " + quoted(more);
    case "other_values": return values.length ? values.join("; ") : "what it speaks about has other numbers";
    case "confidence": case "history": return aspectsText(item);
    case "removed": case "added": {
      // Vetoes of one command have one title; what they ask for tells them apart.
      if (!near) return item.kind.endsWith("requirement_model") ? "if " + quoted(item.rows.filter((row) => row[0] === "condition").map((row) => row[2] || row[3])) : "";
      const here = left ? "A" : "B", there = left ? "B" : "A";
      const own = left ? gone : more, other = left ? more : gone;
      if (near.right_is !== "generalised" && near.right_is !== "specialised") return `nearest in ${there}: ${near.title}`;
      const general = (near.right_is === "generalised") === Boolean(right);
      return general ? `more general than \u201c${near.title}\u201d of ${there}: without ${quoted(other)}`
        : `more specific than \u201c${near.title}\u201d of ${there}: ${here} also asks for ${quoted(own)}`;
    }
    default: return "";
  }
}
function aspectsText({ aspects, left, right }) {
  const counts = (side) => `${countText(side.positive)} of ${countText(side.total)}`;
  return aspects.map((aspect) => {
    if (aspect === "confidence") return `A ${sureText(left.sure)} (${counts(left)}), B ${sureText(right.sure)} (${counts(right)})`;
    if (aspect === "evidence") return `both ${sureText(left.sure)}: A ${counts(left)}, B ${counts(right)}`;
    if (aspect === "strength") return right.strong ? "confirmed in B only" : "confirmed in A only";
    if (aspect === "state") return `A ${sideState(left)}, B ${sideState(right)}`;
    if (aspect === "origin") return `A ${left.how}, B ${right.how}`;
    if (aspect === "copies") return `A has it ${left.copies} times, B ${right.copies}`;
    return "made from another piece";
  }).join("; ");
}

// Everything that can be found in it.
function wordsOf(item) {
  const sides = [item.left, item.right].flatMap((side) => (side ? [side.id, side.state, side.target, side.title] : []));
  return [item.title, ...sides, ...item.rows.flatMap((row) => [row[2], row[3]]), KIND_WORDS.get(kindOf(item)), fateOf(item),
    NODE_WORDS[item.kind]].join("\n").toLowerCase();
}
