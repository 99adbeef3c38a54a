// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/attached_robots.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/frame/belief.h>
#include <robotlink/live/board_columns.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto lookInterval = 100ms;        // is it still the segment of this key?
constexpr std::size_t mostRows = 4096;      // waiting; older ones are lost, counted
constexpr double flagMemory = 1.0;          // s, as in the frames of a running match
constexpr int attachedStep = 65536 * 1000;  // ids that no robot and no second sender can have

Error problem(std::string sentence, std::string_view part) {
  return {ErrorCode::InvalidArgument, std::move(sentence), "--attach " + std::string(part)};
}

template <class Number>
bool readNumber(std::string_view text, Number& out) {
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), out);
  return code == std::errc{} && stop == text.data() + text.size();
}

struct Map {
  VariableCatalog catalog;
  SegmentLayout layout;
};

Result<Map> mapOf(const AttachedBoard& board) {
  SegmentLayout layout;
  if (board.bytes != 0) layout.bytes = board.bytes;
  const bool isPublished = board.catalogFile.empty();
  Result<VariableCatalog> catalog = isPublished
                                        ? Result<VariableCatalog>(VariableCatalog::published())
                                        : VariableCatalog::fromFile(board.catalogFile, layout);
  if (!catalog) return tl::unexpected(catalog.error());
  if (board.bytes != 0 && layout.bytes != board.bytes) {
    return failure(ErrorCode::Conflict,
                   "says " + std::to_string(layout.bytes) + " bytes, but the size asked for is " +
                       std::to_string(board.bytes),
                   board.catalogFile);
  }
  for (const Variable& variable : catalog->variables()) {
    const int offset = variable.type == VariableType::Int ? 0 : layout.floatOffset;
    if (variable.index + offset < layout.words()) continue;
    return failure(ErrorCode::Conflict,
                   variable.name + " lies beyond the " + std::to_string(layout.bytes) +
                       " bytes of the segment; give the catalog that belongs to it",
                   isPublished ? "the published map" : board.catalogFile);
  }
  return Map{std::move(*catalog), layout};
}

}  // namespace

Result<AttachedBoard> parseAttachedBoard(std::string_view text) {
  AttachedBoard board;
  bool isFirst = true;
  while (isFirst || !text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view part = text.substr(0, comma);
    text.remove_prefix(std::min(comma + 1, text.size()));
    const std::size_t equals = part.find('=');
    const std::string_view name = part.substr(0, equals);
    const std::string_view value = equals == part.npos ? "" : part.substr(equals + 1);
    bool good = false;
    if (std::exchange(isFirst, false)) {
      good = readNumber(part, board.key);
    } else if (name == "catalog") {
      board.catalogFile = value;
      good = !value.empty();
    } else if (name == "size") {
      good = readNumber(value, board.bytes) && board.bytes > 0;
    } else if (name == "robot") {
      good = readNumber(value, board.robot) && board.robot > 0;
    } else if (name == "rate") {
      good = readNumber(value, board.rate);
    } else if (name == "team") {
      for (const TeamColorInfo& known : teamColors) {
        if (known.name != value) continue;
        board.team = known.color;
        good = true;
      }
    }
    if (!good) {
      return tl::unexpected(
          problem("is not understood; write KEY[,catalog=FILE][,size=BYTES][,robot=N][,rate=R]"
                  "[,team=COLOUR], such as 100,catalog=blackboard.h,robot=3",
                  part));
    }
  }
  if (const auto valid = validate(std::vector{board}); !valid) return tl::unexpected(valid.error());
  return board;
}

Result<void> validate(const std::vector<AttachedBoard>& boards) {
  std::set<int> keys;
  for (const AttachedBoard& board : boards) {
    const std::string key = std::to_string(board.key);
    if (board.key <= 0) return tl::unexpected(problem("a key is a positive number", key));
    if (!keys.insert(board.key).second) {
      return tl::unexpected(problem("this key is attached twice", key));
    }
    if (!(board.rate >= AttachedBoard::slowest && board.rate <= AttachedBoard::fastest)) {
      return tl::unexpected(problem("the rate must lie between 0.1 and 1000 a second", key));
    }
    if (board.robot < 0 || board.robot > 999) {
      return tl::unexpected(problem("the number of a robot is from 1 to 999", key));
    }
    if (board.bytes % 4 != 0 || board.bytes > SegmentLayout::mostBytes) {
      return tl::unexpected(problem("the size is a multiple of 4, at most 1 MiB", key));
    }
    if (const auto map = mapOf(board); !map) return tl::unexpected(map.error());
  }
  return {};
}

class AttachedRobots::Reader {
 public:
  Reader(const AttachedBoard& board, Map map, std::function<double()> seconds)
      : m_board(board),
        m_map(std::move(map)),
        m_columns(m_map.catalog),
        m_seconds(std::move(seconds)) {
    sim::RobotIdentity identity;
    identity.team = board.team;
    identity.number = board.number();
    m_group = {identity.name() + " key " + std::to_string(board.key),
               m_columns.columns(),
               {{"key", std::to_string(board.key)},
                {"attached", "1"},
                {"robot", std::to_string(board.number())},
                {"number", std::to_string(board.number())},
                {"team", std::string(info(board.team).name)}}};
    for (const Variable& variable : m_map.catalog.variables()) {
      const int offset = variable.type == VariableType::Int ? 0 : m_map.layout.floatOffset;
      m_places.push_back(static_cast<std::size_t>(variable.index + offset));
    }
    for (std::size_t i = 0; i < names.size(); ++i) m_wanted[i] = columnNamed(names[i]);
    m_seen.fill(-1e9);
    m_thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  const AttachedBoard& board() const { return m_board; }
  const telemetry::GroupInfo& group() const { return m_group; }

  AttachedStatus status() const {
    const std::lock_guard lock(m_mutex);
    return m_status;
  }

  std::vector<BoardRow> takeRows() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_rows, {});
  }

  void addTo(MatchFrame& frame) const {
    const std::lock_guard lock(m_mutex);
    if (m_newest.words.empty()) return;
    RobotFrame& robot = frame.robots.emplace_back();
    robot.identity.number = m_board.number();
    robot.identity.team = m_board.team;
    robot.identity.id = RobotId{m_board.number() + attachedStep};
    while (isTaken(frame, robot.identity.id)) robot.identity.id.value += 1000;
    RobotHealth& health = robot.health.emplace();
    const double age = std::max(0.0, m_seconds() - m_newest.time);
    health.age =
        std::chrono::duration_cast<telemetry::Duration>(std::chrono::duration<double>(age));
    health.messages = m_status.samples;
    health.rate = m_status.attached ? m_board.rate : 0.0;
    health.timedOut = !m_status.attached;
    robot.board = boardView(health.timedOut);
    fillHealth(frame.field, robot, health);
  }

 private:
  enum Wanted : std::size_t {
    ActionA,
    Voltage,
    Lost,
    BallDist,
    Pan,
    LocX,
    LocY,
    LocTheta,
    Belief,
    Control,
    Vision,
    Localization,
    Decision,
    Imu,
    wantedCount
  };
  static constexpr std::array<std::string_view, wantedCount> names{
      "DECISION_ACTION_A",    "VOLTAGE",         "VISION_LOST",    "VISION_BALL_DIST",
      "VISION_PAN_DEG",       "LOCALIZATION_X",  "LOCALIZATION_Y", "LOCALIZATION_THETA",
      "LOCALIZATION_RBT01_X", "CONTROL_WORKING", "VISION_WORKING", "LOCALIZATION_WORKING",
      "DECISION_WORKING",     "IMU_WORKING"};

  static bool isTaken(const MatchFrame& frame, RobotId id) {
    return std::count_if(frame.robots.begin(), frame.robots.end(),
                         [id](const RobotFrame& robot) { return robot.id() == id; }) > 1;
  }

  std::optional<std::size_t> columnNamed(std::string_view name) const {
    const auto& columns = m_columns.columns();
    const auto found = std::find_if(columns.begin(), columns.end(),
                                    [name](const auto& column) { return column.name == name; });
    if (found == columns.end()) return std::nullopt;
    return static_cast<std::size_t>(found - columns.begin());
  }

  /// Of the newest sample; 0 for what the catalog does not have.
  double value(Wanted wanted) const {
    const auto place = m_wanted[wanted];
    if (!place) return 0.0;
    const std::uint32_t word = m_newest.words[*place];
    if (m_columns.columns()[*place].type == telemetry::ColumnType::Int32) {
      return std::bit_cast<std::int32_t>(word);
    }
    const auto real = static_cast<double>(std::bit_cast<float>(word));
    return std::isfinite(real) ? real : 0.0;
  }
  int whole(Wanted wanted) const {
    return static_cast<int>(std::clamp(value(wanted), -2147483648.0, 2147483647.0));
  }

  RobotBoardView boardView(bool gone) const {
    RobotBoardView view;
    view.key = m_board.key;
    view.actionA = whole(ActionA);
    view.voltage = whole(Voltage);
    view.visionLost = whole(Lost) != 0;
    view.ballDistCm = static_cast<float>(value(BallDist));
    view.panDeg = static_cast<float>(value(Pan));
    view.localizationX = whole(LocX);
    view.localizationY = whole(LocY);
    view.localizationTheta = whole(LocTheta);
    view.belief = static_cast<float>(value(Belief));
    const auto works = [&](Wanted flag) {
      return !gone && m_newest.time - m_seen[flag - Control] <= flagMemory;
    };
    view.controlWorking = works(Control);
    view.visionWorking = works(Vision);
    view.localizationWorking = works(Localization);
    view.decisionWorking = works(Decision);
    view.imuWorking = works(Imu);
    return view;
  }

  void fillHealth(const sim::FieldSpec& field, RobotFrame& robot, RobotHealth& health) const {
    constexpr std::array<bool RobotBoardView::*, telemetry::processCount> works{
        &RobotBoardView::controlWorking, &RobotBoardView::visionWorking,
        &RobotBoardView::localizationWorking, &RobotBoardView::decisionWorking,
        &RobotBoardView::imuWorking};
    for (std::size_t i = 0; i < works.size(); ++i) {
      if (health.timedOut || !m_wanted[Control + i]) continue;
      health.processes[i].state = (*robot.board).*works[i] ? telemetry::ProcessState::Working
                                                           : telemetry::ProcessState::Silent;
    }
    health.action = robot.board->actionA;
    robot.action = robot.board->actionA;
    if (robot.board->voltage > 0) {
      health.battery = telemetry::batteryAt(robot.board->voltage / 10.0, telemetry::usualBattery);
    }
    health.poseKnown = m_wanted[LocX] && m_wanted[LocY];
    if (!health.poseKnown) return;
    robot.pose = sim::published_frame::studioFromLocalization(
        field, {value(LocX), value(LocY), value(LocTheta)});
    robot.headYaw = robot.pose.yaw;
    if (robot.board->visionWorking && !robot.board->visionLost) {
      health.ball = ballSeenFrom(robot.pose, value(BallDist), value(Pan), field);
    }
  }

  void run(const std::stop_token& stop) {
    const auto period = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(1.0 / m_board.rate));
    std::optional<SegmentView> view;
    auto due = Clock::now(), nextLook = due;
    std::mutex idle;
    std::condition_variable_any ending;
    std::unique_lock idling(idle);
    while (!stop.stop_requested()) {
      auto now = Clock::now();
      if (now >= nextLook) {
        nextLook = now + lookInterval;
        look(view);
      }
      if (view && now >= due) {
        sample(*view);
        due += period;
        if (now > due) {
          const auto late = (now - due) / period + 1;
          due += period * late;
          const std::lock_guard lock(m_mutex);
          m_status.missed += static_cast<std::uint64_t>(late);
        }
      }
      const auto wake = view ? std::min(due, nextLook) : nextLook;
      ending.wait_until(idling, stop, wake, [] { return false; });
      if (!view) due = Clock::now();
    }
  }

  /// Takes the segment up, or lets it go.
  void look(std::optional<SegmentView>& view) {
    if (view && view->isThere()) return;
    const bool had = view.has_value();
    view.reset();
    auto attached = SegmentView::attach(m_board.key, m_map.layout.bytes);
    const std::lock_guard lock(m_mutex);
    m_status.attached = attached.has_value();
    if (attached) {
      view.emplace(std::move(*attached));
      m_status.problem.clear();
    } else if (had || m_status.samples > 0) {
      m_status.problem = "Segment " + std::to_string(m_board.key) +
                         " was removed; it is taken up when it comes again.";
    } else {
      m_status.problem = attached.error().text();
    }
  }

  void sample(const SegmentView& view) {
    BoardRow row;
    row.time = m_seconds();
    row.words.reserve(m_places.size());
    for (const std::size_t place : m_places) row.words.push_back(view.word(place));
    const std::lock_guard lock(m_mutex);
    m_newest = row;
    for (std::size_t i = 0; i < m_seen.size(); ++i) {
      if (value(static_cast<Wanted>(Control + i)) != 0.0) m_seen[i] = row.time;
    }
    if (m_rows.size() == mostRows) {
      m_rows.erase(m_rows.begin(), m_rows.begin() + mostRows / 4);
      m_status.missed += mostRows / 4;
    }
    m_rows.push_back(std::move(row));
    ++m_status.samples;
  }

  const AttachedBoard m_board;
  const Map m_map;
  const BoardColumns m_columns;
  const std::function<double()> m_seconds;
  telemetry::GroupInfo m_group;
  std::vector<std::size_t> m_places;  // words of the columns
  std::array<std::optional<std::size_t>, wantedCount> m_wanted;

  mutable std::mutex m_mutex;  // of what follows
  AttachedStatus m_status{m_board, false, {}, 0, 0};
  BoardRow m_newest;
  std::array<double, telemetry::processCount> m_seen{};  // when each flag was set last
  std::vector<BoardRow> m_rows;
  std::jthread m_thread;  // last: it uses all of the above
};

AttachedRobots::AttachedRobots(std::function<double()> seconds) : m_seconds(std::move(seconds)) {}
AttachedRobots::~AttachedRobots() = default;

void AttachedRobots::set(const std::vector<AttachedBoard>& boards) {
  std::erase_if(m_readers, [&boards](const auto& reader) {
    return std::find(boards.begin(), boards.end(), reader->board()) == boards.end();
  });
  for (const AttachedBoard& board : boards) {
    const auto known = std::find_if(m_readers.begin(), m_readers.end(),
                                    [&](const auto& reader) { return reader->board() == board; });
    if (known != m_readers.end()) continue;
    if (auto map = mapOf(board)) {
      m_readers.push_back(std::make_unique<Reader>(board, std::move(*map), m_seconds));
    }
  }
}

void AttachedRobots::addTo(MatchFrame& frame) const {
  for (const auto& reader : m_readers) reader->addTo(frame);
}

void AttachedRobots::takeRows(const BoardRowsTaker& take) {
  for (const auto& reader : m_readers) {
    const std::vector<BoardRow> rows = reader->takeRows();
    if (!rows.empty()) take(reader->group(), rows);
  }
}

std::vector<AttachedStatus> AttachedRobots::status() const {
  std::vector<AttachedStatus> all;
  for (const auto& reader : m_readers) all.push_back(reader->status());
  return all;
}

void BoardRowKeeper::take(const telemetry::GroupInfo& group, std::span<const BoardRow> rows) {
  const auto [known, isNew] = m_groups.try_emplace(group.name);
  if (isNew) known->second = m_sink->addGroup(group);
  for (const BoardRow& row : rows) m_sink->append(known->second, {row.time, row.words, {}});
}

}  // namespace pitchboard::link
