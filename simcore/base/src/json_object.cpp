// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numeric>

#include <base/lined_json.h>
#include <base/nearest_name.h>

namespace pitchboard {
namespace {

constexpr std::size_t maxListed = 24;

/// Edits (insert, delete, replace) between two names, letters compared without their case.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

/// The name that shares its first letters with `name`, at least four and half of them: "decide" for
/// "decision". The one with the fewest edits, if there are several.
std::string_view withSameBeginning(std::string_view name, std::span<const std::string_view> known) {
  std::string_view best;
  for (const std::string_view candidate : known) {
    const auto [end, unused] = std::ranges::mismatch(name, candidate);
    const auto common = static_cast<std::size_t>(end - name.begin());
    if (common < 4 || 2 * common < name.size()) continue;
    if (best.empty() || editDistance(name, candidate) < editDistance(name, best)) best = candidate;
  }
  return best;
}

/// The name that ends with `name`, or else has it in it: "ball_dist" for "VISION_BALL_DIST". The
/// shortest, if there are several.
std::string_view around(std::string_view name, std::span<const std::string_view> known) {
  constexpr std::size_t leastLetters = 4;
  if (name.size() < leastLetters) return {};
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  };
  std::string_view best;
  bool bestEnds = false;
  for (const std::string_view candidate : known) {
    if (std::search(candidate.begin(), candidate.end(), name.begin(), name.end(), same) ==
        candidate.end()) {
      continue;
    }
    const bool ends =
        std::ranges::equal(candidate.substr(candidate.size() - name.size()), name, same);
    if (best.empty() || ends > bestEnds || (ends == bestEnds && candidate.size() < best.size())) {
      best = candidate;
      bestEnds = ends;
    }
  }
  return best;
}

}  // namespace

std::string_view nearestName(std::string_view name, std::span<const std::string_view> known) {
  if (name.size() > 64) return {};
  std::string_view best;
  // At least one letter must be right; two swapped letters count as two edits.
  std::size_t least = std::min(std::max<std::size_t>(2, name.size() / 3) + 1, name.size());
  for (const std::string_view candidate : known) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  if (best.empty()) best = withSameBeginning(name, known);
  return best.empty() ? around(name, known) : best;
}

namespace {

std::string hint(std::string_view name, std::span<const std::string_view> known) {
  if (const std::string_view near = nearestName(name, known); !near.empty()) {
    return "did you mean \"" + std::string(near) + "\"?";
  }
  std::string list = "known are ";
  const std::size_t listed = std::min(known.size(), maxListed);
  for (std::size_t i = 0; i < listed; ++i) {
    list += (i == 0 ? "" : ", ") + std::string(known[i]);
  }
  if (listed < known.size()) list += " and " + std::to_string(known.size() - listed) + " others";
  return list;
}

/// For messages: without an exponent where a person would write none.
std::string plain(double value) {
  if (std::abs(value) >= 1e15) return shortest(value);
  std::array<char, 40> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  return {buffer.data(), end.ptr};
}

std::string shortened(std::string_view text) {
  return text.size() <= 64 ? std::string(text) : std::string(text.substr(0, 61)) + "...";
}

}  // namespace

std::string unknownName(std::string_view what, std::string_view name,
                        std::span<const std::string_view> known) {
  return "there is no " + std::string(what) + " \"" + shortened(name) + "\"; " + hint(name, known);
}

std::string shortest(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

JsonObject::JsonObject(JsonReport& report, const JsonNode& node, std::string path)
    : m_report(&report), m_node(&node), m_path(std::move(path)) {
  if (node.kind != JsonNode::Kind::Object) {
    report.fail(node.line, m_path, "must be an object in braces");
  }
}

JsonObject::JsonObject(JsonReport& report, const JsonNode& node, std::string path,
                       std::span<const std::string_view> keys)
    : JsonObject(report, node, std::move(path)) {
  for (const auto& [name, value] : node.members) {
    if (std::ranges::find(keys, name) == keys.end()) {
      report.fail(value.line, pathOf(shortened(name)), "unknown key; " + hint(name, keys));
      return;
    }
  }
}

std::string JsonObject::pathOf(std::string_view key) const {
  return m_path.empty() ? std::string(key) : m_path + '.' + std::string(key);
}

std::string JsonObject::pathOf(std::string_view key, std::size_t entry) const {
  return pathOf(key) + '[' + std::to_string(entry) + ']';
}

void JsonObject::fail(std::string_view key, const std::string& text) const {
  const JsonNode* value = find(key);
  m_report->fail(value ? value->line : m_node->line, pathOf(key), text);
}

void JsonObject::require(std::string_view key) const {
  if (m_node->kind == JsonNode::Kind::Object && !find(key)) fail(key, "is missing");
}

double JsonObject::number(std::string_view key, double fallback, const NumberRange& range) const {
  const JsonNode* value = find(key);
  if (!value) return fallback;
  const std::string unit(range.unit);
  if (value->kind != JsonNode::Kind::Number) {
    fail(key, unit.empty() ? "must be a number" : "must be a number in " + unit);
    return fallback;
  }
  if (!std::isfinite(value->number) || value->number < range.least || value->number > range.most) {
    fail(key, "must lie between " + plain(range.least) + " and " + plain(range.most) +
                  (unit.empty() ? "" : ' ' + unit));
    return fallback;
  }
  return value->number;
}

int JsonObject::integer(std::string_view key, int fallback, int least, int most) const {
  const JsonNode* value = find(key);
  if (!value) return fallback;
  const bool whole =
      value->kind == JsonNode::Kind::Number && value->number == std::trunc(value->number);
  if (!whole || value->number < least || value->number > most) {
    fail(key,
         "must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return fallback;
  }
  return static_cast<int>(value->number);
}

std::uint64_t JsonObject::unsignedInteger(std::string_view key, std::uint64_t fallback) const {
  const JsonNode* value = find(key);
  if (!value) return fallback;
  if (!value->whole) {
    fail(key, "must be a whole number from 0 to 18446744073709551615");
    return fallback;
  }
  return *value->whole;
}

bool JsonObject::boolean(std::string_view key, bool fallback) const {
  const JsonNode* value = find(key);
  if (!value) return fallback;
  if (value->kind != JsonNode::Kind::Boolean) {
    fail(key, "must be true or false");
    return fallback;
  }
  return value->boolean;
}

std::string JsonObject::text(std::string_view key, std::string fallback,
                             std::size_t longest) const {
  const JsonNode* value = find(key);
  if (!value) return fallback;
  if (value->kind != JsonNode::Kind::Text) {
    fail(key, "must be text in quotes");
    return fallback;
  }
  if (value->text.size() > longest) {
    fail(key, "must not be longer than " + std::to_string(longest) + " bytes");
    return fallback;
  }
  return value->text;
}

std::optional<std::size_t> JsonObject::choice(std::string_view key,
                                              std::span<const std::string_view> known,
                                              std::string_view what) const {
  const JsonNode* value = find(key);
  if (!value) return {};
  if (value->kind != JsonNode::Kind::Text) {
    fail(key, "must be the name of a " + std::string(what) + ", in quotes");
    return {};
  }
  const auto found = std::ranges::find(known, value->text);
  if (found == known.end()) {
    fail(key, unknownName(what, value->text, known));
    return {};
  }
  return static_cast<std::size_t>(found - known.begin());
}

const std::vector<JsonNode>* JsonObject::array(std::string_view key, std::size_t most) const {
  const JsonNode* value = find(key);
  if (!value) return nullptr;
  if (value->kind != JsonNode::Kind::Array) {
    fail(key, "must be a list in square brackets");
    return nullptr;
  }
  if (value->items.size() > most) {
    fail(key, "must not have more than " + std::to_string(most) + " entries");
    return nullptr;
  }
  return &value->items;
}

}  // namespace pitchboard
