// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/session/export_forms.h>

#include <QFileInfo>
#include <QtGlobal>

#include <base/try.h>
#include <robotlink/report/report.h>
#include <robotlink/session/live_moments.h>
#include <robotlink/session/session_events.h>

namespace pitchboard::ui {
namespace {

using telemetry::ExportFormat;

const ExportForm forms[] = {
    {"Table, one row per time (CSV)", ExportKind::Numbers, ".csv", ExportFormat::CsvWide},
    {"Table at a fixed rate (CSV)", ExportKind::Numbers, ".csv", ExportFormat::CsvEven},
    {"Table, one row per value (CSV)", ExportKind::Numbers, ".csv", ExportFormat::CsvLong},
    {"JSON lines", ExportKind::Numbers, ".jsonl", ExportFormat::JsonLines},
    {"Part of the session (MCAP)", ExportKind::Numbers, ".mcap", ExportFormat::Mcap},
    {"Report (HTML)", ExportKind::Report, ".html"},
    {"Picture of the field (PNG)", ExportKind::Png, ".png"},
    {"Picture of the field (SVG)", ExportKind::Svg, ".svg"},
    {"Video of the field (MP4)", ExportKind::Video, ".mp4"},
    {"Video of the field (WebM)", ExportKind::Video, ".webm"},
};

Result<std::uint64_t> writeReport(const telemetry::SessionReader& session,
                                  const ExportRequest& request, const QByteArray& picture) {
  const telemetry::TimeRange range = request.selection.range;
  link::ReportContent content;
  content.session = session.info();
  content.title = content.session.title;
  content.statistics = link::statisticsOf(session, {range.begin, range.end});
  content.events = link::eventsOf(session);
  link::keepRobots(content, TRY(link::RobotChoice::of(session, request.selection.robots)));
  content.picture = picture.toStdString();
  content.notes = session.notes();
  const auto done = link::writeReport(request.path.toStdString(), content, IfExists::Replace,
                                      request.session.toStdString());
  if (!done) return tl::unexpected(done.error());
  return static_cast<std::uint64_t>(QFileInfo(request.path).size());
}

}  // namespace

Result<std::uint64_t> writeExport(const ExportRequest& request, const ExportForm& form,
                                  const QByteArray& picture,
                                  const telemetry::ExportProgress& progress) {
  const auto session = telemetry::SessionReader::open(request.session.toStdString());
  if (!session) return tl::unexpected(session.error());
  if (form.kind == ExportKind::Report) return writeReport(*session, request, picture);
  telemetry::ExportSelection selection = request.selection;
  if (form.format == ExportFormat::Mcap) {
    selection.opening = link::openingAt(*session, selection.range.begin);
  }
  TRY(link::chooseRobots(*session, form.format, selection));
  const auto report = telemetry::exportFile(
      *session, form.format, selection, request.path.toStdString(), progress, IfExists::Replace);
  if (!report) return tl::unexpected(report.error());
  return report->bytes;
}

std::span<const ExportForm> exportForms() {
  return forms;
}

}  // namespace pitchboard::ui
