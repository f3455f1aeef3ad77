// Writes triangles as an SVG by three.js's SVGRenderer, which sorts them by
// depth.
//
//   node peer_three.mjs TRIANGLES OUT.svg      (run where `three` is installed)
//
// TRIANGLES as peer_gl2ps.cpp has them. Prints seconds of processor time.
import fs from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";
import {pathToFileURL} from "node:url";

// The part of a document that the renderer asks for.
class Node {
  constructor(name) {
    this.name = name;
    this.attributes = {};
    this.childNodes = [];
    this.style = {};
  }
  setAttribute(name, value) { this.attributes[name] = value; }
  appendChild(node) { this.childNodes.push(node); }
  removeChild(node) { this.childNodes.splice(this.childNodes.indexOf(node), 1); }
  text() {
    const words = Object.entries(this.attributes)
                      .map(([name, value]) => ` ${name}="${value}"`).join("");
    return `<${this.name}${words}>` +
        this.childNodes.map((node) => node.text() + "\n").join("") +
        `</${this.name}>`;
  }
}
globalThis.document = {createElementNS: (space, name) => new Node(name)};

const require = createRequire(pathToFileURL(process.cwd() + "/"));
const three = path.dirname(path.dirname(require.resolve("three")));
const THREE = await import(pathToFileURL(three + "/build/three.module.js"));
const {SVGRenderer} = await import(
    pathToFileURL(three + "/examples/jsm/renderers/SVGRenderer.js"));

const SIDE = 1000;
const groups = new Map();
for (const line of fs.readFileSync(process.argv[2], "utf8").split("\n")) {
  const numbers = line.split(" ").map(Number);
  if (numbers.length < 13) continue;
  const look = numbers.slice(9).join(",");
  if (!groups.has(look)) groups.set(look, []);
  for (let k = 0; k < 9; k += 3)
    groups.get(look).push(numbers[k], SIDE - numbers[k + 1], numbers[k + 2]);
}
const begin = process.cpuUsage();
const scene = new THREE.Scene();
for (const [look, points] of groups) {
  const [red, green, blue, closed] = look.split(",");
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position",
                        new THREE.Float32BufferAttribute(points, 3));
  scene.add(new THREE.Mesh(geometry, new THREE.MeshBasicMaterial(
      {color: new THREE.Color(`rgb(${red},${green},${blue})`),
       side: closed === "1" ? THREE.FrontSide : THREE.DoubleSide})));
}
const camera = new THREE.OrthographicCamera(0, SIDE, SIDE, 0, 1, 5000);
camera.position.z = 2500;
const renderer = new SVGRenderer();
renderer.setSize(SIDE, SIDE);
renderer.render(scene, camera);
const used = process.cpuUsage(begin);
const svg = renderer.domElement;
svg.setAttribute("xmlns", "http://www.w3.org/2000/svg");
fs.writeFileSync(process.argv[3], svg.text());
console.log(((used.user + used.system) / 1e6).toFixed(3));
