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
#include <base/file_target.h>
#include <robotlink/processes/team_program.h>
#include <robotlink/session/recorded_frame.h>
#include <telemetry/session/drawn_notes.h>
#include <ui/base/save_file.h>
#include <ui/base/theme.h>
#include <ui/field/field_view.h>
#include <ui/session/video_export.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>
#include <ui/window/scenario_files.h>

#include "arguments.h"
#include "end_signals.h"
#include "running_studio.h"

namespace pitchboard::studio {
namespace {

int writePicture(const ui::FieldView& field, const Arguments& arguments, QSize within,
                 IfExists ifExists) {
  const QByteArray bytes =
      field.pictureFile(within, QFileInfo(QString::fromStdString(arguments.picture)).suffix());
  if (bytes.isEmpty()) {
    return shared::reportError({ErrorCode::InvalidArgument,
                                "the name of a picture must end in .png or .svg",
                                arguments.picture});
  }
  const auto written =
      writeFile(arguments.picture, {bytes.constData(), static_cast<std::size_t>(bytes.size())},
                ifExists, arguments.paint);
  return written ? 0 : shared::reportError(written.error());
}

int writeVideo(const ui::FieldView& field, const Arguments& arguments, QSize within,
               telemetry::TimeRange range) {
  ui::VideoExport video(field.framePainter(), nullptr);
  EndSignals signals_;
  int exitCode = 0;
  const auto end = [&](const QString& sentence) {
    exitCode = shared::reportError({ErrorCode::SystemError, sentence.toStdString(), {}});
    QApplication::exit();
  };
  QObject::connect(&video, &ui::VideoExport::progressed, &video, [](double part) {
    std::printf("%.4f\n", part);
    std::fflush(stdout);
  });
  QObject::connect(&video, &ui::VideoExport::finished, &video, [] { QApplication::exit(); });
  QObject::connect(&video, &ui::VideoExport::failed, &video, end);
  QObject::connect(&signals_, &EndSignals::received, &video, [&] {
    video.cancel();
    end(QStringLiteral("Export cancelled."));
  });
  ui::VideoOptions options;
  options.path = QString::fromStdString(arguments.picture);
  options.size = field.pictureSize(within);
  options.framesPerSecond = arguments.rate;
  if (const auto started = video.start(QString::fromStdString(arguments.paint), range,
                                       arguments.paintRobots, options);
      !started) {
    return shared::reportError(started.error());
  }
  QApplication::exec();
  return exitCode;
}

/// Paints a scenario's start into arguments.picture; returns the exit code.
int paintScenario(const Arguments& arguments, const link::Scenario& scenario, WindowSize within) {
  link::MatchOptions options;
  options.cognition = link::Cognition::Inline;
  ui::MatchController controller(options);
  bool failed = false;
  QObject::connect(&controller, &ui::MatchController::errorOccurred, &controller,
                   [&failed](const QString& sentence) {
                     failed = true;
                     std::fprintf(stderr, "error: %s\n", qPrintable(sentence));
                   });
  ui::FieldView field(&controller);
  controller.open(scenario, true);
  constexpr int maxWait = 10000;
  QTimer limit;
  limit.setSingleShot(true);
  limit.start(maxWait);
  while (!failed && !controller.frame() && limit.isActive()) {
    QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  }
  if (failed || !controller.frame()) return 2;
  return writePicture(field, arguments, {within.width, within.height}, IfExists::Replace);
}

/// Paints a moment of a session, or a video of part of it. Prints the progress of a video to
/// stdout, as lines with a number from 0 to 1. Returns the exit code.
int paintSession(const Arguments& arguments, WindowSize within) {
  const auto session = telemetry::SessionReader::open(arguments.paint);
  if (!session) return shared::reportError(session.error());
  const auto all = session->range();
  if (!all) {
    return shared::reportError({ErrorCode::NotFound, "the recording is empty", arguments.paint});
  }
  const auto from = timeIn(*session, arguments.from, "--from");
  if (!from) return shared::reportError(from.error());
  const auto until = timeIn(*session, arguments.until, "--until");
  if (!until) return shared::reportError(until.error());
  const telemetry::TimeRange range{from->value_or(all->begin), until->value_or(all->end)};
  const auto robots = link::RobotChoice::of(*session, arguments.paintRobots);
  if (!robots) return shared::reportError(robots.error());
  link::RecordedFrames frames(link::backdropOf(*session), *robots);
  const auto frame = std::make_shared<link::MatchFrame>(frames.frameAt(*session, range.begin));
  ui::FieldView field(static_cast<ui::FrameSource*>(nullptr), nullptr);
  field.showFrame(frame);
  if (auto drawn = telemetry::readDrawnNotes(arguments.paint)) {
    field.setDrawnNotes(std::move(drawn->notes));
  }
  const QSize size(within.width, within.height);
  const QString suffix = QFileInfo(QString::fromStdString(arguments.picture)).suffix().toLower();
  const bool video = suffix == QLatin1String("mp4") || suffix == QLatin1String("webm");
  return video ? writeVideo(field, arguments, size, range)
               : writePicture(field, arguments, size, IfExists::Refuse);
}

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
  options.cognition = shared::cognitionOf(arguments.processes);
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
  return failure(ErrorCode::SystemError,
                 "cannot create files in the folder " + folder.path().toStdString() +
                     "; choose another folder",
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
  QObject::connect(&signals_, &EndSignals::received, &window, &ui::MainWindow::closeNow);
  if (size) window.resize(size->width, size->height);
  window.offerToRemoveOrphans();
  window.offerLostRecordings();
  controller.setSpeed(speed);
  const auto live = liveOptionsOf(arguments, window.live()->options());
  if (!live) return shared::reportError(live.error());
  window.live()->setOptions(*live);
  if (start) {
    QObject::connect(
        window.replay(), &ui::ReplayController::opened, &window,
        [&window, start] { window.shown()->seek(*start); }, Qt::SingleShotConnection);
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
      window.closeNow();
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
  const auto speed = shared::speedFrom(arguments.processes.speed);
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
