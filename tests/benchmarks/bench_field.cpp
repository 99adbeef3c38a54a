// SPDX-License-Identifier: GPL-3.0-or-later
// Milliseconds to show one frame of 22 moving robots with every layer, by software rendering:
// items brought up to date, and the whole widget painted.

#include <benchmark/benchmark.h>

#include <QApplication>
#include <QAction>
#include <QImage>
#include <QPainter>

#include <ui/field_view.h>
#include <ui/theme.h>

#include <cmath>

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

FramePtr movingFrame(int serial) {
  auto frame = std::make_shared<link::MatchFrame>();
  frame->serial = static_cast<std::uint64_t>(serial + 1);
  frame->snapshot.tick = static_cast<std::uint64_t>(serial);
  frame->snapshot.time = serial / 60.0;
  frame->snapshot.ball = {std::sin(serial * 0.02), 0.3};
  for (int i = 0; i < 22; ++i) {
    const double phase = serial * 0.01 + i;
    sim::RobotSnapshot robot;
    robot.identity = {RobotId{i + 1}, i < 11 ? TeamColor::Blue : TeamColor::Red, i % 11 + 1, false};
    robot.pose = {{-4.0 + 0.38 * i + 0.3 * std::cos(phase), 2.4 * std::sin(phase * 0.7)}, phase};
    robot.headYaw = phase + 0.2;
    frame->snapshot.robots.push_back(robot);
    link::RobotBoardView board;
    board.id = robot.identity.id;
    board.localizationX = static_cast<int>(100 * (robot.pose.position.x + 4.5)) + 10;
    board.localizationY = static_cast<int>(100 * (3.0 - robot.pose.position.y)) + 10;
    board.belief = 25.0F;
    board.localizationWorking = board.visionWorking = true;
    board.ballDistCm = 150.0F;
    frame->boards.push_back(board);
  }
  return frame;
}

void frameOfTwentyTwo(benchmark::State& state) {
  FieldView view(nullptr);
  view.resize(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  for (QAction* layer : view.layerActions()) layer->setChecked(true);
  view.show();
  for (int i = 0; i < 400; ++i) view.showFrame(movingFrame(i));  // trails at full length
  std::vector<RobotId> selected;
  for (int i = 1; i <= static_cast<int>(state.range(2)); ++i) selected.push_back(RobotId{i});
  view.select(selected);
  QCoreApplication::processEvents();
  QImage screen(view.size(), QImage::Format_RGB32);
  int serial = 400;
  for (auto _ : state) {
    state.PauseTiming();
    const FramePtr frame = movingFrame(serial++);
    state.ResumeTiming();
    view.showFrame(frame);
    view.render(&screen);
  }
}
BENCHMARK(frameOfTwentyTwo)
    ->ArgNames({"width", "height", "selected"})
    ->Args({1280, 800, 1})
    ->Args({1920, 1080, 1})
    ->Args({1280, 800, 22})  // 22 fields of view over one another: the worst case
    ->Args({1920, 1080, 22})
    ->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
  QApplication application(argc, argv);
  setTheme(application, ThemeChoice::Dark);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
