// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One list of events, wherever it is read: for tests that compare a source, a file, the command
// line and a report.

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QRegularExpression>
#include <QStringList>
#include <vector>

#include <robotlink/frame/match_event.h>

namespace event_lists {

inline QString line(double time, const QString& kind, std::uint32_t robot, const QString& side) {
  return QStringLiteral("%1 %2 %3 %4").arg(time, 0, 'f', 6).arg(kind).arg(robot).arg(side);
}

/// Kind, time, robot and side of each.
inline QStringList linesOf(const std::vector<pitchboard::link::MatchEvent>& events) {
  QStringList lines;
  for (const auto& event : events) {
    const std::string kind(pitchboard::link::info(event.kind).name);
    const std::string side(event.side ? pitchboard::link::sideName(*event.side) : "");
    lines << line(event.time, QString::fromStdString(kind), event.robot.value,
                  QString::fromStdString(side));
  }
  return lines;
}

inline QByteArray cli(const QStringList& arguments) {
  QProcess process;
  process.start(QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli"), arguments);
  if (!process.waitForFinished(120'000)) return {};
  return process.readAllStandardOutput();
}

/// What `inspect` says of a session.
inline QStringList inspected(const QString& path) {
  const auto json = QJsonDocument::fromJson(cli({"inspect", path, "--json", "--events"})).object();
  QStringList lines;
  for (const QJsonValue& value : json["events"].toArray()) {
    lines << line(value["time"].toDouble(), value["kind"].toString(),
                  static_cast<std::uint32_t>(value["uid"].toInteger()), value["side"].toString());
  }
  return lines;
}

/// Rows of the report's tables: kind, robot's name, words. Kicks stand behind the others.
inline QStringList reported(const QString& html) {
  static const QRegularExpression row(
      QStringLiteral("<tr><td>[0-9:.]+</td><td class=\"l\">([^<]*)</td><td class=\"l\">([^<]*)</td>"
                     "<td class=\"l\">([^<]*)</td></tr>"));
  QStringList rows;
  for (auto found = row.globalMatch(html); found.hasNext();) {
    const auto match = found.next();
    rows << QStringList{match.captured(1), match.captured(2), match.captured(3)}.join('|');
  }
  return rows;
}

/// What reported() should say of these events.
inline QStringList expectedRows(const std::vector<pitchboard::link::MatchEvent>& events) {
  QStringList rows, kicks;
  for (const auto& event : events) {
    using Kind = pitchboard::link::MatchEventKind;
    if (event.kind == Kind::BallSeen || event.kind == Kind::BallLost) continue;  // left out there
    const std::string kind(pitchboard::link::info(event.kind).name);
    const QString words =
        QString::fromStdString(sentenceOf(event)).toHtmlEscaped().replace("'", "&#39;");
    (event.kind == Kind::Kick ? kicks : rows)
        << QStringList{QString::fromStdString(kind), QString::fromStdString(event.name), words}
               .join('|');
  }
  return rows + kicks;
}

}  // namespace event_lists
