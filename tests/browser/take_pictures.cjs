// Takes the pictures of the report that the documentation shows: take_pictures.cjs DEMO.html FAILURE.html DIFF.html FOLDER
//   DEMO.html     the report of `aerascope demo`
//   FAILURE.html  the report of assets/scenarios/size_pruned_first_scripted.toml
//   DIFF.html     the difference of that scenario's run and of pick_and_place_scripted.toml's
//   FOLDER        where they go, as small WebP files
// Run it through NODE_PATH=(the node_modules that tests/browser/run has fetched); look at what it made before it is kept.
"use strict";
const fs = require("node:fs");
const path = require("node:path");
const { chromium } = require("playwright-core");

const [demo, failure, diff, folder] = process.argv.slice(2);
const PICTURES = [
  { name: "overview", report: demo, t: 9, view: "overview", sel: "analogy" },
  { name: "knowledge", report: demo, t: 9, view: "knowledge", sel: "analogy" },
  { name: "reasoning", report: demo, t: 7.06, view: "reasoning", sel: "analogy" },
  { name: "events", report: demo, t: 7.06, view: "events", sel: "analogy" },
  { name: "dark", report: demo, t: 15, view: "knowledge", sel: "analogy", theme: "dark" },
  { name: "failure", report: failure, t: 0.9, view: "overview", sel: "failed" },
  { name: "vetoes", report: failure, t: 1.2, view: "knowledge", sel: "veto" },
  { name: "narrow", report: demo, t: 9, view: "overview", sel: "analogy", width: 400, height: 860, scale: 1 },
  { name: "diff", report: diff, hash: "#" },
];

// The id of what a picture is about, found by what it is.
const findSubject = (page, wanted) => page.evaluate((what) => {
  const first = (selector) => { const node = document.querySelector(selector); return node ? node.closest("[data-subject]").dataset.subject : ""; };
  if (what === "failed") return first(".lane-field .item.failed");
  if (what === "veto") return first(".graph .item.veto");
  return first(".lane-field .sign use[href='#m-analogy']");
}, wanted);

(async () => {
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: ["--no-sandbox"] });
  for (const { name, report, hash: address, t, view, sel, theme, width = 1440, height = 900, scale = 2 / 3 } of PICTURES) {
    const open = async (hash) => {
      const opened = await browser.newPage({ viewport: { width, height }, reducedMotion: "reduce" });
      await opened.goto("file://" + path.resolve(report) + hash);
      await opened.waitForFunction(() => document.documentElement.dataset.ready === "true", null, { polling: 100 });
      return opened;
    };
    let id = "";
    if (!address) {
      const first = await open("#view=knowledge&t=" + t);
      id = await findSubject(first, sel);
      await first.close();
    }
    const page = await open(address || `#view=${view}&t=${t}&sel=${encodeURIComponent(id)}` + (theme ? "&th=" + theme : ""));
    await page.waitForTimeout(1500);
    const shot = (await page.screenshot()).toString("base64");
    // A page of its own makes the small picture; the report's policy would not let it.
    const maker = await browser.newPage();
    const webp = await maker.evaluate(async ([data, factor]) => {
      const image = new Image();
      image.src = "data:image/png;base64," + data;
      await image.decode();
      const canvas = document.createElement("canvas");
      canvas.width = image.width * factor;
      canvas.height = image.height * factor;
      const pen = canvas.getContext("2d");
      pen.imageSmoothingQuality = "high";
      pen.drawImage(image, 0, 0, canvas.width, canvas.height);
      return canvas.toDataURL("image/webp", 0.82).split(",")[1];
    }, [shot, scale]);
    fs.writeFileSync(path.join(folder, name + ".webp"), Buffer.from(webp, "base64"));
    console.log(name, id, Buffer.from(webp, "base64").length, "bytes");
    await page.close();
    await maker.close();
  }
  await browser.close();
})();
