// The page in a headless Firefox: what it shows and saves is what the native
// program makes. The page tells of it to a server on this machine.
//
//   node firefox_test.mjs PAGE FIREFOX NATIVE_PROGRAM WORK_DIR
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import path from "node:path";
import { heatedWave, pixelsOf } from "./png.mjs";

const [pageFile, firefox, program, work] = process.argv.slice(2).map(
  (p) => path.resolve(p));
fs.rmSync(work, { recursive: true, force: true });
fs.mkdirSync(path.join(work, "profile"), { recursive: true });
process.chdir(work);
const native = (...options) => execFileSync(program, [...options, "--quiet"]);
fs.writeFileSync("wave.ply", heatedWave());
native("csg", "box(40, 30, 5) - translate(cylinder(4, 9, 64), 10, 15, -2)",
  "-o", "plate.obj");
native("csg", "translate(sphere(9, 24), 30, 15, 4)", "-o", "ball.obj");

/** Runs in the page, when that is ready. */
async function tried() {
  const fileOf = async (name) =>
    new File([await (await fetch(`/${name}`)).arrayBuffer()], name);
  const text = (bytes) => btoa(Array.from(bytes,
    (b) => String.fromCharCode(b)).join(""));
  const page = window.halfspacePage;
  const element = (id) => document.getElementById(id);
  const command = () => element("command").textContent;
  const said = {};
  try {
    await page.open([await fileOf("wave.ply")]);
    element("numbers").value = "heat";
    await page.changeColors();
    said.png = text(await page.saved("png"));
    said.render = command();
    await page.load([]);
    await page.open([await fileOf("plate.obj"), await fileOf("ball.obj")]);
    await page.load(page.parts.map((part, k) =>
      k === 1 ? { ...part, operation: "subtract" } : part));
    element("lines").value = "hidden-dashed";
    await page.render();
    said.draw = command();
    said.svg = text(await page.saved("svg"));
    said.stl = text(await page.saved("stl"));
  } catch (error) {
    said.error = String(error);
  }
  await fetch("/said", { method: "POST", body: JSON.stringify(said) });
}

const page = fs.readFileSync(pageFile, "utf8").replace("</body>",
  `<script type="module">(${tried})();</script></body>`);
let heard;
const said = new Promise((resolve) => { heard = resolve; });
const server = http.createServer((request, response) => {
  const name = request.url.slice(1);
  if (request.method === "POST") {
    let text = "";
    request.on("data", (part) => { text += part; });
    request.on("end", () => {
      response.end();
      heard(JSON.parse(text));
    });
  } else if (["wave.ply", "plate.obj", "ball.obj"].includes(name)) {
    response.end(fs.readFileSync(name));
  } else {
    response.setHeader("content-type", "text/html");
    response.end(page);
  }
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const browser = spawn(firefox, ["--headless", "--no-remote", "--profile",
  path.join(work, "profile"), `http://127.0.0.1:${server.address().port}/`],
{ stdio: "ignore", env: { ...process.env, HOME: path.join(work, "profile") } });
const late = setTimeout(() => heard({ error: "the page said nothing" }), 120000);
const found = await said;
clearTimeout(late);
browser.kill();
server.close();
server.closeAllConnections();

assert.equal(found.error, undefined);
const run = (command) => execFileSync("bash", ["-ec", command], {
  env: { ...process.env,
    PATH: `${path.dirname(program)}:${process.env.PATH}` } });
const bytes = (text) => Buffer.from(text, "base64");
run(found.render);
assert.deepEqual(pixelsOf(bytes(found.png)),
  pixelsOf(fs.readFileSync("picture.png")), "colours by numbers");
run(found.draw);
assert.ok(bytes(found.svg).equals(fs.readFileSync("figure.svg")), "SVG");
native("csg", "a - b", "a=plate.obj", "b=ball.obj", "-o", "difference.stl");
assert.ok(bytes(found.stl).equals(fs.readFileSync("difference.stl")), "STL");
console.log("firefox: all as it should be");
