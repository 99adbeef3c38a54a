// SPDX-License-Identifier: GPL-3.0-or-later
#include "processes_model.h"

#include <QColor>
#include <algorithm>

#include <ui/base/robot_text.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

using State = link::ProcessState;

QString stateText(const link::ProcessStatus& status) {
  const QString detail = QString::fromStdString(status.detail);
  const auto with = [&detail](const QString& state) {
    return detail.isEmpty() ? state : state + QStringLiteral(" (") + detail + QLatin1Char(')');
  };
  switch (status.state) {
    case State::Waiting:
      return QStringLiteral("waiting to start");
    case State::Running:
      return status.deaths == 0   ? QStringLiteral("running")
             : status.deaths == 1 ? QStringLiteral("running, crashed once")
                                  : QStringLiteral("running, crashed %1 times").arg(status.deaths);
    case State::NotResponding:
      return with(QStringLiteral("not responding"));
    case State::Restarting:
      return with(QStringLiteral("restarting"));
    case State::Ended:
      return with(QStringLiteral("ended"));
    case State::Stopped:
      return QStringLiteral("stopped");
    case State::GivenUp:
      return with(QStringLiteral("given up"));
  }
  return {};
}

}  // namespace

void ProcessesModel::update(const link::MatchFrame& frame, Time now) {
  std::vector<Row> rows;
  for (const link::RobotFrame& robot : frame.robots) {
    for (const link::ProcessStatus& one : robot.processes()) {
      const auto since = std::chrono::duration_cast<std::chrono::seconds>(now - one.started);
      rows.push_back({one, robotName(robot), one.pid != 0 ? qint64{since.count()} : 0});
    }
  }
  const auto sameKey = [](const Row& a, const Row& b) {
    return a.status.id == b.status.id && a.robot == b.robot;
  };
  if (!std::equal(rows.begin(), rows.end(), m_rows.begin(), m_rows.end(), sameKey)) {
    beginResetModel();
    m_rows = std::move(rows);
    endResetModel();
    return;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] == m_rows[i]) continue;
    m_rows[i] = std::move(rows[i]);
    const int row = static_cast<int>(i);
    emit dataChanged(index(row, 0), index(row, columns - 1));
  }
}

void ProcessesModel::clear() {
  beginResetModel();
  m_rows.clear();
  endResetModel();
}

const link::ProcessStatus& ProcessesModel::statusAt(int row) const {
  return m_rows[static_cast<std::size_t>(row)].status;
}

int ProcessesModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int ProcessesModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QString ProcessesModel::text(const Row& row, int column) const {
  const link::ProcessStatus& status = row.status;
  const bool runs = status.pid != 0;
  switch (column) {
    case Robot:
      return row.robot;
    case Process:
      return QString::fromStdString(status.name);
    case Program:
      return QString::fromStdString(status.program());
    case State:
      return stateText(status);
    case Pid:
      return runs ? QString::number(status.pid) : QString();
    case Uptime:
      return runs ? durationText(static_cast<double>(row.seconds)) : QString();
    case Restarts:
      return QString::number(status.restarts);
    case Cpu:
      return runs ? QStringLiteral("%1 %").arg(std::max(0.0, status.cpu) * 100, 0, 'f', 1)
                  : QString();
    case Memory:
      return runs ? QStringLiteral("%1 MB").arg(static_cast<double>(status.memoryBytes) / 1e6, 0,
                                                'f', 1)
                  : QString();
    case Heartbeat:
      return runs && status.heartbeatAge
                 ? QStringLiteral("%1 ago").arg(durationText(*status.heartbeatAge, 1))
                 : QString();
    case LastOutput:
      return status.lastLines.empty() ? QString() : QString::fromStdString(status.lastLines.back());
    default:
      return {};
  }
}

QVariant ProcessesModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const Row& row = m_rows[static_cast<std::size_t>(index.row())];
  if (role == Qt::DisplayRole) return text(row, index.column());
  if (role == Qt::ToolTipRole) {
    if (index.column() == State && row.status.deaths > 0) {
      return QStringLiteral("Last crash: ") + QString::fromStdString(row.status.lastDeath);
    }
    if (index.column() == Program) {
      QStringList command;
      for (const std::string& part : row.status.command) command << QString::fromStdString(part);
      return command.join(QLatin1Char(' '));
    }
    if (index.column() != LastOutput) return text(row, index.column());
    QStringList lines;
    for (const std::string& line : row.status.lastLines) lines << QString::fromStdString(line);
    return lines.join(QLatin1Char('\n'));
  }
  if (role == Qt::TextAlignmentRole) return headerData(index.column(), Qt::Horizontal, role);
  if (role == Qt::ForegroundRole && index.column() == State) {
    switch (row.status.state) {
      case State::NotResponding:
      case State::Restarting:
        return theme().warningText;
      case State::GivenUp:
        return theme().errorText;
      case State::Waiting:
      case State::Stopped:
        return theme().secondaryText;
      case State::Ended:
        return row.status.detail == "exit code 0" ? theme().secondaryText : theme().errorText;
      case State::Running:
        return row.status.deaths > 0 ? QVariant(theme().warningText) : QVariant();
    }
  }
  return {};
}

QVariant ProcessesModel::headerData(int section, Qt::Orientation orientation, int role) const {
  // A column of numbers stands beneath its title.
  if (role == Qt::TextAlignmentRole && section >= Pid && section <= Heartbeat) {
    return static_cast<int>(Qt::AlignRight | Qt::AlignVCenter);
  }
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  static const char* const names[columns] = {"Robot",  "Process",   "Program",    "State",
                                             "PID",    "Up",        "Restarts",   "CPU",
                                             "Memory", "Heartbeat", "Last output"};
  return section >= 0 && section < columns ? QString::fromUtf8(names[section]) : QVariant();
}

}  // namespace pitchboard::ui
