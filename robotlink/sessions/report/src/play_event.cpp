// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/report/play_event.h>

#include <array>
#include <cmath>

#include <base/duration_text.h>
#include <robotlink/report/report_page.h>

namespace pitchboard::link {
namespace {

struct PlayKindNames {
  std::string_view name, label;
};
constexpr std::array<PlayKindNames, playKindCount> playKinds{{{"goal", "goal"},
                                                              {"shot", "shot"},
                                                              {"pass", "pass"},
                                                              {"ball-won", "ball won"},
                                                              {"set-play", "set play"},
                                                              {"penalty", "penalty"},
                                                              {"offline", "offline"}}};
constexpr std::array<std::string_view, playOutcomeCount> playOutcomes{
    "",     "completed", "intercepted", "out",  "goal",   "saved",
    "wide", "shot",      "kept",        "lost", "goes-on"};

std::string metres(const PlayEvent& event) {
  if (!event.from || !event.to) return {};
  return " (" + fixed(distance(*event.from, *event.to), 1) + " m)";
}

std::string by(const PlayEvent& event, std::string_view word) {
  return event.otherName.empty() ? "" : std::string(word) + event.otherName;
}

std::string passText(const PlayEvent& e) {
  if (e.outcome == PlayOutcome::Completed) return e.name + " passes to " + e.otherName + metres(e);
  if (e.outcome == PlayOutcome::Out) return e.name + " kicks the ball out" + metres(e);
  return e.otherName + " intercepts a pass of " + e.name + metres(e);
}

std::string setPlayText(const PlayEvent& e) {
  std::string text = e.detail + " for " + std::string(info(e.team).name);
  if (!e.name.empty()) text += ", taken by " + e.name;
  return e.outcome == PlayOutcome::GoesOn ? text : text + ": " + std::string(labelOf(e.outcome));
}

}  // namespace

std::string_view nameOf(PlayKind kind) {
  return playKinds[static_cast<std::size_t>(kind)].name;
}

std::string_view labelOf(PlayKind kind) {
  return playKinds[static_cast<std::size_t>(kind)].label;
}

std::string_view nameOf(PlayOutcome outcome) {
  return playOutcomes[static_cast<std::size_t>(outcome)];
}

std::string_view labelOf(PlayOutcome outcome) {
  static constexpr std::array<std::string_view, playOutcomeCount> labels{
      "",     "completed", "intercepted",   "play was stopped", "goal",   "saved",
      "wide", "a shot",    "kept the ball", "lost the ball",    "goes on"};
  return labels[static_cast<std::size_t>(outcome)];
}

std::string sentenceOf(const PlayEvent& e) {
  const auto lasts = [&e](std::string text) {
    if (e.outcome == PlayOutcome::GoesOn) return text + ", not back";
    return text + ", " + durationText(e.end - e.time);
  };
  switch (e.kind) {
    case PlayKind::Goal:
      return "goal for " + std::string(info(e.team).name) +
             (e.name.empty() ? "" : ", last touched by " + e.name);
    case PlayKind::Shot:
      return e.name + " shoots: " +
             (e.outcome == PlayOutcome::Saved && e.otherName.empty()
                  ? "stopped"
                  : std::string(nameOf(e.outcome))) +
             (e.outcome == PlayOutcome::Saved ? by(e, " by ") : "");
    case PlayKind::Pass:
      return passText(e);
    case PlayKind::BallWon:
      return e.name + " wins the ball" + by(e, " from ");
    case PlayKind::SetPlay:
      return setPlayText(e);
    case PlayKind::Penalty:
      return lasts(e.name + " is penalised" + (e.detail.empty() ? "" : ": " + e.detail));
    case PlayKind::Offline:
      return lasts(e.name + " is offline");
  }
  return {};
}

std::string playCsv(const std::vector<PlayEvent>& events) {
  std::string out = "time,end,kind,outcome,team,robot,other,x,y,to_x,to_y,sigma,detail\n";
  const auto place = [](const std::optional<Point>& at) {
    return at ? fixed(at->x, 3) + ',' + fixed(at->y, 3) : std::string(",");
  };
  for (const PlayEvent& e : events) {
    out += fixed(e.time, 3) + ',' + fixed(e.end, 3) + ',' + std::string(nameOf(e.kind)) + ',' +
           std::string(nameOf(e.outcome)) + ',' + std::string(info(e.team).name) + ',' + e.name +
           ',' + e.otherName + ',' + place(e.from) + ',' + place(e.to) + ',' + fixed(e.sigma, 3) +
           ',' + e.detail + '\n';
  }
  return out;
}

}  // namespace pitchboard::link
