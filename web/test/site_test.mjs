// What the pages of the site show in JavaScript, run page by page.
//
//   node site_test.mjs PACKAGE_DIR PAGES_DIR WORK_DIR
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";

const [packageDir, pages, work] = process.argv.slice(2).map(
  (p) => path.resolve(p));
fs.rmSync(work, { recursive: true, force: true });
fs.mkdirSync(path.join(work, "node_modules"), { recursive: true });
fs.symlinkSync(packageDir, path.join(work, "node_modules", "halfspace"));

let count = 0;
for (const name of fs.readdirSync(pages, { recursive: true })) {
  if (!name.endsWith(".md")) continue;
  const text = fs.readFileSync(path.join(pages, name), "utf8");
  const blocks = [...text.matchAll(/^```javascript\n(.*?)^```$/gms)];
  if (!blocks.length) continue;
  const file = path.join(work, `${path.basename(name, ".md")}.mjs`);
  fs.writeFileSync(file, blocks.map((block) => block[1]).join("\n"));
  execFileSync(process.execPath, [file], { cwd: work, stdio: "inherit" });
  count += blocks.length;
}
assert(count > 10, `${count} blocks`);
console.log(`${count} blocks run`);
