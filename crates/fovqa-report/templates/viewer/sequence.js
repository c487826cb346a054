// The frames of a sequence: curve and list.

"use strict";

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
  byId("frames-heading").textContent = `Frames by ${metricLabel(metric)} (mean of all methods), worst first`;
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
