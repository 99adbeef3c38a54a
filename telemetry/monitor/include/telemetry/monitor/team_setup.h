// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A team setup says who a team is and how to receive it: name, colour, ports, senders, profile,
// names of robots (docs/live.md, "Team setups"). TeamRouter finds the team of each datagram. Setups
// are plain values for any thread; a TeamRouter belongs to the thread that decodes.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <telemetry/formats/text_decoder.h>
#include <telemetry/monitor/sender_filter.h>

namespace pitchboard::telemetry {

struct TeamSetup {
  static constexpr std::size_t maxRobots = 64;
  static constexpr std::size_t maxTeams = 16;  ///< teams that can be received at one time
  std::string name;                            ///< may be empty; see title()
  int number = 0;                              ///< number in the GameController; 0 if unknown
  std::string colour;                          ///< the name of a TeamColor; empty: Live chooses one
  int firstPort = 0, lastPort = 0;             ///< 0: Live's ports
  std::vector<std::string> senders;            ///< allowed addresses and networks; empty: all
  std::string profileName = "published";       ///< a built-in profile, or a file beside the setup
  Profile profile = publishedProfile();
  std::string model;                  ///< robot model: sets when a battery is low; may be empty
  bool attacksLeft = false;           ///< the team attacks the left goal
  std::map<int, std::string> robots;  ///< names of its robots, by number
  bool operator==(const TeamSetup&) const = default;

  /// Returns the name, or "Team 12", or "Team".
  std::string title() const;
};

/// Reads a setup. `file` is used in messages, and profiles are searched in its folder. Fails as
/// parseProfile() does; errors in the profile name its file.
Result<TeamSetup> parseTeamSetup(std::string_view json, const std::string& file);
/// Reads a setup from a file. The name of a profile that is a file becomes its full path.
Result<TeamSetup> loadTeamSetup(const std::string& path);
/// Writes a setup, replacing an existing file. A profile in the same folder is named without the
/// folder. Fails as writeFile() does.
Result<void> saveTeamSetup(const TeamSetup& setup, const std::string& path);
/// The same, with a profile that is already known: its name in the setup is only a label.
Result<TeamSetup> parseTeamSetup(std::string_view json, const std::string& file, Profile profile);
/// Returns a text that parseTeamSetup() reads back to the same value.
std::string teamSetupText(const TeamSetup& setup);

/// Returns the ports to receive: those of the teams, Live's (livePorts()) for teams that name none,
/// and the referee's. Fails as livePorts() does, and with InvalidArgument for more than maxTeams.
Result<std::vector<std::uint16_t>> teamPorts(const std::vector<TeamSetup>& teams, int base,
                                             int count, int referee);

/// RobotKey::team of simulated robots that are received as if they were real. They are no team of
/// the setups, so that their numbers cannot be mistaken for those of real robots.
inline constexpr int simulatedTeam = static_cast<int>(TeamSetup::maxTeams) + 1;

/// Returns the setup of a team by its index (RobotKey::team), or null if it has none.
inline const TeamSetup* setupAt(int place, const std::vector<TeamSetup>& teams) {
  return place > 0 && static_cast<std::size_t>(place) <= teams.size()
             ? &teams[static_cast<std::size_t>(place) - 1]
             : nullptr;
}

class TeamRouter {
 public:
  /// Without teams, every datagram is read with the one profile. Datagrams of simulated robots are
  /// read with the published one.
  TeamRouter(const Profile& profile, std::vector<TeamSetup> teams, const Surroundings& where);

  /// Decodes a datagram as its team writes it: the first team whose ports, senders and format fit.
  /// DecodedText::place says which one. Returns null if it belongs to no team.
  std::shared_ptr<const TextDecoder> decode(const DatagramView& datagram, DecodedText& out) const;
  /// Returns the RobotKey::team of a datagram, by where it came from and the team number `team`
  /// that it may name. Nothing if it belongs to no team.
  std::optional<int> placeOf(const DatagramView& datagram, std::optional<int> team) const;
  /// Returns the RobotKey::team of each team that allows this sender, whatever port it sends to.
  std::vector<int> placesOf(Address sender) const;

 private:
  struct Team {
    TeamSetup setup;
    SenderFilter senders;
    std::shared_ptr<const TextDecoder> decoder;
  };
  bool mayCome(const Team& team, const DatagramView& datagram) const;

  std::vector<Team> m_teams;
  std::shared_ptr<const TextDecoder> m_only;
  std::shared_ptr<const TextDecoder> m_simulated;
};

}  // namespace pitchboard::telemetry
