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

test("the lanes of twenty frames are in sight from beginning to end, and no tag in them is empty", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn");
  const lanes = await page.evaluate(() => {
    const scroll = document.querySelector(".lanes-scroll"), edge = scroll.getBoundingClientRect().right;
    const tags = [...document.querySelectorAll(".lane-field .item")].filter((item) => item.querySelector(".bar"));
    return { beyond: scroll.scrollWidth - scroll.clientWidth, count: tags.length, empty: tags.filter((tag) => !tag.querySelector(".mark") && !tag.querySelector("text").textContent).length,
      cut: [...document.querySelectorAll(".lane-field text")].filter((text) => text.getBoundingClientRect().right > edge).map((text) => text.textContent) };
  });
  assert.ok(lanes.count > 20, String(lanes.count));
  assert.deepEqual({ ...lanes, count: 0 }, { beyond: 0, count: 0, empty: 0, cut: [] });
  await close();
});

test("lanes that are wider than the page say so and go on", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn", { width: 400, height: 860, hash: "#t=0" });
  const more = page.locator(".lanes-pane .to-right"), back = page.locator(".lanes-pane .to-left");
  await more.waitFor();
  assert.equal(await back.isVisible(), false);
  for (let i = 0; i < 20 && await more.isVisible(); ++i) {
    await more.click();
    await page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
  }
  assert.equal(await more.isVisible(), false);
  assert.ok(await back.isVisible());
  await close();
});

test("at 800 px the views begin on the first screen, and the story stands beside the picture", async () => {
  for (const report of [demo, "scenarios/hand_grab_sphere_learn"]) {
    const { page, close } = await open(report, { width: 800, height: 800 });
    const boxOf = (part) => page.locator(part).boundingBox();
    const tab = await boxOf("#tab-overview"), film = await boxOf("#film"), story = await boxOf("#story"), head = await boxOf(".story-head");
    assert.ok(tab.y + tab.height < 600, report + JSON.stringify(tab));
    assert.ok(story.x >= film.x + film.width && head.x >= film.x + film.width, JSON.stringify([story, film]));
    assert.ok(story.height > 150 && story.y + story.height <= tab.y, JSON.stringify([story, tab]));
    await page.locator("#fold").click();
    assert.ok((await boxOf(".objects")).height > 100, "folded, the things are there instead");
    await close();
  }
});

for (const [width, height] of [[400, 860], [375, 667]]) {
  test(`the first screen of a telephone (${width} px) has the answer, the picture, the clock and the tabs`, async () => {
    const { page, close } = await open(demo, { width, height });
    for (const part of ["#summary", "#film", ".transport", "#moment", "#tab-overview", "#tab-events"]) {
      const box = await page.locator(part).boundingBox();
      assert.ok(box.y >= 0 && box.y + box.height <= height && box.x >= 0 && box.x + box.width <= width, part + JSON.stringify(box));
    }
    const first = await page.locator(".drive").first().boundingBox();
    assert.ok(first.y < height - 80, "and begins with what was to be done");
    await close();
  });
}

test("on a telephone the third column of Knowledge is a touch away, and Reasoning's chain is within the page", async () => {
  const { page, close } = await open(demo, { width: 400, height: 860, hash: "#view=knowledge&t=9" });
  const rightmost = () => page.locator(".graph.heads .column").last().evaluate((node) => node.getBoundingClientRect().right);
  assert.ok(await rightmost() > 400);
  for (let i = 0; i < 6 && await page.locator(".graph-body .to-right").isVisible(); ++i) {
    await page.locator(".graph-body .to-right").click();
    await page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
  }
  assert.ok(await rightmost() <= 400, "the end is reached");
  await page.locator("#tab-reasoning").click();
  const cells = await page.locator(".chain td").evaluateAll((list) => list.map((cell) => ({ right: cell.getBoundingClientRect().right, question: getComputedStyle(cell, "::before").content })));
  assert.deepEqual(cells.slice(0, 5).map((cell) => cell.question), ["this happened", "while this held", "so this model applies", "expected", "and then"].map((text) => `"${text}"`));
  assert.ok(cells.every((cell) => cell.right <= 400), JSON.stringify(cells));
  await close();
});

test("on a telephone a button leads from the view to the selection", async () => {
  const { page, close } = await open(demo, { width: 400, height: 860 });
  const down = page.locator("#to-selection");
  await page.locator(".drive-button").first().click();
  await page.waitForFunction(() => document.getElementById("to-selection").textContent.includes("s1"));
  await down.click();
  await down.waitFor({ state: "hidden" });
  const box = await page.locator("#inspector").boundingBox();
  assert.ok(box.y < 400, String(box.y));
  await close();
});

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
