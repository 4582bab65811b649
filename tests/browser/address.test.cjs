// What the address of the page holds, and where the report opens without one.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const { firstAnalogy, time, useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();

test("without an address it opens where experience first spoke about an analogy", async () => {
  const { page, close } = await open("full");
  assert.equal(await time(page), "8.0 s");
  assert.match(await page.locator("#inspector .kind").textContent(), /made by analogy/);
  await close();
});

test("the address restores moment, selection and theme", async () => {
  const first = await open("full");
  const id = await firstAnalogy(first.page);
  await first.close();
  const { page, close } = await open("full", { hash: `#t=11&sel=${id}&th=dark` });
  assert.equal(await time(page), "11.0 s");
  assert.match(await page.locator("#inspector .kind").textContent(), new RegExp(id));
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  await close();
});
