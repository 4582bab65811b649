// The four views of the middle, and what can be done in each.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const fs = require("node:fs");
const { demo, fileOf, scenarios } = require("./lib/reports.cjs");
const { firstAnalogy, inHash, settled, time, useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();
const failure = "scenarios/size_pruned_first_scripted";
const tab = (page, name) => page.locator("#tab-" + name);
const shown = (page) => page.evaluate(() => document.body.dataset.view);

test("the first screen says what was to be done, what went wrong and what was learned", async () => {
  const { page, noise, close } = await open(failure);
  assert.equal(await shown(page), "overview");
  const overview = page.locator("#overview");
  assert.match(await overview.textContent(), /What was to be done\?3 of 4 reached/);
  assert.equal(await overview.locator(".drive.fail").count(), 1);
  assert.match(await overview.textContent(), /Did not come true/);
  assert.match(await overview.locator(".pieces .gone").textContent(), /given up at/);
  // A drive leads to itself, at the moment it was decided.
  await overview.locator(".drive.fail .drive-button").click();
  await settled(page);
  assert.match(await inHash(page, "sel"), /^goal_/);
  assert.match(await page.locator("#inspector").textContent(), /not reached by/);
  assert.match(await page.locator("#inspector").textContent(), /Why not\?/);
  assert.deepEqual(noise, []);
  await close();
});

for (const name of scenarios) {
  test(`every view of ${name} opens, at both ends of time, without a message`, async () => {
    const { page, noise, close } = await open(name);
    for (const view of ["knowledge", "reasoning", "events", "overview"]) {
      await tab(page, view).click();
      for (const key of ["Home", "ArrowRight", "End"]) await page.keyboard.press(key);
      assert.equal(await shown(page), view);
      assert.equal(await page.locator("#view-" + view).isVisible(), true);
    }
    assert.deepEqual(noise, []);
    await close();
  });
}

test("tabs go by arrows and by number, and back and forward lead through them", async () => {
  const { page, close } = await open("full", { hash: "#view=overview&t=3" });
  await tab(page, "overview").focus();
  await page.keyboard.press("ArrowRight");
  assert.equal(await shown(page), "knowledge");
  assert.equal(await page.evaluate(() => document.activeElement.id), "tab-knowledge");
  await settled(page);
  await page.locator("#title").click();
  await page.keyboard.press("4");
  assert.equal(await shown(page), "events");
  await settled(page);
  await page.goBack();
  await page.waitForFunction(() => document.body.dataset.view === "knowledge");
  await page.goForward();
  await page.waitForFunction(() => document.body.dataset.view === "events");
  await close();
});

test("the list of events says what the program says, event by event", async () => {
  const { page, close } = await open(demo, { hash: "#view=events&t=0" });
  await page.locator(".events-head .kinds summary").click();
  await page.locator(".events-head .kind-list").getByRole("button", { name: "all" }).click();
  // Row by row, as somebody sees them who scrolls from the first to the last.
  const seen = await page.evaluate(async () => {
    const list = document.querySelector(".events-list");
    const rows = new Map();
    for (let top = 0; top < list.scrollHeight; top += list.clientHeight / 2) {
      list.scrollTop = top;
      await new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
      for (const row of list.querySelectorAll(".event-row")) rows.set(Number(row.dataset.event), row.querySelector(".sentence").textContent);
    }
    return [...rows].sort((a, b) => a[0] - b[0]).map(([event, text]) => "#" + event + " " + text);
  });
  const said = fs.readFileSync(fileOf(demo).replace(/html$/, "txt"), "utf8").trimEnd().split("\n")
    .map((line) => line.replace(/^\S+ s +(#\d+) +\w+ +/, "$1 ").replace(/`([^`]*)`/g, "\u201c$1\u201d"));
  assert.ok(said.length > 1000);
  assert.deepEqual(seen, said);
  await close();
});

test("events are filtered by words, kind and thing, and those in the head can be left out", async () => {
  const { page, close } = await open(demo, { hash: "#view=events&t=7.06" });
  const count = page.locator(".events-head [aria-live]");
  const number = async () => Number((await count.textContent()).split(" ")[0]);
  const all = await number();
  assert.ok(all > 500);
  assert.ok(await page.locator(".event-row.imagined").count() > 0, "what was imagined is marked");
  await page.getByRole("button", { name: "In the head, too" }).click();
  const real = await number();
  assert.ok(real < all);
  assert.equal(await page.locator(".event-row.imagined").count(), 0);
  await page.locator(".events-head input[type=search]").fill("the agent commands");
  await page.waitForFunction(() => /^8 of/.test(document.querySelector(".events-head [aria-live]").textContent));
  for (const row of await page.locator(".event-row .sentence").allTextContents()) assert.match(row, /The agent commands/);
  // On to the next, which moves the clock.
  const before = await time(page);
  await page.locator(".event-row").first().click();
  await page.locator(".events-head").getByRole("button", { name: "next" }).click();
  assert.notEqual(await time(page), before);
  await page.locator(".events-head input[type=search]").fill("");
  await page.waitForFunction((n) => document.querySelector(".events-head [aria-live]").textContent.startsWith(n + " of"), real);
  await page.locator(".events-head .kinds summary").click();
  await page.locator(".events-head .kind-list").getByRole("button", { name: "none" }).click();
  await page.locator(".events-head .kind-list label", { hasText: "Goal reached" }).locator("input").check();
  assert.equal(await number(), 5);
  await close();
});

test("all events of a thing are a click away from it", async () => {
  const { page, close } = await open("full", { hash: "#t=8" });
  await page.evaluate((id) => { location.hash = `#t=8&sel=${id}&view=knowledge`; }, await firstAnalogy(page));
  await page.locator("#inspector .all-events").click();
  assert.equal(await shown(page), "events");
  const id = await page.evaluate(() => new URLSearchParams(location.hash.slice(1)).get("sel"));
  await page.waitForFunction(() => !document.querySelector(".events-head .chip[hidden]"));
  assert.match(await page.locator(".events-head").textContent(), new RegExp("About mdl_"));
  assert.ok(await page.locator(".event-row").count() > 2, id);
  await close();
});

test("the reasoning of a moment shows the plans tried, and what each imagined", async () => {
  const { page, close } = await open(demo, { hash: "#view=reasoning&t=7.06" });
  const reasoning = page.locator("#reasoning");
  await reasoning.locator("summary", { hasText: "Tried in the head" }).first().click();
  const steps = await reasoning.locator("details.tried[open] .tree").first().textContent();
  assert.match(steps, /Imagined: move/);
  assert.match(steps, /Imagined: grab_type_2/);
  assert.match(steps, /reaches its goal/);
  assert.match(await reasoning.textContent(), /Not pursued: h holding \[\] \(it holds already\)/);
  assert.match(await reasoning.locator(".chain").textContent(), /expects that move/);
  await close();
});

test("the graph hides by kind and counts what it hides, folds, zooms and shows neighbours", async () => {
  const { page, close } = await open(demo, { hash: "#view=knowledge&t=15" });
  const rings = () => page.locator("#graph .ring-bed").count();
  const all = await rings();
  await page.locator("#graph-tools summary").click();
  const menu = page.locator("#graph-tools .kind-list");
  await menu.getByLabel("made by analogy").uncheck();
  assert.equal(await page.locator("#graph-hidden").textContent(), "4 hidden");
  assert.equal(await rings(), all - 4);
  await menu.getByLabel("made by analogy").check();
  assert.equal(await page.locator("#graph-hidden").textContent(), "");
  await menu.getByLabel("around").selectOption("1");
  assert.ok(await rings() < all);
  await menu.getByLabel("around").selectOption("0");
  const open_bands = () => page.locator("#graph g.open").count();
  await menu.getByRole("button", { name: "fold all", exact: true }).click();
  assert.equal(await open_bands(), 0);
  await page.locator("#title").click();
  await page.locator("#graph .fold-mark").first().click();
  assert.equal(await open_bands(), 1);
  const width = () => page.locator("#graph svg[role=group]").evaluate((node) => node.getBoundingClientRect().width);
  const usual = await width();
  await page.getByRole("button", { name: "Larger" }).click();
  assert.ok(await width() > usual * 1.2);
  await page.getByRole("button", { name: "Fit all into the pane" }).click();
  assert.ok(await width() <= usual);
  await close();
});

test("a veto is barred and says so, what was given up is struck", async () => {
  const { page, close } = await open(failure, { hash: "#view=knowledge&t=1.2" });
  assert.ok(await page.locator("#graph .item.veto .bar").count() >= 1);
  assert.match(await page.locator("#graph .item.veto").first().locator("> title").textContent(), /veto/);
  assert.ok(await page.locator("#graph .item.gone").count() >= 1);
  await close();
});

test("a cause unfolds to what was seen, and folds again", async () => {
  const { page, close } = await open("full", { hash: "#t=8" });
  const why = page.locator("#inspector .block", { has: page.locator("#part-why") });
  const rows = () => why.locator("li").count();
  const before = await rows();
  await why.locator("button.twist[aria-expanded=false]").first().click();
  const unfolded = await rows();
  assert.ok(unfolded > before);
  await why.locator("button.twist[aria-expanded=true]").first().click();
  assert.ok(await rows() < unfolded);
  await close();
});

test("find goes on to the next, back to the one before, and to the events that say it", async () => {
  const { page, close } = await open(demo, { hash: "#t=15&view=knowledge" });
  await page.keyboard.press("/");
  await page.keyboard.type("release");
  const seen = [];
  for (let i = 0; i < 3; ++i) {
    await page.keyboard.press("Enter");
    await settled(page);
    seen.push(await inHash(page, "sel"));
  }
  assert.equal(new Set(seen).size, 3);
  await page.keyboard.press("Shift+Enter");
  await settled(page);
  assert.equal(await inHash(page, "sel"), seen[1]);
  await page.locator("#query").click();
  await page.locator("#results .every button").click();
  assert.equal(await shown(page), "events");
  await page.waitForFunction(() => /^\d+ of \d+$/.test(document.querySelector(".events-head [aria-live]").textContent));
  for (const row of await page.locator(".event-row .sentence").allTextContents()) assert.match(row.toLowerCase(), /release/);
  await close();
});

test("the link to this moment can be copied", async () => {
  const { page, close } = await open("full", { hash: "#t=8&view=reasoning", permissions: ["clipboard-read", "clipboard-write"] });
  await page.locator("#copy").click();
  await page.waitForFunction(() => document.getElementById("said").textContent !== "");
  assert.match(await page.locator("#said").textContent(), /Link copied|address bar/);
  assert.match(page.url(), /view=reasoning/);
  await close();
});

test("the lanes can be stretched and shrunk around the cursor", async () => {
  const { page, close } = await open(demo, { hash: "#t=9" });
  const width = () => page.locator(".lane-field").evaluate((node) => Number(node.getAttribute("width")));
  const usual = await width();
  await page.getByRole("button", { name: "Longer time scale" }).click();
  assert.ok(await width() > usual * 1.4);
  const cursor = await page.locator(".cursor").boundingBox();
  const pane = await page.locator(".lanes-scroll").boundingBox();
  assert.ok(cursor.x > pane.x && cursor.x < pane.x + pane.width, "the cursor stays in sight");
  await page.getByRole("button", { name: "Shorter time scale" }).click();
  assert.ok(Math.abs(await width() - usual) < 2);
  await close();
});

test("a row that says what became of a model selects that event, and the model is one click away", async () => {
  const { page, close } = await open(failure);
  const row = page.locator("#overview .tree button", { hasText: "is given up" }).first();
  const model = /mdl_\d+/.exec(await row.textContent())[0];
  const event = await row.getAttribute("data-event");
  await row.click();
  await settled(page);
  assert.equal(await inHash(page, "sel"), "#" + event);
  const inspector = page.locator("#inspector");
  assert.match(await inspector.locator(".top").textContent(), /Model retired or restored/);
  assert.match(await inspector.textContent(), /Why did it happen\?/);
  await inspector.locator(".tree button", { hasText: model }).first().click();
  await settled(page);
  assert.equal(await inHash(page, "sel"), model);
  await close();
});
