// Measures a report in Chromium, as a reader feels it: how long until it answers, and the longest time it does not
// while somebody scrubs, scrolls and types. Made for large episodes; ./report_bench makes them and calls this.
//
//   node report_bench.cjs REPORT.html... [--profile]     a table; --profile: where the time of opening goes
"use strict";
const fs = require("node:fs");
const path = require("node:path");
const { chromium } = require("playwright-core");

const kOpenings = 3;
const executablePath = process.env.CHROMIUM || "/usr/bin/chromium";

// Inside the page: the gaps between drawn frames, and tasks that hold the page up. A gap counts as a stall from the
// frame before the work to the frame after it.
function watch() {
  const seen = { ready: 0, gap: 0, task: 0, on: false };
  window.__bench = seen;
  const note = () => {
    if (!seen.ready && document.documentElement && document.documentElement.dataset.ready === "true") seen.ready = performance.now();
  };
  new MutationObserver(note).observe(document, { subtree: true, childList: true, attributes: true, attributeFilter: ["data-ready"] });
  new PerformanceObserver((list) => {
    for (const entry of list.getEntries()) if (seen.on) seen.task = Math.max(seen.task, entry.duration);
  }).observe({ type: "longtask", buffered: true });
  let last = 0;
  const frame = (now) => {
    if (seen.on && last) seen.gap = Math.max(seen.gap, now - last);
    last = now;
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}

const frames = (page, count = 1) => page.evaluate((n) => new Promise((done) => {
  const next = () => (n-- > 0 ? requestAnimationFrame(next) : done());
  next();
}), count);

// What somebody does for some seconds; returns the longest gap between frames and the longest task.
async function stall(page, act) {
  await page.keyboard.press(act.name === "scroll the events" ? "4" : "2");  // events, knowledge
  await page.waitForTimeout(200);
  await page.evaluate(() => Object.assign(window.__bench, { gap: 0, task: 0, on: true }));
  await act(page);
  await frames(page, 3);
  return page.evaluate(() => { window.__bench.on = false; return { gap: window.__bench.gap, task: window.__bench.task }; });
}

const firstOf = async (page, ...selectors) => {
  for (const selector of selectors) {
    const found = page.locator(selector).first();
    if (await found.count() && await found.isVisible()) return found;
  }
  return null;
};

const actions = {
  async "drag over the lanes"(page) {
    const field = await firstOf(page, ".lane-field", "#lanes canvas", "#lanes");
    const box = await field.boundingBox();
    const pane = await page.locator("#lanes").boundingBox();
    const left = Math.max(box.x, pane.x + 150) + 10, right = Math.min(box.x + box.width, pane.x + pane.width) - 10;
    const y = pane.y + Math.min(pane.height, 300) - 8;
    await page.mouse.move(left, y);
    await page.mouse.down();
    for (let i = 1; i <= 60; ++i) { await page.mouse.move(left + (right - left) * i / 60, y); await frames(page); }
    for (let i = 60; i >= 0; i -= 7) { await page.mouse.move(left + (right - left) * i / 60, y); await frames(page); }
    await page.mouse.up();
  },
  async "arrow keys held"(page) {
    await page.keyboard.press("Home");
    for (const key of ["ArrowRight", "ArrowLeft"]) {
      for (let i = 0; i < 60; ++i) await page.keyboard.down(key);
      await page.keyboard.up(key);
    }
  },
  async "#t= changes"(page) {
    const end = await page.evaluate(() => {
      const cursor = document.querySelector("[role=slider]");
      return Number(cursor ? cursor.getAttribute("aria-valuemax") : 0) || 100;
    });
    for (let i = 0; i < 40; ++i) {
      await page.evaluate((t) => { location.hash = `t=${t}`; }, ((i * 0.6180339887) % 1 * end).toFixed(1));
      await frames(page, 2);
    }
  },
  async "scroll the events"(page) {
    const list = await firstOf(page, ".events-list");
    await list.hover();
    for (let i = 0; i < 60; ++i) { await page.mouse.wheel(0, 400 + 300 * i); await frames(page); }
    for (let i = 0; i < 10; ++i) {
      await list.evaluate((node, part) => { node.scrollTop = node.scrollHeight * part; }, (i * 0.6180339887) % 1);
      await frames(page, 2);
    }
  },
  async "type in find"(page) {
    const query = page.locator("#query");
    await query.focus();
    for (const words of ["grab_12", "sphere holding", "mdl_9", "why"]) {
      await page.keyboard.type(words, { delay: 30 });
      await page.waitForTimeout(150);
      await query.evaluate((node) => { node.value = ""; node.dispatchEvent(new Event("input", { bubbles: true })); });
    }
    await page.keyboard.press("Escape");
  },
};

async function measure(browser, file) {
  const openings = [];
  const out = { file: path.basename(file), megabytes: fs.statSync(file).size / 1e6 };
  let page, context;
  for (let i = 0; i < kOpenings; ++i) {
    if (context) await context.close();
    context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
    page = await context.newPage();
    page.on("pageerror", (error) => { console.error(`error: ${out.file}: ${error.message}`); process.exitCode = 1; });
    await page.addInitScript(watch);
    await page.goto("file://" + path.resolve(file), { waitUntil: "commit" });
    await page.waitForFunction(() => window.__bench && window.__bench.ready, null, { timeout: 180000 });
    openings.push(await page.evaluate(() => window.__bench.ready));
  }
  out.ready = openings.sort((a, b) => a - b)[Math.floor(kOpenings / 2)];
  const cdp = await context.newCDPSession(page);
  out.stalls = {};
  for (const [name, act] of Object.entries(actions)) out.stalls[name] = await stall(page, act);
  await cdp.send("HeapProfiler.collectGarbage");
  const { metrics } = await cdp.send("Performance.enable").then(() => cdp.send("Performance.getMetrics"));
  out.heap = metrics.find(({ name }) => name === "JSHeapUsedSize").value / 1e6;
  out.nodes = await page.evaluate(() => document.querySelectorAll("*").length);
  await context.close();
  return out;
}

// The functions in which a page spends its own time, opening or acting.
async function profile(browser, file) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
  const page = await context.newPage();
  await page.addInitScript(watch);
  const cdp = await context.newCDPSession(page);
  await cdp.send("Profiler.enable");
  const top = async (name, act) => {
    await cdp.send("Profiler.start");
    await act();
    const { profile: taken } = await cdp.send("Profiler.stop");
    const own = new Map();
    const byId = new Map(taken.nodes.map((node) => [node.id, node]));
    taken.samples.forEach((id, i) => {
      const { functionName, lineNumber } = byId.get(id).callFrame;
      const key = `${functionName || "(anonymous)"}:${lineNumber + 1}`;
      own.set(key, (own.get(key) || 0) + taken.timeDeltas[i] / 1000);
    });
    console.log(`\n${path.basename(file)}, ${name}: own time of functions`);
    for (const [key, ms] of [...own].filter(([key]) => !/^\((idle|root)/.test(key)).sort((a, b) => b[1] - a[1]).slice(0, 12)) {
      console.log(`  ${ms.toFixed(0).padStart(6)} ms  ${key}`);
    }
  };
  await top("opening", async () => {
    await page.goto("file://" + path.resolve(file), { waitUntil: "commit" });
    await page.waitForFunction(() => window.__bench && window.__bench.ready, null, { timeout: 180000 });
  });
  for (const [name, act] of Object.entries(actions)) await top(name, async () => { await page.keyboard.press(name === "scroll the events" ? "4" : "2"); await act(page); });
  await context.close();
}

async function main() {
  const files = process.argv.slice(2).filter((argument) => argument.endsWith(".html"));
  // The sandbox needs rights that containers do not give.
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--enable-precise-memory-info"] });
  const rows = [];
  for (const file of files) {
    if (process.argv.includes("--profile")) await profile(browser, file);
    else rows.push(await measure(browser, file));
  }
  await browser.close();
  if (!rows.length) return;
  const line = (name, cells) => console.log("| " + [name.padEnd(34), ...cells.map((cell) => String(cell).padStart(18))].join(" | ") + " |");
  line("", rows.map((row) => row.file));
  console.log("|" + ["", ...rows].map((_, i) => "-".repeat(i ? 20 : 36)).join("|") + "|");
  line("size, MB", rows.map((row) => row.megabytes.toFixed(2)));
  line("ready after, ms", rows.map((row) => row.ready.toFixed(0)));
  for (const name of Object.keys(actions))
    line(`${name}: longest stall, ms`, rows.map((row) => `${row.stalls[name].gap.toFixed(0)} (task ${row.stalls[name].task.toFixed(0)})`));
  line("JavaScript heap, MB", rows.map((row) => row.heap.toFixed(1)));
  line("elements in the page", rows.map((row) => row.nodes));
}

main().catch((error) => { console.error(error.message); process.exit(1); });
