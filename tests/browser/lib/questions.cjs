// Reads docs/questions.md: questions with the clicks that answer them, written in a fixed wording so that a test can do
// just what a reader would. A question looks like this (the text in `code` is what stands on the screen; … stands for
// anything, such as the number in mdl_…):
//   ## 3. What was pruned?
//   Report: `pick_and_place`
//   1. Click `compared` in the selection.
//   Answer, in the selection:
//   > `C shape cube` …
"use strict";

// The parts of the page by the names that the document gives them.
const REGIONS = { heading: "header", picture: "#film", clock: ".transport", story: ".left", overview: "#overview", tabs: ".tabs",
  knowledge: "#view-knowledge", reasoning: "#view-reasoning", events: "#view-events", lanes: "#lanes", selection: "#inspector" };

const CLICK = /^\d+\. Click `([^`]+)` in the (\w+)(?:, at `([^`]+)`)?(, further down)?\.$/;
const TYPE = /^\d+\. Type `([^`]+)` into the search field\.$/;
const ANSWER = /^Answer, in the (\w+):$/;

function readQuestions(text) {
  const questions = [];
  let region = "";
  const wrong = (number, line) => { throw new Error(`docs/questions.md:${number}: not understood: ${line}`); };
  const known = (name, number, line) => REGIONS[name] || wrong(number, line);
  text.split("\n").forEach((line, i) => {
    const number = i + 1;
    const title = /^## (\d+)\. (.+)$/.exec(line);
    const question = questions[questions.length - 1];
    if (title) {
      questions.push({ number: Number(title[1]), title: title[2], report: "", clicks: [], answers: [], line: number });
      region = "";
      return;
    }
    if (!question) return;
    const report = /^Report: `(\w+)`$/.exec(line);
    if (report) { question.report = report[1]; return; }
    const click = CLICK.exec(line), type = TYPE.exec(line), answer = ANSWER.exec(line), words = /^> `([^`]+)`$/.exec(line);
    if (click) question.clicks.push({ text: click[1], region: known(click[2], number, line), at: click[3] || "", scroll: Boolean(click[4]) });
    else if (type) question.clicks.push({ type: type[1] });
    else if (answer) region = known(answer[1], number, line);
    else if (words) question.answers.push({ text: words[1], region: region || wrong(number, line) });
    else if (/^(\d+\.|>|Answer|Report)/.test(line) && line !== ">") wrong(number, line);
  });
  return questions;
}

module.exports = { readQuestions };
