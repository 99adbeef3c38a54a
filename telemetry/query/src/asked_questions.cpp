// SPDX-License-Identifier: GPL-3.0-or-later
#include "asked_questions.h"

#include <cmath>
#include <limits>

#include "comparisons.h"

namespace pitchboard::telemetry {
namespace {

AskedQuestion asked(const MomentQuestion& question) {
  AskedQuestion out;
  out.least = question.least;
  out.text = {question.condition, {}, question.robots};
  auto first = comparisonOf(conjunctsOf(question.condition).front());
  if (!first || first->op == "==") return out;
  if (const auto turned = withNumberOnTheRight(*first)) first = turned;
  const auto limit = numberIn(first->right);
  const std::string value = limit ? first->left : "(" + first->left + ") - (" + first->right + ")";
  // The value has to have its samples where the condition has them: at its first variable.
  const auto parsed = Expression::parse(value, eachRobot);
  const auto whole = Expression::parse(question.condition, eachRobot);
  if (!parsed || !whole || parsed->variables().front() != whole->variables().front()) return out;
  out.text.value = value;
  out.text.condition = question.condition;
  out.hasValue = true;
  out.sign = first->op.front() == '<' ? -1.0 : 1.0;
  out.limit = limit.value_or(0.0);
  return out;
}

}  // namespace

std::vector<AskedQuestion> askedOf(std::span<const MomentQuestion> questions) {
  std::vector<AskedQuestion> out;
  for (const MomentQuestion& question : questions) out.push_back(asked(question));
  return out;
}

AskedQuery resolvedFor(const QueryRows& rows, std::span<const AskedQuestion> asked) {
  AskedQuery out;
  std::vector<QueryText> texts;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (const auto one = SessionQuery::of(rows, std::span(&asked[i].text, 1)); !one) {
      out.unanswered.push_back({i, one.error()});
      continue;
    }
    texts.push_back(asked[i].text);
    out.questions.push_back(i);
  }
  if (texts.empty()) return out;
  if (auto all = SessionQuery::of(rows, texts)) out.query = std::move(*all);
  return out;
}

bool addStretches(const QueryRows& rows, AskedQuery& query, std::span<const AskedQuestion> asked,
                  TimeRange range, std::span<Stretches> out,
                  const std::function<bool(double)>& progress) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return query.query->run(
      rows, range,
      [&](const QuerySample& sample) {
        const AskedQuestion& question = asked[query.questionOf(sample.curve)];
        const bool holds = question.hasValue ? sample.isConditioned
                                             : std::isfinite(sample.value) && sample.value != 0.0;
        out[sample.curve].add(sample.time, holds, [&] {
          return question.hasValue
                     ? Stretches::Excess{question.sign * (sample.value - question.limit),
                                         sample.value}
                     : Stretches::Excess{none, none};
        });
        return true;
      },
      progress);
}

void addMoments(std::span<const Stretches::Found> found, std::size_t question,
                const AskedQuestion& asked, const std::string& robot,
                std::vector<FoundMoment>& out) {
  constexpr double rounding = 2e-9;  // s; files have whole nanoseconds
  for (const Stretches::Found& one : found) {
    if (one.until - one.from < asked.least - rounding) continue;
    FoundMoment moment{question, robot, {one.from, one.until}, {}, one.valueAt};
    if (std::isfinite(one.value)) moment.value = one.value;
    out.push_back(std::move(moment));
  }
}

}  // namespace pitchboard::telemetry
