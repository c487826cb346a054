// Choices of scene, frame, layers and mode.

"use strict";

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
