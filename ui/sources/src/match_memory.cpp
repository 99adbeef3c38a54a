// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/match_memory.h>

#include <algorithm>
#include <cmath>

#include <robotlink/frame/drawing_origin.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/moment_reader.h>
#include <ui/base/robot_text.h>
#include <ui/sources/match_edits.h>

#include "match_rows.h"

namespace pitchboard::ui {

MatchMemory::MatchMemory(MatchController* match) : QObject(match), m_match(match) {}
MatchMemory::~MatchMemory() = default;

void MatchMemory::begin(Kept kept) {
  m_kept = std::move(kept);
  m_drawn = {};
  if (m_kept.rows) {
    m_kept.rows->setMemoryBudget(m_budget);
    return;
  }
  m_kept = {std::make_shared<MatchRows>(m_budget),
            {},
            std::make_shared<link::StateArchive>(),
            std::make_shared<link::DrawingMemory>()};
  m_kept.sampler =
      std::make_shared<link::MatchSampler>(m_kept.rows, link::MatchSamplerOptions{m_everyNth});
}

void MatchMemory::forget() {
  m_kept = {};
  m_past.reset();
}

std::vector<std::shared_ptr<link::TickObserver>> MatchMemory::observers() const {
  if (!m_kept.sampler) return {};
  return {m_kept.sampler, m_kept.archive, m_kept.drawings};
}

std::shared_ptr<const link::LiveHistory> MatchMemory::drawn() const {
  return m_kept.drawings;
}

void MatchMemory::setMemoryBudget(std::size_t bytes) {
  m_budget = bytes;
  if (m_kept.rows) m_kept.rows->setMemoryBudget(bytes);
}

std::shared_ptr<const telemetry::SeriesStore> MatchMemory::series() const {
  return m_kept.rows
             ? std::shared_ptr<const telemetry::SeriesStore>(m_kept.rows, &m_kept.rows->store())
             : nullptr;
}

std::shared_ptr<telemetry::RowSink> MatchMemory::rowsBeside() const {
  return m_kept.rows ? MatchRows::beside(m_kept.rows) : nullptr;
}

std::function<double()> MatchMemory::timeBeside() const {
  return [rows = m_kept.rows] { return rows ? rows->timeBeside() : 0.0; };
}

void MatchMemory::setSampling(int everyNth) {
  if (everyNth == m_everyNth || everyNth < 1) return;
  m_everyNth = everyNth;
  if (!m_kept.sampler) return;
  m_match->post([sampler = m_kept.sampler, everyNth](link::SimulatedMatch&) {
    sampler->setEveryNth(everyNth);
    return link::Changed::No;
  });
}

FramePtr MatchMemory::frameAt(double time) const {
  const auto rows = series();
  const FramePtr newest = m_match->frame();
  if (!rows || !newest || !rows->range()) return nullptr;
  if (!m_past) {
    m_past = std::make_unique<link::RecordedFrames>(*newest->settings);
  }
  auto past = std::make_shared<link::MatchFrame>(m_past->frameAt(*rows, time));
  if (past->robots.empty() && !newest->robots.empty() && time < rows->range()->begin) {
    return nullptr;
  }
  past->drawings = m_drawn.at(*m_kept.drawings, time);
  link::keyDrawings(*past);
  // Rows do not tell what was changed by hand while the match ran.
  const auto tick = static_cast<std::uint64_t>(
      std::llround(std::max(past->snapshot.time, 0.0) * past->settings->tickRate));
  if (const auto settings = m_kept.archive->settings(tick)) {
    auto then = std::make_shared<link::FrameSettings>(*past->settings);
    then->noise = settings->noise;
    then->physics = settings->physics;
    then->rigidBody = settings->rigidBody;
    past->settings = std::move(then);
    past->refereeRules = settings->referee ? settings->referee->name : std::string();
  }
  return past;
}

void MatchMemory::reportLosses(const link::Moment& moment, link::Cognition where) {
  if (moment.past || where == link::Cognition::None) return;
  const double time = static_cast<double>(moment.state.tick) / moment.state.settings.tickRate;
  emit continuedWithout(
      where == link::Cognition::Separate
          ? QStringLiteral("Separate reference processes restart with the belief they had at %1. "
                           "Team programs keep theirs.")
                .arg(clockText(time))
          : QStringLiteral("The memory of the robots' processes at %1 is no longer available, so "
                           "they restart with the belief they had then.")
                .arg(clockText(time)),
      time);
}

void MatchMemory::continueFrom(double time) {
  if (!m_match->isOpen()) return;
  m_match->setPaused(true);
  // What belongs to the future that ends here arrives before rewound().
  m_match->settle();
  const auto rows = series();
  const FramePtr newest = m_match->frame();
  if (!m_match->isOpen() || !m_kept.archive || !rows || !newest) return;
  const auto tick =
      static_cast<std::uint64_t>(std::llround(std::max(time, 0.0) * newest->settings->tickRate));
  auto moment = link::momentFromMemory(*m_kept.archive, *rows, tick, m_match->catalog());
  if (!moment) {
    emit failed(QStringLiteral("Cannot continue the match from this moment: %1")
                    .arg(QString::fromStdString(moment.error().text())));
    return;
  }
  m_match->edits()->adopt(*moment);
  const double from = static_cast<double>(tick) / newest->settings->tickRate;
  const auto left = std::make_shared<MatchBranch>();
  left->from = from;
  const auto entering = std::make_shared<const link::Moment>(std::move(*moment));
  m_match->post({QStringLiteral("Cannot continue the match from this moment"),
                 [entering, rows = m_kept.rows, left](link::SimulatedMatch& match) {
                   auto entered = match.restore(*entering);
                   if (!entered) return entered;
                   const std::size_t before = rows->store().memoryBytes();
                   left->rows = rows->store().branch();
                   rows->rewind(left->from);
                   left->bytes = before - std::min(before, rows->store().memoryBytes());
                   return entered;
                 },
                 {},
                 [this, entering, left] {
                   emit branching(*left);
                   emit m_match->rewound(left->from);
                   emit branched(*left);
                   reportLosses(*entering, m_match->cognition());
                 }});
}

}  // namespace pitchboard::ui
