// What axe-core can find, focus that is always seen, and motion that is not wanted.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const { findings, focusUnseen, looks, motion } = require("./lib/access.cjs");
const reports = require("./lib/reports.cjs");
const { quiet, useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();
// The demo in every look; the others in one look each, so that each look is tried on several.
const all = [...reports.fixtures, ...reports.scenarios].filter((name) => name !== reports.demo);
const cases = [...looks.map((look) => [reports.demo, look]), ...all.map((name, i) => [name, looks[i % looks.length]])];
for (const [name, look] of cases) {
  test(`axe finds nothing in ${name}, ${look.colorScheme}, at ${look.width} px`, async () => {
    const { page, close } = await open(name, look);
    for (const view of name === reports.demo ? ["overview", "knowledge", "reasoning", "events"] : ["overview"]) {
      await page.locator("#tab-" + view).click();
      await quiet(page);
      assert.deepEqual(await findings(page), [], view);
    }
    await close();
  });
}

for (const colorScheme of ["light", "dark"]) {
  test(`wherever the Tab key goes, focus is seen, ${colorScheme}`, async () => {
    const { page, close } = await open(reports.demo, { colorScheme });
    assert.deepEqual(await focusUnseen(page, 90), []);
    await close();
  });
}

test("who wants less motion gets none", async () => {
  const { page, close } = await open(reports.demo, { reducedMotion: "reduce" });
  assert.deepEqual(await motion(page), []);
  await close();
});
