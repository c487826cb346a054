// What is under the pointer or the crosshair.

"use strict";

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
