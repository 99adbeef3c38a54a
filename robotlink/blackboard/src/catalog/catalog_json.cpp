// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/blackboard/variable_catalog.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "catalog/catalog_reading.h"

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;

struct SegmentField {
  const char* name;
  int value;
};
// The layout is fixed by SYSTEM.md section 2; a file may state it but not change it.
constexpr std::array<SegmentField, 5> segmentFields{
    {{"bytes", Blackboard::bytes},
     {"key_per_robot", 100},
     {"int_offset_words", 0},
     {"float_offset_words", Blackboard::floatOffset},
     {"word_bytes", 4}}};
constexpr const char* byteOrder = "native (little-endian on every known robot)";

std::string atPath(std::string_view source, const std::string& path) {
  return std::string(source) + ": " + path;
}

std::optional<Error> checkSegment(const Json& segment, std::string_view source) {
  if (!segment.is_object())
    return Error{ErrorCode::ParseError, "must be an object", atPath(source, "segment")};
  for (const auto& [key, value] : segment.items()) {
    const std::string where = atPath(source, "segment." + key);
    if (key == "byte_order") {
      if (!value.is_string()) return Error{ErrorCode::ParseError, "must be a text", where};
      continue;
    }
    const auto* const field =
        std::find_if(segmentFields.begin(), segmentFields.end(),
                     [&name = key](const SegmentField& f) { return name == f.name; });
    if (field == segmentFields.end())
      return Error{ErrorCode::ParseError, "is not a key of a variable map", where};
    if (!value.is_number_integer() || value != field->value)
      return Error{ErrorCode::Unsupported,
                   "must be " + std::to_string(field->value) +
                       ": other layouts cannot be shared "
                       "with a robot's processes",
                   where};
  }
  return std::nullopt;
}

// nlohmann keeps the last of two equal keys; for a variable map that hides a mistake. It also looks
// keys up one by one, so a hostile file with very many of them is cut short.
class KeyCheck {
 public:
  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    const auto level = static_cast<std::size_t>(std::max(depth, 0));
    if (event == Json::parse_event_t::object_start) {
      m_keys.resize(std::max(m_keys.size(), level + 2));
      m_path.resize(m_keys.size());
      m_keys[level + 1].clear();
    } else if (event == Json::parse_event_t::key && m_found.empty() && level < m_keys.size()) {
      const auto& key = parsed.get_ref<const std::string&>();
      m_path[level] = key;
      if (++m_count > maxKeys) return false;
      if (!m_keys[level].insert(key).second) {
        for (std::size_t i = 1; i <= level; ++i)
          m_found += (i > 1 && !m_path[i].empty() ? "." : "") + m_path[i];
      }
    }
    return true;
  }
  /// Path of the first key that is there twice.
  const std::string& found() const { return m_found; }
  bool tooMany() const { return m_count > maxKeys; }

 private:
  static constexpr int maxKeys = 4096;
  int m_count = 0;
  std::vector<std::set<std::string>> m_keys;
  std::vector<std::string> m_path;
  std::string m_found;
};

std::optional<Error> readBlock(const Json& block, const std::string& name, VariableType type,
                               std::string_view source, std::vector<CatalogEntry>& entries) {
  if (!block.is_object())
    return Error{ErrorCode::ParseError, "must be an object of names and indices",
                 atPath(source, name)};
  for (const auto& [key, value] : block.items()) {
    const std::string where = atPath(source, name + "." + key);
    CatalogEntry entry{key, type, 0, where};
    if (value.is_number_unsigned())
      entry.index = static_cast<long long>(std::min<std::uint64_t>(
          value.get<std::uint64_t>(), static_cast<std::uint64_t>(absurdIndex)));
    else if (value.is_number_integer())
      entry.index = value.get<long long>();
    else
      return Error{ErrorCode::ParseError, "must be a whole number, the variable's index", where};
    entries.push_back(std::move(entry));
  }
  return std::nullopt;
}

}  // namespace

Result<VariableCatalog> VariableCatalog::fromJson(std::string_view text, std::string_view source) {
  if (const auto error = checkCatalogText(text, source)) return tl::unexpected(*error);
  KeyCheck keys;
  Json root;
  try {
    root = Json::parse(text, [&keys](int depth, Json::parse_event_t event, Json& parsed) {
      return keys(depth, event, parsed);
    });
  } catch (const Json::parse_error& error) {
    const std::string_view before = text.substr(0, error.byte > 0 ? error.byte - 1 : 0);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    return failure(ErrorCode::ParseError, "this is not JSON: check the text before this place",
                   atLine(source, static_cast<int>(line)));
  } catch (const Json::exception&) {
    // A number too large for a double is the one other thing the parser refuses.
    return failure(ErrorCode::ParseError, "a number in it is too large", std::string(source));
  }
  if (keys.tooMany())
    return failure(ErrorCode::ParseError, "has far more keys than a blackboard has words",
                   std::string(source));
  if (!keys.found().empty())
    return failure(ErrorCode::ParseError, "is there twice", atPath(source, keys.found()));
  if (!root.is_object())
    return failure(ErrorCode::ParseError, "must be an object with the keys \"int\" and \"float\"",
                   std::string(source));

  std::vector<CatalogEntry> entries;
  for (const auto& [key, value] : root.items()) {
    std::optional<Error> error;
    if (key == "segment")
      error = checkSegment(value, source);
    else if (key == "int")
      error = readBlock(value, key, VariableType::Int, source, entries);
    else if (key == "float")
      error = readBlock(value, key, VariableType::Float, source, entries);
    else
      error = Error{ErrorCode::ParseError,
                    "is not a key of a variable map; it has \"segment\", \"int\" and \"float\"",
                    atPath(source, key)};
    if (error) return tl::unexpected(*error);
  }
  return make(entries, source);
}

std::string VariableCatalog::toJson() const {
  Json segment = Json::object();
  Json ints = Json::object();
  Json floats = Json::object();
  for (const SegmentField& field : segmentFields) segment[field.name] = field.value;
  segment["byte_order"] = byteOrder;
  for (const Variable& variable : m_variables)
    (variable.type == VariableType::Int ? ints : floats)[variable.name] = variable.index;
  Json root = Json::object();
  root["segment"] = std::move(segment);
  root["int"] = std::move(ints);
  root["float"] = std::move(floats);
  return root.dump(1) + "\n";
}

}  // namespace pitchboard::link
