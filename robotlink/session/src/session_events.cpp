// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/session_events.h>

#include <map>
#include <string_view>

#include <robotlink/frame/teams.h>
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

/// Of another program: its words are all that there is.
MatchEvent textOnlyEvent(const telemetry::SessionEvent& event) {
  MatchEvent out = begun(event);
  if (matchEventKind(event.kind)) out.detail = event.text;
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
  facts.cause = static_cast<int>(event.cause);
  return out;
}

MatchEvent matchEvent(const telemetry::SessionEvent& event) {
  if (!event.facts) return textOnlyEvent(event);
  const telemetry::EventFacts& facts = *event.facts;
  MatchEvent out = begun(event);
  if (facts.robotTeam) out.robot = {*facts.robotTeam, facts.robot, facts.sender};
  out.side = sideNamed(facts.side);
  out.team = facts.team;
  out.colour = facts.colour;
  out.value = facts.value;
  if (facts.score) out.score = sim::Score{facts.score->first, facts.score->second};
  out.process = facts.process;
  out.cause = static_cast<std::uint32_t>(facts.cause);
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
  dropUndone(events);
  return events;
}

}  // namespace pitchboard::link
