// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_comparison.h"

#include <algorithm>
#include <bit>

#include "recorded_robot.h"

namespace pitchboard::link {
namespace {

double numberOf(const Variable& variable, std::uint32_t word) {
  return variable.type == VariableType::Int ? static_cast<double>(std::bit_cast<std::int32_t>(word))
                                            : static_cast<double>(std::bit_cast<float>(word));
}

bool isSameNumber(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::vector<telemetry::ColumnInfo> columnsOf(const Feed& feed) {
  std::vector<telemetry::ColumnInfo> columns;
  for (const Feed::Output& output : feed.outputs()) columns.push_back(output.column);
  return columns;
}

}  // namespace

RunComparison::RunComparison(const Feed& feed, const RerunOptions& options, double slack,
                             double begin)
    : m_feed(feed),
      m_options(options),
      m_comparer(columnsOf(feed), slack, options.unchanged, options.exact),
      m_values(feed.outputs().size()),
      m_lastValues(feed.outputs().size()),
      m_outputs(std::make_shared<RerunOutputs>()) {
  m_outputs->begin = m_outputs->end = begin;
  for (const Feed::Output& output : feed.outputs()) {
    m_kept.push_back(&m_outputs->changes[output.column.name]);
    if (!options.last) continue;
    const auto found = options.last->changes.find(output.column.name);
    m_last.push_back({found == options.last->changes.end() ? nullptr : &found->second, 0});
  }
  if (options.last) m_sinceLast.emplace(columnsOf(feed), slack, options.unchanged, options.exact);
}

void RunComparison::add(double time, const Blackboard& board,
                        const std::vector<std::string>& running) {
  const auto& outputs = m_feed.outputs();
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::uint32_t recorded = m_feed.word(i), rerun = m_feed.word(board, i);
    const bool isComplete = std::ranges::find(running, outputs[i].process) == running.end();
    m_values[i] = {numberOf(outputs[i].variable, recorded), numberOf(outputs[i].variable, rerun),
                   m_feed.counts(i) && isComplete, recorded == rerun};
  }
  m_comparer.add(time, m_values);
  if (m_sinceLast) compareWithLast(time);
  keep(time);
  if (m_options.compared) m_options.compared(time, m_comparer.variables(), m_values);
}

/// The rows are those that the last rerun had, too.
void RunComparison::compareWithLast(double time) {
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
    value.isSame = isSameNumber(value.recorded, value.rerun);
  }
  m_sinceLast->add(time, m_lastValues);
  (void)m_sinceLast->drainBegun();
}

void RunComparison::keep(double time) {
  if (m_changes >= RerunOutputs::maxChanges) return;  // what is known ends here
  m_outputs->end = time;
  for (std::size_t i = 0; i < m_values.size(); ++i) {
    std::vector<RerunOutputs::Change>& changes = *m_kept[i];
    const double now = m_values[i].rerun;
    if (!changes.empty() && isSameNumber(changes.back().value, now)) continue;
    changes.push_back({time, now});
    ++m_changes;
  }
}

void RunComparison::finish() {
  m_comparer.finish();
  if (m_sinceLast) m_sinceLast->finish();
}

void RunComparison::putInto(RerunResult& result) const {
  result.variables = m_comparer.variables();
  result.outputs = m_outputs;
  if (m_sinceLast) result.sinceLast = m_sinceLast->variables();
}

}  // namespace pitchboard::link
