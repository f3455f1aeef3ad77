// Makes the package and the page of the module.
//
//   node build.mjs SOURCE_DIR WASM OUT_DIR
//
// OUT_DIR/package is what npm packs; OUT_DIR/halfspace.html is the page, in one
// file.
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";

const [source, wasm, out] = process.argv.slice(2);
const read = (...names) => fs.readFileSync(path.join(source, ...names), "utf8");
const write = (text, ...names) => {
  const name = path.join(out, ...names);
  fs.mkdirSync(path.dirname(name), { recursive: true });
  fs.writeFileSync(name, text);
};

/** A text with what goes in place of a marker. */
function filled(text, marker, content) {
  const parts = text.split(marker);
  if (parts.length !== 2) throw new Error(`not one ${marker}`);
  return parts.join(content);
}

// LZMA, for it takes 30 % less than what browsers unpack by themselves.
const packed = execFileSync("xz", ["--format=lzma",
  "--lzma1=preset=9e,lc=4,lp=0,pb=0", "--stdout", "--keep", wasm],
{ maxBuffer: 1 << 28 });
const module = filled(filled(read("package", "src", "halfspace.js"),
  "@HALFSPACE_SIZE@", String(fs.statSync(wasm).size)),
'"@HALFSPACE_WASM@"', `"${packed.toString("base64")}"`);
// Comments that have lines of their own, and what lines begin with, stay in the
// sources: pages load none. No string goes on in the next line.
const bare = (text) => text.replace(/^ *\/\*\*[^]*?\*\/\n/gm, "")
  .replace(/^ *\/\/.*\n/gm, "").replace(/^ +/gm, "");
write(bare(module), "package", "halfspace.js");
for (const name of ["halfspace.d.ts", "manifold.js", "manifold.d.ts"])
  write(read("package", "src", name), "package", name);
write(read("package", "package.json"), "package", "package.json");
write(read("README.md"), "package", "README.md");
write(read("..", "LICENSE"), "package", "LICENSE");

// Scripts within the page are text to the HTML parser: no end tag in them.
const inline = (text) => text.replaceAll("</script", "<\\/script");
const page = read("page", "page.html")
  .replace("/* @STYLE@ */", () => read("page", "page.css"))
  .replace("/* @LIBRARY@ */", () => inline(module))
  .replace("/* @WORKER@ */", () => inline(read("page", "worker.js")))
  .replace("/* @PAGE@ */", () => inline(read("page", "page.js")));
write(page, "halfspace.html");
