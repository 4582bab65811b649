// Every report opens, says nothing on the console and asks the network for nothing.
"use strict";
const assert = require("node:assert/strict");
const fs = require("node:fs");
const path = require("node:path");
const { test } = require("node:test");
const reports = require("./lib/reports.cjs");
const { settled, useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();

test("there is a report of every shipped scenario", () => {
  assert.deepEqual(reports.scenarios, process.env.SCENARIOS.split(" ").map((name) => "scenarios/" + name).sort());
});

for (const name of [...reports.fixtures, ...reports.scenarios]) {
  test(`the report ${name} opens without a message and without a request`, async (t) => {
    const { page, noise, opened, close } = await open(name);
    for (const key of ["End", "Home", "ArrowRight", "ArrowRight"]) await page.keyboard.press(key);
    await settled(page);
    assert.deepEqual(noise, []);
    t.diagnostic(`opened in ${opened} ms`);
    await close();
  });
}

test("a part of the page that is only there to a part is waited for", async () => {
  const { page, noise, close } = await open("full");
  // As while the browser still reads the page: the last block has begun, and its text has not ended.
  const source = fs.readFileSync(path.join(__dirname, "../../viewer/page/blocks.js"), "utf8");
  const bytes = await page.evaluate(`(async () => {
    ${source}
    Object.defineProperty(document, "readyState", { configurable: true, get: () => "loading" });
    const block = document.createElement("script");
    block.type = "text/plain";
    block.id = "half-there";
    block.textContent = "AQI";
    document.body.append(block);
    const read = blockBytes("half-there");
    await new Promise((resume) => { setTimeout(resume, 50); });
    block.textContent = "AQIDBA==";
    document.dispatchEvent(new Event("DOMContentLoaded"));
    return [...await read];
  })()`);
  assert.deepEqual(bytes, [1, 2, 3, 4]);
  assert.deepEqual(noise, []);
  await close();
});
