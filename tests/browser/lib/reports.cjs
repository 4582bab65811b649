// The reports that the tests open. ./run makes them and says in REPORTS where they lie.
"use strict";
const fs = require("node:fs");
const path = require("node:path");

const folder = process.env.REPORTS;

// Of episodes written down by hand (tests/viewer/page/make_reports.cpp).
const fixtures = ["full", "no_frames", "cut_short", "slipped", "hostile"];
// Of every shipped scenario, run and reported by the program: what lies in the subfolder "scenarios".
const scenarios = fs.readdirSync(path.join(folder, "scenarios"))
  .filter((name) => name.endsWith(".html")).map((name) => "scenarios/" + name.slice(0, -5)).sort();
// Of episodes whose texts are hostile, endless, or whose numbers are none (tests/support/hostile_texts.h).
const hostile = fs.readdirSync(path.join(folder, "hostile"))
  .filter((name) => name.endsWith(".html")).map((name) => "hostile/" + name.slice(0, -5)).sort();
// Pages of differences, those with hostile texts apart.
const pages = fs.readdirSync(path.join(folder, "diffs")).filter((name) => name.endsWith(".html")).map((name) => "diffs/" + name.slice(0, -5)).sort();
const diffs = pages.filter((name) => !name.includes("hostile"));
const hostileDiffs = pages.filter((name) => name.includes("hostile"));
const demo = "scenarios/pick_and_place";

const fileOf = (name) => path.join(folder, name + ".html");

module.exports = { demo, diffs, fileOf, fixtures, folder, hostile, hostileDiffs, scenarios };
