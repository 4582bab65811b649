// What axe-core finds in a page, whether focus is seen, and what moves; for the tests of every page.
"use strict";
const fs = require("node:fs");

const axe = fs.readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

// Each finding as "rule: element". Evaluated, not added as an element, since the page allows no other script.
async function findings(page) {
  await page.evaluate(axe);
  const found = await page.evaluate(() => axe.run(document, { resultTypes: ["violations"],
    // An experimental rule, which axe leaves out by itself: speech control needs names that hold what is seen.
    rules: { "label-content-name-mismatch": { enabled: true } } }));
  return found.violations.flatMap(({ id, nodes }) => nodes.map((node) =>
    `${id}: ${node.html.slice(0, 160)} (${[...node.any, ...node.all].map((check) => check.message).join("; ").slice(0, 200)})`));
}

// How a page may be looked at.
const looks = [];
for (const colorScheme of ["light", "dark"]) for (const width of [1440, 1024, 400]) looks.push({ colorScheme, width });

// Whether what has the focus shows it: an outline of its own, or a changed stroke or fill of its shape.
const focusLook = () => {
  const node = document.activeElement;
  if (!node || node === document.body) return null;
  const looks = [node, ...node.querySelectorAll("rect, path, circle, line")].map((part) => {
    const style = getComputedStyle(part);
    return [style.outlineStyle, style.outlineWidth, style.outlineColor, style.stroke, style.strokeWidth, style.fill,
      style.boxShadow, style.backgroundColor, style.opacity, style.visibility].join("|");
  }).join("\n");
  const style = getComputedStyle(node);
  const outlined = style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0;
  const name = node.outerHTML.slice(0, 120);
  node.dataset.focusLook = looks;
  return { name, outlined, box: node.getBoundingClientRect().toJSON() };
};
// The same element when it has lost the focus: what changed?
const changedSince = () => {
  const node = document.querySelector("[data-focus-look]");
  if (!node) return true;
  const before = node.dataset.focusLook;
  node.removeAttribute("data-focus-look");
  const after = [node, ...node.querySelectorAll("rect, path, circle, line")].map((part) => {
    const style = getComputedStyle(part);
    return [style.outlineStyle, style.outlineWidth, style.outlineColor, style.stroke, style.strokeWidth, style.fill,
      style.boxShadow, style.backgroundColor, style.opacity, style.visibility].join("|");
  }).join("\n");
  return before !== after;
};

// What the Tab key reaches without its being seen, or without a size.
async function focusUnseen(page, steps) {
  const unseen = new Set();
  let last = null;
  for (let i = 0; i < steps; ++i) {
    await page.keyboard.press("Tab");
    if (last && !await page.evaluate(changedSince)) unseen.add(last.name);
    last = await page.evaluate(focusLook);
    if (!last) continue;
    if (last.box.width === 0 || last.box.height === 0) unseen.add("without a size: " + last.name);
  }
  return [...unseen];
}

// What moves by itself, or would be moved smoothly.
const motion = (page) => page.evaluate(() => [...document.querySelectorAll("*")].filter((node) => {
    const style = getComputedStyle(node);
    const seconds = (list) => Math.max(...list.split(",").map((one) => parseFloat(one) * (one.trim().endsWith("ms") ? 0.001 : 1)));
    return (style.animationName !== "none" && seconds(style.animationDuration) > 0.01) ||
      (style.transitionProperty !== "none" && seconds(style.transitionDuration) > 0.01) || style.scrollBehavior === "smooth";
  }).map((node) => node.outerHTML.slice(0, 100)));

module.exports = { findings, focusUnseen, looks, motion };
