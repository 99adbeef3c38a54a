// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/session_events.h>

#include <string_view>

#include <robotlink/session/session_choice.h>

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

TeamColor colourNamed(std::string_view name) {
  for (const TeamColorInfo& one : refereeColors) {
    if (one.name == name) return one.color;
  }
  return teamColorNamed(name).value_or(TeamColor::Unknown);
}

std::optional<PlayState> stateNamed(std::string_view name) {
  for (int i = 0; i <= static_cast<int>(PlayState::Unknown); ++i) {
    if (labelOf(static_cast<PlayState>(i)) == name) return static_cast<PlayState>(i);
  }
  return {};
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
  facts.robot = event.robot;
  if (event.side) facts.side = sideName(*event.side);
  facts.team = event.team;
  if (event.colour) facts.colour = info(*event.colour).name;
  facts.teamName = event.teamName;
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
  out.robot = facts.robot;
  out.side = sideNamed(facts.side);
  out.team = facts.team;
  if (!facts.colour.empty()) out.colour = colourNamed(facts.colour);
  out.teamName = facts.teamName;
  out.value = facts.value;
  if (facts.score) out.score = sim::Score{facts.score->first, facts.score->second};
  out.process = facts.process;
  out.cause = static_cast<std::uint32_t>(facts.cause);
  if (matchEventKind(event.kind)) out.detail = facts.detail;
  if (out.kind == Kind::GameState) out.state = stateNamed(facts.detail);
  return out;
}

std::vector<MatchEvent> eventsOf(const telemetry::SessionReader& session) {
  std::vector<MatchEvent> events;
  for (const telemetry::SessionEvent& event : session.events()) {
    MatchEvent& made = events.emplace_back(matchEvent(event));
    if (made.robot == RobotUid{} && !made.name.empty()) made.robot = robotNamed(session, made.name);
  }
  dropUndone(events);
  return events;
}

}  // namespace pitchboard::link
