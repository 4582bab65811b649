// The film as a video: it plays, the clock and everything else go with it, and it shows the moment that the clock reads.
// The same for a report whose video lies beside it (--folder).
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const { demo } = require("./lib/reports.cjs");
const { useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();
// Seconds between two pictures of the video; moments at which another scene is seen than a second before and some
// seconds after.
const films = [{ name: demo, picture: 0.05, moments: [3, 8, 10], after: 1 }, { name: "folder/wrong_grasp", picture: 0.1, moments: [2, 4, 8], after: 2 }];

// What stands where: in seconds.
const state = (page) => page.evaluate(() => {
  const video = document.getElementById("film-video");
  return { clock: Number.parseFloat(document.getElementById("time").textContent), cursor: Number(document.querySelector(".cursor").getAttribute("aria-valuenow")),
    place: document.querySelector(".cursor").getBoundingClientRect().x, film: video.currentTime, paused: video.paused,
    moving: document.getElementById("film").classList.contains("moving"), moment: document.getElementById("frame").textContent };
});
const until = (page, condition, ...more) => page.waitForFunction(condition, ...more.length ? more : [null], { timeout: 20000 });

// The picture in the pane, without names and outlines, as grey values of a small canvas. A picture of the screen, since
// the browser lets no script read a video from another file.
async function picture(page) {
  await page.evaluate(() => { for (const node of document.querySelectorAll("#film > :not(video, img)")) node.style.visibility = "hidden"; });
  const bytes = await page.locator("#film").screenshot();
  return page.evaluate(async (text) => {
    const image = new Image();
    image.src = "data:image/png;base64," + text;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: 96, height: 54 });
    const pen = canvas.getContext("2d");
    pen.drawImage(image, 0, 0, 96, 54);
    const { data } = pen.getImageData(0, 0, 96, 54);
    return Array.from({ length: 96 * 54 }, (_, i) => (data[4 * i] + data[4 * i + 1] + data[4 * i + 2]) / 3);
  }, bytes.toString("base64"));
}
const difference = (a, b) => a.reduce((sum, value, i) => sum + Math.abs(value - b[i]), 0) / a.length;

async function goTo(page, t) {
  await page.evaluate((at) => { location.hash = "#t=" + at; }, t);
  await until(page, (at) => Math.abs(Number(document.querySelector(".cursor").getAttribute("aria-valuenow")) - at) < 1e-6, t);
}
async function stillAt(page, t) {
  await goTo(page, t);
  await until(page, () => { const still = document.querySelector("#film .still"); return !document.getElementById("film").classList.contains("moving") && still.complete && still.naturalWidth > 0; });
  return picture(page);
}
async function filmAt(page, t) {
  await goTo(page, t);
  await until(page, () => document.getElementById("film").classList.contains("moving"));
  return picture(page);
}

for (const { name, picture: step, moments, after: later } of films) {
  test(`the video of ${name} plays, and clock, cursor and film go together`, async () => {
    const { page, noise, close } = await open(name, { hash: "#t=4" });
    await page.locator("#play").click();
    const seen = [];
    for (const goal of [4.5, 5.2, 6.1]) {
      await until(page, (t) => Number(document.querySelector(".cursor").getAttribute("aria-valuenow")) >= t, goal);
      seen.push(await state(page));
    }
    for (const [i, now] of seen.entries()) {
      assert.equal(now.paused, false);
      assert.equal(now.moving, true);
      // The clock reads tenths of seconds. On a busy machine the video runs ahead of what is drawn.
      assert.ok(Math.abs(now.clock - now.cursor) <= 0.051, JSON.stringify(now));
      assert.ok(Math.abs(now.film - now.cursor) < 0.7, JSON.stringify(now));
      assert.match(now.moment, new RegExp(`^frame ${Math.floor(now.cursor + 1e-6) + 1} of `));
      if (i > 0) assert.ok(now.place > seen[i - 1].place && now.film > seen[i - 1].film, JSON.stringify(seen));
    }
    await page.locator("#play").click();
    assert.equal(await page.locator("#play").getAttribute("aria-label"), "Play");
    await page.waitForTimeout(100);
    const stopped = await state(page);
    assert.equal(stopped.paused, true);
    // The clock stands at the picture that is seen.
    assert.ok(stopped.film - stopped.cursor > -1e-6 && stopped.film - stopped.cursor < step + 1e-6, JSON.stringify(stopped));
    await page.waitForTimeout(300);
    assert.deepEqual(await state(page), stopped);
    assert.deepEqual(noise.filter((line) => !/^request: file:.*\/wrong_grasp_files\/(video|image)-/.test(line)), []);
    await close();
  });

  test(`the video of ${name} shows the moment that the clock reads`, async () => {
    const { page, close } = await open(name);
    for (const moment of moments) {
      const [before, still, after] = [await stillAt(page, moment - 1), await stillAt(page, moment), await stillAt(page, moment + later)];
      // One picture on, the still is no longer at hand; little has moved since.
      const film = await filmAt(page, moment + 1.2 * step);
      const now = difference(film, still), others = [difference(film, before), difference(film, after)];
      const said = `at ${moment} s: ${now.toFixed(2)} from its still, ${others.map((one) => one.toFixed(2))} from those around`;
      assert.ok(now < 3, said);
      assert.ok(Math.min(...others) > 1.5 * now, said);
    }
    await close();
  });
}

test("a click in the lanes while the video plays takes it along", async () => {
  const { page, close } = await open(demo, { hash: "#t=2" });
  await page.locator("#play").click();
  await until(page, () => Number(document.querySelector(".cursor").getAttribute("aria-valuenow")) > 2.2);
  await page.keyboard.press("End");
  await until(page, () => document.getElementById("film-video").currentTime > 14.9);
  // It stops by itself at the end of time.
  await until(page, () => document.getElementById("play").getAttribute("aria-label") === "Play");
  assert.equal(await page.locator("#time").textContent(), "16.0 s");
  await close();
});
