// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Shows what the window shows to other programs: Foxglove, Lichtblick and others that speak
// Foxglove's protocol. Of Simulate and Live that is the present; a recording is at the moment shown
// here, and clients may play it. If another source is shown, or another match or session, clients
// begin anew with that. UI thread only.

#include <QObject>
#include <functional>
#include <memory>
#include <vector>

#include <telemetry/foxglove/foxglove_server.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

class QTimer;

namespace pitchboard::ui {

class LiveController;
class MatchController;
class ReplayController;
class ShownMoment;
class SharedReplay;

struct ShareOptions {
  bool everyComputer = false;  ///< in the network; otherwise only programs on this one
  int port = 8765;             ///< TCP; 0: a free one
};

class NetworkShare : public QObject {
  Q_OBJECT
 public:
  /// What can be shared. Everything must outlive the share.
  struct Sources {
    MatchController* match = nullptr;
    LiveController* live = nullptr;
    ReplayController* replay = nullptr;
    ShownMoment* shown = nullptr;
  };
  explicit NetworkShare(const Sources& sources, QObject* parent = nullptr);
  ~NetworkShare() override;

  /// Shares from now on what is shown, with these options. If the port cannot be used, nothing is
  /// shared, and `failed` follows.
  void start(const ShareOptions& options);
  void stop();
  bool isOn() const { return m_isOn; }
  const ShareOptions& options() const { return m_options; }
  /// Returns the port; 0 while there is nothing to see, because no match or session is open.
  int port() const;
  telemetry::FoxgloveServerStatus status() const;

 signals:
  void changed();  ///< switched on or off, or another source is shared
  void failed(const QString& sentence);

 private:
  void begin();
  void end();
  void beginMatch();
  void beginLive();
  void beginReplay();
  void follow();
  void obey(const telemetry::FoxglovePlaybackControl& control);
  telemetry::FoxgloveServerOptions serverOptions(const QString& name) const;
  /// Keeps the server, or reports why there is none. Returns whether there is one.
  bool take(Result<std::shared_ptr<telemetry::FoxgloveServer>> server);
  bool listen(const QString& name);

  Sources m_sources;
  ShareOptions m_options;
  bool m_isOn = false;
  std::uint64_t m_generation = 0;  // of what is shared
  QTimer* m_timer;                 // of a recording
  UiQueue m_toUi;
  std::shared_ptr<telemetry::FoxgloveServer> m_server;
  std::function<void()> m_detach;  // from a match or Live
  std::shared_ptr<SharedReplay> m_replay;
  std::vector<telemetry::FoxglovePlaybackControl> m_asked;  // by clients, not answered yet
  Workers m_worker;                                         // reads the recording
};

}  // namespace pitchboard::ui
