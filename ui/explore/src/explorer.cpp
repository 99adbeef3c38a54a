// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/explore/explorer.h>

#include <algorithm>
#include <cmath>

#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/scenario_behind.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

using link::ExploreResult;

std::array<std::optional<TeamColor>, 2> teamsOf(const link::ExploreStart& start,
                                                const link::MatchFrame& frame) {
  std::array<std::optional<TeamColor>, 2> teams;
  for (std::size_t i = 0; i < start.robots.size(); ++i) {
    const link::RobotFrame* robot = frame.robot(start.robots[i]);
    if (robot == nullptr) continue;
    teams[static_cast<std::size_t>(start.setup.players[i].side)] = robot->identity.team;
  }
  return teams;
}

BallHeatPtr heatOf(const ExploredMoment* found, int second) {
  if (found == nullptr || found->result.times.empty()) return nullptr;
  const ExploreResult& result = found->result;
  const std::size_t at = std::min(static_cast<std::size_t>(second), result.times.size() - 1);
  return std::make_shared<const BallHeat>(
      BallHeat{result.columns, result.rows, result.times[at].heat});
}

}  // namespace

Explorer::Explorer(const Parts& parts, QObject* parent) : QObject(parent), m_parts(parts) {
  connect(m_parts.shown, &ShownMoment::sourceChosen, this, &Explorer::clear);
  connect(m_parts.shown, &FrameSource::restarted, this, &Explorer::clear);
}

Explorer::~Explorer() {
  if (m_running) *m_running = true;
  m_worker.waitForDone();
}

void Explorer::start() {
  cancel();
  const FramePtr frame = m_parts.shown->frame();
  if (!frame) return;
  const auto scenario = scenarioBehind(*m_parts.shown, *m_parts.match, *m_parts.replay);
  link::ExploreStartOptions options;
  // The true match is shown only where it is simulated.
  options.useTruth = m_parts.shown->source() == m_parts.match;
  options.base = scenario ? &*scenario : nullptr;
  options.earlier = [this](double time) { return m_parts.shown->frameAt(time); };
  auto start = link::exploreStart(*frame, options);
  m_found.reset();
  m_problem.clear();
  m_progress = 0.0;
  if (!start) {
    m_problem = QString::fromStdString(start.error().text());
    return notify();
  }
  m_found = std::make_unique<ExploredMoment>();
  m_found->time = frame->snapshot.time;
  m_found->teams = teamsOf(*start, *frame);
  m_found->start = *start;
  link::ExploreOptions explore;
  explore.seconds = seconds;
  m_running = std::make_shared<std::atomic<bool>>(false);
  m_worker.start([this, job = m_running, begin = std::move(*start), explore] {
    const auto result = link::explore(
        begin, explore,
        [&](double done, const ExploreResult& soFar) {
          m_ui.post([this, job, done, soFar] { take(job, done, soFar); });
          return !job->load();
        },
        job.get());
    const QString problem =
        result || job->load() ? QString() : QString::fromStdString(result.error().text());
    m_ui.post([this, job, problem] { end(job, problem); });
  });
  notify();
}

void Explorer::take(const std::shared_ptr<std::atomic<bool>>& job, double progress,
                    const ExploreResult& result) {
  if (job != m_running) return;
  m_progress = progress;
  m_found->result = result;
  notify();
}

void Explorer::end(const std::shared_ptr<std::atomic<bool>>& job, const QString& problem) {
  if (job != m_running) return;
  m_running.reset();
  m_problem = problem;
  notify();
}

void Explorer::cancel() {
  if (!m_running) return;
  *m_running = true;
  m_running.reset();
  if (m_found && m_found->result.times.empty()) m_found.reset();
  notify();
}

void Explorer::clear() {
  if (!m_running && !m_found && m_problem.isEmpty()) return;
  cancel();
  m_found.reset();
  m_problem.clear();
  notify();
}

void Explorer::showSecond(int second) {
  second = std::clamp(second, 0, seconds);
  if (second == m_second) return;
  m_second = second;
  notify();
}

void Explorer::notify() {
  emit changed();
  emit heatChanged(heatOf(m_found.get(), m_second));
}

}  // namespace pitchboard::ui
