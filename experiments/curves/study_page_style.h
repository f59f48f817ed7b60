#pragma once

#include <string_view>

namespace irradiff {

/// What the page of a metric study adds to a figure's style sheet (experiments/figures/figure_page_style.h).
inline constexpr std::string_view kStudyPageStyle = R"css(
.stage { position: relative; max-width: 34rem; border: 1px solid var(--line); overflow: hidden; }
.stage img { display: block; width: 100%; image-rendering: pixelated; }
.stage .over { position: absolute; inset: 0; height: 100%; }
.divide { width: 100%; max-width: 34rem; margin: 0.4rem 0; }
.slider .scales { max-width: 34rem; }
.conclusion li { margin: 0.3rem 0; }
)css";

/// Makes two pictures of a section comparable. It takes them from the figures in the same section. No less-than signs,
/// so that the page can be checked as text.
inline constexpr std::string_view kStudyPageScript = R"js(
"use strict";
for (const slider of document.querySelectorAll(".slider")) {
  const figures = [...slider.parentElement.querySelectorAll("figure[data-name]")];
  if (figures.length === 0) continue;
  const find = name => slider.querySelector(name);
  const divide = find(".divide");
  const cut = () => { find(".over").style.clipPath = `inset(0 ${100 - divide.value}% 0 0)`; };
  for (const side of ["left", "right"]) {
    const select = find(`select.${side}`);
    for (const figure of figures) select.add(new Option(figure.dataset.name, figure.dataset.name));
    const show = () => {
      const figure = figures.find(f => f.dataset.name === select.value);
      find(side === "left" ? ".over" : ".under").src = figure.querySelector("img").src;
      const scales = [...figure.querySelectorAll(".scale")].map(scale => scale.cloneNode(true));
      find(`.scale-${side}`).replaceChildren(select.value, ...scales);
    };
    const first = figures.find(f => f.dataset.name === slider.dataset[side]) || figures[0];
    select.value = first.dataset.name;
    select.addEventListener("change", show);
    show();
  }
  divide.addEventListener("input", cut);
  cut();
  slider.hidden = false;
}
)js";

}  // namespace irradiff
