// SPDX-License-Identifier: GPL-3.0-or-later
// VariablesModel: reading values.
#include <algorithm>
#include <cmath>
#include <utility>

#include "variable_node.h"
#include "variable_text.h"
#include "variables_model.h"

namespace pitchboard::ui {
namespace {

using telemetry::ColumnKind;
using telemetry::Sample;
using telemetry::SeriesBucket;

constexpr double staleAfter = 10.0;  // s; what stands there after it is history

/// Missing values are the same, too.
bool sameValue(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool same(const SeriesBucket& a, const SeriesBucket& b) {
  return sameValue(a.min, b.min) && sameValue(a.max, b.max) && sameValue(a.last, b.last) &&
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
  changed = changed || !sameValue(newest->value, variable.value);
  variable.value = newest->value;
  if (variable.info.kind == ColumnKind::Number) {
    const double rate = changePerSecond(view, variable.column, *newest);
    changed = changed || !sameValue(rate, variable.ratePerSecond);
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
  bool withNames = false;
  for (const QModelIndex& index : rows) {
    if (!index.isValid()) continue;
    VariableNode* row = node(index);
    VariableNode* group = row->owner();
    const double rate = group->rowsPerSecond;
    lookAt(*group);
    const bool other = row->kind == Kind::Variable
                           ? read(*row, sparkPixels)
                           : row->kind == Kind::Group && rate != group->rowsPerSecond;
    const bool isHistory = m_now - group->newest > staleAfter;
    const bool turned = std::exchange(row->isHistory, isHistory) != isHistory;
    withNames = withNames || turned;
    if (other || turned) changed.push_back(row);
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
    emit dataChanged(indexOf(changed[first], withNames ? Name : Value),
                     indexOf(changed[last], columns - 1));
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

}  // namespace pitchboard::ui
