// Draws the stages: pictures, maps, rings, gaze and borders.

"use strict";

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
