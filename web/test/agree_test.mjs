// The loops of WebAssembly give the pictures that the native ones give.
//
//   node agree_test.mjs AGREE_WASM AGREE_PROGRAM
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import { WASI } from "node:wasi";

const [wasm, program] = process.argv.slice(2);
const file = "agree_wasm.txt";
const out = fs.openSync(file, "w");
const wasi = new WASI({ version: "preview1", args: ["agree"], stdout: out,
  returnOnExit: true });
const module = await WebAssembly.compile(fs.readFileSync(wasm));
const instance = await WebAssembly.instantiate(module,
  { wasi_snapshot_preview1: wasi.wasiImport });
const status = wasi.start(instance);
fs.closeSync(out);
const lines = fs.readFileSync(file, "utf8").trim().split("\n");
const native = execFileSync(program, { encoding: "utf8" }).trim().split("\n");
assert.ok(native.length >= 90, `only ${native.length} pictures`);
assert.deepEqual(lines, native);
assert.equal(status ?? 0, 0);
console.log(`${lines.length} pictures are the same`);
