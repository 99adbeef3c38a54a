// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/field_text.h>

#include <algorithm>
#include <cstdio>

#include <simcore/world/parameter_reading.h>

namespace pitchboard::sim {
namespace {

constexpr std::size_t maxNameLength = 64;

std::string jsonText(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
      out += code;
      continue;
    }
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

/// Adds the members that `base` has otherwise.
template <class Values, std::size_t N>
void addDifferences(std::vector<std::string>& out,
                    const std::array<Parameter<Values>, N>& parameters, const Values& values,
                    const Values& base) {
  for (const auto& parameter : parameters) {
    const double value = values.*parameter.member;
    if (value == base.*parameter.member) continue;
    out.push_back(jsonText(parameter.key) + ":" + shortest(parameter.written(value)));
  }
}

std::vector<std::string> differences(const FieldSpec& field, const FieldSpec& base) {
  std::vector<std::string> out;
  addDifferences(out, fieldParameters, field, base);
  addDifferences(out, surfaceParameters, field.surface, base.surface);
  return out;
}

}  // namespace

std::vector<std::string_view> fieldNames() {
  std::vector<std::string_view> names;
  for (const FieldSpec& field : builtInFields()) names.push_back(field.name);
  return names;
}

FieldSpec readField(JsonReport& report, const JsonNode& node, const std::string& path) {
  FieldSpec field;
  const JsonObject object(report, node, path,
                          withKeys(withKeys({"name", "base"}, fieldParameters), surfaceParameters));
  if (const auto base = object.choice("base", fieldNames(), "field")) {
    field = builtInFields()[*base];
  }
  field.name = object.text("name", "custom", maxNameLength);
  readNumbers(object, fieldParameters, field);
  readNumbers(object, surfaceParameters, field.surface);
  if (const auto valid = validate(field); !valid)
    report.fail(node.line, path, valid.error().message);
  return field;
}

Result<FieldSpec> fieldFromText(std::string_view nameOrJson, std::string_view source) {
  if (nameOrJson.find('{') == std::string_view::npos) {
    const std::vector<std::string_view> known = fieldNames();
    const auto found = std::ranges::find(known, nameOrJson);
    if (found != known.end()) {
      return builtInFields()[static_cast<std::size_t>(found - known.begin())];
    }
    return failure(ErrorCode::NotFound, unknownName("field", nameOrJson, known),
                   std::string(source));
  }
  JsonReport report(source);
  const auto root = parseJson(nameOrJson, report);
  FieldSpec field;
  if (root) field = readField(report, *root, "field");
  if (report.failed()) return tl::unexpected(report.error());
  return field;
}

std::string fieldToText(const FieldSpec& field) {
  const FieldSpec* base = nullptr;
  std::vector<std::string> least;
  for (const FieldSpec& built : builtInFields()) {
    if (built == field) return std::string(field.name);
    std::vector<std::string> changed = differences(field, built);
    if (base && changed.size() >= least.size()) continue;
    base = &built;
    least = std::move(changed);
  }
  std::string out = "{\"name\":" + jsonText(field.name) + ",\"base\":" + jsonText(base->name);
  for (const std::string& member : least) out += ',' + member;
  return out + '}';
}

}  // namespace pitchboard::sim
