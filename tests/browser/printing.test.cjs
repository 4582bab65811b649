// On paper nothing is cut off and nothing has to be scrolled.
"use strict";
const assert = require("node:assert/strict");
const { test } = require("node:test");
const reports = require("./lib/reports.cjs");
const { quiet, useBrowser } = require("./lib/browser.cjs");

const open = useBrowser();

test("a print leaves nothing cut", async () => {
  const { page, close } = await open(reports.demo, { width: 1024, height: 1400 });
  await page.emulateMedia({ media: "print" });
  await quiet(page);
  const cut = await page.evaluate(() => {
    const found = [];
    for (const node of document.querySelectorAll("body, body *")) {
      if (node instanceof SVGElement || !node.checkVisibility()) continue;
      const style = getComputedStyle(node);
      const hides = (overflow) => overflow !== "visible";
      // A picture may be shown in part, a word shortened with an ellipsis, and words for screen readers take no room.
      if (style.textOverflow === "ellipsis" || node.clientWidth <= 1 || node.firstElementChild?.matches("img:only-child") || node.closest("[hidden], dialog:not([open])")) continue;
      const wide = hides(style.overflowX) && node.scrollWidth > node.clientWidth + 1 && node.clientWidth > 0;
      const high = hides(style.overflowY) && node.scrollHeight > node.clientHeight + 1 && node.clientHeight > 0;
      if (wide || high) found.push(`${node.outerHTML.slice(0, 80)} ${node.scrollWidth}x${node.scrollHeight} in ${node.clientWidth}x${node.clientHeight}`);
    }
    if (document.documentElement.scrollWidth > document.documentElement.clientWidth) found.push("the page is too wide");
    return found;
  });
  assert.deepEqual(cut, []);
  await close();
});
