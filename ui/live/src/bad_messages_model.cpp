// SPDX-License-Identifier: GPL-3.0-or-later
#include "bad_messages_model.h"

#include <ui/base/robot_text.h>

namespace pitchboard::ui {

void BadMessagesModel::add(std::vector<Row>& rows, const QString& who,
                           const telemetry::ErrorTally& errors) const {
  for (std::size_t i = 0; i < telemetry::textErrorCount; ++i) {
    const auto error = static_cast<telemetry::TextError>(i);
    if (errors.count(error) == 0) continue;
    const std::string_view text = telemetry::errorText(error);
    rows.push_back({who, QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size())),
                    errors.count(error), QString::fromStdString(errors.sample(error))});
  }
}

void BadMessagesModel::update(const link::LiveDetails& details) {
  std::vector<Row> rows;
  add(rows, QStringLiteral("All robots"), details.team.errors);
  for (const telemetry::RobotStatus& robot : details.team.robots) {
    add(rows,
        QStringLiteral("robot %1 at %2")
            .arg(robot.key.number)
            .arg(QString::fromStdString(robot.sender.text())),
        robot.errors);
  }
  for (const telemetry::SenderStatus& sender : details.team.senders) {
    add(rows, QStringLiteral("sender %1").arg(QString::fromStdString(sender.address.text())),
        sender.errors);
  }
  const auto count = [&rows](const QString& who, const QString& kind, quint64 number,
                             const QString& sample = {}) {
    if (number > 0) rows.push_back({who, kind, number, sample});
  };
  count(QStringLiteral("referee's port"), QString::fromStdString(details.unknownRefereeReason),
        details.unknownReferee, QString::fromStdString(details.unknownRefereeSample));
  count(QStringLiteral("robots"), QStringLiteral("sender not on the list"),
        details.team.refusedByFilter);
  count(QStringLiteral("referee"), QStringLiteral("sender not on the list"),
        details.refusedReferees);
  count(QStringLiteral("referee"), QStringLiteral("other protocol version"),
        details.referee.otherVersions);
  count(QStringLiteral("robots"), QStringLiteral("from more than 64 robots"),
        details.team.refusedRobots);
  count(QStringLiteral("curves"), QStringLiteral("messages from more than 64 robots"),
        details.rows.rows);
  count(QStringLiteral("curves"), QStringLiteral("values beyond the field limit"),
        details.rows.values);
  count(QStringLiteral("network"), QStringLiteral("lost: the studio could not keep up"),
        details.network.queueDrops);
  for (const telemetry::PortStatus& port : details.network.ports) {
    count(QStringLiteral("port %1").arg(port.port),
          QStringLiteral("lost in the kernel: its buffer was full"), port.kernelDrops);
    count(QStringLiteral("port %1").arg(port.port), QStringLiteral("longer than 64 KiB, truncated"),
          port.truncated);
  }
  const auto sameRow = [](const Row& a, const Row& b) {
    return a.who == b.who && a.kind == b.kind;
  };
  if (!std::equal(rows.begin(), rows.end(), m_rows.begin(), m_rows.end(), sameRow)) {
    beginResetModel();
    m_rows = std::move(rows);
    endResetModel();
    return;
  }
  if (rows == m_rows) return;
  m_rows = std::move(rows);
  emit dataChanged(index(0, 0), index(rowCount() - 1, columns - 1));
}

int BadMessagesModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int BadMessagesModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QVariant BadMessagesModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const Row& row = m_rows[static_cast<std::size_t>(index.row())];
  if (role == Qt::TextAlignmentRole) return headerData(index.column(), Qt::Horizontal, role);
  if (role != Qt::DisplayRole && role != Qt::ToolTipRole) return {};
  switch (index.column()) {
    case Who:
      return row.who;
    case Kind:
      return row.kind;
    case Count:
      return countText(row.count);
    case Sample:
      return row.sample;
    default:
      return {};
  }
}

QVariant BadMessagesModel::headerData(int section, Qt::Orientation orientation, int role) const {
  // A column of numbers stands beneath its title.
  if (role == Qt::TextAlignmentRole && section == Count) {
    return QVariant(Qt::AlignRight | Qt::AlignVCenter);
  }
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  const QString names[] = {QStringLiteral("Sender"), QStringLiteral("Problem"),
                           QStringLiteral("Count"), QStringLiteral("Last message")};
  return section >= 0 && section < columns ? names[section] : QVariant();
}

}  // namespace pitchboard::ui
