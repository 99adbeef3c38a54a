// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/session_events.h>

#include <charconv>
#include <map>
#include <string_view>

#include <robotlink/session/row_slot.h>

namespace pitchboard::link {
namespace {

using Kind = MatchEventKind;

MatchEvent begun(const telemetry::SessionEvent& event) {
  MatchEvent out;
  out.time = event.time;
  out.name = event.group;
  if (const auto kind = matchEventKind(event.kind)) {
    out.kind = *kind;
  } else {
    out.detail = event.kind + (event.text.empty() ? "" : ": " + event.text);
  }
  return out;
}

/// What stands behind this, or nothing when the text does not begin so.
std::optional<std::string_view> behind(std::string_view text, std::string_view start) {
  if (!text.starts_with(start)) return {};
  return text.substr(start.size());
}

// Before 0.2 a process had one kind of event, and the words told which: "B1 decision started
// (process 71)", "B1 decision ended: exit code 0", "B1 decision died: exit code 2". The studio
// wrote "B1 decision" as the group and, of those that died, only how.
void readOldProcess(MatchEvent& out, std::string_view text) {
  struct Word {
    std::string_view word;
    Kind kind;
  };
  constexpr Word words[] = {{" started", Kind::ProcessStarted},
                            {" ended: ", Kind::ProcessEnded},
                            {" died: ", Kind::ProcessDied}};
  if (const auto space = out.name.find(' '); space != std::string::npos) {
    out.process = out.name.substr(space + 1);
    out.name.resize(space);
  }
  out.kind = Kind::ProcessDied;
  out.detail = text;
  for (const Word& word : words) {
    const auto at = text.find(word.word);
    if (at == std::string_view::npos) continue;
    out.kind = word.kind;
    out.detail = text.substr(at + word.word.size());
    const std::string_view who = text.substr(0, at);
    if (out.process.empty()) out.process = behind(who, out.name + ' ').value_or(who);
    break;
  }
  if (out.kind != Kind::ProcessStarted) return;
  if (const auto number = behind(out.detail, " (process ")) {
    int pid = 0;
    if (std::from_chars(number->data(), number->data() + number->size(), pid).ec == std::errc()) {
      out.value = pid;
    }
  }
  out.detail.clear();
}

/// The only place that reads words: of events that were recorded before 0.2.
MatchEvent fromOldForm(const telemetry::SessionEvent& event) {
  if (event.kind == "process") {
    MatchEvent out = begun({event.time, {}, event.group, {}});
    readOldProcess(out, event.text);
    return out;
  }
  MatchEvent out = begun(event);
  const std::string_view text = event.text;
  switch (out.kind) {
    case Kind::Goal:
      // The recorder's sentence, or the team's name as the studio saved it.
      if (text.find("left") != std::string_view::npos) {
        out.side = Side::Left;
      } else if (text.find("right") != std::string_view::npos) {
        out.side = Side::Right;
      }
      for (const TeamColorInfo& team : teamColors) {
        std::string name(team.name);
        for (char& c : name) c = static_cast<char>(c - 'a' + 'A');
        if (out.name == name) out.colour = team.name;
      }
      out.name.clear();
      break;
    case Kind::Kick:
      out.detail = behind(text, out.name + ": ").value_or(std::string_view());
      break;
    case Kind::UnknownAction:
      if (const auto code = behind(text, out.name + ": unknown action ")) {
        int value = 0;
        if (std::from_chars(code->data(), code->data() + code->size(), value).ec == std::errc()) {
          out.value = value;
        }
      }
      break;
    case Kind::GameState:
      out.detail = behind(text, "referee: ").value_or(text);
      break;
    case Kind::Other:
      if (event.kind != info(Kind::Other).name) break;
      if (const auto penalty = behind(text, "penalised: ")) {
        out.kind = Kind::Penalised;
        out.detail = *penalty;
      } else {
        out.detail = text;
      }
      break;
    case Kind::Bookmark:
      out.detail = text;
      break;
    default:
      break;  // the kind says it all
  }
  return out;
}

}  // namespace

telemetry::SessionEvent sessionEvent(const MatchEvent& event) {
  telemetry::SessionEvent out{event.time, std::string(info(event.kind).name), event.name,
                              event.kind == Kind::Bookmark ? event.detail : sentenceOf(event)};
  telemetry::EventFacts& facts = out.facts.emplace();
  facts.robot = event.robot.number;
  facts.robotTeam = event.robot.team;
  facts.sender = event.robot.sender;
  if (event.side) facts.side = sideName(*event.side);
  facts.team = event.team;
  facts.colour = event.colour;
  facts.value = event.value;
  if (event.score) facts.score.emplace(event.score->left, event.score->right);
  facts.process = event.process;
  facts.detail = event.detail;
  return out;
}

MatchEvent matchEvent(const telemetry::SessionEvent& event) {
  if (!event.facts) return fromOldForm(event);
  const telemetry::EventFacts& facts = *event.facts;
  MatchEvent out = begun(event);
  if (facts.robotTeam) out.robot = {*facts.robotTeam, facts.robot, facts.sender};
  out.side = sideNamed(facts.side);
  out.team = facts.team;
  out.colour = facts.colour;
  out.value = facts.value;
  if (facts.score) out.score = sim::Score{facts.score->first, facts.score->second};
  out.process = facts.process;
  if (matchEventKind(event.kind)) out.detail = facts.detail;
  return out;
}

std::vector<MatchEvent> eventsOf(const telemetry::SessionReader& session) {
  // Until 0.8 an event had the number of a simulated robot's blackboard or of a live robot's port.
  std::map<std::string, RobotKey> simulated;
  bool hasTeams = false;
  for (const telemetry::SessionGroup& group : session.groups()) {
    const bool isLive = attribute(group.info, "live") == "1";
    hasTeams = hasTeams || (isLive && !attribute(group.info, "shirt").empty());
    if (isLive || attributeNumber(group.info, "robot") == 0) continue;
    simulated[group.info.name] = {static_cast<int>(teamOf(group.info)) + 1,
                                  attributeNumber(group.info, "number"), 0};
  }
  std::vector<MatchEvent> events;
  for (const telemetry::SessionEvent& event : session.events()) {
    MatchEvent& made = events.emplace_back(matchEvent(event));
    if (made.robot.number != 0) continue;
    if (const auto known = simulated.find(made.name); known != simulated.end()) {
      made.robot = known->second;
    } else if (event.facts) {
      made.robot = keyOfOldId(event.facts->robot, hasTeams);
    }
  }
  return events;
}

}  // namespace pitchboard::link
