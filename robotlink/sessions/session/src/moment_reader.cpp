// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/moment_reader.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <base/try.h>
#include <robotlink/live/board_columns.h>
#include <robotlink/session/session_checkpoint.h>
#include <robotlink/session/state_archive.h>
#include <simcore/rules/game_start.h>

namespace pitchboard::link {
namespace {

constexpr double tickTolerance = 1e-6;

std::optional<RobotId> robotOf(const telemetry::GroupInfo& group) {
  const int slot = factsOf(group).slot;
  return slot > 0 ? std::optional(RobotId{slot}) : std::nullopt;
}

std::string behaviourOf(const telemetry::GroupInfo& group) {
  const std::string& behaviour = factsOf(group).behaviour;
  return behaviour.empty() ? std::string(noBehaviour) : behaviour;
}

bool isPlaying(const sim::WorldState& state, RobotId id) {
  return std::any_of(state.robots.begin(), state.robots.end(),
                     [id](const auto& robot) { return robot.id == id; });
}

}  // namespace

std::vector<BoardWord> boardWords(const telemetry::GroupInfo& group, const telemetry::RowView& row,
                                  const VariableCatalog& catalog) {
  std::vector<BoardWord> out;
  std::size_t words = 0, values = 0;
  for (const telemetry::ColumnInfo& column : group.columns) {
    const bool isWord = column.type != telemetry::ColumnType::Float64;
    const std::size_t place = isWord ? words++ : values++;
    const Variable* variable = catalog.find(column.name);
    if (!variable || place >= (isWord ? row.words.size() : row.values.size())) continue;
    const bool isInt = variable->type == VariableType::Int;
    std::uint32_t bits = 0;
    if (isWord) {
      if (isInt != (column.type == telemetry::ColumnType::Int32)) continue;
      bits = row.words[place];
    } else {
      // A variable that some rows of the robot do not have. Truth has names of its own.
      const double value = row.values[place];
      if (std::isnan(value)) continue;
      bits = isInt ? static_cast<std::uint32_t>(
                         static_cast<std::int32_t>(std::clamp(value, -2147483648.0, 2147483647.0)))
                   : std::bit_cast<std::uint32_t>(static_cast<float>(value));
    }
    if (!isInt) bits = BoardColumns::boardWord(column.name, bits);
    out.push_back({(isInt ? 0 : Blackboard::floatOffset) + variable->index, bits});
  }
  return out;
}

Moment presentMoment(const SimulatedMatch& match, const StateArchive& archive) {
  const sim::WorldState& state = match.simulation().state();
  Moment moment{state, {}, archive.past(state.tick)};
  for (const auto& slot : match.robots().all()) {
    MomentRobot& robot = moment.robots.emplace_back(MomentRobot{slot->id, slot->behaviour, {}});
    for (const Variable& variable : match.catalog().variables()) {
      const bool isInt = variable.type == VariableType::Int;
      const auto bits =
          isInt ? std::bit_cast<std::uint32_t>(slot->board.read(IntVar{variable.index}))
                : std::bit_cast<std::uint32_t>(slot->board.read(FloatVar{variable.index}));
      robot.words.push_back({(isInt ? 0 : Blackboard::floatOffset) + variable.index, bits});
    }
  }
  return moment;
}

Result<Moment> momentFromMemory(const StateArchive& archive, const telemetry::SeriesStore& rows,
                                std::uint64_t tick, const VariableCatalog& catalog) {
  auto state = TRY(archive.restore(tick));
  Moment moment{std::move(state), {}, archive.past(tick)};
  const double rate = moment.state.settings.tickRate;
  const double time = (static_cast<double>(tick) + tickTolerance) / rate;
  std::vector<std::uint32_t> words;
  std::vector<double> values;
  for (telemetry::GroupId id = 0; id < rows.groups(); ++id) {
    const auto view = rows.view(id);
    if (!view) continue;
    const auto robot = robotOf(view->info());
    double rowTime = 0.0;
    if (!robot || !isPlaying(moment.state, *robot) || !view->rowAt(time, rowTime, words, values)) {
      continue;
    }
    if (rowTime * rate < static_cast<double>(tick) - 1.5)
      continue;  // an earlier robot of its number
    MomentRobot& known = moment.robots.emplace_back(
        MomentRobot{*robot, behaviourOf(view->info()),
                    boardWords(view->info(), {rowTime, words, values}, catalog)});
    // The rows tell only the newest one.
    if (!moment.past) continue;
    for (const RobotsMemory::Robot& remembered : moment.past->memory->robots) {
      if (remembered.id == *robot) known.behaviour = remembered.behaviour;
    }
  }
  return moment;
}

Result<Moment> momentFromSession(const telemetry::SessionReader& session, double seconds,
                                 const VariableCatalog& catalog) {
  const auto segment = TRY(checkpointAt(session, seconds));
  const double rate = segment.segment.tickRate();
  const double ticks = std::floor((seconds - segment.time) * rate + tickTolerance);
  const auto length = static_cast<double>(segment.segment.lastTick() - segment.segment.firstTick());
  const double inside = std::clamp(ticks, 0.0, length);
  auto state =
      TRY(segment.segment.at(segment.segment.firstTick() + static_cast<std::uint64_t>(inside)));
  Moment moment{std::move(state), {}, {}};

  const double time = segment.time + (inside + tickTolerance) / rate;
  std::vector<telemetry::SessionRow> rows;
  session.rowsAt(time, rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const telemetry::GroupInfo& group = session.groups()[i].info;
    const auto robot = robotOf(group);
    if (!rows[i].present || !robot || !isPlaying(moment.state, *robot)) continue;
    if ((time - rows[i].time) * rate > 1.5) continue;
    if (moment.robot(*robot)) continue;
    moment.robots.push_back(
        {*robot, behaviourOf(group), boardWords(group, rows[i].view(), catalog)});
  }
  return moment;
}

Result<sim::WorldState> stateOfFrame(const telemetry::SessionReader& session,
                                     const MatchFrame& frame) {
  auto moment = TRY(momentFromSession(session, frame.snapshot.time, VariableCatalog::published()));
  if (moment.state.tick != frame.snapshot.tick) {
    return failure(ErrorCode::NotFound, "the recording does not have the state of this moment");
  }
  return std::move(moment.state);
}

void setGameOf(const Result<sim::WorldState>& state, Scenario& scenario) {
  scenario.game.reset();
  if (!state) return;
  scenario.settings.referee = state->settings.referee;
  scenario.settings.teams = state->settings.teams;
  if (state->game) scenario.game = sim::gameStartOf(*state);
}

}  // namespace pitchboard::link
