// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/game_state.h>

namespace pitchboard::sim {
namespace {

template <class Enum, std::size_t N>
std::string_view at(const std::array<std::string_view, N>& label, Enum value) {
  static_assert(static_cast<std::size_t>(lastOf(Enum{})) + 1 == N);
  return label[static_cast<std::size_t>(value)];
}

}  // namespace

std::string_view labelOf(PlayState state) {
  static constexpr std::array<std::string_view, 5> label{"INITIAL", "READY", "SET", "PLAYING",
                                                         "FINISHED"};
  return at(label, state);
}

std::string_view labelOf(GamePhase phase) {
  static constexpr std::array<std::string_view, 4> label{"normal time", "penalty shoot-out",
                                                         "overtime", "timeout"};
  return at(label, phase);
}

std::string_view labelOf(SetPlay play) {
  static constexpr std::array<std::string_view, 7> label{
      "",         "direct free kick", "indirect free kick", "penalty kick",
      "throw-in", "goal kick",        "corner kick"};
  return at(label, play);
}

std::string_view labelOf(PenaltyKind penalty) {
  static constexpr std::array<std::string_view, 18> label{"",
                                                          "ball manipulation",
                                                          "pushing",
                                                          "illegal attack",
                                                          "illegal defence",
                                                          "pickup or incapable",
                                                          "service",
                                                          "illegal position",
                                                          "motion in SET",
                                                          "motion while stopped",
                                                          "local game stuck",
                                                          "ball holding",
                                                          "leaving the field",
                                                          "playing with the hands",
                                                          "cautioned",
                                                          "sent off",
                                                          "substitute",
                                                          "manual penalty"};
  return at(label, penalty);
}

}  // namespace pitchboard::sim
