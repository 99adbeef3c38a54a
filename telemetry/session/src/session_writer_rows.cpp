// SPDX-License-Identifier: GPL-3.0-or-later
// The channels that a group's rows are written to, when they are made, and their summaries.
#include <algorithm>
#include <utility>

#include "session_writer_impl.h"

namespace pitchboard::telemetry {
namespace {

/// Texts that were received can be very many, and a newer channel describes them all.
void forgetTexts(std::vector<ColumnInfo>& columns) {
  for (ColumnInfo& column : columns) {
    if (column.kind == ColumnKind::Text) column.labels.clear();
  }
}

}  // namespace

std::size_t SessionWriter::Impl::indexOf(const GroupInfo& of) {
  const std::string key = of.id.empty() ? "name " + of.name : "id " + of.id;
  const auto [known, isNew] = groupsByKey.try_emplace(key, groups.size());
  if (isNew) groups.emplace_back();
  return known->second;
}

/// Makes a channel for what `group.info` says now, and writes the rows that wait for it.
void SessionWriter::Impl::openChannel(Group& group, double time) {
  const GroupInfo& of = group.info;
  // Two groups may have had one name, one after the other.
  std::string suffix;
  const auto isTaken = [&](const RowChannel& one) { return one.topic == rowTopic(of) + suffix; };
  for (int i = 2; std::ranges::any_of(rowChannels, isTaken); ++i) suffix = std::to_string(i);
  RowChannel channel{.columns = of.columns,
                     .layout = session::RowLayout(of),
                     .topic = rowTopic(of) + suffix,
                     .summary = SummaryBuilder(of)};
  if (!stop && !error && channels < maxChannels) {
    const std::uint16_t schema = addSchema(
        current, {0, session::rowSchemaName(of) + suffix, "ros2msg", session::rowSchema(of)});
    channel.channel =
        addChannel(current, {0,
                             schema,
                             channel.topic,
                             "cdr",
                             {{std::string(session::groupKey), session::groupToJson(of)}}});
  }
  for (const std::size_t before : group.channels) forgetTexts(rowChannels[before].columns);
  group.takes = rowChannels.size();
  group.isDescribed = true;
  group.channels.push_back(rowChannels.size());
  rowChannels.push_back(std::move(channel));
  // Twice as long for columns that keep coming, and soon for a change after a calm time.
  const bool isCalm = !(time - group.openedAt < 2.0 * group.wait);
  group.wait = isCalm ? minWait : std::min(2.0 * group.wait, maxWait);
  group.openedAt = time;
  const std::vector<HeldRow> held = std::exchange(group.held, {});
  const std::size_t values = rowChannels.back().layout.values;
  for (const HeldRow& row : held) {
    heldBytes -= bytesOf(row);
    std::vector<double> all = row.values;
    all.resize(values, std::numeric_limits<double>::quiet_NaN());
    write(group, row.log, row.publish, {row.time, row.words, all});
  }
}

void SessionWriter::Impl::openWhere(const std::function<bool(const Group&)>& wanted) {
  if (stop || error) return;
  for (Group& group : groups) {
    if (!group.channels.empty() && !group.isDescribed && wanted(group)) {
      openChannel(group, group.openedAt + group.wait);
    }
  }
}

bool SessionWriter::Impl::isDue(const Group& group, double time) const {
  const double wait = group.takes ? group.wait : std::min(group.wait, maxHold);
  const bool isLate = time < group.openedAt || time >= group.openedAt + wait;
  return isLate || (!group.held.empty() && heldBytes > options.queueBytes / 4);
}

void SessionWriter::Impl::hold(Group& group, std::uint64_t log, std::uint64_t publish,
                               const RowView& row) {
  group.held.push_back({row.time,
                        log,
                        publish,
                        {row.words.begin(), row.words.end()},
                        {row.values.begin(), row.values.end()}});
  group.heldAt = Clock::now();
  heldBytes += bytesOf(group.held.back());
}

void SessionWriter::Impl::write(Group& group, std::uint64_t log, std::uint64_t publish,
                                const RowView& row) {
  RowChannel& to = rowChannels[*group.takes];
  if (to.channel == 0) {
    ++state.dropped;
    return;
  }
  if (to.layout.isCopied(row)) {
    const auto head = session::RowLayout::headOf(row);
    current.add(McapMessage{to.channel, to.sequence++, log, publish, {head.data(), head.size()}},
                {reinterpret_cast<const char*>(row.values.data()), row.values.size_bytes()});
  } else {
    to.layout.write(current.addMessage(to.channel, to.sequence++, log, publish, to.layout.size),
                    row);
  }
  summarize(group, *group.takes, log, row);
}

void SessionWriter::Impl::summarize(Group& group, std::size_t channel, std::uint64_t log,
                                    const RowView& row) {
  // Buckets of a group's channels do not overlap.
  if (group.last && *group.last != channel) {
    RowChannel& before = rowChannels[*group.last];
    if (const auto part = before.summary.closeBucket()) keep(before, *part);
  }
  group.last = channel;
  RowChannel& to = rowChannels[channel];
  to.lastLog = log;
  const auto start = static_cast<std::uint64_t>(info.start.time_since_epoch().count());
  const double time = static_cast<double>(static_cast<std::int64_t>(log - start)) / 1e9;
  if (const auto part = to.summary.add(time, row)) keep(to, *part);
}

/// A chunk of its own: who draws a whole day reads these chunks and no others.
void SessionWriter::Impl::keep(RowChannel& of, const SummaryPart& part) {
  McapChunk chunk;
  if (of.summaryChannel == 0) {
    of.summaryChannel = addChannel(chunk, {0,
                                           0,
                                           of.topic + "/summary",
                                           std::string(session::summaryEncoding),
                                           {{std::string(session::summaryKey), of.topic}}});
    if (of.summaryChannel == 0) return;
  }
  // Behind its rows: a recording that breaks off has no summary of rows that it does not have.
  closeCurrent();
  const std::string bytes = session::summaryBytes(part);
  chunk.add(McapMessage{of.summaryChannel, of.summaries++, of.lastLog, of.lastLog, bytes});
  waiting += chunk.bytes();
  full.push_back(std::move(chunk));
  wake.notify_one();
}

std::uint16_t SessionWriter::Impl::addSchema(McapChunk& to, McapSchema schema) {
  if (schemas >= maxChannels) return 0;
  schema.id = ++schemas;
  to.add(schema);
  return schema.id;
}

std::uint16_t SessionWriter::Impl::addChannel(McapChunk& to, McapChannel channel) {
  if (channels >= maxChannels) return 0;
  channel.id = ++channels;
  to.add(channel);
  return channel.id;
}

void SessionWriter::Impl::note(std::uint64_t log) {
  if (!firstLog) firstLog = log;
  lastLog = std::max(lastLog, log);
  state.seconds = static_cast<double>(lastLog - *firstLog) * 1e-9;
  if (openBytes() < options.chunkBytes) return;
  closeCurrent();
  wake.notify_one();
}

}  // namespace pitchboard::telemetry
