// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/attached_boards.h>

#include <algorithm>

#include <base/try.h>
#include <robotlink/blackboard/system_v.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_memory.h>

namespace pitchboard::ui {
namespace {
constexpr int takeInterval = 20;  // ms
const char* const noMatch = "open a match first: what is sampled is kept beside its rows";
}  // namespace

AttachedBoards::AttachedBoards(MatchController* controller, QObject* parent)
    : QObject(parent), m_controller(controller) {
  connect(controller, &MatchController::restarted, this, &AttachedBoards::follow);
  connect(&m_take, &QTimer::timeout, this, [this] {
    m_robots->takeRows([this](telemetry::GroupInfo group, auto rows) {
      // It is none of the robots of the match, even if it has the number of one.
      for (const char* ofRobots : {"robot", "number", "team"}) group.attributes.erase(ofRobots);
      m_rows->take(group, rows);
    });
  });
}

AttachedBoards::~AttachedBoards() = default;

Result<void> AttachedBoards::attach(int key, double rate) {
  link::AttachedBoard board;
  board.key = key;
  board.rate = rate;
  TRY(link::validate({board}));
  TRY(link::SegmentView::attach(key, link::SegmentLayout().bytes));
  if (!m_controller->memory()->rowsBeside()) return failure(ErrorCode::NotFound, noMatch);
  detach(key);
  m_boards.push_back(board);
  m_robots ? set() : follow();
  return {};
}

void AttachedBoards::detach(int key) {
  if (std::erase_if(m_boards, [key](const auto& board) { return board.key == key; }) != 0) set();
}

bool AttachedBoards::contains(int key) const {
  return std::ranges::find(m_boards, key, &link::AttachedBoard::key) != m_boards.end();
}

// Another match has rows and a catalog of its own.
void AttachedBoards::follow() {
  m_take.stop();
  m_robots.reset();
  const MatchMemory* memory = m_controller->memory();
  auto rows = memory->rowsBeside();
  if (rows) {
    m_rows = std::make_unique<link::BoardRowKeeper>(std::move(rows));
    m_robots =
        std::make_unique<link::AttachedRobots>(memory->timeBeside(), m_controller->catalog());
  }
  set();
}

void AttachedBoards::set() {
  std::vector<std::string> taken;
  for (const auto& robot : m_controller->scenario().robots) taken.push_back(robot.identity.name());
  const std::vector<std::string> names = link::boardNames(m_boards, taken);
  for (std::size_t i = 0; i < names.size(); ++i) {
    m_names[m_boards[i].key] = QString::fromStdString(names[i]);
  }
  if (m_robots) m_robots->set(m_boards, taken);
  if (m_robots && !m_boards.empty()) {
    m_take.start(takeInterval);
  } else {
    m_take.stop();
  }
}

std::vector<link::AttachedStatus> AttachedBoards::status() const {
  if (m_robots) return m_robots->status();
  std::vector<link::AttachedStatus> all;
  for (const link::AttachedBoard& board : m_boards) all.push_back({board, false, noMatch});
  return all;
}

}  // namespace pitchboard::ui
