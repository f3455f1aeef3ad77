// The names of manifold-3d over exact solids.
//
//   node manifold_test.mjs PACKAGE_DIR
import assert from "node:assert/strict";
import path from "node:path";
import { pathToFileURL } from "node:url";

const { default: Module } = await import(pathToFileURL(
  path.join(path.resolve(process.argv[2]), "manifold.js")));
const wasm = await Module();
wasm.setup();
const { Manifold, CrossSection, Mesh } = wasm;

const cube = Manifold.cube([2, 2, 2], true);
assert.equal(cube.volume(), 8);
assert.equal(cube.surfaceArea(), 24);
assert.deepEqual(cube.boundingBox(), { min: [-1, -1, -1], max: [1, 1, 1] });
assert.equal(cube.numTri(), 12);
assert.equal(cube.numVert(), 8);
assert.equal(cube.numEdge(), 18);
assert.equal(cube.status(), "NoError");
assert.equal(cube.genus(), 0);
assert.ok(!cube.isEmpty() && new Manifold().isEmpty());
assert.equal(Manifold.cube(3).volume(), 27);

// Coplanar faces and shared edges need no overshoot.
const half = Manifold.cube([1, 2, 2]).translate(0, -1, -1);
assert.equal(cube.subtract(half).volume(), 4);
assert.equal(cube.add(half.translate([1, 0, 0])).volume(), 12);
assert.equal(cube.intersect(half).volume(), 4);
assert.equal(Manifold.union([cube, half, half]).volume(), 8);
assert.equal(Manifold.difference(cube, half).volume(), 4);
assert.equal(Manifold.intersection([cube, half]).volume(), 4);
assert.deepEqual(cube.split(half).map((m) => m.volume()), [4, 4]);
assert.deepEqual(cube.splitByPlane([0, 0, 2], 0.5).map((m) => m.volume()),
  [2, 6]);
assert.equal(cube.trimByPlane([0, 0, 1], 0.5).volume(), 2);

assert.equal(Manifold.cylinder(2, 1, 1, 4).volume(), 4);
assert.equal(Manifold.cylinder(2, 1, -1, 4, true).boundingBox().min[2], -1);
assert.ok(Math.abs(Manifold.cylinder(3, 1, 0.5, 4).volume() - 3.5) < 1e-12);
assert.ok(Manifold.sphere(1, 32).volume() > 4);
assert.ok(Math.abs(Manifold.tetrahedron().volume() - 8 / 3) < 1e-15);
assert.equal(Manifold.hull([[0, 0, 0], [6, 0, 0], [0, 1, 0], [0, 0, 1]])
  .volume(), 1);
assert.equal(Manifold.hull([cube, cube.translate([2, 0, 0])]).volume(), 16);

const square = [[0, 0], [2, 0], [2, 2], [0, 2]];
const hole = [[0.5, 0.5], [0.5, 1.5], [1.5, 1.5], [1.5, 0.5]];
assert.equal(Manifold.extrude([square, hole], 2).volume(), 6);
assert.equal(Manifold.extrude(square, 1, 0, 0, [1, 1], true)
  .boundingBox().min[2], -0.5);
const frustum = Manifold.extrude(square, 3, 0, 0, [0.5, 0.5]);
assert.equal(frustum.volume(), 7);
assert.equal(frustum.status(), "NoError");
assert.equal(Manifold.revolve([[1, 0], [2, 0], [2, 1], [1, 1]], 4).volume(), 6);
assert.equal(Manifold.revolve([[1, 0], [2, 0], [2, 1], [1, 1]], 4).genus(), 1);

assert.equal(cube.scale(2).volume(), 64);
assert.equal(cube.scale([1, 2, 3]).volume(), 48);
assert.equal(cube.translate(1, 2, 3).boundingBox().min[2], 2);
assert.equal(half.rotate([0, 0, 90]).boundingBox().min[0], -1);
assert.equal(half.rotate(0, 0, 90).boundingBox().max[1], 1);
assert.equal(half.mirror([1, 0, 0]).boundingBox().min[0], -1);
assert.equal(cube.transform([2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1])
  .boundingBox().max[0], 7);
assert.equal(cube.warp((p) => { p[2] *= 3; }).volume(), 24);
const two = Manifold.compose([cube, cube.translate(5, 0, 0)]);
assert.deepEqual(two.decompose().map((m) => m.volume()), [8, 8]);

// 2D.
assert.equal(cube.slice(0).area(), 4);
assert.equal(two.project().area(), 8);
assert.equal(CrossSection.square([2, 3]).area(), 6);
assert.equal(CrossSection.square(2, true).subtract(CrossSection.square(1))
  .area(), 3);
assert.equal(CrossSection.square(2).extrude(2).volume(), 8);
assert.equal(new CrossSection([square, hole]).numContour(), 2);
assert.ok(CrossSection.circle(1, 64).area() > 3.1);

// Meshes: which triangle is of which original.
const a = Manifold.cube(2);
const drill = Manifold.cube(2);
const b = drill.translate([1, 1, 1]);
const mesh = a.subtract(b).getMesh();
assert.equal(mesh.numProp, 3);
assert.equal(mesh.runIndex.at(-1), mesh.triVerts.length);
assert.deepEqual([...mesh.runOriginalID], [a.originalID(), drill.originalID()]);
assert.equal(mesh.runIndex.length, mesh.numRun + 1);
assert.equal(mesh.faceID.length, mesh.numTri);
assert.equal(mesh.position(0).length, 3);
assert.equal(mesh.verts(0).length, 3);
const back = Manifold.ofMesh(mesh);
assert.equal(back.volume(), 7);
// Runs and face numbers of an input come out again.
const again = back.subtract(Manifold.cube(0.5)).getMesh();
const ids = new Set(again.runOriginalID);
assert.ok(ids.has(a.originalID()) && ids.has(drill.originalID()));
assert.equal(new Manifold(new Mesh({ numProp: 3,
  vertProperties: mesh.vertProperties, triVerts: mesh.triVerts })).volume(), 7);
assert.equal(cube.asOriginal().volume(), 8);
assert.ok(Manifold.reserveIDs(5) < Manifold.reserveIDs(1));

// What is wrong, and what is not there.
const open = new Mesh({ numProp: 3,
  vertProperties: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0),
  triVerts: Uint32Array.of(0, 1, 2) });
assert.equal(Manifold.ofMesh(open).status(), "NotManifold");
for (const name of ["levelSet", "smooth"]) {
  assert.throws(() => Manifold[name], new RegExp(`Manifold.${name} is not`));
}
for (const name of ["refine", "setProperties", "calculateNormals", "minGap",
  "simplify", "smoothOut", "rayCast"]) {
  assert.throws(() => cube[name](1), new RegExp(`${name} is not in`));
}
assert.throws(() => CrossSection.square(1).offset(1), /offset/);
assert.throws(() => Manifold.extrude(square, 1, 4, 90), /twist/);
cube.delete();
assert.throws(() => cube.volume(), /disposed/);
console.log("manifold: all as it should be");
