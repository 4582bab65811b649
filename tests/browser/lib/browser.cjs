// Opens reports as their readers do: in Chromium, from file://, without a network.
"use strict";
const { after, before } = require("node:test");
const { chromium } = require("playwright-core");
const reports = require("./reports.cjs");

const executablePath = process.env.CHROMIUM || "/usr/bin/chromium";

// The sandbox needs rights that containers do not give.
const launch = (more = []) => chromium.launch({ executablePath, args: ["--no-sandbox", ...more] });

// One browser for the tests of a file. Call it once, at the top; use the function it returns to open reports.
function useBrowser() {
  let browser;
  before(async () => { browser = await launch(); });
  after(async () => { if (browser) await browser.close(); });
  return (name, options) => open(browser, name, options);
}

// What a page says, asks for, or pops up is kept in `noise`, of which there must be none.
function listen(page) {
  const noise = [];
  page.on("console", (message) => noise.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => noise.push(`error: ${error.message}`));
  page.on("dialog", (dialog) => { noise.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
  page.on("popup", (popup) => noise.push(`popup: ${popup.url()}`));
  page.on("framenavigated", (frame) => {
    if (frame !== page.mainFrame()) noise.push(`frame: ${frame.url()}`);
  });
  page.on("request", (request) => {
    if (request.isNavigationRequest() && request.frame() === page.mainFrame() && request.url().startsWith("file:")) return;
    if (!/^(blob|data):/.test(request.url())) noise.push(`request: ${request.url()}`);
  });
  return noise;
}

// Opens a report by the name of its file without .html. Options: hash, width, height, and those of a browser context
// (colorScheme, reducedMotion ...).
async function open(browser, name, { hash = "", width = 1440, height = 900, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, ...options });
  const page = await context.newPage();
  settleAfterActions(page);
  const noise = listen(page);
  const started = Date.now();
  await page.goto("file://" + reports.fileOf(name) + hash);
  await ready(page);
  await quiet(page);
  return { page, noise, opened: Date.now() - started, close: () => context.close() };
}

const ready = (page, timeout = 60000) =>
  page.waitForFunction(() => document.documentElement.dataset.ready === "true", null, { timeout });

const time = (page) => page.locator("#time").textContent();
const inHash = (page, name) =>
  page.evaluate((key) => new URLSearchParams(location.hash.slice(1)).get(key), name);
const selected = (page) => inHash(page, "sel");

// Waits until what was asked for is on the screen: nothing is on its way, and two frames in a row changed nothing.
// What never rests, such as a film that plays, is waited for no longer than it takes to begin.
const quiet = (page) => page.evaluate(() => new Promise((resolve) => {
  const since = performance.now();
  let changed = false, still = 0;
  const observer = new MutationObserver(() => { changed = true; });
  observer.observe(document, { subtree: true, childList: true, attributes: true, characterData: true });
  const look = () => {
    const busy = document.documentElement.dataset.busy === "true";
    still = changed || busy ? 0 : still + 1;
    changed = false;
    const waited = performance.now() - since;
    if (still < 2 && waited < (busy ? 20000 : 400)) { requestAnimationFrame(look); return; }
    observer.disconnect();
    resolve();
  };
  requestAnimationFrame(look);
}));
// The same, and the address says it too, which is written with a delay.
async function settled(page) {
  await quiet(page);
  await page.waitForFunction(() => document.documentElement.dataset.unsaved !== "true");
}

// After what a reader does, a test looks at what came of it, not at what was there before. A dialog or a page that went
// away has nothing to wait for.
function settleAfterActions(page) {
  const calm = (object, ...names) => {
    for (const name of names) {
      const act = object[name];
      object[name] = async function actAndSettle(...given) {
        const result = await act.apply(this, given);
        const acted = typeof this.page === "function" ? this.page() : page;
        await quiet(acted).catch(() => {});
        return result;
      };
    }
  };
  calm(page.keyboard, "press");
  calm(page.mouse, "click");
  const locators = Object.getPrototypeOf(page.locator("html"));
  if (locators.settles) return;
  locators.settles = true;
  calm(locators, "click", "fill", "press", "selectOption");
}

// The first piece of knowledge made by analogy: its ring in the graph, its mark in the lanes.
async function firstAnalogy(page) {
  return page.evaluate(() => {
    const star = document.querySelector(".lane-field .sign use[href='#m-analogy']");
    return star.closest(".item").dataset.subject;
  });
}

module.exports = { firstAnalogy, inHash, launch, listen, open, quiet, ready, selected, settled, time, useBrowser };
