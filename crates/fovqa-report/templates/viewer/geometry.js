// How a stage shows the frame: zoom, position, and the way from the screen to a pixel and back.

"use strict";

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
