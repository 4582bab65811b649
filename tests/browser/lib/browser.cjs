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
  const noise = listen(page);
  const started = Date.now();
  await page.goto("file://" + reports.fileOf(name) + hash);
  await ready(page);
  return { page, noise, opened: Date.now() - started, close: () => context.close() };
}

const ready = (page, timeout = 60000) =>
  page.waitForFunction(() => document.documentElement.dataset.ready === "true", null, { timeout });

const time = (page) => page.locator("#time").textContent();
const inHash = (page, name) =>
  page.evaluate((key) => new URLSearchParams(location.hash.slice(1)).get(key), name);
const selected = (page) => inHash(page, "sel");
const settled = (page) => page.waitForTimeout(350);  // the address is written with a delay

// The first piece of knowledge made by analogy: its ring in the graph, its mark in the lanes.
async function firstAnalogy(page) {
  return page.evaluate(() => {
    const star = document.querySelector(".lane-field .sign use[href='#m-analogy']");
    return star.closest(".item").dataset.subject;
  });
}

module.exports = { firstAnalogy, inHash, launch, listen, open, ready, selected, settled, time, useBrowser };
