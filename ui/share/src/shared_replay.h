// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A recording that is shared: it follows the moment that the window shows.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <base/result.h>
#include <robotlink/serve/served_session.h>
#include <telemetry/foxglove/foxglove_server.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::ui {

class SharedReplay {
 public:
  struct Moment {
    double time = 0.0;  ///< s of the session
    double speed = 1.0;
    bool plays = false;
  };

  /// Reads what a recording has. Any thread; afterwards one thread at a time, but for seconds() and
  /// cancel().
  static Result<std::shared_ptr<SharedReplay>> open(const std::string& path);

  /// Listens, once, before follow().
  Result<std::shared_ptr<telemetry::FoxgloveServer>> listen(
      telemetry::FoxgloveServerOptions options);
  /// Shows this moment to clients: with all that happened on the way, or as it is if it is before
  /// the last one or far behind it. Answers what they asked for.
  void follow(const Moment& moment, const std::vector<telemetry::FoxglovePlaybackControl>& asked);
  /// Ends a follow() that is under way.
  void cancel() { m_isCancelled = true; }
  double seconds(std::uint64_t logTime) const { return m_session.seconds(logTime); }

 private:
  explicit SharedReplay(telemetry::SessionReader session) : m_session(std::move(session)) {}
  void tell(const Moment& moment, bool didSeek, const std::string& requestId);

  telemetry::SessionReader m_session;
  std::shared_ptr<telemetry::FoxgloveServer> m_server;
  std::optional<link::ServedSession> m_served;
  std::optional<Moment> m_told;
  std::atomic<bool> m_isCancelled = false;
};

}  // namespace pitchboard::ui
