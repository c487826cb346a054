// Numbers: how they are written, half floats, eccentricity, scales and ticks.

"use strict";

const clamp = (value, least, most) => Math.min(Math.max(value, least), most);

/** A score of the data as a number; a missing one is NaN. */
function number(score) {
  if (score === "inf") return Infinity;
  if (score === "-inf") return -Infinity;
  return typeof score === "number" ? score : NaN;
}

/** A number with the digits of its metric. */
function formatted(value, digits) {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const text = digits === undefined || digits === null ? String(Number(value.toPrecision(4))) : value.toFixed(digits);
  return text.replace(/^-/, "−");
}

/** A number with at most four significant digits. */
const formattedValue = (value) => formatted(value, undefined);

/** A value of a map with four significant digits, zeros at its end included, so that columns line up. */
const formattedBlock = (value) => (Number.isFinite(value) ? value.toPrecision(4).replace("-", "−") : formattedValue(value));

/** The number that 16 bits of an IEEE half float stand for. */
function halfFloat(bits) {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

/** The eccentricity in degrees of a point, by the same formulas as the scores. */
function eccentricityDeg(view, gaze, x, y) {
  const [fx, fy] = view.focal_px;
  let radians;
  if (view.eccentricity === "planar") {
    radians = Math.atan2(Math.hypot(x - gaze[0], y - gaze[1]), Math.sqrt(fx * fy));
  } else {
    // The cross product is of the difference of the rays, so that it is exact near the gaze.
    const [cx, cy] = view.principal_px;
    const [gx, gy] = [(gaze[0] - cx) / fx, (gaze[1] - cy) / fy];
    const [rx, ry] = [(x - cx) / fx, (y - cy) / fy];
    const [dx, dy] = [(x - gaze[0]) / fx, (y - gaze[1]) / fy];
    radians = Math.atan2(Math.hypot(dx, dy, dx * gy - dy * gx), 1 + rx * gx + ry * gy);
  }
  return (radians * 180) / Math.PI;
}

/** The index of the half-open band with this eccentricity, or -1. */
function bandIndex(edges, degrees) {
  for (let band = 0; band + 1 < edges.length; band++) {
    if (degrees >= edges[band] && degrees < edges[band + 1]) return band;
  }
  return -1;
}

/** Where a value lies on a scale: 0 is `none`, 1 is `most`; NaN has no place. */
function placeOnScale(scale, value) {
  const along = scale.kind === "log" ? Math.log10 : (number) => number;
  const [none, most] = [along(scale.none), along(scale.most)];
  return clamp((along(value) - none) / (most - none), 0, 1);
}

/** The value in the middle of a scale. */
function middleOfScale({ kind, none, most }) {
  return kind === "log" ? Math.sqrt(none * most) : (none + most) / 2;
}

/** Steps of 1, 2 or 5 times a power of ten: the multiples between two numbers, about `count`. */
function ticks(from, to, count, least = 0) {
  const rough = (to - from) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = Math.max(least, power * [1, 2, 5, 10].find((factor) => factor * power >= rough));
  const first = Math.ceil(from / step - 1e-9);
  const last = Math.floor(to / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, at) => (first + at) * step);
}
