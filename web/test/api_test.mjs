// The package in node: what it promises, and that the native program gives the
// same bytes.
//
//   node api_test.mjs PACKAGE_DIR NATIVE_PROGRAM WORK_DIR MODULE
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { heatedWave, pixelsOf } from "./png.mjs";

const [packageDir, program, work] = process.argv.slice(2).map(
  (p) => path.resolve(p));
const { Solid, Scene, HalfspaceError, init, scope, version, memoryBytes, reset } =
  await import(pathToFileURL(path.join(packageDir, "halfspace.js")));
fs.mkdirSync(work, { recursive: true });
process.argv[5] = path.resolve(process.argv[5]);
process.chdir(work);

const native = (...options) => execFileSync(program, options,
  { stdio: ["ignore", "pipe", "pipe"] });
const bytesOf = (name) => new Uint8Array(fs.readFileSync(name));
function same(actual, expected, what) {
  assert.ok(Buffer.compare(Buffer.from(actual), Buffer.from(expected)) === 0,
    `${what}: the bytes differ`);
}
function fails(code, work) {
  assert.throws(work, (error) => error instanceof HalfspaceError &&
    error.code === code && error.message.length > 0,
  `no HalfspaceError ${code}`);
}

let count = 0;
async function test(name, body) {
  try {
    await body();
  } catch (error) {
    console.error(`FAILED: ${name}`);
    throw error;
  }
  ++count;
}

await test("nothing works before init()", () => {
  fails("NOT_READY", () => Solid.sphere(1));
});
await Promise.all([init(), init()]);

const scripts = [
  "box(4, 3, 1) - translate(cylinder(1, 3, 48), 2, 1.5, -1)",
  "sphere(10, 40) & translate(sphere(10, 40), 3, 4, 5)",
  "box(1) | translate(box(1), 1, 0, 0) - translate(box(1, 0.5, 2), " +
    "0.5, 0.25, 0.25)",
  "rotate(box(4), 1, 2, 3, 30) ^ sphere(2.5, 24)",
  "box(1) & half(x < 0.3)",
];

await test("files are those of the program", () => {
  for (const script of scripts) {
    for (const format of ["stl", "obj"]) {
      native("csg", script, "-o", `native.${format}`, "--quiet");
      same(Solid.fromText(script).save(format), bytesOf(`native.${format}`),
        `${script} as ${format}`);
    }
  }
});

await test("operands that no grid holds are rounded as the program does", () => {
  // Decimals of 21 digits; of 4, far away; and doubles.
  const text = new TextDecoder().decode(
    Solid.box([0, 0, 0], [1, 1, 1]).save("obj"));
  const scaled = (f) => new TextEncoder().encode(text.replace(/^v .*$/gm,
    (line) => `v ${line.split(" ").slice(1).map(Number).map(f).join(" ")}`));
  const files = {
    fine: scaled((c) => c ? "1.23456789012345678901" : "-0.3"),
    far: scaled((c) => c ? "987654.3" : "0.1"),
  };
  for (const [name, bytes] of Object.entries(files))
    fs.writeFileSync(`${name}.obj`, bytes);
  fs.writeFileSync("third.ply", Solid.box([0, 0, 0], [1 / 3, 1e-9, 2 / 7])
    .save("ply"));
  files.third = bytesOf("third.ply");
  const read = (name, options = { mayRound: true, mergeCoplanar: false }) =>
    Solid.fromFile(files[name], name === "third" ? "ply" : "obj", options);
  for (const [a, b] of [["fine", "far"], ["far", "third"], ["third", "fine"]]) {
    native("csg", "A - B", `A=${a}.${a === "third" ? "ply" : "obj"}`,
      `B=${b}.${b === "third" ? "ply" : "obj"}`, "-o", "native.stl", "--quiet");
    const part = read(a).subtract(read(b));
    same(part.save("stl"), bytesOf("native.stl"), `${a} - ${b}`);
    assert.ok(part.rounding().moved > 0 && part.rounding().gridBits === 54);
  }
  fails("OUT_OF_RANGE", () => read("far", {}).add(read("third", {})).volume());
});

await test("measures are exact", () => {
  const corner = Solid.box([0, 0, 0], [1, 1, 1])
    .intersect(Solid.halfSpace([1, 2, 3], 1));
  const volume = corner.exactVolume();
  assert.equal(volume.numerator, 1n);
  assert.equal(volume.denominator, 36n);
  assert.equal(String(volume), "1/36");
  assert.equal(corner.volume(), 1 / 36);
  const box = Solid.box([0, 0, 0], [0.1, 0.2, 0.3]);
  assert.equal(String(box.exactVolume()), "0.006");
  assert.equal(String(box.exactArea()), "0.22");
  assert.equal(box.exactVolume().denominator, 500n);
  assert.equal(corner.exactArea(), null);
  assert.deepEqual(box.bounds(), { low: [0, 0, 0], high: [0.1, 0.2, 0.3] });
  assert.deepEqual(box.centroid(), [0.05, 0.1, 0.15]);
  assert.equal(Solid.torus(3, 1).genus(), 1);
  assert.equal(box.add(box.translate([1, 0, 0])).shellCount(), 2);
  assert.ok(Solid.empty().isEmpty() && box.subtract(box).isEmpty());
  assert.equal(box.rounding().moved, 0);
  assert.equal(box.locate([0.05, 0.1, 0.1]), "inside");
  assert.equal(box.locate([0.1, 0.1, 0.1]), "on");
  assert.equal(box.locate([1, 1, 1]), "outside");
  const next = box.translate([0.1, 0, 0]);
  assert.ok(box.touches(next) && !box.overlaps(next));
  assert.ok(box.contains(box.scale(0.5)));
});

await test("operations and maps", () => {
  const a = Solid.box([0, 0, 0], [2, 2, 2]);
  const b = Solid.box([1, 1, 1], [3, 3, 3]);
  assert.equal(a.add(b).volume(), 15);
  assert.equal(a.subtract(b).volume(), 7);
  assert.equal(a.intersect(b).volume(), 1);
  assert.equal(a.xor(b).volume(), 14);
  assert.equal(Solid.union([a, b, b.translate([5, 0, 0])]).volume(), 23);
  assert.equal(Solid.intersection([a, b]).volume(), 1);
  assert.equal(a.intersect(b.complement()).volume(), 7);
  assert.equal(a.scale([1, 2, 0.5]).volume(), 8);
  assert.equal(a.rotate([0, 0, 1], 90).bounds().low[0], -2);
  assert.equal(a.mirror([1, 0, 0], 0).bounds().low[0], -2);
  assert.equal(a.transform([[2, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0]]).volume(),
    16);
  const { negative, positive } = a.split([0, 0, 1], 0.5);
  assert.equal(negative.volume(), 2);
  assert.equal(positive.volume(), 6);
  assert.equal(Solid.prism([[0, 0], [3, 0], [3, 3], [0, 3]], 2,
    [[[1, 1], [2, 1], [2, 2], [1, 2]]]).volume(), 16);
  assert.equal(Solid.hull([0, 0, 0, 6, 0, 0, 0, 1, 0, 0, 0, 1]).volume(), 1);
  assert.equal(Solid.revolution([[0, 0], [1, 0], [1, 1], [0, 1]], 4).volume(),
    2);
  const parts = a.add(b.translate([9, 9, 9])).decompose();
  assert.deepEqual(parts.map((p) => p.volume()), [8, 8]);
  const [region] = a.subtract(Solid.box([0.5, 0.5, -1], [1, 1, 3]))
    .section([0, 0, 1], 1);
  assert.equal(region.boundary.length, 12);
  assert.equal(region.holes.length, 1);
});

await test("meshes in and out, with their origins", () => {
  const a = Solid.box([0, 0, 0], [2, 2, 2]).named("a");
  const part = a.subtract(Solid.box([1, 1, 1], [3, 3, 3]).named("b"));
  const mesh = part.mesh({ triangles: false });
  const names = part.operands().map((o) => o.name);
  assert.deepEqual(names, ["a", "b"]);
  assert.equal(mesh.origins.length, 2 * mesh.polygonCount);
  const triangles = part.mesh();
  assert.equal(triangles.corners.length, 3 * triangles.polygonCount);
  const back = Solid.fromMesh(
    { vertices: triangles.vertices, triangles: triangles.corners });
  assert.equal(back.volume(), 7);
  const polygons = Solid.fromMesh({ vertices: mesh.vertices,
    corners: mesh.corners, firstCorner: mesh.firstCorner });
  assert.ok(polygons.xor(part).isEmpty());
  for (const format of ["stl", "obj", "ply", "off", "hsolid"]) {
    const read = Solid.fromFile(part.save(format), format);
    assert.ok(read.xor(part).isEmpty(), format);
  }
});

await test("pictures and figures are those of the program", () => {
  const script = scripts[0];
  native("csg", script, "-o", "part.obj", "--quiet");
  const scene = Scene.of(Solid.fromText(script));
  const from = [9, -7, 5];
  const target = [2, 1.5, 0.5];
  const view = { eye: from, target, up: [0, 0, 1], fov: 30,
    width: 320, height: 240 };
  const camera = ["--eye", from.join(), "--target", target.join(), "--fov",
    "30", "--size", "320x240", "--quiet"];
  native("render", "part.obj", "--ids", "part.npy", ...camera);
  const { ids, rgba } = scene.render(view);
  const npy = bytesOf("part.npy");
  same(new Uint8Array(ids.buffer), npy.subarray(npy.length - ids.byteLength),
    "ids");
  assert.equal(rgba.length, 4 * 320 * 240);
  assert.ok(new Set(ids).size > 3);
  for (const [fill, lines] of [["colour", "none"], ["part", "edges"],
    ["none", "hidden-dashed"]]) {
    native("draw", "part.obj", "-o", "part.svg", ...camera, "--fill", fill,
      ...(lines === "hidden-dashed"
        ? ["--lines", "edges", "--hidden", "dashed"] : ["--lines", lines]));
    same(scene.draw(view, { fill, lines }), bytesOf("part.svg"),
      `SVG with ${fill} and ${lines}`);
  }
  native("draw", "part.obj", "-o", "cut.svg", ...camera, "--fill", "colour",
    "--lines", "edges", "--clip", "-1,0,0,2.5", "--cap", "hatch");
  const half = { ...view, clips: [[-1, 0, 0, 2.5]], caps: "hatch" };
  same(scene.draw(half, { lines: "edges" }), bytesOf("cut.svg"),
    "SVG of a section");
  fails("OUT_OF_RANGE", () => scene.draw({ ...view, backColor: [1, 2, 3] }));
  fails("OUT_OF_RANGE", () => scene.draw(
    { ...half, clips: [[-1, 0, 0, 2.5], [0, -1, 0, 2]] }, { lines: "edges" }));
  native("render", "part.obj", "--ids", "clip.npy", ...camera, "--clip",
    "-1,0,0,2.5", "--cap", "200,80,40");
  const cut = scene.render({ ...view, clips: [[-1, 0, 0, 2.5]],
    caps: [200, 80, 40] });
  const clip = bytesOf("clip.npy");
  same(new Uint8Array(cut.ids.buffer),
    clip.subarray(clip.length - cut.ids.byteLength), "ids of a section");
  native("render", "part.obj", "-o", "clip.png", ...camera, "--clip",
    "-1,0,0,2.5", "--cap", "200,80,40", "--aa", "2");
  same(scene.render({ ...view, clips: [[-1, 0, 0, 2.5]], caps: [200, 80, 40],
    samples: 2 }).rgba.filter((_, k) => k % 4 !== 3),
  pixelsOf(fs.readFileSync("clip.png")).rgb, "a section in samples");
  native("render", "part.obj", "-o", "back.png", ...camera, "--clip",
    "-1,0,0,2.5", "--back-color", "250,30,90");
  same(scene.render({ ...view, clips: [[-1, 0, 0, 2.5]],
    backColor: [250, 30, 90] }).rgba.filter((_, k) => k % 4 !== 3),
  pixelsOf(fs.readFileSync("back.png")).rgb, "marked back faces");
  assert.throws(() => scene.render({ ...view, backColor: [1, 2, 3],
    samples: 2 }));
  native("render", "part.obj", "-o", "glass.png", ...camera, "--alpha", "90",
    "--clip", "-1,0,0,2.5");
  const glass = scene.render({ ...view, alpha: 90, clips: half.clips });
  same(glass.rgba.filter((_, k) => k % 4 !== 3),
    pixelsOf(fs.readFileSync("glass.png")).rgb, "a transparent picture");
  native("draw", "part.obj", "-o", "glass.svg", ...camera, "--alpha", "90");
  same(scene.draw({ ...view, alpha: 90 }), bytesOf("glass.svg"),
    "SVG of what is transparent");
  native("draw", "part.obj", "-o", "glass.svg", ...camera, "--alpha", "90",
    "--clip", "-1,0,0,2.5", "--cap", "hatch");
  same(scene.draw({ ...view, alpha: 90, clips: half.clips, caps: "hatch" }),
    bytesOf("glass.svg"), "SVG of a transparent section");
  for (const other of [{ samples: 2 }, { backColor: [1, 2, 3] }])
    fails("OUT_OF_RANGE", () =>
      scene.render({ ...view, alpha: 90, ...other }));
  for (const alpha of [-1, 256, 0.5, "x"])
    assert.throws(() => scene.render({ ...view, alpha }), TypeError);
  const all = scene.view({ azimuth: 30, elevation: 25, width: 100,
    height: 100 });
  assert.ok(all.eye && all.target);
  const seen = scene.pick(view, 160, 120);
  assert.equal(seen.polygon, ids[120 * 320 + 160]);
  assert.equal(scene.render({ ...view, samples: 2 }).rgba.length,
    4 * 320 * 240);
});

await test("caps are told apart by solids as the program's by files", () => {
  const camera = ["--eye", "6,-9,7", "--target", "0,0,0", "--up", "0,0,1",
    "--fov", "40", "--size", "160x120"];
  const view = { eye: [6, -9, 7], target: [0, 0, 0], up: [0, 0, 1], fov: 40,
    width: 160, height: 120, clips: [[0, 1, 0, -0.5]] };
  const boxes = [[-2, 0, 0], [0.5, 0, 0.25], [3, 0, 0]].map((at) =>
    Solid.box([0, 0, 0], [1, 2, 1.5]).translate(at));
  boxes.forEach((box, k) =>
    fs.writeFileSync(`box-${k}.obj`, box.save("obj")));
  const files = boxes.map((_, k) => `box-${k}.obj`);
  native("draw", ...files, "-o", "caps.svg", ...camera, "--clip", "0,1,0,-0.5",
    "--cap", "file");
  const scene = Scene.of(boxes);
  const apart = { ...view, caps: "hatch", capsBySolid: true };
  same(scene.draw(apart), bytesOf("caps.svg"), "SVG of caps by solid");
  const colorsOf = (asked) => {
    const words = new Uint32Array(scene.render(asked).rgba.buffer);
    return new Set(words).size;
  };
  // A cap's colour for each of three boxes in place of one.
  assert.equal(colorsOf(apart), colorsOf({ ...apart, capsBySolid: false }) + 2);
});

await test("colours by numbers are the program's", () => {
  fs.writeFileSync("wave.ply", heatedWave());
  const numbers = Array.from({ length: 2 * 24 * 24 }, (_, k) => 1 + k % 50);
  fs.writeFileSync("faces.csv", numbers.join("\n") + "\n");
  const view = { eye: [14, -9, 12], target: [3, 3, 0], up: [0, 0, 1], fov: 30,
    width: 160, height: 120 };
  const words = ["--size", "160x120", "--eye", "14,-9,12", "--target", "3,3,0",
    "--up", "0,0,1", "--fov", "30"];
  assert.deepEqual(Scene.scalarNames(bytesOf("wave.ply")),
    ["x", "y", "z", "heat"]);
  for (const [source, style, options] of [
    ["heat", { map: "turbo" }, ["--map", "turbo"]],
    ["heat", { map: "coolwarm_r", low: 20, high: 300, steps: 7, clamp: false },
      ["--map", "coolwarm_r", "--range", "20,300", "--steps", "7",
        "--no-clamp"]],
    ["faces.csv", { logarithmic: true }, ["--log"]],
  ]) {
    const scene = Scene.byScalars(
      { bytes: bytesOf("wave.ply"), format: "ply", name: "wave" },
      source === "heat" ? source
        : { bytes: bytesOf(source), format: "csv", name: "faces" }, style);
    const scale = scene.colorBy(style);
    assert.ok(scale.low < scale.high && scale.colors.length > 6);
    for (const samples of [1, 2]) {
      native("render", "wave.ply", "-o", "scalars.png", ...words, "--scalar",
        source, ...options, ...(samples > 1 ? ["--aa", "2"] : []));
      const picture = scene.render({ ...view, samples });
      const expected = pixelsOf(fs.readFileSync("scalars.png"));
      same(picture.rgba.filter((_, k) => k % 4 !== 3), expected.rgb,
        `colours by ${source}, ${samples} samples`);
    }
    scene.dispose();
  }
  fails("BAD_INDEX", () => Scene.byScalars(
    { bytes: bytesOf("wave.ply"), format: "ply" }, "cold"));
  const plain = Scene.of(Solid.sphere(1, 8));
  fails("EMPTY", () => plain.colorBy());
});

await test("an order feed is a permutation of what is seen", () => {
  const scene = Scene.of([Solid.sphere(1, 12),
    Solid.sphere(1, 12).translate([0.5, 0, 0])]);
  const { positions, polygons } = scene.fragments();
  assert.equal(positions.length, 3 * polygons.length);
  const view = { eye: [5, 3, 2], target: [0, 0, 0] };
  const back = scene.order(view);
  const front = scene.order(view, true);
  assert.equal(back.length % 3, 0);
  assert.equal(back.length, front.length);
  assert.ok(back.length > 0 && back.every((v) => v < polygons.length));
  const keys = (list) => {
    const found = [];
    for (let k = 0; k < list.length; k += 3)
      found.push(list.slice(k, k + 3).join());
    return found.sort().join(" ");
  };
  assert.equal(keys(back), keys(front));
});

await test("what is wrong is said", () => {
  const bytes = (text) => new TextEncoder().encode(text);
  fails("SYNTAX", () => Solid.fromFile(bytes("v 1 2 x\n"), "obj"));
  fails("TRUNCATED", () => Solid.fromFile(
    Solid.sphere(1).save("stl").subarray(0, 500), "stl"));
  fails("EMPTY", () => Solid.fromFile(new Uint8Array(), "obj"));
  fails("UNKNOWN_FORMAT", () => Solid.fromFile(bytes("x"), "xyz"));
  fails("OPEN", () => Solid.fromFile(
    bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "obj").volume());
  fails("BAD_INDEX", () => Scene.ofFiles(
    [{ bytes: bytes("v 0 0 0\nf 1 2 3\n"), format: "obj" }]));
  fails("SYNTAX", () => Solid.fromText("box(").volume());
  fails("UNBOUNDED", () => Solid.halfSpace([0, 0, 1], 0).volume());
  try {
    Solid.fromFile(bytes("v 0 0 0\nv 1 2 x\n"), "obj", { name: "broken" });
  } catch (error) {
    assert.match(error.message, /^broken\.obj.*line 2/);
  }
  const gone = Solid.sphere(1);
  gone.dispose();
  fails("DISPOSED", () => gone.volume());
  assert.throws(() => Solid.box([0, 0], [1, 1, 1]), TypeError);
});

await test("progress is heard, and stops the work", () => {
  const many = (n) => Solid.union(Array.from({ length: n }, (_, k) =>
    Solid.box([0, 0, 0], [1, 1, 1]).translate([k, 0, 0])));
  const shares = [];
  many(40).evaluate({ progress: (share) => { shares.push(share); } });
  assert.ok(shares.length > 1 && shares.every((s) => s >= 0 && s <= 1));
  fails("STOPPED", () => many(41).evaluate({ progress: () => false }));
  assert.throws(() => many(42).evaluate(
    { progress: () => { throw new RangeError("mine"); } }), RangeError);
});

await test("memory is flat over 10,000 solids that are dropped", async () => {
  const turn = () => new Promise((done) => setImmediate(done));
  const make = () => Solid.box([0, 0, 0], [1, 1, 1])
    .subtract(Solid.box([0.5, 0.5, 0.5], [2, 2, 2])).volume();
  const run = async (n) => {
    for (let k = 0; k < n; ++k) {
      make();
      if (k % 50 === 0) await turn();
    }
  };
  await run(2000);
  const before = memoryBytes();
  await run(10000);
  const grown = memoryBytes() - before;
  assert.ok(grown <= 1.0 * before, `grew by ${grown} from ${before} bytes`);
  const start = memoryBytes();
  for (let k = 0; k < 10000; ++k) scope(make);
  assert.ok(memoryBytes() === start, "scope() does not give back");
});

/** The module with room for that many pages of 64 KiB. */
function withPages(module, pages) {
  const bytes = new Uint8Array(module);
  let at = 8;
  const number = () => {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = bytes[at++];
      value |= (byte & 127) << shift;
      if (byte < 128) return value;
    }
  };
  while (at < bytes.length) {
    const section = bytes[at++];
    const end = number() + at;
    if (section === 5) {
      assert.equal(number(), 1);
      assert.equal(number(), 1);  // it has a limit
      number();
      assert.deepEqual([...bytes.subarray(at, at + 3)], [0x80, 0x80, 4]);
      bytes.set([0x80 | (pages & 127), 0x80 | (pages >> 7), 0], at);
      return bytes;
    }
    at = end;
  }
  throw new Error("no memory section");
}

await test("a module that ran out of memory is begun again", async () => {
  const other = await import(
    pathToFileURL(path.join(packageDir, "halfspace.js")) + "?small");
  await other.init({ wasm: withPages(fs.readFileSync(process.argv[5]), 1200) });
  // The first of its kind, and so where the next module has its first.
  const solid = other.Solid.box([0, 0, 0], [1, 1, 1]);
  const broken = (work) => assert.throws(work, (e) => e.code === "BROKEN" &&
    /memory|reset/.test(e.message));
  const { error } = console;
  console.error = () => {};
  broken(() => other.Solid.sphere(1, 4000).volume());
  broken(() => solid.volume());
  await other.reset();
  broken(() => solid.volume());
  const box = other.Solid.box([0, 0, 0], [1, 1, 1]);
  assert.equal(box.volume(), 1);
  // What was made before names nothing there, and gives nothing back.
  solid.dispose();
  const more = Array.from({ length: 8 }, (_, k) => box.scale(k + 1));
  assert.equal(box.add(box.translate([1, 0, 0])).volume(), 2);
  assert.deepEqual(more.map((m) => m.volume()),
    more.map((_, k) => (k + 1) ** 3));
  console.error = error;
});

assert.match(version(), /^\d+\.\d+\.\d+$/);
console.log(`${count} tests passed`);
