// SPDX-License-Identifier: GPL-3.0-or-later
#include "value_writer.h"

#include <algorithm>

#include <ui/base/in_place_message.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

#include "variables_model.h"

namespace pitchboard::ui {

ValueWriter::ValueWriter(MatchController* controller, VariablesModel* model,
                         InPlaceMessage* message, QObject* parent)
    : QObject(parent), m_controller(controller), m_model(model), m_message(message) {
  connect(model, &VariablesModel::valueEdited, this, &ValueWriter::write);
  connect(controller->edits(), &MatchEdits::variableWritten, this, &ValueWriter::written);
}

void ValueWriter::forget() {
  m_pending.clear();
  m_watch.clear();
}

void ValueWriter::write(const QModelIndex& index, double value) {
  const auto group = m_model->groupOf(index);
  const telemetry::ColumnInfo* column = m_model->columnOf(index);
  const RobotId id{factsOf(group->info()).slot};
  if (column == nullptr || id.value == 0) return;
  const auto series = m_model->store()->find(group->info().name, column->name);
  const auto view = series ? m_model->store()->view(series->group) : nullptr;
  const auto before = view ? view->latest(series->column) : std::nullopt;
  const QString name = QString::fromStdString(column->name);
  m_message->clear();
  m_pending.push_back({id,
                       {QString::fromStdString(group->info().name), name,
                        before ? before->value : 0.0, value, 0.0}});
  m_controller->edits()->writeVariable(id, name, value);
}

void ValueWriter::written(RobotId robot, const QString& name, double time) {
  const auto pending = std::find_if(m_pending.begin(), m_pending.end(), [&](const Pending& each) {
    return each.robot == robot && each.value.column == name;
  });
  if (pending == m_pending.end()) return;
  pending->value.time = time;
  m_watch.add(pending->value);
  m_pending.erase(pending);
}

void ValueWriter::check() {
  if (m_watch.empty() || m_model->store() == nullptr) return;
  const auto found = m_watch.check(*m_model->store());
  if (!found) return;
  const QModelIndex index =
      m_model->find(found->written.group + QLatin1Char('/') + found->written.column);
  if (const telemetry::ColumnInfo* column = m_model->columnOf(index)) {
    m_message->showMessage(InPlaceMessage::Tone::Warning, overwrittenText(*found, *column));
  }
}

}  // namespace pitchboard::ui
