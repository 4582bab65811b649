// The page of a difference: its answers, filters, selection and address; how it is read and printed.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const { findings, focusUnseen, looks, motion } = require("./lib/access.cjs");
const { inHash, quiet, useBrowser } = require("./lib/browser.cjs");
const { Firefox, program } = require("./lib/firefox.cjs");
const reports = require("./lib/reports.cjs");

const open = useBrowser();
const counts = (page) => page.locator("#kinds .kind").evaluateAll((rows) =>
  Object.fromEntries(rows.map((row) => [row.querySelector("span").textContent, Number(row.querySelector("b").textContent)])));
const listed = (page) => page.locator("#list .piece").count();
const detail = (page) => page.locator("#detail").innerText();

test("two runs that know the same are said to, and what they know is there to look at", async () => {
  const { page, noise, close } = await open("diffs/same");
  assert.equal(await page.locator("h1").textContent(), "A and B know the same");
  assert.match(await page.locator("#summary").textContent(), /^All 19 pieces of knowledge are the same in both/);
  const { "the same": same, ...rest } = await counts(page);
  assert.equal(same, 19);
  assert.deepEqual([...new Set(Object.values(rest))], [0]);
  assert.equal(await listed(page), 0);
  assert.match(await page.locator("#inputs").innerText(), /Nothing: the same scenario, seed and parameters\.[^]*Nowhere/);
  assert.equal(await page.locator("#same-list .piece").count(), 19);
  await page.locator("#same-list").getByText("grab_type_2 something large").click();
  assert.match(await detail(page), /the same[^]*Both have it, equal in what it says[^]*C size large, at P[^]*confidence/);
  assert.equal(await page.locator("#detail mark").count(), 0);
  assert.deepEqual(noise, []);
  await close();
});

test("a lesson less: the first screen says what is missing, why, and how it ended", async () => {
  const { page, noise, close } = await open("diffs/lesson");
  assert.equal(await page.locator("h1").textContent(), "A knows 5 pieces that B does not");
  assert.equal((await counts(page))["only in A"], 5);
  const ends = await page.locator("#ends").innerText();
  assert.match(ends, /hold cyl\s+reached\s+1\.5 s\s+missed 2\.3 s/);
  const inputs = await page.locator("#inputs").innerText();
  assert.match(inputs, /one lesson only/);
  assert.match(inputs, /After 13 common steps:\s+A\s+0\.41 s, #\d+: The teacher commands move \[h 5\]\.\s+B\s+0\.41 s, #\d+: Drive: hold s1\./);
  await page.locator("#inputs summary").first().click();
  assert.match(await page.locator("#inputs .lines").first().innerText(), /# Second lesson: the large cube\./);
  // All of that without scrolling.
  const below = await page.evaluate(() => ["title", "kinds", "sure", "ends"].filter((id) => document.getElementById(id).getBoundingClientRect().bottom > innerHeight));
  assert.deepEqual(below, []);
  assert.deepEqual(noise, []);
  await close();
});

test("counts are those of the program, and each kind shows just its own", async () => {
  for (const name of reports.diffs) {
    const { page, close } = await open(name);
    const all = await listed(page);
    const { "the same": same, ...rest } = await counts(page);
    assert.equal(Object.values(rest).reduce((sum, count) => sum + count, 0), all, name);
    await page.locator("#same").evaluate((node) => { node.open = true; });
    await quiet(page);
    assert.equal(await page.locator("#same-list .piece").count(), same, name);
    for (const [words, count] of Object.entries(rest)) {
      if (!count) continue;
      const button = page.locator("#kinds button").filter({ hasText: words });
      await button.click();
      assert.equal(await button.getAttribute("aria-pressed"), "true");
      assert.equal(await listed(page), count, name + ": " + words);
      assert.deepEqual(await page.locator("#list .piece .line:first-child b").evaluateAll((nodes) => [...new Set(nodes.map((node) => node.textContent))]), [words]);
      await page.locator("#kinds button").filter({ hasText: words }).click();
      assert.equal(await listed(page), all);
    }
    await close();
  }
});

test("pieces that differ by a condition are paired, condition beside condition, with the ids of both", async () => {
  const { page, close } = await open("diffs/forms");
  // What is chosen first is the piece that both have in another form.
  const text = await detail(page);
  assert.match(text, /more specific in B[^]*grab_type_2 a cube → grab_type_2 a large cube/);
  const heads = await page.locator("#detail .beside thead th").allInnerTexts();
  assert.match(heads[0], /^A grab_type_2 a cube\s+mdl_\d+ on cst_\d+, of mdl_\d+$/);
  assert.match(heads[1], /^B grab_type_2 a large cube\s+mdl_\d+ on cst_\d+, of mdl_\d+$/);
  const rows = await page.locator("#detail .beside tbody tr").evaluateAll((nodes) => nodes.map((row) => [...row.cells].map((cell) => cell.textContent)));
  assert.deepEqual(rows.filter(([a]) => a === "nothing"), [["nothing", "C size large, at P (only in B)"]]);
  assert.ok(rows.some(([a, b]) => a === "H hand at P" && b === "H hand at P"));
  // What only one has stands beside its nearest relative.
  await page.locator("#list .piece", { hasText: "more general than \u201cgrab_type_1 a small cube\u201d of A" }).click();
  assert.match(await detail(page), /A does not have it\. Nearest:\s+grab_type_1 a small cube/);
  // And leads there.
  await page.locator("#detail .beside thead button", { hasText: "grab_type_1 a small cube" }).click();
  assert.match(await detail(page), /^the same\s+requirement model\s+grab_type_1 a small cube/);
  await close();
});

test("a confidence that differs is shown on a scale, in numbers and over time, and leads to its piece", async () => {
  const { page, close } = await open("diffs/forms");
  const row = page.locator("#sure button.scale").first();
  assert.match(await row.innerText(), /grab_type_1 \[X\] makes X holding \[Y\][^]*\+0\.50/);
  await row.click();
  const text = await detail(page);
  assert.match(text, /other confidence or state/);
  assert.match(text, /confidence\s+0\.50\s+1\.00/);
  assert.match(text, /evidence\s+right 1 of 2\s+right 2 of 2/);
  const said = await page.locator("#detail .curves").getAttribute("aria-label");
  assert.match(said, /^A ends at 0\.50 after \d+ steps?, B ends at 1\.00 after \d+ steps?$/);
  assert.equal(await page.locator("#detail .curves g").count(), 2);
  await close();
});

test("paper against openaera: the parameter that was changed is named", async () => {
  const { page, close } = await open("diffs/openaera");
  assert.match(await page.locator("#inputs").innerText(), /parameter analogy_mode\s+paper\s+openaera/);
  assert.ok(await listed(page) > 0);
  await close();
});

test("an earlier moment of the same run has less, and is said to be one", async () => {
  const { page, close } = await open("diffs/earlier");
  assert.match(await page.locator("#sides").innerText(), /@0\.72s, as it was at 0\.72 s/);
  assert.match(await page.locator("h1").textContent(), /^B knows \d+ pieces? that A does not/);
  const derived = page.locator("#list .piece", { hasText: "grab_type_1 something small" });
  await derived.click();
  assert.match(await detail(page), /only in B[^]*without \u201cC shape cube, at P\u201d[^]*made by analogy/);
  await close();
});

test("what B gave up again is counted apart and said to be given up in the list, the piece and the map", async () => {
  const { page, noise, close } = await open("diffs/given_up");
  assert.equal(await page.locator("h1").textContent(), "B alone knows 1 piece, and had 6 more that it gave up; 2 confidences differ");
  const gone = page.locator("#list .piece", { has: page.locator(".fate", { hasText: /^given up at [\d.]+ s$/ }) });
  assert.equal(await gone.count(), 6);
  assert.equal(await page.locator("#list .piece.added").count(), 7);
  assert.equal(await page.locator("#map .chip.given-up .fate").count(), 6);
  // Vetoes on the same conditions differ in how long before they are seen.
  const vetoes = await page.locator("#map .chip", { hasText: "not if " }).allTextContents();
  assert.ok(vetoes.some((text) => text.includes("not if seen 0.2 s before: ")), vetoes.join("\n"));
  assert.ok(vetoes.some((text) => text.includes("not if seen 0.1 s before: ")), vetoes.join("\n"));
  assert.ok(vetoes.some((text) => !text.includes("seen ")), vetoes.join("\n"));
  await gone.first().click();
  const text = await detail(page);
  assert.match(text, /veto\s+given up at [\d.]+ s[^]*Only B had [^]*given up[^]*state\s+\u2013\s+given up at [\d.]+ s/);
  // A veto says what it speaks against.
  assert.match(text, /release \[H\]\s+nothing\s+not H holding \[\]/);
  assert.deepEqual(noise, []);
  await close();
});

test("words find titles, ids and conditions; nothing found is said", async () => {
  const { page, close } = await open("diffs/forms");
  const all = await listed(page);
  const id = (await page.locator("#list .piece .ids").first().innerText()).split(" ").pop();
  for (const words of [id, "SIZE SMALL", "veto"]) {
    await page.locator("#query").fill(words);
    const some = await listed(page);
    assert.ok(some > 0 && some < all, words);
    assert.match(await page.locator("#count").textContent(), new RegExp(`^${some} of ${all} differences$`));
  }
  await page.locator("#query").fill("no such thing");
  assert.equal(await listed(page), 0);
  assert.match(await page.locator("#list").innerText(), /Nothing of this kind with these words/);
  await close();
});

test("selection, filter and words stand in the address; back and forward lead through what was chosen", async () => {
  const { page, close } = await open("diffs/forms");
  const pieces = page.locator("#list .piece");
  const keys = [await pieces.nth(0).getAttribute("data-key"), await pieces.nth(3).getAttribute("data-key")];
  await pieces.nth(0).click();
  await pieces.nth(3).click();
  assert.equal(await inHash(page, "sel"), keys[1]);
  await page.goBack();
  await page.waitForFunction((key) => document.querySelector(".piece[aria-current]")?.dataset.key === key, keys[0]);
  await page.goForward();
  await page.waitForFunction((key) => document.querySelector(".piece[aria-current]")?.dataset.key === key, keys[1]);
  await page.locator("#kinds button").filter({ hasText: "only in B" }).click();
  await page.locator("#query").fill("size");
  const address = await page.evaluate(() => location.hash);
  const shown = await listed(page);
  await close();
  const again = await open("diffs/forms", { hash: address + "&th=dark" });
  assert.equal(await listed(again.page), shown);
  assert.equal(await inHash(again.page, "kind"), "added");
  assert.equal(await again.page.locator("#query").inputValue(), "size");
  assert.equal(await again.page.evaluate(() => document.documentElement.dataset.theme), "dark");
  await again.close();
});

test("keys: through the list, find, all kinds, help", async () => {
  const { page, close } = await open("diffs/forms", { hash: "#kind=added" });
  const first = await page.locator("#list .piece").first().getAttribute("data-key");
  await page.keyboard.press("j");
  assert.equal(await inHash(page, "sel"), first);
  await page.keyboard.press("j");
  assert.equal(await inHash(page, "sel"), await page.locator("#list .piece").nth(1).getAttribute("data-key"));
  await page.keyboard.press("k");
  assert.equal(await inHash(page, "sel"), first);
  await page.keyboard.press("0");
  assert.equal(await inHash(page, "kind"), null);
  await page.keyboard.press("/");
  assert.equal(await page.evaluate(() => document.activeElement.id), "query");
  await page.keyboard.press("Escape");
  await page.keyboard.press("?");
  assert.ok(await page.locator("#keys").isVisible());
  await page.keyboard.press("Escape");
  assert.ok(!await page.locator("#keys").isVisible());
  await page.locator("#list .piece").nth(2).focus();
  await page.keyboard.press("Enter");
  assert.equal(await inHash(page, "sel"), await page.locator("#list .piece").nth(2).getAttribute("data-key"));
  await close();
});

test("the map groups conditions under what they allow, and its pieces lead to the same selection", async () => {
  const { page, close } = await open("diffs/lesson");
  const group = page.locator("#map .group", { hasText: "grab_type_2 [X] makes X holding [Y]" });
  assert.equal(await group.locator(".chip.indent").count(), 2);
  await group.locator(".chip.indent").first().click();
  assert.equal(await page.locator("#list .piece[aria-current]").count(), 1);
  assert.match(await detail(page), /grab_type_2 a large cube/);
  // Every piece is in it once.
  const keys = await page.locator("#map [data-key]").evaluateAll((nodes) => nodes.map((node) => node.dataset.key));
  assert.equal(new Set(keys).size, keys.length);
  assert.equal(keys.length, Object.values(await counts(page)).reduce((sum, count) => sum + count, 0));
  await close();
});

// The richest page in every look, the others in one each.
const cases = [...looks.map((look) => ["diffs/forms", look]), ...reports.diffs.map((name, i) => [name, looks[(i + 1) % looks.length]])];
for (const [name, look] of cases) {
  test(`axe finds nothing in ${name}, ${look.colorScheme}, at ${look.width} px, and nothing is wider than the page`, async () => {
    const { page, noise, close } = await open(name, look);
    await page.evaluate(() => { for (const details of document.querySelectorAll("details")) details.open = true; });
    await quiet(page);
    assert.deepEqual(await findings(page), []);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "it scrolls sideways");
    assert.deepEqual(noise, []);
    await close();
  });
}

for (const colorScheme of ["light", "dark"]) {
  test(`wherever the Tab key goes on a difference, focus is seen, ${colorScheme}`, async () => {
    const { page, close } = await open("diffs/forms", { colorScheme });
    assert.deepEqual(await focusUnseen(page, 70), []);
    await close();
  });
}

test("who wants less motion gets none on a difference", async () => {
  const { page, close } = await open("diffs/forms", { reducedMotion: "reduce" });
  assert.deepEqual(await motion(page), []);
  await close();
});

test("a difference is printed light, whole and without tools", async () => {
  const { page, close } = await open("diffs/lesson", { colorScheme: "dark" });
  await page.emulateMedia({ media: "print" });
  assert.ok(!await page.locator("#copy").isVisible());
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(255, 255, 255)");
  const pdf = await page.pdf({ printBackground: true });
  assert.ok(pdf.length > 10000);
  await close();
});

test("the page of a difference works in Firefox", { skip: program ? false : "firefox-esr is not installed", timeout: 120000 }, async () => {
  const firefox = await Firefox.start();
  try {
    await firefox.open("file://" + reports.fileOf("diffs/forms"));
    await firefox.until("document.documentElement.dataset.ready === 'true'");
    await firefox.click("#kinds button[data-kind='added']");
    await firefox.until("new URLSearchParams(location.hash.slice(1)).get('kind') === 'added'");
    await firefox.click("#list li:nth-child(2) .piece");
    await firefox.until("document.querySelector('#list li:nth-child(2) .piece').getAttribute('aria-current') === 'true'");
    await firefox.press("/", "small");
    await firefox.until("document.querySelectorAll('#list .piece').length > 0");
    await firefox.press("Escape");
    if (process.env.SCREENSHOTS) await firefox.screenshot(process.env.SCREENSHOTS + "/firefox-diff.png");
    assert.deepEqual(firefox.noise, []);
  } finally {
    await firefox.close();
  }
});
