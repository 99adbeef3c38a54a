// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Who is heard, as a file that a team keeps: its name and colour, where its messages come from, how
// they are written, what its robots are called (docs/live.md, "Team setups"). And the choice of the
// team for each datagram. Values; any thread. A TeamRouter belongs to the one who decodes.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <telemetry/wire/sender_filter.h>
#include <telemetry/wire/text_decoder.h>

namespace pitchboard::telemetry {

struct TeamSetup {
  static constexpr std::size_t maxRobots = 64;
  static constexpr std::size_t mostTeams = 16;  ///< that are heard at one time
  std::string name;                             ///< empty: title() has the number
  int number = 0;                               ///< the referee's; 0: not known
  std::string colour;                           ///< as colourWords(); empty: Live chooses
  int firstPort = 0, lastPort = 0;              ///< 0: Live's own ports
  std::vector<std::string> senders;             ///< addresses and networks; empty: everybody
  std::string profileName = "published";        ///< a built-in one, or a file (beside the setup)
  Profile profile = publishedProfile();
  bool attacksLeft = false;           ///< plays towards the left goal
  std::map<int, std::string> robots;  ///< names by number
  bool operator==(const TeamSetup&) const = default;

  /// "RoboFEI", "Team 12" or "Team".
  std::string title() const;
};

/// Reads a setup; `file` is for messages, and its folder is where profiles are looked for. Errors
/// as parseProfile(); those of the profile name its own file.
Result<TeamSetup> parseTeamSetup(std::string_view json, const std::string& file);
/// The name of a profile that is a file becomes its whole path.
Result<TeamSetup> loadTeamSetup(const std::string& path);
/// A profile in the same folder is named without it. In place of an old file; errors as
/// writeFile().
Result<void> saveTeamSetup(const TeamSetup& setup, const std::string& path);
/// The same with a profile that is known already: its name in the setup is only a name.
Result<TeamSetup> parseTeamSetup(std::string_view json, const std::string& file, Profile profile);
/// Text that parseTeamSetup() reads back to the same value.
std::string teamSetupText(const TeamSetup& setup);

/// The ports of the teams; those of Live (livePorts()) where a team names none, and always the
/// referee's. Errors as livePorts(), and InvalidArgument for more than mostTeams.
Result<std::vector<std::uint16_t>> teamPorts(const std::vector<TeamSetup>& teams, int base,
                                             int count, int referee);

/// Of the team at this place (RobotKey::team). Null: it has none.
inline const TeamSetup* setupAt(int place, const std::vector<TeamSetup>& teams) {
  return place > 0 && static_cast<std::size_t>(place) <= teams.size()
             ? &teams[static_cast<std::size_t>(place) - 1]
             : nullptr;
}

class TeamRouter {
 public:
  /// Without teams every datagram is of the one profile.
  TeamRouter(const Profile& profile, std::vector<TeamSetup> teams, const Surroundings& where);

  /// Reads a datagram as its team writes: the first one whose ports and senders fit and whose
  /// format it has; DecodedText::place says which. Null: it comes from no team.
  std::shared_ptr<const TextDecoder> decode(const DatagramView& datagram, DecodedText& out) const;
  /// RobotKey::team of robots whose datagrams come like this one, from the team with the referee's
  /// number `team` where it says one. Nothing: it comes from no team.
  std::optional<int> placeOf(const DatagramView& datagram, std::optional<int> team) const;
  /// Of robots at this address, whatever port they send to.
  std::optional<int> placeOf(Address sender) const;

 private:
  struct Team {
    TeamSetup setup;
    SenderFilter senders;
    std::shared_ptr<const TextDecoder> decoder;
  };
  bool mayCome(const Team& team, const DatagramView& datagram) const;

  std::vector<Team> m_teams;
  std::shared_ptr<const TextDecoder> m_only;
};

}  // namespace pitchboard::telemetry
