// How long booleans and pictures take in WebAssembly: processor time of this
// process, the least of some runs. Beside manifold-3d, where a path is given.
//
//   node measure.mjs PACKAGE_DIR [MANIFOLD_3D_MODULE]
//
// measure.cpp does the same natively.
import path from "node:path";
import { pathToFileURL } from "node:url";

const load = (p) => import(pathToFileURL(path.resolve(p)));
const { Solid, Scene, init, scope } =
  await load(path.join(process.argv[2], "halfspace.js"));
await init();

function least(work, runs = 7) {
  let best = Infinity;
  for (let k = 0; k < runs; ++k) {
    const begin = process.cpuUsage();
    work();
    const { user, system } = process.cpuUsage(begin);
    best = Math.min(best, (user + system) / 1000);
  }
  return best;
}
const print = (name, ms) => console.log(`${name}\t${ms.toFixed(1)} ms`);

// The same triangles for all: spheres of 10,000 of them.
const sphere = scope(() => Solid.sphere(1, 100).mesh());
const vertices = sphere.vertices;
const triangles = sphere.corners;
const moved = vertices.map((c, k) => k % 3 === 0 ? c + 0.5 : c);
console.log(`spheres of ${triangles.length / 3} triangles`);

print("difference", least(() => scope(() => {
  const a = Solid.fromMesh({ vertices, triangles });
  const b = Solid.fromMesh({ vertices: moved, triangles });
  a.subtract(b).mesh();
})));
{
  const a = Solid.fromMesh({ vertices, triangles });
  const b = Solid.fromMesh({ vertices: moved, triangles });
  a.evaluate();
  b.evaluate();
  print("difference, operands checked", least(() => scope(() => {
    a.subtract(b).evaluate();
  })));
}
/** Menger's sponge: a cube without its holes along three axes. */
function menger(box, depth) {
  const holes = [];
  for (let d = 1, n = 1; d <= depth; ++d, n *= 3) {
    for (let i = 0; i < n; ++i)
      for (let j = 0; j < n; ++j) {
        const at = [(3 * i + 1) / (3 * n), (3 * j + 1) / (3 * n)];
        holes.push([at, 1 / (3 * n)]);
      }
  }
  return box(holes);
}
const side = 27;
print("menger 3", least(() => scope(() => menger((holes) => {
  const bars = holes.flatMap(([[u, v], w]) => {
    const [a, b, c] = [u * side, v * side, w * side].map(Math.round);
    return [Solid.box([-1, a, b], [side + 1, a + c, b + c]),
      Solid.box([a, -1, b], [a + c, side + 1, b + c]),
      Solid.box([a, b, -1], [a + c, b + c, side + 1])];
  });
  return Solid.box([0, 0, 0], [side, side, side])
    .subtract(Solid.union(bars)).evaluate();
}, 3)), 3));
print("plate with 100 holes", least(() => scope(() => {
  const drill = Solid.cylinder(1, 9, 48);
  let part = Solid.box([0, 0, 0], [31, 31, 5]);
  for (let k = 0; k < 100; ++k)
    part = part.subtract(drill.translate([2 + 3 * (k % 10),
      2 + 3 * Math.floor(k / 10), -2]));
  part.evaluate();
}), 3));
{
  const scene = Scene.of(Solid.sphere(10, 300));
  const view = scene.view({ width: 1000, height: 1000 });
  scene.render(view);
  print("picture, 1000 x 1000, 89,400 polygons",
    least(() => scene.render(view)));
}

if (process.argv[3]) {
  const wasm = await (await load(process.argv[3])).default();
  wasm.setup();
  const { Manifold, Mesh } = wasm;
  const mesh = (points) => new Mesh({ numProp: 3,
    vertProperties: Float32Array.from(points),
    triVerts: Uint32Array.from(triangles) });
  const [one, two] = [mesh(vertices), mesh(moved)];
  print("manifold-3d: difference", least(() => {
    const a = Manifold.ofMesh(one);
    const b = Manifold.ofMesh(two);
    const c = a.subtract(b);
    c.getMesh();
    for (const m of [a, b, c]) m.delete();
  }));
  const a = Manifold.ofMesh(one);
  const b = Manifold.ofMesh(two);
  print("manifold-3d: difference, operands made", least(() => {
    const c = a.subtract(b);
    c.numTri();
    c.delete();
  }));
  print("manifold-3d: menger 3", least(() => menger((holes) => {
    const bars = holes.flatMap(([[u, v], w]) => {
      const [p, q, c] = [u * side, v * side, w * side].map(Math.round);
      const box = (size, at) => Manifold.cube(size).translate(at);
      return [box([side + 2, c, c], [-1, p, q]),
        box([c, side + 2, c], [p, -1, q]), box([c, c, side + 2], [p, q, -1])];
    });
    return Manifold.cube(side).subtract(Manifold.union(bars)).numTri();
  }, 3), 3));
  print("manifold-3d: plate with 100 holes", least(() => {
    const drill = Manifold.cylinder(9, 1, 1, 48);
    let part = Manifold.cube([31, 31, 5]);
    for (let k = 0; k < 100; ++k)
      part = part.subtract(drill.translate([2 + 3 * (k % 10),
        2 + 3 * Math.floor(k / 10), -2]));
    part.numTri();
  }, 3));
}
