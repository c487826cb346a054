// The pointer, the wheel and fingers.

"use strict";

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
