// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Packets of the GameController, the referee's program, of every version of the Humanoid League,
// the Standard Platform League and the Humanoid Soccer League since 2013. RefereeState has the
// fields of a packet as they are sent, so that every byte can be shown, compared and sent again;
// what they mean is a Game, which gameOf() reads from them. The layouts are data
// (src/gamecontroller_layouts.cpp); a new version is a new row there. Plain values and pure
// functions; any thread.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include <base/game.h>
#include <base/result.h>

namespace pitchboard::telemetry {

/// A slot of a team, with codes as sent.
struct RefereePlayer {
  int number = 0;  ///< number of the slot, from 1
  int penalty = 0;
  int secondsLeft = 0;  ///< as sent: some versions do not count down
  std::optional<int> warnings, yellow, red, cautions, goalkeeper;
  /// True if the program of 2013 has overwritten these bytes; penalty and secondsLeft are then
  /// those of an unused slot.
  bool unreliable = false;
  bool operator==(const RefereePlayer&) const = default;
};

struct RefereeTeam {
  static constexpr std::size_t maxPlayers = 20;
  int number = 0;  ///< identifies the team; its place in the packet is its side
  int colour = 0;  ///< see colourOf()
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

/// A packet of the referee. An optional is empty if the version does not have the field. Times are
/// seconds as sent, negative in extra time.
struct RefereeState {
  std::array<char, 4> magic{'R', 'G', 'm', 'e'};
  int version = 0;
  int size = 0;  ///< size of the packet in bytes
  League league = League::Humanoid;
  int playersPerTeam = 0;
  int state = 0;       ///< 0 INITIAL ... see playStateOf()
  int firstHalf = 0;   ///< 1 in the first half
  int kickOffRaw = 0;  ///< as sent: a colour in v7 and v8, then a team number
  int secsRemaining = 0;
  std::optional<int> kickOffTeam;  ///< number of the team; empty if no team kicks off
  std::optional<int> packetNumber, secondaryTime;
  std::optional<int> gameType;  ///< HL and SPL 2017
  std::optional<int> secState;  ///< secondary state, HL
  std::optional<std::array<int, 4>> secStateInfo;
  std::optional<int> gamePhase, setPlay, competitionPhase, competitionType, stopped;
  std::optional<int> dropInTeam, dropInTime;
  std::optional<RefereeExtra2013> extra2013;
  std::array<RefereeTeam, 2>
      teams{};  ///< [0] is the left side (v7 beside v8 or v9: sorted by colour)

  /// Returns whether this is true data (RGTD): what really happens, without the league's delays.
  /// Only monitors receive it, so it is not what robots know.
  bool trueData() const { return magic[2] == 'T'; }
  /// Returns the team with this number, or null.
  const RefereeTeam* team(int number) const;
  bool operator==(const RefereeState&) const = default;
};

/// A robot's reply to the referee (magic RGrt).
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

/// Any datagram that is valid on the referee's port.
using RefereePacket = std::variant<RefereeState, RobotReply, ForwardedReply, TrueDataRequest>;

/// Decodes a datagram. It never reads outside the span and allocates only for an error's text.
/// Fails with ParseError if it is not a packet of the referee or is cut off, with Unsupported if
/// version or size are unknown (the message names both).
Result<RefereePacket> decodeReferee(std::span<const std::byte> datagram);
Result<RefereePacket> decodeReferee(std::string_view datagram);

/// Returns what a packet says of the game. Its first team defends the left goal; times are whole
/// seconds; a robot's shirt is the number of its slot.
Game gameOf(const RefereeState& packet);

// Codes of packets and what they mean; Unknown for codes that a version does not have.
PlayState playStateOf(int code);
TeamColor colourOf(int code);
PenaltyKind penaltyOf(const RefereeState& packet, int code);
// And back: the nearest that the version of a packet has. A set play that it cannot tell is 0.
int colourCode(TeamColor colour);
int penaltyCode(const RefereeState& packet, PenaltyKind penalty);
/// Of secState in the Humanoid League, of setPlay in the others.
int setPlayCode(const RefereeState& packet, SetPlay play);
/// Returns a name such as "HL_PICKUP_OR_INCAPABLE" or "NONE"; "UNKNOWN" if this version has no such
/// code.
std::string_view penaltyName(const RefereeState& packet, int code);

}  // namespace pitchboard::telemetry
