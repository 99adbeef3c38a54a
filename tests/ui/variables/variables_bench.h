// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The panel of variables over rows made by hand, for the tests of its list and of its editing.

#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest>
#include <bit>
#include <cmath>
#include <memory>

#include <simcore/world/action_codes.h>
#include <telemetry/series/series_store.h>
#include <ui/base/in_place_message.h>
#include <ui/base/plot_target.h>
#include <ui/base/theme.h>
#include <ui/sources/attached_boards.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>
#include <ui/variables/variables_dock.h>

#include "../../support/group_facts.h"
#include "variables_filter.h"
#include "variables_model.h"
#include "variables_view.h"

namespace pitchboard::ui::test {

using telemetry::ColumnInfo;
using telemetry::ColumnKind;
using telemetry::ColumnType;

// A robot with a few variables of every kind, by hand.
inline telemetry::GroupInfo robotGroup(const std::string& name, int robot, int extra = 0) {
  telemetry::GroupInfo info;
  info.name = name;
  info.robot =
      telemetry::facts({{"robot", std::to_string(robot)}, {"team", "blue"}, {"number", "1"}});
  ColumnInfo action{"DECISION_ACTION_A", ColumnType::Int32,       "",
                    "Decision",          ColumnKind::Enumeration, actionLabels()};
  info.columns = {
      action,
      {"VISION_LOST", ColumnType::Int32, "", "Vision", ColumnKind::Flag, {}},
      {"VISION_BALL_DIST", ColumnType::Float32, "cm", "Vision", ColumnKind::Number, {}}};
  for (int i = 0; i < extra; ++i) {
    info.columns.push_back(
        {"EXTRA_" + std::to_string(i), ColumnType::Float32, "", "Extra", ColumnKind::Number, {}});
  }
  info.columns.push_back({"TRUE_X", ColumnType::Float64, "m", "Truth", ColumnKind::Number, {}});
  return info;
}

inline void append(telemetry::SeriesStore& store, telemetry::GroupId group, double time, int action,
                   int lost, float distance, double x, int extra = 0) {
  std::vector<std::uint32_t> words{static_cast<std::uint32_t>(action),
                                   static_cast<std::uint32_t>(lost),
                                   std::bit_cast<std::uint32_t>(distance)};
  for (int i = 0; i < extra; ++i) {
    words.push_back(std::bit_cast<std::uint32_t>(float(i) + float(std::sin(time))));
  }
  const double values[] = {x};
  store.append(group, {time, words, values});
}

// Rows made by hand in place of a match.
class HandSource : public FrameSource {
 public:
  const SourceKind& kind() const override { return m_kind; }
  FramePtr frame() const override { return {}; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override { return m_store; }
  QString emptyText() const override { return QStringLiteral("Nobody is here."); }
  void take(std::shared_ptr<telemetry::SeriesStore> store, SourceKind kind) {
    m_store = std::move(store);
    m_kind = kind;
    emit restarted();
  }

 private:
  std::shared_ptr<telemetry::SeriesStore> m_store;
  SourceKind m_kind = SourceKind::Simulate;
};

class HandPlots : public PlotTarget {
 public:
  using PlotTarget::PlotTarget;
  void plotVariables(const QStringList& names) override { plotted += names; }
  QStringList plotted;
};

inline std::shared_ptr<telemetry::SeriesStore> twoRobots() {
  auto store = std::make_shared<telemetry::SeriesStore>();
  const auto b1 = store->addGroup(robotGroup("B1", 1));
  const auto b2 = store->addGroup(robotGroup("B2", 2));
  for (int i = 0; i <= 600; ++i) {
    const double time = i / 60.0;
    // B1 turns to walking at 9 s; its distance changes all the time. B2 stands.
    // At the very beginning B1 did not see the ball, and B2 walked.
    append(*store, b1, time, time >= 9.0 ? 1 : 0, i == 0, float(100 - 2 * time), 0.5);
    append(*store, b2, time, i == 0 ? 3 : 0, 1, 250.0F, -0.5);
  }
  return store;
}

// The dock with everything around it that it needs.
struct Bench {
  explicit Bench(const QString& settingsFile = {})
      : controller(inlineOptions()),
        source(&hand),
        plots(nullptr),
        settings(settingsFile.isEmpty() ? folder.filePath(QStringLiteral("s.ini")) : settingsFile,
                 QSettings::IniFormat) {
    VariablesContext context;
    context.controller = &controller;
    context.shown = &source;
    context.plots = &plots;
    context.settings = &settings;
    context.selection = &selection;
    context.boards = &boards;
    dock.reset(makeVariablesDock(context, nullptr));
    dock->resize(460, 700);
    dock->show();
    view = dock->findChild<VariablesView*>();
    model = dock->findChild<VariablesModel*>();
  }
  static link::MatchOptions inlineOptions() {
    link::MatchOptions options;
    options.cognition = link::Cognition::Inline;
    return options;
  }
  QModelIndex at(const QString& path, int column = 0) const {
    auto* filter = qobject_cast<VariablesFilter*>(view->model());
    return filter->mapFromSource(model->find(path)).siblingAtColumn(column);
  }
  QString text(const QString& path, int column) const {
    return model->find(path).siblingAtColumn(column).data().toString();
  }
  QString message() const { return dock->findChild<InPlaceMessage*>()->text(); }
  void press(const char* button) const {
    QTest::mouseClick(dock->findChild<QToolButton*>(QLatin1String(button)), Qt::LeftButton);
  }
  void choose(const QString& path) const {
    view->openAll();
    view->setCurrentIndex(at(path));
    view->setFocus();
  }
  /// Opens the editor of a value of twoRobots(), as F2 does; null when there is none.
  QLineEdit* edit(const QString& path) {
    hand.take(twoRobots(), SourceKind::Simulate);
    press("editValues");
    choose(path);
    QTest::keyClick(view, Qt::Key_F2);
    return dock->findChild<QLineEdit*>(QStringLiteral("valueEdit"));
  }

  QTemporaryDir folder;
  HandSource hand;
  MatchController controller;
  ShownMoment source;
  RobotSelection selection;
  HandPlots plots;
  QSettings settings;
  LiveController live;
  AttachedBoards boards{&controller, &live, &source, &settings};
  std::unique_ptr<QWidget> dock;
  VariablesView* view = nullptr;
  VariablesModel* model = nullptr;
};

inline const QString ballDistance = QStringLiteral("B1/VISION_BALL_DIST");
inline const QString action = QStringLiteral("B1/DECISION_ACTION_A");

}  // namespace pitchboard::ui::test
