// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/explore/explore.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <base/try.h>
#include <robotlink/rollout/rollouts.h>
#include <simcore/world/field.h>

namespace pitchboard::link {
namespace {

using rollout::Rollouts;
using rollout::TracePoint;

constexpr double cellSize = 0.25;  // m, of the heat maps

/// What has happened up to one time, counted over rollouts.
struct TimeCounts {
  std::vector<std::uint32_t> cells;
  std::size_t goalsLeft = 0, goalsRight = 0;
};

class Exploration {
 public:
  static Result<Exploration> create(const ExploreStart& start, const ExploreOptions& options) {
    const auto refuse = [](const char* text, const char* key) {
      return failure(ErrorCode::InvalidArgument, text, key);
    };
    if (!(options.seconds >= 1.0 && options.seconds <= Rollouts::longest)) {
      return refuse("Rollouts last 1 to 600 s.", "seconds");
    }
    if (options.maxRollouts < 2 || options.rolloutsPerRound < 1) {
      return refuse("At least two rollouts are needed.", "rollouts");
    }
    rollout::RolloutsOptions rollouts;
    rollouts.threads = options.threads;
    return Exploration(start, options, TRY(Rollouts::create(start.setup, rollouts)));
  }

  /// False when it was cancelled before the round was finished: only whole rounds count.
  Result<bool> playRound(const std::atomic<bool>* cancelled) {
    const std::size_t count =
        std::min(m_options.rolloutsPerRound, m_options.maxRollouts - m_played);
    std::vector<std::uint64_t> seeds(count);
    std::iota(seeds.begin(), seeds.end(), m_options.seed + m_played);
    std::vector<double> rows(count * rollout::columnCount);
    std::vector<TracePoint> trace(count * m_counts.size());
    TRY(m_rollouts.play(m_start.belief, seeds, m_play, rows, cancelled, trace));
    if (cancelled != nullptr && cancelled->load()) return false;
    for (std::size_t i = 0; i < trace.size(); ++i) add(trace[i], m_counts[i % m_counts.size()]);
    m_played += count;
    return true;
  }

  ExploreResult result() const {
    ExploreResult out{m_played, m_options.seconds, m_columns, m_rows, {}};
    const auto n = static_cast<double>(m_played);
    for (const TimeCounts& counts : m_counts) {
      ExploredTime& time = out.times.emplace_back();
      for (const std::uint32_t cell : counts.cells) {
        time.heat.push_back(static_cast<float>(cell / n));
      }
      time.goalLeft = shareOf(static_cast<double>(counts.goalsLeft), n);
      time.goalRight = shareOf(static_cast<double>(counts.goalsRight), n);
    }
    return out;
  }

  bool enough(const ExploreResult& result) const {
    const auto isKnown = [this](const Share& share) {
      return (share.high - share.low) / 2.0 <= m_options.precision;
    };
    return m_played >= m_options.maxRollouts ||
           (isKnown(result.last().goalLeft) && isKnown(result.last().goalRight));
  }

  double done() const {
    return static_cast<double>(m_played) / static_cast<double>(m_options.maxRollouts);
  }
  std::size_t played() const { return m_played; }

 private:
  Exploration(const ExploreStart& start, const ExploreOptions& options, Rollouts rollouts)
      : m_start(start), m_options(options), m_rollouts(std::move(rollouts)) {
    const sim::FieldSpec& field = start.setup.field;
    m_columns = std::max(1, static_cast<int>(std::lround(field.length / cellSize)));
    m_rows = std::max(1, static_cast<int>(std::lround(field.width / cellSize)));
    m_play.seconds = options.seconds;
    m_play.goOn = true;
    m_counts.resize(rollout::tracePoints(m_play));
    for (TimeCounts& counts : m_counts) {
      counts.cells.resize(static_cast<std::size_t>(m_columns) * static_cast<std::size_t>(m_rows));
    }
  }

  void add(const TracePoint& point, TimeCounts& counts) const {
    const sim::FieldSpec& field = m_start.setup.field;
    const auto cellOf = [](double place, double half, int count) {
      const double share = (place + half) / (2.0 * half);
      return static_cast<std::size_t>(std::clamp(static_cast<int>(share * count), 0, count - 1));
    };
    ++counts.cells[cellOf(point.ball.y, field.halfWidth(), m_rows) *
                       static_cast<std::size_t>(m_columns) +
                   cellOf(point.ball.x, field.halfLength(), m_columns)];
    counts.goalsLeft += point.goalsLeft > 0 ? 1 : 0;
    counts.goalsRight += point.goalsRight > 0 ? 1 : 0;
  }

  ExploreStart m_start;
  ExploreOptions m_options;
  Rollouts m_rollouts;
  rollout::PlayOptions m_play;
  std::vector<TimeCounts> m_counts;
  std::size_t m_played = 0;
  int m_columns = 1, m_rows = 1;
};

}  // namespace

Share shareOf(double hits, double count) {
  constexpr double z = 1.959963984540054;
  if (count <= 0.0) return {};
  const double p = hits / count, scale = 1.0 + z * z / count;
  const double middle = (p + z * z / (2.0 * count)) / scale;
  const double half = z / scale * std::sqrt(p * (1.0 - p) / count + z * z / (4.0 * count * count));
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

Result<ExploreResult> explore(const ExploreStart& start, const ExploreOptions& options,
                              const ExploreProgress& progress, const std::atomic<bool>* cancelled) {
  Exploration exploration = TRY(Exploration::create(start, options));
  for (;;) {
    if (!TRY(exploration.playRound(cancelled))) break;
    ExploreResult result = exploration.result();
    const bool enough = exploration.enough(result);
    if ((progress && !progress(enough ? 1.0 : exploration.done(), result)) || enough) return result;
  }
  if (exploration.played() == 0) return failure(ErrorCode::Conflict, "Cancelled.");
  return exploration.result();
}

}  // namespace pitchboard::link
