// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/match_memory.h>

#include <algorithm>
#include <cmath>

#include <robotlink/frame/drawing_origin.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/moment_reader.h>
#include <ui/base/robot_words.h>
#include <ui/sources/match_edits.h>

#include "match_rows.h"

namespace pitchboard::ui {

MatchMemory::MatchMemory(MatchController* match) : QObject(match), m_match(match) {}
MatchMemory::~MatchMemory() = default;

void MatchMemory::begin() {
  m_rows = std::make_shared<MatchRows>(m_budget);
  m_sampler = std::make_shared<link::MatchSampler>(m_rows, link::MatchSamplerOptions{m_everyNth});
  m_archive = std::make_shared<link::StateArchive>();
  m_drawings = std::make_shared<link::DrawingMemory>();
  m_drawn = {};
}

void MatchMemory::forget() {
  m_rows.reset();
  m_sampler.reset();
  m_archive.reset();
  m_drawings.reset();
  m_past.reset();
}

std::vector<std::shared_ptr<link::TickObserver>> MatchMemory::observers() const {
  if (!m_sampler) return {};
  return {m_sampler, m_archive, m_drawings};
}

std::shared_ptr<const link::LiveHistory> MatchMemory::drawn() const {
  return m_drawings;
}

void MatchMemory::setMemoryBudget(std::size_t bytes) {
  m_budget = bytes;
  if (m_rows) m_rows->setMemoryBudget(bytes);
}

std::shared_ptr<const telemetry::SeriesStore> MatchMemory::series() const {
  return m_rows ? std::shared_ptr<const telemetry::SeriesStore>(m_rows, &m_rows->store()) : nullptr;
}

std::shared_ptr<telemetry::RowSink> MatchMemory::rowsBeside() const {
  return m_rows ? MatchRows::beside(m_rows) : nullptr;
}

std::function<double()> MatchMemory::timeBeside() const {
  return [rows = m_rows] { return rows ? rows->timeBeside() : 0.0; };
}

void MatchMemory::setSampling(int everyNth) {
  if (everyNth == m_everyNth || everyNth < 1) return;
  m_everyNth = everyNth;
  if (!m_sampler) return;
  m_match->post([sampler = m_sampler, everyNth](link::SimulatedMatch&) {
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
  past->drawings = m_drawn.at(*m_drawings, time);
  link::keyDrawings(*past);
  // Rows do not tell what was changed by hand while the match ran.
  const auto tick = static_cast<std::uint64_t>(
      std::llround(std::max(past->snapshot.time, 0.0) * past->settings->tickRate));
  if (const auto settings = m_archive->settings(tick)) {
    auto then = std::make_shared<link::FrameSettings>(*past->settings);
    then->noise = settings->noise;
    then->physics = settings->physics;
    past->settings = std::move(then);
    past->refereeRules = settings->referee ? settings->referee->name : std::string();
  }
  return past;
}

void MatchMemory::continueFrom(double time) {
  if (!m_match->isOpen()) return;
  m_match->setPaused(true);
  // What belongs to the future that ends here arrives before rewound().
  m_match->settle();
  const auto rows = series();
  const FramePtr newest = m_match->frame();
  if (!m_match->isOpen() || !m_archive || !rows || !newest) return;
  const auto tick =
      static_cast<std::uint64_t>(std::llround(std::max(time, 0.0) * newest->settings->tickRate));
  auto moment = link::momentFromMemory(*m_archive, *rows, tick, m_match->catalog());
  if (!moment) {
    emit failed(QStringLiteral("The match cannot be continued from this moment: %1")
                    .arg(QString::fromStdString(moment.error().text())));
    return;
  }
  m_match->edits()->adopt(*moment);
  if (!moment->past && m_match->cognition() != link::Cognition::None) {
    emit continuedWithout(
        m_match->cognition() == link::Cognition::Separate
            ? QStringLiteral("Reference processes that run separately begin again with the belief "
                             "that they had at %1. A team's own programs are not told.")
                  .arg(clockText(time))
            : QStringLiteral("What the robots' processes remembered at %1 is not kept any more: "
                             "they begin again with the belief that they had then.")
                  .arg(clockText(time)));
  }
  const double from = static_cast<double>(tick) / newest->settings->tickRate;
  m_match->post({QStringLiteral("The match cannot be continued from this moment"),
                 [moment = std::move(*moment), rows = m_rows, from](link::SimulatedMatch& match) {
                   auto entered = match.restore(moment);
                   if (entered) rows->rewind(from);
                   return entered;
                 },
                 {},
                 [this, from] { emit m_match->rewound(from); }});
}

}  // namespace pitchboard::ui
