// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a SessionReader knows of its file. Private to session_reader.cpp and session_walk.cpp.

#include <algorithm>
#include <list>
#include <map>
#include <set>

#include <telemetry/mcap/mcap_cursor.h>
#include <telemetry/series/column_merge.h>
#include <telemetry/session/session_reader.h>

#include "session_format.h"
#include "time_order.h"

namespace pitchboard::telemetry {

struct SessionReader::Impl {
  static constexpr std::size_t maxNotes = 200;
  static constexpr int noGroup = -1;

  McapReader file;
  SessionInfo info;
  bool described = false;                ///< by metadata of ours that are whole
  std::vector<SessionEvent> addedNotes;  ///< of the file beside it
  std::vector<SessionGroup> groups;
  std::vector<session::RowLayout> layouts;  ///< of the channels with rows
  std::vector<RowMap> maps;                 ///< of each layout: to all columns of its group
  struct Use {
    int group = noGroup;
    std::size_t layout = 0;
    SessionStream stream = SessionStream::Events;
  };
  std::vector<std::uint16_t> otherChannels;  ///< of the file that are not in our format
  std::vector<Use> useOfChannel;  ///< by channel id, up to the highest that the file declares
  /// Of each group: the channels of its summary, and the layout whose columns they have.
  std::map<GroupId, std::map<std::uint16_t, std::size_t>> summaryChannels;
  std::array<std::vector<std::uint16_t>, sessionStreamCount> channelsOfStream;
  /// Chunks by their start, and the latest end among the first n.
  std::vector<std::size_t> byStart;
  std::vector<std::uint64_t> latestEnd;

  mutable std::vector<std::string> notes;
  mutable std::set<std::size_t> damaged;
  mutable std::vector<McapLoss> losses;
  mutable bool damagedAttachment = false;
  mutable std::vector<std::uint32_t> ownWords;  ///< of a row before it is converted
  mutable std::vector<double> ownValues;
  mutable std::vector<bool> seen;  ///< of the chunks: their body was asked for
  struct Kept {
    std::size_t chunk = 0;
    std::shared_ptr<std::string> body;
  };
  mutable std::list<Kept> kept;  ///< newest first
  /// Of a recording that broke off, by group: summaries of the rows behind those in the file.
  mutable std::vector<std::vector<SummaryPart>> rest;

  explicit Impl(McapReader f) : file(std::move(f)) {}

  /// A damaged file holds messages of channels that it does not declare.
  Use useOf(std::uint16_t channel) const {
    return channel < useOfChannel.size() ? useOfChannel[channel] : Use{};
  }
  /// False: the message is no row of its channel.
  bool readRow(Use use, std::string_view data, SessionRow& row) const;
  void addGroup(GroupInfo group, std::uint64_t rows, std::uint16_t channel);
  void mapRows();

  void note(std::string sentence) const {
    if (notes.size() < maxNotes) notes.push_back(std::move(sentence));
  }
  GroupSummary writtenSummary(GroupId group, const std::function<bool()>& goOn) const;
  bool summarizeRest(const SessionReader& session, const std::function<bool()>& goOn) const;
  void takeNotes(const std::string& path);
  void takeMetadata();
  void takeChannels();
  void takeFacts();
  void takeSummaries();
  void takeChunks();
  void findStart();
  void noteLosses();
  void noteOthers(bool isForeign);
  std::shared_ptr<const std::string> hold(std::size_t chunk) const;
  std::string_view body(std::size_t chunk) const;
  /// `wanted` in order. False: the visitor or the progress said so.
  bool walk(std::uint64_t begin, std::uint64_t end, const std::vector<std::uint16_t>& wanted,
            const std::function<bool(const SessionItem&)>& visit,
            const std::function<bool(double)>& progress) const;
  TimeOrder inOrder() const;
  std::vector<std::uint16_t> channelsOf(std::span<const GroupId> wanted,
                                        std::span<const SessionStream> streams) const;
  static bool mayHold(const McapChunkInfo& chunk, std::uint16_t channel) {
    return chunk.channels.empty() ||
           std::binary_search(chunk.channels.begin(), chunk.channels.end(), channel);
  }
  /// The session's time of a row or message that says `source` of itself.
  static double time(double source, const McapMessage& message) {
    if (message.logTime == message.publishTime) return source;
    return source +
           static_cast<double>(static_cast<std::int64_t>(message.logTime - message.publishTime)) /
               1e9;
  }
};

}  // namespace pitchboard::telemetry
