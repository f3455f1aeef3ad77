// The core of manifold-3d's interface over exact solids, so that an editor can
// switch by one import. Names that are not here throw, and say what to do.
import { HalfspaceError, Solid, init, scope } from "./halfspace.js";

let nextId = 1;
let circularSegments = 0;
let minAngle = 10;
let minEdge = 1;

/** As manifold-3d: from the angle and the length of edges, a multiple of 4. */
function segmentsFor(radius, asked) {
  if (asked >= 3) return asked;
  if (circularSegments >= 3) return circularSegments;
  const byAngle = 360 / minAngle;
  const byEdge = 2 * Math.PI * radius / minEdge;
  const n = Math.min(byAngle, byEdge) + 3;
  return Math.max(Math.floor(n) - Math.floor(n) % 4, 4);
}

const vec3 = (x, y, z) =>
  Array.isArray(x) || ArrayBuffer.isView(x) ? [...x].map(Number)
    : [Number(x), Number(y ?? x), Number(z ?? y ?? x)];
const vec2 = (x, y) => Array.isArray(x) || ArrayBuffer.isView(x)
  ? [...x].map(Number) : [Number(x), Number(y ?? x)];
const shift3 = (x, y, z) => Array.isArray(x) || ArrayBuffer.isView(x)
  ? [...x].map(Number) : [Number(x), Number(y ?? 0), Number(z ?? 0)];

/** Contours: one, several, or a CrossSection. */
function contoursOf(polygons) {
  if (polygons instanceof CrossSection) return polygons.toPolygons();
  return polygons.length > 0 && typeof polygons[0][0] === "number"
    ? [polygons] : polygons;
}
function signedArea(loop) {
  let twice = 0;
  loop.forEach(([x, y], k) => {
    const [u, v] = loop[(k + 1) % loop.length];
    twice += x * v - u * y;
  });
  return twice / 2;
}

/** The solid of what contours wind round: counterclockwise ones add. */
function prismOf(polygons, height) {
  const loops = contoursOf(polygons).filter((loop) => loop.length >= 3);
  const outer = loops.filter((loop) => signedArea(loop) > 0)
    .map((loop) => Solid.prism(loop, height));
  const inner = loops.filter((loop) => signedArea(loop) < 0)
    .map((loop) => Solid.prism(loop, height));
  const all = outer.length === 1 ? outer[0] : Solid.union(outer);
  return inner.length === 0 ? all : all.subtract(Solid.union(inner));
}

const STATUS = {
  OPEN: "NotManifold", SELF_CROSSING: "NotManifold", INSIDE_OUT: "NotManifold",
  NOT_FINITE: "NonFiniteVertex", BAD_INDEX: "VertexOutOfBounds",
  OUT_OF_RANGE: "ResultTooLarge", UNBOUNDED: "InvalidConstruction",
};

/** A mesh in manifold-3d's arrays. */
export class Mesh {
  constructor(options) {
    this.numProp = options.numProp ?? 3;
    this.vertProperties = options.vertProperties;
    this.triVerts = options.triVerts;
    this.mergeFromVert = options.mergeFromVert ?? new Uint32Array();
    this.mergeToVert = options.mergeToVert ?? new Uint32Array();
    this.runIndex = options.runIndex ?? new Uint32Array();
    this.runOriginalID = options.runOriginalID ?? new Uint32Array();
    this.runTransform = options.runTransform ?? new Float32Array();
    this.faceID = options.faceID ?? new Uint32Array();
    this.halfedgeTangent = options.halfedgeTangent ?? new Float32Array();
  }
  get numTri() {
    return this.triVerts.length / 3;
  }
  get numVert() {
    return this.vertProperties.length / this.numProp;
  }
  get numRun() {
    return this.runOriginalID.length;
  }
  verts(triangle) {
    return this.triVerts.subarray(3 * triangle, 3 * triangle + 3);
  }
  position(vertex) {
    const at = this.numProp * vertex;
    return this.vertProperties.subarray(at, at + 3);
  }
  extras(vertex) {
    const at = this.numProp * vertex;
    return this.vertProperties.subarray(at + 3, at + this.numProp);
  }
  /** Equal points are one point here without being told so. */
  merge() {
    return false;
  }
}

const advice = {
  levelSet: "sample the function to a mesh and take ofMesh()",
  smooth: "there is no smoothing; refine the mesh before ofMesh()",
  refine: "surfaces are flat: more triangles are the same surface",
  refineToLength: "surfaces are flat: more triangles are the same surface",
  refineToTolerance: "surfaces are flat: more triangles are the same surface",
  smoothByNormals: "there is no smoothing; refine the mesh before ofMesh()",
  smoothOut: "there is no smoothing; refine the mesh before ofMesh()",
  setProperties: "keep what belongs to vertices by runOriginalID and faceID",
  calculateNormals: "take the normals of the triangles of getMesh()",
  calculateCurvature: "there is no curvature; take it from getMesh()",
  minGap: "use Solid.touches() of halfspace for whether the gap is 0",
  setTolerance: "there is no tolerance: results are exact",
  rayCast: "use Scene.pick() of halfspace",
  minkowskiSum: "take Manifold.hull() of convex parts moved to the corners",
  minkowskiDifference: "there is no Minkowski difference",
  offset: "there are no offsets; offset the contours before CrossSection.of()",
  warpBatch: "use warp()",
  simplify: "faces in one plane are one face already; see Solid.mesh()",
};

/** Throws on names that manifold-3d has and this has not. */
function guarded(object, what) {
  return new Proxy(object, {
    get(target, name, receiver) {
      if (typeof name === "string" && !(name in target) && name in advice) {
        throw new HalfspaceError("NOT_THERE", "not there",
          `${what}.${name} is not in halfspace/manifold: ${advice[name]}`);
      }
      return Reflect.get(target, name, receiver);
    },
  });
}

/** A solid, under manifold-3d's names. */
class ManifoldBase {
  #solid;
  #sources;
  #originalId;

  constructor(solid, sources = new Map(), originalId = -1) {
    if (solid instanceof Mesh || solid?.triVerts) {
      const made = Manifold.ofMesh(solid);
      [solid, sources, originalId] = [made._solid, made._sources,
        made.originalID()];
    }
    this.#solid = solid ?? Solid.empty();
    this.#sources = sources;
    this.#originalId = originalId;
  }
  /** The solid of halfspace: exact volumes, scenes, SVG. */
  get _solid() {
    return this.#solid;
  }
  get solid() {
    return this.#solid;
  }
  get _sources() {
    return this.#sources;
  }

  /** An original: its name in results is its id. */
  static _original(solid, source = {}) {
    const id = source.id ?? nextId++;
    const name = `m${id}`;
    return new Manifold(solid.named(name),
      new Map([[name, { id, ...source }]]), id);
  }
  static _joined(solid, ...from) {
    const sources = new Map();
    for (const m of from)
      for (const [name, source] of m._sources) sources.set(name, source);
    return new Manifold(solid, sources);
  }
  #like(solid) {
    return new Manifold(solid, this.#sources);
  }

  static cube(size = [1, 1, 1], center = false) {
    const s = vec3(size);
    return this._original(center
      ? Solid.box(s.map((v) => -v / 2), s.map((v) => v / 2))
      : Solid.box([0, 0, 0], s));
  }
  static sphere(radius, segments = 0) {
    return this._original(
      Solid.sphere(radius, segmentsFor(radius, segments)));
  }
  static cylinder(height, radiusLow, radiusHigh = -1, segments = 0,
    center = false) {
    const high = radiusHigh < 0 ? radiusLow : radiusHigh;
    const solid = Solid.cone(radiusLow, high, height,
      segmentsFor(Math.max(radiusLow, high), segments));
    return this._original(
      center ? solid.translate([0, 0, -height / 2]) : solid);
  }
  static tetrahedron() {
    return this._original(Solid.hull(
      [[-1, -1, 1], [-1, 1, -1], [1, -1, -1], [1, 1, 1]]));
  }
  static extrude(polygons, height, nDivisions = 0, twistDegrees = 0,
    scaleTop = [1, 1], center = false) {
    if (twistDegrees !== 0) {
      throw new HalfspaceError("NOT_THERE", "not there",
        "extrude() does not twist here: make a mesh of it for ofMesh()");
    }
    const [sx, sy] = vec2(scaleTop);
    let solid = prismOf(polygons, height);
    if (sx !== 1 || sy !== 1) {
      if (sx <= 0 || sy <= 0) {
        throw new HalfspaceError("OUT_OF_RANGE", "out of range",
          "extrude() takes a scaleTop above 0: use Manifold.hull() for a tip");
      }
      const mesh = solid.mesh();
      const vertices = mesh.vertices;
      for (let k = 0; k < vertices.length; k += 3) {
        if (vertices[k + 2] === 0) continue;
        vertices[k] *= sx;
        vertices[k + 1] *= sy;
      }
      solid = Solid.fromMesh({ vertices, triangles: mesh.corners });
    }
    return this._original(
      center ? solid.translate([0, 0, -height / 2]) : solid);
  }
  static revolve(polygons, segments = 0, revolveDegrees = 360) {
    if (revolveDegrees < 360) {
      throw new HalfspaceError("NOT_THERE", "not there",
        "revolve() goes all round here: intersect it with an extruded wedge");
    }
    const loops = contoursOf(polygons);
    const radius = Math.max(...loops.flat().map(([x]) => x));
    const count = segmentsFor(radius, segments);
    const of = (sign) => loops.filter((l) => signedArea(l) * sign > 0)
      .map((l) => Solid.revolution(l, count));
    const outer = Solid.union(of(1));
    const inner = of(-1);
    return this._original(
      inner.length ? outer.subtract(Solid.union(inner)) : outer);
  }
  static ofMesh(mesh) {
    const { numProp = 3, vertProperties, triVerts } = mesh;
    const count = vertProperties.length / numProp;
    const vertices = new Float64Array(3 * count);
    for (let v = 0; v < count; ++v)
      for (let c = 0; c < 3; ++c)
        vertices[3 * v + c] = vertProperties[numProp * v + c];
    const triangles = Int32Array.from(triVerts);
    const runIndex = mesh.runIndex?.length ? [...mesh.runIndex] : null;
    const ids = mesh.runOriginalID ? [...mesh.runOriginalID] : [];
    const materials = new Int32Array(triangles.length / 3);
    if (runIndex) {
      for (let r = 0; r + 1 < runIndex.length; ++r)
        materials.fill(r, runIndex[r] / 3, runIndex[r + 1] / 3);
    }
    return this._original(
      Solid.fromMesh({ vertices, triangles, materials }),
      { runOf: runIndex ? materials : null, ids,
        faceID: mesh.faceID?.length ? Uint32Array.from(mesh.faceID) : null });
  }
  static hull(points) {
    const list = points.flatMap((p) => p instanceof ManifoldBase
      ? Array.from({ length: p.numVert() }, (_, v) =>
        p._solidMesh().vertices.slice(3 * v, 3 * v + 3))
      : [p]);
    return this._original(Solid.hull(list.map((p) => [...p])));
  }
  static union(a, b) {
    return ManifoldBase.#many(b === undefined ? a : [a, b], "union");
  }
  static difference(a, b) {
    const [first, ...others] = b === undefined ? a : [a, b];
    if (others.length === 0) return first;
    return ManifoldBase._joined(first._solid.subtract(
      Solid.union(others.map((m) => m._solid))), first, ...others);
  }
  static intersection(a, b) {
    return ManifoldBase.#many(b === undefined ? a : [a, b], "intersection");
  }
  static #many(list, how) {
    return ManifoldBase._joined(
      Solid[how](list.map((m) => m._solid)), ...list);
  }
  /** Disjoint parts as one. */
  static compose(list) {
    return ManifoldBase.#many(list, "union");
  }
  static reserveIDs(count) {
    const first = nextId;
    nextId += count;
    return first;
  }

  add(other) {
    return ManifoldBase._joined(this.#solid.add(other._solid), this, other);
  }
  subtract(other) {
    return ManifoldBase._joined(this.#solid.subtract(other._solid), this,
      other);
  }
  intersect(other) {
    return ManifoldBase._joined(this.#solid.intersect(other._solid), this,
      other);
  }
  /** What is in the cutter, and what is not. */
  split(cutter) {
    return [this.intersect(cutter), this.subtract(cutter)];
  }
  /** What is on the normal's side of the plane, and the rest. */
  splitByPlane(normal, originOffset) {
    const { negative, positive } =
      this.#solid.split(vec3(normal), unitOffset(normal, originOffset));
    return [this.#like(positive), this.#like(negative)];
  }
  trimByPlane(normal, originOffset) {
    return this.splitByPlane(normal, originOffset)[0];
  }
  slice(height = 0) {
    return CrossSection._ofRegions(this.#solid.section([0, 0, 1], height));
  }
  /** The shadow on the plane z = 0. */
  project() {
    return scope(() => {
      const { vertices, corners } = this._solidMesh();
      const prisms = [];
      for (let t = 0; t < corners.length; t += 3) {
        const loop = [0, 1, 2].map((k) =>
          [vertices[3 * corners[t + k]], vertices[3 * corners[t + k] + 1]]);
        if (signedArea(loop) > 0) prisms.push(Solid.prism(loop, 1));
      }
      return CrossSection._ofRegions(
        Solid.union(prisms).section([0, 0, 1], 0.5));
    });
  }
  translate(x, y, z) {
    return this.#like(this.#solid.translate(shift3(x, y, z)));
  }
  /** About x, then y, then z. Units: degrees. */
  rotate(x, y, z) {
    const [a, b, c] = shift3(x, y, z);
    let solid = this.#solid;
    if (a) solid = solid.rotate([1, 0, 0], a);
    if (b) solid = solid.rotate([0, 1, 0], b);
    if (c) solid = solid.rotate([0, 0, 1], c);
    return this.#like(solid);
  }
  scale(x, y, z) {
    return this.#like(this.#solid.scale(vec3(x, y, z)));
  }
  mirror(normal) {
    return this.#like(this.#solid.mirror(vec3(normal), 0));
  }
  /** Column by column, 16 numbers. */
  transform(m) {
    const rows = [0, 1, 2].map((r) => [m[r], m[4 + r], m[8 + r], m[12 + r]]);
    return this.#like(this.#solid.transform(rows));
  }
  /** Moves vertices: the function changes the point that it is given. */
  warp(move) {
    const mesh = this._solidMesh();
    const vertices = mesh.vertices.slice();
    for (let k = 0; k < vertices.length; k += 3) {
      const point = [...vertices.subarray(k, k + 3)];
      move(point);
      vertices.set(point, k);
    }
    return Manifold._original(
      Solid.fromMesh({ vertices, triangles: mesh.corners }));
  }
  decompose() {
    return this.#solid.decompose().map((part) => this.#like(part));
  }

  _solidMesh() {
    return this.#solid.mesh({ triangles: true });
  }
  getMesh() {
    const mesh = this._solidMesh();
    const names = this.#solid.operands().map((o) => {
      const name = o.name;
      o.dispose();
      return name;
    });
    const count = mesh.corners.length / 3;
    const rows = Array.from({ length: count }, (_, t) => {
      const source = this.#sources.get(names[mesh.origins[2 * t]]);
      const polygon = mesh.origins[2 * t + 1];
      const run = source?.runOf ? source.runOf[polygon] : 0;
      return {
        t,
        id: source?.ids?.[run] ?? source?.id ?? 0,
        face: source?.faceID ? source.faceID[polygon] : polygon,
      };
    });
    rows.sort((a, b) => a.id - b.id || a.t - b.t);
    const triVerts = new Uint32Array(3 * count);
    const faceID = new Uint32Array(count);
    const runIndex = [];
    const runOriginalID = [];
    rows.forEach(({ t, id, face }, k) => {
      triVerts.set(mesh.corners.subarray(3 * t, 3 * t + 3), 3 * k);
      faceID[k] = face;
      if (runOriginalID.at(-1) === id) return;
      runIndex.push(3 * k);
      runOriginalID.push(id);
    });
    runIndex.push(3 * count);
    return new Mesh({
      numProp: 3,
      vertProperties: Float32Array.from(mesh.vertices),
      triVerts,
      runIndex: Uint32Array.from(runIndex),
      runOriginalID: Uint32Array.from(runOriginalID),
      faceID,
    });
  }

  volume() {
    return this.#solid.volume();
  }
  surfaceArea() {
    return this.#solid.area();
  }
  boundingBox() {
    const { low, high } = this.#solid.bounds();
    return { min: low, max: high };
  }
  genus() {
    return this.#solid.genus();
  }
  numTri() {
    return this._solidMesh().corners.length / 3;
  }
  numVert() {
    return this._solidMesh().vertices.length / 3;
  }
  numEdge() {
    return this.numTri() * 3 / 2;
  }
  numProp() {
    return 0;
  }
  numPropVert() {
    return this.numVert();
  }
  isEmpty() {
    return this.#solid.isEmpty();
  }
  /** "NoError", or what is wrong in manifold-3d's words. */
  status() {
    try {
      this.#solid.evaluate();
      return "NoError";
    } catch (error) {
      if (!(error instanceof HalfspaceError)) throw error;
      return STATUS[error.code] ?? "InvalidConstruction";
    }
  }
  /** There is none: results are exact. */
  tolerance() {
    return 0;
  }
  originalID() {
    return this.#originalId;
  }
  asOriginal() {
    return Manifold._original(
      Solid.fromMesh(trianglesOf(this._solidMesh())));
  }
  /** Not needed: the garbage collector does it. */
  delete() {
    this.#solid.dispose();
  }
  [Symbol.dispose ?? Symbol.for("Symbol.dispose")]() {
    this.delete();
  }
}

const trianglesOf = (mesh) =>
  ({ vertices: mesh.vertices, triangles: mesh.corners });
/** manifold-3d takes the offset along the unit normal. */
function unitOffset(normal, offset) {
  const length = Math.hypot(...normal);
  return offset * length;
}
for (const name of Object.keys(advice)) {
  if (name in ManifoldBase.prototype || name === "offset") continue;
  Object.defineProperty(ManifoldBase.prototype, name, {
    configurable: true,
    get() {
      throw new HalfspaceError("NOT_THERE", "not there",
        `Manifold.${name} is not in halfspace/manifold: ${advice[name]}`);
    },
  });
}
export const Manifold = guarded(ManifoldBase, "Manifold");

/** A plane figure: contours, counterclockwise round what is in it. */
export class CrossSection {
  #loops;
  constructor(polygons = []) {
    this.#loops = contoursOf(polygons).map((l) => l.map((p) => [...p]));
  }
  static _ofRegions(regions) {
    const flat = (points) => {
      const loop = [];
      for (let k = 0; k < points.length; k += 3)
        loop.push([points[k], points[k + 1]]);
      return loop;
    };
    return new CrossSection(regions.flatMap((r) =>
      [flat(r.boundary), ...r.holes.map(flat)]));
  }
  static of(polygons) {
    return new CrossSection(polygons);
  }
  static ofPolygons(polygons) {
    return new CrossSection(polygons);
  }
  static square(size = [1, 1], center = false) {
    const [w, h] = vec2(size);
    const [x, y] = center ? [-w / 2, -h / 2] : [0, 0];
    return new CrossSection([[[x, y], [x + w, y], [x + w, y + h], [x, y + h]]]);
  }
  static circle(radius, segments = 0) {
    const n = segmentsFor(radius, segments);
    return new CrossSection([Array.from({ length: n }, (_, k) => {
      const a = 2 * Math.PI * k / n;
      return [radius * Math.cos(a), radius * Math.sin(a)];
    })]);
  }
  static union(a, b) {
    return (b === undefined ? a : [a, b]).reduce((x, y) => x.add(y));
  }
  static difference(a, b) {
    return (b === undefined ? a : [a, b]).reduce((x, y) => x.subtract(y));
  }
  static intersection(a, b) {
    return (b === undefined ? a : [a, b]).reduce((x, y) => x.intersect(y));
  }
  #with(other, how) {
    return scope(() => CrossSection._ofRegions(
      prismOf(this, 1)[how](prismOf(other, 1)).section([0, 0, 1], 0.5)));
  }
  add(other) {
    return this.#with(other, "add");
  }
  subtract(other) {
    return this.#with(other, "subtract");
  }
  intersect(other) {
    return this.#with(other, "intersect");
  }
  #mapped(f, flips = false) {
    return new CrossSection(this.#loops.map((loop) => {
      const moved = loop.map(f);
      return flips ? moved.reverse() : moved;
    }));
  }
  translate(x, y = 0) {
    const [dx, dy] = Array.isArray(x) ? x : [x, y];
    return this.#mapped(([u, v]) => [u + dx, v + dy]);
  }
  scale(x, y) {
    const [sx, sy] = vec2(x, y);
    return this.#mapped(([u, v]) => [sx * u, sy * v], sx * sy < 0);
  }
  rotate(degrees) {
    const a = degrees * Math.PI / 180;
    const [c, s] = [Math.cos(a), Math.sin(a)];
    return this.#mapped(([u, v]) => [c * u - s * v, s * u + c * v]);
  }
  extrude(height, nDivisions, twistDegrees, scaleTop, center) {
    return Manifold.extrude(this, height, nDivisions, twistDegrees, scaleTop,
      center);
  }
  revolve(segments, degrees) {
    return Manifold.revolve(this, segments, degrees);
  }
  toPolygons() {
    return this.#loops.map((loop) => loop.map((p) => [...p]));
  }
  area() {
    return this.#loops.reduce((sum, loop) => sum + signedArea(loop), 0);
  }
  bounds() {
    const points = this.#loops.flat();
    const x = points.map((p) => p[0]);
    const y = points.map((p) => p[1]);
    return { min: [Math.min(...x), Math.min(...y)],
      max: [Math.max(...x), Math.max(...y)] };
  }
  isEmpty() {
    return this.#loops.length === 0;
  }
  numContour() {
    return this.#loops.length;
  }
  numVert() {
    return this.#loops.reduce((sum, loop) => sum + loop.length, 0);
  }
  delete() {}
  get offset() {
    throw new HalfspaceError("NOT_THERE", "not there",
      `CrossSection.offset is not in halfspace/manifold: ${advice.offset}`);
  }
}

export function setMinCircularAngle(degrees) {
  minAngle = degrees;
}
export function setMinCircularEdgeLength(length) {
  minEdge = length;
}
export function setCircularSegments(count) {
  circularSegments = count;
}
export function getCircularSegments(radius) {
  return segmentsFor(radius, 0);
}
export function resetToCircularDefaults() {
  circularSegments = 0;
  minAngle = 10;
  minEdge = 1;
}

/** As manifold-3d's default export: `await Module()`, then `setup()`. */
export default async function Module(options) {
  await init(options);
  return {
    setup() {},
    Manifold, CrossSection, Mesh,
    setMinCircularAngle, setMinCircularEdgeLength, setCircularSegments,
    getCircularSegments, resetToCircularDefaults,
    triangulate() {
      throw new HalfspaceError("NOT_THERE", "not there",
        "triangulate is not in halfspace/manifold: take the triangles of " +
        "Manifold.extrude(polygons, 1).getMesh()");
    },
  };
}
