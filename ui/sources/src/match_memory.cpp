// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/match_memory.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>

#include <robotlink/frame/drawing_origin.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/moment_reader.h>
#include <telemetry/series/row_sink.h>
#include <telemetry/series/series_store.h>
#include <ui/base/robot_text.h>
#include <ui/sources/match_edits.h>

namespace pitchboard::ui {

/// The rows of one simulated match, written by two kinds of threads: the match's, which brings its
/// own time, and the samplers of attached blackboards, whose rows get the match's time at that
/// moment, so that both can be compared.
class MatchRows : public telemetry::RowSink {
 public:
  explicit MatchRows(std::size_t memoryBudget) : m_store({memoryBudget}) {}  ///< bytes

  // The match's thread.
  telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override;
  void append(telemetry::GroupId group, const telemetry::RowView& row) override;
  /// The match goes on from here (s): later rows are dropped, those of attached blackboards too.
  void rewind(double time);

  // Any thread.
  const telemetry::SeriesStore& store() const { return m_store; }
  void setMemoryBudget(std::size_t bytes) { m_store.setMemoryBudget(bytes); }

  /// Of what is sampled beside the match, s.
  double timeBeside();
  /// Where its rows go; keeps `rows`.
  static std::shared_ptr<telemetry::RowSink> beside(const std::shared_ptr<MatchRows>& rows) {
    return {rows, &rows->m_store};
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::mutex m_mutex;  // of the time
  telemetry::SeriesStore m_store;
  double m_time = 0.0;  // of the match's newest row, s
  double m_step = 0.0;  // between its last two
  Clock::time_point m_arrived = Clock::now();
  bool m_matchBegan = false;
};

telemetry::GroupId MatchRows::addGroup(const telemetry::GroupInfo& info) {
  return m_store.addGroup(info);
}

void MatchRows::append(telemetry::GroupId group, const telemetry::RowView& row) {
  // Only this thread changes the time: it may look without the lock.
  if (row.time != m_time || !m_matchBegan) {
    const std::lock_guard lock(m_mutex);
    m_step = m_matchBegan ? std::max(0.0, row.time - m_time) : 0.0;
    m_time = row.time;
    m_arrived = Clock::now();
    m_matchBegan = true;
  }
  m_store.append(group, row);
}

void MatchRows::rewind(double time) {
  {
    const std::lock_guard lock(m_mutex);
    m_step = 0.0;
    m_time = time;
  }
  m_store.rewind(time);
}

// Between two ticks time goes on as it does on the wall, but never past the next tick.
double MatchRows::timeBeside() {
  const std::lock_guard lock(m_mutex);
  const double since = std::chrono::duration<double>(Clock::now() - m_arrived).count();
  return m_matchBegan ? m_time + std::min(since, m_step) : 0.0;
}

MatchMemory::MatchMemory(MatchController* match) : QObject(match), m_match(match) {
  connect(match, &MatchController::frameReceived, this,
          [this](const FramePtr& frame) { noteThinking(*frame); });
  connect(match, &MatchController::rewound, this, [this](double time) {
    for (auto& [robot, list] : m_kept.thinking) {
      std::erase_if(list, [time](const auto& one) { return one.from > time; });
    }
  });
}
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
            std::make_shared<link::DrawingMemory>(),
            {}};
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

void MatchMemory::noteThinking(const link::MatchFrame& frame) {
  for (const link::RobotFrame& robot : frame.robots) {
    auto& list = m_kept.thinking[robot.uid];
    if (!list.empty() && list.back().behaviour == robot.behaviour &&
        list.back().programs == robot.programs)
      continue;
    list.push_back({list.empty() ? 0.0 : frame.snapshot.time, robot.behaviour, robot.programs});
  }
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
  for (link::RobotFrame& robot : past->robots) {
    const auto known = m_kept.thinking.find(robot.uid);
    if (known == m_kept.thinking.end()) continue;
    for (const Kept::Thinking& one : known->second) {
      if (one.from > past->snapshot.time) break;
      robot.behaviour = one.behaviour;
      robot.programs = one.programs;
    }
  }
  const auto tick = static_cast<std::uint64_t>(
      std::llround(std::max(past->snapshot.time, 0.0) * past->settings->tickRate));
  if (const auto settings = m_kept.archive->settings(tick)) {
    auto then = std::make_shared<link::FrameSettings>(*past->settings);
    then->noise = settings->noise;
    then->physics = settings->physics;
    then->rigidBody = settings->rigidBody;
    past->settings = std::move(then);
    if (past->rules && settings->referee) {
      past->rules = std::make_shared<const sim::RefereeRules>(*settings->referee);
    }
  }
  return past;
}

void MatchMemory::reportLosses(const link::Moment& moment, link::Cognition where) {
  if (moment.past || where == link::Cognition::None) return;
  const double time = static_cast<double>(moment.state.tick) / moment.state.settings.tickRate;
  emit continuedWithout(
      where == link::Cognition::Separate
          ? QStringLiteral("Restarted the separate reference processes with their beliefs of %1. "
                           "Team programs continue with what they know now.")
                .arg(clockText(time))
          : QStringLiteral("The internal state of the robots' processes at %1 is no longer stored. "
                           "They restart with their beliefs of that moment.")
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
