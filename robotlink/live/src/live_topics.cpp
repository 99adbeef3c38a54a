// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_topics.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include <robotlink/live/live_rows.h>
#include <robotlink/live/robot_uids.h>
#include <robotlink/live/topic_groups.h>
#include <robotlink/live/topic_meanings.h>
#include <robotlink/live/topic_robots.h>
#include <telemetry/formats/text_errors.h>
#include <telemetry/monitor/arrival_stats.h>
#include <telemetry/pb2/clock_map.h>
#include <telemetry/recordings/decoded_topics.h>

namespace pitchboard::link {
namespace {

using telemetry::FoxgloveChannel;
using telemetry::RecordedMessage;
using telemetry::RecordedTopic;
using telemetry::WallTime;

constexpr std::int64_t nanosecondsPerMs = 1'000'000;
constexpr std::int64_t mostTimeBack = 1'000'000'000;  // ns; a message further back is an old one
constexpr int mostBack = 50;  // old messages in a row: the source's clock was set back
constexpr std::size_t mostReasons = 20, mostRobotRows = 10'000;
constexpr std::size_t shownText = 200;  // of what a program says

std::vector<telemetry::ColumnInfo> sourceColumns() {
  std::vector<telemetry::ColumnInfo> columns;
  for (const auto& [name, unit] : {std::pair("RATE", "1/s"),
                                   {"DELAY", "ms"},
                                   {"JITTER", "ms"},
                                   {"CLOCK_OFFSET", "s"},
                                   {"DROPPED", ""},
                                   {"ERRORS", ""}}) {
    telemetry::ColumnInfo& column = columns.emplace_back();
    column.name = name;
    column.unit = unit;
    column.category = linkCategory;
  }
  return columns;
}

double secondsOfNs(std::int64_t time) {
  return static_cast<double>(time) * 1e-9;
}

}  // namespace

/// Keeps the rows of robots until drainRows().
class LiveTopics::RobotRowKeeper : public telemetry::RowSink {
 public:
  telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override {
    auto known = std::ranges::find_if(
        m_groups, [&info](const Group& group) { return isSameGroup(group.info, info); });
    if (known == m_groups.end()) known = m_groups.insert(known, Group{});
    known->info = info;
    return static_cast<telemetry::GroupId>(known - m_groups.begin());
  }
  void append(telemetry::GroupId group, const telemetry::RowView& row) override {
    std::vector<BoardRow>& rows = m_groups[group].rows;
    if (rows.size() >= mostRobotRows) return;  // nobody takes them
    rows.push_back({row.time, {}, {row.values.begin(), row.values.end()}});
  }
  void drain(const BoardRowsTaker& take) {
    for (Group& group : m_groups) {
      if (!group.rows.empty()) take(group.info, group.rows);
      group.rows.clear();
    }
  }

 private:
  struct Group {
    telemetry::GroupInfo info;
    std::vector<BoardRow> rows;
  };
  std::vector<Group> m_groups;
};

struct LiveTopics::Groups : TopicGroups {
  using TopicGroups::TopicGroups;
};

/// Stays, so that a source that is added again continues its groups of rows.
struct LiveTopics::Known {
  telemetry::FoxgloveAddress address;
  std::size_t index = 0;
  telemetry::DecodedTopics topics;
};

struct LiveTopics::Source {
  FoxgloveSource source;
  Known* known = nullptr;
  telemetry::FoxgloveClientStatus client;

  std::uint64_t session = 0;
  std::unordered_map<std::uint32_t, std::size_t> topicOfChannel;
  std::optional<TopicMapping> given;  ///< by a file
  TopicMapping mapping;
  std::unique_ptr<TopicRobots> robots;
  std::optional<TopicLog> log;
  std::optional<TopicReferee> referee;

  StampChoice stamps;
  telemetry::ClockMap clock;
  std::optional<std::int64_t> newest;  ///< log time, ns
  int back = 0;                        ///< old messages in a row
  telemetry::ArrivalStats arrivals;
  double delay = 0.0;
  std::uint64_t old = 0, restarts = 0, wrongBefore = 0;
};

LiveTopics::LiveTopics(Outputs outputs, WallTime zero)
    : m_outputs(std::move(outputs)),
      m_zero(zero),
      m_robotRows(std::make_unique<RobotRowKeeper>()),
      m_groups(std::make_unique<Groups>(m_outputs.rows, m_outputs.log)) {}

LiveTopics::~LiveTopics() = default;

LiveTopics::Known* LiveTopics::knownAt(const telemetry::FoxgloveAddress& address) {
  const auto known = std::ranges::find_if(
      m_known, [&address](const auto& one) { return one->address == address; });
  if (known != m_known.end()) return known->get();
  auto made = std::make_unique<Known>();
  made->address = address;
  made->index = m_known.size();
  return m_known.emplace_back(std::move(made)).get();
}

void LiveTopics::setSources(const std::vector<FoxgloveSource>& sources, const sim::FieldSpec& field,
                            double timeout) {
  const bool isOtherField = !(field == m_field);
  m_field = field;
  m_timeout = timeout;
  std::erase_if(m_sources, [&sources](const auto& known) {
    return std::ranges::find(sources, known->source) == sources.end();
  });
  for (const auto& known : m_sources) {
    known->robots->setTimeout(timeout);
    if (isOtherField) begin(*known);
  }
  for (const FoxgloveSource& source : sources) {
    if (find(source) != nullptr) continue;
    auto made = std::make_unique<Source>();
    made->source = source;
    made->known = knownAt(source.address);
    if (!source.mappingFile.empty()) {
      if (auto read = mappingFromFile(source.mappingFile)) made->given = std::move(*read);
    }
    begin(*made);
    m_sources.push_back(std::move(made));
  }
}

LiveTopics::Source* LiveTopics::find(const FoxgloveSource& source) const {
  const auto known =
      std::ranges::find_if(m_sources, [&source](const auto& one) { return one->source == source; });
  return known == m_sources.end() ? nullptr : known->get();
}

/// Robots begin anew.
void LiveTopics::begin(Source& source) {
  source.robots.reset();
  TopicRobots::Options options;
  options.field = m_field;
  options.timeout = m_timeout;
  options.source = static_cast<int>(source.known->index % TopicRobots::maxSources);
  options.numberOf = [this](TeamColor team, int wanted) { return freeNumber(team, wanted); };
  source.mapping = {};
  source.robots = std::make_unique<TopicRobots>(*m_robotRows, TopicMapping{}, std::move(options));
  map(source);
}

int LiveTopics::freeNumber(TeamColor team, int wanted) const {
  const auto isTaken = [this, team](int number) {
    return std::ranges::any_of(m_sources, [&](const auto& source) {
      return source->robots && source->robots->hasNumber(team, number);
    });
  };
  int number = std::max(1, wanted);
  while (isTaken(number)) ++number;
  return number;
}

/// What the topics that are known so far mean.
void LiveTopics::map(Source& source) {
  TopicMapping mapping =
      source.given ? *source.given : builtInMapping(source.known->topics.topics());
  if (!source.given) {
    const std::string& host = source.source.address.host;
    const bool isName =
        std::ranges::any_of(host, [](unsigned char letter) { return std::isalpha(letter) != 0; }) &&
        host.find(':') == host.npos;
    const std::string label = host.substr(0, host.find('.'));
    for (MappedRobot& robot : mapping.robots) {
      robot.team = source.source.team;
      const bool isOnly = robot.name.empty() || mapping.robots.size() == 1;
      if (source.source.robot > 0 && isOnly) {
        robot.number = source.source.robot;
      } else if (robot.name.empty() && isName) {
        robot.number = numberOfName(label).value_or(robot.number);
      }
    }
  }
  if (mapping == source.mapping && source.log) return;
  source.robots->update(mapping);
  source.log.emplace(mapping);
  if (mapping.referee != source.mapping.referee) {
    source.referee.reset();
    if (mapping.referee) source.referee.emplace(*mapping.referee);
  }
  source.mapping = std::move(mapping);
}

TopicRequest LiveTopics::take(const FoxgloveSource& from, const telemetry::FoxgloveEvent& event) {
  Source* source = find(from);
  if (source == nullptr) return {};
  if (const auto* begun = std::get_if<telemetry::FoxgloveBegun>(&event)) {
    source->session = begun->session;
    source->topicOfChannel.clear();
    // Its computer may have started again, with another clock.
    source->clock = {};
    source->newest.reset();
    source->back = 0;
    source->stamps = {};
  } else if (const auto* added = std::get_if<telemetry::FoxgloveChannelsAdded>(&event)) {
    return add(*source, added->channels);
  } else if (const auto* gone = std::get_if<telemetry::FoxgloveChannelsRemoved>(&event)) {
    for (const std::uint32_t channel : gone->channels) source->topicOfChannel.erase(channel);
  } else if (const auto* message = std::get_if<telemetry::FoxgloveReceived>(&event)) {
    receive(*source, *message);
  } else {
    source->topicOfChannel.clear();
  }
  return {};
}

TopicRequest LiveTopics::add(Source& source, const std::vector<FoxgloveChannel>& channels) {
  TopicRequest request{source.session, {}};
  const std::size_t before = source.known->topics.topics().size();
  for (const FoxgloveChannel& channel : channels) {
    source.topicOfChannel.erase(channel.id);
    if (source.known->topics.topics().size() >= maxTopics) continue;
    const std::size_t topic = source.known->topics.add(
        channel.topic,
        {channel.schemaName, channel.schemaEncoding, channel.encoding, channel.schema}, 0);
    source.topicOfChannel[channel.id] = topic;
    if (source.known->topics.isWanted(topic)) request.channels.push_back(channel.id);
  }
  if (source.known->topics.topics().size() > before) map(source);
  return request;
}

void LiveTopics::receive(Source& source, const telemetry::FoxgloveReceived& received) {
  const auto known = source.topicOfChannel.find(received.channel);
  if (known == source.topicOfChannel.end() || !source.known->topics.isWanted(known->second)) return;
  source.arrivals.add(received.arrival);
  const auto logTime = static_cast<std::int64_t>(
      std::min<std::uint64_t>(received.logTime, std::numeric_limits<std::int64_t>::max()));
  const double arrival = std::max(0.0, telemetry::secondsOf(received.arrival - m_zero));

  // Messages that were kept for new subscribers carry old times: they say nothing of the delay.
  const bool isBack = source.newest && logTime < *source.newest - mostTimeBack;
  source.back = isBack ? source.back + 1 : 0;
  if (source.back >= mostBack) {
    source.clock = {};
    source.newest.reset();
    source.back = 0;
    ++source.restarts;
  }
  if (!source.newest || !isBack) {
    // ClockMap counts whole milliseconds.
    const std::int64_t rest = logTime % nanosecondsPerMs;
    source.clock.map(static_cast<std::uint64_t>(logTime / nanosecondsPerMs),
                     arrival - secondsOfNs(rest));
    source.newest = std::max(logTime, source.newest.value_or(logTime));
    source.delay = std::max(0.0, arrival - (secondsOfNs(logTime) + source.clock.offset()));
  }

  RecordedMessage message;
  if (!source.known->topics.decode(known->second, received.payload, logTime, message)) return;
  double time = secondsOfNs(source.stamps.timeOf(message)) + source.clock.offset();
  if (arrival - time > longDelay) {
    ++source.old;
    time = arrival;
  }
  time = std::clamp(time, 0.0, arrival);

  const RecordedTopic& topic = source.known->topics.topics()[known->second];
  if (m_outputs.decoded) {
    m_outputs.decoded({time, received.arrival, source.source, topic, message});
  }
  source.robots->take(topic, message, time);
  if (source.referee && m_outputs.referee) {
    if (const auto packet = source.referee->packetOf(topic, message)) {
      m_outputs.referee(*packet, received.arrival);
    }
  }
  if (auto line = source.log->lineOf(topic, message, time)) {
    if (m_outputs.log) m_outputs.log(std::move(*line));
    return;
  }
  m_groups->take(source.known->index, topic, message, time, source.source.address.host);
}

void LiveTopics::note(const FoxgloveSource& from, telemetry::FoxgloveClientStatus status) {
  if (Source* source = find(from)) source->client = std::move(status);
}

std::vector<RobotFrame> LiveTopics::robots(double time) const {
  std::vector<RobotFrame> all;
  for (const auto& source : m_sources) {
    for (RobotFrame& robot : source->robots->frames(time, {})) {
      robot.name = groupId(robot.uid, RobotRows::Variables);
      robot.link->rate =
          source->arrivals.rate(m_zero + std::chrono::nanoseconds(std::llround(time * 1e9)));
      if (robot.link->timedOut) robot.link->rate = 0.0;
      robot.link->jitter = source->clock.jitter();
      all.push_back(std::move(robot));
    }
  }
  return all;
}

void LiveTopics::drainRows(const BoardRowsTaker& take) {
  m_robotRows->drain(take);
}

std::vector<MatchEvent> LiveTopics::drainEvents() {
  std::vector<MatchEvent> all;
  for (const auto& source : m_sources) {
    for (MatchEvent& event : source->robots->drainEvents()) all.push_back(std::move(event));
  }
  return all;
}

void LiveTopics::report(WallTime now) {
  for (const TopicSourceStatus& status : this->status(now)) {
    if (status.client.state != telemetry::FoxgloveState::Connected) continue;
    telemetry::GroupInfo group;
    group.name = status.source.address.text() + " link";
    group.columns = sourceColumns();
    const std::vector<double> values{status.rate,
                                     status.delay * 1000.0,
                                     status.jitter * 1000.0,
                                     status.clockOffset,
                                     static_cast<double>(status.client.dropped),
                                     static_cast<double>(status.client.malformed + status.wrong)};
    const auto id = m_outputs.rows.addGroup(group);
    m_outputs.rows.append(id, {std::max(0.0, telemetry::secondsOf(now - m_zero)), {}, values});
  }
}

std::string LiveTopics::sourceOf(RobotUid robot) const {
  for (const auto& source : m_sources) {
    if (!source->robots->sourceOf(robot).empty()) return source->source.address.text();
  }
  return {};
}

std::vector<TopicSourceStatus> LiveTopics::status(WallTime now) const {
  std::vector<TopicSourceStatus> all;
  for (const auto& source : m_sources) {
    TopicSourceStatus& out = all.emplace_back();
    out.source = source->source;
    out.client = source->client;
    out.channels = source->topicOfChannel.size();
    for (const auto& [channel, index] : source->topicOfChannel) {
      const RecordedTopic& topic = source->known->topics.topics()[index];
      if (topic.isUnderstood()) {
        ++out.decoded;
      } else if (topic.isSkipped) {
        ++out.skipped;
      } else if (out.unread.size() < mostReasons) {
        out.unread.push_back(telemetry::printable(topic.name, shownText) + ": " +
                             telemetry::printable(topic.reason, shownText));
      }
    }
    std::ranges::sort(out.unread);
    out.wrong = source->known->topics.wrong() - source->wrongBefore;
    out.old = source->old;
    out.rate = source->arrivals.rate(now);
    out.delay = source->delay;
    out.jitter = source->clock.jitter();
    // The pipeline's zero is a time of day.
    out.clockOffset = source->clock.offset() + secondsOfNs(m_zero.time_since_epoch().count());
    out.restarts = source->restarts + source->clock.restarts();
  }
  return all;
}

void LiveTopics::forget(RobotUid robot) {
  for (const auto& source : m_sources) source->robots->forget(robot);
}

void LiveTopics::clear() {
  for (const auto& source : m_sources) {
    begin(*source);
    source->old = source->restarts = 0;
    source->wrongBefore = source->known->topics.wrong();
  }
}

}  // namespace pitchboard::link
