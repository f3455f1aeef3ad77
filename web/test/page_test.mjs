// The page in a headless Chromium, opened as a file: what it shows and saves is
// what the native program makes; broken files, large ones and a lost worker
// leave it usable.
//
//   node page_test.mjs PAGE CHROMIUM NATIVE_PROGRAM WORK_DIR
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "./browser.mjs";
import { heatedWave, pixelsOf } from "./png.mjs";

const [page, chromium, program, work] = process.argv.slice(2).map(
  (p) => path.resolve(p));
fs.mkdirSync(work, { recursive: true });
process.chdir(work);
const native = (...options) => execFileSync(program, [...options, "--quiet"]);
const read = (name) => fs.readFileSync(name);

native("csg", "box(40, 30, 5) - translate(cylinder(4, 9, 64), 10, 15, -2)",
  "-o", "plate.stl");
native("csg", "box(40, 30, 5) - translate(cylinder(4, 9, 64), 10, 15, -2)",
  "-o", "plate.obj");
native("csg", "translate(sphere(9, 24), 30, 15, 4)", "-o", "ball.obj");
fs.writeFileSync("open.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n");

const browser = await Browser.start(chromium);
/** Calls an async function of the page with values that JSON holds. */
const inPage = (work, ...values) => browser.evaluate(
  `(${work})(...${JSON.stringify(values)})`);
const fileOf = (name) => ({ name, data: read(name).toString("base64") });
const open = (...names) => inPage(async (files) => {
  const made = files.map(({ name, data }) => new File(
    [Uint8Array.from(atob(data), (c) => c.charCodeAt(0))], name));
  await halfspacePage.open(made).catch(() => {});
}, names.map(fileOf));
const said = () => inPage(() => document.getElementById("said").textContent);
const saved = async (format) => Buffer.from(await inPage(async (f) => {
  const bytes = await halfspacePage.saved(f);
  let text = "";
  for (const b of bytes) text += String.fromCharCode(b);
  return btoa(text);
}, format), "base64");
const choose = (id, value) => inPage((id, value) => {
  const element = document.getElementById(id);
  if (element.type === "checkbox") element.checked = value;
  else element.value = value;
  element.dispatchEvent(new Event(id === "at" || id === "axis" ? "input"
    : "change"));
}, id, value);
const command = () => inPage(() =>
  document.getElementById("command").textContent);
/** Runs what the page shows as the command, in the working folder. */
const runCommand = async () => execFileSync("bash", ["-ec", await command()], {
  env: { ...process.env,
    PATH: `${path.dirname(program)}:${process.env.PATH}` } });
function same(a, b, what) {
  assert.ok(Buffer.compare(a, b) === 0, `${what}: the bytes differ`);
}

try {
  await browser.open(pathToFileURL(page).href);
  // One mesh, as the program draws it.
  await open("plate.stl");
  assert.match(await said(), /^\d+ polygons$/);
  await inPage(() => halfspacePage.render());
  await browser.screenshot("one.png");
  await runCommand();
  same(await saved("svg"), read("figure.svg"), "SVG of one mesh");

  // A boolean of two; edges; the saved files.
  await inPage(() => halfspacePage.load([]));
  await open("plate.obj", "ball.obj");
  await browser.screenshot("two.png");
  await runCommand();
  same(await saved("svg"), read("figure.svg"), "SVG of two meshes");
  await inPage(() => halfspacePage.load(halfspacePage.parts.map((p, k) =>
    k === 1 ? { ...p, operation: "subtract" } : p)));
  await choose("lines", "hidden-dashed");
  await inPage(() => halfspacePage.render());
  await browser.screenshot("boolean.png");
  await runCommand();
  same(await saved("svg"), read("figure.svg"), "SVG of a difference");
  for (const format of ["stl", "obj"]) {
    native("csg", "a - b", "a=plate.obj", "b=ball.obj", "-o",
      `difference.${format}`);
    same(await saved(format), read(`difference.${format}`), format);
  }
  // The picture is the program's: its pixels are.
  const png = await saved("png");
  fs.writeFileSync("picture.png", png);
  assert.deepEqual([...png.subarray(1, 4)], [0x50, 0x4e, 0x47]);
  const view = await inPage(() => halfspacePage.viewOf());
  native("render", "result.obj", "--ids", "page.npy", "--size",
    `${view.width}x${view.height}`, "--eye", view.eye.join(), "--target",
    view.target.join(), "--up", view.up.join(), "--fov", String(view.fov));
  const ids = await inPage(async () => {
    const { ids } = await halfspacePage.ask("render",
      await halfspacePage.viewOf());
    const bytes = new Uint8Array(ids.buffer);
    let text = "";
    for (const b of bytes) text += String.fromCharCode(b);
    return btoa(text);
  });
  const npy = read("page.npy");
  const pixels = Buffer.from(ids, "base64");
  same(pixels, npy.subarray(npy.length - pixels.length), "ids of the picture");

  // A section: filled, and cut in what is saved.
  await choose("axis", "1");
  await inPage(() => halfspacePage.changeSection());
  await browser.screenshot("section.png");
  await runCommand();
  same(await saved("svg"), read("figure.svg"), "SVG of a section");
  await choose("axis", "");
  await inPage(() => halfspacePage.changeSection());

  // Files that no one grid holds go together as in the program.
  native("csg", "box(1)", "-o", "unit.obj");
  for (const [name, ends] of [["fine", ["-0.3", "1.23456789012345678901"]],
    ["far", ["0.1", "987654.3"]]]) {
    fs.writeFileSync(`${name}.obj`, read("unit.obj").toString().replace(
      /^v .*$/gm, (line) => `v ${line.split(" ").slice(1)
        .map((c) => ends[Number(c)]).join(" ")}`));
  }
  await inPage(() => halfspacePage.load([]));
  await open("fine.obj", "far.obj");
  await inPage(() => halfspacePage.load(halfspacePage.parts.map((p, k) =>
    k === 1 ? { ...p, operation: "subtract" } : p)));
  native("csg", "a - b", "a=fine.obj", "b=far.obj", "-o", "rounded.stl");
  same(await saved("stl"), read("rounded.stl"), "rounded operands");

  // Colours by a property, and by a file of numbers beside the mesh.
  fs.writeFileSync("wave.ply", heatedWave());
  fs.writeFileSync("wave.csv",
    Array.from({ length: 25 * 25 }, (_, k) => `${k % 25}\n`).join(""));
  const heat = async () => {
    await inPage(() => halfspacePage.changeColors());
    await runCommand();
    const { width, height, rgb } = pixelsOf(read("picture.png"));
    const shown = pixelsOf(await saved("png"));
    assert.deepEqual([shown.width, shown.height], [width, height]);
    same(Buffer.from(shown.rgb), Buffer.from(rgb), "colours by numbers");
  };
  await inPage(() => halfspacePage.load([]));
  await open("wave.ply");
  const sources = () => inPage(() => [...document.getElementById("numbers")
    .options].map((o) => o.value));
  assert.deepEqual(await sources(), ["", "x", "y", "z", "heat"]);
  await inPage(() => { document.getElementById("numbers").value = "heat"; });
  await heat();
  await browser.screenshot("colours.png");
  await open("wave.csv");
  assert.equal(await inPage(() => document.getElementById("numbers").value),
    "wave.csv");
  await inPage(() => { document.getElementById("map").value = "turbo"; });
  await heat();
  await inPage(() => { document.getElementById("numbers").value = ""; });
  await inPage(() => halfspacePage.changeColors());
  assert.ok(await inPage(() => document.getElementById("legend").hidden));

  // Crossing surfaces as a figure, in time.
  fs.writeFileSync("waves.obj", waves());
  await inPage(() => halfspacePage.load([]));
  await open("waves.obj");
  await choose("lines", "none");
  await inPage(() => halfspacePage.render());
  await saved("svg");
  const times = [];
  for (let k = 0; k < 5; ++k) {
    times.push(await inPage(async () => {
      const view = await halfspacePage.viewOf();
      const begin = performance.now();
      await halfspacePage.ask("draw", { view, options: {} });
      return performance.now() - begin;
    }));
  }
  console.log(`crossing surfaces as SVG: ${Math.min(...times).toFixed(0)} ms`);
  await browser.screenshot("waves.png");

  // What is wrong leaves the page as it was.
  await inPage(() => halfspacePage.load([]));
  await open("plate.stl");
  fs.writeFileSync("broken.obj", "v 0 0 0\nv 1 2 x\n");
  await open("broken.obj");
  assert.match(await said(), /broken\.obj.*line 2/);
  assert.equal(await inPage(() => halfspacePage.parts.length), 1);
  // Files that are too large, as they are and unpacked: sparse, and of zeros.
  fs.closeSync(fs.openSync("large.stl", "w"));
  fs.truncateSync("large.stl", 2 ** 31);
  execFileSync("bash", ["-c",
    "head -c 1100M /dev/zero | gzip -1 >bomb.obj.gz"]);
  for (const [name, what] of [["large.stl", /large\.stl: has 2\.0 GiB/],
    ["bomb.obj.gz", /bomb\.obj\.gz: unpacks to more than 1 GiB/]]) {
    await browser.chooseFiles("#files", path.resolve(name));
    await browser.until(`${what}.test(
      document.getElementById("said").textContent)`, 60);
    fs.rmSync(name);
  }
  assert.equal(await inPage(() => halfspacePage.parts.length), 1);
  await open("open.obj");
  await inPage(() => halfspacePage.load(halfspacePage.parts.map((p, k) =>
    k === 1 ? { ...p, operation: "add" } : p)).catch(() => {}));
  assert.match(await said(), /open\.obj/);
  await inPage(() => halfspacePage.load(halfspacePage.parts.slice(0, 1)));

  // A worker that is lost, and work that is cancelled.
  const lost = await inPage(() => {
    const question = halfspacePage.ask("save", { format: "stl" })
      .catch((error) => error.code);
    halfspacePage.worker.terminate();
    halfspacePage.lose("the worker was lost");
    return question;
  });
  assert.equal(lost, "LOST");
  await inPage(() => halfspacePage.load(halfspacePage.parts));
  assert.match(await said(), /polygons/);
  assert.ok((await saved("stl")).length > 84);

  // Solids that are made and dropped leave no memory behind.
  const grown = await inPage(async () => {
    const text = document.getElementById("library").textContent
      .replaceAll("<\\/script", "</script");
    const library = await import(URL.createObjectURL(
      new Blob([text], { type: "text/javascript" })));
    await library.init();
    const loop = (count) => {
      for (let k = 0; k < count; ++k) {
        library.scope(() => library.Solid.box([0, 0, 0], [1, 1, 1])
          .subtract(library.Solid.box([0, 0, 0], [0.5, 0.5, 1 + k % 2]))
          .mesh());
      }
    };
    loop(1000);
    const before = library.memoryBytes();
    loop(10000);
    return library.memoryBytes() - before;
  });
  assert.equal(grown, 0);

  // A phone.
  await browser.send("Emulation.setDeviceMetricsOverride",
    { width: 390, height: 780, deviceScaleFactor: 2, mobile: true });
  await new Promise((done) => setTimeout(done, 300));
  await inPage(() => halfspacePage.render());
  const box = await inPage(() => {
    const b = document.getElementById("picture").getBoundingClientRect();
    return [b.width, b.height, document.documentElement.scrollWidth];
  });
  assert.ok(box[0] === 390 && box[1] > 200 && box[2] <= 390, box.join());
  const before = await inPage(() => halfspacePage.camera.azimuth);
  const touch = (type, x, y) => browser.send("Input.dispatchTouchEvent",
    { type, touchPoints: type === "touchEnd" ? [] : [{ x, y }] });
  await touch("touchStart", 150, 150);
  await touch("touchMove", 200, 160);
  await touch("touchEnd");
  await browser.until(`halfspacePage.camera.azimuth !== ${before}`, 10);
  await inPage(() => halfspacePage.render());
  await browser.screenshot("phone.png");
  assert.deepEqual(browser.problems, []);
  console.log("page: all as it should be");
} catch (error) {
  await browser.screenshot("failed.png").catch(() => {});
  throw error;
} finally {
  await browser.close();
}

/** Two surfaces of 30 x 30 squares that cross. */
function waves() {
  const n = 30;
  let text = "";
  for (const sign of [1, -1]) {
    for (let j = 0; j <= n; ++j) {
      for (let i = 0; i <= n; ++i) {
        const z = sign * Math.sin(i / 5) * Math.cos(j / 5) + sign * 0.1;
        text += `v ${i / 10} ${j / 10} ${z.toFixed(4)}\n`;
      }
    }
  }
  for (const first of [1, 1 + (n + 1) ** 2]) {
    for (let j = 0; j < n; ++j) {
      for (let i = 0; i < n; ++i) {
        const v = first + j * (n + 1) + i;
        const w = v + n + 1;
        text += `f ${v} ${v + 1} ${w + 1}\nf ${v} ${w + 1} ${w}\n`;
      }
    }
  }
  return text;
}
