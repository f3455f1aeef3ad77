/**
 * Exact solids and exact pictures: the C++ library Halfspace as WebAssembly.
 *
 *     import { init, Solid } from "halfspace";
 *     await init();
 *     const part = Solid.box([0, 0, 0], [4, 3, 1])
 *       .subtract(Solid.cylinder(1, 9).translate([2, 1.5, -4]));
 *     part.volume();
 *
 * A number of at most 12 significant decimal digits is that decimal, so 0.1 is
 * one tenth. Nothing needs to be deleted: what is no longer used is given back
 * when the garbage collector finds it, or at once by `using`, `dispose()` or
 * `scope()`.
 */

export type Vector = readonly [number, number, number] | ArrayLike<number>;
export type Format = "stl" | "obj" | "ply" | "off" | "hsolid" | (string & {});
export type Numbers = ArrayLike<number> | readonly (readonly number[])[];

/** Receives the share that is done, 0 to 1; where it returns false, the work
 *  stops with the code STOPPED. */
export type Progress = (share: number) => boolean | void;

export interface InitOptions {
  /** The module, instead of the one that the package holds. */
  wasm?: BufferSource | WebAssembly.Module | Response | URL | string;
}
export function init(options?: InitOptions): Promise<void>;
/** A fresh module, after one that broke: all that was made before is gone. */
export function reset(): Promise<void>;
/** The compiled module, for `init({ wasm })` in a worker. */
export function wasmModule(): WebAssembly.Module;
export function version(): string;
/** How much memory the module has. Units: bytes. */
export function memoryBytes(): number;

/** Disposes of all that `work` made, but for what it returns. */
export function scope<T>(work: () => T): T;

/** What a question failed with. */
export class HalfspaceError extends Error {
  /** Such as "OPEN" or "SYNTAX"; "BROKEN" where the module stopped. */
  readonly code: string;
  /** A few words for the code. */
  readonly words: string;
  /** Of the polygon, line or byte; -1: none. */
  readonly index: number;
}

/** A rational number without common factors. */
export class Rational {
  readonly numerator: bigint;
  readonly denominator: bigint;
  /** A decimal, or a fraction such as 1/3. */
  toString(): string;
  valueOf(): number;
}

interface Owned {
  /** Gives the memory back now; the object is of no use from then on. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/** The surface of a solid, in arrays of its own. */
export class Mesh {
  /** Three numbers a vertex. Units: model units. */
  readonly vertices: Float64Array;
  /** Polygon p has corners[firstCorner[p]] to before firstCorner[p + 1]. */
  readonly firstCorner: Uint32Array;
  readonly corners: Int32Array;
  /** One a polygon, or empty. */
  readonly materials: Int32Array;
  /** Two a polygon: the operand (Solid.operands()) and its polygon. */
  readonly origins: Int32Array;
  /** Three a polygon, or empty. */
  readonly colors: Uint8Array;
  readonly vertexCount: number;
  readonly polygonCount: number;
}

export interface MeshInput {
  vertices: Numbers;
  /** Three corners each; or `corners` with `firstCorner`. */
  triangles?: Numbers;
  corners?: Numbers;
  firstCorner?: ArrayLike<number>;
  /** One a polygon; faces never merge across a change of them. */
  materials?: ArrayLike<number>;
}
export interface OperandOptions {
  /** Take what a surface that crosses itself winds round. */
  resolve?: boolean;
  /** Make polygons in one plane one face first; true unless said. */
  mergeCoplanar?: boolean;
  /** Let the finest grid round what other operands do not go together with,
   *  in place of an error. The program does so with all files. */
  mayRound?: boolean;
  /** What messages call the file. */
  name?: string;
}
export interface MeshOptions {
  /** Which faces in one plane become one; "origin" unless said. */
  merge?: "origin" | "plane" | "none";
  /** Triangles only. Of mesh() true, of save() false, unless said. */
  triangles?: boolean;
  progress?: Progress;
}
export interface Region {
  /** Three numbers a point, counterclockwise as seen from the normal's side. */
  boundary: Float64Array;
  holes: Float64Array[];
}

/**
 * A solid: a value that is an expression of others, worked out when something
 * is asked of it, once. Making and combining cannot fail: what is wrong comes
 * out where the solid is used, as a HalfspaceError.
 */
export class Solid implements Owned {
  static empty(): Solid;
  static box(corner: Vector, opposite: Vector): Solid;
  static sphere(radius: number, segments?: number): Solid;
  static cylinder(radius: number, height: number, segments?: number): Solid;
  static cone(bottomRadius: number, topRadius: number, height: number,
    segments?: number): Solid;
  static torus(radius: number, tubeRadius: number, segments?: number,
    tubeSegments?: number): Solid;
  /** An outline in the plane z = 0, two numbers a point, drawn up. */
  static prism(outline: Numbers, height: number, holes?: Numbers[]): Solid;
  /** An outline of points (r, z), turned about the z axis. */
  static revolution(outline: Numbers, segments?: number): Solid;
  static hull(points: Numbers): Solid;
  /** All points with normal . p below the offset. */
  static halfSpace(normal: Vector, offset: number): Solid;
  static fromMesh(mesh: MeshInput, options?: OperandOptions): Solid;
  static fromFile(bytes: BufferSource, format: Format,
    options?: OperandOptions): Solid;
  /** The solid that the surface in a file was meant to be, and what was done. */
  static mended(bytes: BufferSource, format: Format,
    options?: { weld?: number; thicken?: number; name?: string }):
    { solid: Solid; done: string[] };
  /** What a script says, such as "box(4) - sphere(1)". */
  static fromText(script: string): Solid;
  static union(solids: Iterable<Solid>): Solid;
  static intersection(solids: Iterable<Solid>): Solid;

  add(other: Solid): Solid;
  subtract(other: Solid): Solid;
  intersect(other: Solid): Solid;
  xor(other: Solid): Solid;
  complement(): Solid;
  translate(by: Vector): Solid;
  scale(by: number | Vector): Solid;
  /** About an axis through the origin. */
  rotate(axis: Vector, degrees: number): Solid;
  mirror(normal: Vector, offset?: number): Solid;
  /** Three rows of four numbers. */
  transform(rows: Numbers): Solid;
  split(normal: Vector, offset: number): { negative: Solid; positive: Solid };
  named(name: string): Solid;
  readonly name: string;

  /** Works it out now. */
  evaluate(options?: { progress?: Progress }): this;
  /** Rounded to the nearest double. */
  volume(): number;
  area(): number;
  exactVolume(): Rational;
  /** Null where it is irrational. */
  exactArea(): Rational | null;
  bounds(): { low: number[]; high: number[] };
  centroid(): number[];
  /** The tensor about the centroid at density 1. */
  inertia(): number[][];
  genus(): number;
  shellCount(): number;
  isEmpty(): boolean;
  /** What rounding did to the operands: all there is of it. */
  rounding(): { moved: number; maxMove: number; step: number; gridBits: number };
  locate(point: Vector): "inside" | "on" | "outside";
  overlaps(other: Solid): boolean;
  touches(other: Solid): boolean;
  contains(other: Solid): boolean;
  /** The connected parts. */
  decompose(): Solid[];
  /** What it was made of, as Mesh.origins counts. */
  operands(): Solid[];
  section(normal: Vector, offset: number): Region[];
  mesh(options?: MeshOptions): Mesh;
  /** The bytes of a file: what the program writes. */
  save(format: Format, options?: MeshOptions): Uint8Array;

  dispose(): void;
  [Symbol.dispose](): void;
}

/** Where something is seen from. Units: model units, degrees, pixels. */
export interface View {
  eye?: Vector;
  target?: Vector;
  up?: Vector;
  /** Instead of eye and target: where all is seen from. */
  direction?: Vector;
  azimuth?: number;
  elevation?: number;
  fov?: number;
  orthographic?: boolean;
  orthoHeight?: number;
  near?: number;
  width?: number;
  height?: number;
  cull?: boolean;
  background?: Vector;
  /** Marks what is seen from behind; of one sample a pixel, not in figures. */
  backColor?: Vector;
  /** Planes a, b, c, d: what has a x + b y + c z + d >= 0 is kept. */
  clips?: readonly (readonly [number, number, number, number])[];
  /** A colour or a hatch that fills the cuts of solids. */
  caps?: Vector | "hatch";
  /** Each solid or file has caps with a colour of its own; where several are,
   *  caps look as `caps` says. */
  capsBySolid?: boolean;
  /** How much of what is behind a polygon it hides: all of it, or alpha / 255.
   *  In pictures of one sample a pixel without caps or marked back faces, and
   *  in figures without clip planes, whose regions have composed colours. */
  alpha?: number;
  /** 1, 2, 4 or 8 samples a pixel each way; ids are then those of samples. */
  samples?: 1 | 2 | 4 | 8;
}
export interface Picture {
  width: number;
  height: number;
  /** By pixel its polygon; -1: none. */
  ids: Int32Array;
  /** What ImageData takes. */
  rgba: Uint8ClampedArray;
}
export interface DrawOptions {
  format?: "svg" | "pdf" | "eps" | "tex" | "dxf" | "hpgl";
  /** Which polygons make one region, and its colour; "colour" unless said. */
  fill?: "none" | "face" | "part" | "file" | "colour";
  /** "none" unless said. */
  lines?: "none" | "regions" | "edges" | "hidden-dashed";
  crease?: number;
  lineWidth?: number;
  decimals?: number;
  progress?: Progress;
}
export interface SceneFile {
  bytes: BufferSource;
  format: Format;
  name?: string;
}

/** How numbers become colours. */
export interface ScalarStyle {
  /** heated, grey, viridis, cividis, turbo or coolwarm, with _r in reverse. */
  map?: string;
  /** Nothing: the least number, and the greatest. */
  low?: number;
  high?: number;
  logarithmic?: boolean;
  /** So many bands; 0: one a colour. */
  steps?: number;
  /** false: what is outside has the colour of no data. */
  clamp?: boolean;
}

/** Solids, or meshes that need be none, to look at. */
export class Scene implements Owned {
  static of(solids: Solid | Iterable<Solid>,
    options?: { progress?: Progress }): Scene;
  /** What the program's `render` and `draw` show of these files. */
  static ofFiles(files: Iterable<SceneFile>,
    options?: { progress?: Progress }): Scene;
  /** A mesh coloured by numbers: a property of the PLY file that it is, or a
   *  file of numbers (csv, txt, npy), one a vertex or one a polygon. What is
   *  interpolated is the number. */
  static byScalars(file: SceneFile, source: string | SceneFile,
    options?: ScalarStyle & { progress?: Progress }): Scene;
  /** The properties of a PLY file by which byScalars() colours it. */
  static scalarNames(bytes: ArrayBufferView | ArrayBuffer): string[];
  /** Chooses the colours of a scene of byScalars(): the range that it has, and
   *  the colours of its bands from the least number on, three bytes each. */
  colorBy(style?: ScalarStyle): { low: number; high: number;
    colors: Uint8Array };
  readonly polygonCount: number;
  /** By polygon the solid or file that it is of. */
  sources(): Int32Array;
  /** The view, with what it does not say so that all is seen. */
  view(partial?: View): View;
  render(view?: View, options?: { progress?: Progress }): Picture;
  /** What is at a pixel. A cap is no polygon: of the k-th plane it is
   *  polygonCount + k, of source -1, and where it is seen is not told. */
  pick(view: View, x: number, y: number):
    { polygon: number; source: number; point: number[] | null;
      distance: number | null } | null;
  draw(view?: View, options?: DrawOptions): Uint8Array;
  svg(view?: View, options?: DrawOptions): string;
  /** Parts of polygons as vertices, three numbers each, and by vertex the
   *  polygon: the same for every eye. */
  fragments(): { positions: Float32Array; polygons: Int32Array };
  /** Indices of their triangles from back to front, or from front to back. */
  order(view: View, frontToBack?: boolean): Uint32Array;
  dispose(): void;
  [Symbol.dispose](): void;
}
