// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads JSON that people write, so that every error can name file, line and key: a tree that
// remembers the line of each value, and JsonObject, which refuses keys that it does not expect.
// After an error, reads return their fallbacks. Plain values; one thread at a time.

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <base/result.h>

namespace pitchboard {

struct JsonMember;

struct JsonNode {
  enum class Kind { Null, Boolean, Number, Text, Array, Object };

  Kind kind = Kind::Null;
  int line = 1;  ///< line of the value (of a member: of its key), from 1
  bool boolean = false;
  double number = 0.0;                 ///< finite
  std::optional<std::uint64_t> whole;  ///< exact value of a number without sign and point
  std::string text;
  std::vector<JsonNode> items;
  std::vector<JsonMember> members;  ///< in the order of the file

  const JsonNode* find(std::string_view key) const;
};

/// A key with its value. Not a std::pair, because some compilers reject a std::pair of the
/// incomplete type JsonNode.
struct JsonMember {
  std::string key;
  JsonNode value;
};

/// Collects errors. `source` is the name of the file.
class JsonReport {
 public:
  explicit JsonReport(std::string_view source) : m_source(source) {}

  /// Adds an error as "source:line: path: text"; one per place, at most twenty.
  void fail(int line, const std::string& path, const std::string& text,
            ErrorCode code = ErrorCode::ParseError);
  bool failed() const { return !m_errors.empty(); }
  std::size_t errors() const { return m_errors.size(); }
  /// Returns the first error.
  const Error& error() const { return m_errors.front(); }
  /// Returns all errors: the first, with the others in its message, a line each.
  Error allErrors() const;

 private:
  std::string m_source;
  std::vector<Error> m_errors;
};

/// Parses a text. Refuses more than `maxBytes`, nesting deeper than 64, duplicate keys, and
/// anything that is not JSON. Returns nothing exactly if `report` has an error.
std::optional<JsonNode> parseJson(std::string_view text, JsonReport& report,
                                  std::size_t maxBytes = std::size_t{1} << 20);

/// The range of a number. `unit` is in the plural, for people; empty for plain numbers.
struct NumberRange {
  double least = 0.0;
  double most = 0.0;
  std::string_view unit = {};
};

inline constexpr NumberRange anyNumber{std::numeric_limits<double>::lowest(),
                                       std::numeric_limits<double>::max()};

/// Reads one object of the file.
class JsonObject {
 public:
  /// Unknown keys are ignored.
  JsonObject(JsonReport& report, const JsonNode& node, std::string path);
  /// Keys that are not in `keys` are errors.
  JsonObject(JsonReport& report, const JsonNode& node, std::string path,
             std::span<const std::string_view> keys);
  JsonObject(JsonReport& report, const JsonNode& node, std::string path,
             std::initializer_list<std::string_view> keys)
      : JsonObject(report, node, std::move(path), std::span(keys.begin(), keys.size())) {}

  const JsonNode* find(std::string_view key) const { return m_node->find(key); }
  std::span<const JsonMember> members() const { return m_node->members; }
  int line() const { return m_node->line; }
  const std::string& path() const { return m_path; }
  std::string pathOf(std::string_view key) const;
  /// Reports an error about one of its keys, or about the object if the key is missing.
  void fail(std::string_view key, const std::string& text) const;
  /// Reports an error if the key is missing.
  void require(std::string_view key) const;

  // Each returns `fallback` if the key is missing.
  double number(std::string_view key, double fallback, const NumberRange& range) const;
  int integer(std::string_view key, int fallback, int least, int most) const;
  std::uint64_t unsignedInteger(std::string_view key, std::uint64_t fallback) const;
  bool boolean(std::string_view key, bool fallback) const;
  std::string text(std::string_view key, std::string fallback, std::size_t longest) const;
  /// Returns the index of the text in `known`; `what` is used as in "there is no team ...".
  std::optional<std::size_t> choice(std::string_view key, std::span<const std::string_view> known,
                                    std::string_view what) const;
  const std::vector<JsonNode>* array(std::string_view key, std::size_t most) const;
  /// Returns the path of an entry of an array: "robots[3]".
  std::string pathOf(std::string_view key, std::size_t entry) const;

 private:
  JsonReport* m_report;
  const JsonNode* m_node;
  std::string m_path;
};

/// Returns `there is no team "bleu"; did you mean "blue"?`, or all known names if none is similar.
std::string unknownName(std::string_view what, std::string_view name,
                        std::span<const std::string_view> known);

/// Returns the shortest decimal text that reads back to the same double.
std::string shortest(double value);

}  // namespace pitchboard
