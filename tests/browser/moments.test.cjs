// One clock: playing, stepping, dragging, and the address of a moment.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const { demo } = require("./lib/reports.cjs");
const { quiet, time, useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();

test("it plays from the first frame to the last and stops", async () => {
  const { page, noise, close } = await open("full", { hash: "#t=13" });
  await page.keyboard.press(" ");
  assert.equal(await page.locator("#play").getAttribute("aria-label"), "Pause");
  await page.waitForFunction(() => document.getElementById("play").getAttribute("aria-label") === "Play", null, { timeout: 8000 });
  assert.equal(await time(page), "14.0 s");
  assert.deepEqual(noise, []);
  await close();
});

test("keys step, jump to both ends, search and explain themselves", async () => {
  const { page, close } = await open("full", { hash: "#t=5" });
  await page.keyboard.press("ArrowRight");
  assert.equal(await time(page), "6.0 s");
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("ArrowLeft");
  assert.equal(await time(page), "4.0 s");
  await page.keyboard.press("End");
  assert.equal(await time(page), "14.0 s");
  await page.keyboard.press("Home");
  assert.equal(await time(page), "0.0 s");
  await page.keyboard.press("?");
  assert.equal(await page.locator("#keys").evaluate((dialog) => dialog.open), true);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator("#keys").evaluate((dialog) => dialog.open), false);
  await page.keyboard.press("/");
  await page.keyboard.type("release");
  assert.ok(await page.locator("#results button").count() > 0);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator("#query").inputValue(), "");
  await close();
});

test("dragging anywhere on the lanes scrubs film, graph and story together", async () => {
  const { page, close } = await open("full", { hash: "#view=knowledge" });
  const box = await page.locator(".lane-field").boundingBox();
  const image = () => page.locator("#film img").getAttribute("src");
  await page.mouse.move(box.x + 20, box.y + box.height - 4);
  await page.mouse.down();
  await page.mouse.move(box.x + 30, box.y + 8);
  await quiet(page);
  const [earlyTime, earlyImage] = [await time(page), await image()];
  const earlyCount = await page.locator("#graph-count").textContent();
  await page.mouse.move(box.x + box.width - 120, box.y + 8, { steps: 5 });
  await quiet(page);
  await page.mouse.up();
  assert.notEqual(await time(page), earlyTime);
  assert.notEqual(await image(), earlyImage);
  assert.match(earlyCount, /^0 of 9/);
  assert.equal(await page.locator("#graph-count").textContent(), "9 of 9 pieces learned");
  await close();
});

// Knowledge is that of a moment, Reasoning that of its whole frame; both called themselves "at 9.0 s", and 7.06 was 7.1.
test("clock, lanes, Knowledge and Reasoning say the same moment, to the same decimals, and which part of its frame they show", async () => {
  const { page, close } = await open(demo, { hash: "#view=knowledge&t=7.06" });
  const text = (id) => page.locator(id).textContent();
  assert.equal(await time(page), "7.06 s");
  assert.equal(await text(".cursor text"), "7.06 s");
  assert.equal(await text("#graph-title"), "What it knew at 7.06 s");
  assert.equal(await text("#graph-part"), "frame 8, up to this moment");
  await page.locator("#tab-reasoning").click();
  assert.equal(await text("#reasoning-title"), "What it thought at 7.06 s");
  assert.equal(await text("#reasoning-part"), "frame 8, all of it: 7.0 to 8.0 s");
  await page.keyboard.press("ArrowLeft");
  assert.equal(await text("#reasoning-title"), "What it thought at 7.0 s");
  await page.locator("#tab-knowledge").click();
  assert.equal(await text("#graph-count"), "5 of 9 pieces learned, 1 more in this frame");
  await close();
});
