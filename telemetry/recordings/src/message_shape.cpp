// SPDX-License-Identifier: GPL-3.0-or-later
#include "message_shape.h"

#include <algorithm>
#include <array>
#include <set>

namespace pitchboard::telemetry {
namespace {

template <std::size_t N>
bool isOneOf(std::string_view name, const std::array<std::string_view, N>& names) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

void PathOut::leaveElement() {
  Element element = std::move(m_elements.back());
  m_elements.pop_back();
  const std::size_t begin = element.pathBegin, length = m_path.size() - begin;
  const std::string old = m_path.substr(begin);
  m_path.resize(begin);
  if (element.name.empty()) return;
  const std::string named = "[" + element.name + "]";
  for (std::size_t i = element.fieldBegin; i < m_shape->fields.size(); ++i) {
    std::string& path = m_shape->fields[i].path;
    if (path.compare(begin, length, old) == 0) path.replace(begin, length, named);
  }
}

std::shared_ptr<const RecordedShape> PathOut::finish() {
  std::set<std::string> taken;
  for (RecordedField& field : m_shape->fields) {
    const std::string path = field.path;
    for (int n = 2; !taken.insert(field.path).second; ++n) {
      field.path = path + " (" + std::to_string(n) + ")";
    }
  }
  return m_shape;
}

bool isElementName(std::string_view field) {
  static constexpr std::array<std::string_view, 4> names{"name", "child_frame_id", "joint_name",
                                                         "label"};
  return isOneOf(field, names);
}

bool isNameList(std::string_view field) {
  static constexpr std::array<std::string_view, 4> names{"name", "names", "joint_names",
                                                         "joint_name"};
  return isOneOf(field, names);
}

bool isStampName(std::string_view field) {
  static constexpr std::array<std::string_view, 2> names{"stamp", "timestamp"};
  return isOneOf(field, names);
}

}  // namespace pitchboard::telemetry
