// What the page holds, what is chosen, and the layers that can be shown.

"use strict";

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
