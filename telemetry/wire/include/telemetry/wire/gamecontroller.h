// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the referee's program (GameController) broadcasts: every version of the Humanoid League, the
// Standard Platform League and the Humanoid Soccer League since 2013, in one value. The layouts are
// data (src/gamecontroller_layouts.cpp); a new version is a new row there.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include <base/result.h>

namespace pitchboard::telemetry {

/// Who wrote the packet; decides what the codes of penalties and set plays mean.
enum class League : std::uint8_t {
  Humanoid,          ///< HL: v7, v8, v9, v11 (592 bytes), v12 (640 and 688)
  StandardPlatform,  ///< SPL: v10, v11 (58), v12 (54) ... v18
  HumanoidSoccer     ///< HSL since 2026: v19, v20
};

/// One slot of a team. Codes as sent; words by penaltyName() and penaltyWords().
struct RefereePlayer {
  int number = 0;  ///< slot, from 1
  int penalty = 0;
  int secondsLeft = 0;  ///< as sent: some versions do not count down
  std::optional<int> warnings, yellow, red, cautions, goalkeeper;
  /// The 2013 program writes other things over these bytes; penalty and secondsLeft are not what it
  /// sent but those of an unused slot.
  bool unreliable = false;
  bool operator==(const RefereePlayer&) const = default;
};

struct RefereeTeam {
  static constexpr std::size_t maxPlayers = 20;
  int number = 0;  ///< identifies a team; its place in the packet is its side of the field
  int colour = 0;  ///< see colourWords()
  int score = 0;
  std::optional<int> goalColour;   ///< v7
  std::optional<int> penaltyShot;  ///< penalty shots taken
  std::optional<int> singleShots;  ///< one bit per penalty shot, set if it scored
  std::optional<int> messageBudget;
  std::optional<int> goalkeeperColour, goalkeeper;
  std::array<RefereePlayer, maxPlayers> allSlots{};
  std::size_t slotCount = 0;
  std::span<const RefereePlayer> players() const { return {allSlots.data(), slotCount}; }
  bool operator==(const RefereeTeam&) const = default;
};

/// Bytes 107-115 of the program of 2013 (v7), which are not players.
struct RefereeExtra2013 {
  int timeOut = 0;
  std::array<int, 2> penaltyShot{};
  std::array<int, 2> penaltyTries{};
  int subTime = 0;
  bool operator==(const RefereeExtra2013&) const = default;
};

/// One referee packet. An optional is empty when the version does not have the field. Times in
/// seconds, as sent, negative in extra time.
struct RefereeState {
  std::array<char, 4> magic{'R', 'G', 'm', 'e'};
  int version = 0;
  int size = 0;  ///< bytes of the packet
  League league = League::Humanoid;
  int playersPerTeam = 0;
  int state = 0;       ///< 0 INITIAL ... see stateName()
  int firstHalf = 0;   ///< 1 in the first half
  int kickOffRaw = 0;  ///< as sent: a colour in v7 and v8, then a team number
  int secsRemaining = 0;
  std::optional<int> kickOffTeam;  ///< number of the team; empty: drop ball or nobody
  std::optional<int> packetNumber, secondaryTime;
  std::optional<int> gameType;  ///< HL and SPL 2017
  std::optional<int> secState;  ///< secondary state, HL
  std::optional<std::array<int, 4>> secStateInfo;
  std::optional<int> gamePhase, setPlay, competitionPhase, competitionType, stopped;
  std::optional<int> dropInTeam, dropInTime;
  std::optional<RefereeExtra2013> extra2013;
  std::array<RefereeTeam, 2>
      teams{};  ///< [0] is the left side (v7 beside v8 or v9: sorted by colour)

  /// RGTD: what really happens, sent to monitors only, without the league's delays. Not a referee
  /// state: robots do not get it.
  bool trueData() const { return magic[2] == 'T'; }
  /// The team with this number, or nullptr. The other one is the opponent.
  const RefereeTeam* team(int number) const;
  bool operator==(const RefereeState&) const = default;
};

/// What a robot answers to the referee (magic RGrt).
struct RobotReply {
  int version = 0;
  int size = 0;
  int team = 0, player = 0;
  std::optional<int> message;  ///< v1, v2: 0 penalise 1 unpenalise 2 alive 3 goalkeeper
  std::optional<int> fallen;   ///< v4
  std::optional<std::array<float, 3>> pose;  ///< v4: mm, mm, rad
  std::optional<float> ballAge;              ///< v4: seconds, negative if never seen
  std::optional<std::array<float, 2>> ball;  ///< v4: mm in the robot's frame
};

/// A robot's reply that a controller passes on to its monitors (port 3940).
struct ForwardedReply {
  std::uint32_t robot = 0;  ///< IPv4 address of the robot, host byte order
  RobotReply reply;
};

/// RGTr: a program asks the referee for true data.
struct TrueDataRequest {};

/// What a datagram on the referee's port turned out to be.
using RefereePacket = std::variant<RefereeState, RobotReply, ForwardedReply, TrueDataRequest>;

/// Decodes one datagram. Never reads outside the span, allocates only for an error's text.
/// Errors: ParseError (not a referee's packet, or cut), Unsupported (version or size unknown; the
/// sentence names both).
Result<RefereePacket> decodeReferee(std::span<const std::byte> datagram);
Result<RefereePacket> decodeReferee(std::string_view datagram);

/// "PLAYING"; "UNKNOWN" for other codes.
std::string_view stateName(int state);
/// "PENALTYSHOOT", "CORNER_KICK", ...: the HL's secondary state.
std::string_view secStateName(int secState);
/// "ROUNDROBIN", "PLAYOFF", "DROPIN".
std::string_view gameTypeName(int gameType);
/// "normal", "penalty shoot-out", "overtime", "timeout".
std::string_view gamePhaseWords(int gamePhase);
/// "corner", "pushing free kick", ...: in JSON, which programs read. The same code means different
/// things in the SPL and the HSL.
std::string_view setPlayName(League league, int setPlay);
/// As people read it everywhere: "corner kick". Of the HL the secondary state.
std::string_view setPlayWords(League league, int setPlay);
/// "blue", "red", ...; "unknown".
std::string_view colourWords(int colour);
/// "HL_PICKUP_OR_INCAPABLE", "NONE"; "UNKNOWN" for codes without a name in this version.
std::string_view penaltyName(const RefereeState& state, int penalty);
/// "pickup or incapable", "" for none, "unknown penalty" otherwise. A player with a red card is
/// "sent off", whatever penalty the packet gives for it.
std::string_view penaltyWords(const RefereeState& state, const RefereePlayer& player);
/// A slot without a player, which a display leaves out.
bool isSubstitute(const RefereeState& state, const RefereePlayer& player);

}  // namespace pitchboard::telemetry
