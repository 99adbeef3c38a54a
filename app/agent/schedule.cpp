// SPDX-License-Identifier: GPL-3.0-or-later
#include "schedule.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace pitchboard::agent {
namespace {

using telemetry::Pb2Number;
using telemetry::Pb2Writer;

constexpr Time second = std::chrono::seconds(1);
/// Room for the largest datagram of one variable and the status, twice: one for the refresh.
constexpr double smallDatagram = 200.0;

double secondsOf(Time time) {
  return std::chrono::duration<double>(time).count();
}

Pb2Number numberOf(const link::Variable& variable, std::uint32_t word) {
  return variable.type == link::VariableType::Int
             ? Pb2Number(std::int64_t{std::bit_cast<std::int32_t>(word)})
             : Pb2Number(std::bit_cast<float>(word));
}

}  // namespace

Schedule::Schedule(const ScheduleOptions& options, std::vector<link::Variable> variables)
    : m_options(options),
      m_variables(std::move(variables)),
      m_states(m_variables.size()),
      m_words(m_variables.size()) {}

Time Schedule::refreshTime(Time now) const {
  const Time thisRound = m_there ? now - m_roundStart : Time{};
  return std::max({promisedPeriod, m_lastRound, thisRound});
}

void Schedule::refill(Time now) {
  const double passed = m_started ? secondsOf(now - m_last) : 0.0;
  const double limit = m_options.bytesPerSecond;
  const double share = limit / 4;
  // What is saved up is what one tick needs: more would be a burst.
  const double tick = std::max(1.0 / m_options.rate, secondsOf(refreshStep));
  const double receivers = m_options.receivers;
  m_tokens = std::min(m_tokens + limit * passed, limit * tick + 2 * smallDatagram * receivers);
  m_reserve = std::min(m_reserve + share * passed, share * tick + smallDatagram * receivers);
  if (!m_started) m_tokens = 2 * smallDatagram * receivers;
  while (!m_lastSecond.empty() && now - m_lastSecond.front().at > second) {
    m_spentLastSecond -= m_lastSecond.front().bytes;
    m_lastSecond.pop_front();
  }
  if (m_lastSecond.empty()) m_spentLastSecond = 0.0;

  const auto count = static_cast<double>(m_variables.size());
  m_due = std::min(m_due + count * passed / secondsOf(refreshPeriod), count);
}

double Schedule::room() const {
  if (m_options.bytesPerSecond <= 0.0) return std::numeric_limits<double>::infinity();
  return std::min(m_tokens, m_options.bytesPerSecond - m_spentLastSecond);
}

void Schedule::spend(Time now, double bytes) {
  m_spentNow += bytes;
  if (m_options.bytesPerSecond <= 0.0) return;
  m_tokens -= bytes;
  m_spentLastSecond += bytes;
  if (m_lastSecond.empty() || m_lastSecond.back().at != now) m_lastSecond.push_back({now, 0.0});
  m_lastSecond.back().bytes += bytes;
}

void Schedule::close() {
  if (m_open.empty()) return;
  m_datagrams.push_back(std::move(m_open.back()).finish());
  m_open.clear();
}

/// Begins a datagram if it may hold so many bytes; the first one of a second tells the status.
bool Schedule::open(Time now, double room, std::size_t fieldBytes) {
  Pb2Writer writer(m_options.robot, m_sequence, static_cast<std::uint64_t>(now.count() / 1000));
  const bool sendsStatus = now - m_lastStatus >= statusStep || m_there != m_reportedThere;
  if (sendsStatus) {
    const auto refresh = std::chrono::duration_cast<std::chrono::milliseconds>(refreshTime(now));
    writer.add("@REFRESH", Pb2Number(std::int64_t{refresh.count()}).text());
    writer.add("@WAITING", Pb2Number(static_cast<std::int64_t>(m_waited)).text());
    writer.add("@BLACKBOARD", Pb2Number(std::int64_t{m_there}).text());
  }
  const double cost = static_cast<double>(headerBytes + writer.bytes()) * m_options.receivers;
  if (cost + static_cast<double>(fieldBytes) * m_options.receivers > room) return false;
  close();
  m_open.push_back(std::move(writer));
  ++m_sequence;
  spend(now, cost);
  if (sendsStatus) {
    m_lastStatus = now;
    m_reportedThere = m_there;
  }
  return true;
}

bool Schedule::put(std::size_t index, Time now, double room) {
  const link::Variable& variable = m_variables[index];
  const Pb2Number number = numberOf(variable, m_words[index]);
  const std::size_t bytes = Pb2Writer::fieldBytes(variable.name, number.text());
  const double cost = static_cast<double>(bytes) * m_options.receivers;
  if (!m_open.empty() && m_open.back().fits(bytes)) {
    if (cost > room) return false;
  } else if (!open(now, room, bytes)) {
    return false;
  }
  m_open.back().add(variable.name, number.text());
  spend(now, cost);
  State& state = m_states[index];
  state.sent = m_words[index];
  state.known = true;
  state.sentAt = now;
  return true;
}

void Schedule::sendChanges(Time now, std::span<const std::uint32_t> words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    State& state = m_states[i];
    m_words[i] = words[i];
    if (state.queued || (state.known && state.sent == words[i])) continue;
    state.queued = true;
    m_queue.push_back(i);
  }
  while (!m_queue.empty()) {
    const std::size_t index = m_queue.front();
    State& state = m_states[index];
    const bool stillNew = !state.known || state.sent != m_words[index];
    if (stillNew && !put(index, now, room() - m_reserve)) return;
    state.queued = false;
    m_queue.pop_front();
  }
}

void Schedule::sendRefresh(Time now) {
  if (m_open.empty() && now - m_lastRefresh < refreshStep) return;
  while (m_due >= 1.0) {
    const double before = m_spentNow;
    const bool fresh = m_states[m_cursor].sentAt == now;
    if (!fresh && !put(m_cursor, now, room())) return;
    m_reserve = std::max(0.0, m_reserve - (m_spentNow - before));
    m_lastRefresh = now;
    m_due -= 1.0;
    if (++m_cursor < m_variables.size()) continue;
    m_cursor = 0;
    m_lastRound = now - m_roundStart;
    m_roundStart = now;
  }
}

const std::vector<std::string>& Schedule::next(Time now, std::span<const std::uint32_t> words) {
  m_datagrams.clear();
  refill(now);
  m_waited = m_queue.size();
  const bool there = !words.empty();
  if (there && !m_there) {
    m_roundStart = now;
    m_lastRound = Time{};
  }
  m_there = there;
  m_started = true;
  m_last = now;
  if (there) {
    sendChanges(now, words);
    sendRefresh(now);
  } else {
    m_due = 0.0;
  }
  // The status goes along with values; alone only when none come.
  const Time patience = there ? statusStep + 2 * refreshStep : statusStep;
  const bool nothingSent = m_open.empty() && m_datagrams.empty();
  if (nothingSent && (m_there != m_reportedThere || now - m_lastStatus >= patience)) {
    (void)open(now, room(), 0);
  }
  close();
  return m_datagrams;
}

}  // namespace pitchboard::agent
