// The model graph and what is shown of anything selected.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const { firstAnalogy, selected, settled, time, useBrowser } = require("./lib/browser.cjs");
const { demo } = require("./lib/reports.cjs");

const open = useBrowser();

test("no card moves while time does, and what is not known yet says when it will be", async () => {
  const { page, close } = await open("full", { hash: "#t=0" });
  const places = () => page.locator(".graph .item").evaluateAll((nodes) => nodes.map((node) => {
    const shape = node.querySelector("rect, circle");
    return [shape.getAttribute("x") ?? shape.getAttribute("cx"), shape.getAttribute("y") ?? shape.getAttribute("cy")].join();
  }));
  const before = await places();
  assert.ok(await page.locator(".graph .later .note", { hasText: "learned at 9 s" }).first().isVisible());
  await page.keyboard.press("End");
  assert.deepEqual(await places(), before);
  assert.equal(await page.locator(".graph .later").count(), 0);
  await close();
});

test("a clicked model shows what it says, how sure it is and what it is bound to", async () => {
  const { page, noise, close } = await open("full", { hash: "#t=8" });
  const id = await firstAnalogy(page);
  await page.locator(`.graph .item[data-id="${id}"]`).first().click();
  await settled(page);
  assert.equal(await selected(page), id);
  const inspector = page.locator("#inspector");
  assert.match(await inspector.locator(".big").textContent(), /^0\.88sure at 8 s/);
  assert.match(await inspector.locator(".definition .now").textContent(), /^at 7 sH = h, C = s1/);
  assert.equal(await inspector.locator("tr.missed").first().locator("td").last().textContent(), "pruned");
  assert.match(await inspector.locator(".verdict").first().textContent(), /3\/4 = 0\.75, accepted/);
  assert.match(await page.locator("#film .bound .name", { hasText: "s1" }).textContent(), /C = s1/);
  assert.deepEqual(noise, []);
  await close();
});

test("what a model was bound to in an earlier frame is said with its time, not as what is so now", async () => {
  // The hand was moved at 7 s; at 8 s the move's condition is still bound to where it began.
  const { page, noise, close } = await open(demo, { hash: "#t=8.06&view=knowledge" });
  const label = page.locator("#inspector .definition .now .label");
  const labels = new Set();
  for (const ring of await page.locator(".graph .item").evaluateAll((items) => [...new Set(items.map((item) => item.dataset.id))])) {
    await page.evaluate((id) => { location.hash = `#t=8.06&view=knowledge&sel=${id}`; }, ring);
    await page.waitForFunction((id) => location.hash.includes(id), ring);
    await settled(page);
    if (await label.count()) labels.add(await label.textContent());
  }
  assert.ok(labels.has("now"), [...labels].join());
  assert.ok(labels.has("at 7.06 s"), [...labels].join());
  assert.deepEqual(noise, []);
  await close();
});

test("a veto says what it is bound to while its state holds, though no prediction comes of it", async () => {
  // At 1.1 s it denies that the sphere can be let go, and nothing fires.
  const { page, noise, close } = await open("scenarios/hand_grab_sphere_learn", { hash: "#t=1.1&view=knowledge&sel=mdl_150" });
  const now = page.locator("#inspector .definition .now");
  assert.equal(await now.textContent(), "nowS = s, P = 15, H = h");
  // It goes on through the frames in which the same is so, and ends where it is not.
  for (const [at, text] of [["1.4", "nowS = s, P = 15, H = h"], ["1.8", "nowS = s, P = 5, H = h"], ["0.9", "nownot seen to hold at this moment"]]) {
    await page.evaluate((t) => { location.hash = `#t=${t}&view=knowledge&sel=mdl_150`; }, at);
    await settled(page);
    assert.equal(await now.textContent(), text, at);
  }
  assert.deepEqual(noise, []);
  await close();
});

test("a fall of confidence carries its number, where there is room", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn", { hash: "#t=2&view=knowledge&sel=mdl_46" });
  assert.deepEqual(await page.locator("#inspector .life .value tspan").allTextContents(), ["1.00", "0.67", "0.75", "0.80"]);
  await close();
});

test("states that read alike are told apart by what they are made of", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn", { hash: "#view=knowledge&sel=mdl_153" });
  const block = page.locator("#inspector .block", { hasText: "Which states is it made of?" });
  assert.deepEqual(await block.locator(".tree b").allTextContents(), ["cst_45", "cst_68"]);
  await block.locator("button", { hasText: "cst_45" }).click();
  await settled(page);
  assert.equal(await selected(page), "cst_45");
  await close();
});

test("what is learned later on a generalised state is not said to have pruned anything", async () => {
  const { page, close } = await open("scenarios/size_pruned_first_scripted", { hash: "#view=knowledge&sel=mdl_196" });
  assert.match(await page.locator("#inspector .definition .lhs").textContent(), /^cst_79.*C shape cube, at P$/);
  assert.equal(await page.locator("#inspector .definition s, #inspector .definition .cut").count(), 0);
  await close();
});

test("a goal that a veto only held up says which", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn");
  await page.locator("#overview .drive-button", { hasText: "hold nothing again" }).click();
  await settled(page);
  const block = page.locator("#inspector .block", { hasText: "What held it up?" });
  assert.match(await block.textContent(), /stands against it: mdl_157/);
  assert.deepEqual(await block.locator(".tree").last().locator("b").allTextContents(), ["mdl_157"]);
  // Nothing held up the one that was reached straight away.
  await page.locator("#overview .drive-button", { hasText: "sphere at 15" }).click();
  await settled(page);
  assert.equal(await page.locator("#part-whynot").count(), 0);
  await close();
});

test("a clicked thing tells what is known of it", async () => {
  const { page, noise, close } = await open("full", { hash: "#t=8" });
  await page.locator("#film .object", { hasText: "cyl" }).locator(".area").click();
  assert.match(await page.locator("#inspector h2").textContent(), /cyl/);
  assert.match(await page.locator("#inspector table").first().textContent(), /position/);
  assert.deepEqual(noise, []);
  await close();
});

test("why leads back to a seen fact and moves the clock to its frame", async () => {
  const { page, close } = await open("full", { hash: "#t=8" });
  const id = await firstAnalogy(page);
  await page.locator(`.graph .item[data-id="${id}"]`).first().click();
  const seen = page.locator("#inspector .tree button", { hasText: "Seen:" }).first();
  const at = await seen.locator("time").textContent();
  assert.ok(await seen.locator(".thumb img").count(), "a cause shows the frame it was seen in");
  await seen.click();
  assert.equal(Number.parseFloat(await time(page)), Number.parseFloat(at));
  await close();
});

test("a composite state is selected by itself, and leads to what is said where it holds", async () => {
  const { page, close } = await open("full", { hash: "#t=8&view=knowledge" });
  const model = await firstAnalogy(page);
  const state = await page.locator(`.graph .item[data-subject="${model}"]`).first().getAttribute("data-id");
  assert.match(state, /^cst_\d+$/);
  await page.locator(`.graph .item[data-id="${state}"]`).first().click();
  await settled(page);
  assert.equal(await selected(page), state);
  const inspector = page.locator("#inspector");
  assert.match(await inspector.locator(".kind").textContent(), new RegExp(`${state}, composite state, made by analogy`));
  assert.match(await inspector.textContent(), /When did it hold\?/);
  assert.ok(await inspector.locator(".tree button", { hasText: `${state} holds: ` }).count() > 0, "the moments at which it held");
  assert.match(await inspector.textContent(), /Generalised from/);
  // To its requirement model and back.
  await inspector.locator(".tree button", { hasText: model }).first().click();
  await settled(page);
  assert.equal(await selected(page), model);
  await inspector.locator(".definition .lhs button", { hasText: state }).click();
  await settled(page);
  assert.equal(await selected(page), state);
  // And it is found by its id.
  await page.keyboard.press("/");
  await page.keyboard.type(state);
  assert.match(await page.locator("#results button").first().textContent(), new RegExp(`${state}$`));
  await close();
});

test("knowledge that is called the same is told apart by its id", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn", { hash: "#view=knowledge" });
  const curves = await page.locator(".lane-labels button[data-subject]").allTextContents();
  assert.ok(curves.length > 1);
  assert.equal(new Set(curves).size, curves.length, curves.join("; "));
  // In the overview by its conditions, too.
  await page.locator("#tab-overview").click();
  const rows = page.locator("#overview .pieces tr", { hasText: "Veto: release a sphere" });
  assert.ok(await rows.count() > 1);
  // A time before that only one has tells it apart already.
  const alike = rows.filter({ hasNotText: "seen 0.2 s before" });
  assert.equal(await alike.count(), await rows.count() - 1);
  const conditions = await rows.locator(".apart").allTextContents();
  assert.equal(conditions.length, await alike.count());
  assert.ok(conditions.some((text) => /^if .*H holding \[S\], S sphere at P/.test(text)), conditions.join("; "));
  await close();
});

// What was filled in above it pushed it away.
test("the part that was asked for stays in sight while more is filled in above it, until the reader scrolls", async () => {
  const { page, close } = await open(demo, { hash: "#t=9&view=overview&sel=mdl_204", height: 560 });
  // Some browsers keep the place by themselves, others do not.
  await page.evaluate(() => { document.getElementById("inspector").style.overflowAnchor = "none"; });
  await page.locator("#inspector .jump").getByRole("button", { name: "why" }).click();
  const top = () => page.locator("#part-why").evaluate((node) => node.getBoundingClientRect().top - document.getElementById("inspector").getBoundingClientRect().top);
  // Something that comes late, as lists and pictures do.
  const fillIn = () => page.evaluate(async () => {
    const late = document.createElement("p");
    late.style.height = "300px";
    const first = document.querySelector("#inspector .block");
    first.before(late);
    first.append(late);
    for (let i = 0; i < 3; ++i) await new Promise((resume) => requestAnimationFrame(resume));
  });
  const asked = await top();
  assert.ok(asked < 120, String(asked));
  await fillIn();
  assert.ok(Math.abs(await top() - asked) < 3, String(await top()));
  await page.mouse.move(1200, 300);
  await page.mouse.wheel(0, -200);
  await page.waitForFunction((before) => document.getElementById("part-why").getBoundingClientRect().top > before + 150, asked);
  const moved = await top();
  await fillIn();
  assert.ok(await top() >= moved + 150, "left where the reader scrolled to");
  // Asked for while the next selection is on its way.
  await page.evaluate(() => {
    document.querySelector(".drive-button").click();
    [...document.querySelectorAll("#inspector .jump button")].find((button) => button.textContent === "why").click();
  });
  await page.waitForFunction(() => document.querySelector("#inspector h2").textContent === "hold s1");
  assert.ok(await top() < 120, String(await top()));
  await close();
});
