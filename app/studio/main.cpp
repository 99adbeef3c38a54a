// SPDX-License-Identifier: GPL-3.0-or-later
#include <QApplication>
#include <QDir>
#include <QFileInfo>
#include <QIcon>
#include <QSaveFile>
#include <QSettings>
#include <QTimer>
#include <cmath>
#include <csignal>
#include <cstdio>

#include <app/command_line.h>
#include <robotlink/processes/team_program.h>
#include <ui/base/save_file.h>
#include <ui/base/theme.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/timeline.h>
#include <ui/window/main_window.h>
#include <ui/window/scenario_files.h>

#include "arguments.h"
#include "end_signals.h"
#include "paint.h"
#include "running_studio.h"

namespace pitchboard::studio {
namespace {

constexpr WindowSize pictureSize{1280, 960};  // of which the field takes its shape

QIcon programIcon() {
  QIcon icon;
  for (const char* size : {"16", "32", "48", "256"}) {
    icon.addFile(QStringLiteral(":/icons/%1.png").arg(QLatin1String(size)));
  }
  return icon;
}

std::unique_ptr<QSettings> makeSettings(const Arguments& arguments) {
  if (!arguments.settings.empty()) {
    return std::make_unique<QSettings>(QString::fromStdString(arguments.settings),
                                       QSettings::IniFormat);
  }
  return std::make_unique<QSettings>();
}

ui::ThemeChoice themeOf(const Arguments& arguments, const QSettings& settings) {
  if (arguments.theme == "light") return ui::ThemeChoice::Light;
  if (arguments.theme == "dark") return ui::ThemeChoice::Dark;
  const int saved = settings.value(QStringLiteral("window/theme")).toInt();
  return saved == 1   ? ui::ThemeChoice::Light
         : saved == 2 ? ui::ThemeChoice::Dark
                      : ui::ThemeChoice::FollowDesktop;
}

link::MatchOptions matchOptions(const Arguments& arguments) {
  link::MatchOptions options;
  options.cognition = cognitionOf(arguments);
  shared::apply(arguments.processes, options);
  options.cognitionDebug = true;
  options.robotProgram = link::besideTeamProgram("pitchboard-robot");
  return options;
}

bool save(const QPixmap& picture, const std::string& file) {
  const QString path = QString::fromStdString(file);
  QSaveFile out(path);
  if (out.open(QIODevice::WriteOnly) &&
      picture.save(&out, QFileInfo(path).suffix().toLatin1().constData()) && ui::commitWhole(out)) {
    return true;
  }
  shared::reportError(
      {ErrorCode::SystemError,
       "cannot write the picture. Choose an existing folder and a name that ends in .png", file});
  return false;
}

/// Whether a recording can be made there; said before a window opens.
Result<void> checkRecordFolder(const Arguments& arguments) {
  if (arguments.record.empty()) return {};
  const QDir folder = QFileInfo(QString::fromStdString(arguments.record)).dir();
  if (folder.mkpath(QStringLiteral(".")) && QFileInfo(folder.path()).isWritable()) return {};
  return failure(
      ErrorCode::SystemError,
      "cannot create a file in the folder " + folder.path().toStdString() + ". Choose another one",
      "--record");
}

int showWindow(QApplication& application, const Arguments& arguments,
               const link::Scenario& scenario, double speed, std::optional<WindowSize> size,
               std::optional<double> start, QSettings& settings) {
  // They end in the opposite order: the window completes its files while the match is there, and a
  // second signal does not break that off.
  int exitCode = 0;
  EndSignals signals_;
  ui::MatchController controller(matchOptions(arguments));
  std::optional<ui::MainWindow> made(std::in_place, &controller, &settings);
  ui::MainWindow& window = *made;
  QObject::connect(&signals_, &EndSignals::received, &window, &QWidget::close);
  if (size) window.resize(size->width, size->height);
  window.offerToRemoveOrphans();
  controller.setSpeed(speed);
  const auto live = liveOptionsOf(arguments, window.live()->options());
  if (!live) return shared::reportError(live.error());
  window.live()->setOptions(*live);
  if (start) {
    QObject::connect(
        window.replay(), &ui::ReplayController::opened, &window,
        [&window, start] { window.timeline()->seek(*start); }, Qt::SingleShotConnection);
  }
  if (!arguments.session.empty()) window.openSession(QString::fromStdString(arguments.session));
  const bool recordsMatch = !arguments.record.empty() && !arguments.live;
  if ((!arguments.live && arguments.session.empty()) || arguments.scenarioGiven) {
    // A match that is to be recorded starts once its recorder observes it.
    controller.open(scenario, arguments.paused || recordsMatch);
    window.files()->showCurrent(QString::fromStdString(arguments.match.scenario));
  }
  if (arguments.live) window.showSource(ui::SourceKind::Live);
  if (arguments.overlay) window.overlayLive(true);
  const auto play = [&arguments, &controller] {
    if (arguments.playTo) controller.runTo(*arguments.playTo);
  };
  const auto record = [&arguments, &application, &exitCode, &window] {
    if (arguments.record.empty()) return;
    QObject::connect(&window, &ui::MainWindow::recordingFailed, &application,
                     [&exitCode](const QString& sentence) {
                       exitCode = 2;
                       std::fprintf(stderr, "error: %s\n", qPrintable(sentence));
                     });
    window.recordInto(QString::fromStdString(arguments.record));
  };
  if (recordsMatch) {
    QObject::connect(
        &controller, &ui::MatchController::opened, &window,
        [&arguments, &controller, record, play] {
          record();
          controller.setPaused(arguments.paused);
          play();
        },
        Qt::SingleShotConnection);
  } else {
    record();
    play();
  }
  window.show();
  std::optional<RunningStudio> running;
  if (const QString socket = studioSocket(arguments); !socket.isEmpty()) {
    running.emplace(socket, [&window](const QString& file) {
      if (!window.isVisible()) return false;  // it ends
      window.openSession(file);
      window.setWindowState(window.windowState() & ~Qt::WindowMinimized);
      window.raise();
      window.activateWindow();
      return true;
    });
  }
  if (!arguments.screenshotFile.empty()) {
    const int wait = static_cast<int>(std::lround(arguments.after * 1000));
    QTimer::singleShot(wait, &window, [&] {
      exitCode = save(window.grab(), arguments.screenshotFile) ? 0 : 2;
      window.close();
    });
  }
  const int ended = application.exec();
  running.reset();
  made.reset();
  return ended != 0 ? ended : exitCode;
}

int run(int argc, char** argv) {
  Arguments arguments;
  if (const auto exitCode = parseArguments(argc, argv, arguments)) return *exitCode;
  const auto speed = shared::speedFrom(arguments.speed);
  if (!speed) return shared::reportError(speed.error());
  const auto size = sizeOf(arguments);
  if (!size) return shared::reportError(size.error());
  const auto scenario = scenarioOf(arguments);
  if (!scenario) return shared::reportError(scenario.error());
  const auto start = startOf(arguments);
  if (!start) return shared::reportError(start.error());

  const bool render = !arguments.renderScenario.empty() || !arguments.paint.empty();
  if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM") && qEnvironmentVariableIsEmpty("DISPLAY") &&
      qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY")) {
    if (!render && arguments.screenshotFile.empty()) {
      return shared::reportError(
          {ErrorCode::SystemError,
           "no display to open a window on. Use pitchboard-cli, or set QT_QPA_PLATFORM=offscreen",
           {}});
    }
    qputenv("QT_QPA_PLATFORM", "offscreen");
  }
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing, not the end
  QApplication::setOrganizationName(QStringLiteral("Pitchboard"));
  QApplication::setApplicationName(QStringLiteral("Pitchboard"));
  QApplication::setApplicationVersion(QStringLiteral(PITCHBOARD_VERSION));
  int applicationArguments = 1;
  QApplication application(applicationArguments, argv);
  QApplication::setWindowIcon(programIcon());
  // Wayland finds the icon by the name of the desktop entry.
  QApplication::setDesktopFileName(QStringLiteral("org.pitchboard.Pitchboard"));
  if (arguments.onlySession &&
      handOver(studioSocket(arguments), QString::fromStdString(arguments.session))) {
    return 0;
  }
  if (const auto good = checkRecordFolder(arguments); !good)
    return shared::reportError(good.error());
  const auto settings = makeSettings(arguments);
  ui::setTheme(application, themeOf(arguments, *settings));
  if (!arguments.paint.empty()) return paintSession(arguments, size->value_or(pictureSize));
  if (render) return paintScenario(arguments, *scenario, size->value_or(pictureSize));
  return showWindow(application, arguments, *scenario, *speed, *size, *start, *settings);
}

}  // namespace
}  // namespace pitchboard::studio

int main(int argc, char** argv) {
  return pitchboard::studio::run(argc, argv);
}
