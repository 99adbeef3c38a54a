// SPDX-License-Identifier: GPL-3.0-or-later
// VariablesModel: reading values, and how they are shown.
#include <QColor>
#include <algorithm>
#include <cmath>

#include <ui/base/theme.h>

#include "variable_node.h"
#include "variable_text.h"
#include "variables_model.h"

namespace pitchboard::ui {
namespace {

using telemetry::ColumnKind;
using telemetry::ColumnType;
using telemetry::Sample;
using telemetry::SeriesBucket;

bool same(const SeriesBucket& a, const SeriesBucket& b) {
  const auto equal = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return equal(a.min, b.min) && equal(a.max, b.max) && equal(a.last, b.last) &&
         (a.samples == 0) == (b.samples == 0);
}

// How much the value changed over the last second of samples.
double changePerSecond(const telemetry::GroupView& view, std::uint32_t column,
                       const Sample& newest) {
  constexpr double span = 1.0;
  const auto before = view.at(column, newest.time - span);
  if (!before || before->time >= newest.time) return std::nan("");
  return (newest.value - before->value) / (newest.time - before->time);
}

// Text that grows only as fast as a person reads.
QString shownAge(double seconds) {
  constexpr double steps = 10.0;
  return ageText(std::floor(std::max(0.0, seconds) * steps) / steps);
}

}  // namespace

void VariablesModel::takeTime() {
  if (m_moment)
    m_now = *m_moment;
  else if (const auto range = m_store->range())
    m_now = range->end;
}

void VariablesModel::lookAt(VariableNode& group) {
  if (group.round == m_round) return;
  group.round = m_round;
  // Null once the group was replaced: its last rows stand until updateGroups().
  if (auto view = m_store->view(group.group)) group.view = std::move(view);
  group.rowsPerSecond = group.view->rate();
  if (const auto range = group.view->range()) group.newest = range->end;
}

bool VariablesModel::read(VariableNode& variable, int sparkPixels) const {
  const VariableNode& group = *variable.owner();
  const telemetry::GroupView& view = *group.view;
  const auto newest = m_moment ? view.at(variable.column, *m_moment) : view.latest(variable.column);
  bool changed = newest.has_value() != variable.known;
  variable.known = newest.has_value();
  if (!newest) return changed;
  const bool sameValue =
      newest->value == variable.value || (std::isnan(newest->value) && std::isnan(variable.value));
  changed = changed || !sameValue;
  variable.value = newest->value;
  if (variable.info.kind == ColumnKind::Number) {
    const double rate = changePerSecond(view, variable.column, *newest);
    changed = changed || rate != variable.ratePerSecond;
    variable.ratePerSecond = rate;
  }
  if (const auto last = view.lastChange(variable.column)) variable.lastChange = *last;
  // Only the last change of all is known; of a past moment before it the age is not.
  QString age = variable.lastChange <= m_now ? shownAge(m_now - variable.lastChange) : QString();
  changed = changed || age != variable.ageShown;
  variable.ageShown = std::move(age);
  if (sparkPixels <= 0) return changed;
  // The window moves by whole pixels: buckets keep their samples and the line does not shimmer.
  const double pixel = sparkSeconds() / sparkPixels;
  const double end = std::floor(m_now / pixel + 1) * pixel;
  QList<SeriesBucket> spark(sparkPixels);
  view.buckets(variable.column, {end - sparkSeconds(), end},
               std::span(spark.data(), static_cast<std::size_t>(sparkPixels)));
  if (!std::equal(spark.begin(), spark.end(), variable.spark.begin(), variable.spark.end(), same)) {
    changed = true;
    variable.spark = std::move(spark);
  }
  return changed;
}

void VariablesModel::refresh(const QModelIndexList& rows, int sparkPixels) {
  if (!m_store) return;
  ++m_round;
  takeTime();
  std::vector<VariableNode*> changed;
  for (const QModelIndex& index : rows) {
    if (!index.isValid()) continue;
    VariableNode* row = node(index);
    VariableNode* group = row->owner();
    const double rate = group->rowsPerSecond;
    lookAt(*group);
    if (row->kind == Kind::Variable ? read(*row, sparkPixels)
                                    : row->kind == Kind::Group && rate != group->rowsPerSecond) {
      changed.push_back(row);
    }
  }
  std::sort(changed.begin(), changed.end(), [](const VariableNode* a, const VariableNode* b) {
    return std::pair(a->parent, a->row) < std::pair(b->parent, b->row);
  });
  for (std::size_t first = 0; first < changed.size();) {
    std::size_t last = first;
    while (last + 1 < changed.size() && changed[last + 1]->parent == changed[first]->parent &&
           changed[last + 1]->row <= changed[last]->row + 1) {
      ++last;
    }
    emit dataChanged(indexOf(changed[first], Value), indexOf(changed[last], columns - 1));
    first = last + 1;
  }
}

void VariablesModel::refreshAll() {
  if (!m_store) return;
  ++m_round;
  takeTime();
  for (const auto& group : m_groups) {
    lookAt(*group);
    for (const auto& category : group->children) {
      bool changed = false;
      for (const auto& variable : category->children) {
        if (variable->kind == Kind::Variable) changed = read(*variable, 0) || changed;
      }
      if (changed) {
        emit dataChanged(indexOf(category->children.front().get(), Value),
                         indexOf(category->children.back().get(), columns - 1));
      }
    }
  }
}

void VariablesModel::refreshChanges() {
  if (!m_store) return;
  ++m_round;
  takeTime();
  for (const auto& group : m_groups) {
    lookAt(*group);
    forEachVariable(*group, [&group](VariableNode& variable) {
      if (const auto last = group->view->lastChange(variable.column)) variable.lastChange = *last;
    });
  }
}

void VariablesModel::lookForSet(VariableNode& group) {
  const auto range = group.view->range();
  if (!range) return;
  bool any = false;
  forEachVariable(group, [&](VariableNode& variable) {
    if (variable.wasSet) return;
    const auto newest = group.view->latest(variable.column);
    if (!newest) return;
    // What was set and taken back between two looks has changed all the same.
    const bool zero = newest->value == 0.0 || std::isnan(newest->value);
    if (zero && group.view->lastChange(variable.column).value_or(range->begin) <= range->begin) {
      return;
    }
    variable.wasSet = true;
    --variable.parent->neverSet;
    any = true;
  });
  if (any) ++m_setRevision;
}

void VariablesModel::refreshSet(const QModelIndexList& rows) {
  if (!m_store || m_groups.empty()) return;
  std::vector<VariableNode*> groups{m_groups[m_nextGroup++ % m_groups.size()].get()};
  for (const QModelIndex& index : rows) {
    VariableNode* group = node(index)->owner();
    if (group != groups.back()) groups.push_back(group);
  }
  for (VariableNode* group : groups) {
    if (auto view = m_store->view(group->group)) group->view = std::move(view);
    const std::uint64_t before = m_setRevision;
    lookForSet(*group);
    if (before == m_setRevision) continue;
    for (const auto& category : group->children) {
      const QModelIndex rest = indexOf(category->children.back().get(), Name);
      emit dataChanged(rest, rest);
    }
  }
}

QString VariablesModel::restText(const VariableNode& row) const {
  const int count = row.parent->neverSet;
  const QString words = count == 1 ? QStringLiteral("1 variable never set")
                                   : QStringLiteral("%1 variables never set").arg(count);
  return m_restShown.contains(row.parent->path) ? QStringLiteral("Fold ") + words : words;
}

double VariablesModel::rateOf(const VariableNode& group) const {
  return m_notes.value(group.name).rate.value_or(group.rowsPerSecond);
}

QVariant VariablesModel::display(const VariableNode& row, int column) const {
  if (row.kind == Kind::Rest) return column == Name ? restText(row) : QString();
  if (column == Name) {
    const QString note = row.kind == Kind::Group ? m_notes.value(row.name).trouble : QString();
    return note.isEmpty() ? row.name : row.name + QStringLiteral(" · ") + note;
  }
  if (row.kind == Kind::Group) {
    const double rate = rateOf(row);
    if (column == Value && rate > 0) return QString::number(rate, 'f', rate < 10 ? 1 : 0);
    return column == Unit && rate > 0 ? QStringLiteral("/s") : QString();
  }
  if (row.kind == Kind::Category) return {};
  switch (column) {
    case Value:
      return row.known ? valueText(row.info, row.value) : QString();
    case Unit: {
      const QString words = row.known ? wordsOf(row.info, row.value) : QString();
      return words.isEmpty() ? QString::fromStdString(row.info.unit) : words;
    }
    case Rate:
      return rateText(row.info, row.ratePerSecond);
    case Age:
      return row.known ? row.ageShown : QString();
    default:
      return {};
  }
}

QVariant VariablesModel::sortValue(const VariableNode& row, int column) const {
  if (row.kind != Kind::Variable) return {};
  switch (column) {
    case Value:
      return row.known ? QVariant(row.value) : QVariant();
    case Rate:
      return row.ratePerSecond;
    case Age:
      return m_now - row.lastChange;
    default:
      return display(row, column);
  }
}

QString VariablesModel::whyNotEditable(const QModelIndex& index) const {
  const telemetry::ColumnInfo* column = columnOf(index);
  if (column == nullptr) return QStringLiteral("Only values of variables can be edited.");
  if (m_kind == SourceKind::Live) {
    return QStringLiteral("Values of live robots are only shown: nothing is ever sent to robots.");
  }
  if (m_kind == SourceKind::Replay)
    return QStringLiteral("Values of a recording are what they were.");
  if (m_moment) {
    return QStringLiteral(
        "A past moment is shown, and its values are what they were. Now leads back to the match.");
  }
  const telemetry::GroupInfo& group = groupOf(index)->info();
  if (group.attributes.count("robot") == 0) {
    return group.name == "match" ? QStringLiteral("Facts of the match are measured, not set.")
                                 : QStringLiteral("An attached blackboard is only read.");
  }
  if (column->type == ColumnType::Float64) {
    return QStringLiteral(
        "This is the truth or follows from it, not a variable of the blackboard. Robots and "
        "ball are moved on the field.");
  }
  return {};
}

QString VariablesModel::toolTip(const QModelIndex& index) const {
  const VariableNode& row = *node(index);
  if (row.kind == Kind::Category) return {};
  if (row.kind == Kind::Rest) {
    return QStringLiteral(
        "Zero, or without a value, ever since the beginning. A click shows and folds them.");
  }
  if (row.kind == Kind::Group) {
    QStringList lines{row.name};
    for (const auto& [key, value] : row.view->info().attributes) {
      lines << QString::fromStdString(key) + QStringLiteral(": ") + QString::fromStdString(value);
    }
    const GroupNote note = m_notes.value(row.name);
    for (const QString& text : {note.trouble, note.detail}) {
      if (!text.isEmpty()) lines << text;
    }
    lines << (rateOf(row) > 0
                  ? QStringLiteral(
                        "Sampled %1 times a second. Changes between two samples cannot be seen.")
                        .arg(rateOf(row), 0, 'f', 1)
                  : QStringLiteral("No sample within the last second."));
    return lines.join(QLatin1Char('\n'));
  }
  QStringList lines{row.path};
  if (row.known) {
    const QString words = wordsOf(row.info, row.value);
    lines << exactText(row.info, row.value) + QLatin1Char(' ') +
                 (words.isEmpty() ? QString::fromStdString(row.info.unit) : words);
    if (const QString rate = rateText(row.info, row.ratePerSecond); !rate.isEmpty()) {
      lines << QStringLiteral("changes by %1 a second").arg(rate);
    }
    lines << QStringLiteral("has this value for %1").arg(row.ageShown);
  } else {
    lines << QStringLiteral("no value yet");
  }
  const QString why = whyNotEditable(index);
  if (index.column() == Value) {
    lines << (!why.isEmpty()     ? why
              : m_editingAllowed ? QStringLiteral("Double-click or F2 edits it.")
                                 : QStringLiteral("Turn on “Edit values” to edit it."));
  }
  return lines.join(QLatin1Char('\n'));
}

QVariant VariablesModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const VariableNode& row = *node(index);
  switch (role) {
    case Qt::DisplayRole:
      return display(row, index.column());
    case Qt::EditRole:
      return index.column() == Value && row.known ? exactText(row.info, row.value)
                                                  : display(row, index.column());
    case Qt::ToolTipRole:
      return toolTip(index);
    case Qt::FontRole:
      if (row.kind == Kind::Group && index.column() == Name) return themeFont(TypeRole::Body, true);
      if (row.kind == Kind::Rest) return themeFont(TypeRole::Secondary);
      return index.column() == Unit || index.column() == Age || row.kind == Kind::Group
                 ? themeFont(TypeRole::Secondary)
                 : QVariant();
    case Qt::TextAlignmentRole:
      return int(Qt::AlignVCenter) |
             int(index.column() == Value || index.column() == Rate || index.column() == Age
                     ? Qt::AlignRight
                     : Qt::AlignLeft);
    case Qt::ForegroundRole: {
      // Nothing has come for a while: what stands there is history.
      constexpr double silence = 10.0;
      if (row.kind == Kind::Group && !m_notes.value(row.name).trouble.isEmpty()) {
        return theme().warningText;
      }
      if (m_now - row.owner()->newest > silence) return theme().disabledText;
      if (row.kind == Kind::Rest || index.column() == Unit || index.column() == Age ||
          index.column() == Rate || (row.kind == Kind::Group && index.column() != Name)) {
        return theme().secondaryText;
      }
      return {};
    }
    case PathRole:
      return row.path;
    case SortRole:
      return sortValue(row, index.column());
    case SparkRole:
      return QVariant::fromValue(row.spark);
    case ColumnRole:
      return QVariant::fromValue(row.info);
    case FavouriteRole:
      return row.kind == Kind::Variable && m_favourites.contains(row.path);
    default:
      return {};
  }
}

bool VariablesModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (role != Qt::EditRole || index.column() != Value || !m_editingAllowed ||
      !whyNotEditable(index).isEmpty()) {
    return false;
  }
  const Result<double> parsed = parseValue(node(index)->info, value.toString());
  if (!parsed) return false;
  emit valueEdited(index, *parsed);
  return true;
}

Qt::ItemFlags VariablesModel::flags(const QModelIndex& index) const {
  if (!index.isValid()) return Qt::NoItemFlags;
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
  if (kindOf(index) == Kind::Rest) return flags | Qt::ItemNeverHasChildren;
  if (kindOf(index) != Kind::Variable) return flags;
  flags |= Qt::ItemIsDragEnabled | Qt::ItemNeverHasChildren;
  if (index.column() == Value && m_editingAllowed && whyNotEditable(index).isEmpty()) {
    flags |= Qt::ItemIsEditable;
  }
  return flags;
}

QVariant VariablesModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || section < 0 || section >= columns) return {};
  if (role == Qt::TextAlignmentRole) {
    const bool right = section == Value || section == Rate || section == Age;
    return int(Qt::AlignVCenter) | int(right ? Qt::AlignRight : Qt::AlignLeft);
  }
  const QString last = QStringLiteral("Last %1 s").arg(sparkSeconds(), 0, 'f', 0);
  if (role == Qt::DisplayRole) {
    const QString names[] = {QStringLiteral("Name"), QStringLiteral("Value"),
                             QStringLiteral("Unit"), QStringLiteral("Change/s"),
                             QStringLiteral("Age"),  last};
    return names[section];
  }
  if (role == Qt::ToolTipRole) {
    const QString tips[] = {
        QStringLiteral(
            "Robot, process, variable. In a robot's row: samples a second.\nChanges between two "
            "samples cannot be seen."),
        QStringLiteral("Newest sample"),
        QStringLiteral("Unit, or what a code means"),
        QStringLiteral("Rate of change: how much the value changed over the last second"),
        QStringLiteral("Time since the value changed last"),
        QStringLiteral("The %1, from lowest to highest value").arg(last.toLower())};
    return tips[section];
  }
  return {};
}

}  // namespace pitchboard::ui
