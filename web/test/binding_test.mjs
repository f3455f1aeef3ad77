// What goes through the binding arrives where it belongs: signs, the order of
// arguments, and copies that stay when the module works on.
//
//   node binding_test.mjs PACKAGE_DIR
import assert from "node:assert/strict";
import path from "node:path";
import { pathToFileURL } from "node:url";

const load = (name) => import(
  pathToFileURL(path.join(path.resolve(process.argv[2]), name)));
const { Solid, Scene, memoryBytes, scope } = await load("halfspace.js");
const { default: Module } = await load("manifold.js");
const wasm = await Module();
wasm.setup();
const { Manifold } = wasm;

const near = (a, b) => assert.ok(
  [a].flat(2).every((v, k) => Math.abs(v - [b].flat(2)[k]) < 1e-9),
  `${JSON.stringify(a)} is not ${JSON.stringify(b)}`);
const brick = Solid.box([0, 0, 0], [1, 2, 3]);

// Signs, and the order of arguments.
near(brick.mirror([1, 0, 0], 2).bounds().low, [3, 0, 0]);
near(brick.rotate([1, 0, 0], 90).bounds().low, [0, -3, 0]);
near(brick.rotate([0, 1, 0], 90).bounds().low, [0, 0, -1]);
const cone = Solid.cone(3, 0, 4, 16);
assert.equal(cone.locate([2, 0, 0.5]), "inside");
assert.equal(cone.locate([2, 0, 3.5]), "outside");
const ring = Solid.torus(4, 1, 8, 4);
const { vertices: round } = ring.mesh();
assert.equal(round.filter((c, k) => k % 3 === 2 && c === 0).length, 16);
const inertia = brick.inertia();
assert.ok(inertia[0][0] > inertia[1][1] && inertia[1][1] > inertia[2][2]);

// A binding's copies do not change with the next question, nor where memory
// of the module grows.
const section = brick.section([0, 0, 1], 1)[0].boundary;
const kept = [...section];
brick.translate([5, 5, 5]).bounds();
Solid.sphere(1, 300).volume();
assert.deepEqual([...section], kept);

// Parts of arrays are taken, and their copies given back.
const corners = Float64Array.of(9, 9, 9, 0, 0, 0, 6, 0, 0, 0, 1, 0, 0, 0, 1);
assert.equal(Solid.hull(corners.subarray(3)).volume(), 1);
const many = new Float64Array(3 * 20000);
for (let k = 0; k < 2; ++k) scope(() => { Solid.hull(many); });
const before = memoryBytes();
for (let k = 0; k < 100; ++k) scope(() => { Solid.hull(many); });
assert.equal(memoryBytes(), before);

// What scopes return stays, until the scope around them ends.
const [one, other] = scope(() => [brick.scale(2), brick.scale(3)]);
assert.equal(one.volume() + other.volume(), 6 * 35);
assert.equal(scope(() => brick.scale(4)).volume(), 6 * 64);
let inner = null;
scope(() => { inner = scope(() => brick.scale(5)); });
assert.throws(() => inner.volume(), (e) => e.code === "DISPOSED");

// Errors have their index and their words.
const wrong = { vertices: [0, 0, 0, 1, 0, 0, 0, 1, 0], triangles: [0, 1, 7] };
assert.throws(() => Solid.fromMesh(wrong).volume(), (e) =>
  e.code === "BAD_INDEX" && e.index === 2 && e.words !== "");
assert.throws(() => Solid.fromMesh({ ...wrong, triangles: [0, 1, 2] }).volume(),
  (e) => e.code === "OPEN" && /open/.test(e.words));

// Work within a report of other work leaves that its reports.
const row = (n) => Solid.union(Array.from({ length: n }, (_, k) =>
  brick.translate([2 * k, 0, 0])));
let reports = 0;
row(40).evaluate({ progress: () => {
  if (++reports === 1) row(7).evaluate({ progress: () => true });
} });
assert.ok(reports > 1);

// Materials and colours of polygons are in their own arrays.
const mesh = brick.mesh();
const marked = Solid.fromMesh({ vertices: mesh.vertices,
  triangles: mesh.corners,
  materials: Int32Array.from({ length: 12 }, (_, k) => k + 1) })
  .mesh({ merge: "none" });
assert.deepEqual(new Set(marked.materials),
  new Set(Array.from({ length: 12 }, (_, k) => k + 1)));
assert.equal(marked.materials.length, marked.polygonCount);
assert.equal(marked.colors.length, 0);

// Views: where the eye is, and what it sees.
const scene = Scene.of(brick);
const offset = (options) => {
  const { eye, target } = scene.view(options);
  return eye.map((c, k) => c - target[k]);
};
const front = offset({ azimuth: 0, elevation: 0 });
assert.ok(front[1] < 0 && Math.abs(front[0]) < 1e-9 * -front[1]);
const right = offset({ azimuth: 90, elevation: 0 });
assert.ok(right[0] > 0 && Math.abs(right[1]) < 1e-9 * right[0]);
near(scene.view({ azimuth: 0, elevation: 90 }).up, [0, 1, 0]);
near(scene.view({ azimuth: 90, elevation: 90 }).up, [-1, 0, 0]);
const view = { eye: [0.5, 1, 20], target: [0.5, 1, 0], up: [0, 1, 0],
  width: 40, height: 40, orthographic: true, orthoHeight: 4 };
const seen = scene.pick(view, 22, 17);
near(seen.point[2], 3);
assert.ok(Math.abs(seen.point[0] - 0.75) < 0.06 &&
  Math.abs(seen.point[1] - 1.25) < 0.06, seen.point.join());
near(seen.distance, 17);
assert.deepEqual(scene.pick({ ...view, clips: [[0, 0, -1, 1]],
  caps: [1, 2, 3] }, 22, 17),
{ polygon: scene.polygonCount, source: -1, point: null, distance: null });
const count = (v) => scene.render(v).ids.filter((id) => id !== -1).length;
assert.equal(count(view), 200);
assert.equal(count({ ...view, orthoHeight: 8 }), 50);
// In front of the near plane nothing is seen: not the top, but what is below.
assert.ok(scene.pick({ ...view, near: 18 }, 22, 17)?.point[2] !== 3);
const below = { ...view, eye: [0.5, 1, 1], orthographic: false, fov: 40 };
assert.ok(count(below) > 0);
assert.equal(count({ ...below, cull: true }), 0);

const ground = scene.render({ ...view, background: [10, 20, 30] });
assert.deepEqual([...ground.rgba.subarray(0, 4)], [10, 20, 30, 255]);
assert.equal(ground.ids[0], -1);
// The brick is 3.2 high from there.
const flat = scene.view({ azimuth: 0, elevation: 0, orthographic: true });
assert.ok(flat.orthoHeight > 3 && flat.orthoHeight < 8);
assert.equal(flat.fov, scene.view({ azimuth: 0, elevation: 0 }).fov);

// Options of meshes and files.
const soup = (solids) => {
  const parts = solids.map((s) => s.mesh());
  const vertices = parts.flatMap((m) => [...m.vertices]);
  let at = 0;
  const triangles = parts.flatMap((m) => {
    const moved = [...m.corners].map((c) => c + at);
    at += m.vertexCount;
    return moved;
  });
  return { vertices, triangles };
};
const crossing = soup([Solid.box([0, 0, 0], [2, 2, 2]),
  Solid.box([1, 1, 1], [3, 3, 3])]);
assert.throws(() => Solid.fromMesh(crossing).volume(),
  (e) => e.code === "SELF_CROSSING");
assert.equal(Solid.fromMesh(crossing, { resolve: true }).volume(), 15);
const faces = (options) => Solid.fromMesh(soup([brick]), options)
  .mesh({ triangles: false }).polygonCount;
assert.equal(faces({ mergeCoplanar: false }), 12);
assert.equal(faces({}), 6);
const wide = brick.add(Solid.box([1, 0, 0], [2, 2, 3]));
const count4 = (text) => [...text.matchAll(/^f /gm)].length;
const saved = (options) =>
  count4(new TextDecoder().decode(wide.save("obj", options)));
assert.equal(saved({ merge: "plane" }), 6);
assert.equal(saved({ merge: "plane", triangles: true }), 12);
assert.equal(saved({}), 10);
assert.equal(wide.mesh({ merge: "plane" }).polygonCount, 12);
const obj = (text) => new TextEncoder().encode(text);
const sheet = obj("v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n");
const { solid: shell } = Solid.mended(sheet, "obj", { thicken: 0.5 });
assert.ok(Math.abs(shell.volume() - 4) < 0.01, shell.volume());
// A box, the top of which has corners of its own a little beside.
const box = new TextDecoder().decode(brick.save("obj", { merge: "plane" }));
const lines = box.split("\n").filter((l) => l.startsWith("v "));
const top = box.split("\n").filter((l) => l.startsWith("f "));
const apart = obj([...lines, ...lines.map((l) =>
  `v ${l.slice(2).split(" ").map((c, k) => Number(c) + (k === 0 ? 0.01 : 0))
    .join(" ")}`), ...top.slice(1), `f ${top[0].slice(2).split(" ")
  .map((c) => Number(c) + lines.length).join(" ")}`].join("\n") + "\n");
const welded = Solid.mended(apart, "obj", { weld: 0.02 });
assert.equal(welded.solid.shellCount(), 1);
assert.ok(welded.done.some((line) => /weld/.test(line)), welded.done.join());
assert.throws(() => Solid.mended(apart, "obj"), (e) => e.code === "OPEN");

// Figures: creases, widths, digits.
const drum = Scene.of(Solid.cylinder(1, 2, 8));
const figure = (options) => drum.svg({ ...drum.view({ azimuth: 10,
  elevation: 20 }), width: 200, height: 200 }, { fill: "none", ...options });
const edges = figure({ lines: "edges" });
assert.ok(figure({ lines: "edges", crease: 60 }).length < edges.length);
assert.match(figure({ lines: "edges", lineWidth: 7.5 }), /7\.5/);
assert.ok(!/7\.5"/.test(edges));
assert.match(edges, /\d\.\d{3}/);
assert.ok(!/\d\.\d{2}/.test(figure({ lines: "edges", decimals: 1 })));

// The order feed: what is behind comes first, or last.
const two = Scene.of([brick, brick.translate([0, 0, 5])]);
const { positions, polygons } = two.fragments();
assert.equal(positions.length, 3 * polygons.length);
for (let k = 0; k < positions.length; k += 3) {
  const [x, y, z] = positions.subarray(k, k + 3);
  assert.ok(x >= 0 && x <= 1 && y >= 0 && y <= 2 && z >= 0 && z <= 8);
}
const above = { eye: [0.5, 1, 40], target: [0.5, 1, 0], up: [0, 1, 0] };
/** The heights of the level triangles, in order. */
const levels = (frontToBack) => {
  const order = [...two.order(above, frontToBack)];
  const z = order.map((v) => positions[3 * v + 2]);
  return z.filter((c, k) => k % 3 === 0 && c === z[k + 1] && c === z[k + 2]);
};
const back = levels(false);
assert.ok(back.lastIndexOf(3) < back.indexOf(8) && back.includes(3));
const front8 = levels(true);
assert.ok(front8.lastIndexOf(8) < front8.indexOf(3) && front8.includes(8));

// manifold: rotations go about x, then y, then z.
near(Manifold.cube([1, 2, 3]).rotate(90, 0, 0).boundingBox().min, [0, -3, 0]);
near(Manifold.cube([1, 2, 3]).rotate(0, 90, 0).boundingBox().min, [0, 0, -1]);
near(Manifold.cube([1, 2, 3]).rotate(90, 90, 0).boundingBox().max, [2, 0, 0]);

// manifold: each run has the triangles of its original, and their faces.
const body = Manifold.cube(4);
const bit = Manifold.cube(2);
const drill = bit.translate(3, 3, 3);
const owner = (m, t) => {
  const [a, b, c] = [...m.verts(t)].map((v) => m.position(v));
  const cross = [0, 1, 2].map((k) => {
    const [i, j] = [(k + 1) % 3, (k + 2) % 3];
    return (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
  });
  const k = cross.findIndex((v) => v !== 0);
  return { axis: 2 * k + (cross[k] > 0 ? 1 : 0), at: a[k] };
};
const check = (m) => {
  for (let r = 0; r < m.numRun; ++r) {
    assert.ok(m.runIndex[r] < m.runIndex[r + 1]);
    for (let t = m.runIndex[r] / 3; t < m.runIndex[r + 1] / 3; ++t) {
      const of = owner(m, t).at === 3 ? bit : body;
      assert.equal(m.runOriginalID[r], of.originalID(), `triangle ${t}`);
    }
  }
  const planes = new Map();
  for (let r = 0; r < m.numRun; ++r)
    for (let t = m.runIndex[r] / 3; t < m.runIndex[r + 1] / 3; ++t) {
      const key = `${r} ${m.faceID[t]}`;
      const { axis, at } = owner(m, t);
      planes.set(key, planes.get(key) ?? `${axis} ${at}`);
      assert.equal(planes.get(key), `${axis} ${at}`, `face of ${t}`);
    }
};
const made = body.subtract(drill).getMesh();
assert.equal(made.numRun, 2);
check(made);
const again = Manifold.ofMesh(made)
  .subtract(Manifold.cube(1).translate(9, 9, 9)).getMesh();
assert.equal(again.numRun, 2);
check(again);
console.log("binding: all as it should be");
