// What goes through the binding arrives where it belongs: signs, the order of
// arguments, and copies that stay when the module works on.
//
//   node binding_test.mjs PACKAGE_DIR
import assert from "node:assert/strict";
import path from "node:path";
import { pathToFileURL } from "node:url";

const load = (name) => import(
  pathToFileURL(path.join(path.resolve(process.argv[2]), name)));
const { Solid, Scene } = await load("halfspace.js");
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
const count = (v) => scene.render(v).ids.filter((id) => id !== -1).length;
assert.equal(count(view), 200);
assert.equal(count({ ...view, orthoHeight: 8 }), 50);
// In front of the near plane nothing is seen: not the top, but what is below.
assert.ok(scene.pick({ ...view, near: 18 }, 22, 17)?.point[2] !== 3);
const below = { ...view, eye: [0.5, 1, 1], orthographic: false, fov: 40 };
assert.ok(count(below) > 0);
assert.equal(count({ ...below, cull: true }), 0);

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
