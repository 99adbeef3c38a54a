// SPDX-License-Identifier: GPL-3.0-or-later
// The arrays of a line: what is read becomes nested lists, and what is to be written is checked
// against the shape of the worlds.
#include <cmath>
#include <limits>
#include <type_traits>

#include "world_columns.h"
#include "world_request.h"

namespace pitchboard::link {

bool WorldRequest::answerable(std::size_t size) {
  if (size <= m_lines.m_limits.values) return true;
  fail("do", "would read " + std::to_string(size) + " values, more than the " +
                 std::to_string(m_lines.m_limits.values) + " of one answer; make fewer worlds");
  return false;
}

template <class Value>
Json WorldRequest::nested(std::span<const Value> values, std::span<const std::size_t> shape) {
  Json list = Json::array();
  const std::size_t part = shape[0] == 0 ? 0 : values.size() / shape[0];
  for (std::size_t i = 0; i < shape[0]; ++i) {
    if (shape.size() == 1) {
      list.push_back(values[i]);  // not a number becomes null
    } else {
      list.push_back(nested(values.subspan(i * part, part), shape.subspan(1)));
    }
  }
  return list;
}

void WorldRequest::read() {
  Worlds* const all = worlds();
  if (!all) return;
  constexpr std::array<std::string_view, 4> names{"percepts", "robots", "game", "boards"};
  const auto what = m_request.choice("what", names, "array");
  const std::size_t rows = all->count() * all->robots();
  if (failed()) return;
  if (what.has_value() == (m_request.find("variables") != nullptr)) {
    return fail("do", "read needs \"what\" or \"variables\"");
  }
  if (!what) {
    const auto wanted = variables();
    if (!wanted || !answerable(rows * wanted->size())) return;
    std::vector<double> out(rows * wanted->size());
    const std::array shape{all->count(), all->robots(), wanted->size()};
    if (check(all->readVariables(*wanted, out))) {
      m_answer["values"] = nested<double>(out, shape);
    }
    return;
  }
  if (names[*what] == "boards") {
    const std::array shape{all->count(), all->robots(), std::size_t{Blackboard::words}};
    if (!answerable(rows * Blackboard::words)) return;
    std::vector<std::uint32_t> out(rows * Blackboard::words);
    if (check(all->readBoards(out))) m_answer["values"] = nested<std::uint32_t>(out, shape);
    return;
  }
  const auto array = static_cast<WorldArray>(*what);
  if (!answerable(all->sizeOf(array))) return;
  std::vector<double> out(all->sizeOf(array));
  if (!check(all->read(array, out))) return;
  std::vector<std::size_t> shape{all->count(), all->robots(), columnsOf(array).size()};
  if (array == WorldArray::Game) shape.erase(shape.begin() + 1);
  m_answer["values"] = nested<double>(out, shape);
}

std::optional<std::vector<Variable>> WorldRequest::variables() {
  const auto* list = m_request.array("variables", 2 * Blackboard::words);
  if (!list) return {};
  std::vector<Variable> found;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto variable = worldVariable((*list)[i].text);
    if (!variable) {
      m_report.fail(1, m_request.pathOf("variables", i), variable.error().message);
      return {};
    }
    found.push_back(*variable);
  }
  if (!found.empty()) return found;
  fail("variables", "must have at least one name");
  return {};
}

template <class Value>
void WorldRequest::flatten(const JsonNode& node, const std::string& path,
                           std::span<const std::size_t> shape, Value absent,
                           std::vector<Value>& out) {
  if (failed()) return;
  if (shape.empty()) {
    if (node.kind == JsonNode::Kind::Null) return out.push_back(absent);
    if (node.kind != JsonNode::Kind::Number) {
      return m_report.fail(1, path, "must be a number, or null to leave what stands there");
    }
    if constexpr (std::is_integral_v<Value>) {
      if (!(node.number > static_cast<double>(absent) && node.number <= 2147483647.0 &&
            node.number == std::floor(node.number))) {
        return m_report.fail(1, path, "must be a whole number of 32 bits");
      }
    }
    return out.push_back(static_cast<Value>(node.number));
  }
  if (node.kind != JsonNode::Kind::Array || node.items.size() != shape[0]) {
    return m_report.fail(1, path, "must be a list of " + std::to_string(shape[0]));
  }
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    flatten(node.items[i], path + '[' + std::to_string(i) + ']', shape.subspan(1), absent, out);
  }
}

template <class Value>
std::optional<std::vector<Value>> WorldRequest::values(std::string_view key,
                                                       std::span<const std::size_t> shape,
                                                       Value absent) {
  m_request.require(key);
  if (failed()) return {};
  std::vector<Value> out;
  flatten(*m_request.find(key), m_request.pathOf(key), shape, absent, out);
  if (failed()) return {};
  return out;
}

void WorldRequest::write() {
  Worlds* const all = worlds();
  if (!all) return;
  const auto asked = [this](const char* key) { return m_request.find(key) != nullptr; };
  if (asked("variables") + asked("actions") + asked("commands") != 1) {
    return fail("do",
                "write needs one of \"variables\" (with \"values\"), \"actions\", \"commands\"");
  }
  if (asked("actions")) {
    const std::array shape{all->count(), all->robots()};
    const auto actions = values<std::int32_t>("actions", shape, Worlds::keep);
    if (actions) check(all->writeActions(*actions));
  } else if (asked("commands")) {
    const std::array shape{all->count(), all->robots(), commandColumns().size()};
    const auto commands = values<std::int32_t>("commands", shape, Worlds::keep);
    if (commands) check(all->writeCommands(*commands));
  } else {
    const auto wanted = variables();
    if (!wanted) return;
    const std::array shape{all->count(), all->robots(), wanted->size()};
    const auto numbers = values<double>("values", shape, std::numeric_limits<double>::quiet_NaN());
    if (numbers) check(all->writeVariables(*wanted, *numbers));
  }
}

}  // namespace pitchboard::link
