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
