// What npm packs: the right files, small enough, of use in an empty project.
//
//   node package_test.mjs PACKAGE_DIR NPM WORK_DIR
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import zlib from "node:zlib";

const [packageDir, npm, work] = process.argv.slice(2).map(
  (p) => path.resolve(p));
fs.rmSync(work, { recursive: true, force: true });
fs.mkdirSync(path.join(work, "project"), { recursive: true });
const run = (program, options, cwd) =>
  execFileSync(program, options, { cwd, encoding: "utf8" });
const offline = ["--offline", "--no-audit", "--no-fund",
  `--cache=${path.join(work, "cache")}`, "--silent"];

const [packed] = JSON.parse(run(npm,
  ["pack", "--json", `--pack-destination=${work}`,
    `--cache=${path.join(work, "cache")}`], packageDir));
assert.deepEqual(packed.files.map((f) => f.path).sort(),
  ["LICENSE", "README.md", "halfspace.d.ts", "halfspace.js", "manifold.d.ts",
    "manifold.js", "package.json"]);
const described = JSON.parse(
  fs.readFileSync(path.join(packageDir, "package.json"), "utf8"));
assert.equal(described.dependencies, undefined);
for (const entry of Object.values(described.exports)) {
  for (const file of typeof entry === "string" ? [entry]
    : Object.values(entry))
    assert.ok(fs.existsSync(path.join(packageDir, file)), file);
}

// The budget: what a page loads, compressed (docs/decisions/0110).
const budget = 552 * 1000;
const size = zlib.gzipSync(
  fs.readFileSync(path.join(packageDir, "halfspace.js")), { level: 9 }).length;
console.log(`halfspace.js: ${size} bytes gzipped, of ${budget}`);
assert.ok(size <= budget, `halfspace.js has ${size} bytes gzipped`);

// Each name of the types is there, and each name there has a type.
const library = await import(path.join(packageDir, "halfspace.js"));
const types = fs.readFileSync(path.join(packageDir, "halfspace.d.ts"), "utf8");
const declared = [...types.matchAll(/^export (?:function|class) (\w+)/gm)]
  .map((m) => m[1]);
assert.deepEqual(Object.keys(library).sort(), declared.sort());
for (const name of ["Solid", "Scene"]) {
  const body = types.slice(types.indexOf(`export class ${name} `));
  const said = new Set([...body.slice(0, body.indexOf("\n}"))
    .matchAll(/^ {2}(?:static |readonly )?(\w+)(?=[(<:])/gm)].map((m) => m[1]));
  const own = [...Object.getOwnPropertyNames(library[name]),
    ...Object.getOwnPropertyNames(library[name].prototype)].filter((n) =>
    !["length", "name", "prototype", "constructor"].includes(n));
  for (const n of own) assert.ok(said.has(n), `${name}.${n} has no type`);
  for (const n of said) {
    assert.ok(n in library[name] || n in library[name].prototype,
      `${name}.${n} is not there`);
  }
}

// A new user: installs it, and runs the README's example.
const project = path.join(work, "project");
fs.writeFileSync(path.join(project, "package.json"),
  '{"name": "tried", "private": true, "type": "module"}');
run(npm, ["install", ...offline, path.join(work, packed.filename)], project);
const readme = fs.readFileSync(path.join(packageDir, "README.md"), "utf8");
const examples = [...readme.matchAll(/```js\n([^]*?)```/g)].map((m) => m[1]);
assert.ok(examples.length >= 3);
examples.forEach((text, k) => {
  fs.writeFileSync(path.join(project, `example-${k}.js`), text);
  const said = run(process.execPath, [`example-${k}.js`], project);
  const expected = [...text.matchAll(/^ *console\.log\(.*\/\/ (.*)$/gm)]
    .map((m) => m[1]);
  assert.deepEqual(said.trim().split("\n").filter((l) => l !== ""), expected,
    `example ${k}`);
});
console.log(`${examples.length} examples run from the installed package`);
