// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The forms in which part of a session leaves the studio, and the writing of those that need
// nothing but the session. Any thread.

#include <QByteArray>
#include <QString>
#include <span>

#include <telemetry/session/session_export.h>

namespace pitchboard::ui {

enum class ExportKind { Numbers, Report, Png, Svg, Video };

struct ExportForm {
  const char* words;
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

/// Numbers or a report; the bytes of the file. `picture` stands in a report. An old file goes when
/// the new one is whole.
Result<std::uint64_t> writeExport(const ExportRequest& request, const ExportForm& form,
                                  const QByteArray& picture,
                                  const telemetry::ExportProgress& progress);

}  // namespace pitchboard::ui
