// Drives Firefox by WebDriver BiDi: as much of it as the tests need. playwright-core can only drive a Firefox of its own.
"use strict";
const { spawn } = require("node:child_process");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const WebSocket = require("ws");

const program = ["/usr/bin/firefox-esr", "/usr/bin/firefox"].find((file) => fs.existsSync(file));

class Firefox {
  // Starts it with a profile of its own and opens one page.
  static async start() {
    const firefox = new Firefox();
    firefox.profile = fs.mkdtempSync(path.join(os.tmpdir(), "aerascope-firefox-"));
    // Nothing of its own on the network: what is asked for then comes from the report.
    fs.writeFileSync(path.join(firefox.profile, "user.js"), [
      ["app.normandy.enabled", false], ["browser.safebrowsing.downloads.remote.enabled", false], ["datareporting.policy.dataSubmissionEnabled", false],
      ["network.captive-portal-service.enabled", false], ["network.connectivity-service.enabled", false], ["services.settings.server", "data:,"],
      ["toolkit.telemetry.enabled", false], ["app.update.disabledForTesting", true], ["browser.shell.checkDefaultBrowser", false],
    ].map(([name, value]) => `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});\n`).join(""));
    firefox.process = spawn(program, ["--headless", "--no-remote", "--profile", firefox.profile, "--remote-debugging-port", "0"],
      { stdio: ["ignore", "ignore", "pipe"], env: { ...process.env, HOME: firefox.profile, MOZ_HEADLESS: "1" } });
    const address = await new Promise((found, lost) => {
      let said = "";
      firefox.process.stderr.on("data", (data) => {
        said += data;
        const listening = /WebDriver BiDi listening on (ws:\/\/\S+)/.exec(said);
        if (listening) found(listening[1]);
      });
      firefox.process.on("exit", () => lost(new Error("Firefox ended: " + said.slice(-500))));
      setTimeout(() => lost(new Error("Firefox did not start in 60 s: " + said.slice(-500))), 60000).unref();
    });
    firefox.socket = new WebSocket(address + "/session");
    await new Promise((open, lost) => { firefox.socket.on("open", open); firefox.socket.on("error", lost); });
    firefox.waiting = new Map();
    firefox.noise = [];
    firefox.socket.on("message", (data) => firefox.hear(JSON.parse(data)));
    await firefox.send("session.new", { capabilities: {} });
    const { contexts } = await firefox.send("browsingContext.getTree", {});
    firefox.context = contexts[0].context;
    await firefox.send("browsingContext.setViewport", { context: firefox.context, viewport: { width: 1440, height: 900 } });
    await firefox.send("session.subscribe", { events: ["log.entryAdded", "network.beforeRequestSent"] });
    return firefox;
  }

  hear(message) {
    if (message.id) {
      const [done, failed] = this.waiting.get(message.id);
      this.waiting.delete(message.id);
      if (message.type === "error") failed(new Error(`${message.error}: ${message.message}`)); else done(message.result);
    } else if (message.method === "log.entryAdded") {
      this.noise.push(`${message.params.level}: ${message.params.text}`);
    } else if (message.method === "network.beforeRequestSent" && !/^(file|blob|data):/.test(message.params.request.url)) {
      this.noise.push(`request: ${message.params.request.url}`);
    }
  }

  send(method, params) {
    const id = (this.last = (this.last || 0) + 1);
    this.socket.send(JSON.stringify({ id, method, params }));
    return new Promise((done, failed) => this.waiting.set(id, [done, failed]));
  }

  open(url) { return this.send("browsingContext.navigate", { context: this.context, url, wait: "complete" }); }

  // The value of an expression in the page: a string, number, boolean or null.
  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send("script.evaluate",
      { expression, target: { context: this.context }, awaitPromise: true });
    if (exceptionDetails) throw new Error(exceptionDetails.text);
    return result.value;
  }

  async until(expression, timeout = 20000) {
    const end = Date.now() + timeout;
    while (!await this.evaluate(expression)) {
      if (Date.now() > end) throw new Error(`waited ${timeout} ms for ${expression}`);
      await new Promise((resume) => { setTimeout(resume, 50); });
    }
  }

  // Keys by their names ("End", "/") or text; WebDriver has private code points for those without a character.
  press(...keys) {
    const codes = { End: "\uE010", Home: "\uE011", ArrowLeft: "\uE012", ArrowRight: "\uE014", Enter: "\uE007", Escape: "\uE00C", Tab: "\uE004" };
    const actions = keys.flatMap((key) => (codes[key] ? [codes[key]] : [...key])).flatMap((value) =>
      [{ type: "keyDown", value }, { type: "keyUp", value }]);
    return this.send("input.performActions", { context: this.context, actions: [{ type: "key", id: "keyboard", actions }] });
  }

  async click(selector) {
    const where = JSON.parse(await this.evaluate(`(() => { const node = document.querySelector(${JSON.stringify(selector)}); node.scrollIntoView({ block: "nearest" });
      const box = node.getBoundingClientRect(); return JSON.stringify({ x: Math.round(box.x + box.width / 2), y: Math.round(box.y + box.height / 2) }); })()`));
    const actions = [{ type: "pointerMove", ...where }, { type: "pointerDown", button: 0 }, { type: "pointerUp", button: 0 }];
    await this.send("input.performActions", { context: this.context, actions: [{ type: "pointer", id: "mouse", actions }] });
  }

  async screenshot(file) {
    const { data } = await this.send("browsingContext.captureScreenshot", { context: this.context });
    fs.writeFileSync(file, Buffer.from(data, "base64"));
  }

  async close() {
    this.socket.close();
    const ended = new Promise((done) => { this.process.on("exit", done); });
    this.process.kill();
    await ended;
    fs.rmSync(this.profile, { recursive: true, force: true });
  }
}

module.exports = { Firefox, program };
