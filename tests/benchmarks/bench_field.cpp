// SPDX-License-Identifier: GPL-3.0-or-later
// Milliseconds to show one frame of 22 moving robots by software rendering, with the layers that
// are on at the start (all:0) and with every layer (all:1).

#include <benchmark/benchmark.h>

#include <QAction>
#include <QImage>
#include <QPainter>

#include <cmath>
#include <memory>
#include <vector>

#include <ui/field/field_view.h>

#include "without_screen.h"

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

constexpr int firstSerial = 600;  // trails have their full length by then

FramePtr movingFrame(int serial) {
  auto frame = std::make_shared<link::MatchFrame>();
  frame->serial = static_cast<std::uint64_t>(serial + 1);
  frame->snapshot.tick = static_cast<std::uint64_t>(serial);
  frame->snapshot.time = serial / 60.0;
  frame->snapshot.ball = {std::sin(serial * 0.02), 0.3};
  for (int i = 0; i < 22; ++i) {
    const double phase = serial * 0.01 + i;
    link::RobotFrame robot;
    robot.identity = {RobotId{i + 1}, i < 11 ? TeamColor::Blue : TeamColor::Red, i % 11 + 1, false};
    robot.uid = link::uidOf(robot.identity.id);
    robot.key = link::keyOf(robot.identity);
    robot.name = robot.identity.name();
    robot.pose = {{-4.0 + 0.38 * i + 0.3 * std::cos(phase), 2.4 * std::sin(phase * 0.7)}, phase};
    robot.headYaw = phase + 0.2;
    robot.boardKey = 0;
    robot.belief = {{robot.pose.position.x + 0.1, robot.pose.position.y - 0.1}, 0.0};
    robot.sigma = 0.25;
    robot.ball = link::SeenBall{{robot.pose.position.x + 1.6, robot.pose.position.y}, 1.5, 0.0};
    frame->robots.push_back(robot);
  }
  return frame;
}

std::unique_ptr<FieldView> viewOf(const benchmark::State& state) {
  auto view = std::make_unique<FieldView>(nullptr);
  view->resize(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  if (state.range(2)) {
    for (QAction* layer : view->actions().layers) layer->setChecked(true);
  }
  view->show();
  for (int i = 0; i < firstSerial; ++i) view->showFrame(movingFrame(i));
  std::vector<RobotUid> selected;
  for (const link::RobotFrame& robot : movingFrame(firstSerial)->robots) {
    if (selected.size() < static_cast<std::size_t>(state.range(3))) selected.push_back(robot.uid);
  }
  view->select(selected);
  QCoreApplication::processEvents();
  return view;
}

/// Shows one moving frame after another; `paint` brings the view onto a screen.
template <class Paint>
void frames(benchmark::State& state, Paint&& paint) {
  const auto view = viewOf(state);
  int serial = firstSerial;
  for (auto _ : state) {
    state.PauseTiming();
    const FramePtr frame = movingFrame(serial++);
    state.ResumeTiming();
    view->showFrame(frame);
    paint(*view);
  }
}

/// As in the studio: a frame arrives, and the event loop paints what it has changed.
void liveFrame(benchmark::State& state) {
  frames(state, [](FieldView&) { QCoreApplication::processEvents(); });
}

/// Everything painted again, as after a change of zoom: the upper bound.
void wholeRepaint(benchmark::State& state) {
  QImage screen;
  frames(state, [&screen](FieldView& view) {
    if (screen.isNull()) screen = QImage(view.size(), QImage::Format_RGB32);
    view.render(&screen);
  });
}

void cases(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"width", "height", "all", "selected"})
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime();  // Qt also paints on threads of its own
  for (const int all : {0, 1}) {
    benchmark->Args({1280, 800, all, 1})->Args({1920, 1080, all, 1});
  }
  benchmark->Args({1920, 1080, 1, 22});  // 22 fields of view over one another: the worst case
}

BENCHMARK(liveFrame)->Apply(cases);
BENCHMARK(wholeRepaint)->Apply(cases);

}  // namespace

int main(int argc, char** argv) {
  return runWithoutScreen(argc, argv);
}
