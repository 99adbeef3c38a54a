// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The selected part of a session as a session of its own.

#include <telemetry/mcap/mcap_writer.h>

#include "export_selection.h"

namespace pitchboard::telemetry {

/// Fills and finishes `out`. Progress and errors as exportFile().
Result<ExportReport> writeClip(const SessionReader& session, const ExportSelection& selection,
                               const std::vector<SelectedGroup>& selected, McapWriter& out,
                               const ExportProgress& progress);

tl::unexpected<Error> exportStopped();

}  // namespace pitchboard::telemetry
