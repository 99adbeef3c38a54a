// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/topic_groups.h>

#include <algorithm>
#include <limits>

namespace pitchboard::link {
namespace {

using telemetry::ColumnInfo;
using telemetry::ColumnKind;
using telemetry::ColumnType;
using telemetry::RecordedField;
using telemetry::RecordedKind;

constexpr std::size_t maxKeptLayouts = 1000;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr double longStepBack = 0.05;  // s; less is disorder on the way
constexpr const char* changingLabel = "(text in the log)";

ColumnKind kindOf(RecordedKind kind) {
  switch (kind) {
    case RecordedKind::Flag:
      return ColumnKind::Flag;
    case RecordedKind::Enumeration:
      return ColumnKind::Enumeration;
    case RecordedKind::Text:
      return ColumnKind::Text;
    default:
      return ColumnKind::Number;
  }
}

bool isHeader(const RecordedField& field) {
  return field.path == "stamp" || field.path == "timestamp" || field.path.starts_with("header.");
}

/// "pose" of "pose.position.x", "transforms" of "transforms[base].x": a list in lists of variables.
std::string categoryOf(const std::string& path) {
  const auto end = path.find_first_of(".[");
  return end == path.npos ? std::string("Message") : path.substr(0, end);
}

}  // namespace

std::string TopicGroups::freeName(const std::string& name, const std::string& origin) {
  if (m_names.insert(name).second) return name;
  const std::string base = origin.empty() ? name : name + " (" + origin + ")";
  std::string free = base;
  for (int n = 2; !m_names.insert(free).second; ++n) free = base + " (" + std::to_string(n) + ")";
  return free;
}

TopicGroups::Group& TopicGroups::groupOf(std::size_t source, const telemetry::RecordedTopic& topic,
                                         std::size_t index, const std::string& origin) {
  if (source >= m_groups.size()) m_groups.resize(source + 1);
  if (index >= m_groups[source].size()) m_groups[source].resize(index + 1);
  auto& group = m_groups[source][index];
  if (!group) {
    group = std::make_unique<Group>();
    const auto begin = topic.name.find_first_not_of('/');
    group->info.name = freeName(
        begin == topic.name.npos ? std::string("topic") : topic.name.substr(begin), origin);
  }
  return *group;
}

const TopicGroups::Layout& TopicGroups::layoutOf(Group& group,
                                                 const telemetry::RecordedMessage& message) {
  if (group.layout != nullptr && group.layout->shape == message.shape) return *group.layout;
  if (const auto known = group.layouts.find(message.shape.get()); known != group.layouts.end()) {
    group.layout = &known->second;
    return known->second;
  }
  if (group.layouts.size() >= maxKeptLayouts) group.layouts.clear();
  Layout& layout = group.layouts[message.shape.get()];
  layout.shape = message.shape;
  layout.isTextOnly = !message.texts.empty();
  bool hasText = false, changed = false;
  for (const RecordedField& field : message.shape->fields) {
    const bool isText = field.kind == RecordedKind::Text;
    layout.isTextOnly = layout.isTextOnly && (isText || isHeader(field));
    hasText = hasText || (isText && !isHeader(field));
    const auto known = group.columns.find(field.path);
    if (known != group.columns.end()) {
      layout.columns.push_back(known->second);
      continue;
    }
    if (group.info.columns.size() >= maxColumns) {
      layout.columns.push_back(noColumn);
      continue;
    }
    const auto place = static_cast<std::uint32_t>(group.info.columns.size());
    group.columns[field.path] = place;
    layout.columns.push_back(place);
    group.info.columns.push_back({field.path, ColumnType::Float64, field.unit,
                                  categoryOf(field.path), kindOf(field.kind), field.labels});
    changed = true;
  }
  layout.isTextOnly = layout.isTextOnly && hasText;
  sortFields(group, layout);
  group.layout = &layout;
  if (changed || !group.isKnown) {
    group.id = m_rows.addGroup(group.info);
    group.isKnown = true;
  }
  return layout;
}

void TopicGroups::sortFields(const Group& group, Layout& layout) {
  layout.isInOrder = true;
  for (std::uint32_t i = 0; i < layout.columns.size(); ++i) {
    const std::uint32_t column = layout.columns[i];
    const bool isText = layout.shape->fields[i].kind == RecordedKind::Text;
    // A text whose column has numbers is left out, a number in a column of texts is its code.
    const bool fits =
        column != noColumn && (!isText || group.info.columns[column].kind == ColumnKind::Text);
    if (isText) layout.texts.push_back({i, fits ? column : noColumn});
    if (!fits) ++layout.refused;
    layout.isInOrder = layout.isInOrder && column == i;
  }
}

void TopicGroups::logLine(const Group& group, double time, std::string text) {
  LogLine line;
  line.time = time;
  line.origin = group.info.name;
  line.text = std::move(text);
  m_log(std::move(line));
  ++m_logLines;
}

double TopicGroups::codeOf(Group& group, std::uint32_t column, std::string_view text, double time,
                           bool isLogged) {
  Texts& texts = group.texts[column];
  if (texts.code >= 0.0 && texts.coded == text) return texts.code;
  const auto known = texts.codes.find(text);
  if (known == texts.codes.end() && !texts.keepsChanging) {
    texts.keepsChanging = texts.codes.size() == maxLabels;
    const int code = static_cast<int>(texts.codes.size());
    auto& labels = group.info.columns[column].labels;
    labels[code] = texts.keepsChanging ? std::string(changingLabel) : std::string(text);
    if (!texts.keepsChanging) texts.codes.emplace(text, code);
    group.id = m_rows.addGroup(group.info);
    if (!texts.keepsChanging) return code;
  } else if (known != texts.codes.end()) {
    texts.coded = known->first;
    texts.code = known->second;
    return texts.code;
  }
  if (!isLogged && texts.last != text) {
    texts.last = text;
    logLine(group, time, group.info.columns[column].name + ": " + texts.last);
  }
  return static_cast<double>(maxLabels);
}

void TopicGroups::logTexts(const Group& group, const telemetry::RecordedMessage& message,
                           double time) {
  std::string line;
  std::size_t text = 0, count = 0;
  const auto& fields = message.shape->fields;
  const auto isShown = [](const RecordedField& field) {
    return field.kind == RecordedKind::Text && !isHeader(field);
  };
  const bool isOne = std::ranges::count_if(fields, isShown) == 1;
  for (const RecordedField& field : fields) {
    if (field.kind != RecordedKind::Text) continue;
    const std::string_view value = message.texts[text++];
    if (!isShown(field)) continue;
    if (count++ > 0) line += ", ";
    if (!isOne) line += field.path + ": ";
    line += value;
  }
  logLine(group, time, std::move(line));
}

void TopicGroups::fillRow(Group& group, const Layout& layout,
                          const telemetry::RecordedMessage& message, std::size_t columns) {
  group.refused += layout.refused;
  if (layout.isInOrder) {
    group.row.assign(message.values.begin(), message.values.end());
    group.row.resize(columns, missing);
    return;
  }
  group.row.assign(columns, missing);
  for (std::size_t i = 0; i < message.values.size(); ++i) {
    if (layout.columns[i] != noColumn) group.row[layout.columns[i]] = message.values[i];
  }
}

void TopicGroups::take(std::size_t source, const telemetry::RecordedTopic& topic,
                       const telemetry::RecordedMessage& message, double time,
                       const std::string& origin) {
  Group& group = groupOf(source, topic, message.topic, origin);
  if (message.shape->fields.empty()) {
    ++group.empty;
    return;
  }
  const Layout& layout = layoutOf(group, message);
  if (time < group.lastTime) {
    if (group.lastTime - time > longStepBack) ++group.late;
    time = group.lastTime;
  }
  group.lastTime = time;
  if (layout.isTextOnly) logTexts(group, message, time);
  const std::size_t columns = group.info.columns.size();
  if (layout.isInOrder && layout.texts.empty() && message.values.size() == columns) {
    m_rows.append(group.id, {time, {}, message.values});
    return;
  }
  fillRow(group, layout, message, columns);
  std::size_t text = 0;
  for (const auto& [field, column] : layout.texts) {
    const std::string_view shown = message.texts[text++];
    if (column != noColumn) {
      group.row[column] = codeOf(group, column, shown, time, layout.isTextOnly);
    }
  }
  m_rows.append(group.id, {time, {}, group.row});
}

std::vector<const TopicGroups::Group*> TopicGroups::allGroups() const {
  std::vector<const Group*> groups;
  for (const auto& source : m_groups) {
    for (const auto& group : source) {
      if (group) groups.push_back(group.get());
    }
  }
  return groups;
}

void TopicGroups::addNotes(std::vector<std::string>& notes) const {
  const auto many = [](std::uint64_t count, const char* what) {
    return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
  };
  for (const Group* group : allGroups()) {
    if (group->empty > 0) {
      notes.push_back(group->info.name + ": " + many(group->empty, "message") +
                      " without values (the type has no fields).");
    }
    if (group->late > 0) {
      notes.push_back(group->info.name + ": " + many(group->late, "message") +
                      " older than the one before; the time of that one is used.");
    }
    if (group->refused > 0) {
      notes.push_back(group->info.name + ": " + many(group->refused, "value") +
                      " left out, because a topic has at most " + std::to_string(maxColumns) +
                      " variables, each of one kind.");
    }
  }
}

std::uint64_t TopicGroups::variables() const {
  std::uint64_t sum = 0;
  for (const Group* group : allGroups()) sum += group->info.columns.size();
  return sum;
}

}  // namespace pitchboard::link
