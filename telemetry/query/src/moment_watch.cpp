// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/query/moment_watch.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "asked_questions.h"

namespace pitchboard::telemetry {
namespace {

/// What the names of a query depend on.
using GroupLayout = std::vector<std::pair<std::string, std::size_t>>;

GroupLayout layoutOf(const QueryRows& rows) {
  GroupLayout out;
  for (const GroupInfo* group : rows.groups()) {
    out.emplace_back(group->name, group->columns.size());
  }
  return out;
}

}  // namespace

struct MomentWatch::Impl {
  using Key = std::pair<std::size_t, std::string>;  // question, robot

  std::vector<AskedQuestion> asked;
  AskedQuery query{};
  GroupLayout layout{};
  std::map<Key, Stretches> stretches{};
  std::vector<FoundMoment> ended{};
  double done = -std::numeric_limits<double>::infinity();

  Key keyOf(std::size_t curve) const {
    return {query.questionOf(curve), query.query->curves()[curve].robot};
  }
  void takeEnded() {
    for (auto& [key, of] : stretches) {
      addMoments(of.takeEnded(), key.first, asked[key.first], key.second, ended);
    }
  }
};

MomentWatch::MomentWatch(std::vector<MomentQuestion> questions)
    : m_impl(std::make_unique<Impl>(Impl{askedOf(questions)})) {}
MomentWatch::MomentWatch(MomentWatch&&) noexcept = default;
MomentWatch& MomentWatch::operator=(MomentWatch&&) noexcept = default;
MomentWatch::~MomentWatch() = default;

bool MomentWatch::advance(const QueryRows& rows, double until,
                          const std::function<bool(double)>& progress) {
  Impl& d = *m_impl;
  if (GroupLayout layout = layoutOf(rows); layout != d.layout) {
    d.layout = std::move(layout);
    d.query = resolvedFor(rows, d.asked);
  }
  const auto all = rows.range();
  if (!all || until <= d.done) return true;
  const TimeRange fresh{
      std::max(all->begin, std::nextafter(d.done, std::numeric_limits<double>::infinity())), until};
  d.done = until;
  if (d.query.query && fresh.begin <= fresh.end) {
    std::vector<Stretches> ofCurves;
    const std::size_t curves = d.query.query->curves().size();
    for (std::size_t c = 0; c < curves; ++c) {
      ofCurves.push_back(std::move(d.stretches[d.keyOf(c)]));
    }
    if (!addStretches(rows, d.query, d.asked, fresh, ofCurves, progress)) return false;
    for (std::size_t c = 0; c < curves; ++c) d.stretches[d.keyOf(c)] = std::move(ofCurves[c]);
  }
  for (auto& [key, of] : d.stretches) of.endIfSilent(until);
  d.takeEnded();
  return true;
}

std::vector<FoundMoment> MomentWatch::takeEnded() {
  std::vector<FoundMoment> out = std::exchange(m_impl->ended, {});
  std::ranges::stable_sort(out, {}, [](const FoundMoment& one) { return one.range.begin; });
  return out;
}

std::vector<FoundMoment> MomentWatch::open() const {
  std::vector<FoundMoment> out;
  for (const auto& [key, of] : m_impl->stretches) {
    addMoments(of.found(), key.first, m_impl->asked[key.first], key.second, out);
  }
  return out;
}

const std::vector<UnansweredQuestion>& MomentWatch::unanswered() const {
  return m_impl->query.unanswered;
}

}  // namespace pitchboard::telemetry
