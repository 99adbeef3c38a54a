// SPDX-License-Identifier: GPL-3.0-or-later
#include "paint.h"

#include <QApplication>
#include <QFileInfo>
#include <QTimer>
#include <cstdio>

#include <app/command_line.h>
#include <base/file_target.h>
#include <robotlink/session/recorded_frame.h>
#include <ui/field/field_view.h>
#include <ui/session/video_export.h>
#include <ui/sources/match_controller.h>

#include "end_signals.h"

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

}  // namespace

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
  constexpr int longestWait = 10000;
  QTimer limit;
  limit.setSingleShot(true);
  limit.start(longestWait);
  while (!failed && !controller.frame() && limit.isActive()) {
    QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  }
  if (failed || !controller.frame()) return 2;
  return writePicture(field, arguments, {within.width, within.height}, IfExists::Replace);
}

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
  link::RecordedFrames frames(link::backdropOf(*session), arguments.paintRobots);
  const auto frame = std::make_shared<link::MatchFrame>(frames.frameAt(*session, range.begin));
  ui::FieldView field(static_cast<ui::FrameSource*>(nullptr), nullptr);
  field.showFrame(frame);
  const QSize size(within.width, within.height);
  const QString suffix = QFileInfo(QString::fromStdString(arguments.picture)).suffix().toLower();
  const bool video = suffix == QLatin1String("mp4") || suffix == QLatin1String("webm");
  return video ? writeVideo(field, arguments, size, range)
               : writePicture(field, arguments, size, IfExists::Refuse);
}

}  // namespace pitchboard::studio
