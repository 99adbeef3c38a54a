// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/rollout/rollouts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include <base/try.h>

#include "rollout_world.h"

namespace pitchboard::rollout {
namespace {

constexpr std::array<OutcomeColumn, columnCount> columnInfos{{
    {"seed", "seed of the rollout"},
    {"ended_by", "0 its time, 1 a goal, 2 the ball left the field"},
    {"time", "s that it lasted"},
    {"goals_left", "goals of the team that attacks right"},
    {"goals_right", "goals of the team that attacks left"},
    {"time_to_goal", "s until the first goal; NaN without"},
    {"ball_x", "m, at the end"},
    {"ball_y", "m, at the end"},
    {"ball_vx", "m/s, at the end"},
    {"ball_vy", "m/s, at the end"},
    {"look_x", "m, ball at the time of the look, or at the end before it"},
    {"look_y", "m, likewise"},
    {"last_touch", "player that touched the ball last, from 0; -1 nobody"},
    {"near_left", "m from where the ball comes to rest to the nearest robot that attacks right"},
    {"near_right", "m from there to the nearest robot that attacks left"},
}};

template <class... Numbers>
bool areFinite(Numbers... numbers) {
  return (std::isfinite(numbers) && ...);
}

bool isSigma(double sigma) {
  return std::isfinite(sigma) && sigma >= 0.0;
}

Result<void> refuse(const std::string& text, const std::string& where) {
  return failure(ErrorCode::InvalidArgument, text, where);
}

constexpr double farthest = 1000.0;  // m, m/s, s: nothing on a field is more

bool isNear(double number) {
  return std::isfinite(number) && std::abs(number) <= farthest;
}

Result<void> check(const Belief& belief, std::size_t players) {
  if (belief.robots.size() != players) {
    return refuse("The belief has " + std::to_string(belief.robots.size()) + " robots, the setup " +
                      std::to_string(players) + ".",
                  "robots");
  }
  for (std::size_t i = 0; i < players; ++i) {
    const RobotBelief& robot = belief.robots[i];
    if (robot.absent) continue;
    const std::string where = "robots[" + std::to_string(i) + "]";
    if (!isNear(robot.pose.position.x) || !isNear(robot.pose.position.y) ||
        !isNear(robot.pose.yaw) || !isNear(robot.forward) || !isNear(robot.left) ||
        !isNear(robot.turn) || !isNear(robot.getsUpIn)) {
      return refuse("Pose and speeds must be finite numbers up to 1000.", where);
    }
    if (!isSigma(robot.sigma) || !isSigma(robot.yawSigma)) {
      return refuse("Standard deviations must be finite and not negative.", where);
    }
  }
  const BallBelief& ball = belief.ball;
  if (!isNear(ball.place.x) || !isNear(ball.place.y) || !isNear(ball.velocity.x) ||
      !isNear(ball.velocity.y) || !isSigma(ball.sigma) || !isSigma(ball.velocitySigma) ||
      !isSigma(ball.age) || ball.age > farthest) {
    return refuse("The ball's numbers must be finite, its age and sigmas not negative.", "ball");
  }
  const GameBelief& game = belief.game;
  if (!areFinite(game.secondsLeft, game.setPlayLeft)) {
    return refuse("Times must be finite.", "game");
  }
  return {};
}

}  // namespace

std::span<const OutcomeColumn, columnCount> columns() {
  return columnInfos;
}

std::size_t tracePoints(const PlayOptions& options) {
  constexpr double rounding = 1e-9;  // s
  return static_cast<std::size_t>((options.seconds + rounding) / options.traceEvery) + 1;
}

struct Rollouts::Parts {
  RolloutsOptions options;
  std::shared_ptr<const RolloutConstants> constants;
  std::vector<RolloutWorld> worlds;  ///< a tile for each thread
};

Rollouts::Rollouts(std::unique_ptr<Parts> parts) : m_parts(std::move(parts)) {}
Rollouts::Rollouts(Rollouts&&) noexcept = default;
Rollouts& Rollouts::operator=(Rollouts&&) noexcept = default;
Rollouts::~Rollouts() = default;

Result<Rollouts> Rollouts::create(const Setup& setup, const RolloutsOptions& options) {
  if (options.threads < 1 || options.threads > maxThreads) {
    return failure(ErrorCode::InvalidArgument, "There may be 1 to 256 threads.", "threads");
  }
  if (options.tile < 1 || options.tile > maxTile) {
    return failure(ErrorCode::InvalidArgument, "A tile has 1 to 4096 worlds.", "tile");
  }
  auto parts = std::make_unique<Parts>();
  parts->options = options;
  parts->constants = TRY(RolloutConstants::create(setup));
  const auto worlds =
      static_cast<std::size_t>(options.threads) * static_cast<std::size_t>(options.tile);
  parts->worlds.reserve(worlds);
  for (std::size_t i = 0; i < worlds; ++i) {
    parts->worlds.push_back(TRY(RolloutWorld::create(parts->constants)));
  }
  return Rollouts(std::move(parts));
}

std::size_t Rollouts::players() const {
  return m_parts->constants->players.size();
}

Result<void> Rollouts::play(const Belief& belief, std::span<const std::uint64_t> seeds,
                            const PlayOptions& options, std::span<double> out,
                            const std::atomic<bool>* cancelled, std::span<TracePoint> trace) {
  TRY(check(belief, m_parts->constants->setup.players.size()));
  if (!(options.seconds > 0.0 && options.seconds <= longest)) {
    return refuse("A rollout takes more than 0 and at most 600 s.", "seconds");
  }
  if (!isSigma(options.look)) return refuse("The time of the look must not be negative.", "look");
  if (out.size() != seeds.size() * columnCount) {
    return refuse("The array must have " + std::to_string(columnCount) + " numbers for each seed.",
                  "outcomes");
  }
  std::size_t points = 0;
  if (!trace.empty()) {
    if (!(options.traceEvery >= 0.01 && options.traceEvery <= longest)) {
      return refuse("Points of a trace are 0.01 to 600 s apart.", "trace_every");
    }
    points = tracePoints(options);
    if (trace.size() != seeds.size() * points) {
      return refuse("The array must have " + std::to_string(points) + " points for each seed.",
                    "trace");
    }
  }
  std::ranges::fill(out, std::numeric_limits<double>::quiet_NaN());

  const auto tile = static_cast<std::size_t>(m_parts->options.tile);
  std::atomic<std::size_t> next = 0;
  const auto playTiles = [&](std::size_t thread) {
    const auto worlds = std::span(m_parts->worlds).subspan(thread * tile, tile);
    while (cancelled == nullptr || !cancelled->load(std::memory_order_relaxed)) {
      const std::size_t first = next.fetch_add(tile);
      if (first >= seeds.size()) return;
      const std::size_t count = std::min(tile, seeds.size() - first);
      for (std::size_t i = 0; i < count; ++i) {
        worlds[i].begin(belief, seeds[first + i], options,
                        trace.subspan((first + i) * points, points));
      }
      for (bool any = true; any;) {
        any = false;
        for (std::size_t i = 0; i < count; ++i) any = worlds[i].cycle() || any;
      }
      for (std::size_t i = 0; i < count; ++i) {
        worlds[i].write(out.subspan((first + i) * columnCount, columnCount));
      }
    }
  };
  std::vector<std::jthread> helpers;
  for (int thread = 1; thread < m_parts->options.threads; ++thread) {
    helpers.emplace_back(playTiles, static_cast<std::size_t>(thread));
  }
  playTiles(0);
  return {};
}

}  // namespace pitchboard::rollout
