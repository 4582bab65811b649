// What the address of the page holds, and where the report opens without one.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const { demo } = require("./lib/reports.cjs");
const { firstAnalogy, inHash, settled, time, useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();

test("without an address it opens where experience first spoke about an analogy", async () => {
  const { page, close } = await open("full");
  assert.equal(await time(page), "8.0 s");
  assert.match(await page.locator("#inspector .kind").textContent(), /made by analogy/);
  await close();
});

test("without an address a run that missed a goal opens at the first that was missed, and one whose model failed there", async () => {
  const missed = await open("scenarios/hand_grab_sphere_learn");
  assert.equal(await time(missed.page), "1.4 s");
  assert.match(await missed.page.locator("#moment").textContent(), /Goal missed: h holding \[\]\./);
  assert.match(await missed.page.locator("#inspector .top").textContent(), /goal_\d+.*hold nothing/);
  assert.equal(await inHash(missed.page, "view") || "overview", "overview");
  await missed.close();
  const failed = await open("scenarios/moving_ball");
  assert.equal(await time(failed.page), "1.3 s");
  await failed.close();
});

test("what the story shows stands in the address, and is gone back from", async () => {
  const { page, close } = await open(demo, { hash: "#t=9&view=overview&story=goal" });
  const rows = () => page.locator("#story li:not(.more)").count();
  const pressed = (name) => page.locator("#chips").getByRole("button", { name }).getAttribute("aria-pressed");
  assert.equal(await pressed("Goals"), "true");
  const goals = await rows();
  await page.locator("#chips").getByRole("button", { name: "Commands" }).click();
  await page.waitForFunction(() => location.hash.includes("story=command"));
  assert.notEqual(await rows(), goals);
  await page.goBack();
  await page.waitForFunction(() => document.querySelector("#chips [aria-pressed=true]").textContent === "Goals");
  assert.equal(await rows(), goals);
  await page.locator("#chips").getByRole("button", { name: "All" }).click();
  await page.waitForFunction(() => !location.hash.includes("story="));
  await close();
});

test("the list of keys tells each part of the address", async () => {
  const { page, close } = await open(demo, { hash: "#t=9&view=events&th=dark&story=goal&words=seen&head=no&kinds=FactObserved&show=given:0&cam=side&about=thing:s1" });
  await page.keyboard.press("?");
  const text = await page.locator("#keys").textContent();
  await page.waitForFunction(() => location.hash.includes("story="));
  const parts = await page.evaluate(() => [...new URLSearchParams(location.hash.slice(1)).keys()]);
  assert.ok(parts.length >= 9, parts.join());
  for (const part of parts) assert.ok(text.includes(part + "="), part);
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

const eventCount = (page) => page.locator(".events-head [aria-live]").textContent().then((text) => Number(text.split(" ")[0]));

test("what the list of events is filtered by stands in the address, and back and forward go through it", async () => {
  const { page, close } = await open(demo, { hash: "#view=events&t=7" });
  const kinds = page.locator(".events-head .kinds summary");
  const all = await eventCount(page);
  await page.getByRole("button", { name: "In the head, too" }).click();
  const real = await eventCount(page);
  await settled(page);
  await kinds.click();
  await page.getByRole("button", { name: "Only goal reached" }).click();
  assert.equal(await eventCount(page), 5);
  await settled(page);
  assert.equal(await inHash(page, "kinds"), "GoalAchieved");
  assert.equal(await inHash(page, "head"), "no");
  const address = page.url().split("#")[1];
  await page.goBack();
  await page.waitForFunction((n) => document.querySelector(".events-head [aria-live]").textContent.startsWith(n + " of"), real);
  await page.goBack();
  await page.waitForFunction((n) => document.querySelector(".events-head [aria-live]").textContent.startsWith(n + " of"), all);
  assert.equal(await page.getByRole("button", { name: "In the head, too" }).getAttribute("aria-pressed"), "true");
  await page.goForward();
  await page.goForward();
  await page.waitForFunction(() => document.querySelector(".events-head [aria-live]").textContent.startsWith("5 of"));
  await close();
  // The same address somewhere else.
  const again = await open(demo, { hash: "#" + address });
  assert.equal(await eventCount(again.page), 5);
  await again.page.locator(".events-head .kinds summary").click();
  assert.equal(await again.page.locator(".events-head .kind-list input:checked").count(), 1);
  await again.close();
});

test("words that events are searched for are restored, kinds that no run has are forgotten", async () => {
  const { page, noise, close } = await open(demo, { hash: "#view=events&t=7&words=the%20agent%20commands&kinds=-Unheard.CauseConsidered&head=perhaps" });
  await page.waitForFunction(() => /^8 of \d+$/.test(document.querySelector(".events-head [aria-live]").textContent));
  assert.equal(await page.locator(".events-head input[type=search]").inputValue(), "the agent commands");
  await settled(page);
  assert.equal(await inHash(page, "kinds"), "-CauseConsidered");
  assert.equal(await inHash(page, "head"), null);
  assert.deepEqual(noise, []);
  await close();
});

test("what the graph shows stands in the address and in the copied link", async () => {
  const { page, close } = await open(demo, { hash: "#t=15&view=knowledge", permissions: ["clipboard-read", "clipboard-write"] });
  await page.locator("#graph-tools summary").click();
  const menu = page.locator("#graph-tools .kind-list");
  await menu.getByLabel("made by analogy").uncheck();
  await menu.getByLabel("sure at least").selectOption("0.9");
  await settled(page);
  assert.equal(await inHash(page, "show"), "analogy:0,sure:0.9");
  const hidden = await page.locator("#graph-hidden").textContent();
  assert.match(hidden, /^\d+ hidden$/);
  await page.locator("#title").click();
  await page.locator("#copy").click();
  await page.waitForFunction(() => document.getElementById("said").textContent !== "");
  const link = await page.evaluate(() => (document.getElementById("said").textContent === "Link copied" ? navigator.clipboard.readText() : location.href));
  await page.goBack();
  await page.waitForFunction((text) => document.getElementById("graph-hidden").textContent !== text, hidden);
  await close();
  const again = await open(demo, { hash: "#" + link.split("#")[1] });
  assert.equal(await again.page.locator("#graph-hidden").textContent(), hidden);
  await again.page.locator("#graph-tools summary").click();
  assert.equal(await again.page.locator("#graph-tools .kind-list").getByLabel("made by analogy").isChecked(), false);
  await again.close();
});

test("a simulation is known by the event that began it, and an id that is not there is said to be none", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn", { hash: "#t=1.11&sel=sim_176" });
  assert.match(await page.locator("#inspector .top").textContent(), /^#\d+, in the head, at 1\.11 s/);
  assert.match(await page.locator("#inspector").textContent(), /sim_176/);
  await page.evaluate(() => { location.hash = "#t=1.11&sel=pred_9999"; });
  await settled(page);
  assert.equal(await page.locator("#said").textContent(), "There is no pred_9999 here.");
  await close();
});

test("an event in the address is in sight in the list of events", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn", { hash: "#t=1.1&view=events&sel=%23311" });
  await settled(page);
  const row = page.locator(".event-row[data-event='311']");
  const [box, list] = [await row.boundingBox(), await page.locator(".events-list").boundingBox()];
  assert.ok(box && box.y >= list.y && box.y + box.height <= list.y + list.height, JSON.stringify([box, list]));
  await close();
});
