// SPDX-License-Identifier: GPL-3.0-or-later
// VariablesModel: how rows are shown, and what a person may do with them.
#include <telemetry/series/group_attributes.h>
#include <QColor>

#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/blackboard/variable_meanings.h>
#include <ui/base/theme.h>

#include "variable_node.h"
#include "variable_text.h"
#include "variables_model.h"

namespace pitchboard::ui {

QString VariablesModel::restText(const VariableNode& row) const {
  const int count = row.parent->neverSet;
  const QString label = count == 1 ? QStringLiteral("1 variable never set")
                                   : QStringLiteral("%1 variables never set").arg(count);
  return m_restShown.contains(row.parent->path) ? QStringLiteral("Fold ") + label : label;
}

double VariablesModel::rateOf(const VariableNode& group) const {
  return m_notes.value(group.name).rate.value_or(group.rowsPerSecond);
}

QVariant VariablesModel::display(const VariableNode& row, int column) const {
  if (row.kind == Kind::Rest) return column == Name ? restText(row) : QString();
  if (column == Name) {
    if (row.kind != Kind::Group) return row.name;
    QString name = row.name;
    const QString key = attachedKey(row.view->info());
    if (!key.isEmpty() && !name.contains(key)) name += QStringLiteral(" (%1)").arg(key);
    const QString note = m_notes.value(row.name).trouble;
    return note.isEmpty() ? name : name + QStringLiteral(" · ") + note;
  }
  if (row.kind == Kind::Group) {
    const double rate = rateOf(row);
    if (column == Value && rate > 0) return QString::number(rate, 'f', rate < 9.95 ? 1 : 0);
    return column == Unit && rate > 0 ? QStringLiteral("/s") : QString();
  }
  if (row.kind == Kind::Category) return {};
  switch (column) {
    case Value:
      return row.known ? valueText(row.info, row.value) : QString();
    case Unit: {
      const QString label = row.known ? labelOf(row.info, row.value) : QString();
      return label.isEmpty() ? QString::fromStdString(row.info.unit) : label;
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
  if (*m_kind.whyNotEditable != 0) return QString::fromUtf8(m_kind.whyNotEditable);
  if (m_moment) {
    return QStringLiteral("You can't edit the past. Press Now to return to the match.");
  }
  const telemetry::GroupInfo& group = groupOf(index)->info();
  if (factsOf(group).slot == 0) {
    return group.name == "match" ? QStringLiteral("Match data is measured and cannot be edited.")
                                 : QStringLiteral("Attached blackboards are read-only.");
  }
  if (column->type == telemetry::ColumnType::Float64) {
    return QStringLiteral(
        "This is simulated truth, not a blackboard variable. Move the robots and the ball on the "
        "field instead.");
  }
  return {};
}

QString VariablesModel::toolTip(const QModelIndex& index) const {
  const VariableNode& row = *node(index);
  if (row.kind == Kind::Category) return {};
  if (row.kind == Kind::Rest) {
    return QStringLiteral("Zero or without a value since the start. Click to show or fold them.");
  }
  if (row.kind == Kind::Group) {
    QStringList lines{row.name};
    for (const auto& [key, value] : telemetry::attributesOf(row.view->info())) {
      if (key == "order") continue;  // how lists are sorted
      lines << QString::fromStdString(key) + QStringLiteral(": ") + QString::fromStdString(value);
    }
    const GroupNote note = m_notes.value(row.name);
    for (const QString& text : {note.trouble, note.detail}) {
      if (!text.isEmpty()) lines << text;
    }
    lines << (rateOf(row) > 0
                  ? QStringLiteral(
                        "Sampled %1 times per second. Changes between two samples are missed.")
                        .arg(rateOf(row), 0, 'f', 1)
                  : QStringLiteral("No sample within the last second."));
    return lines.join(QLatin1Char('\n'));
  }
  QStringList lines{row.path};
  if (link::VariableCatalog::extended().find(row.info.name)) {
    const auto text = link::VariableMeanings::published().description(row.info.name);
    lines << QString::fromUtf8(text.data(), qsizetype(text.size()));
  }
  if (row.known) {
    const QString label = labelOf(row.info, row.value);
    lines << exactText(row.info, row.value) + QLatin1Char(' ') +
                 (label.isEmpty() ? QString::fromStdString(row.info.unit) : label);
    if (const QString rate = rateText(row.info, row.ratePerSecond); !rate.isEmpty()) {
      lines << QStringLiteral("changes by %1 per second").arg(rate);
    }
    lines << QStringLiteral("unchanged for %1").arg(row.ageShown);
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
      if (row.kind == Kind::Group && !m_notes.value(row.name).trouble.isEmpty()) {
        return theme().warningText;
      }
      if (row.isHistory) return theme().disabledText;
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
      return row.kind == Kind::Variable && isFavourite(row);
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
        QStringLiteral("Robot, process, variable. A robot's row shows its samples per "
                       "second.\nChanges between two samples are missed."),
        QStringLiteral("Newest sample"),
        QStringLiteral("Unit, or what a code means"),
        QStringLiteral("Rate of change: how much the value changed over the last second"),
        QStringLiteral("Time since the last change"),
        QStringLiteral("The %1, from lowest to highest value").arg(last.toLower())};
    return tips[section];
  }
  return {};
}

}  // namespace pitchboard::ui
