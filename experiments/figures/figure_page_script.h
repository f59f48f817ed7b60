#pragma once

#include <string_view>

namespace irradiff {

/// Makes the comparison of two pictures work: it takes the pictures from the page's figures and the values from the
/// element `map-data` (figure_page.cpp). It has no less-than signs, so that the page can be checked as text.
inline constexpr std::string_view kFigurePageScript = R"js(
"use strict";
const byId = id => document.getElementById(id);
const data = JSON.parse(byId("map-data").textContent);
const floats = text => new Float32Array(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
const channels = data.channels.map(c => ({name: c.name, unit: c.unit, values: floats(c.values)}));
const stage = byId("stage"), divide = byId("divide");
const sides = {left: byId("over"), right: byId("under")};
const clamp = (value, last) => Math.min(Math.max(value, 0), last);
// What is shown of both pictures: from `left` and `top`, as shares of them, enlarged by `scale`.
const zoom = {scale: 1, left: 0, top: 0};
const largestScale = 64;
// The place among the values that are here, from the lower left.
let column = Math.floor(data.columns / 2), row = Math.floor(data.rows / 2);

for (const figure of document.querySelectorAll("figure[data-name]")) {
  for (const side of ["left", "right"]) {
    byId(side).add(new Option(figure.dataset.name, figure.dataset.name));
  }
}
const figureOf = side => document.querySelector(`figure[data-name="${byId(side).value}"]`);
const showSide = side => {
  sides[side].src = figureOf(side).querySelector("img").src;
};
// A picture may name the channels that belong to it.
const isRead = name => ["left", "right"].some(side => {
  const names = figureOf(side).dataset.values;
  return names === undefined || names.split(" ").includes(name);
});
const showDivider = () => {
  byId("clip").style.clipPath = `inset(0 ${100 - divide.value}% 0 0)`;
  byId("divider").style.left = `${divide.value}%`;
};
const showValues = () => {
  const share = [(Math.floor((column + 0.5) * data.width / data.columns) + 0.5) / data.width,
                 (Math.floor((row + 0.5) * data.height / data.rows) + 0.5) / data.height];
  const position = data.origin.map((o, i) => o + share[0] * data.u[i] + share[1] * data.v[i]);
  byId("place").textContent = `At (${position.map(p => p.toFixed(4)).join(", ")}) m`;
  byId("cross").style.left = `${100 * (share[0] - zoom.left) * zoom.scale}%`;
  byId("cross").style.top = `${100 * (1 - share[1] - zoom.top) * zoom.scale}%`;
  for (const channel of channels) {
    const cell = byId(`value-${channel.name}`);
    cell.hidden = cell.previousElementSibling.hidden = !isRead(channel.name);
    const value = channel.values[row * data.columns + column];
    const text = Number.isNaN(value) ? "does not exist here"
      : channel.unit === "" ? (value === 1 ? "yes" : "no")
      : channel.unit === "1" ? value.toPrecision(5) : `${value.toPrecision(5)} ${channel.unit}`;
    cell.textContent = text;
  }
};
const showZoom = () => {
  zoom.left = clamp(zoom.left, 1 - 1 / zoom.scale);
  zoom.top = clamp(zoom.top, 1 - 1 / zoom.scale);
  const shift = share => -100 * share * zoom.scale;
  for (const picture of Object.values(sides)) {
    picture.style.transform = `translate(${shift(zoom.left)}%, ${shift(zoom.top)}%) scale(${zoom.scale})`;
  }
  showValues();
};
// Where an event is in the stage, as shares from the upper left.
const placeOf = event => {
  const box = stage.getBoundingClientRect();
  return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
};
// Enlarges about a place in the stage, which stays where it is.
const zoomAt = ([x, y], factor) => {
  const scale = Math.max(1, Math.min(largestScale, zoom.scale * factor));
  zoom.left += x / zoom.scale - x / scale;
  zoom.top += y / zoom.scale - y / scale;
  zoom.scale = scale;
  showZoom();
};
const pick = event => {
  if (event.type === "pointermove" && event.buttons === 1) {
    const box = stage.getBoundingClientRect();
    zoom.left -= event.movementX / box.width / zoom.scale;
    zoom.top -= event.movementY / box.height / zoom.scale;
    showZoom();
    return;
  }
  const [x, y] = placeOf(event);
  column = clamp(Math.floor((zoom.left + x / zoom.scale) * data.columns), data.columns - 1);
  row = clamp(Math.floor((1 - zoom.top - y / zoom.scale) * data.rows), data.rows - 1);
  showValues();
};
const steps = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1]};
stage.addEventListener("pointermove", pick);
stage.addEventListener("pointerdown", pick);
stage.addEventListener("wheel", event => {
  event.preventDefault();
  zoomAt(placeOf(event), Math.exp(-0.002 * event.deltaY));
}, {passive: false});
const zooms = {"+": 1.5, "=": 1.5, "-": 1 / 1.5, "0": 1 / largestScale};
stage.addEventListener("keydown", event => {
  const factor = zooms[event.key];
  if (factor) zoomAt([0.5, 0.5], factor);
  const step = steps[event.key];
  if (!step) return;
  event.preventDefault();
  column = clamp(column + step[0], data.columns - 1);
  row = clamp(row + step[1], data.rows - 1);
  showValues();
});
divide.addEventListener("input", showDivider);
for (const side of ["left", "right"]) {
  byId(side).addEventListener("change", () => {
    showSide(side);
    showValues();
  });
  byId(side).value = data[side];
}
byId("compare").hidden = false;
showSide("left");
showSide("right");
showDivider();
showZoom();
)js";

}  // namespace irradiff
