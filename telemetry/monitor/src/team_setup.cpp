// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <telemetry/monitor/team_setup.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include <base/file_target.h>
#include <base/lined_json.h>
#include <base/read_file.h>
#include <telemetry/sockets/socket_address.h>
#include <telemetry/sockets/udp_receiver.h>

namespace pitchboard::telemetry {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t maxSetupBytes = 256 * kibibyte, longestText = 60, mostSenders = 64;
constexpr int highestTeam = 65535;
constexpr std::array<std::string_view, 2> directions{"right", "left"};
constexpr std::array<std::string_view, 9> setupKeys{
    "name", "number", "colour", "ports", "senders", "profile", "model", "attacks", "robots"};

/// The GameController's colours in which robots are drawn.
constexpr std::array<std::string_view, 5> drawnColours{"blue", "red", "black", "orange", "yellow"};

void readPorts(const JsonObject& top, TeamSetup& setup) {
  const JsonNode* node = top.find("ports");
  if (node == nullptr) return;
  if (node->kind == JsonNode::Kind::Number) {
    setup.firstPort = setup.lastPort = top.integer("ports", 0, 1, highestPort);
    return;
  }
  const auto* ports = top.array("ports", 2);
  if (ports == nullptr) return;
  const auto portAt = [ports](std::size_t i) {
    const JsonNode& port = (*ports)[i];
    return port.whole && *port.whole <= highestPort ? static_cast<int>(*port.whole) : 0;
  };
  if (ports->size() == 2 && portAt(0) > 0 && portAt(1) >= portAt(0) && portAt(1) - portAt(0) < 64) {
    setup.firstPort = portAt(0);
    setup.lastPort = portAt(1);
  } else {
    top.fail("ports",
             "must be one port, or the first and the last of at most 64, each from 1 to 65535");
  }
}

void readSenders(const JsonObject& top, TeamSetup& setup) {
  const auto* senders = top.array("senders", mostSenders);
  SenderFilter filter;
  for (std::size_t i = 0; senders && i < senders->size(); ++i) {
    const JsonNode& sender = (*senders)[i];
    const auto added = filter.add(sender.text);
    if (!added) return top.fail("senders", added.error().text());
    setup.senders.push_back(sender.text);
  }
}

constexpr int maxNumber = 999;

void readRobots(JsonReport& report, const JsonObject& top, TeamSetup& setup) {
  const JsonNode* node = top.find("robots");
  if (node == nullptr) return;
  const JsonObject robots(report, *node, top.pathOf("robots"));
  if (robots.members().size() > TeamSetup::maxRobots) {
    return top.fail("robots", "must not have more than 64 names");
  }
  for (const auto& [key, value] : robots.members()) {
    int number = 0;
    const auto [stop, error] = std::from_chars(key.data(), key.data() + key.size(), number);
    if (error != std::errc{} || stop != key.data() + key.size() || number < 1 ||
        number > maxNumber) {
      return robots.fail(key, "a robot number must be 1 to 999");
    }
    setup.robots[number] = robots.text(key, {}, longestText);
  }
}

bool isBuiltIn(const std::string& profile) {
  const auto known = builtInProfiles();
  return std::find(known.begin(), known.end(), profile) != known.end();
}

/// All but the profile itself.
TeamSetup readSetup(JsonReport& report, const JsonObject& top) {
  TeamSetup setup;
  setup.name = top.text("name", {}, longestText);
  setup.number = top.integer("number", 0, 0, highestTeam);
  if (const auto colour = top.choice("colour", drawnColours, "colour of a team")) {
    setup.colour = drawnColours[*colour];
  }
  readPorts(top, setup);
  readSenders(top, setup);
  setup.attacksLeft = top.choice("attacks", directions, "direction").value_or(0) == 1;
  readRobots(report, top, setup);
  setup.profileName = top.text("profile", setup.profileName, 4096);
  setup.model = top.text("model", {}, 4096);
  return setup;
}

}  // namespace

std::string TeamSetup::title() const {
  if (!name.empty()) return name;
  return number > 0 ? "Team " + std::to_string(number) : std::string("Team");
}

Result<TeamSetup> parseTeamSetup(std::string_view text, const std::string& file, Profile profile) {
  JsonReport report(file);
  const auto root = parseJson(text, report, maxSetupBytes);
  if (!root) return tl::unexpected(report.error());
  TeamSetup setup = readSetup(report, JsonObject(report, *root, "", setupKeys));
  if (report.failed()) return tl::unexpected(report.error());
  setup.profile = std::move(profile);
  return setup;
}

Result<TeamSetup> parseTeamSetup(std::string_view text, const std::string& file) {
  JsonReport report(file);
  const auto root = parseJson(text, report, maxSetupBytes);
  if (!root) return tl::unexpected(report.error());
  const JsonObject top(report, *root, "", setupKeys);
  TeamSetup setup = readSetup(report, top);
  if (report.failed()) return tl::unexpected(report.error());
  std::string from = setup.profileName;
  if (!isBuiltIn(from)) from = (fs::path(file).parent_path() / from).string();
  auto profile = loadProfile(from);
  if (!profile && profile.error().code == ErrorCode::NotFound) {
    const auto known = builtInProfiles();
    const std::vector<std::string_view> choices(known.begin(), known.end());
    top.fail("profile",
             profile.error().text() + "; " + unknownName("profile", setup.profileName, choices));
    return tl::unexpected(report.error());
  }
  if (!profile) return tl::unexpected(profile.error());
  setup.profile = std::move(*profile);
  return setup;
}

Result<TeamSetup> loadTeamSetup(const std::string& path) {
  const auto text = readFile(path, maxSetupBytes, "The team setup");
  if (!text) return tl::unexpected(text.error());
  auto setup = parseTeamSetup(*text, path);
  if (setup && !isBuiltIn(setup->profileName)) {
    setup->profileName =
        fs::absolute(fs::path(path).parent_path() / setup->profileName).lexically_normal().string();
  }
  return setup;
}

Result<void> saveTeamSetup(const TeamSetup& setup, const std::string& path) {
  TeamSetup written = setup;
  const fs::path profile(setup.profileName);
  if (!isBuiltIn(setup.profileName) && profile.is_absolute() &&
      profile.parent_path() == fs::absolute(path).lexically_normal().parent_path()) {
    written.profileName = profile.filename().string();
  }
  return writeFile(path, teamSetupText(written), IfExists::Replace);
}

std::string teamSetupText(const TeamSetup& setup) {
  Json json{{"name", setup.name}};
  if (setup.number > 0) json["number"] = setup.number;
  if (!setup.colour.empty()) json["colour"] = setup.colour;
  if (setup.firstPort > 0 && setup.firstPort == setup.lastPort) json["ports"] = setup.firstPort;
  if (setup.firstPort < setup.lastPort) json["ports"] = {setup.firstPort, setup.lastPort};
  if (!setup.senders.empty()) json["senders"] = setup.senders;
  json["profile"] = setup.profileName;
  if (!setup.model.empty()) json["model"] = setup.model;
  if (setup.attacksLeft) json["attacks"] = directions[1];
  for (const auto& [number, name] : setup.robots) json["robots"][std::to_string(number)] = name;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<std::vector<std::uint16_t>> teamPorts(const std::vector<TeamSetup>& teams, int base,
                                             int count, int referee) {
  const auto usual = livePorts(base, count, referee);
  const auto hasNone = [](const TeamSetup& team) { return team.firstPort == 0; };
  if (!usual || teams.empty()) return usual;
  if (teams.size() > TeamSetup::maxTeams) {
    return failure(ErrorCode::InvalidArgument,
                   "At most " + std::to_string(TeamSetup::maxTeams) +
                       " teams can be received at the same time; remove some.");
  }
  std::vector<std::uint16_t> ports;
  if (std::any_of(teams.begin(), teams.end(), hasNone)) ports = *usual;
  for (const TeamSetup& team : teams) {
    for (int port = team.firstPort; port > 0 && port <= team.lastPort; ++port) {
      if (port == referee) {
        return failure(ErrorCode::InvalidArgument, "UDP " + std::to_string(port) +
                                                       " is the referee's port; " + team.title() +
                                                       " needs another one.");
      }
      const auto number = static_cast<std::uint16_t>(port);
      if (std::find(ports.begin(), ports.end(), number) == ports.end()) ports.push_back(number);
    }
  }
  const auto last = static_cast<std::uint16_t>(referee);
  if (std::find(ports.begin(), ports.end(), last) == ports.end()) ports.push_back(last);
  return ports;
}

TeamRouter::TeamRouter(const Profile& profile, std::vector<TeamSetup> teams,
                       const Surroundings& where)
    : m_simulated(std::make_shared<const TextDecoder>(publishedProfile(), where)) {
  if (teams.empty()) m_only = std::make_shared<const TextDecoder>(profile, where);
  for (TeamSetup& setup : teams) {
    Team team;
    for (const std::string& sender : setup.senders) (void)team.senders.add(sender);
    Surroundings own = where;
    own.attacksLeft = setup.attacksLeft;
    team.decoder = std::make_shared<const TextDecoder>(setup.profile, own);
    team.setup = std::move(setup);
    m_teams.push_back(std::move(team));
  }
}

bool TeamRouter::mayCome(const Team& team, const DatagramView& datagram) const {
  const int port = datagram.localPort;
  const bool itsPort =
      team.setup.firstPort == 0 || (port >= team.setup.firstPort && port <= team.setup.lastPort);
  return itsPort && team.senders.allows(datagram.sender.address);
}

std::shared_ptr<const TextDecoder> TeamRouter::decode(const DatagramView& datagram,
                                                      DecodedText& out) const {
  out.place = 0;
  if (isSimulated(datagram.sender.address)) {
    m_simulated->decode(datagram, out);
    out.place = simulatedTeam;
    return m_simulated;
  }
  if (m_only) {
    m_only->decode(datagram, out);
    return m_only;
  }
  const Team* refused = nullptr;
  for (std::size_t i = 0; i < m_teams.size(); ++i) {
    const Team& team = m_teams[i];
    if (!mayCome(team, datagram)) continue;
    team.decoder->decode(datagram, out);
    if (refused == nullptr) refused = &team;
    const bool another = out.team && team.setup.number > 0 && *out.team != team.setup.number;
    if (!out.accepted() || another) continue;
    out.place = static_cast<int>(i) + 1;
    return team.decoder;
  }
  if (refused == nullptr) return nullptr;
  // What is wrong with it, as the first team would write it.
  refused->decoder->decode(datagram, out);
  if (out.accepted()) return nullptr;  // it names another team
  out.place = static_cast<int>(refused - m_teams.data()) + 1;
  return refused->decoder;
}

std::optional<int> TeamRouter::placeOf(const DatagramView& datagram,
                                       std::optional<int> team) const {
  if (isSimulated(datagram.sender.address)) return simulatedTeam;
  if (m_only) return 0;
  for (std::size_t i = 0; i < m_teams.size(); ++i) {
    const int number = m_teams[i].setup.number;
    const bool another = team && number > 0 && *team != number;
    if (another || !mayCome(m_teams[i], datagram)) continue;
    return static_cast<int>(i) + 1;
  }
  return std::nullopt;
}

std::vector<int> TeamRouter::placesOf(Address sender) const {
  if (isSimulated(sender)) return {simulatedTeam};
  if (m_only) return {0};
  std::vector<int> places;
  for (std::size_t i = 0; i < m_teams.size(); ++i) {
    if (m_teams[i].senders.allows(sender)) places.push_back(static_cast<int>(i) + 1);
  }
  return places;
}

}  // namespace pitchboard::telemetry
