// Every report opens, says nothing on the console and asks the network for nothing.
"use strict";
const assert = require("node:assert/strict");
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
