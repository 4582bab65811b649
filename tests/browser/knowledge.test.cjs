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

test("what was only compared is said to be, not to hold", async () => {
  // The large cube is where the hand is not: the comparison left the place open.
  const { page, close } = await open("scenarios/size_pruned_first_scripted", { hash: "#t=0.41&view=knowledge&sel=mdl_80" });
  assert.equal(await page.locator("#inspector .definition .now").textContent(), "comparedH = h, C = c2");
  assert.equal(await page.locator("#film .bound").count(), 0);
  assert.match(await page.locator("#inspector .verdict").first().textContent(), /^With H = h, C = c2; what this leaves open may differ\. \u03c8 = 3\/4/);
  await close();
});

test("a model is bound in its own variables, when it predicts silently, too", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn", { hash: "#t=0.96&view=knowledge&sel=mdl_19" });
  const now = page.locator("#inspector .definition .now");
  // From 0 by 15 to 15.
  assert.equal(await now.textContent(), "nowP0 = 0, H = h, D = 15, P1 = 15");
  await close();
  const ball = await open("scenarios/moving_ball", { hash: "#t=1.4&view=reasoning&sel=mdl_8" });
  assert.match(await ball.page.locator("#inspector .definition .now").textContent(), /^nowP0 = 52, B = b, S = 20, P1 = 54$/);
  // What stood against it is not among what allowed it.
  assert.match(await ball.page.locator(".chain td[data-question='so this model applies']").textContent(), /^mdl_10 expects .*and this spoke against it:mdl_96 denies/);
  assert.match(await ball.page.locator(".chain td[data-question='expected']").textContent(), /Predicted silently: b at 54\./);
  // Silent ones count where evidence does.
  await ball.page.locator("#tab-knowledge").click();
  assert.match(await ball.page.locator(".graph .item[data-id='mdl_8']").first().textContent(), /came true \d+ of \d+/);
  await ball.close();
});

test("a sub-goal that was left says when and why", async () => {
  const { page, close } = await open("scenarios/size_pruned_first_scripted", { hash: "#t=0.61&sel=goal_129" });
  assert.match(await page.locator("#inspector").textContent(), /What came of it\? left at 0\.71 s, to look for a way again/);
  await page.evaluate(() => { location.hash = "#t=0.81&sel=goal_161"; });
  await settled(page);
  assert.match(await page.locator("#inspector").textContent(), /What came of it\?No longer pursued: h holding \[c2\] \(what it served is settled\)\.0\.9 s/);
  // What stood in its way comes first, and nothing that held is among it.
  await page.evaluate(() => { location.hash = "#t=0.9&sel=goal_72"; });
  await settled(page);
  const reasons = await page.locator("#inspector .block", { hasText: "Why not?" }).locator(".tree").first().locator(".line").allTextContents();
  assert.match(reasons[0], /Not pursued: c2 size small \(a property, which nothing changes\)/);
  assert.equal(reasons.filter((text) => /h hand|shape cube/.test(text)).length, 0, reasons.join("\n"));
  await close();
});

test("what rides on another model says where it ends up as that computes it", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn", { hash: "#t=0.96&view=knowledge&sel=mdl_69" });
  assert.match(await page.locator("#inspector .say").textContent(), /then move \[H A\] makes H at P \+ A makes S at P \+ A\.$/);
  await close();
});

test("the life of a thing has what was seen of it, that of a state only when it held", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn", { hash: "#t=2&sel=thing:s" });
  const rows = () => page.locator("#inspector .block", { hasText: /What happened with it\?|When did it hold\?/ }).locator(".tree .line").allTextContents();
  const seen = (await rows()).filter((text) => text.startsWith("Seen: s at"));
  assert.deepEqual(seen.map((text) => /at (\d+)/.exec(text)[1]), ["5", "0", "15", "5"]);
  await page.evaluate(() => { location.hash = "#t=2&sel=cst_45"; });
  await settled(page);
  const held = await rows();
  assert.ok(held.length > 2 && held.every((text) => text.startsWith("cst_45 holds: ")), held.join("\n"));
  await close();
});

test("of a long life the turns are told", async () => {
  const { page, close } = await open("scenarios/moving_ball", { hash: "#t=2.9&sel=mdl_10" });
  const life = await page.locator("#inspector .block", { hasText: "Its life" }).textContent();
  for (const words of ["mdl_10 failed too often and only predicts silently now.", "mdl_10 is in use again.", "and 25 more"]) assert.ok(life.includes(words), words + "; " + life);
  await close();
});

test("vetoes are apart from what allows a model", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn", { hash: "#t=2&sel=mdl_44" });
  const block = page.locator("#inspector .block", { hasText: "When does it work?" });
  const lists = await block.locator(".tree").evaluateAll((trees) => trees.map((tree) => [...tree.querySelectorAll("b")].map((id) => id.textContent)));
  assert.deepEqual(lists[0], ["mdl_46"]);
  assert.equal(lists[1].length, 7);
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
