/**
 * The core of manifold-3d's interface over exact solids: editors switch by one
 * import. What is not here throws, and says what to do. `delete()` is never
 * needed.
 */
import type { InitOptions, Solid } from "./halfspace.js";

export type Vec2 = [number, number];
export type Vec3 = [number, number, number];
export type SimplePolygon = Vec2[];
export type Polygons = SimplePolygon | SimplePolygon[] | CrossSection;
export interface Box { min: number[]; max: number[] }
export interface Rect { min: number[]; max: number[] }
export type ErrorStatus = "NoError" | "NonFiniteVertex" | "NotManifold" |
  "VertexOutOfBounds" | "ResultTooLarge" | "InvalidConstruction";

export interface MeshOptions {
  numProp: number;
  vertProperties: Float32Array;
  triVerts: Uint32Array;
  mergeFromVert?: Uint32Array;
  mergeToVert?: Uint32Array;
  runIndex?: Uint32Array;
  runOriginalID?: Uint32Array;
  runTransform?: Float32Array;
  faceID?: Uint32Array;
}
export class Mesh {
  constructor(options: MeshOptions);
  numProp: number;
  vertProperties: Float32Array;
  triVerts: Uint32Array;
  mergeFromVert: Uint32Array;
  mergeToVert: Uint32Array;
  runIndex: Uint32Array;
  runOriginalID: Uint32Array;
  runTransform: Float32Array;
  faceID: Uint32Array;
  readonly numTri: number;
  readonly numVert: number;
  readonly numRun: number;
  verts(triangle: number): Uint32Array;
  position(vertex: number): Float32Array;
  extras(vertex: number): Float32Array;
  merge(): boolean;
}

export class Manifold {
  constructor(mesh?: Mesh);
  /** The exact solid: volumes as fractions, scenes, SVG. */
  readonly solid: Solid;
  static cube(size?: number | Vec3, center?: boolean): Manifold;
  static sphere(radius: number, circularSegments?: number): Manifold;
  static cylinder(height: number, radiusLow: number, radiusHigh?: number,
    circularSegments?: number, center?: boolean): Manifold;
  static tetrahedron(): Manifold;
  static extrude(polygons: Polygons, height: number, nDivisions?: number,
    twistDegrees?: number, scaleTop?: number | Vec2, center?: boolean):
    Manifold;
  static revolve(polygons: Polygons, circularSegments?: number,
    revolveDegrees?: number): Manifold;
  static ofMesh(mesh: Mesh | MeshOptions): Manifold;
  static hull(points: (Manifold | Vec3)[]): Manifold;
  static union(a: Manifold, b: Manifold): Manifold;
  static union(manifolds: Manifold[]): Manifold;
  static difference(a: Manifold, b: Manifold): Manifold;
  static difference(manifolds: Manifold[]): Manifold;
  static intersection(a: Manifold, b: Manifold): Manifold;
  static intersection(manifolds: Manifold[]): Manifold;
  static compose(manifolds: Manifold[]): Manifold;
  static reserveIDs(count: number): number;
  add(other: Manifold): Manifold;
  subtract(other: Manifold): Manifold;
  intersect(other: Manifold): Manifold;
  split(cutter: Manifold): [Manifold, Manifold];
  splitByPlane(normal: Vec3, originOffset: number): [Manifold, Manifold];
  trimByPlane(normal: Vec3, originOffset: number): Manifold;
  slice(height?: number): CrossSection;
  project(): CrossSection;
  translate(t: Vec3): Manifold;
  translate(x: number, y?: number, z?: number): Manifold;
  rotate(degrees: Vec3): Manifold;
  rotate(x: number, y?: number, z?: number): Manifold;
  scale(v: number | Vec3): Manifold;
  mirror(normal: Vec3): Manifold;
  transform(m: ArrayLike<number>): Manifold;
  warp(move: (point: number[]) => void): Manifold;
  decompose(): Manifold[];
  getMesh(): Mesh;
  volume(): number;
  surfaceArea(): number;
  boundingBox(): Box;
  genus(): number;
  numTri(): number;
  numVert(): number;
  numEdge(): number;
  numProp(): number;
  numPropVert(): number;
  isEmpty(): boolean;
  status(): ErrorStatus;
  tolerance(): number;
  originalID(): number;
  asOriginal(): Manifold;
  delete(): void;
}

export class CrossSection {
  constructor(polygons?: Polygons);
  static of(polygons: Polygons): CrossSection;
  static ofPolygons(polygons: Polygons): CrossSection;
  static square(size?: number | Vec2, center?: boolean): CrossSection;
  static circle(radius: number, circularSegments?: number): CrossSection;
  static union(list: CrossSection[]): CrossSection;
  static union(a: CrossSection, b: CrossSection): CrossSection;
  static difference(list: CrossSection[]): CrossSection;
  static difference(a: CrossSection, b: CrossSection): CrossSection;
  static intersection(list: CrossSection[]): CrossSection;
  static intersection(a: CrossSection, b: CrossSection): CrossSection;
  add(other: CrossSection): CrossSection;
  subtract(other: CrossSection): CrossSection;
  intersect(other: CrossSection): CrossSection;
  translate(v: Vec2): CrossSection;
  translate(x: number, y?: number): CrossSection;
  scale(v: number | Vec2): CrossSection;
  rotate(degrees: number): CrossSection;
  extrude(height: number, nDivisions?: number, twistDegrees?: number,
    scaleTop?: number | Vec2, center?: boolean): Manifold;
  revolve(circularSegments?: number, revolveDegrees?: number): Manifold;
  toPolygons(): SimplePolygon[];
  area(): number;
  bounds(): Rect;
  isEmpty(): boolean;
  numContour(): number;
  numVert(): number;
  delete(): void;
}

export function setMinCircularAngle(degrees: number): void;
export function setMinCircularEdgeLength(length: number): void;
export function setCircularSegments(count: number): void;
export function getCircularSegments(radius: number): number;
export function resetToCircularDefaults(): void;

export interface ManifoldToplevel {
  setup(): void;
  Manifold: typeof Manifold;
  CrossSection: typeof CrossSection;
  Mesh: typeof Mesh;
  setMinCircularAngle: typeof setMinCircularAngle;
  setMinCircularEdgeLength: typeof setMinCircularEdgeLength;
  setCircularSegments: typeof setCircularSegments;
  getCircularSegments: typeof getCircularSegments;
  resetToCircularDefaults: typeof resetToCircularDefaults;
}
export default function Module(options?: InitOptions): Promise<ManifoldToplevel>;
