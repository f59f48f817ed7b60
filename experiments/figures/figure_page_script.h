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
  const scales = [...figureOf(side).querySelectorAll(".scale")].map(scale => scale.cloneNode(true));
  byId(`scale-${side}`).replaceChildren(byId(side).value, ...scales);
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
// Of the place, as shares of the picture from the lower left.
const placeShare = () => [(Math.floor((column + 0.5) * data.width / data.columns) + 0.5) / data.width,
                          (Math.floor((row + 0.5) * data.height / data.rows) + 0.5) / data.height];
const showValues = () => {
  const share = placeShare();
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
  byId("scale").textContent = `${zoom.scale.toPrecision(3)} x`;
  // A finger scrolls the page while there is nothing to move.
  stage.style.touchAction = zoom.scale === 1 ? "pan-y" : "none";
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
// The place in the stage; at its edge where it is outside.
const mark = () => {
  const [x, y] = placeShare();
  return [clamp((x - zoom.left) * zoom.scale, 1), clamp((1 - y - zoom.top) * zoom.scale, 1)];
};
let grabbed = null;  // where the pictures are held while they are dragged
const pick = event => {
  const [x, y] = placeOf(event);
  if (grabbed && event.buttons === 1 && zoom.scale !== 1) {
    zoom.left -= (x - grabbed[0]) / zoom.scale;
    zoom.top -= (y - grabbed[1]) / zoom.scale;
    grabbed = [x, y];
    showZoom();
    return;
  }
  grabbed = event.type === "pointerdown" ? [x, y] : null;
  column = clamp(Math.floor((zoom.left + x / zoom.scale) * data.columns), data.columns - 1);
  row = clamp(Math.floor((1 - zoom.top - y / zoom.scale) * data.rows), data.rows - 1);
  showValues();
};
// Moves by receivers; what is enlarged follows.
const step = (columns, rows) => {
  column = clamp(column + columns, data.columns - 1);
  row = clamp(row + rows, data.rows - 1);
  const [x, y] = placeShare();
  const follow = (start, share) => Math.min(Math.max(start, share - 0.95 / zoom.scale), share - 0.05 / zoom.scale);
  zoom.left = follow(zoom.left, x);
  zoom.top = follow(zoom.top, 1 - y);
  showZoom();
};
const keys = {
  ArrowLeft: () => step(-1, 0), ArrowRight: () => step(1, 0), ArrowDown: () => step(0, -1), ArrowUp: () => step(0, 1),
  "+": () => zoomAt(mark(), 1.5), "=": () => zoomAt(mark(), 1.5), "-": () => zoomAt(mark(), 1 / 1.5),
  "0": () => zoomAt(mark(), 1 / largestScale),
};
stage.addEventListener("pointermove", pick);
stage.addEventListener("pointerdown", pick);
stage.addEventListener("wheel", event => {
  // Over the whole picture the wheel scrolls the page on.
  if (zoom.scale === 1 && event.deltaY >= 0) return;
  event.preventDefault();
  zoomAt(placeOf(event), Math.exp(-0.002 * event.deltaY));
}, {passive: false});
stage.addEventListener("keydown", event => {
  const act = keys[event.key];
  // With these keys, the browser's own zoom.
  if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  act();
});
byId("nearer").addEventListener("click", keys["+"]);
byId("farther").addEventListener("click", keys["-"]);
byId("whole").addEventListener("click", keys["0"]);
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
