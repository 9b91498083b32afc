#pragma once

#include <string_view>

namespace hlc::plot {

/// Begin of the page of a search. Colours of fates: those of Okabe and Ito, for any kind of colour
/// vision; marks and dashes differ, too.
inline constexpr std::string_view kSearchPageHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'">
<link rel="icon" href="data:,">
<title>What was searched</title>
<style>
:root {
  color-scheme: light dark;
  --page: #f6f6f4; --ground: #fff; --text: #16181a; --muted: #62666a; --line: #d4d4d0;
  --area: #dededa; --expanded: #0072b2; --collision: #d55e00; --bound: #8c8c88; --open: #cc79a7;
  --winner: #009e73; --second: #e69f00;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #16181a; --ground: #101214; --text: #eceeef; --muted: #9aa0a6; --line: #373b3f;
    --area: #33383c; --expanded: #56b4e9; --bound: #6c7176; --winner: #1fc093;
  }
}
body { margin: 1em auto; max-width: 70em; padding: 0 1em; background: var(--page); color: var(--text);
  font: 15px/1.4 system-ui, sans-serif; }
h1 { font-size: 20px; }
h2 { font-size: 16px; margin: 1.6em 0 .3em; }
p, li { overflow-wrap: anywhere; }
p, ul { margin: .3em 0; }
.result { font-weight: 600; }
.note, th, dd { color: var(--muted); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; margin: .5em 0; }
th, td { padding: 2px 10px; border-top: 1px solid var(--line); text-align: right; white-space: nowrap; }
th:first-child, td:first-child, td:last-child.words, th:last-child.words { text-align: left; }
th { font-weight: 400; }
dt { font-weight: 600; margin-top: .3em; }
dd { margin: 0 0 0 1.2em; }
svg.tree, svg.map { display: block; width: 100%; background: var(--ground); border: 1px solid var(--line); }
svg.map { max-height: min(85vh, 800px); }
svg.tree text { font-size: 13px; fill: var(--muted); }
svg.map text { fill: var(--text); stroke: var(--ground); stroke-width: .25em; paint-order: stroke;
  text-anchor: middle; dominant-baseline: central; font-family: inherit; }
path, line, circle { fill: none; stroke-linejoin: round; vector-effect: non-scaling-stroke; }
.grid { stroke: var(--line); }
.edge { stroke-width: 1; opacity: .5; }
.tree .edge { opacity: .28; }
.vertex { stroke-width: 5; stroke-linecap: round; }
.vertex.collision { stroke-width: 1.8; }
.vertex.bound, .vertex.open { stroke-width: 4.5; }
.expanded { stroke: var(--expanded); }
.collision { stroke: var(--collision); }
.edge.collision { stroke-dasharray: 4 3; }
.bound { stroke: var(--bound); }
.open { stroke: var(--open); }
.goal, .winner { stroke: var(--winner); }
.vertex.goal { stroke-width: 9; }
.winner { stroke-width: 4; }
.second { stroke: var(--second); stroke-width: 3.5; stroke-dasharray: 9 5; }
.cost { stroke-width: 1.5; }
.obstacle { fill: var(--area); stroke: var(--muted); fill-opacity: .6; }
.boundary { stroke: var(--text); stroke-width: 1.5; }
.car { stroke: var(--text); }
.reference { stroke: var(--text); stroke-dasharray: 1 4; stroke-linecap: round; stroke-width: 1.5; }
circle.reference { stroke-dasharray: none; }
.swept { fill: var(--winner); fill-opacity: .1; stroke: none; }
.legend span { margin-right: 1.2em; white-space: nowrap; }
.legend svg { width: 34px; height: 14px; vertical-align: middle; margin-right: 5px; }
</style>
</head>
<body>
)";

}  // namespace hlc::plot
