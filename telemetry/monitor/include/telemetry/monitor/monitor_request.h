// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The one packet that Live may send, and only if the user turns it on: it asks a GameController of
// 2026 to send true data and the robots' states to this computer (monitor mode). It goes to the
// referee, never to a robot. The controller refuses computers that ever sent a robot's status.

#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

inline constexpr std::uint16_t monitorRequestPort = 3636;
/// The port to which a controller in monitor mode sends the robots' states.
inline constexpr std::uint16_t robotStatesPort = 3940;

/// Sends `RGTr` and one zero byte to the referee. Repeat it every second or two while monitor mode
/// is on. Fails with SystemError if the network refuses it.
Result<void> sendMonitorRequest(Address referee, std::uint16_t port = monitorRequestPort);

}  // namespace pitchboard::telemetry
