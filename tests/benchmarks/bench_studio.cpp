// SPDX-License-Identifier: GPL-3.0-or-later
// The whole window as a person has it (docs/performance.md):
//   bench_studio paused [SECONDS]  3 against 3 that stands still
//   bench_studio match [SECONDS]   the same while it is played
//   bench_studio live [SECONDS]    22 robots at 60 messages a second each over UDP, all panels
//   bench_studio start [TIMES]     from the start of a process to its first frame of a match
//   bench_studio replay FILE       from a jump in a session larger than memory to a minute of
//     curves; FILE: pitchboard-cli record --scenario match-3v3 --duration 1800 -o FILE
//   bench_studio splitter          dragging the edge of a panel beside three plots of a match
//   bench_studio library FOLDER    until all sessions of a folder are listed, at first and again
// The first three give the CPU time of the studio as a share of a core; robots and senders are
// processes of their own. Under Xvfb:
//   xvfb-run -a -s "-screen 0 1920x1080x24" env QT_QPA_PLATFORM=xcb bench_studio live
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QEventLoop>
#include <QGraphicsView>
#include <QLabel>
#include <QMouseEvent>
#include <QSettings>
#include <QStyle>
#include <QTemporaryDir>
#include <QTimer>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <robotlink/scenario/scenario.h>
#include <telemetry/formats/text_protocol.h>
#include <ui/base/theme.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>

#include "../support/test_socket.h"
#include "chart_pane.h"

using namespace pitchboard;
using Clock = std::chrono::steady_clock;

namespace {

constexpr int robots = 22;
constexpr int perSecond = 60;
constexpr double frameMilliseconds = 1000.0 / 60.0;

double cpuMilliseconds() {
  rusage use{};
  ::getrusage(RUSAGE_SELF, &use);
  const auto ms = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_usec) * 1e-3;
  };
  return ms(use.ru_utime) + ms(use.ru_stime);
}

/// How often a thread of this process has gone to sleep.
long sleeps() {
  rusage use{};
  ::getrusage(RUSAGE_SELF, &use);
  return use.ru_nvcsw;
}

double millisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// A robot that walks a curve of its own and looks at a ball.
std::string message(int robot, double time) {
  const double a = 0.3 * time + robot;
  telemetry::TextMessage m;
  m.robot = robot;
  m.x = 520 + static_cast<int>(70.0 * (robot % 5 + 1) * std::cos(a));
  m.y = 390 + static_cast<int>(60.0 * (robot % 4 + 1) * std::sin(1.3 * a));
  m.theta = static_cast<int>(90.0 * std::sin(a));
  m.belief = static_cast<float>(20.0 + 10.0 * std::sin(a));
  m.ballDist = static_cast<float>(80.0 + 50.0 * std::sin(2.0 * a));
  m.ballAngle = static_cast<float>(20.0 * std::sin(3.0 * a));
  m.control = m.vision = m.localization = m.decision = m.imu = 1;
  m.actionA = static_cast<int>(time / 2.0 + robot) % 3 == 0 ? 3 : 8;
  m.voltage = 165;
  return telemetry::encode(m);
}

/// Sends until it is killed.
[[noreturn]] void sendRobots(int portBase) {
  const TestSocket socket;
  const auto begin = Clock::now();
  for (int round = 0;; ++round) {
    const double time = static_cast<double>(round) / perSecond;
    for (int robot = 1; robot <= robots; ++robot) {
      const auto port = static_cast<std::uint16_t>(portBase + robot);
      if (!socket.send(port, message(robot, time))) _exit(1);
    }
    const double wait = time * 1e3 - millisecondsSince(begin);
    if (wait > 0) usleep(static_cast<useconds_t>(wait * 1e3));
  }
}

// Not quit(): that would close the window.
void spin(std::chrono::milliseconds time) {
  QEventLoop loop;
  QTimer::singleShot(time, &loop, &QEventLoop::quit);
  loop.exec();
}

struct Paints : QObject {
  int count = 0;
  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    if (event->type() == QEvent::Paint) ++count;
    return false;
  }
};

/// The studio with settings of its own, as at the first start.
struct Studio {
  explicit Studio(QSize size, const link::MatchOptions& options = {})
      : controller(options), window(&controller, &settings) {
    window.resize(size);
  }
  QWidget* canvas() const { return window.field()->findChild<QGraphicsView*>()->viewport(); }
  QTemporaryDir folder;
  QSettings settings{folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat};
  ui::MatchController controller;
  ui::MainWindow window;
};

/// What the window costs while time passes.
void measure(const char* what, const Studio& studio, int seconds, double most) {
  Paints paints;
  studio.canvas()->installEventFilter(&paints);
  const double before = cpuMilliseconds();
  const long sleptBefore = sleeps();
  const auto begin = Clock::now();
  spin(std::chrono::seconds(seconds));
  const double cpu = cpuMilliseconds() - before, took = millisecondsSince(begin);
  std::printf(
      "%s: %.2f %% of a core (wanted: %.0f %%), field painted %.1f times a second, %.0f sleeps a "
      "second\n",
      what, 100.0 * cpu / took, most, 1e3 * paints.count / took,
      1e3 * static_cast<double>(sleeps() - sleptBefore) / took);
}

/// With robots in processes of their own, as the studio starts them.
int match(int seconds, bool paused) {
  link::MatchOptions options;
  options.cognition = link::Cognition::Separate;
  options.cognitionDebug = true;
  options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
  Studio studio({1440, 900}, options);
  const auto scenario = link::loadScenario("match-3v3");
  if (!scenario) return 1;
  studio.controller.open(*scenario, false);
  studio.window.show();
  spin(std::chrono::seconds(5));
  studio.controller.setPaused(paused);
  spin(std::chrono::seconds(2));
  measure(paused ? "3 against 3, paused" : "3 against 3, 1440x900", studio, seconds,
          paused ? 1.0 : 15.0);
  return 0;
}

void openEveryDock(const ui::MainWindow& window) {
  QWidget* plots = nullptr;
  QWidget* variables = nullptr;
  for (auto* dock : window.findChildren<QDockWidget*>()) {
    dock->show();
    if (dock->objectName() == QStringLiteral("plots")) plots = dock;
    if (dock->objectName() == QStringLiteral("variables")) variables = dock;
  }
  // Of those in one place the two that cost most are in front.
  plots->raise();
  variables->raise();
}

int live(int seconds, int portBase, pid_t sender) {
  Studio studio({1920, 1080});
  link::LiveOptions options;
  options.bind = {INADDR_LOOPBACK};
  options.portBase = portBase;
  options.robots = robots;
  options.refereePort = portBase + robots + 1;
  studio.window.live()->setOptions(options);
  studio.window.show();
  studio.window.showSource(ui::SourceKind::Live);
  openEveryDock(studio.window);
  spin(std::chrono::seconds(4));  // sizes, curves and memory are what they stay
  measure("22 robots at 60 messages/s, every panel open", studio, seconds, 25.0);
  kill(sender, SIGKILL);
  waitpid(sender, nullptr, 0);
  return 0;
}

/// Of a process that has just been started.
int firstFrame(Clock::time_point begin) {
  Studio studio({1440, 900});
  bool painted = false;
  struct Seen : QObject {
    std::function<void()> call;
    bool eventFilter(QObject* /*watched*/, QEvent* event) override {
      if (event->type() == QEvent::Paint) QTimer::singleShot(0, this, call);
      return false;
    }
  } seen;
  QEventLoop loop;
  seen.call = [&] {
    if (painted || !studio.controller.frame()) return;
    painted = true;
    std::printf("%.0f\n", millisecondsSince(begin));
    loop.quit();
  };
  studio.canvas()->installEventFilter(&seen);
  const auto scenario = link::loadScenario("match");
  if (!scenario) return 1;
  studio.controller.open(*scenario, false);
  studio.window.show();
  loop.exec();
  return 0;
}

int start(const char* program, int times) {
  std::vector<double> took;
  for (int i = 0; i < times; ++i) {
    const auto begin = std::to_string(Clock::now().time_since_epoch().count());
    const std::string command = std::string(program) + " first-frame " + begin;
    FILE* child = popen(command.c_str(), "r");
    char line[64] = {};
    if (child == nullptr || std::fgets(line, sizeof line, child) == nullptr || pclose(child) != 0) {
      std::fprintf(stderr, "error: the studio did not start\n");
      return 2;
    }
    took.push_back(std::atof(line));
  }
  std::sort(took.begin(), took.end());
  std::printf("first frame: %.0f ms at best, median of %d %.0f ms (wanted: 500)\n", took.front(),
              times, took[took.size() / 2]);
  return 0;
}

void mouse(QWidget* window, QEvent::Type type, QPoint at) {
  const bool moves = type == QEvent::MouseMove, ends = type == QEvent::MouseButtonRelease;
  QMouseEvent event(type, at, window->mapToGlobal(at), moves ? Qt::NoButton : Qt::LeftButton,
                    ends ? Qt::NoButton : Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(window, &event);
}

int splitter() {
  Studio studio({1440, 900});
  const auto scenario = link::loadScenario("match-3v3");
  if (!scenario) return 1;
  studio.controller.open(*scenario, false);
  studio.window.show();
  spin(std::chrono::seconds(3));
  auto* plots = studio.window.findChild<ui::PlotsDock*>();
  plots->plotVariables({QStringLiteral("B1/LOCALIZATION_X")});
  spin(std::chrono::seconds(2));
  const auto* dock = studio.window.findChild<QDockWidget*>(QStringLiteral("plots"));
  // Of the row of docks below the field, whose height every plot follows.
  const QPoint from(studio.window.width() / 2,
                    dock->mapTo(&studio.window, QPoint(0, 0)).y() - 2 -
                        studio.window.style()->pixelMetric(QStyle::PM_TabBarTabVSpace));
  QPoint edge = from;
  while (edge.y() > 0 && studio.window.childAt(edge) != nullptr) edge.ry() -= 1;
  const int before = dock->height();
  constexpr int steps = 120;
  std::vector<double> cpu, real;
  mouse(&studio.window, QEvent::MouseMove, edge);
  mouse(&studio.window, QEvent::MouseButtonPress, edge);
  int farthest = before;
  for (int step = 1; step <= steps; ++step) {
    const double cpuBefore = cpuMilliseconds();
    const auto begin = Clock::now();
    const int way = step <= steps / 2 ? step : steps - step;
    mouse(&studio.window, QEvent::MouseMove, edge - QPoint(0, 2 * way));
    QCoreApplication::processEvents();
    cpu.push_back(cpuMilliseconds() - cpuBefore);
    real.push_back(millisecondsSince(begin));
    farthest = std::max(farthest, dock->height());
  }
  mouse(&studio.window, QEvent::MouseButtonRelease, edge);
  if (farthest <= before) {
    std::fprintf(stderr, "error: the edge did not move\n");
    return 2;
  }
  std::sort(cpu.begin(), cpu.end());
  std::sort(real.begin(), real.end());
  std::printf(
      "a step of the edge: CPU time median %.1f ms, 9 of 10 below %.1f ms; real time median "
      "%.1f ms (wanted: below %.1f)\n",
      cpu[steps / 2], cpu[steps * 9 / 10], real[steps / 2], frameMilliseconds);
  return 0;
}

int replay(const char* path) {
  Studio studio({1440, 900});
  studio.window.setMemoryBudget(256);  // MB; half an hour takes about 900
  studio.window.show();
  studio.window.openSession(QString::fromUtf8(path));
  const auto* file = studio.window.replay();
  while (!file->isOpen() || file->loaded() < 1.0) spin(std::chrono::milliseconds(20));
  auto* plots = studio.window.findChild<ui::PlotsDock*>();
  ui::PaneSpec pane;
  pane.curves << ui::variableCurve(QStringLiteral("B1/LOCALIZATION_X"))
              << ui::variableCurve(QStringLiteral("B2/LOCALIZATION_X"));
  plots->setLayoutSpec({{ui::PageSpec{QStringLiteral("one"), {pane}}}, 0});
  plots->time()->setWindow(60.0);
  spin(std::chrono::seconds(2));
  const auto* chart = studio.window.findChild<ui::ChartPane*>();
  const double length = studio.window.shown()->available()->end;
  constexpr int times = 40;
  constexpr double maxFetch = 20'000.0;  // ms
  std::vector<double> cpu, real;
  for (int i = 0; i < times; ++i) {
    // Neither what was read before nor what lies beside it.
    const double time = 60.0 + std::fmod(0.382 * (i + 1), 1.0) * (length - 120.0);
    const auto isDrawn = [&] {
      const telemetry::TimeRange shown = chart->timeAxis().shown;
      constexpr double tick = 1.0 / 60.0;  // the moment that is shown lies on one
      // Until it is drawn again, the chart has the curves of the moment before.
      const auto isOfNow = [&shown](const ui::CurveTrace& trace) {
        return trace.any && !trace.coarse && !trace.columns.empty() &&
               std::abs(trace.columns.front().time - shown.begin) < 1.0 &&
               std::abs(trace.columns.back().time - shown.end) < 1.0;
      };
      return shown.begin <= time + tick && time - tick <= shown.end &&
             std::ranges::all_of(chart->traces(), isOfNow);
    };
    const double cpuBefore = cpuMilliseconds();
    const auto begin = Clock::now();
    studio.window.shown()->seek(time);
    while (!isDrawn()) {
      QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
      if (millisecondsSince(begin) < maxFetch) continue;
      const auto& trace = chart->traces()[0];
      std::fprintf(stderr,
                   "error: the curves at %.1f s are not drawn; shown: %.1f to %.1f s, curve: %s\n",
                   time, chart->timeAxis().shown.begin, chart->timeAxis().shown.end,
                   !trace.any      ? "empty"
                   : trace.reading ? "being read"
                                   : "an envelope");
      return 2;
    }
    QCoreApplication::processEvents();  // the stroke that was asked for
    cpu.push_back(cpuMilliseconds() - cpuBefore);
    real.push_back(millisecondsSince(begin));
    spin(std::chrono::milliseconds(300));
  }
  std::sort(cpu.begin(), cpu.end());
  std::sort(real.begin(), real.end());
  std::printf(
      "a minute of curves after a jump: median %.0f ms, 9 of 10 below %.0f ms, CPU time of all "
      "threads median %.0f ms (wanted: 100)\n",
      real[times / 2], real[times * 9 / 10], cpu[times / 2]);
  return 0;
}

/// From showing the library to all of its rows; ms.
double listed(const char* folder) {
  Studio studio({1440, 900});
  studio.settings.setValue(QStringLiteral("library/folders"),
                           QStringList{QString::fromUtf8(folder)});
  studio.window.show();
  spin(std::chrono::seconds(1));
  const auto* state = studio.window.findChild<QLabel*>(QStringLiteral("libraryState"));
  const auto begin = Clock::now();
  studio.window.findChild<QAction*>(QStringLiteral("showLibrary"))->trigger();
  while (state->text().startsWith(QLatin1Char('0')) || state->text().contains(QLatin1Char(','))) {
    QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
  }
  const double took = millisecondsSince(begin);
  std::printf("%s in %.0f ms\n", qPrintable(state->text()), took);
  return took;
}

int library(const char* folder) {
  const QTemporaryDir cache;
  qputenv("XDG_CACHE_HOME", cache.path().toUtf8());
  const double first = listed(folder), again = listed(folder);
  std::printf("read in %.0f ms; at the next start listed in %.0f ms (wanted: 1000)\n", first,
              again);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const int number = argc > 2 ? std::atoi(argv[2]) : 0;
  if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
  if (what == "start") return start(argv[0], number > 0 ? number : 7);
  const int portBase = 10000 + static_cast<int>(getpid() % 900) * 30;
  pid_t sender = 0;
  if (what == "live") {
    sender = fork();
    if (sender == 0) sendRobots(portBase);
  }
  QApplication application(argc, argv);
  ui::setTheme(application, ui::ThemeChoice::Dark);
  if (what == "live") return live(number > 0 ? number : 20, portBase, sender);
  if (what == "paused" || what == "match") return match(number > 0 ? number : 20, what == "paused");
  if (what == "splitter") return splitter();
  if (what == "replay" && argc > 2) return replay(argv[2]);
  if (what == "library" && argc > 2) return library(argv[2]);
  if (what == "first-frame" && argc > 2) {
    return firstFrame(Clock::time_point(Clock::duration(std::atoll(argv[2]))));
  }
  std::fprintf(
      stderr,
      "error: bench_studio paused|match|live [SECONDS] | start [TIMES] | splitter | replay FILE | "
      "library FOLDER\n");
  return 2;
}
