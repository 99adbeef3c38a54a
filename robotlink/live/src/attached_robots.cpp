// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/attached_robots.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include <base/lined_json.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/frame/join_boards.h>
#include <robotlink/live/board_columns.h>
#include <robotlink/live/board_facts.h>
#include <robotlink/live/robot_uids.h>

#include "board_map.h"
#include "board_meanings.h"

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto lookInterval = 100ms;  // is it still the segment of this key?
constexpr auto maxSleep = 50ms;       // so that stopping takes no longer
constexpr auto rateWindow = 1s;
constexpr std::size_t maxRows = 4096;  // waiting; older ones are lost, counted

}  // namespace

class AttachedRobots::Reader {
 public:
  Reader(const AttachedBoard& board, std::string name, AttachedTo place, BoardMap map,
         std::function<double()> seconds)
      : m_board(board),
        m_map(std::move(map)),
        m_columns(m_map.catalog),
        m_seconds(std::move(seconds)) {
    m_group = {std::move(name), m_columns.columns()};
    m_group.robot = place == AttachedTo::Live
                        ? factsOfBoard(board.key, board.rate, board.number(), board.team)
                        : factsOfBoard(board.key, board.rate);
    for (const Variable& variable : m_map.catalog.variables()) {
      const int offset = variable.type == VariableType::Int ? 0 : m_map.layout.floatOffset;
      m_places.push_back(static_cast<std::size_t>(variable.index + offset));
    }
    m_meanings = BoardMeanings(m_group.columns);
    m_thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  const AttachedBoard& board() const { return m_board; }
  const telemetry::GroupInfo& group() const { return m_group; }

  AttachedStatus status() const {
    const std::lock_guard lock(m_mutex);
    return m_status;
  }

  std::vector<BoardRow> drainRows() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_rows, {});
  }

  std::optional<RobotFrame> robot(const sim::FieldSpec& field,
                                  const telemetry::BatteryLimits& battery) const {
    const std::lock_guard lock(m_mutex);
    if (m_newest.words.empty()) return std::nullopt;
    RobotFrame robot;
    robot.uid = uidOfBoard(m_board.key);
    robot.key = {placeByColour, m_board.number(), 0};
    robot.identity.number = m_board.number();
    robot.identity.team = m_board.team;
    robot.boardKey = m_board.key;
    const bool detached = !m_status.attached;
    robot.link = boardLink(std::max(0.0, m_seconds() - m_newest.time), m_board.rate, detached);
    robot.link->messages = m_status.samples;
    if (!detached) robot.lamps = m_lamps;
    buildRobot(m_meanings.reader(m_newest), field, battery, false, robot);
    robot.action = robot.decided.value_or(0);
    robot.board = m_meanings.contents(m_newest);
    robot.name = m_group.name;
    return robot;
  }

 private:
  void run(const std::stop_token& stop) {
    const auto period = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(1.0 / m_board.rate));
    std::optional<SegmentView> view;
    auto due = Clock::now(), nextLook = due, windowStart = due;
    std::uint64_t inWindow = 0;
    bool isFirst = true;
    while (!stop.stop_requested()) {
      auto now = Clock::now();
      if (now >= nextLook) {
        nextLook = now + lookInterval;
        look(view);
      }
      if (view && now >= due) {
        sample(*view);
        ++inWindow;
        due += period;
        if (now > due) {
          const auto late = (now - due) / period + 1;
          due += period * late;
          const std::lock_guard lock(m_mutex);
          m_status.missed += static_cast<std::uint64_t>(late);
        }
      }
      now = Clock::now();
      const auto elapsed = now - windowStart;
      if (elapsed >= rateWindow || (isFirst && elapsed > period)) {  // the first one as it grows
        const std::lock_guard lock(m_mutex);
        m_status.rate =
            static_cast<double>(inWindow) / std::chrono::duration<double>(elapsed).count();
      }
      if (elapsed >= rateWindow) {
        isFirst = false;
        windowStart = now;
        inWindow = 0;
      }
      // More even than a condition variable.
      std::this_thread::sleep_until(
          std::min(view ? std::min(due, nextLook) : nextLook, now + maxSleep));
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
                         " was removed; it will be attached again when it is back.";
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
    m_lamps = m_works.note(m_meanings.reader(m_newest), row.time);
    m_columns.makeHoles(row.words);
    if (m_rows.size() == maxRows) {
      m_rows.erase(m_rows.begin(), m_rows.begin() + maxRows / 4);
      m_status.missed += maxRows / 4;
    }
    m_rows.push_back(std::move(row));
    ++m_status.samples;
  }

  const AttachedBoard m_board;
  const BoardMap m_map;
  const BoardColumns m_columns;
  const std::function<double()> m_seconds;
  telemetry::GroupInfo m_group;
  std::vector<std::size_t> m_places;  // words of the columns
  BoardMeanings m_meanings;

  mutable std::mutex m_mutex;  // of what follows
  AttachedStatus m_status{m_board, false, {}, 0, 0, 0.0};
  BoardRow m_newest;
  LampMemory m_works;
  LampMemory::Lamps m_lamps{};
  std::vector<BoardRow> m_rows;
  std::jthread m_thread;  // last: it uses all of the above
};

telemetry::LinkHealth boardLink(double age, double rate, bool detached) {
  telemetry::LinkHealth link;
  link.age = std::chrono::duration_cast<telemetry::Duration>(std::chrono::duration<double>(age));
  link.rate = detached ? 0.0 : rate;
  link.timedOut = detached;
  return link;
}

AttachedRobots::AttachedRobots(std::function<double()> seconds, AttachedTo place,
                               VariableCatalog catalog)
    : m_seconds(std::move(seconds)), m_place(place), m_catalog(std::move(catalog)) {}
AttachedRobots::~AttachedRobots() = default;

void AttachedRobots::set(const std::vector<AttachedBoard>& boards,
                         const std::vector<std::string>& taken) {
  std::erase_if(m_readers, [&boards](const auto& reader) {
    return std::find(boards.begin(), boards.end(), reader->board()) == boards.end();
  });
  const std::vector<std::string> names = boardNames(boards, taken);
  for (std::size_t i = 0; i < boards.size(); ++i) {
    if (std::ranges::any_of(m_readers, [&](const auto& reader) {
          return reader->board() == boards[i] && reader->group().name == names[i];
        })) {
      continue;
    }
    // A board with another name starts over.
    std::erase_if(m_readers, [&](const auto& reader) { return reader->board() == boards[i]; });
    if (auto map = mapOf(boards[i], m_catalog)) {
      m_readers.push_back(
          std::make_unique<Reader>(boards[i], names[i], m_place, std::move(*map), m_seconds));
    }
  }
}

std::vector<RobotFrame> AttachedRobots::robots(const sim::FieldSpec& field,
                                               const telemetry::BatteryLimits& battery) const {
  std::vector<RobotFrame> all;
  for (const auto& reader : m_readers) {
    if (auto robot = reader->robot(field, battery)) all.push_back(std::move(*robot));
  }
  return all;
}

void AttachedRobots::drainRows(const BoardRowsTaker& take) {
  for (const auto& reader : m_readers) {
    const std::vector<BoardRow> rows = reader->drainRows();
    if (!rows.empty()) take(reader->group(), rows);
  }
}

std::vector<AttachedStatus> AttachedRobots::status() const {
  std::vector<AttachedStatus> all;
  for (const auto& reader : m_readers) all.push_back(reader->status());
  return all;
}

void BoardRowKeeper::Known::describe(const Facts& facts) {
  info.name = facts.name;
  info.robot = own;
  const telemetry::RobotFacts& now = facts.robot;
  telemetry::RobotFacts& robot = own ? *info.robot : info.robot.emplace();
  if (now.uid != RobotUid{}) robot.uid = now.uid;
  if (now.team) robot.team = now.team;
  if (now.order) robot.order = now.order;
  if (now.place) robot.place = now.place;
  if (now.battery) robot.battery = now.battery;
  if (!now.name.empty()) robot.name = now.name;
  if (!now.linkOf.empty()) robot.linkOf = now.linkOf;
  if (!now.sentFrom.empty()) robot.sentFrom = now.sentFrom;
}

void BoardRowKeeper::take(const std::string& id, const telemetry::GroupInfo& group,
                          const Facts& facts, std::span<const BoardRow> rows) {
  const auto [entry, isNew] = m_groups.try_emplace(id.empty() ? group.name : id);
  Known& known = entry->second;
  if (isNew || known.info.columns != group.columns || known.own != group.robot) {
    known.info = group;
    known.info.id = id;
    known.own = group.robot;
    known.describe(facts);
    known.id = m_sink->addGroup(known.info);
  }
  for (const BoardRow& row : rows) m_sink->append(known.id, {row.time, row.words, row.values});
}

void BoardRowKeeper::describe(const std::map<std::string, Facts>& facts) {
  std::set<std::string> taken;
  for (const auto& [id, now] : facts) taken.insert(now.name);
  std::vector<telemetry::GroupInfo> changed;
  for (auto& [id, known] : m_groups) {
    const telemetry::GroupInfo before = known.info;
    const auto now = facts.find(id);
    if (now == facts.end())
      known.info.name = earlierName(known.info.name, taken);
    else
      known.describe(now->second);
    if (known.info != before) changed.push_back(known.info);
  }
  if (!changed.empty()) m_sink->describeGroups(changed);
}

}  // namespace pitchboard::link
