// The page: files, a camera, and questions to the worker, one picture at a time.

const $ = (id) => document.getElementById(id);
const canvas = $("picture");
const pen = canvas.getContext("2d");

// Questions.

const sourceOf = (id) => $(id).textContent.replaceAll("<\\/script", "</script");
const workerUrl = URL.createObjectURL(new Blob(
  // From file:// workers are no modules. A block of its own: the two may use
  // the same names.
  [sourceOf("library").replace(/^export /gm, ""), "\n{\n", sourceOf("worker"), "\n}\n"], { type: "text/javascript" }));
let worker = null;
let waiting = new Map();
let number = 0;

function start() {
  worker = new Worker(workerUrl);
  worker.onmessage = ({ data }) => {
    if (data.doing !== undefined) return showBusy(data.doing);
    if (data.share !== undefined) return ($("share").value = data.share);
    const question = waiting.get(data.number);
    waiting.delete(data.number);
    if (waiting.size === 0) hideBusy();
    if (data.error) question?.reject(Object.assign(
      new Error(data.error.message), { code: data.error.code }));
    else question?.resolve(data.answer);
  };
  worker.onerror = (event) => {
    event.preventDefault();
    lose(`the worker was lost: ${event.message ?? "no details"}`);
  };
}

/** Begins again with a new worker; what was asked is answered by an error. */
function lose(why) {
  worker?.terminate();
  const lost = waiting;
  waiting = new Map();
  hideBusy();
  start();
  for (const { reject } of lost.values())
    reject(Object.assign(new Error(why), { code: "LOST" }));
}

function ask(question, about = {}) {
  return new Promise((resolve, reject) => {
    waiting.set(++number, { resolve, reject });
    worker.postMessage({ number, question, about });
  });
}

let busyTimer = 0;
function showBusy(doing) {
  $("doing").textContent = doing;
  $("share").removeAttribute("value");
  busyTimer ||= setTimeout(() => { $("busy").hidden = false; }, 250);
}
function hideBusy() {
  clearTimeout(busyTimer);
  busyTimer = 0;
  $("busy").hidden = true;
}
function say(text, isWrong = false) {
  $("said").textContent = text;
  $("said").classList.toggle("wrong", isWrong);
}

// State.

let parts = [];
let numbers = null;  // a file of numbers for a mesh that is there alone
let nextPart = 1;
let box = null;
let camera = { azimuth: 30, elevation: 25, zoom: 1, x: 0, y: 0 };
let fitted = null;  // the view from the camera's direction in which all fits

async function load(next) {
  const before = parts;
  parts = next;
  if (next.length === 0) numbers = null;
  showParts();
  try {
    const answer = await ask("load", { parts, numbers });
    box = answer.box ?? null;
    showSources(answer.sources);
    $("hint").hidden = parts.length > 0;
    say(parts.length ? `${answer.polygons} polygons` : "");
    await ask("section", { section: sectionOf() });
    fitted = null;
    await render();
  } catch (error) {
    say(error.message, true);
    // The parts that were there are shown again.
    if (next.length > before.length || error.code === "LOST") {
      parts = error.code === "LOST" && next === before ? [] : before;
      showParts();
      numbers = null;
      const answer = await ask("load", { parts }).catch(() => null);
      box = answer?.box ?? null;
      showSources(answer?.sources ?? []);
      await render().catch(() => {});
      say(error.message, true);
    }
    throw error;
  }
}

const isNumbers = (name) => /\.(csv|txt|npy)$/i.test(name);

async function open(files) {
  const all = [...files].map((file) => ({
    id: nextPart++, name: file.name, file,
    operation: "show",
  }));
  const added = all.filter((part) => !isNumbers(part.name));
  const found = all.find((part) => isNumbers(part.name));
  if (found) numbers = found;
  await load([...parts, ...added]);
  if (!found) return;
  $("numbers").value = found.name;
  if ($("numbers").value === found.name) return changeColors();
  $("numbers").value = "";
  say(`${found.name}: numbers are shown on one mesh alone`, true);
}

/** Offers what the mesh can be coloured by; it has its own colours again. */
function showSources(sources) {
  $("numbers").replaceChildren(new Option("own colours", ""),
    ...sources.map((name) => new Option(name, name)));
  $("numbers").disabled = sources.length === 0;
  showScale(null);
}
function showScale(scale) {
  $("legend").hidden = scale === null;
  if (scale === null) return;
  const bands = [];
  const count = scale.colors.length / 3;
  for (let k = 0; k < count; ++k) {
    const [r, g, b] = scale.colors.subarray(3 * k, 3 * k + 3);
    bands.push(`rgb(${r} ${g} ${b}) ${100 * k / count}% ` +
      `${100 * (k + 1) / count}%`);
  }
  $("low").textContent = Number(scale.low.toPrecision(6));
  $("high").textContent = Number(scale.high.toPrecision(6));
  $("scale").style.background = `linear-gradient(90deg, ${bands.join()})`;
}
const colorsOf = () => $("numbers").value === "" ? null
  : { source: $("numbers").value, map: $("map").value,
    logarithmic: $("logarithmic").checked };
async function changeColors() {
  try {
    const { scale } = await ask("colors", { colors: colorsOf() });
    showScale(scale);
    say("");
    await render();
  } catch (error) {
    say(error.message, true);
    $("numbers").value = "";
    await ask("colors", { colors: null }).then(render).catch(() => {});
    showScale(null);
    say(error.message, true);
  }
}

const OPERATIONS = { show: "shown", add: "+ union", subtract: "\u2212 difference",
  intersect: "\u2229 intersection", xor: "\u2295 either" };

function showParts() {
  $("parts").replaceChildren(...parts.map((part, k) => {
    const item = document.createElement("li");
    const name = document.createElement("span");
    name.textContent = name.title = part.name;
    const remove = document.createElement("button");
    remove.textContent = "\u00d7";
    remove.title = `Remove ${part.name}`;
    remove.onclick = () => load(parts.filter((p) => p !== part)).catch(() => {});
    item.append(name);
    if (k > 0) {
      const choose = document.createElement("select");
      choose.title = "What it does to those above it";
      for (const [value, text] of Object.entries(OPERATIONS))
        choose.add(new Option(text, value, false, value === part.operation));
      choose.onchange = () => load(parts.map((p) => p === part
        ? { ...p, operation: choose.value } : p)).catch(() => {});
      item.append(choose);
    }
    item.append(remove);
    return item;
  }));
}

function sectionOf() {
  const axis = $("axis").value;
  $("at").disabled = axis === "";
  if (axis === "" || box === null) return null;
  const share = $("at").value / 1000;
  const k = Number(axis);
  const at = Number((box.low[k] + share * (box.high[k] - box.low[k]))
    .toPrecision(6));
  // So that the cut is seen in the view that comes first.
  const sign = $("flip").checked === (k === 1) ? 1 : -1;
  const normal = [0, 0, 0];
  normal[k] = sign;
  return { normal, offset: sign * at };
}

// The camera.

function sizeOf() {
  const ratio = Math.min(devicePixelRatio || 1, 2);
  return { width: Math.max(1, Math.round(canvas.clientWidth * ratio)),
    height: Math.max(1, Math.round(canvas.clientHeight * ratio)) };
}

/** The view as it is now: numbers of few digits, so that commands are short. */
async function viewOf() {
  const { width, height } = sizeOf();
  const orthographic = $("orthographic").checked;
  const key = [camera.azimuth, camera.elevation, width, height, orthographic];
  if (fitted?.key.join() !== key.join()) {
    fitted = { key, view: await ask("view", { azimuth: camera.azimuth,
      elevation: camera.elevation, width, height, orthographic }) };
  }
  const { eye, target, up, fov, orthoHeight } = fitted.view;
  const ahead = eye.map((c, k) => (c - target[k]) / camera.zoom);
  const tall = orthographic ? orthoHeight / camera.zoom
    : 2 * Math.hypot(...ahead) * Math.tan(fov * Math.PI / 360);
  const right = unit(cross(up, ahead));
  const upwards = unit(cross(ahead, right));
  const round = (v) => Number(v.toPrecision(9));
  const middle = target.map((c, k) => round(c +
    tall * (camera.y * upwards[k] - camera.x * right[k])));
  return { eye: middle.map((c, k) => round(c + ahead[k])), target: middle,
    up: up.map(round), fov: round(fov), orthographic,
    orthoHeight: round(tall), width, height,
    samples: $("smooth").checked ? 4 : 1 };
}
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0]];
const unit = (v) => v.map((c) => c / Math.hypot(...v));

let rendering = null;
let again = false;

/** Draws the picture; what comes meanwhile is drawn once, after it. */
function render() {
  if (rendering) {
    again = true;
    return rendering;
  }
  rendering = (async () => {
    do {
      again = false;
      if (parts.length === 0) {
        pen.clearRect(0, 0, canvas.width, canvas.height);
        break;
      }
      const view = await viewOf();
      const picture = await ask("render", view);
      canvas.width = picture.width;
      canvas.height = picture.height;
      pen.putImageData(
        new ImageData(picture.rgba, picture.width, picture.height), 0, 0);
      showCommand(view);
    } while (again);
  })().finally(() => { rendering = null; });
  return rendering;
}
const tryRender = () => render().catch((error) => say(error.message, true));

/** What the program is told for the same figure. */
function showCommand(view) {
  const SIGNS = { show: "|", add: "|", subtract: "-", intersect: "&", xor: "^" };
  const quoted = (name) => `'${name.replaceAll("'", "'\\''")}'`;
  const list = (v) => v.join(",");
  const section = sectionOf();
  const cameraWords = `--size ${view.width}x${view.height} ` +
    `--eye ${list(view.eye)} --target ${list(view.target)} ` +
    `--up ${list(view.up)} ` +
    (view.orthographic ? `--ortho --height ${view.orthoHeight}`
      : `--fov ${view.fov}`);
  const isSolid = section || parts.some((p) => p.operation !== "show");
  let lines = "";
  let files = parts.map((p) => quoted(p.name)).join(" ");
  if (isSolid) {
    let script = parts.reduce((text, p, k) => k === 0 ? "p1"
      : `(${text} ${SIGNS[p.operation]} p${k + 1})`, "");
    if (section) {
      const axis = "xyz"[section.normal.findIndex((c) => c !== 0)];
      const isLess = section.normal.some((c) => c > 0);
      script += ` & half(${axis} ${isLess ? "<" : ">"} ` +
        `${isLess ? section.offset : -section.offset})`;
    }
    const named = parts.map((p, k) => `p${k + 1}=${quoted(p.name)}`).join(" ");
    lines += `halfspace csg ${quoted(script)} ${named} -o result.obj\n`;
    files = "result.obj";
  }
  const lineOptions = { none: "none", edges: "edges",
    "hidden-dashed": "edges --hidden dashed" }[$("lines").value];
  lines += `halfspace draw ${files} -o figure.svg ` +
    `${cameraWords} --fill ${$("fill").value} --lines ${lineOptions}`;
  const colors = colorsOf();
  if (colors) {
    lines += `\nhalfspace render ${quoted(parts[0].name)} -o picture.png ` +
      `${cameraWords} --scalar ${quoted(colors.source)} --map ${colors.map}` +
      (colors.logarithmic ? " --log" : "") +
      (view.samples > 1 ? ` --aa ${view.samples}` : "");
    if (section) {
      lines += ` --clip ${list([...section.normal.map((c) => -c),
        section.offset])} --cap 200,80,40`;
    }
  }
  $("command").textContent = lines;
}

// Saving.

function drawOptions() {
  return { fill: $("fill").value, lines: $("lines").value };
}
async function saved(format) {
  if (format === "png") {
    await render();
    const blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
    return new Uint8Array(await blob.arrayBuffer());
  }
  if (format === "svg")
    return ask("draw", { view: await viewOf(), options: drawOptions() });
  return ask("save", { format });
}
async function download(format) {
  if (parts.length === 0) return say("there is nothing to save", true);
  try {
    const bytes = await saved(format);
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([bytes]));
    link.download = `halfspace.${format}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    say(`halfspace.${format}: ${bytes.length} bytes`);
  } catch (error) {
    say(error.message, true);
  }
}

// Hands.

const pointers = new Map();
canvas.onpointerdown = (event) => {
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, event);
};
canvas.onpointermove = (event) => {
  const before = pointers.get(event.pointerId);
  if (!before) return;
  const dx = event.clientX - before.clientX;
  const dy = event.clientY - before.clientY;
  if (pointers.size === 2) {
    const [other] = [...pointers.values()].filter(
      (p) => p.pointerId !== event.pointerId);
    const span = (p) => Math.hypot(p.clientX - other.clientX,
      p.clientY - other.clientY);
    zoomBy(span(event) / Math.max(1, span(before)));
    shiftBy(dx / 2, dy / 2);
  } else if (event.shiftKey || event.buttons === 4 || event.buttons === 2) {
    shiftBy(dx, dy);
  } else {
    turnBy(dx, dy);
  }
  pointers.set(event.pointerId, event);
  tryRender();
};
canvas.onpointerup = canvas.onpointercancel = (event) => {
  pointers.delete(event.pointerId);
};
canvas.oncontextmenu = (event) => event.preventDefault();
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  zoomBy(Math.exp(-event.deltaY / 500));
  tryRender();
}, { passive: false });
canvas.onkeydown = (event) => {
  const steps = { ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20],
    ArrowDown: [0, 20] }[event.key];
  if (event.key === "+") zoomBy(1.25);
  else if (event.key === "-") zoomBy(0.8);
  else if (steps) turnBy(...steps);
  else return;
  event.preventDefault();
  tryRender();
};
function turnBy(dx, dy) {
  camera.azimuth = Number((camera.azimuth - dx * 0.5).toFixed(2));
  camera.elevation = Number(Math.max(-89, Math.min(89,
    camera.elevation + dy * 0.5)).toFixed(2));
}
function zoomBy(factor) {
  camera.zoom = Math.max(0.05, Math.min(200, camera.zoom * factor));
}
function shiftBy(dx, dy) {
  camera.x += dx / canvas.clientHeight;
  camera.y += dy / canvas.clientHeight;
}

$("views").onclick = ({ target }) => {
  if (!target.dataset.azimuth) return;
  camera = { azimuth: Number(target.dataset.azimuth),
    elevation: Number(target.dataset.elevation), zoom: 1, x: 0, y: 0 };
  tryRender();
};
for (const id of ["orthographic", "smooth", "fill", "lines"])
  $(id).onchange = () => tryRender();
for (const id of ["numbers", "map", "logarithmic"])
  $(id).onchange = () => changeColors();
async function changeSection() {
  await ask("section", { section: sectionOf() });
  await render();
}
for (const id of ["axis", "flip", "at"]) {
  $(id).oninput = () =>
    changeSection().catch((error) => say(error.message, true));
}
$("saves").onclick = ({ target }) => {
  if (target.dataset.save) download(target.dataset.save);
};
$("files").onchange = ({ target }) => {
  open(target.files).catch(() => {});
  target.value = "";
};
$("cancel").onclick = () => lose("cancelled");
const stage = document.body;
stage.ondragover = (event) => {
  event.preventDefault();
  $("stage").classList.add("over");
};
stage.ondragleave = () => $("stage").classList.remove("over");
stage.ondrop = (event) => {
  event.preventDefault();
  $("stage").classList.remove("over");
  open(event.dataTransfer.files).catch(() => {});
};
new ResizeObserver(() => tryRender()).observe(canvas);

start();

/** For scripts, and for tests. */
window.halfspacePage = {
  open, load, render, saved, ask, lose, changeSection, changeColors, viewOf,
  get parts() { return parts; },
  get camera() { return camera; },
  set camera(value) { camera = value; },
  get worker() { return worker; },
};
