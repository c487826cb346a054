// Fills the viewer and begins to listen.

"use strict";

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
