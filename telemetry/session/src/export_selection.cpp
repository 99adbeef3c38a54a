// SPDX-License-Identifier: GPL-3.0-or-later
#include "export_selection.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include <base/nearest_name.h>
#include <base/try.h>
#include <base/wildcard.h>
#include <telemetry/series/group_order.h>

namespace pitchboard::telemetry {
namespace {

constexpr std::array<std::string_view, 5> formats{"csv-wide", "csv-long", "jsonl", "mcap",
                                                  "csv-even"};

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
    const std::vector<GroupId> groups = TRY(session.groupsNamed(robot));
    for (const GroupId group : groups) out[group].selected = true;
  }
  std::vector<bool> used(selection.variables.size(), false);
  for (std::size_t g = 0; g < out.size(); ++g) {
    const GroupInfo& info = session.groups()[g].info;
    out[g].selected = out[g].selected || selection.robots.empty();
    std::size_t words = 0, values = 0;
    for (std::size_t c = 0; c < info.columns.size(); ++c) {
      const ColumnInfo& column = info.columns[c];
      const std::size_t index = column.type == ColumnType::Float64 ? values++ : words++;
      std::optional<std::size_t> wanted;
      if (selection.variables.empty()) wanted = 0;
      for (std::size_t v = 0; v < selection.variables.size(); ++v) {
        if (!out[g].selected || !fitsWildcard(selection.variables[v], column.name)) continue;
        used[v] = true;
        if (!wanted) wanted = v;
      }
      if (!wanted) continue;
      const bool isText = column.kind == ColumnKind::Text && column.type == ColumnType::Float64;
      out[g].columns.push_back({c, column.type, index, *wanted, isText ? &column.labels : nullptr});
    }
    out[g].selected = out[g].selected && !out[g].columns.empty();
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) continue;
    std::vector<std::string_view> known;
    for (std::size_t g = 0; g < out.size(); ++g) {
      const GroupInfo& info = session.groups()[g].info;
      if (!selection.robots.empty() &&
          std::ranges::find(selection.robots, info.name) == selection.robots.end())
        continue;
      for (const ColumnInfo& column : info.columns) known.push_back(column.name);
    }
    const std::string_view near = nearestName(selection.variables[v], known);
    return failure(ErrorCode::NotFound,
                   "The selected robots have no variable \"" + selection.variables[v] + "\"" +
                       (near.empty() ? "; a * stands for any letters."
                                     : "; did you mean \"" + std::string(near) + "\"?"));
  }
  return out;
}

Result<void> checkSelection(const SessionReader& session, const ExportSelection& selection) {
  const auto resolved = resolveSelection(session, selection);
  if (!resolved) return tl::unexpected(resolved.error());
  return {};
}

}  // namespace pitchboard::telemetry
