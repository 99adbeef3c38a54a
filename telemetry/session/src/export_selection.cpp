// SPDX-License-Identifier: GPL-3.0-or-later
#include "export_selection.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include <telemetry/series/group_order.h>

namespace pitchboard::telemetry {
namespace {

constexpr std::array<std::string_view, 5> formats{"csv-wide", "csv-long", "jsonl", "mcap",
                                                  "csv-even"};

/// `*` stands for any letters, also none. Linear in the text for every star.
bool matches(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = std::string_view::npos, mark = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      mark = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++mark;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace

Result<ExportFormat> exportFormat(std::string_view name) {
  const auto found = std::ranges::find(formats, name);
  if (found != formats.end()) return static_cast<ExportFormat>(found - formats.begin());
  return failure(ErrorCode::InvalidArgument,
                 "There is no format \"" + std::string(name.substr(0, 40)) +
                     "\". Choose csv-wide, csv-even, csv-long, jsonl, mcap, report, svg, png, mp4 "
                     "or webm.");
}

Result<void> checkRange(TimeRange range) {
  if (range.begin <= range.end) return {};
  char text[120];
  std::snprintf(text, sizeof text, "The range ends before it begins: from %g s until %g s.",
                range.begin, range.end);
  return failure(ErrorCode::InvalidArgument, text);
}

Result<std::vector<SelectedGroup>> resolveSelection(const SessionReader& session,
                                                    const ExportSelection& selection) {
  if (const auto range = checkRange(selection.range); !range) return tl::unexpected(range.error());
  std::vector<SelectedGroup> out(session.groups().size());
  for (const std::string& robot : selection.robots) {
    bool found = false;
    std::string known;
    for (const std::size_t g : listedOrder(session.groups(), &SessionGroup::info)) {
      const std::string& name = session.groups()[g].info.name;
      found = found || name == robot;
      known += (known.empty() ? "" : ", ") + name;
    }
    if (!found) {
      return failure(ErrorCode::NotFound, "The session has no robot \"" + robot + "\"; it has " +
                                              (known.empty() ? std::string("none") : known) + ".");
    }
  }
  std::vector<bool> used(selection.variables.size(), false);
  for (std::size_t g = 0; g < out.size(); ++g) {
    const GroupInfo& info = session.groups()[g].info;
    out[g].selected = selection.robots.empty() ||
                      std::find(selection.robots.begin(), selection.robots.end(), info.name) !=
                          selection.robots.end();
    std::size_t words = 0, values = 0;
    for (std::size_t c = 0; c < info.columns.size(); ++c) {
      const ColumnInfo& column = info.columns[c];
      const std::size_t index = column.type == ColumnType::Float64 ? values++ : words++;
      bool wanted = selection.variables.empty();
      for (std::size_t v = 0; v < selection.variables.size(); ++v) {
        if (!out[g].selected || !matches(selection.variables[v], column.name)) continue;
        wanted = used[v] = true;
      }
      if (!wanted) continue;
      const bool isText = column.kind == ColumnKind::Text && column.type == ColumnType::Float64;
      out[g].columns.push_back({c, column.type, index, isText ? &column.labels : nullptr});
    }
    out[g].selected = out[g].selected && !out[g].columns.empty();
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) continue;
    return failure(ErrorCode::NotFound, "The selected robots have no variable \"" +
                                            selection.variables[v] +
                                            "\"; a * stands for any letters.");
  }
  return out;
}

Result<void> checkSelection(const SessionReader& session, const ExportSelection& selection) {
  const auto resolved = resolveSelection(session, selection);
  if (!resolved) return tl::unexpected(resolved.error());
  return {};
}

}  // namespace pitchboard::telemetry
