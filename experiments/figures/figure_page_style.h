#pragma once

#include <string_view>

namespace irradiff {

/// What the page of a figure adds to the report's style sheet (verification/report/page_style.h).
inline constexpr std::string_view kFigurePageStyle = R"css(
.choices { display: flex; flex-wrap: wrap; gap: 0.4rem 1.5rem; margin: 0.6rem 0; }
select { font: inherit; }
.compared { display: grid; grid-template-columns: minmax(0, 34rem) minmax(16rem, 1fr); gap: 0.4rem 1.5rem; }
#stage { position: relative; overflow: hidden; touch-action: pan-y; cursor: crosshair; border: 1px solid var(--line); }
#stage img { display: block; width: 100%; image-rendering: pixelated; transform-origin: 0 0; }
#clip { position: absolute; inset: 0; overflow: hidden; }
#divider { position: absolute; top: 0; bottom: 0; width: 2px; margin-left: -1px; background: #000;
  box-shadow: 0 0 0 1px #fff; pointer-events: none; }
#cross { position: absolute; width: 11px; height: 11px; margin: -6px 0 0 -6px; border: 2px solid #fff; border-radius: 50%;
  outline: 1px solid #000; pointer-events: none; }
#divide { width: 100%; margin: 0.4rem 0; }
.tools { display: flex; align-items: center; gap: 0.5rem; margin: 0 0 0.5rem; }
button { font: inherit; padding: 0.1rem 0.7rem; }
#scale { min-width: 3.5rem; text-align: center; font-variant-numeric: tabular-nums; }
.scales { display: grid; grid-template-columns: 1fr 1fr; gap: 0 1.5rem; font-size: 0.9rem; overflow-wrap: anywhere; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0 1rem; margin: 0.3rem 0; font-size: 0.9rem;
  font-variant-numeric: tabular-nums; }
dt { color: var(--soft); }
dd { margin: 0; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(18rem, 100%), 1fr)); gap: 1.4rem; }
.pictures img { display: block; width: 100%; image-rendering: pixelated; border: 1px solid var(--line); }
.bar { height: 0.8rem; margin-top: 0.4rem; border: 1px solid var(--line); }
.ticks { display: flex; justify-content: space-between; font-size: 0.85rem; font-variant-numeric: tabular-nums; }
figcaption { margin-top: 0.3rem; font-size: 0.9rem; }
@media (max-width: 48rem) { .compared { grid-template-columns: minmax(0, 1fr); } }
@media print {
  .pictures { grid-template-columns: repeat(3, 1fr); gap: 0.8rem; }
  .bar, .pictures img { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
)css";

}  // namespace irradiff
