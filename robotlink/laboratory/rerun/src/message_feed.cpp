// SPDX-License-Identifier: GPL-3.0-or-later
#include "message_feed.h"

#include <array>
#include <utility>

#include <base/try.h>
#include <robotlink/cognition/process_registry.h>
#include <telemetry/referee/gamecontroller.h>

namespace pitchboard::link {
namespace {

using Stream = telemetry::SessionStream;

constexpr telemetry::Address loopbackBroadcast{0x7fffffff};  // 127.255.255.255: all that listen
constexpr double everTime = 1e18;
constexpr telemetry::TimeRange allTimes{-everTime, everTime};
constexpr std::array datagramStreams{Stream::Telemetry, Stream::RefereeRaw};

telemetry::DatagramView viewOf(const telemetry::SessionDatagram& datagram) {
  const std::chrono::duration<double> time(datagram.time);
  return {telemetry::WallTime(std::chrono::duration_cast<telemetry::Duration>(time)),
          datagram.sender, datagram.localPort, false, datagram.payload};
}

}  // namespace

bool hearsMessages(const std::string& process) {
  const ProcessInfo* known = findProcess(process);
  return known == nullptr || !known->receives.empty();
}

std::uint64_t MessageFeed::count(const telemetry::SessionReader& session) {
  std::uint64_t count = 0;
  for (const Stream stream : datagramStreams) count += session.count(stream);
  return count;
}

Result<MessageFeed> MessageFeed::start(const telemetry::SessionReader& session,
                                       const RecordedRobot& recorded, bool sends) {
  const telemetry::RobotFacts& facts = factsOf(session.groups()[recorded.group].info);
  const std::string own = facts.sentFrom.empty() ? facts.sender : facts.sentFrom;
  MessageFeed feed;
  feed.m_own = own.substr(0, own.find(':'));
  if (sends) feed.m_sender = TRY(telemetry::UdpSender::simulatedTo(loopbackBroadcast));
  return feed;
}

std::optional<int> MessageFeed::refereeTeam(const telemetry::SessionReader& session,
                                            const RecordedRobot& recorded) {
  const telemetry::RobotFacts& facts = factsOf(session.groups()[recorded.group].info);
  if (facts.teamNumber > 0) return facts.teamNumber;
  std::optional<int> number;
  if (!facts.team) return number;
  session.messages(Stream::RefereeRaw, allTimes, [&](double, std::string_view json) {
    const auto datagram = telemetry::sessionDatagram(json);
    const auto packet = telemetry::decodeReferee(datagram ? datagram->payload : std::string());
    const auto* state = packet ? std::get_if<telemetry::RefereeState>(&*packet) : nullptr;
    if (state == nullptr) return true;
    const Game game = telemetry::gameOf(*state);
    const int team = game.teamOf(*facts.team);
    if (team != Game::noTeam) number = game.teams[static_cast<std::size_t>(team)].number;
    return !number;
  });
  return number;
}

bool MessageFeed::tellsSetPlay(const telemetry::SessionReader& session,
                               const RecordedRobot& recorded) {
  const std::array<std::string, 1> left{"COM_SECONDS_LEFT"};
  Feed feed(recorded.catalog, {}, left);
  feed.setColumns(session.groups()[recorded.group].info);
  bool tells = false;
  if (feed.outputs().empty()) return tells;
  session.rows(allTimes, std::array{recorded.group},
               [&](telemetry::GroupId, const telemetry::RowView& row) {
                 feed.take(row);
                 tells = feed.word(0) != 0;
                 return !tells;
               });
  return tells;
}

void MessageFeed::read(const telemetry::SessionReader& session, double from, double until) {
  session.messages(datagramStreams, {from, until},
                   [&](Stream stream, double time, std::string_view json) {
                     auto datagram = telemetry::sessionDatagram(json);
                     if (!datagram || time >= until) return true;
                     if (m_own.empty() || datagram->sender.address.text() != m_own) {
                       datagram->time = time;
                       m_waiting.push_back({*std::move(datagram), stream == Stream::RefereeRaw});
                     }
                     return true;
                   });
}

void MessageFeed::sendTo(double time) {
  for (; !m_waiting.empty() && m_waiting.front().datagram.time <= time; m_waiting.pop_front()) {
    const telemetry::SessionDatagram& one = m_waiting.front().datagram;
    if (m_sender) m_sender->send(one.localPort, one.payload);
    if (m_waiting.front().isReferee) m_inside->append(viewOf(one));
  }
}

std::function<bool(telemetry::DatagramBatch&)> MessageFeed::refereeDatagrams() const {
  return [inside = m_inside](telemetry::DatagramBatch& batch) {
    batch.clear();
    std::swap(batch, *inside);
    return !batch.empty();
  };
}

}  // namespace pitchboard::link
