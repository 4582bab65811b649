// What is said first: counts, outcomes, and what is missing.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const { useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();

test("the header counts and says where the report comes from", async () => {
  const { page, close } = await open("full");
  assert.equal(await page.locator("#summary").textContent(),
    "5 of 5 goals reached; 9 pieces of knowledge learned, 4 by analogy; 9 of 9 predictions came true");
  assert.match(await page.locator("#provenance").textContent(), /15 frames.*events[\s\S]*verified/);
  await close();
});

test("what was given up is counted apart: in the header, in the overview, and in Knowledge up to the cursor", async () => {
  const { page, close } = await open("scenarios/two_ways", { hash: "#view=overview&t=1.3" });
  assert.match(await page.locator("#summary").textContent(), /; 7 pieces of knowledge learned, 1 given up; /);
  assert.equal(await page.locator("#overview h2", { hasText: "What was learned?" }).locator("span").textContent(), "7 pieces of knowledge, 1 given up");
  assert.deepEqual(await page.locator(".lane-field .curve-item text").evaluateAll((texts) => texts.map((text) => text.textContent).filter((text) => /[a-z]/.test(text))), ["given up"], "in one word everywhere");
  await page.locator("#tab-knowledge").click();
  assert.equal(await page.locator("#graph-count").textContent(), "7 of 7 pieces learned, 1 given up");
  await page.keyboard.press("Home");
  assert.equal(await page.locator("#graph-count").textContent(), "0 of 7 pieces learned");
  await close();
});

test("the first screen begins with what the scenario says of itself", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn");
  assert.match(await page.locator("#overview > :first-child").textContent(), /^Babbling, a hand learns to move, .* and lets go\.$/);
  await close();
});

test("many that were given up are one line of what went wrong, which opens", async () => {
  const { page, close } = await open("scenarios/hand_grab_sphere_learn");
  const retired = page.locator("#overview .retired");
  assert.equal(await page.locator("#overview > .tree button", { hasText: "is given up" }).count(), 0);
  assert.match(await retired.locator("summary").textContent(), /^6 pieces of knowledge were given up at 2 s$/);
  await retired.locator("summary").click();
  assert.equal(await retired.locator("button", { hasText: /mdl_\d+ is given up/ }).count(), 6);
  await close();
});

test("failures carry the fail colour and a cross", async () => {
  const { page, close } = await open("slipped");
  assert.equal(await page.locator(".lane-field .failed use[href='#m-cross']").count(), 2);
  assert.match(await page.locator("#summary .fail").first().textContent(), /4 of 5 goals reached/);
  await close();
});

test("a run cut short and a report without frames say so", async () => {
  const cut = await open("cut_short");
  assert.match(await cut.page.locator("#warning").textContent(), /incomplete: it stops after event \d+/);
  await cut.close();
  const { page, close } = await open("no_frames");
  assert.match(await page.locator("#film .note").textContent(), /no frames/);
  assert.ok(await page.locator(".plan .object").count() >= 5);
  await close();
});

test("evidence says what it began with: an observation, an analogy, a failure", async () => {
  const { page, close } = await open("scenarios/pick_and_place", { hash: "#view=overview&t=15" });
  const row = (title) => page.locator(".pieces tr", { hasText: title }).first();
  const counts = async (title) => {
    await row(title).locator("button").click();
    await page.keyboard.press("End");
    await page.waitForFunction((text) => document.querySelector("#inspector h2").textContent.toLowerCase().startsWith(text.toLowerCase()), title);
    return page.locator("#inspector .counts").textContent();
  };
  assert.equal(await counts("Move the hand"), "Evidence: right 5 of 5, the observation it was learned from counted as the first.");
  assert.equal(await row("Move the hand").locator("td").nth(2).textContent(), "4", "tried four times since");
  assert.match(await counts("grab_type_1 something small"), /^Evidence: right 1\.75 of 2: 0\.75 of 1 inherited by analogy from mdl_\d+, 1 of 1 since\.$/);
  assert.equal(await counts("grab_type_1 a small cube"), "Evidence: right 1 of 1, the observation it was learned from; not put to the test yet.");
  await close();
  const failure = await open("scenarios/size_pruned_first_scripted", { hash: "#view=knowledge&t=1.2" });
  const veto = await failure.page.locator(".graph .item.veto").first().getAttribute("data-subject");
  await failure.page.evaluate((id) => { location.hash = "#view=knowledge&t=1.2&sel=" + id; }, veto);
  await failure.page.locator("#inspector .counts", { hasText: "the failure it was learned from" }).waitFor();
  await failure.close();
});

// A change of state counted as a test.
test("how often a model was tried is how often its evidence moved, also after it was confirmed", async () => {
  const { page, close } = await open("scenarios/moving_ball", { hash: "#view=overview&t=2.9" });
  const row = page.locator(".pieces tr", { hasText: "B speed S, with a ball" }).first();
  assert.equal(await row.locator("td").nth(2).textContent(), "28");
  await page.locator("#inspector .counts", { hasText: "Evidence: right 8 of 10, counted anew since 2 s, as each time it has been right often enough." }).waitFor();
  await close();
});

// The film's place stayed empty where nothing has a position.
test("a world without pictures and positions has a table of its things, as they are at the cursor", async () => {
  const { page, noise, close } = await open("scenarios/two_ways", { hash: "#t=0&view=overview" });
  const jar = page.locator("#film tr", { hasText: "jar" });
  assert.match(await page.locator("#film .note").textContent(), /^What was seen of each thing\. This world has no scene to film\.$/);
  assert.match(await jar.textContent(), /glass.*lid shut/);
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  assert.match(await jar.textContent(), /glass.*lid open/);
  await jar.getByRole("button").click();
  await page.waitForFunction(() => document.querySelector("#film tr.bound")?.textContent.startsWith("jar"));
  assert.match(await page.locator("#inspector h2").textContent(), /jar/);
  assert.deepEqual(noise, []);
  await close();
  const line = await open("scenarios/moving_ball", { hash: "#t=0.2" });
  assert.match(await line.page.locator("#film .note").textContent(), /^Places of things, drawn from the facts\./);
  await line.close();
});
