// SPDX-License-Identifier: GPL-3.0-or-later
#include "team_preview.h"

#include <QStringList>

#include <robotlink/live/live_teams.h>
#include <telemetry/referee/gamecontroller.h>

namespace pitchboard::ui {
namespace {

using telemetry::DecodedText;
using telemetry::TextDecoder;

constexpr std::size_t maxFields = 12;  // more do not fit into a line

QString valuesOf(const TextDecoder& decoder, const DecodedText& decoded) {
  QStringList parts;
  const auto& fields = decoder.profile().fields;
  for (std::size_t i = 0; i < decoded.count && parts.size() < qsizetype{maxFields}; ++i) {
    if (i < fields.size() && fields[i].meaning == telemetry::FieldMeaning::Robot) continue;
    const QString name = QString::fromStdString(decoder.name(decoded, i));
    if (decoded.has(i)) {
      const QString unit = i < fields.size() ? QString::fromStdString(fields[i].unit) : QString();
      parts << QStringLiteral("%1 %2%3").arg(name, QString::number(decoded.values[i], 'g', 6),
                                             unit.isEmpty() ? QString() : QLatin1Char(' ') + unit);
    } else if (!decoded.texts[i].empty()) {
      parts << name + QLatin1Char(' ') +
                   QString::fromStdString(telemetry::printable(decoded.texts[i], 24));
    }
  }
  return parts.join(QStringLiteral(", "));
}

/// Names of the formats that can be read as.
QString knownFormats(const Arrival& arrival, std::span<const KnownFormat> known) {
  QStringList names;
  DecodedText decoded;
  for (const KnownFormat& format : known) {
    format.decoder->decode(arrival.view(), decoded);
    if (decoded.errors.empty() && decoded.robot > 0) names << format.name;
  }
  return names.isEmpty() ? QString()
                         : QStringLiteral("; could be %1").arg(names.join(QStringLiteral(" or ")));
}

QString robotText(const link::LiveOptions& options, const RobotKey& robot) {
  QString text = QString::fromStdString(link::robotName(robot, link::teamsOf(options, {})));
  const std::string own = link::ownNameOf(options, robot);
  if (!own.empty()) text += QLatin1Char(' ') + QString::fromStdString(own);
  if (const auto* team = telemetry::setupAt(robot.team, options.team.teams)) {
    text += QStringLiteral(" (%1)").arg(QString::fromStdString(team->title()));
  }
  return text;
}

}  // namespace

std::vector<PreviewRow> previewOf(const std::vector<Arrival>& arrivals,
                                  const link::LiveOptions& options,
                                  std::span<const KnownFormat> known) {
  const telemetry::TeamRouter router(options.profile, options.team.teams,
                                     link::surroundingsOf(options.field));
  std::vector<PreviewRow> rows;
  DecodedText decoded;
  for (const Arrival& arrival : arrivals) {
    PreviewRow& row = rows.emplace_back();
    row.sender = QString::fromStdString(arrival.sender.address.text());
    row.port = arrival.localPort;
    row.messages = arrival.count;
    if (const auto packet = telemetry::decodeReferee(arrival.payload)) {
      row.used = arrival.localPort == options.refereePort;
      row.robot = QStringLiteral("Referee");
      const auto* state = std::get_if<telemetry::RefereeState>(&*packet);
      row.values = state != nullptr
                       ? QStringLiteral("GameController packet, version %1").arg(state->version)
                       : QStringLiteral("GameController packet");
      if (!row.used) {
        row.values += QStringLiteral("; the referee's port is %1").arg(options.refereePort);
      }
      continue;
    }
    const bool listed = options.team.senders.allows(arrival.sender.address);
    const auto decoder = listed ? router.decode(arrival.view(), decoded) : nullptr;
    if (decoder && decoded.accepted()) {
      row.used = true;
      row.robot = robotText(options, {decoded.place, decoded.robot, 0});
      row.values = valuesOf(*decoder, decoded);
      continue;
    }
    row.robot = QStringLiteral("–");
    QStringList why;
    for (std::size_t i = 0; decoder && i < telemetry::textErrorCount; ++i) {
      const auto error = static_cast<telemetry::TextError>(i);
      if (decoded.errors.has(error)) why << QString::fromUtf8(telemetry::errorText(error));
    }
    if (!listed) why << QStringLiteral("sender not on the team's list");
    if (listed && !decoder) why << QStringLiteral("no team has this sender and port");
    row.values = why.join(QStringLiteral(", ")) + knownFormats(arrival, known) +
                 QStringLiteral(": ") +
                 QString::fromStdString(telemetry::printable(arrival.payload, 60));
  }
  return rows;
}

}  // namespace pitchboard::ui
