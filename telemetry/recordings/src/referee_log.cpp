// SPDX-License-Identifier: GPL-3.0-or-later
// The log of the GameController (Humanoid Soccer League; Standard Platform League since 2023): a
// list in YAML, written entry by entry. Source: the program's own types (game_controller_core,
// log.rs and types.rs). Each state of the game becomes the packet that the program sends of it,
// once a second while its clocks run, so that the decoders of packets read it.
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>

#include <base/base64.h>
#include <base/try.h>
#include <telemetry/recordings/decoded_topics.h>
#include <telemetry/referee/gamecontroller_encoder.h>

#include "message_shape.h"
#include "recording_formats.h"
#include "text_file.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t maxLogEntry = 1U << 20;
constexpr std::int64_t secondInNs = 1'000'000'000;
/// Packets between two entries of the log; a longer silence is a gap.
constexpr int maxPacketsBetween = 3600;
constexpr std::uint16_t gamePort = 3838, statusPort = 3939;
constexpr int teamPortBase = 10'000;
constexpr Address logAddress{0x7f000001};  // the log is the referee's own

template <class Code>
struct LogName {
  std::string_view name;
  Code code;
};

constexpr std::array logPenalties{
    LogName<PenaltyKind>{"noPenalty", PenaltyKind::None},
    LogName<PenaltyKind>{"illegalPositioning", PenaltyKind::IllegalPosition},
    LogName<PenaltyKind>{"illegalPosition", PenaltyKind::IllegalPosition},
    LogName<PenaltyKind>{"illegalPositionInSet", PenaltyKind::IllegalPositionInSet},
    LogName<PenaltyKind>{"motionInSet", PenaltyKind::MotionInSet},
    LogName<PenaltyKind>{"motionInStop", PenaltyKind::MotionInStop},
    LogName<PenaltyKind>{"motionInInitial", PenaltyKind::MotionInInitial},
    LogName<PenaltyKind>{"motionInStandby", PenaltyKind::MotionInInitial},
    LogName<PenaltyKind>{"localGameStuck", PenaltyKind::LocalStuck},
    LogName<PenaltyKind>{"incapableRobot", PenaltyKind::IncapableRobot},
    LogName<PenaltyKind>{"fallenInactive", PenaltyKind::Inactive},
    LogName<PenaltyKind>{"pickedUp", PenaltyKind::PickUp},
    LogName<PenaltyKind>{"ballHolding", PenaltyKind::Holding},
    LogName<PenaltyKind>{"leavingTheField", PenaltyKind::Leaving},
    LogName<PenaltyKind>{"playingWithArmsHands", PenaltyKind::Hands},
    LogName<PenaltyKind>{"playerStance", PenaltyKind::Stance},
    LogName<PenaltyKind>{"pushing", PenaltyKind::Pushing},
    LogName<PenaltyKind>{"playerPushing", PenaltyKind::Pushing},
    LogName<PenaltyKind>{"cautioned", PenaltyKind::Cautioned},
    LogName<PenaltyKind>{"sentOff", PenaltyKind::SentOff},
    LogName<PenaltyKind>{"substitute", PenaltyKind::Substitute}};

constexpr std::array logSetPlays{LogName<SetPlay>{"noSetPlay", SetPlay::None},
                                 LogName<SetPlay>{"kickOff", SetPlay::None},
                                 LogName<SetPlay>{"directFreeKick", SetPlay::DirectFreeKick},
                                 LogName<SetPlay>{"indirectFreeKick", SetPlay::IndirectFreeKick},
                                 LogName<SetPlay>{"pushingFreeKick", SetPlay::PushingFreeKick},
                                 LogName<SetPlay>{"penaltyKick", SetPlay::PenaltyKick},
                                 LogName<SetPlay>{"throwIn", SetPlay::ThrowIn},
                                 LogName<SetPlay>{"kickIn", SetPlay::KickIn},
                                 LogName<SetPlay>{"goalKick", SetPlay::GoalKick},
                                 LogName<SetPlay>{"cornerKick", SetPlay::CornerKick}};

constexpr std::array logStates{LogName<PlayState>{"initial", PlayState::Initial},
                               LogName<PlayState>{"ready", PlayState::Ready},
                               LogName<PlayState>{"set", PlayState::Set},
                               LogName<PlayState>{"playing", PlayState::Playing},
                               LogName<PlayState>{"finished", PlayState::Finished},
                               LogName<PlayState>{"standby", PlayState::Standby},
                               LogName<PlayState>{"timeout", PlayState::Initial}};

constexpr std::array<LogName<int>, 10> logColours{{{"blue", 0},
                                                   {"red", 1},
                                                   {"yellow", 2},
                                                   {"black", 3},
                                                   {"white", 4},
                                                   {"green", 5},
                                                   {"orange", 6},
                                                   {"purple", 7},
                                                   {"brown", 8},
                                                   {"gray", 9}}};

template <class Table, class Code>
Code codeNamed(const Table& table, std::string_view name, Code fallback) {
  for (const auto& row : table) {
    if (row.name == name) return row.code;
  }
  return fallback;
}

std::string logText(const YAML::Node& node) {
  return node.IsDefined() && node.IsScalar() ? node.Scalar() : std::string();
}

int logNumber(const YAML::Node& node, int fallback = 0) {
  int value = fallback;
  return node.IsDefined() && node.IsScalar() && YAML::convert<int>::decode(node, value) ? value
                                                                                        : fallback;
}

std::int64_t logNumber64(const YAML::Node& node) {
  std::int64_t value = 0;
  return node.IsDefined() && node.IsScalar() && YAML::convert<std::int64_t>::decode(node, value)
             ? value
             : 0;
}

bool logFlag(const YAML::Node& node) {
  bool value = false;
  return node.IsDefined() && node.IsScalar() && YAML::convert<bool>::decode(node, value) && value;
}

std::int64_t fromParts(std::int64_t seconds, std::int64_t nanoseconds) {
  constexpr std::int64_t most = 1'000'000'000;
  return std::clamp(seconds, -most, most) * secondInNs +
         std::clamp<std::int64_t>(nanoseconds, -secondInNs, secondInNs);
}

/// {secs, nanos}, a list of both, or a text such as "-0.500000000", in ns.
std::int64_t logDuration(const YAML::Node& node) {
  if (!node.IsDefined()) return 0;
  if (node.IsMap()) return fromParts(logNumber64(node["secs"]), logNumber64(node["nanos"]));
  if (node.IsSequence() && node.size() == 2) {
    return fromParts(logNumber64(node[0]), logNumber64(node[1]));
  }
  double seconds = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, seconds)) return 0;
  return static_cast<std::int64_t>(std::clamp(seconds, -1e9, 1e9) * 1e9);
}

/// A clock of the game, which runs on between two entries.
struct LogTimer {
  std::int64_t remaining = 0;  ///< ns
  std::string condition;       ///< when it runs
  bool overflows = false;      ///< it runs on below 0
  bool isStarted = false;

  void advance(std::int64_t by) {
    remaining -= by;
    if (!overflows) remaining = std::max<std::int64_t>(remaining, 0);
  }
  int seconds(int least, int most) const {
    const std::int64_t whole = remaining / secondInNs + (remaining % secondInNs > 0 ? 1 : 0);
    return static_cast<int>(std::clamp<std::int64_t>(whole, least, most));
  }
};

LogTimer timerOf(const YAML::Node& node) {
  LogTimer timer;
  if (!node.IsDefined() || !node.IsMap()) return timer;
  const YAML::Node inside = node["started"].IsDefined() ? node["started"] : node;
  timer.remaining = logDuration(inside["remaining"]);
  timer.condition = logText(inside["runCondition"]);
  timer.overflows = logText(inside["behaviorAtZero"]) == "overflow";
  timer.isStarted = true;
  return timer;
}

struct LogTeam {
  int number = 0, colour = 0, keeperColour = 0;
};

/// The game as the log has it last.
struct LogGame {
  RefereeState packet;
  LogTimer primary, secondary;
  std::array<std::array<LogTimer, RefereeTeam::maxPlayers>, 2> penalties;
  std::int64_t halfDuration = 0;  ///< ns
  PlayState state = PlayState::Initial;
  bool isShootOut = false;

  bool runs(const std::string& condition) const {
    if (packet.stopped.value_or(0) != 0) return false;
    const bool isPlaying = state == PlayState::Playing;
    const bool isReady = state == PlayState::Ready;
    if (condition == "playing") return isPlaying;
    if (condition == "readyOrPlaying") return isPlaying || isReady;
    if (condition == "mainTimer") {
      const bool hasBegun = !isShootOut && primary.remaining != halfDuration;
      return isPlaying || ((isReady || state == PlayState::Set) && hasBegun);
    }
    return true;
  }
  void advance(std::int64_t by) {
    const auto pass = [&](LogTimer& timer) {
      if (timer.isStarted && runs(timer.condition)) timer.advance(by);
    };
    for (auto& team : penalties) std::ranges::for_each(team, pass);
    pass(secondary);
    pass(primary);
  }
  RefereeState now() const {
    RefereeState out = packet;
    out.secsRemaining = primary.seconds(-32'768, 32'767);
    out.secondaryTime = secondary.seconds(-32'768, 32'767);
    for (std::size_t team = 0; team < 2; ++team) {
      for (std::size_t i = 0; i < out.teams[team].slotCount; ++i) {
        out.teams[team].allSlots[i].secondsLeft = penalties[team][i].seconds(0, 255);
      }
    }
    return out;
  }
};

class RefereeLog : public RecordingReader {
 public:
  static OpenedRecording open(const std::string& path) {
    auto file = TRY(TextFile::open(path));
    auto log = std::unique_ptr<RefereeLog>(new RefereeLog(path, std::move(file)));
    return log;
  }

  const std::vector<RecordedTopic>& topics() const override { return m_topics; }
  double progress() const override { return m_file.progress(); }

  Result<RecordedItem> next() override {
    if (m_isServed) m_items.pop_front();
    m_isServed = false;
    while (m_items.empty() && !m_atEnd) readEntry();
    if (m_items.empty()) return RecordedItem::End;
    m_isServed = true;
    Item& item = m_items.front();
    if (item.isAction) {
      m_texts = {item.source, item.text};
      m_message = {0, item.time, {}, m_shape, m_values, m_texts};
      return RecordedItem::Message;
    }
    m_datagram = {item.time, item.sender, item.port, item.text};
    return RecordedItem::Datagram;
  }

  std::vector<std::string> notes() const override {
    std::vector<std::string> notes;
    if (!m_hasMetadata) {
      notes.push_back(m_path + ": the log has no metadata, so its time of day is unknown.");
    }
    if (!m_isIntact) {
      notes.push_back(m_path + ": the log was cut off; its last entry may be missing.");
    }
    if (m_wrong > 0) {
      notes.push_back(
          m_path + ": " +
          countText(m_wrong, "entry is not valid and was", "entries are not valid and were") +
          " left out, the first at line " + std::to_string(m_firstWrong) + ".");
    }
    for (const auto& [kind, count] : m_unknown) {
      notes.push_back(m_path + ": " + countText(count, "entry", "entries") +
                      " of the unknown kind \"" + kind + "\" " + (count == 1 ? "was" : "were") +
                      " left out.");
    }
    return notes;
  }

 private:
  struct Item {
    std::int64_t time = 0;
    bool isAction = false;
    std::string source, text;  ///< text: of an action, or the bytes of a datagram
    Sender sender{};
    std::uint16_t port = 0;
  };

  RefereeLog(std::string path, TextFile file) : m_path(std::move(path)), m_file(std::move(file)) {
    m_topics.push_back({"/referee", "GameController/Action", "yaml"});
    auto shape = std::make_shared<RecordedShape>();
    shape->fields = {{"source", RecordedKind::Text}, {"action", RecordedKind::Text}};
    m_shape = std::move(shape);
  }

  /// Reads the lines of one entry. Lists inside it are indented.
  void readEntry() {
    std::string text = std::exchange(m_begun, {});
    const std::size_t firstLine = m_line;
    bool isTooLong = false;
    for (;;) {
      const auto line = m_file.line();
      if (!line) {
        m_atEnd = true;
        break;
      }
      ++m_line;
      const bool begins = line->starts_with("- ");
      if (begins && !text.empty()) {
        m_begun = std::string(*line) + "\n";
        break;
      }
      if (!begins && text.empty()) continue;  // "---", comments
      isTooLong = isTooLong || text.size() + line->size() > maxLogEntry;
      if (!isTooLong) text.append(*line).append("\n");
    }
    if (text.empty()) return;
    if (isTooLong || !takeText(text)) {
      if (m_wrong++ == 0) m_firstWrong = std::max<std::size_t>(firstLine, 1);
      // What a crash leaves is the beginning of an entry.
      if (m_atEnd) --m_wrong;
    }
  }

  bool takeText(const std::string& text) {
    try {
      const YAML::Node list = YAML::Load(text);
      if (!list.IsSequence() || list.size() != 1 || !list[0].IsMap()) return false;
      const YAML::Node entry = list[0]["entry"];
      if (!entry.IsDefined()) return false;
      const std::int64_t since = std::max<std::int64_t>(0, logDuration(list[0]["timestamp"]));
      passTime(std::max(since, m_since));
      return takeEntry(entry);
    } catch (const std::exception&) {
      return false;
    }
  }

  /// Packets of the game whose clocks run until `since`.
  void passTime(std::int64_t since) {
    std::int64_t from = m_since;
    m_since = since;
    if (!m_hasGame) return;
    for (int i = 0; from < since && i < maxPacketsBetween; ++i) {
      const std::int64_t step = std::min(secondInNs - (from - m_lastPacket), since - from);
      m_game.advance(step);
      from += step;
      if (from - m_lastPacket >= secondInNs && from < since) addPacket(from);
    }
  }

  bool takeEntry(const YAML::Node& entry) {
    const std::string& tag = entry.Tag();
    if (tag == "!metadata") return takeMetadata(entry);
    if (tag == "!gameState") return takeGame(entry);
    if (tag == "!action") return takeAction(entry);
    if (tag == "!statusMessage") return takeDatagram(entry, statusPort);
    if (tag == "!teamMessage") {
      const int team = logNumber(entry["team"], -1);
      if (team < 0 || team > 255) return false;
      return takeDatagram(entry, static_cast<std::uint16_t>(teamPortBase + team));
    }
    if (tag == "!monitorRequest") return true;  // it says nothing of the game
    if (logText(entry) == "end") {
      m_isIntact = true;
      return true;
    }
    std::string kind(cutText(tag.size() > 1 ? tag : logText(entry), 60));
    if (m_unknown.size() < 100 || m_unknown.contains(kind)) ++m_unknown[kind];
    return true;
  }

  bool takeMetadata(const YAML::Node& entry) {
    const auto start = isoTime(logText(entry["timestamp"]));
    if (!start || m_hasMetadata) return false;
    m_hasMetadata = true;
    m_start = *start;
    const YAML::Node competition = entry["params"]["competition"], game = entry["params"]["game"];
    RefereeState& packet = m_game.packet;
    const bool isSoccer = competition["division"].IsDefined();
    packet.version = isSoccer ? 20 : 18;
    packet.size = refereePacketSize(packet.version).value_or(0);
    packet.league = isSoccer ? League::HumanoidSoccer : League::StandardPlatform;
    packet.playersPerTeam = std::clamp(logNumber(competition["playersPerTeam"]), 0, 20);
    packet.competitionPhase = 0;
    packet.competitionType = 0;
    m_game.halfDuration = logDuration(competition["halfDuration"]);
    for (std::size_t i = 0; i < 2; ++i) {
      const YAML::Node team = game["teams"][sideNames[i]];
      m_teams[i] = {std::clamp(logNumber(team["number"]), 0, 255),
                    codeNamed(logColours, logText(team["fieldPlayerColor"]), 9),
                    codeNamed(logColours, logText(team["goalkeeperColor"]), 9)};
    }
    return true;
  }

  bool takeGame(const YAML::Node& entry) {
    if (!m_hasMetadata || !entry.IsMap()) return false;
    RefereeState& packet = m_game.packet;
    const std::string phase = logText(entry["phase"]), state = logText(entry["state"]);
    m_game.state = codeNamed(logStates, state, PlayState::Unknown);
    m_game.isShootOut = phase == "penaltyShootout";
    const bool isExtra = phase == "firstExtraHalf" || phase == "secondExtraHalf";
    packet.state = static_cast<int>(m_game.state);
    packet.stopped = logFlag(entry["stopped"]) ? 1 : 0;
    packet.gamePhase = state == "timeout" ? 3 : m_game.isShootOut ? 1 : isExtra ? 2 : 0;
    packet.firstHalf = phase == "firstHalf" || phase == "firstExtraHalf" ? 1 : 0;
    packet.setPlay =
        setPlayCode(packet, codeNamed(logSetPlays, logText(entry["setPlay"]), SetPlay::None));
    const std::string kicking = logText(entry["kickingSide"]);
    constexpr int nobody = 255;
    packet.kickOffRaw = kicking == sideNames[0]   ? m_teams[0].number
                        : kicking == sideNames[1] ? m_teams[1].number
                                                  : nobody;
    m_game.primary = timerOf(entry["primaryTimer"]);
    m_game.secondary = timerOf(entry["secondaryTimer"]);
    const bool isHomeLeft = logText(entry["sides"]) != "homeDefendsRightGoal";
    for (std::size_t i = 0; i < 2; ++i) {
      takeTeam(entry["teams"][sideNames[i]], m_teams[i], isHomeLeft ? i : 1 - i);
    }
    m_hasGame = true;
    addPacket(m_since);
    return true;
  }

  void takeTeam(const YAML::Node& node, const LogTeam& known, std::size_t place) {
    RefereeTeam team;
    team.number = known.number;
    team.colour = known.colour;
    team.goalkeeperColour = known.keeperColour;
    team.goalkeeper = std::clamp(logNumber(node["goalkeeper"]), 0, 20);
    team.score = std::clamp(logNumber(node["score"]), 0, 255);
    team.penaltyShot = std::clamp(logNumber(node["penaltyShot"]), 0, 255);
    team.singleShots = std::clamp(logNumber(node["penaltyShotMask"]), 0, 65'535);
    team.messageBudget = std::clamp(logNumber(node["messageBudget"]), 0, 65'535);
    const RefereeState& packet = m_game.packet;
    team.slotCount = std::min(refereeSlots(packet.version, packet.size), RefereeTeam::maxPlayers);
    const YAML::Node players = node["players"];
    for (std::size_t i = 0; i < team.slotCount; ++i) {
      const bool isThere = players.IsDefined() && players.IsSequence() && i < players.size();
      const YAML::Node player = isThere ? players[i] : YAML::Node();
      RefereePlayer& slot = team.allSlots[i];
      slot.number = static_cast<int>(i) + 1;
      const std::string penalty = isThere ? logText(player["penalty"]) : "substitute";
      slot.penalty = penaltyCode(packet, codeNamed(logPenalties, penalty, PenaltyKind::Unknown));
      if (isThere) slot.cautions = std::clamp(logNumber(player["cautions"]), 0, 255);
      m_game.penalties[place][i] = isThere ? timerOf(player["penaltyTimer"]) : LogTimer{};
    }
    m_game.packet.teams[place] = team;
  }

  void addPacket(std::int64_t since) {
    m_lastPacket = since;
    RefereeState state = m_game.now();
    state.packetNumber = m_packet++ & 0xff;
    if (auto bytes = encodeReferee(state)) {
      m_items.push_back(
          {m_start + since, false, {}, std::move(*bytes), {logAddress, gamePort}, gamePort});
    }
  }

  bool takeAction(const YAML::Node& entry) {
    const YAML::Node action = entry["action"];
    std::string text = logText(action["type"]);
    if (text.empty()) return false;
    if (action["args"].IsDefined() && !action["args"].IsNull()) {
      YAML::Emitter args;
      args.SetMapFormat(YAML::Flow);
      args.SetSeqFormat(YAML::Flow);
      args << action["args"];
      text += ' ';
      text += cutText(std::string_view(args.c_str(), args.size()), 500);
    }
    m_items.push_back({m_start + m_since, true, logText(entry["source"]), std::move(text)});
    return true;
  }

  bool takeDatagram(const YAML::Node& entry, std::uint16_t port) {
    const auto bytes = fromBase64(logText(entry["data"]));
    if (!bytes || bytes->empty()) return false;
    const auto address = parseAddress(logText(entry["host"]));  // of IPv6 the log is not used
    m_items.push_back(
        {m_start + m_since, false, {}, *bytes, {address.value_or(Address{}), port}, port});
    return true;
  }

  static constexpr std::array<const char*, 2> sideNames{"home", "away"};

  std::string m_path;
  TextFile m_file;
  std::vector<RecordedTopic> m_topics;
  std::shared_ptr<const RecordedShape> m_shape;
  std::array<double, 2> m_values{std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::quiet_NaN()};
  std::array<std::string_view, 2> m_texts;
  std::string m_begun;  ///< the first line of the next entry
  std::size_t m_line = 0, m_firstWrong = 0;
  std::deque<Item> m_items;
  bool m_isServed = false, m_atEnd = false, m_isIntact = false;
  bool m_hasMetadata = false, m_hasGame = false;
  std::int64_t m_start = 0, m_since = 0, m_lastPacket = 0;  ///< ns
  std::array<LogTeam, 2> m_teams;
  LogGame m_game;
  int m_packet = 0;
  std::uint64_t m_wrong = 0;
  std::map<std::string, std::uint64_t> m_unknown;
};

}  // namespace

bool isRefereeLog(const std::string&, std::string_view beginning) {
  return beginning.find("- timestamp:") < 200 && beginning.find("secs:") < 400 &&
         beginning.find("entry:") != beginning.npos;
}

OpenedRecording openRefereeLog(const std::vector<std::string>& files, const RecordingProgress&) {
  if (files.size() == 1) return RefereeLog::open(files.front());
  return failure(ErrorCode::InvalidArgument,
                 "Each log of a GameController is a match of its own. Import them one by one.",
                 files.back());
}

}  // namespace pitchboard::telemetry
