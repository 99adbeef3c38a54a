// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A source whose rows a test writes: groups B1 and B2 with a few columns, and what the plots' dock
// needs around it.

#include <QSettings>
#include <QTemporaryDir>
#include <cmath>
#include <functional>

#include <simcore/world/action_codes.h>
#include <telemetry/series/series_store.h>
#include <ui/base/plot_target.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {

class PlotSource : public FrameSource {
 public:
  PlotSource() { restart(); }
  const SourceKind& kind() const override { return SourceKind::Simulate; }
  FramePtr frame() const override { return shown; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override { return store; }
  QString emptyText() const override { return {}; }
  FramePtr frameAt(double time) const override { return made(time); }
  static FramePtr made(double time) {
    auto frame = std::make_shared<link::MatchFrame>();
    frame->snapshot.time = time;
    return frame;
  }
  /// It has come to this time.
  void goTo(double time) {
    shown = made(time);
    emit frameReceived(shown);
  }

  void restart() {
    store = std::make_shared<telemetry::SeriesStore>();
    emit restarted();
  }
  /// Columns DIST [cm], ANGLE [°], NOISY and the code ACTION.
  telemetry::GroupId addRobot(const char* name) {
    telemetry::GroupInfo info;
    info.name = name;
    telemetry::ColumnInfo action;
    action.name = "ACTION";
    action.type = telemetry::ColumnType::Int32;
    action.kind = telemetry::ColumnKind::Enumeration;
    action.labels = actionLabels();
    info.columns.push_back(action);
    for (const auto& [column, unit] : {std::pair{"DIST", "cm"}, {"ANGLE", "°"}, {"NOISY", ""}}) {
      telemetry::ColumnInfo made;
      made.name = column;
      made.unit = unit;
      info.columns.push_back(made);
    }
    return store->addGroup(info);
  }
  void append(telemetry::GroupId group, double time, std::int32_t action, double dist,
              double angle = 0.0, double noisy = 0.0) {
    const std::array<std::uint32_t, 1> words{static_cast<std::uint32_t>(action)};
    const std::array<double, 3> values{dist, angle, noisy};
    store->append(group, {time, words, values});
  }
  /// `seconds` of rows at 60 Hz from time 0: DIST is distanceAt(t), ANGLE 90 t, ACTION changes
  /// every second.
  telemetry::GroupId fill(const char* name, double seconds, double shift = 0.0) {
    const telemetry::GroupId group = addRobot(name);
    for (int i = 0; i <= static_cast<int>(seconds * 60); ++i) {
      const double time = i / 60.0;
      append(group, time, static_cast<int>(time) % 3, distanceAt(time) + shift, 90.0 * time,
             std::sin(i * 1.7));
    }
    return group;
  }
  static double distanceAt(double time) { return 100.0 + 50.0 * std::sin(time); }

  std::shared_ptr<telemetry::SeriesStore> store;
  FramePtr shown;
};

/// What a dock gets, without a window.
struct PlotBench {
  PlotSource source;
  ShownMoment sources{&source};
  LinkedTime time{&sources};
  PlotTarget target;
  QTemporaryDir folder;
  QSettings settings{folder.filePath(QStringLiteral("settings.ini")), QSettings::IniFormat};

  PlotsContext context() {
    PlotsContext context;
    context.shown = &sources;
    context.time = &time;
    context.settings = &settings;
    context.plots = &target;
    return context;
  }
};

}  // namespace pitchboard::ui
