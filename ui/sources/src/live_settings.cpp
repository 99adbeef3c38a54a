// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/live_settings.h>

#include <QRegularExpression>
#include <QSettings>
#include <algorithm>
#include <cmath>

namespace pitchboard::ui {
namespace {

const QString prefix = QStringLiteral("live/");

int number(const QSettings& settings, const char* key, int otherwise) {
  bool good = false;
  const int value = settings.value(prefix + QLatin1String(key), otherwise).toInt(&good);
  return good ? value : otherwise;
}

double real(const QSettings& settings, const char* key, double otherwise) {
  bool good = false;
  const double value = settings.value(prefix + QLatin1String(key), otherwise).toDouble(&good);
  return good && std::isfinite(value) ? value : otherwise;
}

QString text(const QSettings& settings, const char* key) {
  return settings.value(prefix + QLatin1String(key)).toString();
}

}  // namespace

Result<telemetry::SenderFilter> sendersFromText(const QString& text) {
  static const QRegularExpression between(QStringLiteral("[,;\\s]+"));
  telemetry::SenderFilter filter;
  for (const QString& part : text.split(between, Qt::SkipEmptyParts)) {
    if (const auto added = filter.add(part.toStdString()); !added) {
      return tl::unexpected<Error>(added.error());
    }
  }
  return filter;
}

LiveSettings loadLiveSettings(const QSettings& settings) {
  LiveSettings live;
  link::LiveOptions& o = live.options;
  const auto complain = [&live](const Error& error) {
    live.problem = QString::fromStdString(error.text());
  };
  if (const QString bind = text(settings, "bind"); !bind.isEmpty()) {
    if (const auto address = telemetry::parseAddress(bind.toStdString()))
      o.bind = *address;
    else
      complain(address.error());
  }
  o.portBase = number(settings, "portBase", o.portBase);
  o.robots = number(settings, "robots", o.robots);
  o.refereePort = number(settings, "refereePort", o.refereePort);
  o.variablesPortBase = number(settings, "variablesPortBase", o.variablesPortBase);
  for (const QString& file : settings.value(prefix + QLatin1String("catalogs")).toStringList()) {
    if (const auto read = link::VariableCatalog::fromFile(file.toStdString())) {
      o.catalogs.push_back(file.toStdString());
    } else {
      complain(read.error());
    }
  }
  o.ourTeam = number(settings, "ourTeam", 0);
  o.colourByNumber = settings.value(prefix + QLatin1String("colourByNumber")).toBool();
  o.team.timeout = std::chrono::milliseconds(
      std::llround(std::clamp(real(settings, "timeout", 10.0), 0.1, 3600.0) * 1000));
  telemetry::BatteryLimits& battery = o.team.battery;
  battery.cells = number(settings, "cells", battery.cells);
  battery.fullPerCell = real(settings, "fullPerCell", battery.fullPerCell);
  battery.lowPerCell = real(settings, "lowPerCell", battery.lowPerCell);
  battery.emptyPerCell = real(settings, "emptyPerCell", battery.emptyPerCell);
  if (const auto field = sim::fieldByName(text(settings, "field").toStdString())) o.field = *field;
  live.senders = text(settings, "senders");
  if (const auto filter = sendersFromText(live.senders))
    o.team.senders = *filter;
  else
    complain(filter.error());
  live.refereeSenders = text(settings, "refereeSenders");
  if (const auto filter = sendersFromText(live.refereeSenders))
    o.refereeSenders = *filter;
  else
    complain(filter.error());
  o.refereeVersion = std::clamp(number(settings, "refereeVersion", 0), 0, 255);
  live.monitorAddress = text(settings, "monitorAddress");
  live.profileFile = text(settings, "profileFile");
  if (!live.profileFile.isEmpty()) {
    if (auto profile = telemetry::loadProfile(live.profileFile.toStdString())) {
      o.profile = std::move(*profile);
    } else {
      complain(profile.error());
      live.profileFile.clear();
    }
  }
  for (const QString& setup : settings.value(prefix + QLatin1String("teams")).toStringList()) {
    // The names of profiles that are files are whole paths.
    if (auto team = telemetry::parseTeamSetup(setup.toStdString(), "Saved team")) {
      o.team.teams.push_back(std::move(*team));
    } else {
      complain(team.error());
    }
  }
  for (const QString& written : settings.value(prefix + QLatin1String("boards")).toStringList()) {
    if (auto board = link::parseAttachedBoard(written.toStdString())) {
      o.boards.push_back(std::move(*board));
    } else {
      complain(board.error());
    }
  }
  if (const auto good = link::validate(o); !good) {
    complain(good.error());
    const link::LiveOptions usual;
    o.portBase = usual.portBase;
    o.robots = usual.robots;
    o.refereePort = usual.refereePort;
    o.variablesPortBase = usual.variablesPortBase;
    o.team.teams.clear();
    o.boards.clear();
  }
  return live;
}

void saveLiveSettings(QSettings& settings, const LiveSettings& live) {
  const link::LiveOptions& o = live.options;
  const auto put = [&settings](const char* key, const QVariant& value) {
    settings.setValue(prefix + QLatin1String(key), value);
  };
  put("bind", QString::fromStdString(o.bind.text()));
  put("portBase", o.portBase);
  put("robots", o.robots);
  put("refereePort", o.refereePort);
  put("variablesPortBase", o.variablesPortBase);
  put("ourTeam", o.ourTeam);
  put("colourByNumber", o.colourByNumber);
  put("timeout", std::chrono::duration<double>(o.team.timeout).count());
  put("cells", o.team.battery.cells);
  put("fullPerCell", o.team.battery.fullPerCell);
  put("lowPerCell", o.team.battery.lowPerCell);
  put("emptyPerCell", o.team.battery.emptyPerCell);
  put("field", QString::fromStdString(o.field.name));
  put("senders", live.senders);
  put("refereeSenders", live.refereeSenders);
  put("refereeVersion", o.refereeVersion);
  put("monitorAddress", live.monitorAddress);
  put("profileFile", live.profileFile);
  QStringList teams;
  for (const telemetry::TeamSetup& team : o.team.teams) {
    teams << QString::fromStdString(telemetry::teamSetupText(team));
  }
  put("teams", teams);
  saveAttachedBoards(settings, o.boards);
  saveCatalogs(settings, o.catalogs);
}

void saveCatalogs(QSettings& settings, const std::vector<std::string>& files) {
  QStringList written;
  for (const std::string& file : files) written << QString::fromStdString(file);
  settings.setValue(prefix + QStringLiteral("catalogs"), written);
}

void saveAttachedBoards(QSettings& settings, const std::vector<link::AttachedBoard>& boards) {
  QStringList written;
  for (const link::AttachedBoard& board : boards) {
    written << QString::fromStdString(link::attachedBoardText(board));
  }
  settings.setValue(prefix + QLatin1String("boards"), written);
}

}  // namespace pitchboard::ui
