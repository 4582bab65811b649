// The report in Firefox: it opens, steps, selects and finds, as in Chromium.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const reports = require("./lib/reports.cjs");
const { Firefox, program } = require("./lib/firefox.cjs");

test("the demo's report works in Firefox", { skip: program ? false : "firefox-esr is not installed", timeout: 120000 }, async () => {
  const firefox = await Firefox.start();
  try {
    await firefox.open("file://" + reports.fileOf(reports.demo) + "#t=0");
    await firefox.until("document.documentElement.dataset.ready === 'true'");
    const time = () => firefox.evaluate("document.getElementById('time').textContent");
    assert.equal(await time(), "0.0 s");
    await firefox.press("ArrowRight");
    assert.equal(await time(), "1.0 s");
    await firefox.press("End");
    assert.match(await time(), /^1\d\.0 s$/);
    await firefox.click("#lanes .item[data-subject]");
    await firefox.until("new URLSearchParams(location.hash.slice(1)).get('sel') !== null");
    await firefox.until("document.querySelector('#inspector h2') !== null");
    await firefox.press("/", "grab");
    await firefox.until("document.querySelectorAll('#results button').length > 0");
    await firefox.press("Escape");
    for (const view of ["2", "3", "4", "1"]) await firefox.press(view);
    await firefox.until("getComputedStyle(document.querySelector('header')).backgroundColor !== 'rgba(0, 0, 0, 0)'");
    if (process.env.SCREENSHOTS) await firefox.screenshot(process.env.SCREENSHOTS + "/firefox.png");
    assert.deepEqual(firefox.noise, []);
  } finally {
    await firefox.close();
  }
});
