// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One line of a conversation with worlds (WorldLines): private to the room. Not thread-safe.

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/lined_json.h>
#include <robotlink/capi/world_lines.h>
#include <robotlink/capi/worlds.h>

namespace pitchboard::link {

using Json = nlohmann::ordered_json;

/// One line: reads what it asks for, does it, and fills the answer.
class WorldRequest {
 public:
  WorldRequest(WorldLines& lines, const JsonNode& node, JsonReport& report, Json& answer)
      : m_lines(lines),
        m_node(node),
        m_report(report),
        m_answer(answer),
        m_request(report, node, "") {}

  void carryOut();

  struct Verb {
    std::string_view name;
    void (WorldRequest::*carryOut)();
    std::vector<std::string_view> keys;
  };
  static const std::vector<Verb>& verbs();

 private:
  void create();
  void columns();
  void behaviour();
  void reset();
  void step();
  void read();
  void write();
  void placeRobot();
  void placeBall();
  void snapshot();
  void restore();
  void forget();
  void hashes();

  bool failed() const { return m_report.failed(); }
  void fail(const Error& error) { m_report.fail(1, "", error.text(), error.code); }
  void fail(std::string_view key, const std::string& text) { m_request.fail(key, text); }
  bool check(const Result<void>& done) {
    if (!done) fail(done.error());
    return done.has_value();
  }
  /// Null, and an error, before `create`.
  Worlds* worlds();
  int world(int fallback);
  RobotId robot() const;
  double number(std::string_view key) const;
  std::optional<std::vector<Variable>> variables();
  /// The numbers of nested lists of this shape; `absent` stands for null.
  template <class Value>
  std::optional<std::vector<Value>> values(std::string_view key, std::span<const std::size_t> shape,
                                           Value absent);
  template <class Value>
  void flatten(const JsonNode& node, const std::string& path, std::span<const std::size_t> shape,
               Value absent, std::vector<Value>& out);
  bool answerable(std::size_t size);
  template <class Value>
  static Json nested(std::span<const Value> values, std::span<const std::size_t> shape);

  WorldLines& m_lines;
  const JsonNode& m_node;
  JsonReport& m_report;
  Json& m_answer;
  JsonObject m_request;
};

}  // namespace pitchboard::link
