// Names that try to be markup.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const { settled, useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();

test("hostile names stay text", async () => {
  const { page, noise, close } = await open("hostile");
  for (const key of ["End", "Home"]) await page.keyboard.press(key);
  for (const item of await page.locator(".lane-field .item").all()) await item.dispatchEvent("keydown", { key: "Enter" });
  await settled(page);
  assert.deepEqual(noise, []);
  assert.notEqual(await page.title(), "owned");
  assert.match(await page.locator("#title").textContent(), /<script>/);
  assert.equal(await page.locator("img[src='x']").count(), 0);
  await close();
});
