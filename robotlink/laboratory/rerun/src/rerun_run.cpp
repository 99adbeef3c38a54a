// SPDX-License-Identifier: GPL-3.0-or-later
#include "rerun_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <thread>

#include <base/time_text.h>
#include <base/try.h>
#include <base/wildcard.h>
#include <robotlink/cognition/referee_orders.h>
#include <robotlink/match/due_ticks.h>
#include <robotlink/session/session_checkpoint.h>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using RerunSeconds = std::chrono::duration<double>;

constexpr double partLength = 5.0;   // s of the session that are read at once
constexpr double freeWarmUp = 10.0;  // s, of programs that are not in lock-step
constexpr double freeSlack = 0.5;    // s
constexpr double packetSlack = 0.2;  // s: some cycles of communication
constexpr double maxGap = 2.0;       // s without a row that is played through
constexpr auto lookEvery = 20ms;     // at programs, progress and cancelling

}  // namespace

Result<std::unique_ptr<RerunRun>> RerunRun::create(const telemetry::SessionReader& session,
                                                   const RerunOptions& options) {
  std::unique_ptr<RerunRun> run(new RerunRun(session, options));
  TRY(run->prepare());
  TRY(run->openBoard());
  return run;
}

Result<void> RerunRun::prepare() {
  m_recorded = TRY(recordedRobot(m_session, m_options));
  m_options.robot = m_recorded.name;
  m_bridge.emplace(RobotVariables(m_recorded.catalog));
  TRY(choose());
  TRY(chooseRange());
  std::vector<std::string> exact;
  for (const RerunChoice& choice : m_chosen.choices) {
    auto cycles = RecordedCycles::find(m_session, m_recorded, choice);
    if (!cycles) continue;
    note("Every cycle of " + choice.process + " was recorded (" + cycles->variable() +
         "); exactly these run.");
    exact.push_back(choice.process);
    m_cycles.emplace(choice.process, *std::move(cycles));
  }
  m_inputs = TRY(checkInputs(m_recorded, m_chosen.choices, *m_feed, exact));
  for (const std::string& sentence : m_inputs.notes) note(sentence);
  return {};
}

Result<RerunPlan> RerunRun::plan(const telemetry::SessionReader& session,
                                 const RerunOptions& options) {
  RerunRun run(session, options);
  TRY(run.prepare());
  RerunPlan plan;
  plan.robot = run.m_options.robot;
  plan.processes = run.m_chosen.processes;
  for (const Feed::Output& output : run.m_feed->outputs()) {
    const std::string& name = output.variable.name;
    const bool chosen = std::ranges::any_of(
        options.writes, [&](const std::string& pattern) { return fitsWildcard(pattern, name); });
    plan.outputs.push_back({name,
                            VariableCatalog::extended().find(name) ? RerunPlan::Known::Map
                            : chosen                               ? RerunPlan::Known::Chosen
                                                                   : RerunPlan::Known::Name,
                            output.isRecorded});
  }
  for (const RerunProcess& process : run.m_chosen.processes) {
    plan.recorded.push_back(
        {process.name, run.m_recorded.programOf(process.name, session.file().contents().name)});
  }
  plan.missing = run.m_inputs.missing;
  plan.notes = run.m_notes;
  plan.start = run.m_start;
  plan.begin = run.m_begin;
  plan.end = run.m_end;
  return plan;
}

void RerunRun::note(const std::string& sentence) {
  m_notes.push_back(sentence);
  if (m_options.note) m_options.note(sentence);
}

bool RerunRun::goesOn() const {
  if (!m_options.progress) return true;
  const double length = m_end - m_start;
  const double now = static_cast<double>(m_tick) / m_recorded.tickRate;
  return m_options.progress(length > 0.0 ? std::clamp((now - m_start) / length, 0.0, 1.0) : 0.0);
}

Result<void> RerunRun::choose() {
  m_chosen = TRY(chooseProcesses(m_session, m_recorded, m_options));
  for (const std::string& sentence : m_chosen.notes) note(sentence);
  std::vector<std::string> names;
  for (const RerunProcess& process : m_chosen.processes) names.push_back(process.name);
  const std::vector<std::string> fed = TRY(hearMessages());
  m_feed.emplace(m_recorded.catalog, names, m_options.writes, fed);
  m_feed->setColumns(m_session.groups()[m_recorded.group].info);
  const BehaviourInfo* behaviour = findBehaviour(m_recorded.robot.behaviour);
  const Variable* target = m_recorded.catalog.find("DECISION_TARGET");
  const bool usesPlanning = behaviour && behaviour->usesPose && !m_recorded.runtime.isChosen();
  const bool planned = (target && m_feed->isRecorded(*target)) || usesPlanning;
  if (!planned) m_feed->exclude("planning");
  const bool talks = std::ranges::any_of(m_chosen.choices, [](const RerunChoice& choice) {
    return choice.isInside && choice.process == "team";
  });
  if (!talks) return {};
  m_mates.emplace(m_session, m_recorded);
  m_recorded.robot.teamChannel = m_mates->channel();
  return {};
}

/// Lets the programs hear what the robot heard. Returns the variables of chosen processes that
/// these do not write.
Result<std::vector<std::string>> RerunRun::hearMessages() {
  std::vector<std::string> fed;
  std::string separate;
  bool inside = false;
  for (const RerunChoice& choice : m_chosen.choices) {
    if (!choice.isInside && hearsMessages(choice.process)) separate = choice.process;
    inside |= choice.isInside && choice.process == "communication";
  }
  if (inside) {
    RerunRobot& robot = m_recorded.robot;
    robot.refereeTeam = MessageFeed::refereeTeam(m_session, m_recorded);
    robot.announceSetPlay = MessageFeed::tellsSetPlay(m_session, m_recorded);
    const std::size_t told = robot.announceSetPlay ? RefereeVariables::names.size() : 1;
    const auto ours = std::span(RefereeVariables::names).first(told);
    for (const Variable& one : m_recorded.catalog.variables()) {
      const bool isRobotNumber = one.name == "ROBOT_NUMBER";
      if (VariableMeanings::published().writers(one.name).writer != "communication") continue;
      if (isRobotNumber || std::ranges::find(ours, one.name) != ours.end()) continue;
      fed.push_back(one.name);
    }
  }
  if (!separate.empty() && MessageFeed::count(m_session) == 0) {
    note("The recording has no datagrams, so " + separate +
         " receives nothing by UDP from the referee and from other robots.");
    separate.clear();
  }
  if (!inside && separate.empty()) return fed;
  m_messages.emplace(TRY(MessageFeed::start(m_session, m_recorded, !separate.empty())));
  if (inside) m_recorded.robot.refereeDatagrams = m_messages->refereeDatagrams();
  return fed;
}

bool RerunRun::hasSeparate() const {
  return std::ranges::any_of(m_chosen.choices,
                             [](const RerunChoice& one) { return !one.isInside; });
}

Result<void> RerunRun::chooseRange() {
  const auto range = m_session.range();
  const double first = m_recorded.begin, last = range ? range->end : first;
  m_start = first;
  m_begin = std::max(first, m_options.from.value_or(first));
  m_end = std::min(last, m_options.until.value_or(last));
  if (m_end <= m_begin) {
    return failure(ErrorCode::InvalidArgument,
                   "Nothing of " + m_options.robot +
                       " was recorded in this part; its rows begin at " + secondsToText(first) +
                       " and end at " + secondsToText(last) + ".",
                   "--from, --until");
  }
  if (m_options.warmUp || hasSeparate()) {
    m_start = std::max(first, m_begin - m_options.warmUp.value_or(freeWarmUp));
  }
  m_read = m_start;
  return {};
}

Result<void> RerunRun::openBoard() {
  m_rows.emplace(m_session, m_recorded, *m_feed, m_chosen.choices);
  if (!hasSeparate()) {
    m_board.emplace(Blackboard::onHeap());
    return {};
  }
  const auto keyOf = [this](MatchNumber number) {
    return blackboardKey(m_recorded.robot.id, number.keyBase());
  };
  const auto isUnused = [&](MatchNumber number) { return !SystemVSegments::info(keyOf(number)); };
  m_claim =
      TRY(m_options.match ? MatchClaim::take(*m_options.match) : MatchClaim::takeFree(isUnused));
  const int key = keyOf(m_claim->number());
  if (!isUnused(m_claim->number())) {
    return failure(
        ErrorCode::Conflict,
        "There is already a blackboard with key " + std::to_string(key) +
            ". End the programs that use it and run \"pitchboard-cli blackboard remove " +
            std::to_string(key) + "\", or choose another one with --match.");
  }
  m_board.emplace(TRY(SystemVSegments::open(key, AttachMode::AttachOrCreate)));
  return {};
}

/// The pieces of the match that begin in a part of the session.
void RerunRun::addPieces(double from, double until) {
  if (!m_recorded.hasWorld) return;
  bool wasPutBack = false, isDamaged = false;
  const auto add = [&](double time, StateSegment segment) {
    const double own = static_cast<double>(segment.firstTick()) / m_recorded.tickRate;
    if (std::abs(own - time) > rowTolerance + 0.5 / m_recorded.tickRate) {
      wasPutBack = true;
    } else {
      m_world.add(std::move(segment));
    }
  };
  if (!m_begun) {
    if (auto before = checkpointAt(m_session, from)) add(before->time, std::move(before->segment));
  }
  m_session.messages(telemetry::SessionStream::Checkpoints, {from, until},
                     [&](double time, std::string_view json) {
                       auto segment = checkpointFromJson(json);
                       if (segment) add(time, std::move(*segment));
                       isDamaged = isDamaged || !segment;
                       return true;
                     });
  if (wasPutBack) {
    note("The match was put back to an earlier moment while it was recorded; from " +
         secondsToText(from) + " on, what the robot sensed is known at the times of rows only.");
  }
  if (isDamaged) note("A checkpoint near " + secondsToText(from) + " is damaged.");
}

Result<void> RerunRun::advanceTo(double time) {
  while (m_read <= std::min(time, m_end)) {
    const double until = std::min(m_read + partLength, m_end);
    TRY(read(m_read, until));
    m_read = until;  // a row or a piece at this time is taken twice, which changes nothing
    if (until >= m_end) {
      m_read = std::numeric_limits<double>::infinity();
      if (m_comparison) {
        m_comparison->finish();
        writeEvents();
      }
    }
    if (!goesOn()) return failure(ErrorCode::Conflict, "Cancelled.");
  }
  return {};
}

/// Plays a part of the session.
Result<void> RerunRun::read(double from, double until) {
  addPieces(from, until);
  if (m_messages) m_messages->read(m_session, from, until);
  std::vector<telemetry::GroupId> groups{m_recorded.group};
  if (m_mates) groups.insert(groups.end(), m_mates->groups().begin(), m_mates->groups().end());
  Result<void> done;
  m_session.rows({from, until}, groups,
                 [&](telemetry::GroupId group, const telemetry::RowView& row) {
                   if (group != m_recorded.group) {
                     done = m_mates->take(group, row);
                   } else {
                     done = m_begun ? takeRow(row) : begin(row);
                   }
                   return done.has_value();
                 });
  return done;
}

/// At the first row everything on the blackboard is as it was.
Result<void> RerunRun::begin(const telemetry::RowView& row) {
  m_begun = true;
  m_tick = m_firstTick = m_recorded.tickOf(row.time);
  m_feed->take(row);
  m_feed->writeAll(*m_board);
  m_feed->endTick();
  for (auto& [process, cycles] : m_cycles) (void)cycles.take(row);
  RerunRobot& robot = m_recorded.robot;
  if (m_world.goTo(m_tick)) {
    const sim::WorldState& world = *m_world.state();
    robot.field = sim::playedField(world.settings);
    robot.seed = world.settings.seed;
    for (std::size_t i = 0; i < world.robots.size(); ++i) {
      if (world.robots[i].id != robot.id) continue;
      robot.model = world.models[i];
      robot.facesLeft = world.robots[i].imuStartsAt180;
    }
  }
  auto& planned = m_recorded.planned;
  std::ranges::stable_sort(planned, {}, &BlackboardWrite::time);
  while (m_nextPlanned < planned.size() &&
         firstTickAtOrAfter(planned[m_nextPlanned].time, m_recorded.tickRate) <= m_tick) {
    ++m_nextPlanned;  // it stands in the row
  }
  TRY(startPrograms());
  m_comparison.emplace(*m_feed, m_options, m_slack, m_begin);
  m_paceTick = m_measuredTick = m_tick;
  m_paceBegin = m_measured = std::chrono::steady_clock::now();
  if (std::ranges::any_of(m_chosen.choices, [this](const RerunChoice& choice) {
        return choice.isInside && hadBegun(choice.process);
      })) {
    note("The part begins at " + secondsToText(row.time) +
         ". What the process remembers from before is unknown.");
  }
  m_rows->write(row, *m_board);
  return {};
}

/// Whether a process had been running before the first row.
bool RerunRun::hadBegun(const std::string& process) const {
  const auto cycles = m_cycles.find(process);
  return cycles == m_cycles.end() ? m_tick > 0 : cycles->second.hasBegun();
}

Result<void> RerunRun::startPrograms() {
  const RerunRobot& robot = m_recorded.robot;
  const auto& scenario = m_recorded.scenario;
  const bool knowsWhere =
      scenario && std::ranges::any_of(scenario->robots, [&robot](const ScenarioRobot& one) {
        return one.identity.id == robot.id && one.belief;
      });
  ProgramPlace place{&*m_board,
                     &m_recorded.catalog,
                     m_options.robotProgram,
                     true,
                     [this] { return goesOn(); },
                     [this](const std::string& line) {
                       if (m_options.print) m_options.print(line);
                     }};
  for (const RerunChoice& choice : m_chosen.choices) {
    if (choice.isInside) {
      m_programs.push_back(TRY(insideProgram(choice, robot, *m_board, m_recorded.tickRate, m_tick,
                                             hadBegun(choice.process) || knowsWhere)));
    } else {
      m_programs.push_back(TRY(separateProgram(choice, robot, place)));
      place.mayCooperate = false;
    }
  }
  for (const auto& program : m_programs) TRY(program->awaitReady());
  const bool lockStep =
      std::ranges::all_of(m_programs, [](const auto& program) { return program->inLockStep(); });
  // Packets have the time at which the recording computer received them, not the robot.
  const bool hears = m_recorded.robot.refereeDatagrams != nullptr;
  m_slack = m_options.slack.value_or(!lockStep ? freeSlack : hears ? packetSlack : 0.0);
  if (!lockStep) m_feed->setFree();
  if (!lockStep || hears) m_slack = std::max(m_slack, 2.0 * m_recorded.rowInterval);
  return {};
}

Result<void> RerunRun::takeRow(const telemetry::RowView& row) {
  const std::uint64_t next = m_recorded.tickOf(row.time);
  if (next <= m_tick) {  // a change by hand, or two rows of one tick
    m_feed->take(row);
    m_feed->after(*m_board, running());
    if (!m_cycles.empty()) {
      TRY(runCycles(row));
      compare(row);
      m_rows->write(row, *m_board);
    }
    m_feed->endTick();
    return {};
  }
  if (static_cast<double>(next - m_tick) > maxGap * m_recorded.tickRate) {
    m_tick = next - 1;  // the robot was away
    m_paceTick = m_measuredTick = m_tick;
    m_paceBegin = m_measured = std::chrono::steady_clock::now();
  }
  while (m_tick + 1 < next) TRY(tick(m_tick + 1, nullptr));
  return tick(next, &row);
}

Result<void> RerunRun::tick(std::uint64_t tick, const telemetry::RowView* row) {
  m_tick = tick;
  TRY(pace());
  planWrites(tick);
  const double time = static_cast<double>(tick) / m_recorded.tickRate;
  if (m_messages) m_messages->sendTo(time);
  const bool known = m_world.goTo(tick);
  const sim::Percepts* percepts = known ? m_world.percepts(m_recorded.robot.id) : nullptr;
  m_feed->setSensed(percepts != nullptr);
  if (m_recorded.hasWorld && !percepts && !std::exchange(m_missedWorld, true)) {
    note("From " + secondsToText(time) +
         " on the recording has no checkpoints, so what the robot sensed is known at the times of "
         "rows only, and differences may come from that.");
  }
  if (known) TRY(followSides(tick));
  if (percepts) m_bridge->publish(*percepts, *m_board);
  if (row) m_feed->take(*row);
  for (const auto& program : m_programs) {
    if (m_cycles.count(program->process()) > 0) continue;
    m_feed->before(*m_board, program->turn());
    TRY(program->cycle(tick));
  }
  if (row) TRY(runCycles(*row));
  if (row) compare(*row);
  m_feed->after(*m_board, running());
  m_feed->endTick();
  if (row) m_rows->write(*row, *m_board);
  return {};
}

/// Those that were announced, on what stood on the blackboard when they began.
Result<void> RerunRun::runCycles(const telemetry::RowView& row) {
  for (const auto& program : m_programs) {
    const auto found = m_cycles.find(program->process());
    if (found == m_cycles.end() || !found->second.take(row)) continue;
    std::vector<std::string> others = running();
    std::erase(others, program->process());
    m_feed->after(*m_board, others);
    const RecordedCycles& cycles = found->second;
    if (cycles.beganAnew()) TRY(program->beginAnew(m_recorded.robot, m_tick));
    TRY(program->run(m_tick, cycles.secondsOf(row)));
  }
  return {};
}

/// As a match does it: what is due at a tick is written before the next one is played.
void RerunRun::planWrites(std::uint64_t tick) {
  for (; m_nextPlanned < m_recorded.planned.size(); ++m_nextPlanned) {
    const BlackboardWrite& write = m_recorded.planned[m_nextPlanned];
    if (firstTickAtOrAfter(write.time, m_recorded.tickRate) >= tick) return;
    m_feed->plan(*m_board, write.variable, write.value);
  }
}

Result<void> RerunRun::followSides(std::uint64_t tick) {
  RerunRobot& robot = m_recorded.robot;
  for (const sim::RobotIdentity& one : m_world.state()->robots) {
    if (one.id != robot.id || robot.facesLeft == one.imuStartsAt180) continue;
    robot.facesLeft = one.imuStartsAt180;
    for (const auto& program : m_programs) TRY(program->changeSides(robot, tick));
  }
  return {};
}

/// The processes of which the newest row is from within a cycle.
std::vector<std::string> RerunRun::running() const {
  std::vector<std::string> names;
  for (const auto& [process, cycles] : m_cycles) {
    if (cycles.isRunning()) names.push_back(process);
  }
  return names;
}

void RerunRun::compare(const telemetry::RowView& row) {
  if (row.time < m_begin - rowTolerance || row.time > m_end + rowTolerance) return;
  m_comparison->add(row.time, *m_board, running());
  writeEvents();
}

void RerunRun::setWriter(telemetry::SessionWriter* writer) {
  m_rows->setWriter(writer);
}

void RerunRun::writeEvents() {
  m_rows->write(m_comparison->drainBegun(), m_comparison->variables());
}

/// Returns the largest speed that is wished and that all programs allow; 0: unlimited.
double RerunRun::speedNow() const {
  double speed = m_options.speed;
  for (const auto& program : m_programs) {
    const double allowed = program->allowedSpeed(m_options.speed);
    if (allowed > 0.0) speed = speed > 0.0 ? std::min(speed, allowed) : allowed;
  }
  return speed;
}

void RerunRun::measurePace(Time now) {
  if (now - m_measured <= 500ms) return;
  m_reached = played(m_measuredTick) / RerunSeconds(now - m_measured).count();
  m_measured = now;
  m_measuredTick = m_tick;
}

/// Plays at the chosen speed, and looks after programs, progress and cancelling.
Result<void> RerunRun::pace() {
  while (true) {
    const auto now = std::chrono::steady_clock::now();
    const auto due = m_speed > 0.0
                         ? m_paceBegin + std::chrono::duration_cast<std::chrono::nanoseconds>(
                                             RerunSeconds(played(m_paceTick) / m_speed))
                         : now;
    if (now - m_looked >= lookEvery) {
      m_looked = now;
      if (!goesOn()) return failure(ErrorCode::Conflict, "Cancelled.");
      measurePace(now);
      if (const double speed = speedNow(); speed != m_speed) {
        m_speed = speed;
        m_paceBegin = now;
        m_paceTick = m_tick;
        continue;
      }
      for (const auto& program : m_programs) {
        TRY(program->lookAfter(played(m_firstTick), m_speed > 0.0 ? m_speed : m_reached));
      }
    }
    if (now >= due) return {};
    std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(due - now, lookEvery));
  }
}

Result<RerunResult> RerunRun::finish() {
  TRY(advanceTo(m_end));
  if (!m_begun || !m_comparison) {
    return failure(ErrorCode::InvalidArgument,
                   "There is no row of " + m_options.robot + " to run.");
  }
  for (const auto& [process, cycles] : m_cycles) {
    if (cycles.missed() == 0) continue;
    note(std::to_string(cycles.missed()) + " cycles of " + process +
         " are missing in the recording: they were shorter than the time between two readings.");
  }
  RerunResult result;
  result.robot = m_options.robot;
  result.processes = m_chosen.processes;
  result.notes = m_notes;
  result.begin = m_begin;
  result.end = m_end;
  result.inLockStep =
      std::ranges::all_of(m_programs, [](const auto& program) { return program->inLockStep(); });
  result.slack = m_slack;
  result.sampledInputs = m_inputs.sampled;
  result.rowInterval = m_recorded.rowInterval;
  m_comparison->putInto(result);
  return result;
}

}  // namespace pitchboard::link
