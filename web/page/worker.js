// The worker of the page, after the library in one module: it computes, and the
// page stays free. A state is a list of parts with operations, and a section.

const most = 1 << 30;
const bytesOf = new Map();  // by number of the part
let state = { parts: [], section: null, numbers: null, colors: null };
let made = null;            // what the state comes to

function say(doing) {
  postMessage({ doing });
}
function progress(share) {
  postMessage({ share });
}

const formatOf = (name) => {
  const found = /\.(stl|obj|ply|off|hsolid)(\.gz)?$/i.exec(name);
  if (found) return found[1].toLowerCase();
  throw new Error(`${name}: a mesh file ends in .stl, .obj, .ply or .off`);
};

const tooLarge = (name, what) => new Error(`${name}: ${what}, and the page ` +
  "takes 1 GiB; use the program `halfspace` for it");

/** The bytes of a gzipped file, as long as they are not too many. */
async function unpacked({ name, file }) {
  const chunks = [];
  let bytes = 0;
  const stream = file.stream().pipeThrough(new DecompressionStream("gzip"));
  const reader = stream.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return new Blob(chunks);
    bytes += value.byteLength;
    if (bytes > most) {
      await reader.cancel();
      throw tooLarge(name, "unpacks to more than 1 GiB");
    }
    chunks.push(value);
  }
}

async function read(part) {
  if (bytesOf.has(part.id)) return;
  const { file } = part;
  if (file.size > most) {
    throw tooLarge(part.name, `has ${(file.size / 2 ** 30).toFixed(1)} GiB`);
  }
  say(`reading ${part.name}`);
  const body = /\.gz$/i.test(part.name) ? await unpacked(part) : file;
  bytesOf.set(part.id, new Uint8Array(await body.arrayBuffer()));
}

const isBoolean = (parts) => parts.some((p) => p.operation !== "show");
const OPERATIONS =
  { add: "add", subtract: "subtract", intersect: "intersect", xor: "xor" };

/** What all parts come to: one solid, if an operation asks for that. */
function solidOf({ parts }) {
  const solids = parts.map((p) => Solid.fromFile(bytesOf.get(p.id),
    formatOf(p.name),
    // As the program reads its operands, so that the bytes are the same.
    { name: p.name.replace(/\.\w+(\.gz)?$/, ""), mergeCoplanar: false,
      mayRound: true }));
  return solids.reduce((all, solid, k) =>
    all[OPERATIONS[parts[k].operation] ?? "add"](solid));
}

function dispose() {
  for (const object of Object.values(made ?? {})) object?.dispose?.();
  made = null;
}

const fileOf = (part) => ({ bytes: bytesOf.get(part.id),
  format: formatOf(part.name), name: part.name.replace(/\.\w+(\.gz)?$/, "") });

/** By what a mesh that is there alone can be coloured: its properties, and the
 *  file of numbers beside it. */
function sourcesOf({ parts, numbers }) {
  if (parts.length !== 1) return [];
  const own = formatOf(parts[0].name) === "ply"
    ? Scene.scalarNames(bytesOf.get(parts[0].id)) : [];
  return numbers ? [...own, numbers.name] : own;
}

/** A scene coloured by numbers, and its scale. */
function coloredScene({ parts, numbers, colors }) {
  const [, name, format] = /^(.*)\.(\w+)$/.exec(numbers?.name ?? "") ?? [];
  const source = colors.source === numbers?.name
    ? { bytes: bytesOf.get(numbers.id), format, name } : colors.source;
  return Scene.byScalars(fileOf(parts[0]), source, { ...colors, progress });
}

/** The scene, and the solid where there is one; made when it is asked for. */
function scene() {
  if (made?.scene) return made.scene;
  made ??= {};
  if (state.colors) {
    say("building the scene");
    made.scene = coloredScene(state);
    return made.scene;
  }
  if (isBoolean(state.parts)) {
    say("working the solid out");
    made.solid ??= solidOf(state).evaluate({ progress });
    say("building the scene");
    made.scene = Scene.of(made.solid, { progress });
  } else {
    say("building the scene");
    made.scene = Scene.ofFiles(state.parts.map(fileOf), { progress });
  }
  return made.scene;
}

/** The solid that is saved: with what the section leaves of it. */
function cutSolid() {
  made ??= {};
  made.solid ??= solidOf(state).evaluate({ progress });
  const { section } = state;
  if (!section) return made.solid;
  made.cut?.dispose();
  made.cut = made.solid.intersect(
    Solid.halfSpace(section.normal, section.offset));
  return made.cut;
}

function clipped(view) {
  const { section } = state;
  if (!section) return view;
  const clips = [[...section.normal.map((c) => -c), section.offset]];
  return { ...view, clips, caps: [200, 80, 40] };
}

const questions = {
  async load({ parts, numbers = null }) {
    dispose();
    const files = numbers ? [...parts, numbers] : parts;
    const kept = new Set(files.map((p) => p.id));
    for (const id of [...bytesOf.keys()]) if (!kept.has(id)) bytesOf.delete(id);
    state = { ...state, parts, numbers, colors: null };
    for (const file of files) await read(file);
    if (parts.length === 0) return { polygons: 0, sources: [] };
    const shown = scene();
    const view = shown.view({ width: 100, height: 100 });
    const box = boxOf();
    return { polygons: shown.polygonCount, view, box,
      sources: sourcesOf(state) };
  },
  /** Colours by numbers, or by what the mesh has itself: the scale, if any. */
  colors({ colors }) {
    const before = made?.scene;
    const next = { ...state, colors };
    let scale = null;
    let shown = null;
    if (colors) {
      say("building the scene");
      shown = coloredScene(next);
      scale = shown.colorBy(colors);
    }
    before?.dispose();
    state = next;
    made = { ...made, scene: shown };
    return { scale };
  },
  section({ section }) {
    state = { ...state, section };
    return {};
  },
  view(view) {
    return scene().view(view);
  },
  render(view) {
    const shown = scene();
    say("drawing the picture");
    let picture;
    try {
      picture = shown.render(clipped(view));
    } catch (error) {
      // What is no solid is cut open.
      if (error.code !== "OPEN") throw error;
      picture = shown.render({ ...clipped(view), caps: undefined });
    }
    return picture;
  },
  draw({ view, options }) {
    say("drawing the figure");
    if (!state.section && !state.colors) return scene().draw(view, options);
    // Figures show what the mesh has itself.
    const cut = state.section ? Scene.of(cutSolid())
      : Scene.ofFiles(state.parts.map(fileOf));
    try {
      return cut.draw(view, options);
    } finally {
      cut.dispose();
    }
  },
  save({ format }) {
    say(`writing ${format.toUpperCase()}`);
    return cutSolid().save(format, { progress });
  },
  measure() {
    const solid = cutSolid();
    return { volume: solid.volume(), exact: String(solid.exactVolume()) };
  },
  pick({ view, x, y }) {
    return scene().pick(clipped(view), x, y);
  },
};

/** The box round what is shown, by the fragments of its tree. */
function boxOf() {
  const { positions } = made.scene.fragments();
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < positions.length; ++k) {
    const c = positions[k];
    if (c < low[k % 3]) low[k % 3] = c;
    if (c > high[k % 3]) high[k % 3] = c;
  }
  return { low, high };
}

const started = init();
let last = started;
onmessage = ({ data: { number, question, about } }) => {
  last = last.catch(() => {}).then(async () => {
    try {
      await started;
      const answer = await questions[question](about);
      const moved = answer?.rgba
        ? [answer.rgba.buffer, answer.ids.buffer] : [];
      postMessage({ number, answer }, moved);
    } catch (error) {
      postMessage({ number, error: {
        code: error.code ?? "", message: error.message } });
      if (error.code === "BROKEN") {
        bytesOf.clear();
        made = null;
        await reset();
      }
    }
  });
};
