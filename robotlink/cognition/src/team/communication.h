// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes the communication process for the registry: telemetry, team messages and the referee, all
// by UDP. The process belongs to who asked for it, and to one thread at a time.

#include <memory>

#include <robotlink/cognition/cognitive_process.h>

namespace pitchboard::link {

/// The published communication process, see communication.cpp. Fails when the address or a port
/// cannot be used, or when the system gives no socket.
Result<std::unique_ptr<CognitiveProcess>> makeCommunication(const ProcessOptions& options);

}  // namespace pitchboard::link
