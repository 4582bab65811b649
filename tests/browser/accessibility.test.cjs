// What axe-core can find, focus that is always seen, and motion that is not wanted.
"use strict";
const assert = require("node:assert/strict");
const fs = require("node:fs");
const { test } = require("node:test");
const reports = require("./lib/reports.cjs");
const { useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();
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

const looks = [];
for (const colorScheme of ["light", "dark"]) for (const width of [1440, 1024, 400]) looks.push({ colorScheme, width });
// The demo in every look; the others in one look each, so that each look is tried on several.
const all = [...reports.fixtures, ...reports.scenarios].filter((name) => name !== reports.demo);
const cases = [...looks.map((look) => [reports.demo, look]), ...all.map((name, i) => [name, looks[i % looks.length]])];
for (const [name, look] of cases) {
  test(`axe finds nothing in ${name}, ${look.colorScheme}, at ${look.width} px`, async () => {
    const { page, close } = await open(name, look);
    for (const view of name === reports.demo ? ["overview", "knowledge", "reasoning", "events"] : ["overview"]) {
      await page.locator("#tab-" + view).click();
      await page.waitForTimeout(50);
      assert.deepEqual(await findings(page), [], view);
    }
    await close();
  });
}

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

for (const colorScheme of ["light", "dark"]) {
  test(`wherever the Tab key goes, focus is seen, ${colorScheme}`, async () => {
    const { page, close } = await open(reports.demo, { colorScheme });
    const unseen = new Set();
    let last = null;
    for (let i = 0; i < 90; ++i) {
      await page.keyboard.press("Tab");
      if (last && !await page.evaluate(changedSince)) unseen.add(last.name);
      last = await page.evaluate(focusLook);
      if (!last) continue;
      if (last.box.width === 0 || last.box.height === 0) unseen.add("without a size: " + last.name);
    }
    assert.deepEqual([...unseen], []);
    await close();
  });
}

test("who wants less motion gets none", async () => {
  const { page, close } = await open(reports.demo, { reducedMotion: "reduce" });
  const moving = await page.evaluate(() => [...document.querySelectorAll("*")].filter((node) => {
    const style = getComputedStyle(node);
    const seconds = (list) => Math.max(...list.split(",").map((one) => parseFloat(one) * (one.trim().endsWith("ms") ? 0.001 : 1)));
    return (style.animationName !== "none" && seconds(style.animationDuration) > 0.01) ||
      (style.transitionProperty !== "none" && seconds(style.transitionDuration) > 0.01) || style.scrollBehavior === "smooth";
  }).map((node) => node.outerHTML.slice(0, 100)));
  assert.deepEqual(moving, []);
  await close();
});
