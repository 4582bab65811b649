// Themes and widths.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const { demo } = require("./lib/reports.cjs");
const { useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();

test("light and dark follow the system and the button", async () => {
  const { page, close } = await open("full", { colorScheme: "dark" });
  const ground = () => page.evaluate(() => getComputedStyle(document.querySelector("header")).backgroundColor);
  const dark = await ground();
  await page.locator("#theme").click();
  assert.notEqual(await ground(), dark);
  await close();
});

for (const width of [1440, 1240, 800, 400]) {
  test(`nothing sticks out sideways at ${width} px`, async () => {
    const { page, close } = await open("full", { width, height: 800 });
    const over = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    assert.equal(over, 0);
    await close();
  });
}

for (const width of [1440, 1024, 400]) {
  test(`only the events in sight are in the page at ${width} px`, async () => {
    const { page, close } = await open(demo, { width, height: 800, hash: "#view=events&t=7" });
    const rows = await page.locator(".event-row").count();
    assert.ok(rows > 10 && rows < 80, String(rows));
    const sentence = await page.locator(".event-row .sentence").first().boundingBox();
    assert.ok(sentence.width > 200, "a sentence has room: " + sentence.width);
    await close();
  });
}
