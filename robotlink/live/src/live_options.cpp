// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_options.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include <base/lined_json.h>
#include <base/try.h>
#include <robotlink/live/live_teams.h>
#include <robotlink/models/robot_models.h>

namespace pitchboard::link {
namespace {

using Access = OptionAccess<LiveOptions>;
using Texts = std::vector<std::string>;
using telemetry::BatteryLimits;
using telemetry::MonitorOptions;

template <auto... path>
constexpr Access liveMember = optionMember<LiveOptions, path...>;
template <auto part>
constexpr Access batteryMember =
    optionMember<LiveOptions, &LiveOptions::team, &MonitorOptions::battery, part>;

const std::string& liveText(const OptionValue& value) {
  return std::get<std::string>(value);
}

constexpr Access bindAccess{[](const LiveOptions& o) -> OptionValue { return o.bind.text(); },
                            [](LiveOptions& o, const OptionValue& value) -> Result<void> {
                              o.bind = TRY(telemetry::parseAddress(liveText(value)));
                              return {};
                            }};

Result<void> setSenders(telemetry::SenderFilter& senders, const OptionValue& value) {
  telemetry::SenderFilter made;
  for (const std::string& several : std::get<Texts>(value)) {
    for (const std::string& text : textsOf(several)) TRY(made.add(text));
  }
  senders = std::move(made);
  return {};
}
constexpr Access sendersAccess{
    [](const LiveOptions& o) -> OptionValue { return o.team.senders.texts(); },
    [](LiveOptions& o, const OptionValue& value) { return setSenders(o.team.senders, value); }};
constexpr Access refereeSendersAccess{
    [](const LiveOptions& o) -> OptionValue { return o.refereeSenders.texts(); },
    [](LiveOptions& o, const OptionValue& value) { return setSenders(o.refereeSenders, value); }};

constexpr Access catalogsAccess{[](const LiveOptions& o) -> OptionValue { return o.catalogs; },
                                [](LiveOptions& o, const OptionValue& value) -> Result<void> {
                                  for (const std::string& file : std::get<Texts>(value))
                                    TRY(VariableCatalog::fromFile(file));
                                  o.catalogs = std::get<Texts>(value);
                                  return {};
                                }};

constexpr Access timeoutAccess{
    [](const LiveOptions& o) -> OptionValue { return telemetry::secondsOf(o.team.timeout); },
    [](LiveOptions& o, const OptionValue& value) -> Result<void> {
      o.team.timeout = std::chrono::milliseconds(std::llround(std::get<double>(value) * 1000));
      return {};
    }};

constexpr Access fieldAccess{[](const LiveOptions& o) -> OptionValue { return o.field.name; },
                             [](LiveOptions& o, const OptionValue& value) -> Result<void> {
                               o.field = TRY(sim::fieldByName(liveText(value)));
                               return {};
                             }};
std::vector<OptionChoice> fieldChoices() {
  std::vector<OptionChoice> choices;
  for (const sim::FieldSpec& field : sim::builtInFields()) {
    choices.push_back({field.name, field.name + ": " + shortest(field.length) + " × " +
                                       shortest(field.width) + " m"});
  }
  return choices;
}

std::vector<OptionChoice> colourChoices() {
  return {{false, "team colour"}, {true, "by robot number"}};
}

constexpr int minRefereeVersion = 7;
constexpr Access versionAccess{[](const LiveOptions& o) -> OptionValue { return o.refereeVersion; },
                               [](LiveOptions& o, const OptionValue& value) -> Result<void> {
                                 const int version = std::get<int>(value);
                                 if (version > 0 && version < minRefereeVersion) {
                                   return failure(ErrorCode::InvalidArgument,
                                                  "There is no version " + std::to_string(version) +
                                                      " of the referee's packets; the first is 7.");
                                 }
                                 o.refereeVersion = version;
                                 return {};
                               }};
std::vector<OptionChoice> versionChoices() {
  std::vector<OptionChoice> choices{{0, "highest received"}};
  for (int version = minRefereeVersion; version <= 20; ++version) {
    choices.push_back({version, "only " + std::to_string(version)});
  }
  return choices;
}

constexpr Access ourTeamAccess{[](const LiveOptions& o) -> OptionValue {
                                 if (o.ourColour) return std::string(info(*o.ourColour).name);
                                 return o.ourTeam == 0 ? std::string() : std::to_string(o.ourTeam);
                               },
                               [](LiveOptions& o, const OptionValue& value) {
                                 return chooseOurTeam(
                                     o, liveText(value).empty() ? "0" : liveText(value));
                               }};

constexpr Access profileAccess{[](const LiveOptions& o) -> OptionValue { return o.profileFile; },
                               [](LiveOptions& o, const OptionValue& value) -> Result<void> {
                                 const std::string& file = liveText(value);
                                 o.profile = file.empty() ? telemetry::publishedProfile()
                                                          : TRY(telemetry::loadProfile(file));
                                 o.profileFile = file;
                                 return {};
                               }};

/// Their files are not known any more.
constexpr Access teamsAccess{[](const LiveOptions&) -> OptionValue { return Texts{}; },
                             [](LiveOptions& o, const OptionValue& value) -> Result<void> {
                               std::vector<telemetry::TeamSetup> teams;
                               for (const std::string& file : std::get<Texts>(value)) {
                                 teams.push_back(TRY(telemetry::loadTeamSetup(file)));
                               }
                               o.team.teams = std::move(teams);
                               return {};
                             }};

/// Further ones are added: a board with the same key replaces the known one.
constexpr Access boardsAccess{[](const LiveOptions& o) -> OptionValue {
                                Texts texts;
                                for (const AttachedBoard& board : o.boards)
                                  texts.push_back(attachedBoardText(board));
                                return texts;
                              },
                              [](LiveOptions& o, const OptionValue& value) -> Result<void> {
                                for (const std::string& text : std::get<Texts>(value)) {
                                  AttachedBoard board = TRY(parseAttachedBoard(text));
                                  std::erase_if(o.boards, [&board](const AttachedBoard& known) {
                                    return known.key == board.key;
                                  });
                                  o.boards.push_back(std::move(board));
                                }
                                return {};
                              }};

/// Further ones are added: a source with the same address replaces the known one.
constexpr Access foxgloveAccess{[](const LiveOptions& o) -> OptionValue {
                                  Texts texts;
                                  for (const FoxgloveSource& source : o.foxglove)
                                    texts.push_back(foxgloveSourceText(source));
                                  return texts;
                                },
                                [](LiveOptions& o, const OptionValue& value) -> Result<void> {
                                  for (const std::string& text : std::get<Texts>(value)) {
                                    FoxgloveSource source = TRY(parseFoxgloveSource(text));
                                    std::erase_if(o.foxglove, [&source](const auto& known) {
                                      return known.address == source.address;
                                    });
                                    o.foxglove.push_back(std::move(source));
                                  }
                                  return {};
                                }};

std::string profileHelp() {
  std::string text = "Format of the robots' messages: a file (docs/live.md), or ";
  const std::vector<std::string> names = telemetry::builtInProfiles();
  for (const std::string& name : names) text += (&name == &names.front() ? "" : ", ") + name;
  return text;
}

}  // namespace

std::span<const Option<LiveOptions>> liveOptionTable() {
  using O = LiveOptions;
  static const std::string profiles = profileHelp();
  // clang-format off
  static const Option<LiveOptions> table[] = {
      {{.name = "bind", .key = "bind", .form = "ADDRESS", .group = "Network", .title = "Listen on",
        .text = "Address to receive at; 0.0.0.0 is every interface, including broadcasts"},
        bindAccess},
      {{.name = "port-base", .key = "portBase", .form = "PORT", .group = "Network",
        .title = "Port base",
        .text = "Robot n sends to port base + n", .min = 0, .max = 65534},
        liveMember<&O::portBase>},
      {{.name = "robots", .key = "robots", .form = "N", .group = "Network", .title = "Robots",
        .text = "Number of robots, and of ports after the base", .min = 1, .max = 64},
        liveMember<&O::robots>},
      {{.name = "variables-port-base", .key = "variablesPortBase", .form = "PORT",
        .group = "Network", .title = "Variables port base",
        .text = "Robot n sends its variables (pitchboard-agent) to this port base + n; 0: off",
        .min = 0, .max = 65534, .unset = "off"}, liveMember<&O::variablesPortBase>},
      {{.name = "catalog", .key = "catalogs", .form = "FILE",
        .text = "Catalog of variables that robots send, besides the published one"},
        catalogsAccess},
      {{.name = "from", .key = "senders", .form = "ADDRESS", .group = "Network",
        .title = "Accept robots from",
        .text = "Accept only robots at this address or network, such as 192.168.1.0/24",
        .unset = "all senders"}, sendersAccess},
      {{.name = "simulated", .key = "simulated", .group = "Network",
        .title = "Receive simulated matches of this computer",
        .text = "Also receive simulated matches of this computer; their robots are called "
                "Simulated 1, Simulated 2, ..., and their referee is shown only while there is no "
                "real one"}, liveMember<&O::simulated>},
      {{.key = "timeout", .group = "Robots", .title = "Timeout after",
        .text = "A robot that sends nothing for this time is greyed out", .unit = "s", .min = 0.1,
        .max = 3600, .decimals = 1, .isRecorded = true}, timeoutAccess},
      {{.key = "cells", .group = "Robots", .title = "Battery cells",
        .text = "Cells in series. Automatic: the smallest number that fits the highest voltage "
                "seen", .min = 0, .max = 24, .unset = "automatic", .isRecorded = true},
        batteryMember<&BatteryLimits::cells>},
      {{.key = "fullPerCell", .group = "Robots", .title = "Full at",
        .text = "Voltage of a full battery", .unit = "V per cell", .min = 0.1, .max = 10,
        .isRecorded = true}, batteryMember<&BatteryLimits::fullPerCell>},
      {{.key = "lowPerCell", .group = "Robots", .title = "Low below",
        .text = "Below this voltage the battery is shown in red", .unit = "V per cell", .min = 0.1,
        .max = 10, .isRecorded = true}, batteryMember<&BatteryLimits::lowPerCell>},
      {{.key = "emptyPerCell", .group = "Robots", .title = "Empty at",
        .text = "Voltage of an empty battery", .unit = "V per cell", .min = 0, .max = 10,
        .isRecorded = true}, batteryMember<&BatteryLimits::emptyPerCell>},
      {{.key = "colourByNumber", .group = "Robots", .title = "Robot colours",
        .text = "In which colours robots are drawn", .choices = colourChoices, .isRecorded = true},
        liveMember<&O::colourByNumber>},
      {{.key = "field", .group = "Robots", .title = "Field",
        .text = "Field that is drawn", .choices = fieldChoices, .isRecorded = true}, fieldAccess},
      {{.name = "gamecontroller-port", .key = "refereePort", .form = "PORT", .group = "Referee",
        .title = "Port",
        .text = "Port of the referee's packets; all GameControllers so far use 3838", .min = 1,
        .max = 65535}, liveMember<&O::refereePort>},
      {{.name = "gamecontroller-version", .key = "refereeVersion", .form = "N", .group = "Referee",
        .title = "Packet version",
        .text = "Accept only this version of the referee's packets; default: the highest received",
        .min = 0, .max = 255, .choices = versionChoices, .isRecorded = true}, versionAccess},
      {{.name = "referee-from", .key = "refereeSenders", .form = "ADDRESS", .group = "Referee",
        .title = "Accept referee from",
        .text = "Accept only a referee at this address or network; others are counted",
        .unset = "all senders"}, refereeSendersAccess},
      {{.name = "our-team", .key = "ourTeam", .form = "N|COLOUR", .group = "Referee",
        .title = "Our team",
        .text = "Our team, by the referee's number or its colour, such as blue or red: gives its "
                "robots colour and penalties and lists them first", .unset = "not chosen",
        .isRecorded = true}, ourTeamAccess},
      {{.name = "profile", .key = "profileFile", .form = "FILE|NAME", .text = profiles.c_str()},
        profileAccess},
      {{.name = "team", .form = "FILE",
        .text = "Team setup as JSON (ports, senders, profile, colour)"}, teamsAccess},
      {{.name = "attach", .key = "boards",
        .form = "KEY[,catalog=FILE][,size=BYTES][,robot=N][,rate=R][,team=COLOUR]",
        .text = "Attach the blackboard with this System V key, read-only"}, boardsAccess},
      {{.name = "foxglove", .key = "foxglove",
        .form = "ADDRESS[,robot=N][,team=COLOUR][,map=FILE]",
        .text = "Show the topics of a program that speaks Foxglove's protocol, such as "
                "foxglove_bridge on a robot with ROS 2, at an address such as ws://robot3:8765; "
                "only reads"}, foxgloveAccess},
  };
  // clang-format on
  return table;
}

const Option<LiveOptions>& liveOption(std::string_view key) {
  return *std::ranges::find_if(liveOptionTable(), [key](const Option<LiveOptions>& option) {
    return option.info.key != nullptr && option.info.key == key;
  });
}

Result<std::vector<std::uint16_t>> portsOf(const LiveOptions& options) {
  auto ports = TRY(telemetry::teamPorts(options.team.teams, options.portBase, options.robots,
                                        options.refereePort));
  if (options.monitor) ports.push_back(telemetry::robotStatesPort);
  if (options.variablesPortBase == 0) return ports;
  for (int port = options.variablesPortBase + 1; port <= options.variablesPortBase + options.robots;
       ++port) {
    if (port < 1 || port > 65535) {
      return failure(ErrorCode::InvalidArgument,
                     "Robots' variables need the UDP ports " +
                         std::to_string(options.variablesPortBase + 1) + " to " +
                         std::to_string(options.variablesPortBase + options.robots) +
                         "; choose a base from 1 to " + std::to_string(65535 - options.robots) +
                         ", or 0 for none.");
    }
    const auto number = static_cast<std::uint16_t>(port);
    if (std::ranges::find(ports, number) != ports.end()) {
      return failure(ErrorCode::InvalidArgument,
                     "UDP " + std::to_string(port) +
                         " cannot be both a port of robots' variables and of messages; choose "
                         "another base.");
    }
    ports.push_back(number);
  }
  return ports;
}

bool isPossible(const telemetry::BatteryLimits& battery) {
  return battery.emptyPerCell < battery.lowPerCell && battery.lowPerCell < battery.fullPerCell;
}

Result<void> validate(const LiveOptions& options) {
  TRY(portsOf(options));
  if (!isPossible(options.team.battery)) {
    return failure(ErrorCode::InvalidArgument,
                   "Battery: empty must be less than low, and low less than full.");
  }
  for (const std::string& file : options.catalogs) TRY(VariableCatalog::fromFile(file));
  TRY(telemetry::validate(options.profile));
  for (const telemetry::TeamSetup& team : options.team.teams) {
    if (team.model.empty()) continue;
    if (auto model = loadRobotModel(team.model); !model) {
      Error error = model.error();
      error.context = team.title() + ", model";
      return tl::unexpected(std::move(error));
    }
  }
  TRY(validate(options.boards));
  TRY(validate(options.foxglove));
  return sim::validate(options.field);
}

}  // namespace pitchboard::link
