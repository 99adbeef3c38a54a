// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/state_codec.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <type_traits>

#include <simcore/rules/referee.h>
#include <simcore/simulation/simulation.h>
#include <simcore/world/state_values.h>

#include "byte_codec.h"

namespace pitchboard::link {
namespace {

constexpr std::string_view magic = "PBst";
// 4: versions 0.8 and 0.9; 5: 0.10 and 0.11, restarts as one value, counts of the rules as whole
// numbers; 6: goals by half, who came back, rules of 2026; 7: battery limits of robot models; 8:
// marks and corner arcs of the field.
constexpr std::uint64_t version = 8, versionOf010 = 5, versionOf08 = 4;
constexpr std::size_t longestText = 256;
// Physics stays well-behaved within this.
constexpr double farthest = 1e6;

class Writer {
 public:
  explicit Writer(std::string& out) : m_out(out) {}
  void value(const std::string& text) {
    putVarint(m_out, text.size());
    m_out += text;
  }
  template <class T>
  void value(const T& value) {
    if constexpr (std::is_same_v<T, double>) {
      putDouble(m_out, value);
    } else if constexpr (std::is_same_v<T, int>) {
      putSigned(m_out, value);
    } else {
      putVarint(m_out, static_cast<std::uint64_t>(value));
    }
  }
  void label(double value, std::uint64_t /*form*/) { this->value(value); }
  template <class T>
  void count(const std::vector<T>& list) {
    putVarint(m_out, list.size());
  }
  template <class T>
  void sameCount(const std::vector<T>& /*list*/, std::size_t /*size*/) {}
  template <class Physics>
  void alternative(const Physics& physics) {
    putVarint(m_out, physics.index());
  }
  template <class T>
  bool repeats(const std::vector<T>& list, std::size_t index) {
    const bool same = index > 0 && list[index] == list[index - 1];
    putVarint(m_out, same ? 1 : 0);
    return same;
  }
  template <class T>
  bool present(const std::optional<T>& value) {
    putVarint(m_out, value ? 1 : 0);
    return value.has_value();
  }

 private:
  std::string& m_out;
};

class Reader {
 public:
  /// `form` is that of the saved state. Labels that it does not have yet keep their defaults.
  Reader(CodecReader& in, std::uint64_t form) : m_in(in), m_form(form) {}
  void label(double& value, std::uint64_t since) {
    if (m_form >= since) this->value(value);
  }
  void value(std::string& text) {
    const std::uint64_t size = m_in.varint();
    if (size > longestText) return m_in.fail();
    text = m_in.bytes(size);
  }
  void value(double& value) {
    value = m_in.real();
    if (!std::isfinite(value)) m_in.fail();
  }
  void value(int& value) {
    const std::int64_t read = m_in.signedVarint();
    if (read < std::numeric_limits<int>::min() || read > std::numeric_limits<int>::max()) {
      return m_in.fail();
    }
    value = static_cast<int>(read);
  }
  void value(bool& value) { value = limited(1) != 0; }
  void value(std::uint32_t& value) {
    value = static_cast<std::uint32_t>(limited(std::numeric_limits<std::uint32_t>::max()));
  }
  void value(std::uint64_t& value) { value = m_in.varint(); }
  void value(sim::AfterGoal& value) {
    value = static_cast<sim::AfterGoal>(
        limited(static_cast<std::uint64_t>(sim::AfterGoal::CentreBall)));
  }
  void value(sim::KickLaw& value) {
    value = static_cast<sim::KickLaw>(limited(static_cast<std::uint64_t>(sim::KickLaw::Foot)));
  }
  void value(TeamColor& value) { value = static_cast<TeamColor>(limited(teamColors.size() - 1)); }
  void value(sim::Posture& value) {
    value = static_cast<sim::Posture>(limited(static_cast<std::uint64_t>(sim::Posture::GettingUp)));
  }
  template <class Enum>
  requires requires { lastOf(Enum{}); }
  void value(Enum& value) {
    value = static_cast<Enum>(limited(static_cast<std::uint64_t>(lastOf(Enum{}))));
  }
  template <class T>
  bool repeats(std::vector<T>& list, std::size_t index) {
    if (limited(index > 0 ? 1 : 0) == 0) return false;
    list[index] = list[index - 1];
    return true;
  }
  template <class T>
  bool present(std::optional<T>& value) {
    value.reset();
    if (limited(1) == 1) value.emplace();
    return value.has_value();
  }
  template <class T>
  void count(std::vector<T>& list) {
    const std::uint64_t size = m_in.varint();
    // Every element takes three bytes at least, so that a lie about the count costs no memory.
    if (size > m_in.left() / 3) return m_in.fail();
    list.resize(size);
  }
  template <class T>
  void sameCount(std::vector<T>& list, std::size_t size) {
    list.resize(size);
  }
  template <class... States>
  void alternative(std::variant<States...>& physics) {
    const std::uint64_t chosen = limited(sizeof...(States) - 1);
    std::uint64_t index = 0;
    ((index++ == chosen ? void(physics.template emplace<States>()) : void()), ...);
  }

 private:
  std::uint64_t limited(std::uint64_t most) {
    const std::uint64_t read = m_in.varint();
    if (read <= most) return read;
    m_in.fail();
    return 0;
  }
  CodecReader& m_in;
  std::uint64_t m_form;
};

/// The referee's rules of form 4: counts were written as other numbers are.
struct RulesReader4 {
  Reader& in;
  template <class T>
  void value(T& value) {
    in.value(value);
  }
  void value(int& count) {
    double read = 0.0;
    in.value(read);
    count = static_cast<int>(std::lround(std::clamp(read, 0.0, 1e6)));
  }
};

void readGame4(Game& g, sim::RefereeMemory& m, Reader& in) {
  const auto all = [&in](auto&... values) { (in.value(values), ...); };
  bool kickOffStands = false, began = false, beganBefore = false, shown = false, ballFree = false;
  int setPlayTeam = 0, shots = 0;
  SetPlay setPlay{};
  sim::visitTeams(g, in);
  all(g.swapped, g.state, g.phase, g.phaseBefore, g.half, g.firstKickOff, g.kickOff, kickOffStands,
      setPlay, g.restart.step, setPlayTeam, g.stopped, g.over, g.clock, began, beganBefore, shown,
      g.stateTicks, g.countdown.ticks, g.countdown.runs, g.hidden, g.dropIn.team, g.dropIn.ticks,
      g.breakLeft, ballFree, g.restart.place.x, g.restart.place.y, g.restart.team, g.restart.kind,
      g.restart.kicker, g.restart.passed, m.touch.robot, m.touch.team, m.still.place.x,
      m.still.place.y, m.still.ticks, m.near.place.x, m.near.place.y, m.near.ticks, m.aloneTicks,
      g.shooter, shots);
  sim::visitWatches(m, in);
  using Step = Restart::Step;
  if (setPlay == SetPlay::None) g.restart.step = ballFree ? Step::Free : Step::Executed;
  g.clockUse = beganBefore ? ClockUse::Began : began ? ClockUse::BeganNow : ClockUse::Full;
}

void readState4(sim::WorldState& state, Reader& in) {
  sim::visitWorld(state, in);
  if (in.present(state.settings.referee)) {
    RulesReader4 rules{in};
    sim::visitRefereeRulesOfForm5(*state.settings.referee,
                                  [&rules](auto&... values) { (rules.value(values), ...); });
  }
  if (!in.present(state.game)) return;
  readGame4(*state.game, state.refereeMemory, in);
  sim::giveSlots(state.robots, *state.game);
}

void readState5(sim::WorldState& state, Reader& in) {
  sim::visitWorld(state, in);
  if (in.present(state.settings.referee)) {
    sim::visitRefereeRulesOfForm5(*state.settings.referee,
                                  [&in](auto&... values) { (in.value(values), ...); });
    sim::visitTeamSettings(state.settings, in);
  }
  if (in.present(state.game)) sim::visitGameOfForm5(*state.game, state.refereeMemory, in);
}

/// Whether every number of the physics is near: a match never comes near the limit.
struct IsNear {
  bool all = true;
  void value(double value) { all = all && std::abs(value) <= farthest; }
  template <class Other>
  void value(const Other& /*value*/) {}
  template <class List>
  void count(const List& /*list*/) {}
  template <class List>
  void sameCount(const List& /*list*/, std::size_t /*size*/) {}
};

bool plausible(const sim::WorldState& state) {
  IsNear near;
  std::visit([&near](const auto& physics) { sim::state_values::physics(physics, near); },
             state.physics);
  return near.all;
}

bool robotsAreDistinct(const sim::WorldState& state) {
  std::set<RobotId> ids;
  for (const sim::RobotIdentity& robot : state.robots) {
    if (robot.id.value < 1 || robot.id.value > sim::Simulation::maxRobots) return false;
    if (!ids.insert(robot.id).second) return false;
  }
  return true;
}

}  // namespace

void encodeState(const sim::WorldState& state, std::string& out) {
  out += magic;
  putVarint(out, version);
  Writer writer(out);
  sim::visitValues(state, writer);
}

std::string encodeState(const sim::WorldState& state) {
  std::string out;
  encodeState(state, out);
  return out;
}

Result<sim::WorldState> decodeState(std::string_view& bytes) {
  CodecReader in(bytes);
  if (in.bytes(magic.size()) != magic) {
    return failure(ErrorCode::ParseError, "this is not a saved state of a match");
  }
  const std::uint64_t found = in.varint();
  if (in.ok() && found < versionOf08) {
    return failure(ErrorCode::Unsupported,
                   "this state was saved by an earlier version of Pitchboard (format " +
                       std::to_string(found) + ", this program reads " + std::to_string(version) +
                       "); you can view the recording, but not continue its match exactly");
  }
  if (in.ok() && found > version) {
    return failure(ErrorCode::Unsupported,
                   "this state was saved by a later version of Pitchboard (format " +
                       std::to_string(found) + ", this program reads " + std::to_string(version) +
                       "); use that version");
  }
  sim::WorldState state;
  Reader reader(in, found);
  if (found == versionOf08) {
    readState4(state, reader);
  } else if (found == versionOf010) {
    readState5(state, reader);
  } else {
    sim::visitValues(state, reader);
  }
  if (state.game) {
    state.game->tickRate = state.settings.tickRate;
    if (state.settings.referee) state.game->league = sim::leagueOf(state.settings.referee->style);
  }
  if (!in.ok()) {
    return failure(ErrorCode::ParseError, "the saved state is truncated or damaged",
                   "byte " + std::to_string(in.offset()));
  }
  const bool usable = robotsAreDistinct(state) &&
                      state.game.has_value() == state.settings.referee.has_value() &&
                      plausible(state);
  if (!usable) {
    return failure(ErrorCode::ParseError,
                   "the saved state has invalid values (robots or positions)");
  }
  // What only the simulation can judge: field, noise, the physics' own sizes.
  auto simulation = sim::Simulation::create({});
  if (auto put = simulation->restore(state); !put) return tl::unexpected(put.error());
  bytes = in.rest();
  return state;
}

}  // namespace pitchboard::link
