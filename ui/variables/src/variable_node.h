// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One row of the tree of variables, and what was last read of it.

#include <QList>
#include <QString>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "variables_model.h"

namespace pitchboard::ui {

struct VariableNode {
  VariablesModel::Kind kind = VariablesModel::Kind::Group;
  VariableNode* parent = nullptr;
  int row = 0;  ///< in its parent
  QString name, path, searchText;
  std::vector<std::unique_ptr<VariableNode>> children;
  bool isHistory = false;  ///< nothing has come for a while

  // Of a group.
  telemetry::GroupId group = 0;
  int rank = 0;  ///< robots, then other groups, then the match
  std::shared_ptr<const telemetry::GroupView> view;
  std::vector<std::string> columns;  ///< names of the columns that are listed
  std::uint64_t round = 0;           ///< in which `view` was taken
  double rowsPerSecond = 0.0;
  double newest = -std::numeric_limits<double>::infinity();

  // Of a category: how many of its variables were never set. Of the row that stands for them: that
  // row's parent has the number.
  int neverSet = 0;

  // Of a variable.
  bool wasSet = false;  ///< was another value than zero, or has changed
  std::uint32_t column = 0;
  telemetry::ColumnInfo info;
  bool known = false;  ///< there is a sample
  double value = 0.0;
  double ratePerSecond = std::numeric_limits<double>::quiet_NaN();
  double lastChange = -std::numeric_limits<double>::infinity();
  QString ageShown;
  QList<telemetry::SeriesBucket> spark;

  const VariableNode* owner() const {
    const VariableNode* at = this;
    while (at->parent != nullptr) at = at->parent;
    return at;
  }
  VariableNode* owner() { return const_cast<VariableNode*>(std::as_const(*this).owner()); }
};

/// Calls `visit` for every variable below, in order.
template <class Visit>
void forEachVariable(const VariableNode& group, const Visit& visit) {
  for (const auto& category : group.children) {
    for (const auto& variable : category->children) {
      if (variable->kind == VariablesModel::Kind::Variable) visit(*variable);
    }
  }
}

}  // namespace pitchboard::ui
