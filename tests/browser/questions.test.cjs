// The questions of docs/questions.md: each answer is on the screen after the clicks that the document names, and no more.
"use strict";
const assert = require("node:assert/strict");
const fs = require("node:fs");
const path = require("node:path");
const { test } = require("node:test");
const { settled, useBrowser } = require("./lib/browser.cjs");
const { readQuestions } = require("./lib/questions.cjs");

const open = useBrowser();
const questions = readQuestions(fs.readFileSync(path.join(__dirname, "../../docs/questions.md"), "utf8"));
const PATIENCE = Number(process.env.PATIENCE || 20000 * (process.env.AERASCOPE_SLOWNESS || 1));

// Runs in the page. Finds what can be clicked, or any element, that says `text`, and where it is: in sight if nothing
// covers its middle and no edge cuts it off. The whole text first, then a part of it.
function find({ text, region, at, clickable, scroll }) {
  const plain = (words) => words.replace(/\s+/g, " ").trim();
  const says = (node) => plain(node.getAttribute("aria-label") || (node instanceof SVGElement && node.querySelector(":scope > title")?.textContent) || node.innerText || node.textContent || "");
  const reads = (node) => plain(node.innerText || node.textContent || "");
  const pattern = plain(text).split("\u2026").map((part) => part.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")).join(".*?");
  const whole = new RegExp(`^${pattern}$`), part = new RegExp(pattern);
  const place = (node) => {
    const box = node.getBoundingClientRect();
    const x = (box.left + box.right) / 2, y = (box.top + box.bottom) / 2;
    const hit = (px, py) => { const top = document.elementFromPoint(px, py); return Boolean(top && (node.contains(top) || top.contains(node))); };
    const inside = box.width > 0 && box.left >= 0 && box.top >= 0 && box.right <= innerWidth + 1 && box.bottom <= innerHeight + 1;
    return { x, y, seen: inside && hit(x, y) && hit(x, box.top + 2) && hit(x, box.bottom - 2) };
  };
  let scopes = [...document.querySelectorAll(region)];
  if (at) {
    const rows = scopes.flatMap((scope) => [...scope.querySelectorAll("li, tr, .block, details")]).filter((node) => part.test(says(node)) && reads(node).includes(plain(at)));
    scopes = rows.sort((a, b) => reads(a).length - reads(b).length).slice(0, 1);
  }
  const kinds = clickable ? "button, summary, label, input, a, [role='button'], [role='tab']" : "*";
  const all = scopes.flatMap((scope) => [...scope.querySelectorAll(kinds)]).filter((node) => node.checkVisibility());
  const read = clickable ? says : reads;
  const fits = [...all.filter((node) => whole.test(read(node))), ...all.filter((node) => part.test(read(node)))];
  if (!fits.length) return null;
  // Of an answer the innermost element counts; it may stand at several places, of which one in sight is enough.
  const inner = clickable ? fits.slice(0, 1) : fits.filter((node) => ![...node.children].some((child) => part.test(reads(child))));
  const target = inner.find((node) => place(node).seen) || inner[0];
  const area = target.querySelector(".area") || target;
  // The page itself may still be about to bring it into sight; only what is further down is looked for there.
  if (clickable && scroll && !place(area).seen) { area.scrollIntoView({ block: "center" }); return { ...place(area), scrolled: true }; }
  return place(area);
}

async function until(page, wanted, done) {
  const end = Date.now() + PATIENCE;
  for (;;) {
    const found = await page.evaluate(find, wanted);
    if (done(found) || Date.now() > end) return found;
    await new Promise((resume) => { setTimeout(resume, 100); });
  }
}

async function follow(page, click) {
  if (click.type) {
    await page.locator("#query").click();
    await page.keyboard.type(click.type);
    return;
  }
  const found = await until(page, { ...click, clickable: true }, (place) => place && (place.seen || place.scrolled));
  assert.ok(found, `there is nothing to click that says: ${click.text}`);
  assert.ok(found.seen || found.scrolled, `is out of sight: ${click.text}`);
  await page.mouse.click(found.x, found.y);
}

test("the document has at least twenty questions, numbered, each with a report, clicks and an answer", () => {
  assert.ok(questions.length >= 20);
  questions.forEach((question, i) => {
    assert.equal(question.number, i + 1, question.title);
    assert.match(question.title, /\?$/);
    assert.ok(question.report && question.answers.length > 0, `${question.number}: report and answer`);
    assert.ok(question.clicks.length <= 3, `${question.number}: at most three clicks, there are ${question.clicks.length}`);
  });
});

for (const question of questions) {
  test(`${question.number}. ${question.title}`, async () => {
    const { page, noise, close } = await open("scenarios/" + question.report);
    try {
      // What is still being filled in would push away what a click has just brought into sight.
      for (const click of question.clicks) { await settled(page); await follow(page, click); }
      for (const answer of question.answers) {
        const found = await until(page, answer, (place) => place && place.seen);
        const failing = !found || !found.seen;
        if (failing && process.env.SHOTS) {
          await page.screenshot({ path: path.join(process.env.SHOTS, `${question.number}.png`) });
          console.log(await page.locator(answer.region).first().innerText());
        }
        assert.ok(found, `is not said: ${answer.text}`);
        assert.ok(found.seen, `is said, but out of sight: ${answer.text}`);
      }
      if (process.env.SHOTS) await page.screenshot({ path: path.join(process.env.SHOTS, `${question.number}.png`) });
      assert.deepEqual(noise, []);
    } finally {
      await close();
    }
  });
}
