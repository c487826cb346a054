// The viewer of report.html: reference, methods and maps of a frame on the same stage. Its files are one
// script on the page; this is the first. This one makes and finds elements.
//
// The data are the JSON in #viewer-data. All text reaches the page as text, never as HTML, so names may
// contain any character. Positions are in pixels of the full frame: (0, 0) is the top-left corner of the
// first pixel, whose centre is at (0.5, 0.5).

"use strict";

/** The element with the id `viewer-NAME`. */
const byId = (name) => document.getElementById(`viewer-${name}`);

/** Makes an HTML element with properties and children. */
function element(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

/** Makes an SVG element with attributes and text. */
function svgElement(tag, attributes = {}, text = "") {
  const node = document.createElementNS(byId("curve").namespaceURI, tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.textContent = text;
  return node;
}

/** Fills a select with options `{value, text, group}`; `group` may be absent. */
function fillSelect(select, options, value) {
  select.replaceChildren();
  const groups = new Map();
  for (const { value, text, group } of options) {
    if (group && !groups.has(group)) {
      groups.set(group, element("optgroup", { label: group }));
      select.append(groups.get(group));
    }
    (groups.get(group) ?? select).append(element("option", { value, textContent: text }));
  }
  select.value = value;
  select.disabled = options.length < 2;
}
