// The report as its reader meets it: opened from file://, without a network, by keyboard and by mouse.
"use strict";
const assert = require("node:assert/strict");
const path = require("node:path");
const { after, before, test } = require("node:test");
const { chromium } = require("playwright-core");

const reports = process.env.REPORTS;
const executablePath = process.env.CHROMIUM || "/usr/bin/chromium";
let browser;

before(async () => {
  // The sandbox needs rights that containers do not give.
  browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
});
after(async () => { if (browser) await browser.close(); });

// Opens a report; what the browser said or asked for is kept in `noise`, of which there must be none.
async function open(name, { hash = "", width = 1440, height = 900, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, ...options });
  const page = await context.newPage();
  const noise = [];
  page.on("console", (message) => noise.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => noise.push(`error: ${error.message}`));
  page.on("request", (request) => {
    if (!/^(file|blob|data):/.test(request.url())) noise.push(`request: ${request.url()}`);
  });
  const started = Date.now();
  await page.goto("file://" + path.join(reports, name + ".html") + hash);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true", null, { timeout: 20000 });
  return { page, noise, opened: Date.now() - started, close: () => context.close() };
}
const time = (page) => page.locator("#time").textContent();
const selected = (page) => page.evaluate(() => new URLSearchParams(location.hash.slice(1)).get("sel"));
const settled = (page) => page.waitForTimeout(350);  // the address is written with a delay

// The first piece of knowledge made by analogy: its ring in the graph, its mark in the lanes.
async function firstAnalogy(page) {
  return page.evaluate(() => {
    const star = document.querySelector(".lane-field .sign use[href='#m-analogy']");
    return star.closest(".item").dataset.subject;
  });
}

for (const name of ["full", "no_frames", "cut_short", "slipped", "hostile"]) {
  test(`the ${name} report opens without a message and without a request`, async (t) => {
    const { page, noise, opened, close } = await open(name);
    await settled(page);
    assert.deepEqual(noise, []);
    t.diagnostic(`opened in ${opened} ms`);
    await close();
  });
}

test("the header counts and says where the report comes from", async () => {
  const { page, close } = await open("full");
  assert.equal(await page.locator("#summary").textContent(),
    "5 of 5 goals reached; 9 pieces of knowledge learned, 4 by analogy; 9 of 9 predictions came true");
  assert.match(await page.locator("#provenance").textContent(), /15 frames.*events[\s\S]*verified/);
  await close();
});

test("without an address it opens where experience first spoke about an analogy", async () => {
  const { page, close } = await open("full");
  assert.equal(await time(page), "8.0 s");
  assert.match(await page.locator("#inspector .kind").textContent(), /made by analogy/);
  await close();
});

test("it plays from the first frame to the last and stops", async () => {
  const { page, noise, close } = await open("full", { hash: "#t=13" });
  await page.keyboard.press(" ");
  assert.equal(await page.locator("#play").getAttribute("aria-label"), "Pause");
  await page.waitForFunction(() => document.getElementById("play").getAttribute("aria-label") === "Play", null, { timeout: 8000 });
  assert.equal(await time(page), "14.0 s");
  assert.deepEqual(noise, []);
  await close();
});

test("keys step, jump to both ends, search and explain themselves", async () => {
  const { page, close } = await open("full", { hash: "#t=5" });
  await page.keyboard.press("ArrowRight");
  assert.equal(await time(page), "6.0 s");
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("ArrowLeft");
  assert.equal(await time(page), "4.0 s");
  await page.keyboard.press("End");
  assert.equal(await time(page), "14.0 s");
  await page.keyboard.press("Home");
  assert.equal(await time(page), "0.0 s");
  await page.keyboard.press("?");
  assert.equal(await page.locator("#keys").evaluate((dialog) => dialog.open), true);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator("#keys").evaluate((dialog) => dialog.open), false);
  await page.keyboard.press("/");
  await page.keyboard.type("release");
  assert.ok(await page.locator("#results button").count() > 0);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator("#query").inputValue(), "");
  await close();
});

test("dragging anywhere on the lanes scrubs film, graph and story together", async () => {
  const { page, close } = await open("full", { hash: "#view=knowledge" });
  const box = await page.locator(".lane-field").boundingBox();
  const image = () => page.locator("#film img").getAttribute("src");
  await page.mouse.move(box.x + 20, box.y + box.height - 4);
  await page.mouse.down();
  await page.mouse.move(box.x + 30, box.y + 8);
  await page.waitForTimeout(150);
  const [earlyTime, earlyImage] = [await time(page), await image()];
  const earlyCount = await page.locator("#graph-count").textContent();
  await page.mouse.move(box.x + box.width - 120, box.y + 8, { steps: 5 });
  await page.waitForTimeout(150);
  await page.mouse.up();
  assert.notEqual(await time(page), earlyTime);
  assert.notEqual(await image(), earlyImage);
  assert.match(earlyCount, /^0 of 9/);
  assert.equal(await page.locator("#graph-count").textContent(), "9 of 9 pieces learned");
  await close();
});

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

test("a clicked model shows what it says, how sure it is and what it is bound to now", async () => {
  const { page, noise, close } = await open("full", { hash: "#t=8" });
  const id = await firstAnalogy(page);
  await page.locator(`.graph .item[data-subject="${id}"]`).first().click();
  await settled(page);
  assert.equal(await selected(page), id);
  const inspector = page.locator("#inspector");
  assert.match(await inspector.locator(".big").textContent(), /^0\.88sure at 8 s/);
  assert.match(await inspector.locator(".definition .now").textContent(), /C = s1/);
  assert.equal(await inspector.locator("tr.missed").first().locator("td").last().textContent(), "pruned");
  assert.match(await inspector.locator(".verdict").first().textContent(), /3\/4 = 0\.75, accepted/);
  assert.match(await page.locator("#film .bound .name", { hasText: "s1" }).textContent(), /C = s1/);
  assert.deepEqual(noise, []);
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
  await page.locator(`.graph .item[data-subject="${id}"]`).first().click();
  const seen = page.locator("#inspector .tree button", { hasText: "Seen:" }).first();
  const at = await seen.locator("time").textContent();
  assert.ok(await seen.locator(".thumb img").count(), "a cause shows the frame it was seen in");
  await seen.click();
  assert.equal(Number.parseFloat(await time(page)), Number.parseFloat(at));
  await close();
});

test("the address restores moment, selection and theme", async () => {
  const first = await open("full");
  const id = await firstAnalogy(first.page);
  await first.close();
  const { page, close } = await open("full", { hash: `#t=11&sel=${id}&th=dark` });
  assert.equal(await time(page), "11.0 s");
  assert.match(await page.locator("#inspector .kind").textContent(), new RegExp(id));
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  await close();
});

test("light and dark follow the system and the button", async () => {
  const { page, close } = await open("full", { colorScheme: "dark" });
  const ground = () => page.evaluate(() => getComputedStyle(document.querySelector("header")).backgroundColor);
  const dark = await ground();
  await page.locator("#theme").click();
  assert.notEqual(await ground(), dark);
  await close();
});

test("hostile names stay text", async () => {
  const { page, noise, close } = await open("hostile");
  for (const key of ["End", "Home"]) await page.keyboard.press(key);
  for (const item of await page.locator(".lane-field .item").all()) await item.dispatchEvent("keydown", { key: "Enter" });
  await settled(page);
  assert.deepEqual(noise, []);
  assert.notEqual(await page.title(), "owned");
  assert.match(await page.locator("#title").textContent(), /<script>/);
  assert.equal(await page.locator("img[src='x']").count(), 0);
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

for (const width of [1440, 1240, 800, 400]) {
  test(`nothing sticks out sideways at ${width} px`, async () => {
    const { page, close } = await open("full", { width, height: 800 });
    const over = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    assert.equal(over, 0);
    await close();
  });
}

test("focus is visible on every kind of control", async () => {
  const { page, close } = await open("full");
  const bare = [];
  for (let i = 0; i < 60; ++i) {
    await page.keyboard.press("Tab");
    bare.push(...await page.evaluate(() => {
      const node = document.activeElement;
      if (!node || node === document.body) return [];
      const style = getComputedStyle(node);
      const outlined = style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0;
      const shape = node.querySelector(".card, .frame, .bar, .focus, rect");
      const drawn = node instanceof SVGElement && shape && getComputedStyle(shape).stroke !== "none";
      return outlined || drawn ? [] : [node.outerHTML.slice(0, 120)];
    }));
  }
  assert.deepEqual([...new Set(bare)], []);
  await close();
});
