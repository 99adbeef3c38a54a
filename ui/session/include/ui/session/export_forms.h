// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The formats in which part of a session can be exported, and functions that write those formats
// that need only the session file. Any thread.

#include <QByteArray>
#include <QString>
#include <span>

#include <telemetry/session/session_export.h>

namespace pitchboard::ui {

enum class ExportKind { Numbers, Report, Png, Svg, Video };

struct ExportForm {
  const char* title;
  ExportKind kind;
  const char* suffix;                                                 ///< ".csv"
  telemetry::ExportFormat format = telemetry::ExportFormat::CsvWide;  ///< Numbers only
};
std::span<const ExportForm> exportForms();

struct ExportRequest {
  QString session;  ///< the file that is read
  QString path;     ///< the file that is written
  telemetry::ExportSelection selection;
};

/// Writes numbers or a report, in which `picture` is included, and returns the size of the file. An
/// old file is replaced once the new one is complete.
Result<std::uint64_t> writeExport(const ExportRequest& request, const ExportForm& form,
                                  const QByteArray& picture,
                                  const telemetry::ExportProgress& progress);

}  // namespace pitchboard::ui
