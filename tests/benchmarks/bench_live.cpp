// SPDX-License-Identifier: GPL-3.0-or-later
// The whole studio in Live under the load of 16 senders: what is lost where, how often the window
// is painted meanwhile, what it costs in memory (docs/performance.md). The senders are a process of
// their own. Arguments: datagrams per second (50000), seconds (10). `agents [SECONDS]` instead: 22
// times pitchboard-agent at 20 Hz, with every tenth variable changing all the time.
#include <QApplication>
#include <QEventLoop>
#include <QGraphicsView>
#include <QProcess>
#include <QSettings>
#include <QTemporaryDir>
#include <QThread>
#include <QTimer>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string_view>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <telemetry/formats/text_protocol.h>
#include <telemetry/series/series_store.h>
#include <ui/base/theme.h>
#include <ui/field/field_view.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/window/main_window.h>

#include "../support/test_socket.h"

using namespace pitchboard;
using Clock = std::chrono::steady_clock;

namespace {

constexpr int robots = 16;

/// Sends at a steady rate, writes how many to the pipe, and ends.
[[noreturn]] void sendLoad(int portBase, int perSecond, int seconds, int pipeEnd) {
  const std::array<TestSocket, robots> sockets;
  std::uint64_t sent = 0;
  const auto begin = Clock::now();
  constexpr auto slice = std::chrono::milliseconds(2);
  const int perSlice = perSecond / 500;
  for (auto next = begin; next < begin + std::chrono::seconds(seconds); next += slice) {
    while (Clock::now() < next) usleep(200);
    for (int i = 0; i < perSlice; ++i) {
      const int robot = static_cast<int>(sent % robots);
      telemetry::TextMessage m;
      m.robot = robot + 1;
      m.x = 100 + static_cast<int>(sent / robots % 700);
      m.y = 30 + 35 * robot;
      m.belief = 20.0F;
      m.ballDist = 120.0F;
      m.control = m.vision = m.localization = m.decision = m.imu = 1;
      m.actionA = 8;
      m.voltage = 165;
      const std::string text = telemetry::encode(m);
      const auto port = static_cast<std::uint16_t>(portBase + robot + 1);
      sent += sockets[static_cast<std::size_t>(robot)].send(port, text) ? 1 : 0;
    }
  }
  [[maybe_unused]] const auto written = write(pipeEnd, &sent, sizeof sent);
  _exit(0);
}

double residentMib() {
  std::ifstream statm("/proc/self/statm");
  long total = 0, resident = 0;
  statm >> total >> resident;
  return static_cast<double>(resident) * 4 / 1024;
}

double cpuSeconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Robots 1 to 22 on one blackboard.
class Agents {
 public:
  static constexpr int robots = 22;

  explicit Agents(int portBase) {
    auto made = link::SystemVSegments::open(key, link::AttachMode::AttachOrCreate);
    if (!made) qFatal("%s", made.error().text().c_str());
    m_board = std::make_unique<link::Blackboard>(std::move(*made));
    for (int robot = 1; robot <= robots; ++robot) {
      auto process = std::make_unique<QProcess>();
      process->start(QStringLiteral(PITCHBOARD_BIN "/pitchboard-agent"),
                     {"--robot", QString::number(robot), "--key", QString::number(key), "--to",
                      QStringLiteral("127.0.0.1:%1").arg(portBase + robot)});
      m_processes.push_back(std::move(process));
    }
    QObject::connect(&m_change, &QTimer::timeout, [this] {
      ++m_round;
      int place = 0;
      for (const link::Variable& variable : link::VariableCatalog::published().variables()) {
        if (place++ % 10 != 0) continue;
        if (variable.type == link::VariableType::Int) {
          m_board->write(link::IntVar{variable.index}, m_round % 1000);
        } else {
          m_board->write(link::FloatVar{variable.index}, 0.01F * static_cast<float>(m_round));
        }
      }
    });
    m_change.start(20);
  }
  ~Agents() {
    for (const auto& process : m_processes) {
      process->kill();
      process->waitForFinished();
    }
    m_board.reset();
    (void)link::SystemVSegments::remove(key);
  }

 private:
  const int key = 100 * (10'000'000 + static_cast<int>(getpid()));
  std::unique_ptr<link::Blackboard> m_board;
  std::vector<std::unique_ptr<QProcess>> m_processes;
  QTimer m_change;
  int m_round = 0;
};

struct Paints : QObject {
  int count = 0;
  bool eventFilter(QObject*, QEvent* event) override {
    if (event->type() == QEvent::Paint) ++count;
    return false;
  }
};

}  // namespace

int main(int argc, char** argv) {
  const bool ofAgents = argc > 1 && std::string_view(argv[1]) == "agents";
  const int perSecond = argc > 1 ? std::atoi(argv[1]) : 50'000;
  const int seconds = argc > 2 ? std::atoi(argv[2]) : 10;
  const int portBase = 10000 + static_cast<int>(getpid() % 900) * 20;
  int pipes[2];
  int go[2];
  if (pipe(pipes) != 0 || pipe(go) != 0) return 1;
  const pid_t child = fork();
  if (child == 0) {
    if (ofAgents) _exit(0);
    char byte = 0;
    if (read(go[0], &byte, 1) != 1) _exit(1);
    sendLoad(portBase, perSecond, seconds, pipes[1]);
  }
  if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
  QApplication application(argc, argv);
  ui::setTheme(application, ui::ThemeChoice::Dark);
  const QTemporaryDir folder;
  QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
  ui::MatchController controller{link::MatchOptions()};
  ui::MainWindow window(&controller, &settings);
  window.resize(1280, 800);
  window.show();
  link::LiveOptions options;
  options.bind = {INADDR_LOOPBACK};
  options.portBase = portBase;
  options.refereePort = portBase + 19;
  if (ofAgents) {
    options.robots = Agents::robots;
    options.refereePort = portBase + 60;
    options.variablesPortBase = portBase + 30;
  }
  window.live()->setOptions(options);
  window.showSource(ui::SourceKind::Live);
  Paints paints;
  window.field()->findChild<QGraphicsView*>()->viewport()->installEventFilter(&paints);
  // Not quit(): that would close the window.
  const auto spin = [](std::chrono::milliseconds time) {
    QEventLoop loop;
    QTimer::singleShot(time, &loop, &QEventLoop::quit);
    loop.exec();
  };
  spin(std::chrono::seconds(1));
  if (ofAgents) {
    const Agents agents(options.variablesPortBase);
    spin(std::chrono::seconds(3));
    const double cpu = cpuSeconds();
    const auto begin = Clock::now();
    spin(std::chrono::seconds(seconds));
    const double passed = std::chrono::duration<double>(Clock::now() - begin).count();
    const link::LiveDetails details = window.live()->details();
    std::uint64_t received = 0, lost = 0;
    for (const link::SentStatus& sent : details.sent) {
      received += sent.link.messages;
      lost += sent.link.lost;
    }
    std::printf("%zu robots, %llu datagrams, lost %llu; CPU of the studio %.1f %% of a core\n",
                details.sent.size(), static_cast<unsigned long long>(received),
                static_cast<unsigned long long>(lost), 100.0 * (cpuSeconds() - cpu) / passed);
    return lost == 0 ? 0 : 1;
  }
  [[maybe_unused]] const auto reported = write(go[1], "g", 1);
  spin(std::chrono::seconds(2));  // everything has its size by then
  const double early = residentMib();
  const auto storeEarly = static_cast<double>(window.live()->series()->memoryBytes());
  paints.count = 0;
  const auto begin = Clock::now();
  spin(std::chrono::seconds(seconds - 3));
  const double painted = paints.count / std::chrono::duration<double>(Clock::now() - begin).count();
  const double late = residentMib();
  const auto storeLate = static_cast<double>(window.live()->series()->memoryBytes());
  spin(std::chrono::seconds(2));
  std::uint64_t sent = 0;
  if (read(pipes[0], &sent, sizeof sent) != sizeof sent) return 1;
  waitpid(child, nullptr, 0);
  spin(std::chrono::milliseconds(500));
  const link::LiveDetails details = window.live()->details();
  constexpr double mib = 1024.0 * 1024.0;
  std::printf(
      "sent %llu, received %llu, decoded %llu, lost in the kernel %llu, lost here %llu, bad %llu\n",
      static_cast<unsigned long long>(sent),
      static_cast<unsigned long long>(details.network.datagrams()),
      static_cast<unsigned long long>(details.team.datagrams),
      static_cast<unsigned long long>(details.network.kernelDrops()),
      static_cast<unsigned long long>(details.network.queueDrops),
      static_cast<unsigned long long>(details.team.errors.messages()));
  std::printf("field painted %.1f times a second\n", painted);
  std::printf(
      "memory grew by %.1f MiB, of which %.1f MiB are rows (bounded by the store's budget)\n",
      late - early, (storeLate - storeEarly) / mib);
  return 0;
}
