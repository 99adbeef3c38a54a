// SPDX-License-Identifier: GPL-3.0-or-later
#include "rerun_run.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <sstream>
#include <thread>

#include <base/time_text.h>
#include <base/try.h>
#include <base/wildcard.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/frame/teams.h>
#include <robotlink/match/due_ticks.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_checkpoint.h>
#include <robotlink/session/session_events.h>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using RerunSeconds = std::chrono::duration<double>;

constexpr double partLength = 5.0;     // s of the session that are read at once
constexpr double freeWarmUp = 10.0;    // s, of programs that are not in lock-step
constexpr double freeSlack = 0.5;      // s
constexpr double maxGap = 2.0;         // s without a row that is played through
constexpr double rowTolerance = 1e-6;  // s; files keep whole nanoseconds
constexpr auto lookEvery = 20ms;       // at programs, progress and cancelling
constexpr std::size_t measuredRows = 200;
constexpr std::size_t maxNamed = 12;
constexpr const char* rerunName = "rerun";
constexpr int rerunSender = 4096;  // no program with the same number is so far back

std::vector<std::string> splitNames(std::string_view text) {
  std::istringstream words{std::string(text)};
  std::vector<std::string> out;
  for (std::string word; words >> word;) out.push_back(word);
  return out;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < maxNamed; ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > maxNamed) {
    text += " and " + std::to_string(names.size() - maxNamed) + " more";
  }
  return text;
}

/// "There is no robot "B9". There are: B1, B2."
std::string notAmong(const char* what, const std::string& name,
                     const std::vector<std::string>& known) {
  std::string text = std::string("There is no ") + what + " \"" + name + "\". There are: ";
  for (std::size_t i = 0; i < known.size(); ++i) text += (i == 0 ? "" : ", ") + known[i];
  return text + '.';
}

bool isRobot(const telemetry::SessionGroup& group) {
  return group.info.robot.has_value() && !group.info.match && group.rows > 0;
}

double numberOf(const Variable& variable, std::uint32_t word) {
  return variable.type == VariableType::Int ? static_cast<double>(std::bit_cast<std::int32_t>(word))
                                            : static_cast<double>(std::bit_cast<float>(word));
}

}  // namespace

Result<std::unique_ptr<RerunRun>> RerunRun::create(const telemetry::SessionReader& session,
                                                   const RerunOptions& options) {
  std::unique_ptr<RerunRun> run(new RerunRun(session, options));
  TRY(run->prepare());
  TRY(run->openBoard());
  return run;
}

Result<void> RerunRun::prepare() {
  TRY(findRobot());
  TRY(readCatalog());
  TRY(readScenario());
  measureRows();
  knowRobot();
  TRY(chooseProcesses());
  TRY(chooseRange());
  return checkInputs();
}

Result<RerunPlan> RerunRun::plan(const telemetry::SessionReader& session,
                                 const RerunOptions& options) {
  RerunRun run(session, options);
  TRY(run.prepare());
  RerunPlan plan;
  plan.robot = run.m_options.robot;
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
  plan.recorded = run.recordedProgram(options.processes.front().name);
  plan.missing = run.m_missing;
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
  const double now = static_cast<double>(m_tick) / m_tickRate;
  return m_options.progress(length > 0.0 ? std::clamp((now - m_start) / length, 0.0, 1.0) : 0.0);
}

Result<void> RerunRun::findRobot() {
  const auto groups = m_session.groups();
  if (std::ranges::none_of(groups, isRobot)) {
    return failure(ErrorCode::NotFound, "This recording has no rows of a robot.");
  }
  // A live robot has messages and a blackboard: that with more words.
  std::optional<telemetry::GroupId> found;
  std::ptrdiff_t most = -1;
  for (const telemetry::GroupId id : TRY(m_session.groupsNamed(m_options.robot))) {
    const std::ptrdiff_t words =
        std::ranges::count_if(groups[id].info.columns, [](const telemetry::ColumnInfo& column) {
          return column.type != telemetry::ColumnType::Float64;
        });
    if (!isRobot(groups[id]) || words <= most) continue;
    found = id;
    most = words;
  }
  if (!found) {
    return failure(ErrorCode::NotFound, "There are no rows of \"" + m_options.robot + "\".",
                   "--robot");
  }
  m_group = *found;
  m_robot.id = RobotId{std::max(1, factsOf(groups[m_group].info).slot)};
  m_options.robot = groups[m_group].info.name;
  return {};
}

Result<void> RerunRun::readCatalog() {
  if (!m_options.catalog.empty()) {
    m_catalog = TRY(VariableCatalog::fromFile(m_options.catalog)).withExtension();
  } else if (const auto text = m_session.attachment(catalogAttachment)) {
    m_catalog = TRY(VariableCatalog::fromJson(*text, catalogAttachment)).withExtension();
  }
  m_bridge.emplace(RobotVariables(m_catalog));
  return {};
}

Result<void> RerunRun::readScenario() {
  if (const auto text = m_session.attachment(scenarioAttachment)) {
    m_scenario = TRY(scenarioFromJson(*text, scenarioAttachment, m_catalog));
  }
  for (const telemetry::SessionGroup& group : m_session.groups()) {
    if (!group.info.match || !group.info.match->tickRate_hz) continue;
    m_hasWorld = m_session.count(telemetry::SessionStream::Checkpoints) > 0;
    m_tickRate = *group.info.match->tickRate_hz;
  }
  return {};
}

std::string RerunRun::recordedProgram(const std::string& process) const {
  if (!m_scenario) return {};
  if (!m_runtime.isChosen()) return std::string(referenceProgram);
  if (process == "decision" && !m_runtime.decision.empty()) return m_runtime.decision;
  RuntimeChoice runtime = m_runtime;
  runtime.profile = besideRecording(runtime.profile, m_session.file().contents().name);
  if (const auto profile = loadRuntime(runtime)) {
    const auto found = std::ranges::find(profile->processes, process, &ProfileProcess::name);
    if (found == profile->processes.end()) return {};
    if (found->isReference()) return std::string(referenceProgram);
  }
  return runtimeChoiceToText(runtime);
}

std::uint64_t RerunRun::tickOf(double time) const {
  return static_cast<std::uint64_t>(std::llround(std::max(0.0, time) * m_tickRate));
}

/// The usual time between two rows, from the first ones.
void RerunRun::measureRows() {
  std::vector<double> gaps;
  std::optional<double> last;
  const std::array only{m_group};
  m_session.rows({-1e18, 1e18}, only, [&](telemetry::GroupId, const telemetry::RowView& row) {
    if (last && row.time > *last + rowTolerance) gaps.push_back(row.time - *last);
    if (!last) m_start = row.time;
    last = row.time;
    return gaps.size() < measuredRows;
  });
  if (gaps.empty()) return;
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  m_rowInterval = *middle;
}

/// Who plays, from the rows' facts, the scenario and the state of the match at the beginning.
void RerunRun::knowRobot() {
  const telemetry::RobotFacts& facts = factsOf(m_session.groups()[m_group].info);
  m_robot.team = facts.team.value_or(TeamColor::Blue);
  m_robot.shirt = facts.number > 0 ? facts.number : m_robot.id.value;
  m_robot.behaviour = facts.behaviour == noBehaviour ? std::string() : facts.behaviour;
  m_robot.facesLeft = facts.imuStartsAt180;
  m_robot.field = backdropOf(m_session).field;
  if (m_scenario) {
    m_robot.field = sim::playedField(m_scenario->settings);
    m_robot.seed = m_scenario->settings.seed;
    m_planned = m_scenario->writes;
    for (const ScenarioRobot& one : m_scenario->robots) {
      if (one.identity.id != m_robot.id) continue;
      m_robot.parameters = one.parameters;
      m_robot.model = one.model;
      m_runtime = m_scenario->runtimeOf(one);
    }
  }
  std::erase_if(m_planned, [this](const BlackboardWrite& write) {
    return write.robot.value != 0 && write.robot != m_robot.id;
  });
}

Result<void> RerunRun::chooseProcesses() {
  if (m_options.processes.empty()) {
    return failure(ErrorCode::InvalidArgument,
                   "Say which process runs again, for example --process decision=reference.");
  }
  std::vector<std::string> names;
  for (const RerunProcess& process : m_options.processes) {
    if (std::ranges::find(names, process.name) != names.end()) {
      return failure(ErrorCode::InvalidArgument, process.name + " is there twice", "--process");
    }
    names.push_back(process.name);
  }
  m_feed.emplace(m_catalog, names, m_options.writes);
  const VariableMeanings& meanings = VariableMeanings::published();
  std::set<std::string> writers;
  for (const Variable& variable : m_catalog.variables()) {
    if (auto writer = meanings.writers(variable.name).writer; !writer.empty())
      writers.insert(std::move(writer));
  }
  const std::vector<std::string> known(writers.begin(), writers.end());
  for (const RerunProcess& process : m_options.processes) {
    if (writers.count(process.name) == 0 && m_options.writes.empty()) {
      return failure(ErrorCode::NotFound,
                     notAmong("process", process.name, known) +
                         " For another one, name its variables with --writes.",
                     "--process");
    }
    m_choices.push_back(TRY(rerunChoice(process, m_robot)));
    const std::string recorded = recordedProgram(process.name);
    if (m_options.isUnchanged && m_choices.back().isInside && !recorded.empty() &&
        recorded != referenceProgram) {
      return failure(ErrorCode::InvalidArgument,
                     "In this recording " + process.name + " was " + recorded + ", so \"" +
                         process.program + "\" is not the unchanged program.",
                     "--process");
    }
  }
  std::ranges::stable_sort(m_choices, {}, [](const RerunChoice& choice) {
    return choice.isInside ? turnOf(choice.process) : lastTurn;
  });
  m_feed->setColumns(m_session.groups()[m_group].info);
  const BehaviourInfo* behaviour = findBehaviour(m_robot.behaviour);
  const Variable* target = m_catalog.find("DECISION_TARGET");
  const bool usesPlanning = behaviour && behaviour->usesPose && !m_runtime.isChosen();
  const bool planned = (target && m_feed->isRecorded(*target)) || usesPlanning;
  if (!planned) m_feed->exclude("planning");
  return {};
}

Result<void> RerunRun::chooseRange() {
  const auto range = m_session.range();
  const double first = m_start, last = range ? range->end : first;
  m_begin = std::max(first, m_options.from.value_or(first));
  m_end = std::min(last, m_options.until.value_or(last));
  if (m_end <= m_begin) {
    return failure(ErrorCode::InvalidArgument,
                   "Nothing of " + m_options.robot +
                       " was recorded in this part; its rows begin at " + secondsToText(first) +
                       " and end at " + secondsToText(last) + ".",
                   "--from, --until");
  }
  const bool separate =
      std::ranges::any_of(m_choices, [](const RerunChoice& one) { return !one.isInside; });
  if (m_options.warmUp || separate) {
    m_start = std::max(first, m_begin - m_options.warmUp.value_or(freeWarmUp));
  }
  m_read = m_start;
  return {};
}

/// What a process uses, as patterns; empty: unknown.
std::vector<std::string> RerunRun::readsOf(const RerunChoice& choice) const {
  if (!choice.isInside) return {};
  const BehaviourInfo* behaviour = choice.process != "decision" ? nullptr
                                   : choice.hasBehaviour ? findBehaviour(choice.behaviour.name)
                                                         : findBehaviour(m_robot.behaviour);
  return splitNames(behaviour ? behaviour->reads : findProcess(choice.process)->reads);
}

/// Names what flowed into the process and is not in the recording.
Result<void> RerunRun::checkInputs() {
  for (const RerunChoice& choice : m_choices) {
    std::vector<std::string> reads = readsOf(choice);
    const bool known = !reads.empty();
    const auto fits = [&](const std::string& name) {
      return !known || std::ranges::any_of(reads, [&](const std::string& pattern) {
        return fitsWildcard(pattern, name);
      });
    };
    std::vector<std::string> inputs;
    for (const Variable& variable : m_catalog.variables()) {
      // What only our processes use is no loss for a team's program, and nobody has written what
      // an advisor writes in a match without one.
      const bool isExtension = !VariableCatalog::published().find(variable.name) &&
                               VariableCatalog::extended().find(variable.name);
      const bool isUnused =
          m_scenario && m_scenario->advisors.empty() &&
          VariableMeanings::published().writers(variable.name).writer == "advisor";
      if (isUnused) continue;
      if (fits(variable.name) && (known || !isExtension)) inputs.push_back(variable.name);
    }
    const auto missing = m_feed->missing(inputs, m_hasWorld);
    const auto sampled = m_feed->sampled(inputs, m_hasWorld);
    if (sampled.empty() && !m_hasWorld) {
      return failure(ErrorCode::InvalidArgument,
                     "This recording has no variable that " + choice.process + " reads" +
                         (known ? " (" + listed(missing) + ")" : std::string()) +
                         "; record the robot's blackboard, for example with pitchboard-agent.");
    }
    if (!missing.empty()) {
      m_missing.insert(m_missing.end(), missing.begin(), missing.end());
      note("Not recorded, so " + choice.process + " reads 0: " + listed(missing) + ".");
    }
    const bool coarse = !m_hasWorld || m_rowInterval > 1.5 / m_tickRate;
    if (coarse) m_sampled.insert(m_sampled.end(), sampled.begin(), sampled.end());
  }
  for (const auto& [name, tells] : m_feed->undecided()) {
    note(name + " is not compared: two processes write it, and " + tells +
         ", which tells which one, was not recorded.");
  }
  if (!m_sampled.empty()) {
    char text[32];
    std::snprintf(text, sizeof text, "%.0f", 1000.0 * m_rowInterval);
    note("The recording has a row every " + std::string(text) +
         " ms. Changes in between are missing, so differences may come from the recording: " +
         listed(m_sampled) + ".");
  }
  return {};
}

Result<void> RerunRun::openBoard() {
  const bool separate =
      std::ranges::any_of(m_choices, [](const RerunChoice& one) { return !one.isInside; });
  if (!separate) {
    m_board.emplace(Blackboard::onHeap());
    return {};
  }
  const auto keyOf = [this](MatchNumber number) {
    return blackboardKey(m_robot.id, number.keyBase());
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
  if (!m_hasWorld) return;
  bool wasPutBack = false, isDamaged = false;
  const auto add = [&](double time, StateSegment segment) {
    const double own = static_cast<double>(segment.firstTick()) / m_tickRate;
    if (std::abs(own - time) > rowTolerance + 0.5 / m_tickRate) {
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
    addPieces(m_read, until);
    Result<void> done;
    const std::array only{m_group};
    m_session.rows({m_read, until}, only, [&](telemetry::GroupId, const telemetry::RowView& row) {
      done = m_begun ? takeRow(row) : begin(row);
      return done.has_value();
    });
    TRY(std::move(done));
    m_read = until;  // a row or a piece at this time is taken twice, which changes nothing
    if (until >= m_end) {
      m_read = std::numeric_limits<double>::infinity();
      if (m_comparer) {
        m_comparer->finish();
        if (m_sinceLast) m_sinceLast->finish();
        writeEvents();
      }
    }
    if (!goesOn()) return failure(ErrorCode::Conflict, "Cancelled.");
  }
  return {};
}

/// At the first row everything on the blackboard is as it was.
Result<void> RerunRun::begin(const telemetry::RowView& row) {
  m_begun = true;
  m_tick = m_firstTick = tickOf(row.time);
  m_feed->take(row);
  m_feed->writeAll(*m_board);
  m_feed->endTick();
  if (m_world.goTo(m_tick)) {
    const sim::WorldState& world = *m_world.state();
    m_robot.field = sim::playedField(world.settings);
    m_robot.seed = world.settings.seed;
    for (std::size_t i = 0; i < world.robots.size(); ++i) {
      if (world.robots[i].id != m_robot.id) continue;
      m_robot.model = world.models[i];
      m_robot.facesLeft = world.robots[i].imuStartsAt180;
    }
  }
  std::ranges::stable_sort(m_planned, {}, &BlackboardWrite::time);
  while (m_nextPlanned < m_planned.size() &&
         firstTickAtOrAfter(m_planned[m_nextPlanned].time, m_tickRate) <= m_tick) {
    ++m_nextPlanned;  // it stands in the row
  }
  TRY(startPrograms());
  std::vector<telemetry::ColumnInfo> columns;
  for (const Feed::Output& output : m_feed->outputs()) columns.push_back(output.column);
  m_comparer.emplace(columns, m_slack, m_options.unchanged, m_options.exact);
  m_values.resize(columns.size());
  m_outputs = std::make_shared<RerunOutputs>();
  m_outputs->begin = m_outputs->end = m_begin;
  for (const telemetry::ColumnInfo& column : columns) {
    m_kept.push_back(&m_outputs->changes[column.name]);
    if (!m_options.last) continue;
    const auto found = m_options.last->changes.find(column.name);
    m_last.push_back({found == m_options.last->changes.end() ? nullptr : &found->second, 0});
  }
  m_lastValues.resize(columns.size());
  if (m_options.last) {
    m_sinceLast.emplace(columns, m_slack, m_options.unchanged, m_options.exact);
  }
  m_paceTick = m_measuredTick = m_tick;
  m_paceBegin = m_measured = std::chrono::steady_clock::now();
  if (m_tick > 0 && std::ranges::any_of(m_choices, &RerunChoice::isInside)) {
    note("The part begins at " + secondsToText(row.time) +
         ". What the process remembers from before is unknown.");
  }
  writeRow(row);
  return {};
}

Result<void> RerunRun::startPrograms() {
  bool lockStep = true;
  const bool knowsWhere =
      m_scenario && std::ranges::any_of(m_scenario->robots, [this](const ScenarioRobot& one) {
        return one.identity.id == m_robot.id && one.belief;
      });
  for (const RerunChoice& choice : m_choices) {
    if (choice.isInside) {
      m_programs.push_back(TRY(
          insideProgram(choice, m_robot, *m_board, m_tickRate, m_tick, m_tick > 0 || knowsWhere)));
    } else {
      m_programs.push_back(TRY(separateProgram(
          choice, m_robot, *m_board, m_catalog, m_options.robotProgram, [this] { return goesOn(); },
          [this](const std::string& line) {
            if (m_options.print) m_options.print(line);
          })));
    }
    lockStep = lockStep && m_programs.back()->inLockStep();
  }
  m_slack = m_options.slack.value_or(lockStep ? 0.0 : freeSlack);
  if (!lockStep) m_feed->setFree();
  if (!lockStep) m_slack = std::max(m_slack, 2.0 * m_rowInterval);
  return {};
}

Result<void> RerunRun::takeRow(const telemetry::RowView& row) {
  const std::uint64_t next = tickOf(row.time);
  if (next <= m_tick) {  // a change by hand, or two rows of one tick
    m_feed->take(row);
    m_feed->after(*m_board);
    m_feed->endTick();
    return {};
  }
  if (static_cast<double>(next - m_tick) > maxGap * m_tickRate) {
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
  const bool known = m_world.goTo(tick);
  const sim::Percepts* percepts = known ? m_world.percepts(m_robot.id) : nullptr;
  m_feed->setSensed(percepts != nullptr);
  if (m_hasWorld && !percepts && !std::exchange(m_missedWorld, true)) {
    note("From " + secondsToText(static_cast<double>(tick) / m_tickRate) +
         " on the recording has no checkpoints, so what the robot sensed is known at the times of "
         "rows only, and differences may come from that.");
  }
  if (known) TRY(followSides(tick));
  if (percepts) m_bridge->publish(*percepts, *m_board);
  if (row) m_feed->take(*row);
  for (const auto& program : m_programs) {
    m_feed->before(*m_board, program->turn());
    TRY(program->cycle(tick));
  }
  if (row) compare(*row);
  m_feed->after(*m_board);
  m_feed->endTick();
  if (row) writeRow(*row);
  return {};
}

/// As a match does it: what is due at a tick is written before the next one is played.
void RerunRun::planWrites(std::uint64_t tick) {
  for (; m_nextPlanned < m_planned.size(); ++m_nextPlanned) {
    const BlackboardWrite& write = m_planned[m_nextPlanned];
    if (firstTickAtOrAfter(write.time, m_tickRate) >= tick) return;
    m_feed->plan(*m_board, write.variable, write.value);
  }
}

Result<void> RerunRun::followSides(std::uint64_t tick) {
  for (const sim::RobotIdentity& one : m_world.state()->robots) {
    if (one.id != m_robot.id || m_robot.facesLeft == one.imuStartsAt180) continue;
    m_robot.facesLeft = one.imuStartsAt180;
    for (const auto& program : m_programs) TRY(program->changeSides(m_robot, tick));
  }
  return {};
}

void RerunRun::compare(const telemetry::RowView& row) {
  if (row.time < m_begin - rowTolerance || row.time > m_end + rowTolerance) return;
  const auto& outputs = m_feed->outputs();
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::uint32_t recorded = m_feed->word(i), rerun = m_feed->word(*m_board, i);
    m_values[i] = {numberOf(outputs[i].variable, recorded), numberOf(outputs[i].variable, rerun),
                   m_feed->counts(i), recorded == rerun};
  }
  m_comparer->add(row.time, m_values);
  if (m_sinceLast) compareWithLast(row.time);
  keepOutputs(row.time);
  if (m_options.compared) m_options.compared(row.time, m_comparer->variables(), m_values);
  writeEvents();
}

/// The rows are those that the last rerun had, too.
void RerunRun::compareWithLast(double time) {
  const RerunOutputs& last = *m_options.last;
  if (time < last.begin - rowTolerance || time > last.end + rowTolerance) return;
  for (std::size_t i = 0; i < m_values.size(); ++i) {
    LastOutput& before = m_last[i];
    ComparedValue& value = m_lastValues[i] = m_values[i];
    if (before.changes) {
      while (before.next < before.changes->size() &&
             (*before.changes)[before.next].time <= time + rowTolerance) {
        ++before.next;
      }
    }
    value.counts = value.counts && before.changes && before.next > 0;
    if (!value.counts) continue;
    value.recorded = (*before.changes)[before.next - 1].value;
    value.isSame =
        std::bit_cast<std::uint64_t>(value.recorded) == std::bit_cast<std::uint64_t>(value.rerun);
  }
  m_sinceLast->add(time, m_lastValues);
  (void)m_sinceLast->drainBegun();
}

void RerunRun::keepOutputs(double time) {
  if (m_changes >= RerunOutputs::maxChanges) return;  // what is known ends here
  m_outputs->end = time;
  for (std::size_t i = 0; i < m_values.size(); ++i) {
    std::vector<RerunOutputs::Change>& changes = *m_kept[i];
    const double now = m_values[i].rerun;
    if (!changes.empty() &&
        std::bit_cast<std::uint64_t>(changes.back().value) == std::bit_cast<std::uint64_t>(now)) {
      continue;
    }
    changes.push_back({time, now});
    ++m_changes;
  }
}

/// Plays at the chosen speed, and looks after programs, progress and cancelling.
Result<void> RerunRun::pace() {
  const auto played = [this](std::uint64_t since) {
    return static_cast<double>(m_tick - since) / m_tickRate;
  };
  while (true) {
    const auto now = std::chrono::steady_clock::now();
    const auto due = m_speed > 0.0
                         ? m_paceBegin + std::chrono::duration_cast<std::chrono::nanoseconds>(
                                             RerunSeconds(played(m_paceTick) / m_speed))
                         : now;
    if (now - m_looked >= lookEvery) {
      m_looked = now;
      if (!goesOn()) return failure(ErrorCode::Conflict, "Cancelled.");
      if (now - m_measured > 500ms) {
        m_reached = played(m_measuredTick) / RerunSeconds(now - m_measured).count();
        m_measured = now;
        m_measuredTick = m_tick;
      }
      double speed = m_options.speed;
      for (const auto& program : m_programs) {
        const double allowed = program->allowedSpeed(m_options.speed);
        if (allowed > 0.0) speed = speed > 0.0 ? std::min(speed, allowed) : allowed;
      }
      if (speed != m_speed) {
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

void RerunRun::writeRow(const telemetry::RowView& row) {
  if (!m_writer) return;
  const telemetry::GroupInfo& recorded = m_session.groups()[m_group].info;
  const auto& outputs = m_feed->outputs();
  if (!m_written) {
    telemetry::GroupInfo info{recorded.name + ' ' + rerunName, {}, recorded.robot};
    telemetry::RobotFacts& facts = info.robot.emplace(factsOf(recorded));
    facts.uid = rerunUid();
    facts.name = rerunName;
    if (facts.order) facts.order->robot.sender = rerunSender;
    std::set<int> taken;
    for (const telemetry::SessionGroup& group : m_session.groups()) {
      taken.insert(factsOf(group.info).slot);
    }
    facts.slot = highestRobotNumber;
    while (facts.slot > 1 && taken.count(facts.slot) > 0) --facts.slot;
    m_rowWords.assign(outputs.size(), -1);
    int words = 0;
    std::size_t values = 0;
    for (const telemetry::ColumnInfo& column : recorded.columns) {
      const bool isWord = column.type != telemetry::ColumnType::Float64;
      const auto output = std::ranges::find_if(
          outputs, [&](const Feed::Output& one) { return one.variable.name == column.name; });
      // What follows from the outputs, or is one of them in another form, would be that of the
      // original.
      const bool kept =
          isWord || (output == outputs.end() && !column.category.starts_with("Belief"));
      if (isWord && output != outputs.end())
        m_rowWords[static_cast<std::size_t>(output - outputs.begin())] = words;
      if (kept) info.columns.push_back(column);
      if (!isWord && kept) m_keptValues.push_back(values);
      isWord ? void(++words) : void(++values);
    }
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      if (m_rowWords[i] >= 0) continue;
      m_rowWords[i] = words++;
      info.columns.push_back(outputs[i].column);
      info.columns.back().type = outputs[i].variable.type == VariableType::Int
                                     ? telemetry::ColumnType::Int32
                                     : telemetry::ColumnType::Float32;
    }
    m_written = m_writer->addGroup(info);
    m_words.resize(static_cast<std::size_t>(words));
  }
  std::ranges::copy(row.words, m_words.begin());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    m_words[static_cast<std::size_t>(m_rowWords[i])] = m_feed->word(*m_board, i);
  }
  m_rowValues.clear();
  for (const std::size_t index : m_keptValues) m_rowValues.push_back(row.values[index]);
  m_writer->append(*m_written, {row.time, m_words, m_rowValues});
}

RobotUid RerunRun::rerunUid() const {
  return uidOf(RobotKey{teamIndex(m_robot.team), m_robot.shirt, rerunSender});
}

void RerunRun::writeEvents() {
  for (const OutputComparer::Begun& begun : m_comparer->drainBegun()) {
    if (!m_writer) continue;
    const ComparedVariable& variable = m_comparer->variables()[begun.variable];
    MatchEvent event;
    event.kind = MatchEventKind::RerunDiffers;
    event.time = begun.stretch.begin;
    event.robot = rerunUid();
    event.name = m_options.robot + ' ' + rerunName;
    event.process = VariableMeanings::published().writers(variable.column.name).writer;
    event.detail = variable.column.name + ": " + differenceText(variable, begun.stretch);
    m_writer->append(sessionEvent(event));
  }
}

Result<RerunResult> RerunRun::finish() {
  TRY(advanceTo(m_end));
  if (!m_begun || !m_comparer) {
    return failure(ErrorCode::InvalidArgument,
                   "There is no row of " + m_options.robot + " to run.");
  }
  RerunResult result;
  result.robot = m_options.robot;
  result.processes = m_options.processes;
  result.notes = m_notes;
  result.begin = m_begin;
  result.end = m_end;
  result.inLockStep =
      std::ranges::all_of(m_programs, [](const auto& program) { return program->inLockStep(); });
  result.slack = m_slack;
  result.sampledInputs = m_sampled;
  result.rowInterval = m_rowInterval;
  result.variables = m_comparer->variables();
  result.outputs = m_outputs;
  if (m_sinceLast) result.sinceLast = m_sinceLast->variables();
  return result;
}

}  // namespace pitchboard::link
