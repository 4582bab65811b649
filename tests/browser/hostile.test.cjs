// Texts that try to be markup, code or control characters appear as texts, everywhere, and nothing of them runs.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const reports = require("./lib/reports.cjs");
const { settled, useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();

// What would show that a text became more than text. `own` are the page's own elements of kinds that can run something.
const harm = () => {
  const found = [];
  if ("pwned" in window) found.push(`window.pwned is ${window.pwned}`);
  for (const node of document.querySelectorAll("*")) {
    for (const { name, value } of node.attributes) {
      if (/^on/i.test(name)) found.push(`handler ${name} in ${node.outerHTML.slice(0, 80)}`);
      if (/^(href|src|action|xlink:href)$/i.test(name) && !/^(#|blob:|data:(,|image\/))/.test(value)) found.push(`${name}=${value.slice(0, 60)}`);
    }
    if (/^(iframe|object|embed|base|frame|math|template|marquee|foreignobject)$/i.test(node.localName)) found.push(`element ${node.localName}`);
  }
  const scripts = [...document.scripts].filter((script) => script.type !== "application/octet-stream").length;
  if (scripts !== 1) found.push(`${scripts} scripts`);
  if (document.querySelectorAll("style").length !== 1) found.push("another style");
  // Whatever text is shown or said: no control characters, nothing that turns the direction around.
  const bad = /[\u0000-\u0008\u000b-\u001f\u007f-\u009f\u200e\u200f\u202a-\u202e\u2066-\u2069]/u;
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const { data, parentElement } = texts.currentNode;
    if (!/^(script|style)$/i.test(parentElement.localName) && bad.test(data)) found.push(`control character in ${JSON.stringify(data.slice(0, 100))}`);
  }
  for (const node of document.querySelectorAll("[title], [aria-label]")) {
    for (const name of ["title", "aria-label"]) if (bad.test(node.getAttribute(name) || "")) found.push(`control character in ${name} ${JSON.stringify(node.getAttribute(name).slice(0, 100))}`);
  }
  return found;
};

// Looks at every view and selects what can be selected; returns all text that was to be seen.
async function lookAround(page, check) {
  let seen = "";
  const look = async () => {
    seen += "\n" + await page.evaluate(() => document.body.innerText);
    await check();
  };
  await look();
  for (const view of ["1", "2", "3", "4"]) {
    await page.keyboard.press(view);
    for (const key of ["Home", "ArrowRight", "ArrowRight", "End"]) await page.keyboard.press(key);
    await settled(page);
    await look();
  }
  const subjects = await page.evaluate(() => [...new Set([...document.querySelectorAll("[data-subject]")].map((node) => node.dataset.subject))]);
  for (const subject of subjects.slice(0, 12)) {
    await page.evaluate((id) => { location.hash = "t=9&view=events&sel=" + encodeURIComponent(id); }, subject);
    await page.waitForTimeout(20);
    await look();
  }
  await page.locator("#query").fill("<script>");
  await page.waitForTimeout(300);
  await look();
  await page.keyboard.press("Escape");
  return seen;
}

for (const name of ["hostile", ...reports.hostile.filter((one) => !one.endsWith("endless"))]) {
  test(`nothing of the texts in ${name} runs, and they are there to be read`, { timeout: 240000 }, async () => {
    const { page, noise, close } = await open(name);
    const before = await page.title();
    const found = new Set();
    const seen = await lookAround(page, async () => { for (const one of await page.evaluate(harm)) found.add(one); });
    assert.deepEqual([...found], []);
    assert.deepEqual(noise, []);
    assert.equal(await page.title(), before);
    if (name.includes("hostile_")) assert.ok(/<script>|onerror=|onload=|javascript:|DROP TABLE|@data@/.test(seen), "no hostile text to be seen");
    await close();
  });
}

// Chooses every piece of a difference, opens what is folded, and filters; returns all text that was to be seen.
async function lookAtDifference(page, check) {
  let seen = "";
  const look = async () => {
    seen += "\n" + await page.evaluate(() => document.body.innerText);
    await check();
  };
  await page.evaluate(() => { for (const details of document.querySelectorAll("details")) details.open = true; });
  await page.waitForTimeout(50);
  await look();
  const keys = await page.evaluate(() => [...new Set([...document.querySelectorAll("[data-key]")].map((node) => node.dataset.key))]);
  for (const key of keys) {
    await page.evaluate((one) => { location.hash = "sel=" + one; }, key);
    await page.waitForTimeout(10);
    await page.evaluate(() => { for (const details of document.querySelectorAll("#detail details")) details.open = true; });
    await look();
  }
  await page.evaluate(() => { location.hash = "find=" + encodeURIComponent("<script>") + "&kind=__proto__&sel=constructor&th=<b>"; });
  await page.waitForTimeout(20);
  await look();
  return seen;
}

for (const name of reports.hostileDiffs) {
  test(`nothing of the texts in ${name} runs, and they are there to be read`, { timeout: 240000 }, async () => {
    const { page, noise, close } = await open(name);
    const before = await page.title();
    const found = new Set();
    const seen = await lookAtDifference(page, async () => { for (const one of await page.evaluate(harm)) found.add(one); });
    assert.deepEqual([...found], []);
    assert.deepEqual(noise, []);
    assert.equal(await page.title(), before);
    assert.doesNotMatch(seen, /undefined|\[object Object\]|\bNaN\b/);
    if (/hostile_(\d|pair)/.test(name)) assert.match(seen, /<script>|onerror=|onload=|javascript:|DROP TABLE|@data@/, "no hostile text to be seen");
    if (name.endsWith("endless")) assert.match(seen, /\d[\d ,.]* (letters|characters|bytes|kB|MB)/);
    if (name.endsWith("no_numbers")) assert.match(seen, /not a number/);
    const longest = seen.split("\n").reduce((most, line) => Math.max(most, line.length), 0);
    assert.ok(longest < 20000, `a line of ${longest} letters`);
    await close();
  });
}

test("between them the hostile reports show every text", async () => {
  let seen = "";
  for (const name of reports.hostile.filter((one) => one.includes("hostile_"))) {
    const { page, close } = await open(name, { hash: "#view=events&t=0" });
    const height = await page.locator(".events-list").evaluate((node) => node.scrollHeight);
    for (let y = 0; y < height; y += 500) {
      await page.locator(".events-list").evaluate((node, top) => { node.scrollTop = top; }, y);
      await page.waitForTimeout(30);
      seen += await page.locator(".events-list").innerText();
    }
    await close();
  }
  for (const text of ["<script>window.pwned=1</script>", "</script><script>window.pwned=2</script>", "<img src=x onerror=window.pwned=3>",
    "\"><svg onload=window.pwned=4>", "<!-- not closed", "]]> <![CDATA[", "&lt;b&gt;&amp;", "javascript:window.pwned=6", "${window.pwned=9}",
    "@data@ @script@ @title@", "__proto__", "constructor", "%s%n%n%d%1$s", "tab\\x09here, line\\x0afeed", "\\x1b[31mred", "nul\\x00inside", "broken \\xc3(",
    "right\\u{202e}to left", "\u{1f469}", "\u4e16\u754c", "DROP TABLE event"]) {
    assert.ok(seen.includes(text), `${JSON.stringify(text)} is nowhere to be seen`);
  }
});

test("a megabyte of text is shortened, with its length said, and the page stays quick", { timeout: 240000 }, async (t) => {
  const { page, noise, opened, close } = await open(reports.hostile.find((name) => name.endsWith("endless")));
  const title = await page.locator("#title").textContent();
  assert.ok(title.length < 2000, `the title has ${title.length} letters`);
  const started = Date.now();
  await lookAround(page, async () => {});
  t.diagnostic(`opened in ${opened} ms, looked at in ${Date.now() - started} ms`);
  assert.ok(opened < 15000, `opened in ${opened} ms`);
  const longest = await page.evaluate(() => {
    let most = 0;
    const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) if (!/^(script|style)$/i.test(texts.currentNode.parentElement.localName)) most = Math.max(most, texts.currentNode.data.length);
    return most;
  });
  assert.ok(longest < 20000, `a text of ${longest} letters is in the page`);
  assert.match(await page.evaluate(() => document.body.innerText), /\d[\d ,.]* (letters|characters|bytes|kB|MB)/);
  assert.deepEqual(noise, []);
  await close();
});

test("numbers that are none are said so", async () => {
  const { page, noise, close } = await open(reports.hostile.find((name) => name.endsWith("no_numbers")));
  const seen = await lookAround(page, async () => {});
  assert.doesNotMatch(seen, /undefined|\[object Object\]/);
  assert.deepEqual(noise, []);
  await close();
});
