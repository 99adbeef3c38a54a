// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/session_events.h>

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

/// Of another program: its words are all that there is.
MatchEvent wordsOnly(const telemetry::SessionEvent& event) {
  MatchEvent out = begun(event);
  if (matchEventKind(event.kind)) out.detail = event.text;
  return out;
}

}  // namespace

telemetry::SessionEvent sessionEvent(const MatchEvent& event) {
  telemetry::SessionEvent out{event.time, std::string(info(event.kind).name), event.name,
                              event.kind == Kind::Bookmark ? event.detail : sentenceOf(event)};
  telemetry::EventFacts& facts = out.facts.emplace();
  facts.robot = event.robot.value;
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
  if (!event.facts) return wordsOnly(event);
  const telemetry::EventFacts& facts = *event.facts;
  MatchEvent out = begun(event);
  out.robot.value = facts.robot;
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
  std::map<std::string, int> numbers;
  for (const telemetry::SessionGroup& group : session.groups()) {
    if (const int number = attributeNumber(group.info, "robot"); number != 0) {
      numbers[group.info.name] = number;
    }
  }
  std::vector<MatchEvent> events;
  for (const telemetry::SessionEvent& event : session.events()) {
    events.push_back(matchEvent(event));
    MatchEvent& made = events.back();
    if (made.robot.value != 0) continue;
    if (const auto known = numbers.find(made.name); known != numbers.end()) {
      made.robot.value = known->second;
    }
  }
  return events;
}

}  // namespace pitchboard::link
