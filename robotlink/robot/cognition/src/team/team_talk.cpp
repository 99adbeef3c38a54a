// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_makers.h"

#include <charconv>
#include <cmath>
#include <tuple>

#include <base/repeatable_math.h>
#include <base/try.h>
#include "team/team_variables.h"

namespace pitchboard::link {
namespace {

constexpr double talkPeriod = 0.2;   // s
constexpr double mateTimeout = 3.0;  // s after which a team-mate is unknown
constexpr std::string_view header = "PB1";

// One extended team message: "PB1 robot x y theta belief intention state ball", whole numbers; x, y
// and belief in cm, theta in degrees (LOCALIZATION frame), ball packed as in team_variables.h.
struct TeamMessage {
  int robot = 0, x = 0, y = 0, theta = 0, belief = 0, intention = 0, state = 0, ball = -1;

  std::string text() const {
    std::string out(header);
    for (const int value : {robot, x, y, theta, belief, intention, state, ball}) {
      out += ' ';
      out += std::to_string(value);
    }
    return out;
  }

  static std::optional<TeamMessage> parse(std::string_view text) {
    if (text.substr(0, header.size()) != header) return std::nullopt;
    TeamMessage m;
    const char* p = text.data() + header.size();
    const char* const end = text.data() + text.size();
    for (int* value :
         {&m.robot, &m.x, &m.y, &m.theta, &m.belief, &m.intention, &m.state, &m.ball}) {
      if (p == end || *p != ' ') return std::nullopt;
      const auto [next, error] = std::from_chars(p + 1, end, *value);
      if (error != std::errc{}) return std::nullopt;
      p = next;
    }
    if (p != end || m.robot < 1 || m.robot > 64) return std::nullopt;
    return m;
  }
};

int whole(float value) {
  return std::isfinite(value) ? static_cast<int>(std::clamp(value, -1e6F, 1e6F)) : -1;
}

// Five times a second: posts where this robot, its ball and its intention are, and writes what the
// others posted: the places of up to ten team-mates to LOCALIZATION_RBT02.._RBT11, and all of the
// three that matter most to COM_*_ROBOT1..3, both in the order of their numbers. Those who go for
// the ball matter most, then those who see it, then the nearest.
class TeamTalk final : public CognitiveProcess {
 public:
  TeamTalk(RobotId robot, std::shared_ptr<TeamChannel> channel)
      : m_robot(robot), m_channel(std::move(channel)) {}

  void step(Blackboard& board, const Clock& clock) override {
    m_channel->post(m_robot, ownMessage(board).text());
    for (const std::string& text : m_channel->take(m_robot)) {
      if (const auto message = TeamMessage::parse(text)) receive(*message, clock.seconds);
    }
    std::erase_if(m_mates,
                  [&](const Mate& mate) { return clock.seconds - mate.received > mateTimeout; });
    writePlaces(board);
    const std::vector<const TeamMessage*> chosen = mostImportant(board);
    for (std::size_t i = 0; i < maxTeamMates; ++i) {
      write(board, i, i < chosen.size() ? chosen[i] : nullptr);
    }
  }

  double period() const override { return talkPeriod; }

  std::unique_ptr<const CognitiveProcess> remembered() const override {
    auto memory = std::make_unique<TeamTalk>(*this);
    memory->m_channel.reset();
    return memory;
  }

  bool restore(const CognitiveProcess& memory) override {
    const auto* other = dynamic_cast<const TeamTalk*>(&memory);
    if (other) m_mates = other->m_mates;
    return other != nullptr;
  }

 private:
  struct Mate {
    TeamMessage message;
    double received = 0.0;
  };

  TeamMessage ownMessage(const Blackboard& board) const {
    const RobotVariables& v = m_variables;
    TeamMessage m;
    m.robot = m_robot.value;
    m.x = board.read(v.localizationX);
    m.y = board.read(v.localizationY);
    m.theta = board.read(v.localizationTheta);
    m.belief = whole(board.read(v.localizationBelief));
    m.intention = readOr(board, m_team.intention);
    m.state = static_cast<int>(board.read(v.imuState) == 0 ? MateState::Active : MateState::Down);
    const int x = whole(readOr(board, m_team.ballX, -1.0F));
    const int y = whole(readOr(board, m_team.ballY, -1.0F));
    // Zeros mean that no ball was written yet.
    const bool known = x >= 0 && y >= 0 && m.intention != static_cast<int>(Intention::None);
    m.ball = known ? packPlace(x, y) : -1;
    return m;
  }

  void receive(const TeamMessage& message, double now) {
    if (message.robot == m_robot.value) return;
    auto mate = std::ranges::find_if(
        m_mates, [&](const Mate& known) { return known.message.robot >= message.robot; });
    if (mate == m_mates.end() || mate->message.robot != message.robot) {
      mate = m_mates.insert(mate, Mate{});
      if (m_mates.size() > 64) return;
    }
    *mate = {message, now};
  }

  std::vector<const TeamMessage*> mostImportant(const Blackboard& board) const {
    std::vector<const TeamMessage*> all;
    for (const Mate& mate : m_mates) all.push_back(&mate.message);
    const int x = board.read(m_variables.localizationX), y = board.read(m_variables.localizationY);
    const auto rank = [x, y](const TeamMessage& m) {
      const bool attacks = m.intention == static_cast<int>(Intention::Ball);
      const double away =
          repeatable::hypot(static_cast<double>(m.x) - x, static_cast<double>(m.y) - y);
      return std::tuple(attacks ? 0 : 1, m.ball >= 0 ? 0 : 1, away, m.robot);
    };
    std::ranges::sort(
        all, [&](const TeamMessage* a, const TeamMessage* b) { return rank(*a) < rank(*b); });
    if (all.size() > maxTeamMates) all.resize(maxTeamMates);
    std::ranges::sort(
        all, [](const TeamMessage* a, const TeamMessage* b) { return a->robot < b->robot; });
    return all;
  }

  void writePlaces(Blackboard& board) const {
    for (std::size_t i = 0; i < maxMatePlaces; ++i) {
      const bool known = i < m_mates.size();
      const TeamMessage m = known ? m_mates[i].message : TeamMessage{};
      writeIfPresent(board, m_team.mateX[i], known ? static_cast<float>(m.x) : -1.0F);
      writeIfPresent(board, m_team.mateY[i], known ? static_cast<float>(m.y) : -1.0F);
    }
  }

  void write(Blackboard& board, std::size_t i, const TeamMessage* message) const {
    const bool known = message != nullptr;
    const TeamMessage m = known ? *message : TeamMessage{};
    writeIfPresent(board, m_team.state[i], m.state);
    writeIfPresent(board, m_team.action[i], m.intention);
    writeIfPresent(board, m_team.place[i], known ? packPlace(m.x, m.y) : -1);
    writeIfPresent(board, m_team.ball[i], m.ball);
  }

  RobotId m_robot;
  std::shared_ptr<TeamChannel> m_channel;
  RobotVariables m_variables;
  TeamVariables m_team;
  std::vector<Mate> m_mates;  // by robot number
};

}  // namespace

TeamVariables::TeamVariables() {
  static const TeamVariables all(LookedUp{});  // names are looked up once
  *this = all;
}

TeamVariables::TeamVariables(LookedUp /*look*/) {
  const VariableCatalog& catalog = VariableCatalog::published();
  const auto intVar = [&catalog](const std::string& name) {
    return catalog.intVar(name).value_or(IntVar{-1});
  };
  const auto floatVar = [&catalog](const std::string& name) {
    return catalog.floatVar(name).value_or(FloatVar{-1});
  };
  intention = intVar("DECISION_STATE");
  targetX = intVar("DECISION_POSITION_A");
  targetY = intVar("DECISION_POSITION_B");
  ballX = floatVar("LOCALIZATION_BALL_X");
  ballY = floatVar("LOCALIZATION_BALL_Y");
  for (std::size_t i = 0; i < maxTeamMates; ++i) {
    const std::string n = std::to_string(i + 1);
    state[i] = intVar("COM_STATE_ROBOT" + n);
    action[i] = intVar("COM_ACTION_ROBOT" + n);
    place[i] = intVar("COM_POS_ROBOT" + n);
    ball[i] = intVar("COM_POS_BALL_ROBOT" + n);
  }
  const auto nameOf = [](const char* kind, std::size_t number) {
    const std::string n = std::to_string(number);
    return "LOCALIZATION_" + std::string(kind) + (n.size() < 2 ? "0" : "") + n;
  };
  for (std::size_t i = 0; i < maxMatePlaces; ++i) {
    mateX[i] = floatVar(nameOf("RBT", i + 2) + "_X");
    mateY[i] = floatVar(nameOf("RBT", i + 2) + "_Y");
  }
  for (std::size_t i = 0; i < maxOpponents; ++i) {
    opponentX[i] = floatVar(nameOf("OPP", i + 1) + "_X");
    opponentY[i] = floatVar(nameOf("OPP", i + 1) + "_Y");
  }
}

Result<std::unique_ptr<CognitiveProcess>> makeTeamTalk(const ProcessOptions& options) {
  std::shared_ptr<TeamChannel> channel = options.teamChannel;
  if (!channel) {
    auto udp = TRY(makeUdpTeamChannel(options.udpAddress, options.team, options.channelPortBase));
    channel = options.lockStepSlot ? makeLockStepChannel(options.lockStepSlot, std::move(udp))
                                   : std::move(udp);
  }
  return std::make_unique<TeamTalk>(options.robot, std::move(channel));
}

}  // namespace pitchboard::link
