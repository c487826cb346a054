// Decodes pictures and maps. Only those of the present frame are kept.

"use strict";

/** What was decoded of the frame on view, by its object in the data. */
let decoded = new Map();

/** How long a stage keeps its former picture while the next one is decoded, in milliseconds. */
const PATIENCE_MS = 200;

/** The decoded form of a picture or map: `{state: "loading" | "ready" | "failed", value}`. */
function decodedOf(source, decode) {
  let entry = decoded.get(source);
  if (!entry) {
    entry = { state: "loading", value: null, since: performance.now() };
    decoded.set(source, entry);
    decode(source).then(
      (value) => Object.assign(entry, { state: "ready", value }),
      () => Object.assign(entry, { state: "failed" }),
    ).then(show);
    setTimeout(show, PATIENCE_MS + 20);
  }
  return entry;
}

async function decodePicture({ src }) {
  const image = new Image();
  image.src = src;
  await image.decode();
  return image;
}

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Decodes the values of a map and paints them, one pixel for each block. */
async function decodeMap({ map, columns, rows, values }) {
  const bytes = await inflated(Uint8Array.from(atob(values), (letter) => letter.charCodeAt(0)));
  if (bytes.length !== columns * rows * 2) throw new Error("the map has another size than it states");
  const halves = new DataView(bytes.buffer);
  const numbers = Float64Array.from({ length: columns * rows }, (_, at) => halfFloat(halves.getUint16(at * 2, true)));
  return { numbers, canvas: paintedMap(numbers, columns, rows, data.maps[map]?.scale) };
}

/** The red, green and blue of six hexadecimal digits. */
const rgb = (hex, at = 0) => [0, 2, 4].map((offset) => parseInt(hex.slice(at + offset, at + offset + 2), 16));

function paintedMap(numbers, columns, rows, scale) {
  const canvas = element("canvas", { width: columns, height: rows });
  const context = canvas.getContext("2d");
  const image = context.createImageData(columns, rows);
  const colours = Array.from({ length: 256 }, (_, at) => rgb(data.palette, at * 6));
  const missing = rgb(data.noValue);
  numbers.forEach((value, at) => {
    const place = scale ? placeOnScale(scale, value) : NaN;
    const colour = Number.isNaN(place) ? missing : colours[Math.round(place * 255)];
    image.data.set([...colour, 255], at * 4);
  });
  context.putImageData(image, 0, 0);
  return canvas;
}

/** The decoded form of a layer. */
function decodedLayer({ picture, map }) {
  return picture ? decodedOf(picture, decodePicture) : decodedOf(map, decodeMap);
}

/** The value of a map in a pixel: NaN if it has none, null while the map is decoded or if it cannot be. */
function valueAt(map, [x, y]) {
  const entry = decodedOf(map, decodeMap);
  if (entry.state !== "ready") return null;
  const column = Math.floor(x / map.block);
  const row = Math.floor(y / map.block);
  if (column >= map.columns || row >= map.rows) return NaN;
  return entry.value.numbers[row * map.columns + column];
}
