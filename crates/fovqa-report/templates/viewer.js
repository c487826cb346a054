// The viewer of report.html: reference, methods and maps of a frame on the same stage.
//
// Its data are the JSON in #viewer-data. All text reaches the page as text, never as HTML, so names
// may contain any character. Positions are in pixels of the full frame: (0, 0) is the top-left corner
// of the first pixel, whose centre is at (0.5, 0.5).

"use strict";
(() => {
  // ---------------------------------------------------------------- Elements

  const SVG = "http://www.w3.org/2000/svg";

  /** The element with the id `viewer-NAME`. */
  const byId = (name) => document.getElementById(`viewer-${name}`);

  /** Makes an HTML element with properties and children. */
  function element(tag, properties = {}, ...children) {
    const node = Object.assign(document.createElement(tag), properties);
    node.append(...children);
    return node;
  }

  /** Makes an SVG element with attributes and text. */
  function svgElement(tag, attributes = {}, text = "") {
    const node = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
    node.textContent = text;
    return node;
  }

  /** Fills a select with options `{value, text, group}`; `group` may be absent. */
  function fillSelect(select, options, value) {
    select.replaceChildren();
    const groups = new Map();
    for (const { value, text, group } of options) {
      if (group && !groups.has(group)) {
        groups.set(group, element("optgroup", { label: group }));
        select.append(groups.get(group));
      }
      (groups.get(group) ?? select).append(element("option", { value, textContent: text }));
    }
    select.value = value;
    select.disabled = options.length < 2;
  }

  // ---------------------------------------------------------------- Numbers

  const clamp = (value, least, most) => Math.min(Math.max(value, least), most);

  /** A score of the data as a number; a missing one is NaN. */
  function number(score) {
    if (score === "inf") return Infinity;
    if (score === "-inf") return -Infinity;
    return typeof score === "number" ? score : NaN;
  }

  /** A number with the digits of its metric. */
  function formatted(value, digits) {
    if (Number.isNaN(value)) return "–";
    if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
    const text = digits === undefined || digits === null ? String(Number(value.toPrecision(4))) : value.toFixed(digits);
    return text.replace(/^-/, "−");
  }

  /** A number with at most four significant digits. */
  const formattedValue = (value) => formatted(value, undefined);

  /** A value of a map with four significant digits, zeros at its end included, so that columns line up. */
  const formattedBlock = (value) => (Number.isFinite(value) ? value.toPrecision(4).replace("-", "−") : formattedValue(value));

  /** The number that 16 bits of an IEEE half float stand for. */
  function halfFloat(bits) {
    const sign = bits & 0x8000 ? -1 : 1;
    const exponent = (bits >> 10) & 31;
    const fraction = bits & 1023;
    if (exponent === 31) return fraction ? NaN : sign * Infinity;
    if (exponent === 0) return sign * fraction * 2 ** -24;
    return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
  }

  /** The eccentricity in degrees of a point, by the same formulas as the scores. */
  function eccentricityDeg(view, gaze, x, y) {
    const [fx, fy] = view.focal_px;
    let radians;
    if (view.eccentricity === "planar") {
      radians = Math.atan2(Math.hypot(x - gaze[0], y - gaze[1]), Math.sqrt(fx * fy));
    } else {
      // The cross product is of the difference of the rays, so that it is exact near the gaze.
      const [cx, cy] = view.principal_px;
      const [gx, gy] = [(gaze[0] - cx) / fx, (gaze[1] - cy) / fy];
      const [rx, ry] = [(x - cx) / fx, (y - cy) / fy];
      const [dx, dy] = [(x - gaze[0]) / fx, (y - gaze[1]) / fy];
      radians = Math.atan2(Math.hypot(dx, dy, dx * gy - dy * gx), 1 + rx * gx + ry * gy);
    }
    return (radians * 180) / Math.PI;
  }

  /** The index of the half-open band with this eccentricity, or -1. */
  function bandIndex(edges, degrees) {
    for (let band = 0; band + 1 < edges.length; band++) {
      if (degrees >= edges[band] && degrees < edges[band + 1]) return band;
    }
    return -1;
  }

  /** Where a value lies on a scale: 0 is `none`, 1 is `most`; NaN has no place. */
  function placeOnScale(scale, value) {
    const along = scale.kind === "log" ? Math.log10 : (number) => number;
    const [none, most] = [along(scale.none), along(scale.most)];
    return clamp((along(value) - none) / (most - none), 0, 1);
  }

  /** The value in the middle of a scale. */
  function middleOfScale({ kind, none, most }) {
    return kind === "log" ? Math.sqrt(none * most) : (none + most) / 2;
  }

  /** Steps of 1, 2 or 5 times a power of ten: the multiples between two numbers, about `count`. */
  function ticks(from, to, count, least = 0) {
    const rough = (to - from) / count;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = Math.max(least, power * [1, 2, 5, 10].find((factor) => factor * power >= rough));
    const first = Math.ceil(from / step - 1e-9);
    const last = Math.floor(to / step + 1e-9);
    return Array.from({ length: Math.max(0, last - first + 1) }, (_, at) => (first + at) * step);
  }

  // ---------------------------------------------------------------- State

  const data = { scenes: [], maps: {}, metrics: {}, palette: "", noValue: "" };
  const page = {};

  /** What is chosen. Layers are named by their keys (see `layersOf`). */
  const state = {
    scene: 0,
    eye: 0,
    /** Index among the frames with pictures. */
    frame: 0,
    /** Number of the chosen frame, which may have no pictures. */
    number: 0,
    mode: "slider",
    a: "reference",
    b: "reference",
    method: 0,
    map: "",
    flickerShowsB: false,
    /** Share of the visible frame that is left of the divider. */
    split: 0.5,
    /** 1 shows the whole frame. */
    zoom: 1,
    /** The point of the frame in the centre of the stage. */
    centre: [0, 0],
    /** The stage under the mouse, and the mouse's place in the window: the pixel there changes with zoom and pan. */
    hover: null,
    /** The pixel of the crosshair. */
    cross: null,
    /** Methods whose line of the curve is hidden. */
    hiddenLines: new Set(),
    /** Whether layers were chosen before, which the next frame keeps. */
    wasChosen: false,
  };

  const chosenEye = () => data.scenes[state.scene].eyes[state.eye];
  const chosenFrame = () => chosenEye().frames[state.frame];
  const testOf = (method) => chosenFrame()?.tests.find((test) => test.method === method);
  const mapOf = (method, kind) => testOf(method)?.maps.find((map) => map.map === kind);
  const methodName = (method) => chosenEye().methods[method] ?? `method ${method}`;
  const mapLabel = (kind) => data.maps[kind]?.label ?? kind;
  const metricLabel = (metric) => data.metrics[metric]?.label ?? metric;

  /** The gaze of the frame on view. Without one it is the principal point, as for all metrics. */
  function gazeOnView() {
    return chosenFrame()?.gaze_px ?? chosenEye().view?.principal_px ?? null;
  }

  /** The pixel that the readout describes. */
  const pointOnView = () => (state.hover ? pixelAt(state.hover.stage, ...placeOn(state.hover.stage, state.hover)) : state.cross);

  /**
   * The layers of the frame on view, by key: `reference`, `method:INDEX` and `map:INDEX:MAP`.
   * `picture` or `map` is what it shows.
   */
  function layersOf(frame) {
    const layers = new Map();
    if (!frame) return layers;
    if (frame.reference) layers.set("reference", { text: "Reference", group: "Pictures", picture: frame.reference });
    for (const test of frame.tests) {
      const { method } = test;
      layers.set(`method:${method}`, { text: methodName(method), group: "Pictures", method, picture: test });
    }
    for (const { method, maps } of frame.tests) {
      for (const map of maps) {
        const text = `${methodName(method)}: ${mapLabel(map.map)} map`;
        layers.set(`map:${method}:${map.map}`, { text, group: "Maps", method, map });
      }
    }
    return layers;
  }

  /** The kinds of map that the frame on view has, in the order of the data. */
  function mapKinds() {
    const kinds = new Set((chosenFrame()?.tests ?? []).flatMap((test) => test.maps.map(({ map }) => map)));
    return [...kinds];
  }

  /** The metrics that have a value in any frame of the eye, in the order of the data. */
  function metricsOf(eye) {
    const used = new Set(Object.keys(eye.sequence?.metrics ?? {}));
    for (const test of eye.frames.flatMap((frame) => frame.tests)) {
      for (const scores of [test.scores, ...test.bands]) Object.keys(scores).forEach((key) => used.add(key));
    }
    return Object.keys(data.metrics).filter((metric) => used.has(metric));
  }

  // ---------------------------------------------------------------- Decoding

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

  // ---------------------------------------------------------------- Geometry of a stage

  /** Screen pixels per pixel of the frame at the largest zoom. */
  const MOST_SCALE = 48;

  /**
   * The whole frame is drawn at this share of the possible size or more, for the sake of whole pixels.
   * It is larger on dense screens, where uneven pixels are less visible.
   */
  const leastShare = () => 1 - 0.3 / density();

  const density = () => window.devicePixelRatio || 1;

  /** The width in pixels of the reduced pictures; a guess before the first one is decoded. */
  function pictureWidth() {
    const { width, height } = chosenEye();
    const picture = [...decoded.values()].find(({ value }) => value instanceof Image);
    return picture?.value.naturalWidth ?? Math.round(width * Math.min(1, 512 / Math.max(width, height)));
  }

  /**
   * The scale at which the whole frame fits into a stage. Where that is not much smaller, each pixel
   * of the picture is a whole number of device pixels: otherwise some pixels would look larger than others.
   */
  function fittingScale(stageWidth, stageHeight) {
    const { width, height } = chosenEye();
    const exact = Math.min(stageWidth / width, stageHeight / height);
    const enlarged = (exact * density() * width) / pictureWidth();
    // The picture's sides are rounded, so that its pixels are not quite squares: a little less than a whole is whole.
    const whole = Math.floor(enlarged + 0.004);
    return whole >= 1 && whole / enlarged > leastShare() ? (exact * whole) / enlarged : exact;
  }

  /** Size of a stage, its scale (screen pixels per pixel of the frame) and the place of the frame's corner. */
  function geometryOf(stage) {
    const { clientWidth: width, clientHeight: height } = stage.canvas;
    const scale = fittingScale(width, height) * state.zoom;
    const eye = chosenEye();
    const origin = [width / 2 - state.centre[0] * scale, height / 2 - state.centre[1] * scale];
    const onDevice = (at) => Math.round(at * density()) / density();
    const [left, top] = origin.map(onDevice);
    const right = left + onDevice(eye.width * scale);
    const bottom = top + onDevice(eye.height * scale);
    return { width, height, scale, left, top, right, bottom };
  }

  /** The point of the frame at a point of a stage. */
  function frameAt({ left, top, scale }, x, y) {
    return [(x - left) / scale, (y - top) / scale];
  }

  /** The point of a stage at a place in the window, such as that of an event. */
  function placeOn({ canvas }, { clientX, clientY }) {
    const { left, top } = canvas.getBoundingClientRect();
    return [clientX - left, clientY - top];
  }

  /** The pixel of the frame at a point of a stage, or null beside the frame. */
  function pixelAt(stage, x, y) {
    const [column, row] = frameAt(geometryOf(stage), x, y).map(Math.floor);
    const { width, height } = chosenEye();
    return column >= 0 && row >= 0 && column < width && row < height ? [column, row] : null;
  }

  /** Keeps the zoom in its range, and the frame on the stage. */
  function keepInSight() {
    const eye = chosenEye();
    const { clientWidth, clientHeight } = page.stages[0].canvas;
    // The stage has no size while the page hides it.
    if (clientWidth === 0) return;
    const fitting = fittingScale(clientWidth, clientHeight);
    state.zoom = clamp(state.zoom, 1, Math.max(1, MOST_SCALE / fitting));
    const scale = fitting * state.zoom;
    state.centre = [[eye.width, clientWidth], [eye.height, clientHeight]].map(([frame, screen], axis) => {
      const half = screen / scale / 2;
      return half * 2 >= frame ? frame / 2 : clamp(state.centre[axis], half, frame - half);
    });
    for (const { canvas } of page.stages) {
      // A finger scrolls the page as long as there is nothing to move on the stage.
      canvas.style.touchAction = state.zoom > 1 ? "none" : "pan-y";
    }
  }

  /** Zooms by a factor; the point of the frame at (x, y) of the stage stays there. */
  function zoomBy(factor, stage = page.stages[0], x = stage.canvas.clientWidth / 2, y = stage.canvas.clientHeight / 2) {
    const before = frameAt(geometryOf(stage), x, y);
    const former = state.zoom;
    state.zoom *= factor;
    keepInSight();
    const after = frameAt(geometryOf(stage), x, y);
    if (state.zoom !== former) state.centre = state.centre.map((at, axis) => at + before[axis] - after[axis]);
    keepInSight();
    show();
  }

  /** Moves the picture by screen pixels. */
  function panBy(dx, dy) {
    const { scale } = geometryOf(page.stages[0]);
    state.centre = [state.centre[0] - dx / scale, state.centre[1] - dy / scale];
    keepInSight();
    show();
  }

  function showWholeFrame() {
    const { width, height } = chosenEye();
    state.zoom = 1;
    state.centre = [width / 2, height / 2];
    keepInSight();
    show();
  }

  // ---------------------------------------------------------------- Drawing

  /** The layers on each visible stage, with the part of the stage's width that each covers, in screen pixels. */
  function partsOf(stage) {
    const layer = (key) => page.layers.get(key);
    const whole = (key) => [{ layer: layer(key), ...WHOLE }];
    if (state.mode === "side") return whole(stage.sideKey());
    if (state.mode === "flicker") return whole(state.flickerShowsB ? state.b : state.a);
    const at = dividerAt(geometryOf(stage));
    return [
      { layer: layer(state.a), from: -Infinity, to: at },
      { layer: layer(state.b), from: at, to: Infinity },
    ];
  }

  /** The divider's place on the stage in screen pixels: a share of the visible width of the frame. */
  function dividerAt({ left, right, width }) {
    const from = Math.max(0, left);
    const at = from + state.split * (Math.min(width, right) - from);
    return Math.round(at * density()) / density();
  }

  let scheduled = false;

  /** Draws and writes everything anew before the next repaint. */
  function show() {
    if (scheduled || !page.stages) return;
    scheduled = true;
    requestAnimationFrame(() => {
      scheduled = false;
      if (page.stages[0].canvas.clientWidth === 0) return;
      // The width of the first decoded picture decides the fitting scale.
      if (page.laidOutFor !== pictureWidth()) layOut();
      keepInSight();
      const complete = page.stages.filter(({ figure }) => !figure.hidden).map(drawStage).every(Boolean);
      showDivider();
      byId("zoom").textContent = `${formattedValue(geometryOf(page.stages[0]).scale * 100)} %`;
      showReadout();
      if (complete) document.documentElement.dataset.viewer = "ready";
    });
  }

  /** Draws a stage. Returns whether all its layers are decoded (or failed). */
  function drawStage(stage) {
    const parts = chosenFrame() ? partsOf(stage) : [];
    const entries = parts.map(({ layer }) => (layer ? decodedLayer(layer) : { state: "absent" }));
    const loading = entries.filter((entry) => entry.state === "loading");
    if (loading.some((entry) => performance.now() - entry.since < PATIENCE_MS)) return false;
    const context = clearedContext(stage.canvas);
    const geometry = geometryOf(stage);
    parts.forEach((part, index) => {
      onPart(context, geometry, part, () => drawLayer(context, geometry, part.layer, entries[index]));
    });
    if (chosenFrame()) onPart(context, geometry, WHOLE, () => drawRings(context, geometry));
    for (const part of parts) onPart(context, geometry, part, () => drawBorders(context, geometry, part.layer));
    if (chosenFrame()) onPart(context, geometry, WHOLE, () => drawMarks(context, geometry, stage));
    showMessage(stage, parts, entries);
    return loading.length === 0;
  }

  /** Says in the stage what cannot be shown. */
  function showMessage(stage, parts, entries) {
    const texts = parts.flatMap(({ layer }, index) => {
      const name = layer && (layer.picture ? `The picture “${layer.text}”` : `“${layer.text}”`);
      return {
        failed: [`${name} could not be decoded.`],
        loading: [`${name} is being decoded.`],
        absent: ["This frame has no such layer."],
      }[entries[index].state] ?? [];
    });
    if (!chosenFrame()) texts.push("There are no pictures of this scene.");
    stage.message.textContent = texts.join(" ");
    stage.message.hidden = texts.length === 0;
  }

  /** The context of a canvas, which is cleared and has one unit for each screen pixel. */
  function clearedContext(canvas) {
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((size) => Math.max(1, Math.round(size * density())));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const context = canvas.getContext("2d");
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    context.setTransform(density(), 0, 0, density(), 0, 0);
    return context;
  }

  /** The part of a stage's width that is all of it. */
  const WHOLE = { from: -Infinity, to: Infinity };

  /** Draws on the frame between two places of the stage's width alone. */
  function onPart(context, { left, top, right, bottom, width }, { from, to }, draw) {
    const [start, end] = [Math.max(from, left, 0), Math.min(to, right, width)];
    if (end <= start) return;
    context.save();
    context.beginPath();
    context.rect(start, top, end - start, bottom - top);
    context.clip();
    draw();
    context.restore();
  }

  function drawLayer(context, geometry, layer, entry) {
    if (entry.state !== "ready") return;
    const { left, top, right, bottom, scale } = geometry;
    const { map } = layer;
    // The last blocks of a map may reach beyond the frame.
    const [across, down] = map ? [map.columns * map.block * scale, map.rows * map.block * scale] : [right - left, bottom - top];
    drawSource(context, geometry, map ? entry.value.canvas : entry.value, across, down);
  }

  /** Draws the layer borders of the method that a layer shows, if they are switched on. */
  function drawBorders(context, geometry, layer) {
    if (!byId("borders").checked) return;
    const borders = layer?.method === undefined ? [] : testOf(layer.method)?.borders;
    if (borders?.length) drawLines(context, geometry, borders, "#ffd75e", 1.5, [6, 4]);
  }

  /** Draws the visible pixels of a picture that is `across` x `down` screen pixels large. */
  function drawSource(context, { left, top, width, height }, source, across, down) {
    const size = [source.naturalWidth ?? source.width, source.naturalHeight ?? source.height];
    const [stepX, stepY] = [across / size[0], down / size[1]];
    const first = [Math.max(0, Math.floor(-left / stepX)), Math.max(0, Math.floor(-top / stepY))];
    const last = [Math.min(size[0], Math.ceil((width - left) / stepX)), Math.min(size[1], Math.ceil((height - top) / stepY))];
    const [columns, rows] = [last[0] - first[0], last[1] - first[1]];
    if (columns <= 0 || rows <= 0) return;
    // Enlarged pixels stay squares: a smoothed picture would hide what a method did.
    context.imageSmoothingEnabled = stepX * density() < 0.999;
    context.imageSmoothingQuality = "high";
    const place = [left + first[0] * stepX, top + first[1] * stepY];
    context.drawImage(source, ...first, columns, rows, ...place, columns * stepX, rows * stepY);
  }

  /** Strokes the current path as a light line with a dark edge, which is readable on every picture. */
  function strokeOnPicture(context, colour, width, dashes = []) {
    context.lineJoin = "round";
    context.lineWidth = width + 2;
    context.strokeStyle = "rgba(0, 0, 0, 0.6)";
    context.stroke();
    context.lineWidth = width;
    context.strokeStyle = colour;
    context.setLineDash(dashes);
    context.stroke();
    context.setLineDash([]);
  }

  /** Draws lines, each a list x, y, x, y, … in pixels of the frame. */
  function drawLines(context, { left, top, scale }, lines, colour, width, dashes = []) {
    context.beginPath();
    for (const line of lines) {
      for (let at = 0; at + 1 < line.length; at += 2) {
        const point = [left + line[at] * scale, top + line[at + 1] * scale];
        if (at === 0) context.moveTo(...point);
        else context.lineTo(...point);
      }
    }
    strokeOnPicture(context, colour, width, dashes);
  }

  /** Draws the gaze and the crosshair. */
  function drawMarks(context, geometry, stage) {
    const gaze = gazeOnView();
    if (byId("trace").checked && !byId("trace").disabled) drawTrace(context, geometry);
    if (byId("gaze").checked && gaze) drawGaze(context, geometry, gaze);
    // The mouse marks its pixel on its own stage.
    const point = state.hover?.stage === stage ? null : pointOnView();
    if (point) drawCross(context, geometry, point);
  }

  function drawRings(context, geometry) {
    if (!byId("rings").checked) return;
    const { rings } = chosenFrame();
    for (const { lines } of rings) drawLines(context, geometry, lines, "#fff", 1.25);
    for (const { deg, lines } of rings) {
      const place = ringLabelPlace(geometry, lines, gazeOnView());
      if (place) drawLabel(context, `${deg}°`, place);
    }
  }

  /** Where a ring's label stands: its visible point that is nearest to above and right of the gaze. */
  function ringLabelPlace({ left, top, right, bottom, width, height, scale }, lines, gaze) {
    const margin = 14;
    let [best, place] = [Infinity, null];
    for (const line of lines) {
      for (let at = 0; at + 1 < line.length; at += 2) {
        const [x, y] = [left + line[at] * scale, top + line[at + 1] * scale];
        const isVisible = x > Math.max(0, left) + margin && x < Math.min(width, right) - margin
          && y > Math.max(0, top) + margin && y < Math.min(height, bottom) - margin;
        const angle = gaze ? angleBetween(Math.atan2(line[at] - gaze[0], gaze[1] - line[at + 1]), Math.PI / 4) : 0;
        if (isVisible && angle < best) [best, place] = [angle, [x, y]];
      }
    }
    return place;
  }

  /** The smallest angle between two directions, in radians. */
  function angleBetween(one, other) {
    const turn = Math.abs(one - other) % (2 * Math.PI);
    return Math.min(turn, 2 * Math.PI - turn);
  }

  function drawLabel(context, text, [x, y]) {
    context.font = "600 12px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineJoin = "round";
    context.lineWidth = 4;
    context.strokeStyle = "rgba(0, 0, 0, 0.75)";
    context.strokeText(text, x, y);
    context.fillStyle = "#fff";
    context.fillText(text, x, y);
  }

  function drawGaze(context, { left, top, scale }, [gazeX, gazeY]) {
    const [x, y] = [left + gazeX * scale, top + gazeY * scale];
    context.beginPath();
    context.arc(x, y, 8, 0, 2 * Math.PI);
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(x + 5 * dx, y + 5 * dy);
      context.lineTo(x + 12 * dx, y + 12 * dy);
    }
    strokeOnPicture(context, "#fff", 1.5);
  }

  function drawTrace(context, geometry) {
    const { frames, gaze_px: gaze } = chosenEye().sequence;
    drawLines(context, geometry, [gaze.flatMap((point) => point ?? [])], "#9fe8ff", 1.25);
    const present = gaze[frames.indexOf(state.number)];
    if (!present) return;
    context.beginPath();
    context.arc(geometry.left + present[0] * geometry.scale, geometry.top + present[1] * geometry.scale, 4, 0, 2 * Math.PI);
    strokeOnPicture(context, "#9fe8ff", 1.5);
    context.fillStyle = "#9fe8ff";
    context.fill();
  }

  /** Draws a cross around a pixel, which itself stays visible. */
  function drawCross(context, { left, top, scale }, [column, row]) {
    const [x, y] = [left + (column + 0.5) * scale, top + (row + 0.5) * scale];
    const gap = Math.max(3, scale / 2 + 1);
    context.beginPath();
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(x + gap * dx, y + gap * dy);
      context.lineTo(x + (gap + 11) * dx, y + (gap + 11) * dy);
    }
    strokeOnPicture(context, "#fff", 1.5);
  }

  function showDivider() {
    const divider = byId("divider");
    divider.hidden = state.mode !== "slider" || !chosenFrame();
    if (divider.hidden) return;
    const geometry = geometryOf(page.stages[0]);
    const [top, bottom] = [Math.max(0, geometry.top), Math.min(geometry.height, geometry.bottom)];
    divider.style.left = `${dividerAt(geometry)}px`;
    divider.style.top = `${top}px`;
    divider.style.height = `${bottom - top}px`;
    const percent = Math.round(state.split * 100);
    divider.setAttribute("aria-valuenow", percent);
    divider.setAttribute("aria-valuetext", `${percent} % ${layerName(state.a)}, ${100 - percent} % ${layerName(state.b)}`);
  }

  const layerName = (key) => page.layers.get(key)?.text ?? "nothing";

  // ---------------------------------------------------------------- Colour bars

  /** Shows a colour bar for each kind of map on view. */
  function showColourBars() {
    const keys = state.mode === "side" ? [sideMapKey()] : [state.a, state.b];
    const kinds = new Set(keys.map((key) => page.layers.get(key)?.map?.map).filter((kind) => data.maps[kind]?.scale));
    byId("bars").replaceChildren(...[...kinds].map((kind) => colourBar(data.maps[kind])));
  }

  function colourBar({ label, unit, about, scale }) {
    const colours = element("canvas", { width: 256, height: 1, className: "viewer-colours" });
    paint(colours, Array.from({ length: 256 }, (_, at) => rgb(data.palette, at * 6)));
    const missing = element("canvas", { width: 1, height: 1, className: "viewer-missing" });
    paint(missing, [rgb(data.noValue)]);
    const ends = [scale.none, middleOfScale(scale), scale.most]
      .map((value) => element("span", { textContent: formattedValue(value) }));
    const kind = scale.kind === "log" ? ", logarithmic" : "";
    return element("div", { className: "viewer-bar" },
      element("strong", { textContent: unit ? `${label} (${unit})${kind}` : `${label}${kind}` }),
      colours,
      element("div", { className: "viewer-ends" }, ...ends),
      element("div", { className: "viewer-why" }, missing, " no value"),
      element("p", { className: "viewer-why", textContent: about ?? "" }));
  }

  /** Paints a canvas of one row with colours. */
  function paint(canvas, colours) {
    const context = canvas.getContext("2d");
    const image = context.createImageData(colours.length, 1);
    colours.forEach((colour, at) => image.data.set([...colour, 255], at * 4));
    context.putImageData(image, 0, 0);
  }

  // ---------------------------------------------------------------- Readout

  /** Builds the table of scores: one row for each method, cells to be filled by `showReadout`. */
  function buildTable() {
    const eye = chosenEye();
    const [head, body] = [byId("scores").tHead, byId("scores").tBodies[0]];
    const columns = [...(state.map ? [{ map: state.map }] : []), ...page.metrics.map((metric) => ({ metric }))];
    head.replaceChildren(element("tr", {}, element("th", { scope: "col", textContent: "Method" }), ...columns.map(columnHead)));
    page.rows = eye.methods.map((name) => {
      const cells = columns.map(() => element("td"));
      return { cells, row: element("tr", {}, element("th", { scope: "row", textContent: name, title: name }), ...cells) };
    });
    page.columns = columns;
    byId("scores").parentElement.hidden = columns.length === 0;
    body.replaceChildren(...page.rows.map(({ row }) => row));
  }

  function columnHead({ map, metric }) {
    if (map) {
      const { unit, about } = data.maps[map] ?? {};
      const text = `${mapLabel(map)} map here${unit ? ` (${unit})` : ""}`;
      return element("th", { scope: "col", textContent: text, title: about ?? "" });
    }
    const { unit, better, about } = data.metrics[metric];
    const direction = { higher: " ↑", lower: " ↓" }[better] ?? "";
    const meaning = direction ? [`${better} is better`] : [];
    return element("th", {
      scope: "col",
      textContent: `${metricLabel(metric)}${unit ? ` (${unit})` : ""}${direction}`,
      title: [about ?? "", ...meaning].filter(Boolean).join(" – "),
    });
  }

  /** What the readout says of a pixel: eccentricity, the band's index and its words. */
  function factsAt(point) {
    const { view, bands_deg: edges } = chosenEye();
    const gaze = gazeOnView();
    if (!view || !gaze || !point) return { degrees: NaN, band: null, bandText: "–" };
    const degrees = eccentricityDeg(view, gaze, point[0] + 0.5, point[1] + 0.5);
    const band = edges.length > 1 ? bandIndex(edges, degrees) : null;
    const bandText = band === null ? "–" : band < 0 ? "outside all" : `${edges[band]}° to ${edges[band + 1]}°`;
    return { degrees, band, bandText };
  }

  /** Whether the chosen frame has pictures. Otherwise the stage shows another one. */
  const isPictured = () => chosenFrame()?.frame === state.number;

  /** A method's scores by metric for the band, or for the whole frame if `band` is null. */
  function scoresOf(method, band) {
    if (band !== null) return testOf(method)?.bands[band] ?? {};
    const { frames, metrics } = chosenEye().sequence ?? { frames: [], metrics: {} };
    const at = frames.indexOf(state.number);
    const ofSequence = Object.fromEntries(Object.entries(metrics).map(([metric, lines]) => [metric, lines[method]?.[at]]));
    return isPictured() ? { ...ofSequence, ...testOf(method)?.scores } : ofSequence;
  }

  function showReadout() {
    const point = chosenFrame() ? pointOnView() : null;
    const facts = factsAt(point);
    byId("fact-pixel").textContent = point ? `x ${point[0]}, y ${point[1]}` : "–";
    byId("fact-eccentricity").textContent = Number.isNaN(facts.degrees) ? "–" : `${facts.degrees.toFixed(2)}°`;
    byId("fact-band").textContent = facts.bandText;
    const shown = isPictured() || facts.band !== null ? chosenFrame()?.frame : state.number;
    const where = facts.band === null ? "" : facts.band < 0 ? ", outside all bands" : `, band ${facts.bandText}`;
    byId("scores-caption").textContent = `Scores of frame ${shown}${where}`;
    const values = page.rows.map((_, method) => {
      const scores = scoresOf(method, facts.band);
      const map = state.map && point ? mapOf(method, state.map) : undefined;
      return page.columns.map(({ metric }) => (metric ? number(scores[metric]) : map ? valueAt(map, point) : NaN));
    });
    page.rows.forEach(({ cells }, method) => cells.forEach((cell, column) => fillCell(cell, column, values, method)));
    describePoint(point, facts, values);
  }

  /** Writes a value, and marks it if it is the best of several methods. */
  function fillCell(cell, column, values, method) {
    const { metric } = page.columns[column];
    const value = values[method][column];
    const digits = metric ? data.metrics[metric].digits : undefined;
    cell.textContent = value === null ? "…" : metric ? formatted(value, digits) : formattedBlock(value);
    const better = metric && data.metrics[metric].better;
    const all = values.map((row) => row[column]).filter((number) => !Number.isNaN(number));
    const best = better === "higher" ? Math.max(...all) : better === "lower" ? Math.min(...all) : NaN;
    cell.classList.toggle("viewer-best", all.length > 1 && value === best && all.some((other) => other !== best));
  }

  /** Puts the readout's values into data attributes. */
  function describePoint(point, { degrees }, values) {
    const { dataset } = byId("readout");
    const value = state.map ? values[state.method]?.[0] : NaN;
    dataset.x = point ? point[0] : "";
    dataset.y = point ? point[1] : "";
    dataset.eccentricity = Number.isNaN(degrees) ? "" : degrees;
    dataset.value = value === undefined || value === null || Number.isNaN(value) ? "" : value;
  }

  /** Tells a screen reader where the crosshair is. */
  function sayCrosshair() {
    const { degrees, bandText } = factsAt(state.cross);
    const map = mapOf(state.method, state.map);
    const value = map ? valueAt(map, state.cross) : NaN;
    const said = [`x ${state.cross[0]}, y ${state.cross[1]}`];
    if (!Number.isNaN(degrees)) said.push(`eccentricity ${degrees.toFixed(1)} degrees, band ${bandText}`);
    if (value !== null && !Number.isNaN(value)) {
      said.push(`${mapLabel(state.map)} of ${methodName(state.method)} ${formattedValue(value)}`);
    }
    byId("said").textContent = said.join("; ");
  }

  // ---------------------------------------------------------------- Choices

  const frameText = ({ frame, why }) => (why?.length ? `frame ${frame} (${why.join(", ")})` : `frame ${frame}`);

  function chooseScene(scene) {
    const eyeName = chosenEye().eye;
    const names = chosenEye().methods;
    state.scene = scene;
    const { eyes } = data.scenes[scene];
    fillSelect(byId("eye"), eyes.map(({ eye }, value) => ({ value, text: eye || "both" })), 0);
    byId("eye-box").hidden = eyes.length < 2;
    chooseEye(Math.max(0, eyes.findIndex(({ eye }) => eye === eyeName)), names);
  }

  /** Chooses an eye. `names` are the methods that the present choice of layers refers to. */
  function chooseEye(index, names = chosenEye().methods) {
    state.eye = index;
    page.curve = null;
    byId("eye").value = index;
    const eye = chosenEye();
    for (const side of ["a", "b"]) state[side] = renamedKey(state[side], names, eye.methods);
    state.method = Math.max(0, eye.methods.indexOf(names[state.method]));
    fillSelect(byId("frame"), eye.frames.map((frame, value) => ({ value, text: frameText(frame) })), 0);
    page.metrics = metricsOf(eye);
    // The note keeps its place where frames without pictures can be chosen, so that nothing jumps.
    byId("note").hidden = !eye.sequence || eye.frames.length === 0;
    state.cross = null;
    state.hover = null;
    state.hiddenLines.clear();
    const { view } = eye;
    byId("fact-eccentricity-box").hidden = byId("fact-band-box").hidden = !view;
    chooseFrame(eye.frames[0]?.frame ?? eye.sequence?.frames[0] ?? 0);
    buildSequence();
    layOut();
    showWholeFrame();
  }

  /** The key of a layer after the list of methods has changed. */
  function renamedKey(key, before, after) {
    const [kind, method, ...map] = key.split(":");
    if (method === undefined) return key;
    return [kind, after.indexOf(before[method]), ...map].join(":");
  }

  /** Chooses a frame by its number. One without pictures shows the nearest one that has some. */
  function chooseFrame(frame) {
    const { frames } = chosenEye();
    const distance = (index) => Math.abs(frames[index].frame - frame);
    const nearest = frames.reduce((best, _, index) => (distance(index) < distance(best) ? index : best), 0);
    state.frame = nearest;
    state.number = frame;
    if (page.decodedFrame !== frames[nearest]) decoded = new Map();
    page.decodedFrame = frames[nearest];
    byId("frame").value = nearest;
    byId("note").textContent = isPictured() || frames.length === 0 ? "" : (
      `Frame ${frame} has no pictures: the nearest frame that has some, ${frames[nearest].frame}, is shown. `
      + `Scores of the whole frame are those of frame ${frame}.`);
    offerLayers();
    showChosenFrame();
    show();
  }

  /** The frame with pictures that is `step` after the one on view. */
  function stepFrame(step) {
    const { frames } = chosenEye();
    const next = frames[clamp(state.frame + step, 0, frames.length - 1)];
    if (next) chooseFrame(next.frame);
  }

  /** Offers the layers and maps of the frame on view, and keeps those chosen if they are among them. */
  function offerLayers() {
    page.layers = layersOf(chosenFrame());
    byId("app").classList.toggle("viewer-no-pictures", !chosenFrame());
    const options = [...page.layers].map(([value, { text, group }]) => ({ value, text, group }));
    const pictures = [...page.layers.keys()].filter((key) => key.startsWith("method:"));
    const first = page.layers.keys().next().value ?? "reference";
    if (!page.layers.has(state.a)) state.a = first;
    if (!page.layers.has(state.b) || !state.wasChosen) state.b = pictures[0] ?? first;
    if (pictures.length && !pictures.includes(`method:${state.method}`)) state.method = page.layers.get(pictures[0]).method;
    state.wasChosen = true;
    const kinds = mapKinds();
    if (!kinds.includes(state.map)) state.map = kinds[0] ?? "";
    fillSelect(byId("a"), options, state.a);
    fillSelect(byId("b"), options, state.b);
    const methods = pictures.map((key) => page.layers.get(key));
    fillSelect(byId("method"), methods.map(({ method, text }) => ({ value: method, text })), state.method);
    fillSelect(byId("map"), kinds.map((value) => ({ value, text: mapLabel(value) })), state.map);
    byId("map-box").hidden = kinds.length === 0;
    byId("mode-side").disabled = pictures.length === 0;
    buildTable();
    showChoice();
  }

  /** Chooses the layer of side `a` or `b`; the readout follows its method and map. */
  function chooseLayer(side, key) {
    state[side] = key;
    const { method, map } = page.layers.get(key);
    if (method !== undefined) state.method = method;
    if (map) chooseMap(map.map);
    byId("method").value = state.method;
    showChoice();
  }

  function chooseMap(kind) {
    state.map = kind;
    byId("map").value = kind;
    buildTable();
    showChoice();
  }

  function chooseMethod(method) {
    state.method = method;
    showChoice();
  }

  function chooseMode(mode) {
    state.mode = mode;
    byId(`mode-${mode}`).checked = true;
    const isSide = mode === "side";
    page.stages.forEach(({ figure }, index) => { figure.hidden = index > 0 && !isSide; });
    byId("main").classList.toggle("viewer-is-side", isSide);
    for (const name of ["a-box", "b-box"]) byId(name).hidden = isSide;
    byId("method-box").hidden = !isSide;
    byId("map-label").textContent = isSide ? "Map" : "Map in the table";
    state.hover = null;
    layOut();
    keepInSight();
    showChoice();
  }

  const sideMapKey = () => `map:${state.method}:${state.map}`;

  /** Shows what follows from the chosen layers: names, links, colour bars and switches. */
  function showChoice() {
    const isSide = state.mode === "side";
    nameLayer("a", isSide ? "reference" : state.a, isSide ? "" : "A: ");
    nameLayer("b", state.b, "B: ");
    nameLayer("method", `method:${state.method}`, "");
    nameLayer("map", sideMapKey(), "");
    byId("caption-b").hidden = isSide;
    byId("tag-a").hidden = isSide || (state.mode === "flicker" && state.flickerShowsB);
    byId("tag-b").hidden = isSide || (state.mode === "flicker" && !state.flickerShowsB);
    byId("tag-a").textContent = `A: ${layerName(state.a)}`;
    byId("tag-b").textContent = `B: ${layerName(state.b)}`;
    const shown = { slider: `${layerName(state.a)} left of the divider, ${layerName(state.b)} right of it`, side: "Reference" };
    byId("stage").setAttribute("aria-label", shown[state.mode] ?? layerName(state.flickerShowsB ? state.b : state.a));
    byId("flip-box").hidden = state.mode !== "flicker";
    byId("flip").textContent = `Show ${state.flickerShowsB ? "A" : "B"} (F)`;
    showColourBars();
    showSwitches();
    show();
  }

  /** Names a layer under its stage, with a link to its picture in full size. */
  function nameLayer(side, key, prefix) {
    const layer = page.layers.get(key);
    byId(`name-${side}`).textContent = layer ? prefix + layer.text : "";
    const { full } = layer?.picture ?? layer?.map ?? {};
    const link = byId(`full-${side}`);
    link.hidden = !full;
    if (full) link.href = full;
    else link.removeAttribute("href");
    link.setAttribute("aria-label", `Full size of ${layer?.text ?? "nothing"}`);
  }

  /** Enables the switches that have something to show, and says why the others have not. */
  function showSwitches() {
    const frame = chosenFrame();
    const keys = state.mode === "side" ? [`method:${state.method}`] : [state.a, state.b];
    const methods = keys.map((key) => page.layers.get(key)?.method).filter((method) => method !== undefined);
    const hasBorders = methods.some((method) => testOf(method)?.borders.length);
    enableSwitch("gaze", gazeOnView(), "No gaze is known.");
    enableSwitch("rings", frame?.rings.length, chosenEye().view ? "There are no rings." : "Rings need a view.");
    enableSwitch("borders", hasBorders, methods.length ? "What is shown has no layer borders." : "No method is shown.");
    const hasTrace = chosenEye().sequence?.gaze_px?.length > 1;
    byId("trace").disabled = !hasTrace;
    byId("trace-box").hidden = !hasTrace;
  }

  function enableSwitch(name, isPossible, why) {
    byId(name).disabled = !isPossible;
    byId(`${name}-why`).textContent = isPossible ? "" : why;
  }

  function flip() {
    if (state.mode !== "flicker") chooseMode("flicker");
    else state.flickerShowsB = !state.flickerShowsB;
    showChoice();
  }

  /** Gives the stages their height, which follows from their width. */
  function layOut() {
    const { width, height } = chosenEye();
    page.laidOutFor = pictureWidth();
    const most = clamp(window.innerHeight * 0.72, 260, 1000);
    for (const { box, figure } of page.stages) {
      if (figure.hidden) continue;
      if (!chosenFrame()) {
        box.style.height = "";
        continue;
      }
      const fitting = Math.min(most, (box.clientWidth * height) / width);
      box.style.height = `${Math.round(fittingScale(box.clientWidth, fitting) * height)}px`;
    }
  }

  // ---------------------------------------------------------------- Pointer

  /** Wheel, drag, pinch, hover and click on a stage. */
  function listenToPointer(stage) {
    const { box, canvas } = stage;
    const pointers = new Map();
    let moved = 0;
    const placeOf = (event) => placeOn(stage, event);
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      pointers.set(event.pointerId, placeOf(event));
      canvas.setPointerCapture(event.pointerId);
      if (pointers.size === 1) moved = 0;
    });
    box.addEventListener("pointermove", (event) => {
      const place = placeOf(event);
      if (event.pointerType !== "touch") hoverAt(stage, event);
      if (!pointers.has(event.pointerId)) return;
      const before = [...pointers.values()];
      const [x, y] = pointers.get(event.pointerId);
      moved += Math.abs(place[0] - x) + Math.abs(place[1] - y);
      pointers.set(event.pointerId, place);
      if (pointers.size === 2) pinch(stage, before, [...pointers.values()]);
      else if (moved > 4) panBy(place[0] - x, place[1] - y);
    });
    const release = (event) => {
      const wasPressed = pointers.delete(event.pointerId);
      if (wasPressed && event.type === "pointerup" && moved <= 4) {
        state.cross = pixelAt(stage, ...placeOf(event));
        show();
      }
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    box.addEventListener("pointerleave", () => { state.hover = null; show(); });
    box.addEventListener("wheel", (event) => {
      const isOut = event.deltaY > 0;
      // The page scrolls when there is nothing to zoom out of.
      if (event.deltaY === 0 || (isOut && state.zoom <= 1)) return;
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      zoomBy(Math.exp(-clamp(event.deltaY * lines, -300, 300) * 0.0018), stage, ...placeOf(event));
    }, { passive: false });
  }

  function hoverAt(stage, { clientX, clientY }) {
    state.hover = { stage, clientX, clientY };
    show();
  }

  /** Zooms and moves by two fingers. */
  function pinch(stage, before, after) {
    const distance = ([[ax, ay], [bx, by]]) => Math.hypot(ax - bx, ay - by);
    const middle = ([[ax, ay], [bx, by]]) => [(ax + bx) / 2, (ay + by) / 2];
    const [from, to] = [middle(before), middle(after)];
    panBy(to[0] - from[0], to[1] - from[1]);
    if (distance(before) > 0) zoomBy(distance(after) / distance(before), stage, ...to);
  }

  function listenToDivider() {
    const divider = byId("divider");
    const moveTo = (clientX) => {
      const { canvas } = page.stages[0];
      const { left, right, width } = geometryOf(page.stages[0]);
      const [from, to] = [Math.max(0, left), Math.min(width, right)];
      setSplit((clientX - canvas.getBoundingClientRect().left - from) / (to - from));
    };
    divider.addEventListener("pointerdown", (event) => divider.setPointerCapture(event.pointerId));
    divider.addEventListener("pointermove", (event) => {
      if (divider.hasPointerCapture(event.pointerId)) moveTo(event.clientX);
    });
    divider.addEventListener("keydown", (event) => {
      const large = event.shiftKey ? 0.1 : 0.01;
      const to = {
        ArrowLeft: state.split - large, ArrowDown: state.split - large,
        ArrowRight: state.split + large, ArrowUp: state.split + large,
        PageDown: state.split - 0.1, PageUp: state.split + 0.1, Home: 0, End: 1,
      }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      setSplit(to);
    });
  }

  function setSplit(split) {
    state.split = clamp(split, 0, 1);
    show();
  }

  // ---------------------------------------------------------------- Keys

  const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

  /** By how many screen pixels an arrow key moves the picture, and the crosshair. */
  const [PAN_STEP, CROSS_STEP] = [60, 4];

  function onStageKey(event) {
    const arrow = ARROWS[event.key];
    if (event.key === "Escape") {
      state.cross = null;
      show();
    } else if (arrow && event.shiftKey) {
      event.preventDefault();
      moveCross(arrow, event.ctrlKey);
    } else if (arrow && !event.ctrlKey && !event.altKey && !event.metaKey) {
      event.preventDefault();
      panBy(-arrow[0] * PAN_STEP, -arrow[1] * PAN_STEP);
    }
  }

  /** Moves the crosshair, which starts in the centre of the stage, and keeps it in sight. */
  function moveCross([dx, dy], byOnePixel) {
    const { width, height } = chosenEye();
    const { scale } = geometryOf(page.stages[0]);
    const step = byOnePixel ? 1 : Math.max(1, Math.round(CROSS_STEP / scale));
    const [x, y] = state.cross ?? state.centre.map(Math.floor);
    const isNew = !state.cross;
    state.cross = isNew ? [x, y] : [clamp(x + dx * step, 0, width - 1), clamp(y + dy * step, 0, height - 1)];
    const { clientWidth, clientHeight } = page.stages[0].canvas;
    state.centre = [clientWidth, clientHeight].map((size, axis) => {
      const reach = (size / scale / 2) * 0.9;
      return clamp(state.centre[axis], state.cross[axis] - reach, state.cross[axis] + reach);
    });
    state.hover = null;
    keepInSight();
    sayCrosshair();
    show();
  }

  /** Keys that work wherever the focus is in the viewer. */
  const KEYS = {
    "+": () => zoomBy(1.5),
    "=": () => zoomBy(1.5),
    "-": () => zoomBy(1 / 1.5),
    "0": showWholeFrame,
    f: flip,
    n: () => stepFrame(1),
    p: () => stepFrame(-1),
    "?": () => { byId("keys").open = true; byId("keys").querySelector("summary").focus(); },
  };

  function onKey(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target.matches("select")) return;
    const action = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  // ---------------------------------------------------------------- Sequence

  /** Fills the section of the sequence, which is hidden if there is none. */
  function buildSequence() {
    const { sequence, methods } = chosenEye();
    const metrics = Object.keys(sequence?.metrics ?? {}).filter((metric) => data.metrics[metric]);
    const hasCurve = sequence?.frames.length > 1 && metrics.length > 0;
    byId("sequence").hidden = !hasCurve;
    if (!hasCurve) return;
    const loss = metrics.includes(sequence.loss) ? sequence.loss : metrics[0];
    const former = byId("curve-metric").value;
    const options = metrics.map((value) => ({ value, text: metricLabel(value) }));
    fillSelect(byId("curve-metric"), options, metrics.includes(former) ? former : loss);
    byId("legend").replaceChildren(...methods.map(legendEntry));
    buildFramesList(loss);
    drawCurve();
  }

  /** A method in the legend: a button that shows or hides its line. */
  function legendEntry(name, method) {
    const sample = svgElement("svg", { width: 26, height: 10, "aria-hidden": "true", class: lineClass(method) });
    sample.append(svgElement("path", { d: "M1 5H25" }));
    const label = element("span", { textContent: name });
    const button = element("button", { type: "button", title: `Show or hide ${name}` }, sample, label);
    button.setAttribute("aria-pressed", "true");
    button.addEventListener("click", () => {
      const isHidden = !state.hiddenLines.delete(method);
      if (isHidden) state.hiddenLines.add(method);
      button.setAttribute("aria-pressed", String(!isHidden));
      drawCurve();
    });
    return element("li", {}, button);
  }

  /** Colours repeat after eight methods, with another dash. */
  const lineClass = (method) => `viewer-line viewer-colour-${method % 8} viewer-dash-${Math.floor(method / 8) % 3}`;

  const CURVE_HEIGHT = 220;
  const CURVE_MARGIN = { left: 58, right: 14, top: 16, bottom: 44 };

  /** Draws the curve of the chosen metric over the frames, one line for each method. */
  function drawCurve() {
    const svg = byId("curve");
    const { sequence } = chosenEye();
    const width = Math.max(240, svg.parentElement.clientWidth);
    const metric = byId("curve-metric").value;
    const lines = (sequence.metrics[metric] ?? []).map((line) => line.map(number));
    const shown = lines.filter((_, method) => !state.hiddenLines.has(method));
    const curve = curveScales(sequence.frames, shown, width);
    page.curve = curve;
    svg.setAttribute("viewBox", `0 0 ${width} ${CURVE_HEIGHT}`);
    svg.setAttribute("width", width);
    svg.setAttribute("height", CURVE_HEIGHT);
    svg.replaceChildren(...curveAxes(curve, metric, shown));
    lines.forEach((line, method) => {
      if (state.hiddenLines.has(method)) return;
      svg.append(svgElement("path", { d: curvePath(curve, sequence.frames, line), class: lineClass(method) }));
    });
    for (const { frame } of chosenEye().frames) {
      const [x, y] = [curve.x(frame), CURVE_HEIGHT - CURVE_MARGIN.bottom + 2];
      svg.append(svgElement("path", { d: `M${x} ${y}l4 7h-8z`, class: "viewer-pictured" }));
    }
    page.present = svgElement("path", { class: "viewer-present" });
    svg.append(page.present);
    showChosenFrame();
  }

  /** How frames and values are placed on the curve. */
  function curveScales(frames, lines, width) {
    const { left, right, top, bottom } = CURVE_MARGIN;
    const finite = lines.flat().filter(Number.isFinite);
    let [low, high] = finite.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
    if (finite.length === 0) [low, high] = [0, 1];
    const margin = (high - low) * 0.06 || Math.abs(high) * 0.05 || 1;
    [low, high] = [low - margin, high + margin];
    const [first, last] = [Math.min(...frames), Math.max(...frames)];
    const x = (frame) => left + ((frame - first) / (last - first || 1)) * (width - left - right);
    const y = (value) => top + (1 - clamp((value - low) / (high - low), 0, 1)) * (CURVE_HEIGHT - top - bottom);
    return { x, y, low, high, first, last, width };
  }

  function curveAxes(curve, metric, lines) {
    const { left, right, top, bottom } = CURVE_MARGIN;
    const floor = CURVE_HEIGHT - bottom;
    const marks = ticks(curve.low, curve.high, 5).flatMap((value) => [
      svgElement("path", { d: `M${left} ${curve.y(value)}H${curve.width - right}`, class: "viewer-grid" }),
      svgElement("text", { x: left - 6, y: curve.y(value) + 4, "text-anchor": "end" }, formattedValue(value)),
    ]);
    for (const frame of ticks(curve.first, curve.last, clamp(curve.width / 90, 2, 10), 1)) {
      marks.push(svgElement("text", { x: curve.x(frame), y: floor + 24, "text-anchor": "middle" }, String(frame)));
    }
    if (lines.flat().includes(Infinity)) marks.push(svgElement("text", { x: left - 6, y: top - 2, "text-anchor": "end" }, "∞"));
    const { unit } = data.metrics[metric];
    marks.push(svgElement("path", { d: `M${left} ${top}V${floor}H${curve.width - right}`, class: "viewer-axis" }));
    const title = `${metricLabel(metric)}${unit ? ` (${unit})` : ""} over frames`;
    marks.push(svgElement("text", { x: left, y: CURVE_HEIGHT - 4 }, title));
    return marks;
  }

  /** The path of a line. It has gaps where values are missing; infinite ones are marks at the edge. */
  function curvePath(curve, frames, line) {
    let path = "";
    let isDown = false;
    line.forEach((value, at) => {
      const [x, y] = [curve.x(frames[at]), Number.isNaN(value) ? 0 : curve.y(value)].map((place) => Math.round(place * 10) / 10);
      const hasNeighbour = Number.isFinite(line[at - 1]) || Number.isFinite(line[at + 1]);
      if (Number.isFinite(value)) path += hasNeighbour ? `${isDown ? "L" : "M"}${x} ${y}` : `M${x - 1.5} ${y}h3`;
      else if (!Number.isNaN(value)) path += `M${x - 2} ${y}h4`;
      isDown = Number.isFinite(value);
    });
    return path;
  }

  /** The mean of a metric over the methods that have a value in this frame. */
  function meanOverMethods(lines, at) {
    const values = lines.map((line) => number(line[at])).filter((value) => !Number.isNaN(value));
    return values.length ? values.reduce((sum, value) => sum + value, 0) / values.length : NaN;
  }

  /** Orders numbers upwards, missing ones last. */
  function byRank(one, other) {
    if (Number.isNaN(one) || Number.isNaN(other)) return Number.isNaN(one) - Number.isNaN(other);
    return one < other ? -1 : Number(one > other);
  }

  /** Lists the frames, the worst first. */
  function buildFramesList(metric) {
    const { sequence, frames: pictured } = chosenEye();
    const { better, digits } = data.metrics[metric];
    const worstFirst = better === "higher" ? 1 : -1;
    const hasPictures = new Set(pictured.map(({ frame }) => frame));
    const ranked = sequence.frames.map((frame, at) => ({ frame, at, mean: meanOverMethods(sequence.metrics[metric], at) }));
    ranked.sort((one, other) => byRank(one.mean * worstFirst, other.mean * worstFirst) || one.at - other.at);
    byId("frames-heading").textContent = `Frames by ${metricLabel(metric)}, worst first`;
    byId("frames-list").replaceChildren(...ranked.map(({ frame, mean }) => {
      const mark = element("span", { className: "viewer-mark", textContent: hasPictures.has(frame) ? "▲" : "" });
      mark.setAttribute("aria-hidden", "true");
      const button = element("button", { type: "button", tabIndex: -1 },
        element("span", { textContent: `frame ${frame}` }), mark, element("span", { textContent: formatted(mean, digits) }));
      if (hasPictures.has(frame)) button.append(element("span", { className: "viewer-hidden", textContent: ", with pictures" }));
      button.dataset.frame = frame;
      return element("li", { className: hasPictures.has(frame) ? "" : "viewer-unpictured" }, button);
    }));
    filterFramesList();
  }

  const listedButtons = () => [...byId("frames-list").querySelectorAll("li:not([hidden]) button")];

  function filterFramesList() {
    const isFiltered = byId("frames-pictured").checked;
    for (const entry of byId("frames-list").querySelectorAll(".viewer-unpictured")) entry.hidden = isFiltered;
    showChosenFrame();
  }

  /** Marks the chosen frame in the curve and the list. */
  function showChosenFrame() {
    if (!page.curve) return;
    const { curve } = page;
    const svg = byId("curve");
    page.present.setAttribute("d", `M${curve.x(state.number)} ${CURVE_MARGIN.top}V${CURVE_HEIGHT - CURVE_MARGIN.bottom}`);
    svg.setAttribute("aria-valuemin", curve.first);
    svg.setAttribute("aria-valuemax", curve.last);
    svg.setAttribute("aria-valuenow", state.number);
    svg.setAttribute("aria-valuetext", curveText());
    const buttons = listedButtons();
    const present = buttons.find(({ dataset }) => Number(dataset.frame) === state.number);
    for (const button of byId("frames-list").querySelectorAll("button")) {
      button.tabIndex = button === (present ?? buttons[0]) ? 0 : -1;
      if (button === present) button.setAttribute("aria-current", "true");
      else button.removeAttribute("aria-current");
    }
  }

  /** What a screen reader says of the chosen frame of the curve. */
  function curveText() {
    const { sequence, methods } = chosenEye();
    const metric = byId("curve-metric").value;
    const at = sequence.frames.indexOf(state.number);
    const { digits } = data.metrics[metric];
    const lines = sequence.metrics[metric] ?? [];
    const values = methods.map((name, method) => `${name} ${formatted(number(lines[method]?.[at]), digits)}`);
    return `frame ${state.number}${isPictured() ? "" : ", no pictures"}: ${metricLabel(metric)} ${values.join(", ")}`;
  }

  function listenToSequence() {
    const svg = byId("curve");
    byId("curve-metric").addEventListener("change", drawCurve);
    const chooseAt = (event) => {
      const at = ((event.clientX - svg.getBoundingClientRect().left) / svg.clientWidth) * page.curve.width;
      const distance = (frame) => Math.abs(page.curve.x(frame) - at);
      const { frames } = chosenEye().sequence;
      chooseFrame(frames.reduce((best, frame) => (distance(frame) < distance(best) ? frame : best)));
    };
    svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); chooseAt(event); });
    svg.addEventListener("pointermove", (event) => { if (svg.hasPointerCapture(event.pointerId)) chooseAt(event); });
    svg.addEventListener("keydown", (event) => {
      const { frames } = chosenEye().sequence;
      const to = steppedIndex(event.key, frames.indexOf(state.number), frames.length, { ArrowUp: 1, ArrowDown: -1 });
      if (to === undefined) return;
      event.preventDefault();
      chooseFrame(frames[to]);
    });
    byId("frames-pictured").addEventListener("change", filterFramesList);
    byId("frames-list").addEventListener("click", (event) => {
      const button = event.target.closest("button");
      if (button) chooseFrame(Number(button.dataset.frame));
    });
    byId("frames-list").addEventListener("keydown", (event) => {
      const buttons = listedButtons();
      const at = buttons.indexOf(event.target.closest("button"));
      const to = steppedIndex(event.key, at, buttons.length, { ArrowUp: -1, ArrowDown: 1 });
      if (to === undefined) return;
      event.preventDefault();
      buttons[to].focus();
    });
  }

  /** The index that a key leads to from `at`, or undefined for other keys. */
  function steppedIndex(key, at, length, vertical) {
    const step = { ArrowLeft: -1, ArrowRight: 1, PageUp: -10, PageDown: 10, Home: -Infinity, End: Infinity, ...vertical }[key];
    return step === undefined ? undefined : clamp(at + step, 0, length - 1);
  }

  // ---------------------------------------------------------------- Start

  function listen() {
    const onChange = (name, choose) => byId(name).addEventListener("change", ({ target }) => choose(target.value));
    onChange("scene", (value) => chooseScene(Number(value)));
    onChange("eye", (value) => chooseEye(Number(value)));
    onChange("frame", (value) => chooseFrame(chosenEye().frames[Number(value)].frame));
    onChange("a", (value) => chooseLayer("a", value));
    onChange("b", (value) => chooseLayer("b", value));
    onChange("method", (value) => chooseMethod(Number(value)));
    onChange("map", chooseMap);
    for (const mode of ["slider", "flicker", "side"]) onChange(`mode-${mode}`, chooseMode);
    for (const name of ["gaze", "rings", "borders", "trace"]) onChange(name, show);
    byId("zoom-in").addEventListener("click", () => zoomBy(1.5));
    byId("zoom-out").addEventListener("click", () => zoomBy(1 / 1.5));
    byId("zoom-fit").addEventListener("click", showWholeFrame);
    byId("flip").addEventListener("click", flip);
    page.stages.forEach(listenToPointer);
    for (const { canvas } of page.stages) canvas.addEventListener("keydown", onStageKey);
    listenToDivider();
    listenToSequence();
    byId("app").addEventListener("keydown", onKey);
    const onResize = () => {
      layOut();
      if (page.curve) drawCurve();
      show();
    };
    new ResizeObserver(onResize).observe(byId("stages"));
    window.addEventListener("resize", onResize);
  }

  /** A stage: its figure, the box that is drawn in, its canvas and message, and its layer side by side. */
  function stageOf(name, sideKey) {
    const canvas = byId(name);
    const box = canvas.parentElement;
    return { canvas, box, figure: box.parentElement, message: box.querySelector(".viewer-message"), sideKey };
  }

  /** Puts empty lists where the data have none. */
  function completeEye(eye) {
    for (const list of ["methods", "frames", "bands_deg"]) eye[list] ??= [];
    for (const frame of eye.frames) {
      frame.tests ??= [];
      frame.rings ??= [];
      for (const test of frame.tests) {
        for (const list of ["borders", "bands", "maps"]) test[list] ??= [];
        test.bands = test.bands.map((scores) => scores ?? {});
        test.scores ??= {};
      }
    }
    if (eye.sequence) {
      eye.sequence.frames ??= [];
      eye.sequence.metrics ??= {};
    }
  }

  function start() {
    const source = document.getElementById("viewer-data");
    Object.assign(data, source ? JSON.parse(source.textContent) : {});
    data.scenes = data.scenes.filter(({ eyes }) => eyes?.length);
    data.scenes.flatMap(({ eyes }) => eyes).forEach(completeEye);
    if (data.scenes.length === 0) {
      byId("none").textContent = "There are no pictures of this run.";
      byId("none").hidden = false;
      document.documentElement.dataset.viewer = "ready";
      return;
    }
    page.stages = [
      stageOf("stage", () => "reference"),
      stageOf("stage-method", () => `method:${state.method}`),
      stageOf("stage-map", sideMapKey),
    ];
    byId("app").hidden = false;
    fillSelect(byId("scene"), data.scenes.map(({ name }, value) => ({ value, text: name })), 0);
    chooseScene(0);
    chooseMode("slider");
    listen();
  }

  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
  else start();
})();
