// SPDX-License-Identifier: GPL-3.0-or-later
#include "team_draft.h"

#include <QRegularExpression>
#include <QStringList>
#include <map>
#include <optional>

namespace pitchboard::ui {
namespace {

QString namesText(const std::map<int, std::string>& robots) {
  QStringList parts;
  for (const auto& [number, name] : robots) {
    parts << QStringLiteral("%1 %2").arg(number).arg(QString::fromStdString(name));
  }
  return parts.join(QStringLiteral(", "));
}

/// "1 Ana, 3 Bo"; nothing where a part is not of this form.
std::optional<std::map<int, std::string>> namesFrom(const QString& typed) {
  static const QRegularExpression form(QStringLiteral("^(\\d{1,3})\\s*[:=]?\\s+(\\S.*)$"));
  std::map<int, std::string> names;
  for (const QString& part : typed.split(QLatin1Char(','), Qt::SkipEmptyParts)) {
    if (part.trimmed().isEmpty()) continue;
    const auto match = form.match(part.trimmed());
    const int number = match.captured(1).toInt();
    if (!match.hasMatch() || number < 1) return std::nullopt;
    names[number] = match.captured(2).toStdString();
  }
  return names;
}

}  // namespace

TeamDraft draftOf(const telemetry::TeamSetup& setup) {
  TeamDraft draft{setup, {}, namesText(setup.robots)};
  QStringList senders;
  for (const std::string& sender : setup.senders) senders << QString::fromStdString(sender);
  draft.senders = senders.join(QStringLiteral(", "));
  return draft;
}

Result<telemetry::TeamSetup> setupOf(const TeamDraft& draft) {
  telemetry::TeamSetup setup = draft.setup;
  static const QRegularExpression between(QStringLiteral("[,;\\s]+"));
  setup.senders.clear();
  for (const QString& part : draft.senders.split(between, Qt::SkipEmptyParts)) {
    setup.senders.push_back(part.toStdString());
  }
  const auto names = namesFrom(draft.robots);
  if (!names) {
    return failure(ErrorCode::InvalidArgument, "Write robots as numbers and names: 1 Ana, 2 Bo",
                   setup.title());
  }
  setup.robots = *names;
  if (setup.firstPort == 0) setup.lastPort = 0;
  if (setup.firstPort > 0 && setup.lastPort == 0) setup.lastPort = setup.firstPort;
  if (setup.lastPort < setup.firstPort) {
    return failure(ErrorCode::InvalidArgument, "The last port is lower than the first. Swap them.",
                   setup.title());
  }
  // What a file of it would be told.
  return telemetry::parseTeamSetup(telemetry::teamSetupText(setup), setup.title(), setup.profile);
}

}  // namespace pitchboard::ui
