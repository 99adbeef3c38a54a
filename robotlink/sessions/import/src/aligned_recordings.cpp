// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/import/aligned_recordings.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

#include <base/try.h>
#include <robotlink/import/opened_recordings.h>
#include <robotlink/live/topic_meanings.h>
#include <telemetry/referee/gamecontroller.h>
#include <telemetry/session/session_types.h>

namespace pitchboard::link {
namespace {

using telemetry::RecordedItem;

// Keys of SessionInfo::more.
const std::string alignedByKey = "aligned_by", offsetKey = "offset.", byHand = "hand";
constexpr std::uint64_t itemsBetweenQuestions = 1000;

/// How far a match is: kick-offs at the same stage are the same one.
struct Stage {
  std::size_t period = 0;  ///< as Game::period(); after the last one in a shoot-out
  int goals = 0;           ///< of both teams
  auto operator<=>(const Stage&) const = default;
};

Stage stageOf(const Game& game) {
  return {game.period().value_or(game.teams.front().byHalf.size()),
          game.teams[0].score + game.teams[1].score};
}

struct FoundEvent {
  std::int64_t time = 0;  ///< ns, without an offset
  Stage stage;
};

PlayState stateOf(AlignEvent event) {
  return event == AlignEvent::Set ? PlayState::Set : PlayState::Playing;
}

std::string textOf(AlignEvent event) {
  return event == AlignEvent::Set ? "beginning of SET" : "kick-off";
}

/// Looks for the event in one recording, from its beginning.
class EventSearch {
 public:
  static Result<EventSearch> open(const std::string& file, const TopicMapping& mapping,
                                  AlignEvent event, std::function<bool()> goesOn) {
    EventSearch search(event, std::move(goesOn));
    if (mapping.referee) search.m_referee.emplace(*mapping.referee);
    search.m_sources = TRY(openTogether({file}, mapping.recordings));
    for (OpenedRecording& source : search.m_sources) {
      search.m_file = source.timing.file;
      source.timing.offset = 0.0;
      TRY(source.step());
    }
    TRY(search.next());
    return search;
  }

  const std::string& file() const { return m_file; }
  const FoundEvent& found() const { return m_found; }

  /// Moves to the next time that the event happens.
  Result<void> next() {
    while (OpenedRecording* source = earliestOf(m_sources)) {
      if (++m_items % itemsBetweenQuestions == 0 && m_goesOn && !m_goesOn()) {
        return failure(ErrorCode::Conflict, "Reading was stopped.");
      }
      const std::int64_t time = source->time;
      const auto game = gameIn(*source);
      TRY(source->step());
      if (!game) continue;
      const auto before = std::exchange(m_state, game->state);
      if (!before || *before == game->state || game->state != stateOf(m_event)) continue;
      m_found = {time, stageOf(*game)};
      return {};
    }
    return notFound();
  }

 private:
  EventSearch(AlignEvent event, std::function<bool()> goesOn)
      : m_event(event), m_goesOn(std::move(goesOn)) {}

  std::optional<Game> gameIn(const OpenedRecording& source) {
    if (source.item == RecordedItem::Datagram) return gameIn(source.reader->datagram().payload);
    if (!m_referee) return {};
    const auto& message = source.reader->message();
    const auto packet = m_referee->packetOf(source.reader->topics()[message.topic], message);
    return packet ? gameIn(*packet) : std::nullopt;
  }
  static std::optional<Game> gameIn(std::string_view packet) {
    const auto decoded = telemetry::decodeReferee(packet);
    const auto* state = decoded ? std::get_if<telemetry::RefereeState>(&*decoded) : nullptr;
    if (state == nullptr || state->trueData()) return {};
    return gameOf(*state);
  }

  Result<void> notFound() const {
    const std::string orByHand =
        ", or move the recording by hand (\"Map topics…\" in the studio, \"recordings\" in a "
        "mapping).";
    if (!m_state) {
      return failure(ErrorCode::NotFound,
                     "There is no state of the game in it, so its " + textOf(m_event) +
                         " is unknown. Name the topic of its referee in the mapping (\"referee\")" +
                         orByHand,
                     m_file);
    }
    return failure(ErrorCode::NotFound,
                   "It has no " + textOf(m_event) + " that the others have: its last state is " +
                       std::string(labelOf(*m_state)) + ". Choose another event" + orByHand,
                   m_file);
  }

  AlignEvent m_event;
  std::function<bool()> m_goesOn;
  std::optional<TopicReferee> m_referee;
  std::vector<OpenedRecording> m_sources;
  std::string m_file;
  std::optional<PlayState> m_state;  ///< of the last message that has one
  FoundEvent m_found;
  std::uint64_t m_items = 0;
};

/// Moves each search to the first event that all have at the same stage.
Result<void> findInAll(std::vector<EventSearch>& searches) {
  const auto stage = [](const EventSearch& search) { return search.found().stage; };
  for (;;) {
    const Stage last = stage(*std::ranges::max_element(searches, {}, stage));
    bool isSame = true;
    for (EventSearch& search : searches) {
      while (stage(search) < last) TRY(search.next());
      isSame = isSame && stage(search) == last;
    }
    if (isSame) return {};
  }
}

MappedRecording* recordingOf(TopicMapping& mapping, const std::string& file) {
  const auto known = std::ranges::find(mapping.recordings, file, &MappedRecording::file);
  return known == mapping.recordings.end() ? nullptr : &*known;
}

/// To a microsecond, which the text of a mapping keeps exactly.
double secondsBetween(std::int64_t from, std::int64_t to) {
  return std::round(static_cast<double>(to - from) / 1e3) / 1e6;
}

}  // namespace

Result<void> nameRecordings(const std::vector<std::string>& files, TopicMapping& mapping) {
  std::set<std::string> names;
  for (const std::string& file : files) {
    std::string name = fileNameOf(file);
    if (!names.insert(name).second) {
      return failure(ErrorCode::Conflict,
                     "Two of the recordings have this name, and a mapping tells recordings apart "
                     "by their names. Rename one of them.",
                     name);
    }
    if (recordingOf(mapping, name) == nullptr) {
      mapping.recordings.push_back({std::move(name), RecordingClock::Auto, 0.0});
    }
  }
  return {};
}

Result<void> alignRecordings(const std::vector<std::string>& files, AlignEvent event,
                             TopicMapping& mapping, const std::function<bool()>& goesOn) {
  if (files.size() < 2) {
    return failure(ErrorCode::InvalidArgument,
                   "One recording has nothing to be aligned with. Name the others, too.");
  }
  std::vector<EventSearch> searches;
  for (const std::string& file : files) {
    searches.push_back(TRY(EventSearch::open(file, mapping, event, goesOn)));
  }
  TRY(findInAll(searches));
  const std::int64_t common = searches.front().found().time;
  for (const EventSearch& search : searches) {
    recordingOf(mapping, search.file())->offset = secondsBetween(search.found().time, common);
  }
  mapping.alignedBy = event;
  return {};
}

void keepAlignment(const TopicMapping& mapping, telemetry::SessionInfo& info) {
  bool isMoved = mapping.alignedBy.has_value();
  for (const MappedRecording& one : mapping.recordings) isMoved = isMoved || one.offset != 0.0;
  if (!isMoved) return;
  info.more[alignedByKey] = mapping.alignedBy ? std::string(nameOf(*mapping.alignedBy)) : byHand;
  for (const MappedRecording& one : mapping.recordings) {
    char seconds[40];
    std::snprintf(seconds, sizeof seconds, "%.6f", one.offset);
    info.more[offsetKey + one.file] = seconds;
  }
}

std::optional<std::string> alignmentText(const telemetry::SessionInfo& info) {
  const auto by = info.more.find(alignedByKey);
  if (by == info.more.end()) return {};
  std::string text = "aligned by " + by->second;
  std::string_view between = ": ";
  for (const auto& [key, value] : info.more) {
    if (!key.starts_with(offsetKey)) continue;
    char seconds[40];
    std::snprintf(seconds, sizeof seconds, " %+.3f s", std::strtod(value.c_str(), nullptr));
    text += std::string(std::exchange(between, ", ")) + key.substr(offsetKey.size()) + seconds;
  }
  return text;
}

}  // namespace pitchboard::link
