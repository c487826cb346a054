// The keyboard.

"use strict";

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
