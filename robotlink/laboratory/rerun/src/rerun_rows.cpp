// SPDX-License-Identifier: GPL-3.0-or-later
#include "rerun_rows.h"

#include <algorithm>
#include <set>

#include <robotlink/blackboard/match_number.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/frame/teams.h>
#include <robotlink/session/session_events.h>

namespace pitchboard::link {
namespace {

constexpr const char* rerunName = "rerun";
constexpr int rerunSender = 4096;  // no program with the same number is so far back

}  // namespace

RobotUid RerunRows::uid() const {
  const RerunRobot& robot = m_recorded.robot;
  return uidOf(RobotKey{teamIndex(robot.team), robot.shirt, rerunSender});
}

void RerunRows::addGroup() {
  const telemetry::GroupInfo& recorded = m_session.groups()[m_recorded.group].info;
  const auto& outputs = m_feed.outputs();
  telemetry::GroupInfo info{recorded.name + ' ' + rerunName, {}, recorded.robot};
  telemetry::RobotFacts& facts = info.robot.emplace(factsOf(recorded));
  facts.uid = uid();
  facts.programs.clear();
  for (const RerunChoice& choice : m_choices) {
    if (!choice.isInside) facts.programs.push_back(programOf(choice.command));
    if (choice.hasBehaviour) facts.behaviour = choice.behaviour.name;
  }
  if (facts.order) facts.order->robot.sender = rerunSender;
  std::set<int> taken;
  for (const telemetry::SessionGroup& group : m_session.groups()) {
    taken.insert(factsOf(group.info).slot);
  }
  facts.slot = highestRobotNumber;
  while (facts.slot > 1 && taken.count(facts.slot) > 0) --facts.slot;
  m_outputWords.assign(outputs.size(), -1);
  int words = 0;
  std::size_t values = 0;
  for (const telemetry::ColumnInfo& column : recorded.columns) {
    const bool isWord = column.type != telemetry::ColumnType::Float64;
    const auto output = std::ranges::find_if(
        outputs, [&](const Feed::Output& one) { return one.variable.name == column.name; });
    // What follows from the outputs, or is one of them in another form, would be that of the
    // original.
    const bool kept = isWord || (output == outputs.end() && !column.category.starts_with("Belief"));
    if (isWord && output != outputs.end())
      m_outputWords[static_cast<std::size_t>(output - outputs.begin())] = words;
    if (kept) info.columns.push_back(column);
    if (!isWord && kept) m_keptValues.push_back(values);
    isWord ? void(++words) : void(++values);
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (m_outputWords[i] >= 0) continue;
    m_outputWords[i] = words++;
    info.columns.push_back(outputs[i].column);
    info.columns.back().type = outputs[i].variable.type == VariableType::Int
                                   ? telemetry::ColumnType::Int32
                                   : telemetry::ColumnType::Float32;
  }
  m_group = m_writer->addGroup(info);
  m_words.resize(static_cast<std::size_t>(words));
}

void RerunRows::write(const telemetry::RowView& row, const Blackboard& board) {
  if (!m_writer) return;
  if (!m_group) addGroup();
  std::ranges::copy(row.words, m_words.begin());
  for (std::size_t i = 0; i < m_outputWords.size(); ++i) {
    m_words[static_cast<std::size_t>(m_outputWords[i])] = m_feed.word(board, i);
  }
  m_values.clear();
  for (const std::size_t index : m_keptValues) m_values.push_back(row.values[index]);
  m_writer->append(*m_group, {row.time, m_words, m_values});
}

void RerunRows::write(const std::vector<OutputComparer::Begun>& differences,
                      const std::vector<ComparedVariable>& variables) {
  if (!m_writer) return;
  for (const OutputComparer::Begun& begun : differences) {
    const ComparedVariable& variable = variables[begun.variable];
    MatchEvent event;
    event.kind = MatchEventKind::RerunDiffers;
    event.time = begun.stretch.begin;
    event.robot = uid();
    event.name = m_recorded.name + ' ' + rerunName;
    event.process = VariableMeanings::published().writers(variable.column.name).writer;
    event.detail = variable.column.name + ": " + differenceText(variable, begun.stretch);
    m_writer->append(sessionEvent(event));
  }
}

}  // namespace pitchboard::link
