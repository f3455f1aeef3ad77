// A headless Chromium, driven over a pipe by the DevTools protocol: no packages.
import { spawn } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";

export class Browser {
  #child;
  #profile;
  #number = 0;
  #waiting = new Map();
  #session;
  #read = "";
  problems = [];

  static async start(program, { width = 900, height = 620 } = {}) {
    const browser = new Browser();
    browser.#profile = fs.mkdtempSync(path.join(os.tmpdir(), "halfspace-web-"));
    browser.#child = spawn(program, [
      "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run",
      "--disable-dev-shm-usage", "--disable-extensions", "--hide-scrollbars",
      `--user-data-dir=${browser.#profile}`,
      `--window-size=${width},${height}`, "--remote-debugging-pipe",
      "about:blank",
    ], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    const from = browser.#child.stdio[4];
    from.setEncoding("utf8");
    from.on("data", (text) => browser.#hear(text));
    browser.#child.on("exit", () => {
      for (const { reject } of browser.#waiting.values())
        reject(new Error("the browser ended"));
    });
    const { targetInfos } = await browser.send("Target.getTargets");
    const page = targetInfos.find((t) => t.type === "page");
    const { sessionId } = await browser.send("Target.attachToTarget",
      { targetId: page.targetId, flatten: true });
    browser.#session = sessionId;
    await browser.send("Runtime.enable");
    await browser.send("Page.enable");
    await browser.send("Emulation.setDeviceMetricsOverride",
      { width, height, deviceScaleFactor: 1, mobile: false });
    return browser;
  }

  #hear(text) {
    this.#read += text;
    const messages = this.#read.split("\0");
    this.#read = messages.pop();
    for (const message of messages.map(JSON.parse)) {
      if (message.method === "Runtime.exceptionThrown") {
        const { text: what, exception } = message.params.exceptionDetails;
        this.problems.push(exception?.description ?? what);
      }
      const question = this.#waiting.get(message.id);
      if (!question) continue;
      this.#waiting.delete(message.id);
      if (message.error) question.reject(new Error(message.error.message));
      else question.resolve(message.result);
    }
  }

  send(method, params = {}) {
    const id = ++this.#number;
    const sessionId = method.startsWith("Target.") ? undefined : this.#session;
    this.#child.stdio[3].write(
      JSON.stringify({ id, method, params, sessionId }) + "\0");
    return new Promise((resolve, reject) =>
      this.#waiting.set(id, { resolve, reject }));
  }

  async open(url) {
    await this.send("Page.navigate", { url });
    await this.until("document.readyState === 'complete'");
  }
  /** What an expression, or a promise, comes to in the page. */
  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate",
      { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) {
      throw new Error(exceptionDetails.exception?.description ??
        exceptionDetails.text);
    }
    return result.value;
  }
  async until(expression, seconds = 60) {
    for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
      if (await this.evaluate(expression).catch(() => false)) return;
      await new Promise((done) => setTimeout(done, 50));
    }
    throw new Error(`within ${seconds} s not so: ${expression}`);
  }
  async screenshot(file) {
    const { data } = await this.send("Page.captureScreenshot");
    fs.writeFileSync(file, Buffer.from(data, "base64"));
  }
  /** Gives a page's input files of this machine, as who chooses them does. */
  async chooseFiles(selector, ...files) {
    const { root } = await this.send("DOM.getDocument");
    const { nodeId } = await this.send("DOM.querySelector",
      { nodeId: root.nodeId, selector });
    await this.send("DOM.setFileInputFiles", { nodeId, files });
  }
  async close() {
    const ended = new Promise((done) => this.#child.on("exit", done));
    await this.send("Browser.close").catch(() => {});
    await ended;
    fs.rmSync(this.#profile, { recursive: true, force: true });
  }
}
