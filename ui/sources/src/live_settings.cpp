// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/live_settings.h>

#include <QSettings>

#include <ui/base/option_form.h>

namespace pitchboard::ui {
namespace {

const QString liveKeys = QStringLiteral("live/");
const QString teamsKey = QStringLiteral("live/teams");
const QString monitorKey = QStringLiteral("live/monitorAddress");

}  // namespace

LiveSettings loadLiveSettings(const QSettings& settings) {
  LiveSettings live;
  link::LiveOptions& o = live.options;
  const auto complain = [&live](const Error& error) {
    live.problem = QString::fromStdString(error.text());
  };
  if (const auto loaded = loadOptions(settings, liveKeys, link::liveOptionTable(), o); !loaded) {
    complain(loaded.error());
  }
  live.monitorAddress = settings.value(monitorKey).toString();
  for (const QString& setup : settings.value(teamsKey).toStringList()) {
    // The names of profiles that are files are whole paths.
    if (auto team = telemetry::parseTeamSetup(setup.toStdString(), "Saved team")) {
      o.team.teams.push_back(std::move(*team));
    } else {
      complain(team.error());
    }
  }
  if (const auto good = link::validate(o); !good) {
    complain(good.error());
    const link::LiveOptions usual;
    o.portBase = usual.portBase;
    o.robots = usual.robots;
    o.refereePort = usual.refereePort;
    o.variablesPortBase = usual.variablesPortBase;
    o.team.battery = usual.team.battery;
    o.team.teams.clear();
    o.boards.clear();
    o.foxglove.clear();
  }
  return live;
}

void saveLiveSettings(QSettings& settings, const LiveSettings& live) {
  saveOptions(settings, liveKeys, link::liveOptionTable(), live.options);
  settings.setValue(monitorKey, live.monitorAddress);
  QStringList teams;
  for (const telemetry::TeamSetup& team : live.options.team.teams) {
    teams << QString::fromStdString(telemetry::teamSetupText(team));
  }
  settings.setValue(teamsKey, teams);
}

void saveLiveOption(QSettings& settings, std::string_view key, const link::LiveOptions& options) {
  saveOptions(settings, liveKeys, {&link::liveOption(key), 1}, options);
}

}  // namespace pitchboard::ui
