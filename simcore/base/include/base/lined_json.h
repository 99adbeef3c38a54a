// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// JSON written by people, read so that every complaint can name file, line and key: a small tree
// that remembers the line of each value, and an object reader that refuses whatever it was not told
// to expect. The first error wins; after it, reads return their fallbacks.

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
  int line = 1;  ///< where the value (of a member: its key) stands, from 1
  bool boolean = false;
  double number = 0.0;                 ///< finite
  std::optional<std::uint64_t> whole;  ///< exact value of a number written without sign and point
  std::string text;
  std::vector<JsonNode> items;
  std::vector<JsonMember> members;  ///< in the order of the file

  const JsonNode* find(std::string_view key) const;
};

/// A type of its own: a std::pair with the node that holds it cannot be made complete by every
/// compiler.
struct JsonMember {
  std::string key;
  JsonNode value;
};

/// Where complaints go. `source` is the name of the file.
class JsonReport {
 public:
  explicit JsonReport(std::string_view source) : m_source(source) {}

  /// Remembers an error as "source:line: path: text"; one of each place, at most twenty.
  void fail(int line, const std::string& path, const std::string& text,
            ErrorCode code = ErrorCode::ParseError);
  bool failed() const { return !m_errors.empty(); }
  std::size_t errors() const { return m_errors.size(); }
  /// The first one.
  const Error& error() const { return m_errors.front(); }
  /// All of them: the first, and in its message the others, a line each.
  Error allErrors() const;

 private:
  std::string m_source;
  std::vector<Error> m_errors;
};

/// Refuses more than `mostBytes`, nesting deeper than 64, a key that occurs twice in an object, and
/// anything that is not JSON. Nothing is returned exactly when `report` has an error.
std::optional<JsonNode> parseJson(std::string_view text, JsonReport& report,
                                  std::size_t mostBytes = std::size_t{1} << 20);

/// What a number may be. `unit` in the plural, for people; empty for plain numbers.
struct NumberRange {
  double least = 0.0;
  double most = 0.0;
  std::string_view unit = {};
};

inline constexpr NumberRange anyNumber{std::numeric_limits<double>::lowest(),
                                       std::numeric_limits<double>::max()};

/// One object of the file.
class JsonObject {
 public:
  /// Keys that it is not asked for are left alone.
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
  /// Complains about one of its keys, or about the object when the key is not there.
  void fail(std::string_view key, const std::string& text) const;
  /// Complains when the key is missing.
  void require(std::string_view key) const;

  // Each returns `fallback` when the key is missing.
  double number(std::string_view key, double fallback, const NumberRange& range) const;
  int integer(std::string_view key, int fallback, int least, int most) const;
  std::uint64_t unsignedInteger(std::string_view key, std::uint64_t fallback) const;
  bool boolean(std::string_view key, bool fallback) const;
  std::string text(std::string_view key, std::string fallback, std::size_t longest) const;
  /// Position of the text in `known`; `what` as in "there is no team ...".
  std::optional<std::size_t> choice(std::string_view key, std::span<const std::string_view> known,
                                    std::string_view what) const;
  const std::vector<JsonNode>* array(std::string_view key, std::size_t most) const;
  /// "robots[3]": the path of an entry of an array.
  std::string pathOf(std::string_view key, std::size_t entry) const;

 private:
  JsonReport* m_report;
  const JsonNode* m_node;
  std::string m_path;
};

/// `there is no team "bleu"; did you mean "blue"?`, or all known names when none is near.
std::string unknownName(std::string_view what, std::string_view name,
                        std::span<const std::string_view> known);

/// Shortest decimal form that reads back as the same double.
std::string shortest(double value);

}  // namespace pitchboard
