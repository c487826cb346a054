// The colour bars of the maps on the stages.

"use strict";

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
