// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Shared parts of our HTML pages: the style sheet (colours as in docs/design-language.md), escaped
// text, numbers that do not depend on the locale. Pure functions; any thread.

#include <string>
#include <string_view>

namespace pitchboard::link {

/// Returns a number with this many decimals, such as "61.5", or "—" if it is not finite.
std::string fixed(double value, int decimals);
/// Escapes text for content and attributes of HTML, XML and SVG.
std::string escaped(std::string_view text);

inline constexpr std::string_view reportStyle = R"css(
:root { color-scheme: light dark;
  --page: #eff0f2; --card: #ffffff; --line: #cfd3d8; --text: #22262b; --quiet: #636b75;
  --blue: #2f6fc6; --red: #c2413c; --black: #4a5058; --orange: #c96f16; --yellow: #a68a00;
  --good: #3f8a5e; --bad: #c02f2a; --accent: #5f4bb6; --track: #e6e8eb; }
@media (prefers-color-scheme: dark) { :root {
  --page: #212428; --card: #2b2e32; --line: #3d4248; --text: #dfe3e8; --quiet: #9ba3ad;
  --blue: #4f8fe3; --red: #d8605b; --black: #8b939d; --orange: #e8a25c; --yellow: #d8c04a;
  --good: #5c9f78; --bad: #f2726b; --accent: #a594f5; --track: #3a3f45; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--text);
  font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
main { max-width: 1040px; margin: 0 auto; padding: 32px 24px 64px; }
h1 { font-size: 28px; line-height: 1.2; margin: 0 0 4px; }
h2 { font-size: 18px; margin: 40px 0 12px; }
p { margin: 0 0 8px; }
.quiet, figcaption, th, .axis { color: var(--quiet); }
.note { border-left: 3px solid var(--accent); padding: 4px 12px; margin: 16px 0 0; }
.score { display: flex; flex-wrap: wrap; gap: 16px; margin-top: 24px; }
.team { flex: 1 1 200px; background: var(--card); border: 1px solid var(--line);
  border-top: 4px solid var(--c); border-radius: 6px; padding: 12px 16px; }
.team b { display: block; font-size: 40px; line-height: 1.1; font-variant-numeric: tabular-nums; }
figure { margin: 0; background: var(--card); border: 1px solid var(--line); border-radius: 6px;
  padding: 12px; }
figure img { display: block; width: 100%; height: auto; border-radius: 3px; }
figcaption { font-size: 13px; margin-top: 8px; }
.scroll { overflow-x: auto; background: var(--card); border: 1px solid var(--line);
  border-radius: 6px; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { padding: 7px 12px; text-align: right; white-space: nowrap; }
th { font-weight: 600; font-size: 13px; border-bottom: 1px solid var(--line);
  white-space: normal; }
tbody tr + tr td { border-top: 1px solid var(--line); }
th.l, td.l { text-align: left; white-space: normal; }
.badge { display: inline-block; min-width: 34px; padding: 0 8px; border-radius: 10px;
  background: var(--c); color: #fff; font-weight: 700; font-size: 13px; text-align: center; }
@media (prefers-color-scheme: dark) { .badge { color: #16181b; } }
.blue { --c: var(--blue); } .red { --c: var(--red); } .black { --c: var(--black); }
.orange { --c: var(--orange); } .yellow { --c: var(--yellow); }
.low { color: var(--bad); font-weight: 700; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(300px, 1fr)); gap: 16px; }
.charts h3 { font-size: 14px; margin: 0 0 4px; display: flex; justify-content: space-between; }
.charts h3 span:last-child { font-weight: 400; }
svg.chart { display: block; width: 100%; height: auto; overflow: visible; }
.axis { font-size: 11px; fill: currentColor; }
.grid { stroke: var(--line); stroke-width: 1; }
.curve { fill: none; stroke: var(--c); stroke-width: 1.6; stroke-linejoin: round; }
.area { fill: var(--c); opacity: .16; }
.bar { fill: var(--c); } .track { fill: var(--track); }
.figures { background: var(--card); border: 1px solid var(--line); border-radius: 6px;
  padding: 12px 16px; margin-top: 16px; }
.figures div:not(.duel) { display: flex; justify-content: space-between; gap: 12px; }
.figures b { flex: 1; font-variant-numeric: tabular-nums; } .figures b:last-child { text-align: right; }
.figures span { color: var(--quiet); }
.duel { display: flex; gap: 2px; height: 5px; margin: 2px 0 8px; }
.duel i { background: var(--c); border-radius: 2px; } .duel.none i { background: var(--track); }
.pictures { display: grid; gap: 16px; grid-template-columns: repeat(auto-fill, minmax(280px, 1fr)); }
.pictures.small { grid-template-columns: repeat(auto-fill, minmax(min(46%, 200px), 1fr)); }
.pictures svg { display: block; width: 100%; height: auto; border-radius: 3px; }
a { color: var(--accent); }
table.sorts th { cursor: pointer; } th[aria-sort=ascending]::after { content: " ▲"; }
th[aria-sort=descending]::after { content: " ▼"; } table.sorts th:focus-visible { outline: 2px solid var(--accent); }
details summary { cursor: pointer; color: var(--accent); margin: 12px 0; }
footer { margin-top: 48px; font-size: 13px; color: var(--quiet); }
@media print { body { background: #fff; } main { max-width: none; padding: 0; }
  figure, .team, .figures, tr { break-inside: avoid; } h2, h2 + p { break-after: avoid; }
  .scroll { overflow: visible; } td, th { padding: 3px 6px; font-size: 12px; }
  details { display: block; } }
@media (max-width: 480px) { main { padding: 16px 12px 32px; } h1 { font-size: 22px; }
  .score { gap: 8px; } .team { flex-basis: 120px; padding: 8px 12px; } .team b { font-size: 32px; }
  td, th { padding: 6px 8px; } }
)css";

/// Sorts tables of the class "sorts" by a click or Enter on a heading; the only script of a page.
inline constexpr std::string_view reportScript = R"js(
document.querySelectorAll('table.sorts th').forEach(function (th) {
  th.tabIndex = 0;
  function sort() {
    var column = th.cellIndex, body = th.closest('table').tBodies[0];
    var up = th.getAttribute('aria-sort') !== 'ascending';
    th.parentNode.querySelectorAll('th').forEach(function (o) { o.removeAttribute('aria-sort'); });
    th.setAttribute('aria-sort', up ? 'ascending' : 'descending');
    function key(row) {
      var cell = row.cells[column], text = cell.dataset.v || cell.textContent;
      var number = parseFloat(text);
      return isNaN(number) ? text : number;
    }
    Array.from(body.rows).sort(function (a, b) {
      var x = key(a), y = key(b);
      var order = typeof x === 'number' && typeof y === 'number' ? x - y
                                                               : String(x).localeCompare(String(y));
      return up ? order : -order;
    }).forEach(function (row) { body.appendChild(row); });
  }
  th.addEventListener('click', sort);
  th.addEventListener('keydown', function (e) { if (e.key === 'Enter') sort(); });
});
)js";

}  // namespace pitchboard::link
