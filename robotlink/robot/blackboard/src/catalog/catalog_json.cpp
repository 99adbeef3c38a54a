// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/blackboard/variable_catalog.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include <base/lined_json.h>

#include "catalog/catalog_reading.h"

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;

struct SegmentField {
  const char* name;
  int value;
};
// The layout is fixed by system.md section 2; a file may state it but not change it.
constexpr std::array<SegmentField, 5> segmentFields{
    {{"bytes", Blackboard::bytes},
     {"key_per_robot", 100},
     {"int_offset_words", 0},
     {"float_offset_words", Blackboard::floatOffset},
     {"word_bytes", 4}}};
constexpr const char* byteOrder = "native (little-endian on every known robot)";

constexpr std::string_view byteOrderKey = "byte_order";

/// The size and the place of the floats, where a segment is only looked at.
void readLayout(const JsonObject& segment, SegmentLayout& layout) {
  constexpr int most = static_cast<int>(SegmentLayout::maxBytes);
  const int bytes = segment.integer("bytes", static_cast<int>(layout.bytes), 4, most);
  if (bytes % 4 != 0) segment.fail("bytes", "must be a multiple of 4");
  layout.bytes = static_cast<std::size_t>(bytes);
  layout.floatOffset =
      segment.integer("float_offset_words", layout.floatOffset, 0, layout.words() - 1);
}

void checkSegment(JsonReport& report, const JsonNode& node, SegmentLayout& layout, bool anyLayout) {
  std::vector<std::string_view> keys{byteOrderKey};
  for (const SegmentField& field : segmentFields) keys.push_back(field.name);
  const JsonObject segment(report, node, "segment", keys);
  (void)segment.text(byteOrderKey, {}, maxCatalogBytes);
  if (anyLayout) return readLayout(segment, layout);
  for (const SegmentField& field : segmentFields) {
    const JsonNode* value = segment.find(field.name);
    if (!value || (value->kind == JsonNode::Kind::Number && value->number == field.value)) continue;
    report.fail(value->line, segment.pathOf(field.name),
                "must be " + std::to_string(field.value) +
                    ": other layouts cannot be shared with a robot's processes",
                ErrorCode::Unsupported);
  }
}

void readBlock(JsonReport& report, const JsonNode& node, const std::string& name, VariableType type,
               std::string_view source, std::vector<CatalogEntry>& entries) {
  const JsonObject block(report, node, name);
  for (const auto& [key, value] : block.members()) {
    if (value.kind != JsonNode::Kind::Number || value.number != std::trunc(value.number)) {
      return block.fail(key, "must be a whole number, the variable's index");
    }
    constexpr auto absurd = static_cast<double>(absurdIndex);
    entries.push_back({key, type, static_cast<long long>(std::clamp(value.number, -absurd, absurd)),
                       atLine(source, value.line) + ": " + block.pathOf(key)});
  }
}

}  // namespace

Result<VariableCatalog> VariableCatalog::fromJson(std::string_view text, std::string_view source) {
  SegmentLayout layout;
  return readJson(text, source, layout, false);
}

Result<VariableCatalog> VariableCatalog::readJson(std::string_view text, std::string_view source,
                                                  SegmentLayout& layout, bool anyLayout) {
  if (const auto error = checkCatalogText(text, source)) return tl::unexpected(*error);
  JsonReport report(source);
  std::vector<CatalogEntry> entries;
  if (const auto root = parseJson(text, report, maxCatalogBytes)) {
    const JsonObject top(report, *root, "", {"segment", "int", "float"});
    // In the order of the file, so that of two variables the later one is refused.
    for (const auto& [key, value] : top.members()) {
      if (key == "segment") checkSegment(report, value, layout, anyLayout);
      if (key == "int") readBlock(report, value, key, VariableType::Int, source, entries);
      if (key == "float") readBlock(report, value, key, VariableType::Float, source, entries);
    }
  }
  if (report.failed()) return tl::unexpected(report.error());
  return make(entries, source, layout);
}

std::string VariableCatalog::toJson(const SegmentLayout& layout) const {
  Json segment = Json::object();
  Json ints = Json::object();
  Json floats = Json::object();
  for (const SegmentField& field : segmentFields) segment[field.name] = field.value;
  segment["bytes"] = layout.bytes;
  segment["float_offset_words"] = layout.floatOffset;
  segment[byteOrderKey] = byteOrder;
  for (const Variable& variable : m_variables)
    (variable.type == VariableType::Int ? ints : floats)[variable.name] = variable.index;
  Json root = Json::object();
  root["segment"] = std::move(segment);
  root["int"] = std::move(ints);
  root["float"] = std::move(floats);
  return root.dump(1) + "\n";
}

}  // namespace pitchboard::link
