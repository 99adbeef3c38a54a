// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/game.h>

namespace pitchboard {
namespace {

/// `last`: the last value of the enumeration.
template <auto last, std::size_t N>
std::string_view at(const std::array<std::string_view, N>& label, decltype(last) value) {
  static_assert(static_cast<std::size_t>(last) + 1 == N);
  return label[static_cast<std::size_t>(value)];
}

struct PenaltyRow {
  PenaltyKind kind;
  std::string_view label;
  PenaltyKind simulated;
};
using Kind = PenaltyKind;
constexpr PenaltyRow penalties[] = {
    {Kind::None, "", Kind::None},
    {Kind::BallManipulation, "ball manipulation", Kind::BallManipulation},
    {Kind::Pushing, "pushing", Kind::Pushing},
    {Kind::IllegalAttack, "illegal attack", Kind::IllegalAttack},
    {Kind::IllegalDefence, "illegal defence", Kind::IllegalDefence},
    {Kind::Incapable, "pickup or incapable", Kind::Incapable},
    {Kind::Service, "service", Kind::Service},
    {Kind::IllegalPosition, "illegal position", Kind::IllegalPosition},
    {Kind::MotionInSet, "motion in SET", Kind::MotionInSet},
    {Kind::MotionInStop, "motion while stopped", Kind::MotionInStop},
    {Kind::LocalStuck, "local game stuck", Kind::LocalStuck},
    {Kind::Holding, "ball holding", Kind::Holding},
    {Kind::Leaving, "leaving the field", Kind::Leaving},
    {Kind::Hands, "playing with the hands", Kind::Hands},
    {Kind::Cautioned, "cautioned", Kind::Cautioned},
    {Kind::SentOff, "sent off", Kind::SentOff},
    {Kind::Substitute, "substitute", Kind::Substitute},
    {Kind::Manual, "manual penalty", Kind::Manual},
    {Kind::PickUp, "pickup", Kind::Service},
    {Kind::PickUpToService, "pickup to service", Kind::Service},
    {Kind::IncapableRobot, "incapable", Kind::Incapable},
    {Kind::BallContact, "ball contact", Kind::BallManipulation},
    {Kind::Inactive, "inactive", Kind::Incapable},
    {Kind::IllegalDefender, "illegal defender", Kind::IllegalDefence},
    {Kind::KickOffGoal, "kick-off goal", Kind::Manual},
    {Kind::CoachMotion, "coach motion", Kind::Manual},
    {Kind::IllegalPositionInSet, "illegal position in SET", Kind::IllegalPosition},
    {Kind::Stance, "stance", Kind::Manual},
    {Kind::MotionInInitial, "motion in INITIAL or STANDBY", Kind::MotionInSet},
    {Kind::Unknown, "unknown penalty", Kind::Manual},
};
constexpr bool inOrder() {
  for (std::size_t i = 0; i < std::size(penalties); ++i) {
    if (penalties[i].kind != static_cast<Kind>(i)) return false;
  }
  return std::size(penalties) == static_cast<std::size_t>(Kind::Unknown) + 1;
}
static_assert(inOrder());

}  // namespace

SetPlay simulated(SetPlay play) {
  switch (play) {
    case SetPlay::PushingFreeKick:
      return SetPlay::DirectFreeKick;
    case SetPlay::KickIn:
      return SetPlay::ThrowIn;
    case SetPlay::Unknown:
      return SetPlay::None;
    default:
      return play;
  }
}

PenaltyKind simulated(PenaltyKind penalty) {
  return penalties[static_cast<std::size_t>(penalty)].simulated;
}

std::string_view labelOf(PlayState state) {
  static constexpr std::array<std::string_view, 7> label{"INITIAL",  "READY",   "SET",    "PLAYING",
                                                         "FINISHED", "STANDBY", "UNKNOWN"};
  return at<PlayState::Unknown>(label, state);
}

std::string_view labelOf(GamePhase phase) {
  static constexpr std::array<std::string_view, 5> label{"normal time", "penalty shoot-out",
                                                         "overtime", "timeout", "unknown"};
  return at<GamePhase::Unknown>(label, phase);
}

std::string_view labelOf(SetPlay play) {
  static constexpr std::array<std::string_view, 10> label{
      "",          "direct free kick", "indirect free kick", "penalty kick", "throw-in",
      "goal kick", "corner kick",      "pushing free kick",  "kick-in",      "unknown"};
  return at<SetPlay::Unknown>(label, play);
}

std::string_view labelOf(PenaltyKind penalty) {
  return penalties[static_cast<std::size_t>(penalty)].label;
}

std::string_view labelOf(Restart::Step step) {
  static constexpr std::array<std::string_view, 5> label{"", "stop", "prepare", "ready", ""};
  return at<Restart::Step::Executed>(label, step);
}

std::string_view labelOf(CountdownTo countdown) {
  static constexpr std::array<std::string_view, 6> label{"",      "set",       "ball free",
                                                         "ready", "next half", "timeout over"};
  return at<CountdownTo::TimeoutOver>(label, countdown);
}

}  // namespace pitchboard
