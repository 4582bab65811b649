// The pages docs/visualizer-parity.md and docs/paper.md name moments of shipped scenarios by the report's address,
// `scenario#t=..&sel=..&view=..`, and say what is to be seen there. Each of these must lead where it says.
"use strict";
const assert = require("node:assert/strict");
const fs = require("node:fs");
const path = require("node:path");
const { test } = require("node:test");
const { settled, useBrowser } = require("./lib/browser.cjs");
const reports = require("./lib/reports.cjs");

const open = useBrowser();
const docs = path.join(__dirname, "..", "..", "docs");
const reportOf = (name) => (name === "demo" ? reports.demo : "scenarios/" + name);

// Every address in a page: [report, what follows the #].
const addressesIn = (file) => [...fs.readFileSync(path.join(docs, file), "utf8").matchAll(/`([a-z_]+)#([^`\s]+)`/g)]
  .map(([, name, hash]) => [reportOf(name), hash]);

// What the page is asked for and does not show, in words; "" once it shows all of it.
function missing(page, hash) {
  return page.evaluate((text) => {
    const wanted = new URLSearchParams(text), now = new URLSearchParams(location.hash.slice(1));
    for (const name of ["sel", "view"]) {
      if (wanted.has(name) && wanted.get(name) !== now.get(name)) return `${name} is ${now.get(name)}`;
    }
    const { textContent } = document.getElementById("time");
    const off = wanted.has("t") ? Math.abs(Number.parseFloat(textContent) - Number(wanted.get("t"))) : 0;
    const named = wanted.get("sel") || "";
    const head = document.querySelector("#inspector .top").textContent;
    if (off > 0.051) return "the time is " + textContent;
    return head.includes(named.replace(/^thing:/, "")) ? "" : "the inspector shows " + head;
  }, hash);
}
// The page changes its address to what it shows, after a moment: what it does not know does not stay there.
async function opens(page, hash) {
  await page.evaluate((text) => { location.hash = text; }, hash);
  await settled(page);
  let left = "";
  for (let tries = 0; tries < 50; ++tries) {
    left = await missing(page, hash);
    if (left === "") return "";
    await page.waitForTimeout(100);
  }
  return left;
}

for (const file of ["visualizer-parity.md", "paper.md"]) {
  test(`every address in ${file} opens what it names`, async () => {
    const addresses = addressesIn(file);
    assert.ok(addresses.length > 15, `addresses found in ${file}: ${addresses.length}`);
    for (const name of new Set(addresses.map(([report]) => report))) {
      assert.ok(reports.scenarios.includes(name), `${file} names ${name}; there are ${reports.scenarios.join(", ")}`);
      const { page, noise, close } = await open(name);
      await page.waitForFunction(() => location.hash !== "");
      for (const [, hash] of addresses.filter(([report]) => report === name)) {
        assert.equal(await opens(page, hash), "", `${file}: ${name}#${hash}`);
      }
      assert.deepEqual(noise, []);
      await close();
    }
  });
}

test("the numbers that paper.md speaks of are on the page of the demo", async () => {
  const { page, close } = await open(reports.demo, { hash: "#t=15&sel=mdl_204&view=knowledge" });
  const text = await page.locator("#inspector").innerText();
  for (const words of ["\u03c8 = 3/4 = 0.75, accepted", "Starts at 0.75 \u00d7 1 (mdl_157) = 0.75", "Jaccard 0.6",
    "Evidence: right 2.75 of 3: 0.75 of 1 inherited by analogy from mdl_157, 2 of 2 since.", "mdl_155", "cst_203", "cst_156 with the scene"]) {
    assert.ok(text.includes(words), `"${words}" is not in the inspector: ${text}`);
  }
  assert.deepEqual(await page.locator("#inspector .life .dot, #inspector .life .star").count(), 3);
  assert.match(await page.locator("#inspector .big").textContent(), /^0\.92/);
  await close();
});

test("of a chain of two analogies the one nearer to the goal comes first", async () => {
  const { page, close } = await open("scenarios/push_then_grab", { hash: "#t=0.41&sel=mdl_43&view=reasoning" });
  const text = await page.locator("#inspector").innerText();
  assert.ok(text.includes("\u03c8 = 2/3 = 0.667, accepted"), text);
  const [grab, push] = ["mdl_41", "mdl_43"].map((id) => page.locator("#reasoning", { hasText: `${id} starts at` }));
  assert.equal(await grab.count() + await push.count(), 2);
  const whole = await page.locator("#reasoning").innerText();
  assert.ok(whole.indexOf("mdl_41 starts at 0.75") < whole.indexOf("mdl_43 starts at 0.667"), whole);
  assert.ok(whole.includes("score 0.5"), whole);
  await close();
});
