#pragma once

#include <string_view>

namespace irradiff {

/// The page's style sheet: system fonts, one column on a phone, tables that turn into cards there, smaller in print.
inline constexpr std::string_view kPageStyle = R"css(
:root { color-scheme: light; --ink: #1a1a1a; --soft: #5a5a5a; --line: #d9d9d9; --tint: #f5f6f8; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.2rem 1rem 4rem; max-width: 72rem; color: var(--ink); background: #fff;
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 0.2rem 0 0.6rem; }
h2 { font-size: 1.25rem; margin: 2.6rem 0 0.6rem; padding-top: 0.6rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.05rem; margin: 1.6rem 0 0.3rem; }
p, ul { max-width: 46rem; margin: 0.5rem 0; }
a { color: #0b5394; }
code, pre { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; font-size: 0.85em; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; background: var(--tint); padding: 0.5rem; margin: 0.3rem 0;
  max-width: 46rem; user-select: all; }
.soft { color: var(--soft); font-size: 0.9rem; }
.verdict { padding: 0.8rem 1rem; margin: 1rem 0; border-left: 6px solid; }
.verdict p { margin: 0.15rem 0; max-width: none; }
.verdict p:first-child { font-size: 1.15rem; font-weight: 600; }
.verdict.right { border-color: #1b7f3b; background: #eef7f0; }
.verdict.wrong { border-color: #b3261e; background: #fcefee; }
.badge { display: inline-block; padding: 0 0.45em; border-radius: 0.3em; font-size: 0.85rem; white-space: nowrap; }
.badge.right { background: #d9f0df; color: #0b5523; }
.badge.wrong { background: #f8d4d1; color: #7d120c; font-weight: 600; }
.badge.none { background: #e9e9ec; color: #44444c; }
nav ul { list-style: none; padding: 0; display: flex; flex-wrap: wrap; gap: 0.2rem 1.2rem; }
.whole { white-space: nowrap; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; margin: 0.6rem 0; font-size: 0.9rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: 0.25rem 0.9rem 0.25rem 0; border-bottom: 1px solid var(--line); }
th { color: var(--soft); font-weight: 600; vertical-align: bottom; }
details { margin: 0.4rem 0; }
summary { cursor: pointer; }
td details { margin: 0; }
td pre { min-width: 22rem; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(20rem, 1fr)); gap: 1rem; }
figure { margin: 0; min-width: 0; }
figure svg { width: 100%; height: auto; }
@media screen and (max-width: 48rem) {
  .plots { grid-template-columns: 1fr; }
  thead { display: none; }
  table, tbody, tr, td { display: block; width: 100%; }
  tr { padding: 0.5rem 0; border-bottom: 1px solid var(--line); }
  td { display: flex; justify-content: space-between; gap: 1rem; border: 0; padding: 0.05rem 0; text-align: right; }
  td::before { content: attr(data-column); color: var(--soft); text-align: left; flex: 0 1 auto; max-width: 60%; }
  td:first-child { font-weight: 600; text-align: left; }
  td:first-child .soft { font-weight: 400; }
  td:first-child::before { content: none; }
  td > span { min-width: 0; }
  .badge { white-space: normal; }
  td pre { text-align: left; min-width: 0; }
}
@media print {
  :root { font-size: 9.5pt; }
  body { max-width: none; font-size: 1rem; padding: 0; }
  nav, .screen { display: none; }
  .scroll { overflow: visible; }
  pre { min-width: 0; }
  h2, h3 { break-after: avoid; }
  figure, tr { break-inside: avoid; }
  .verdict { border: 1px solid #000; border-left-width: 6px; }
}
)css";

}  // namespace irradiff
