// Exact solids, exact pictures. Types and documentation: halfspace.d.ts.
//
// The one module of the package: everything that computes is WebAssembly, which
// stands compressed at the end of this file. Handles of solids and scenes are
// addresses there; a FinalizationRegistry gives them back.

/** What a question failed with. */
export class HalfspaceError extends Error {
  constructor(code, words, message, index = -1) {
    super(message);
    this.name = "HalfspaceError";
    this.code = code;
    this.words = words;
    this.index = index;
  }
}

// By number: ErrorCode of the library (spec/include/halfspace/result.hpp).
const CODES = [
  "UNREADABLE", "UNWRITABLE", "UNKNOWN_FORMAT", "SYNTAX", "TRUNCATED",
  "NOT_FINITE", "OUT_OF_RANGE", "BAD_INDEX", "TOO_FEW_VERTICES",
  "REPEATED_VERTEX", "ZERO_AREA", "NOT_PLANAR", "NOT_CONVEX", "NOT_TRIANGLE",
  "BAD_CAMERA", "BAD_RAY", "OPEN", "SELF_CROSSING", "INSIDE_OUT", "UNBOUNDED",
  "EMPTY", "STOPPED",
];

let core = null;  // the exports of the module
let pending = null;
let generation = 0;  // of the module: handles of an earlier one name nothing
let progress = null;
let progressError = null;

const encoder = new TextEncoder();
const decoder = new TextDecoder();

/** What the module's C library asks of a system: it has nothing there. */
function system() {
  const data = () => new DataView(core.memory.buffer);
  const lacks = () => 52;  // ENOSYS
  const known = {
    fd_write(fd, list, count, written) {
      let total = 0;
      let text = "";
      for (let k = 0; k < count; ++k) {
        const at = data().getUint32(list + 8 * k, true);
        const size = data().getUint32(list + 8 * k + 4, true);
        text += decoder.decode(new Uint8Array(core.memory.buffer, at, size));
        total += size;
      }
      data().setUint32(written, total, true);
      if (text.trim() !== "") console.error(text.trimEnd());
      return 0;
    },
    environ_sizes_get(count, size) {
      data().setUint32(count, 0, true);
      data().setUint32(size, 0, true);
      return 0;
    },
    environ_get: () => 0,
    clock_time_get(_id, _precision, at) {
      data().setBigUint64(at, BigInt(Date.now()) * 1000000n, true);
      return 0;
    },
    proc_exit(code) {
      throw new WebAssembly.RuntimeError(`the module ended with ${code}`);
    },
  };
  return new Proxy(known, {
    get: (target, name) => target[name] ?? lacks,
    has: () => true,
  });
}

function imports(module) {
  const wasi = system();
  const given = { halfspace: {}, wasi_snapshot_preview1: {} };
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    given[from] ??= {};
    given[from][name] = from === "halfspace" ? reported : wasi[name];
  }
  return given;
}

function reported(share) {
  if (progress === null) return 1;
  try {
    return progress(share) === false ? 0 : 1;
  } catch (error) {
    progressError = error;
    return 0;
  }
}

function begin(instance) {
  core = instance.exports;
  ++generation;
  core._initialize?.();
}

/** The bits of an LZMA stream, each with its probability (I. Pavlov's format
 *  of `xz --format=lzma`). */
class BitReader {
  constructor(bytes, at) {
    this.bytes = bytes;
    this.at = at + 1;
    this.range = 0xffffffff;
    this.code = 0;
    for (let k = 0; k < 4; ++k) this.shift();
  }
  shift() {
    this.code = ((this.code << 8) | this.bytes[this.at++]) >>> 0;
  }
  bit(chances, k) {
    if (this.range < 0x1000000) {
      this.range = (this.range << 8) >>> 0;
      this.shift();
    }
    const chance = chances[k];
    const bound = (this.range >>> 11) * chance;
    if (this.code < bound) {
      this.range = bound;
      chances[k] += (2048 - chance) >> 5;
      return 0;
    }
    this.range -= bound;
    this.code -= bound;
    chances[k] -= chance >> 5;
    return 1;
  }
  /** Bits that are as likely 0 as 1. */
  plain(count) {
    let value = 0;
    for (; count > 0; --count) {
      if (this.range < 0x1000000) {
        this.range = (this.range << 8) >>> 0;
        this.shift();
      }
      this.range >>>= 1;
      const one = this.code >= this.range;
      if (one) this.code -= this.range;
      value = value * 2 + (one ? 1 : 0);
    }
    return value;
  }
  /** A number by a tree of chances from `base` on, highest bit first. */
  tree(chances, base, bits) {
    let node = 1;
    for (let k = 0; k < bits; ++k)
      node = node * 2 + this.bit(chances, base + node);
    return node - (1 << bits);
  }
  /** The same, lowest bit first. */
  reversed(chances, base, bits) {
    let node = 1;
    let value = 0;
    for (let k = 0; k < bits; ++k) {
      const one = this.bit(chances, base + node);
      node = node * 2 + one;
      value |= one << k;
    }
    return value;
  }
}

/** Unpacks `size` bytes of an LZMA stream. */
function unpacked(bytes, size) {
  const lc = bytes[0] % 9;
  const lp = Math.floor(bytes[0] / 9) % 5;
  const pb = Math.floor(bytes[0] / 45);
  const reader = new BitReader(bytes, 13);
  const chances = (count) => new Uint16Array(count).fill(1024);
  const literal = chances(0x300 << (lc + lp));
  const isMatch = chances(12 << 4);
  const isRepeat = chances(12);
  const isRepeat1 = chances(12);
  const isRepeat2 = chances(12);
  const isRepeat3 = chances(12);
  const isLongRepeat = chances(12 << 4);
  const slots = chances(4 << 6);
  const special = chances(115);
  const aligned = chances(16);
  const lengths = () => ({ choice: chances(2), low: chances(16 << 3),
    middle: chances(16 << 3), high: chances(256) });
  const matchLengths = lengths();
  const repeatLengths = lengths();
  const lengthBy = (from, place) => {
    if (reader.bit(from.choice, 0) === 0)
      return reader.tree(from.low, place << 3, 3);
    if (reader.bit(from.choice, 1) === 0)
      return 8 + reader.tree(from.middle, place << 3, 3);
    return 16 + reader.tree(from.high, 0, 8);
  };
  const out = new Uint8Array(size);
  const last = [0, 0, 0, 0];  // distances, less 1
  let state = 0;
  let at = 0;
  while (at < size) {
    const place = at & ((1 << pb) - 1);
    if (reader.bit(isMatch, (state << 4) + place) === 0) {
      const before = at > 0 ? out[at - 1] : 0;
      const base = 0x300 *
        (((at & ((1 << lp) - 1)) << lc) + (before >> (8 - lc)));
      let symbol = 1;
      if (state >= 7) {
        let match = out[at - last[0] - 1];
        do {
          const expected = (match >> 7) & 1;
          match <<= 1;
          const one = reader.bit(literal,
            base + ((1 + expected) << 8) + symbol);
          symbol = (symbol << 1) | one;
          if (expected !== one) break;
        } while (symbol < 0x100);
      }
      while (symbol < 0x100)
        symbol = (symbol << 1) | reader.bit(literal, base + symbol);
      out[at++] = symbol & 0xff;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let length;
    if (reader.bit(isRepeat, state) !== 0) {
      if (reader.bit(isRepeat1, state) === 0) {
        if (reader.bit(isLongRepeat, (state << 4) + place) === 0) {
          state = state < 7 ? 9 : 11;
          out[at] = out[at - last[0] - 1];
          ++at;
          continue;
        }
      } else {
        let which = 1;
        if (reader.bit(isRepeat2, state) !== 0)
          which = 2 + reader.bit(isRepeat3, state);
        last.unshift(...last.splice(which, 1));
      }
      length = lengthBy(repeatLengths, place);
      state = state < 7 ? 8 : 11;
    } else {
      length = lengthBy(matchLengths, place);
      state = state < 7 ? 7 : 10;
      const slot = reader.tree(slots, Math.min(length, 3) << 6, 6);
      let distance = slot;
      if (slot >= 4) {
        const bits = (slot >> 1) - 1;
        distance = (2 | (slot & 1)) * 2 ** bits;
        distance += slot < 14
          ? reader.reversed(special, distance - slot, bits)
          : reader.plain(bits - 4) * 16 + reader.reversed(aligned, 0, 4);
      }
      last.unshift(distance);
      last.pop();
    }
    for (length += 2; length > 0 && at < size; --length, ++at)
      out[at] = out[at - last[0] - 1];
  }
  return out;
}

function inlined() {
  return unpacked(Uint8Array.from(atob(INLINED), (c) => c.charCodeAt(0)),
    INLINED_SIZE);
}

/**
 * Makes the library ready. Await it once, before anything else; further calls
 * return at once.
 */
export async function init(options = {}) {
  if (core !== null) return;
  pending ??= (async () => {
    let source = options.wasm ?? inlined();
    if (typeof source === "string" || source instanceof URL)
      source = await fetch(source);
    if (typeof Response !== "undefined" && source instanceof Response)
      source = await source.arrayBuffer();
    const module = source instanceof WebAssembly.Module
      ? source : await WebAssembly.compile(source);
    begin(await WebAssembly.instantiate(module, imports(module)));
    compiled = module;
  })().catch((error) => {
    pending = null;
    throw error;
  });
  await pending;
}
let compiled = null;

/** The compiled module, which `init({ wasm })` takes in a worker. */
export function wasmModule() {
  ready();
  return compiled;
}

/** A fresh module, after one that broke: all that was made before is gone. */
export async function reset() {
  if (compiled === null) return init();
  broken = null;
  begin(await WebAssembly.instantiate(compiled, imports(compiled)));
}

let broken = null;

function ready() {
  if (broken !== null)
    throw new HalfspaceError("BROKEN", "module broken", broken);
  if (core !== null) return core;
  throw new HalfspaceError("NOT_READY", "library not ready",
    "await init() before anything else");
}

/** Calls a function of the module. */
function call(name, ...parameters) {
  const c = ready();
  try {
    return c[name](...parameters);
  } catch (error) {
    if (!(error instanceof WebAssembly.RuntimeError)) throw error;
    broken = "the WebAssembly module stopped, most likely for lack of memory " +
      `(${error.message}); await reset() and begin again`;
    throw new HalfspaceError("BROKEN", "module broken", broken);
  }
}

function text(pointer, size) {
  return decoder.decode(
    new Uint8Array(core.memory.buffer, pointer >>> 0, size >>> 0));
}
const answerText = () => text(core.hs_bytes(), core.hs_byte_count());
const answerBytes = () => new Uint8Array(core.memory.buffer,
  core.hs_bytes() >>> 0, core.hs_byte_count() >>> 0).slice();
const answerNumbers = () => new Float64Array(core.memory.buffer,
  core.hs_numbers() >>> 0, core.hs_number_count() >>> 0).slice();
const answerIntegers = () => new Int32Array(core.memory.buffer,
  core.hs_integers() >>> 0, core.hs_integer_count() >>> 0).slice();

/** Calls a function that asks. Throws: HalfspaceError. */
function ask(name, ...parameters) {
  const status = call(name, ...parameters);
  if (progressError !== null) {
    const error = progressError;
    progressError = null;
    throw error;
  }
  if (status === 0) return;
  core.hs_error();
  const message = answerText();
  const index = answerNumbers()[0];
  core.hs_code_words(status - 1);
  throw new HalfspaceError(CODES[status - 1] ?? "UNKNOWN", answerText(),
    message, index);
}

/** Calls `use` with addresses of copies of arrays, strings or null. */
function withCopies(values, use) {
  ready();
  const copies = values.map((value) => {
    if (value === null || value === undefined) return { at: 0, size: 0 };
    const array = typeof value === "string" ? encoder.encode(value) : value;
    const bytes = new Uint8Array(array.buffer, array.byteOffset,
      array.byteLength);
    const at = call("hs_alloc", Math.max(8, bytes.length)) >>> 0;
    if (at === 0) {
      throw new HalfspaceError("OUT_OF_MEMORY", "out of memory",
        `there is no memory for ${bytes.length} bytes`);
    }
    new Uint8Array(core.memory.buffer, at, bytes.length).set(bytes);
    return { at, size: bytes.length };
  });
  try {
    return use(...copies);
  } finally {
    if (broken === null) for (const { at } of copies) if (at) core.hs_free(at);
  }
}

function putFile(name, bytes) {
  withCopies([name, bytes], (n, b) =>
    call("hs_put_file", n.at, n.size, b.at, b.size));
}
function takeFile(name) {
  return withCopies([name], (n) => {
    if (call("hs_take_file", n.at, n.size) === 0) return null;
    const bytes = answerBytes();
    core.hs_forget();
    return bytes;
  });
}

function withProgress(callback, work) {
  const before = progress;
  progress = callback ?? null;
  try {
    return work();
  } finally {
    progress = before;
  }
}

// Lifetimes.

const DISPOSE = Symbol.dispose ?? Symbol.for("Symbol.dispose");

const registry = new FinalizationRegistry((held) => held.free());

/** A handle of the module, and how it is given back. */
class Held {
  constructor(pointer, freer) {
    this.pointer = pointer;
    this.freer = freer;
    this.generation = generation;
  }
  get at() {
    if (this.pointer === 0) {
      throw new HalfspaceError("DISPOSED", "object disposed",
        "it was disposed of; make a new one");
    }
    if (this.generation !== generation) {
      throw new HalfspaceError("BROKEN", "module broken",
        "it was made before reset(); make it again");
    }
    return this.pointer;
  }
  free() {
    if (this.pointer !== 0 && this.generation === generation &&
        broken === null) core[this.freer](this.pointer);
    this.pointer = 0;
  }
}

let scopeList = null;

/** Memory of the module that no garbage collector sees: makes it look sooner
 *  when the module grew. */
let seenBytes = 0;
function weigh() {
  const bytes = core.memory.buffer.byteLength;
  if (bytes <= seenBytes) return;
  if (seenBytes > 0) new ArrayBuffer(bytes - seenBytes);
  seenBytes = bytes;
}

class Owner {
  #held;
  constructor(pointer, freer) {
    this.#held = new Held(pointer, freer);
    registry.register(this, this.#held, this.#held);
    scopeList?.push(this);
    weigh();
  }
  get _at() {
    return this.#held.at;
  }
  dispose() {
    registry.unregister(this.#held);
    this.#held.free();
  }
  [DISPOSE]() {
    this.dispose();
  }
}

/**
 * Calls `work` and disposes of all that was made meanwhile, but for what it
 * returns (one object, or an array of such).
 */
export function scope(work) {
  const outer = scopeList;
  const own = scopeList = [];
  let kept = new Set();
  try {
    const result = work();
    kept = new Set([result].flat());
    return result;
  } finally {
    scopeList = outer;
    for (const object of own) {
      if (!kept.has(object)) object.dispose();
      else outer?.push(object);
    }
  }
}

// Numbers.

/** A rational number: numerator and denominator, without common factors. */
export class Rational {
  constructor(numerator, denominator, text) {
    this.numerator = numerator;
    this.denominator = denominator;
    this.text = text;
  }
  static parse(text) {
    const [top, bottom] = text.split("/");
    const [whole, places = ""] = top.split(".");
    let n = BigInt(whole + places);
    let d = BigInt(bottom ?? 1) * 10n ** BigInt(places.length);
    const gcd = (a, b) => {
      while (b) [a, b] = [b, a % b];
      return a < 0n ? -a : a;
    };
    const g = gcd(n, d) || 1n;
    n /= g;
    d /= g;
    return new Rational(n, d, text);
  }
  toString() {
    return this.text;
  }
  valueOf() {
    return Number(this.numerator) / Number(this.denominator);
  }
}

function triple(v, name) {
  if (v && v.length === 3) {
    const [x, y, z] = v;
    return [Number(x), Number(y), Number(z)];
  }
  throw new TypeError(`${name} is not three numbers`);
}
function factors(v) {
  return typeof v === "number" ? [v, v, v] : triple(v, "factor");
}
function floats(v, name, each) {
  const array = v instanceof Float64Array ? v
    : ArrayBuffer.isView(v) ? Float64Array.from(v)
      : Float64Array.from(v.flat(Infinity));
  if (array.length % each !== 0)
    throw new TypeError(`${name} has no multiple of ${each} numbers`);
  return array;
}
function integers(v) {
  return v instanceof Int32Array ? v
    : ArrayBuffer.isView(v) ? Int32Array.from(v)
      : Int32Array.from(v.flat(Infinity));
}
function formatName(format) {
  const name = String(format).toLowerCase().replace(/^\./, "");
  return `.${name}`;
}
const MERGES = { origin: 0, plane: 1, none: 2 };
function mergeOf(options) {
  const merge = MERGES[options.merge ?? "origin"];
  if (merge === undefined)
    throw new TypeError("merge is 'origin', 'plane' or 'none'");
  return merge;
}
function flagsOf(options) {
  return (options.resolve ? 1 : 0) | (options.mergeCoplanar === false ? 2 : 0) |
    (options.mayRound ? 4 : 0);
}

/** The surface of a solid, in arrays of its own. */
export class Mesh {
  constructor(parts) {
    Object.assign(this, parts);
  }
  get vertexCount() {
    return this.vertices.length / 3;
  }
  get polygonCount() {
    return this.firstCorner.length - 1;
  }
}

/** A solid: a value that is an expression of others. */
export class Solid extends Owner {
  constructor(pointer) {
    super(pointer ?? call("hs_empty"), "hs_free_solid");
  }
  static #of(name, ...parameters) {
    return new Solid(call(name, ...parameters));
  }

  static empty() {
    return new Solid();
  }
  static box(corner, opposite) {
    return Solid.#of("hs_box", ...triple(corner, "corner"),
      ...triple(opposite, "opposite"));
  }
  static sphere(radius, segments = 32) {
    return Solid.#of("hs_sphere", radius, segments);
  }
  static cylinder(radius, height, segments = 32) {
    return Solid.#of("hs_cone", radius, radius, height, segments);
  }
  static cone(bottomRadius, topRadius, height, segments = 32) {
    return Solid.#of("hs_cone", bottomRadius, topRadius, height, segments);
  }
  static torus(radius, tubeRadius, segments = 48, tubeSegments = 24) {
    return Solid.#of("hs_torus", radius, tubeRadius, segments, tubeSegments);
  }
  static prism(outline, height, holes = []) {
    const loops = [outline, ...holes].map((l) => floats(l, "outline", 2));
    const all = new Float64Array(loops.reduce((n, l) => n + l.length, 0));
    let at = 0;
    for (const loop of loops) {
      all.set(loop, at);
      at += loop.length;
    }
    const sizes = Int32Array.from(loops, (l) => l.length / 2);
    return withCopies([all, sizes], (a, s) =>
      Solid.#of("hs_prism", a.at, s.at, sizes.length, height));
  }
  static revolution(outline, segments = 32) {
    const points = floats(outline, "outline", 2);
    return withCopies([points], (p) =>
      Solid.#of("hs_revolution", p.at, points.length / 2, segments));
  }
  static hull(points) {
    const array = floats(points, "points", 3);
    return withCopies([array], (p) =>
      Solid.#of("hs_hull", p.at, array.length / 3));
  }
  static halfSpace(normal, offset) {
    return Solid.#of("hs_half_space", ...triple(normal, "normal"), offset);
  }
  static fromMesh(mesh, options = {}) {
    const vertices = floats(mesh.vertices, "vertices", 3);
    const corners = integers(mesh.triangles ?? mesh.corners);
    const first = mesh.firstCorner
      ? Uint32Array.from(mesh.firstCorner) : null;
    if (first ? first.at(-1) !== corners.length : corners.length % 3 !== 0)
      throw new TypeError("the mesh's corners do not make up its polygons");
    const count = first ? first.length - 1 : corners.length / 3;
    const materials = mesh.materials ? integers(mesh.materials) : null;
    if (materials && materials.length !== count)
      throw new TypeError("materials are not one a polygon");
    return withCopies([vertices, first, corners, materials],
      (v, f, c, m) => Solid.#of("hs_from_mesh", v.at, vertices.length / 3,
        f.at, count, c.at, m.at, flagsOf(options)));
  }
  static fromFile(bytes, format, options = {}) {
    const name = (options.name ?? "file") + formatName(format);
    putFile(name, new Uint8Array(bytes.buffer ?? bytes, bytes.byteOffset ?? 0,
      bytes.byteLength));
    try {
      return withCopies([name], (n) => {
        const solid = Solid.#of("hs_from_file", n.at, n.size,
          flagsOf(options));
        // It is read when it is needed: now, for the file goes.
        ask("hs_rounding", solid._at);
        return solid;
      });
    } finally {
      takeFile(name);
    }
  }
  /** A mesh file whose surface is no solid's, mended. */
  static mended(bytes, format, options = {}) {
    const name = (options.name ?? "file") + formatName(format);
    putFile(name, new Uint8Array(bytes.buffer ?? bytes, bytes.byteOffset ?? 0,
      bytes.byteLength));
    try {
      return withCopies([name], (n) => {
        ask("hs_mended", n.at, n.size, options.weld ?? -1,
          options.thicken ?? 0);
        const done = answerText().split("\n").filter((line) => line !== "");
        return { solid: new Solid(answerIntegers()[0]), done };
      });
    } finally {
      takeFile(name);
    }
  }
  static fromText(script) {
    return withCopies([script], (s) =>
      Solid.#of("hs_from_text", s.at, s.size));
  }
  static #all(intersects, solids) {
    const list = [...solids];
    const handles = Int32Array.from(list, (s) => s._at);
    return withCopies([handles], (h) =>
      Solid.#of("hs_combine_all", intersects, h.at, list.length));
  }
  static union(solids) {
    return Solid.#all(0, solids);
  }
  static intersection(solids) {
    return Solid.#all(1, solids);
  }

  add(other) {
    return Solid.#of("hs_combine", 0, this._at, other._at);
  }
  subtract(other) {
    return Solid.#of("hs_combine", 1, this._at, other._at);
  }
  intersect(other) {
    return Solid.#of("hs_combine", 2, this._at, other._at);
  }
  xor(other) {
    return Solid.#of("hs_combine", 3, this._at, other._at);
  }
  complement() {
    return Solid.#of("hs_complement", this._at);
  }
  translate(by) {
    return Solid.#of("hs_translated", this._at, ...triple(by, "by"));
  }
  scale(by) {
    return Solid.#of("hs_scaled", this._at, ...factors(by));
  }
  rotate(axis, degrees) {
    return Solid.#of("hs_rotated", this._at, ...triple(axis, "axis"), degrees);
  }
  mirror(normal, offset = 0) {
    return Solid.#of("hs_mirrored", this._at, ...triple(normal, "normal"),
      offset);
  }
  transform(rows) {
    const numbers = floats(rows, "rows", 4);
    if (numbers.length !== 12)
      throw new TypeError("a transformation is three rows of four numbers");
    return withCopies([numbers], (r) =>
      Solid.#of("hs_transformed", this._at, r.at));
  }
  split(normal, offset) {
    call("hs_split", this._at, ...triple(normal, "normal"), offset);
    const [negative, positive] = answerIntegers();
    return { negative: new Solid(negative), positive: new Solid(positive) };
  }
  named(name) {
    return withCopies([String(name)], (n) =>
      Solid.#of("hs_named", this._at, n.at, n.size));
  }
  get name() {
    call("hs_name", this._at);
    return answerText();
  }

  evaluate(options = {}) {
    withProgress(options.progress, () => ask("hs_evaluate", this._at));
    weigh();
    return this;
  }
  #number(name) {
    ask(name, this._at);
    weigh();
    return answerNumbers()[0];
  }
  volume() {
    return this.#number("hs_volume");
  }
  area() {
    return this.#number("hs_area");
  }
  exactVolume() {
    ask("hs_exact_volume", this._at);
    return Rational.parse(answerText());
  }
  exactArea() {
    ask("hs_exact_area", this._at);
    const found = answerText();
    return found === "" ? null : Rational.parse(found);
  }
  bounds() {
    ask("hs_bounds", this._at);
    const n = [...answerNumbers()];
    return { low: n.slice(0, 3), high: n.slice(3) };
  }
  centroid() {
    ask("hs_centroid", this._at);
    return [...answerNumbers()];
  }
  inertia() {
    ask("hs_inertia", this._at);
    const n = [...answerNumbers()];
    return [n.slice(0, 3), n.slice(3, 6), n.slice(6)];
  }
  genus() {
    return this.#number("hs_genus");
  }
  shellCount() {
    return this.#number("hs_shell_count");
  }
  isEmpty() {
    return this.#number("hs_is_empty") === 1;
  }
  rounding() {
    ask("hs_rounding", this._at);
    const [moved, maxMove, step, gridBits] = answerNumbers();
    return { moved, maxMove, step, gridBits };
  }
  locate(point) {
    ask("hs_locate", this._at, ...triple(point, "point"));
    return ["inside", "on", "outside"][answerNumbers()[0] + 1];
  }
  #relation(which, other) {
    ask("hs_relation", which, this._at, other._at);
    return answerNumbers()[0] === 1;
  }
  overlaps(other) {
    return this.#relation(0, other);
  }
  touches(other) {
    return this.#relation(1, other);
  }
  contains(other) {
    return this.#relation(2, other);
  }
  decompose() {
    ask("hs_decompose", this._at);
    return Array.from(answerIntegers(), (at) => new Solid(at));
  }
  operands() {
    ask("hs_operands", this._at);
    return Array.from(answerIntegers(), (at) => new Solid(at));
  }
  section(normal, offset) {
    ask("hs_section", this._at, ...triple(normal, "normal"), offset);
    const counts = answerIntegers();
    const points = answerNumbers();
    const regions = [];
    let at = 0;
    for (let k = 0; k < counts.length;) {
      const loops = [];
      for (let l = counts[k++]; l > 0; --l) {
        const size = 3 * counts[k++];
        loops.push(points.slice(at, at + size));
        at += size;
      }
      regions.push({ boundary: loops[0], holes: loops.slice(1) });
    }
    return regions;
  }
  mesh(options = {}) {
    withProgress(options.progress, () => ask("hs_mesh", this._at,
      mergeOf(options), options.triangles === false ? 0 : 1));
    const at = answerIntegers()[0];
    call("hs_mesh_arrays", at);
    const places = answerIntegers();
    const array = (k, Type) => new Type(core.memory.buffer,
      places[2 * k] >>> 0, places[2 * k + 1]).slice();
    const mesh = new Mesh({
      vertices: array(0, Float64Array),
      firstCorner: array(1, Uint32Array),
      corners: array(2, Int32Array),
      materials: array(3, Int32Array),
      origins: array(4, Int32Array),
      colors: array(5, Uint8Array),
    });
    call("hs_free_mesh", at);
    weigh();
    return mesh;
  }
  /** The bytes of a file: stl, obj, ply, off or hsolid. */
  save(format, options = {}) {
    const name = "saved" + formatName(format);
    withCopies([name], (n) => withProgress(options.progress, () =>
      ask("hs_save", this._at, n.at, n.size, mergeOf(options),
        options.triangles ? 1 : 0)));
    return takeFile(name);
  }
}

// Scenes.

function viewNumbers(view) {
  const clips = view.clips ?? [];
  const cap = view.caps === "hatch" ? [2]
    : view.caps ? [1, ...triple(view.caps, "caps")] : [0];
  const alpha = view.alpha ?? 255;
  if (!Number.isInteger(alpha) || alpha < 0 || alpha > 255)
    throw new TypeError("alpha is a whole number from 0 to 255");
  return Float64Array.from([
    ...triple(view.eye, "eye"), ...triple(view.target, "target"),
    ...triple(view.up ?? [0, 0, 1], "up"), view.fov ?? 40,
    view.orthographic ? 1 : 0, view.orthoHeight ?? 2, view.near ?? NaN,
    view.width ?? 640, view.height ?? 480, view.cull ? 1 : 0,
    ...triple(view.background ?? [255, 255, 255], "background"),
    clips.length, ...clips.flat(), ...cap, view.capsBySolid ? 1 : 0,
    ...(view.backColor ? [1, ...triple(view.backColor, "backColor")] : [0]),
    alpha,
  ]);
}

const LINES = { none: 0, regions: 1, edges: 2, "hidden-dashed": 3 };

const viewOfBytes = (bytes) => new Uint8Array(bytes.buffer ?? bytes,
  bytes.byteOffset ?? 0, bytes.byteLength);

/** Solids or meshes to look at. */
export class Scene extends Owner {
  #names;
  constructor(pointer, names) {
    super(pointer, "hs_free_scene");
    this.#names = names;
  }

  /** A scene of solids. */
  static of(solids, options = {}) {
    const list = solids instanceof Solid ? [solids] : [...solids];
    const names = list.map((s, k) => `solid-${k}.obj`);
    return withProgress(options.progress, () => {
      list.forEach((solid, k) => withCopies([names[k]], (n) =>
        ask("hs_save", solid._at, n.at, n.size, 0, 0)));
      return Scene.#load(names);
    });
  }
  /** A scene of mesh files: what the program's `render` and `draw` show. */
  static ofFiles(files, options = {}) {
    const list = [...files];
    const names = list.map((f, k) =>
      (f.name ?? `file-${k}`) + formatName(f.format));
    list.forEach((f, k) => putFile(names[k], new Uint8Array(
      f.bytes.buffer ?? f.bytes, f.bytes.byteOffset ?? 0,
      f.bytes.byteLength)));
    return withProgress(options.progress, () => Scene.#load(names));
  }
  static #load(names) {
    try {
      return withCopies([names.join("\n")], (n) => {
        ask("hs_scene", n.at, n.size);
        return new Scene(answerIntegers()[0], names);
      });
    } finally {
      if (broken === null) for (const name of names) takeFile(name);
    }
  }

  /** A mesh file coloured by numbers: a property of a PLY, or another file. */
  static byScalars(file, source, options = {}) {
    const name = (file.name ?? "file") + formatName(file.format);
    const from = typeof source === "string" ? source
      : (source.name ?? "numbers") + formatName(source.format);
    putFile(name, viewOfBytes(file.bytes));
    if (from !== source) putFile(from, viewOfBytes(source.bytes));
    try {
      return withCopies([name, from], (n, f) =>
        withProgress(options.progress, () => {
          ask("hs_scene_by_scalars", n.at, n.size, f.at, f.size);
          const scene = new Scene(answerIntegers()[0], [name]);
          scene.colorBy(options);
          return scene;
        }));
    } finally {
      if (broken === null) {
        takeFile(name);
        if (from !== source) takeFile(from);
      }
    }
  }
  /** The properties of a PLY file by which byScalars() colours it. */
  static scalarNames(bytes) {
    const name = "file.ply";
    putFile(name, viewOfBytes(bytes));
    try {
      return withCopies([name], (n) => {
        call("hs_scalar_names", n.at, n.size);
        return answerText().split("\n").filter((line) => line !== "");
      });
    } finally {
      if (broken === null) takeFile(name);
    }
  }
  /** Chooses the colours of a scene by numbers; gives the scale. */
  colorBy(style = {}) {
    return withCopies([style.map ?? "viridis"], (m) => {
      ask("hs_scene_colors", this._at, m.at, m.size, style.low ?? NaN,
        style.high ?? NaN, style.logarithmic ? 1 : 0, style.steps ?? 0,
        style.clamp === false ? 0 : 1);
      const [low, high] = answerNumbers();
      return { low, high, colors: answerBytes() };
    });
  }

  get polygonCount() {
    return call("hs_scene_polygons", this._at);
  }
  /** By polygon the solid or file that it is of. */
  sources() {
    call("hs_scene_files", this._at);
    return answerIntegers();
  }
  /** What is not said of a view, so that all is seen from a direction. */
  view(partial = {}) {
    const view = { width: 640, height: 480, ...partial };
    let direction = partial.direction ?? [0.45, -0.78, 0.42];
    let up = partial.up ?? [0, 0, 1];
    if (partial.azimuth !== undefined || partial.elevation !== undefined) {
      const a = (partial.azimuth ?? 0) * Math.PI / 180;
      const e = (partial.elevation ?? 0) * Math.PI / 180;
      direction = [Math.cos(e) * Math.sin(a), -Math.cos(e) * Math.cos(a),
        Math.sin(e)];
      if (Math.abs(partial.elevation ?? 0) >= 90)
        up = [-Math.sign(e) * Math.sin(a), Math.sign(e) * Math.cos(a), 0];
    }
    if (!partial.eye || !partial.target) {
      ask("hs_scene_view", this._at, ...triple(direction, "direction"),
        ...triple(up, "up"), view.width, view.height,
        view.orthographic ? 1 : 0);
      const n = [...answerNumbers()];
      view.eye ??= n.slice(0, 3);
      view.target ??= n.slice(3, 6);
      view.up ??= n.slice(6, 9);
      view.fov ??= n[9];
      view.orthoHeight ??= n[10];
    }
    view.up ??= up;
    return view;
  }
  #complete(view) {
    return view.eye && view.target ? view : this.view(view);
  }

  /** The picture: by pixel its polygon, and its colours. */
  render(view = {}, options = {}) {
    const numbers = viewNumbers(this.#complete(view));
    withCopies([numbers], (v) => withProgress(options.progress, () =>
      ask("hs_scene_render", this._at, v.at, view.samples ?? 1)));
    const [idsAt, idColumns, idRows, colorsAt, width, height] =
      answerIntegers();
    const ids = new Int32Array(core.memory.buffer, idsAt >>> 0,
      idColumns * idRows).slice();
    const rgba = new Uint8ClampedArray(core.memory.buffer, colorsAt >>> 0,
      4 * width * height).slice();
    return { width, height, ids, rgba };
  }
  /** What is seen at a pixel, or null. */
  pick(view, x, y) {
    const numbers = viewNumbers(this.#complete(view));
    withCopies([numbers], (v) => ask("hs_scene_pick", this._at, v.at, x, y));
    const [polygon, source, px, py, pz, distance] = answerNumbers();
    if (polygon < 0) return null;
    if (source < 0) return { polygon, source, point: null, distance: null };
    return { polygon, source, point: [px, py, pz], distance };
  }
  /** A figure of vectors as bytes; svg unless another format is said. */
  draw(view = {}, options = {}) {
    const lines = LINES[options.lines ?? "none"];
    if (lines === undefined)
      throw new TypeError(`lines is one of ${Object.keys(LINES)}`);
    const fill = options.fill ?? "colour";
    const numbers = viewNumbers(this.#complete(view));
    return withCopies(
      [numbers, formatName(options.format ?? "svg"),
        fill === "none" ? "" : fill],
      (v, e, b) => withProgress(options.progress, () => {
        ask("hs_scene_draw", this._at, v.at, e.at, e.size, b.at, b.size, lines,
          options.crease ?? 20, options.lineWidth ?? 1,
          options.decimals ?? 3);
        const bytes = answerBytes();
        core.hs_forget();
        return bytes;
      }));
  }
  /** The same as text. */
  svg(view = {}, options = {}) {
    return decoder.decode(this.draw(view, { ...options, format: "svg" }));
  }

  /** The parts of polygons as vertices, the same for every eye. */
  fragments() {
    ask("hs_scene_fragments", this._at);
    const bytes = answerBytes();
    const polygons = answerIntegers();
    core.hs_forget();
    return { positions: new Float32Array(bytes.buffer), polygons };
  }
  /** Indices of their triangles, in an order in which none is hidden by one
   *  before it (or after it). Requires: fragments() was called. */
  order(view, frontToBack = false) {
    const numbers = viewNumbers(this.#complete(view));
    withCopies([numbers], (v) =>
      ask("hs_scene_order", this._at, v.at, frontToBack ? 1 : 0));
    return new Uint32Array(answerIntegers().buffer);
  }
}

/** The library's version. */
export function version() {
  call("hs_version");
  return answerText();
}
/** How much memory the module has. Units: bytes. */
export function memoryBytes() {
  return ready().memory.buffer.byteLength;
}

const INLINED_SIZE = @HALFSPACE_SIZE@;
const INLINED = "@HALFSPACE_WASM@";
