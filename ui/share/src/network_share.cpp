// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/share/network_share.h>

#include <QTimer>
#include <algorithm>
#include <cmath>

#include <robotlink/scenario/scenario.h>
#include <robotlink/serve/served_match.h>
#include <robotlink/session/match_sampler.h>
#include <telemetry/sockets/live_clock.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>

#include "shared_replay.h"

namespace pitchboard::ui {
namespace {

constexpr double rate = 20.0;  // Hz: pictures of the field, and rows of a match
constexpr telemetry::Address everyAddress{0};

/// Shows to a server what an observer sees; the server lives as long.
std::shared_ptr<link::ServedMatch> servedBy(
    const std::shared_ptr<telemetry::FoxgloveServer>& server, telemetry::WallTime start) {
  struct Both {
    std::shared_ptr<telemetry::FoxgloveServer> server;
    link::ServedMatch served;
  };
  const auto both = std::make_shared<Both>(Both{server, {*server, link::logTimesFrom(start)}});
  return {both, &both->served};
}

}  // namespace

NetworkShare::NetworkShare(const Sources& sources, QObject* parent)
    : QObject(parent), m_sources(sources), m_timer(new QTimer(this)) {
  m_timer->setInterval(static_cast<int>(1000 / rate));
  connect(m_timer, &QTimer::timeout, this, &NetworkShare::follow);
  connect(sources.shown, &ShownMoment::sourceChanged, this, &NetworkShare::begin);
  connect(sources.match, &MatchController::ending, this, [this] {
    if (m_sources.shown->source() == m_sources.match) end();
  });
  connect(sources.match, &MatchController::opened, this, [this] {
    if (m_sources.shown->source() == m_sources.match) begin();
  });
  connect(sources.replay, &ReplayController::opened, this, [this] {
    if (m_sources.shown->source() == m_sources.replay) begin();
  });
}

NetworkShare::~NetworkShare() {
  const QSignalBlocker nobodyIsLeftToHear(this);
  m_isOn = false;
  end();
}

void NetworkShare::start(const ShareOptions& options) {
  m_options = options;
  m_isOn = true;
  begin();
}

void NetworkShare::stop() {
  m_isOn = false;
  end();
  emit changed();
}

int NetworkShare::port() const {
  return m_server ? m_server->port() : 0;
}

telemetry::FoxgloveServerStatus NetworkShare::status() const {
  return m_server ? m_server->status() : telemetry::FoxgloveServerStatus{};
}

void NetworkShare::begin() {
  end();
  if (!m_isOn) return;
  const FrameSource* source = m_sources.shown->source();
  if (source == m_sources.replay) {
    beginReplay();
  } else if (source == m_sources.live) {
    beginLive();
  } else {
    beginMatch();
  }
  emit changed();
}

void NetworkShare::end() {
  ++m_generation;
  m_timer->stop();
  if (m_detach) std::exchange(m_detach, {})();
  if (m_replay) {
    m_replay->cancel();
    m_worker.waitForDone();  // it follows that recording and has nothing else to do
    m_replay.reset();
  }
  m_asked.clear();
  m_server.reset();
}

telemetry::FoxgloveServerOptions NetworkShare::serverOptions(const QString& name) const {
  telemetry::FoxgloveServerOptions options;
  if (m_options.everyComputer) options.bind = everyAddress;
  options.port = static_cast<std::uint16_t>(m_options.port);
  options.name = name.toStdString();
  options.sessionId = std::to_string(telemetry::LiveClock().now().time_since_epoch().count());
  return options;
}

bool NetworkShare::take(Result<std::shared_ptr<telemetry::FoxgloveServer>> server) {
  if (!server) {
    m_isOn = false;
    emit failed(
        QStringLiteral("Cannot share: %1").arg(QString::fromStdString(server.error().text())));
    return false;
  }
  m_server = std::move(*server);
  m_options.port = m_server->port();  // the next source has the same one
  return true;
}

bool NetworkShare::listen(const QString& name) {
  return take(telemetry::FoxgloveServer::start(serverOptions(name)));
}

void NetworkShare::beginMatch() {
  MatchController* match = m_sources.match;
  if (!match->isOpen()) return;
  const link::Scenario& scenario = match->scenario();
  const std::string& title = scenario.title.empty() ? scenario.name : scenario.title;
  if (!listen(QString::fromStdString(title))) return;
  const FramePtr frame = match->frame();
  const double played = frame ? frame->snapshot.time : 0.0;
  const auto served = servedBy(m_server, telemetry::LiveClock().now() -
                                             std::chrono::nanoseconds(std::llround(played * 1e9)));
  if (frame) served->show(*frame);  // a match that is paused has no ticks
  const int everyNth =
      std::max(1, static_cast<int>(std::lround(scenario.settings.tickRate / rate)));
  link::MatchSamplerOptions sampling;
  sampling.everyNth = everyNth;
  const auto sampler = std::make_shared<link::MatchSampler>(served, sampling);
  const auto serving = std::make_shared<link::MatchServing>(served, everyNth);
  match->observe(sampler);
  match->observe(serving);
  m_detach = [match, sampler, serving] {
    match->stopObserving(sampler);
    match->stopObserving(serving);
  };
}

void NetworkShare::beginLive() {
  LiveController* live = m_sources.live;
  if (!live->isListening()) return;
  if (!listen(QStringLiteral("Live robots"))) return;
  const auto serving = std::make_shared<link::LiveServing>(servedBy(m_server, live->began()));
  live->observe(serving);
  m_detach = [live, serving] { live->stopObserving(serving); };
}

void NetworkShare::beginReplay() {
  if (!m_sources.replay->isOpen()) return;
  telemetry::FoxgloveServerOptions options =
      serverOptions(QString::fromStdString(m_sources.replay->info().title));
  options.control = [this](const telemetry::FoxglovePlaybackControl& control) {
    m_toUi.post([this, control] { obey(control); });
  };
  const std::string path = m_sources.replay->path().toStdString();
  m_worker.start([this, path, options, generation = m_generation] {
    m_toUi.post([this, options, generation, opened = SharedReplay::open(path)] {
      if (generation != m_generation) return;
      using Server = Result<std::shared_ptr<telemetry::FoxgloveServer>>;
      if (take(opened ? (*opened)->listen(options) : Server(tl::unexpected(opened.error())))) {
        m_replay = *opened;
        m_timer->start();
      }
      emit changed();
    });
  });
}

/// A worker that is still busy with the moment before takes the next one.
void NetworkShare::follow() {
  const ShownMoment& shown = *m_sources.shown;
  const SharedReplay::Moment moment{shown.time(), shown.speed(), !shown.isPaused()};
  const bool isTaken = m_worker.tryStart(
      [replay = m_replay, moment, asked = m_asked] { replay->follow(moment, asked); });
  if (isTaken) m_asked.clear();
}

void NetworkShare::obey(const telemetry::FoxglovePlaybackControl& control) {
  if (!m_replay) return;
  ShownMoment* shown = m_sources.shown;
  if (control.seek) shown->seek(m_replay->seconds(*control.seek));
  shown->setSpeed(control.speed);
  shown->setPaused(!control.plays);
  m_asked.push_back(control);
}

}  // namespace pitchboard::ui
