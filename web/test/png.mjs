// The pixels of a PNG of 8 bits a channel, not interlaced, as RGB.
import assert from "node:assert/strict";
import zlib from "node:zlib";

export function pixelsOf(png) {
  const data = [];
  let width = 0, height = 0, channels = 0;
  for (let at = 8; at < png.length;) {
    const size = png.readUInt32BE(at);
    const kind = png.toString("latin1", at + 4, at + 8);
    const body = png.subarray(at + 8, at + 8 + size);
    if (kind === "IHDR") {
      [width, height] = [body.readUInt32BE(0), body.readUInt32BE(4)];
      channels = { 2: 3, 6: 4 }[body[9]];
      assert.ok(body[8] === 8 && channels && body[12] === 0, "an unusual PNG");
    }
    if (kind === "IDAT") data.push(body);
    at += size + 12;
  }
  const raw = zlib.inflateSync(Buffer.concat(data));
  const row = width * channels;
  const out = new Uint8Array(height * row);
  const rgb = new Uint8Array(height * width * 3);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (row + 1)];
    for (let x = 0; x < row; ++x) {
      const at = y * row + x;
      const a = x >= channels ? out[at - channels] : 0;
      const b = y > 0 ? out[at - row] : 0;
      const c = x >= channels && y > 0 ? out[at - row - channels] : 0;
      const [da, db, dc] = [b - c, a - c, a + b - 2 * c].map(Math.abs);
      const paeth = da <= db && da <= dc ? a : db <= dc ? b : c;
      out[at] = raw[y * (row + 1) + 1 + x] +
        [0, a, b, (a + b) >> 1, paeth][filter];
    }
  }
  for (let k = 0; k < width * height; ++k)
    for (let i = 0; i < 3; ++i) rgb[3 * k + i] = out[k * channels + i];
  return { width, height, rgb };
}

/** A mesh of a wave as PLY, whose vertices have a property `heat`. */
export function heatedWave(n = 24) {
  const vertices = [], faces = [];
  for (let j = 0; j <= n; ++j) {
    for (let i = 0; i <= n; ++i) {
      const z = Math.round(100 * Math.sin(i / 4) * Math.cos(j / 5)) / 100;
      vertices.push(`${i / 4} ${j / 4} ${z} ${i === 3 && j === 3 ? "nan" : i * j}`);
      if (i === n || j === n) continue;
      const v = j * (n + 1) + i;
      faces.push(`3 ${v} ${v + 1} ${v + n + 2}`, `3 ${v} ${v + n + 2} ${v + n + 1}`);
    }
  }
  return ["ply", "format ascii 1.0", `element vertex ${vertices.length}`,
    "property double x", "property double y", "property double z",
    "property double heat", `element face ${faces.length}`,
    "property list uchar int vertex_indices", "end_header",
    ...vertices, ...faces, ""].join("\n");
}
