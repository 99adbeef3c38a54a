// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What team setups make of datagrams that have arrived: whose each one is and which values it has,
// or why it cannot be read and which of the known formats it has. Pure functions; any thread.

#include <QString>
#include <span>
#include <vector>

#include <robotlink/live/live_watch.h>

#include "arrivals.h"

namespace pitchboard::ui {

struct PreviewRow {
  QString sender;
  int port = 0;
  qulonglong messages = 0;
  QString robot;  ///< "R3 (Guests)", "R3 Ana (Guests)"
  QString values;
  bool used = false;
};

/// A format that a message may have, by the name that profiles are chosen by.
struct KnownFormat {
  QString name;
  std::shared_ptr<const telemetry::TextDecoder> decoder;
};

/// `known`: those that are named where a message is of no team.
std::vector<PreviewRow> previewOf(const std::vector<Arrival>& arrivals,
                                  const link::LiveOptions& options,
                                  std::span<const KnownFormat> known);

}  // namespace pitchboard::ui
