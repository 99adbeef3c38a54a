// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/attached_boards.h>

#include <algorithm>

#include <base/try.h>
#include <robotlink/blackboard/system_v.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/live_settings.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {

AttachedBoards::AttachedBoards(MatchController* match, LiveController* live, ShownMoment* shown,
                               QSettings* settings, QObject* parent)
    : QObject(parent), m_match(match), m_live(live), m_shown(shown), m_settings(settings) {
  connect(match, &MatchController::restarted, this, &AttachedBoards::followMatch);
  connect(live, &LiveController::optionsChanged, this, &AttachedBoards::setBesideMatch);
  connect(&m_take, &QTimer::timeout, this, [this] {
    m_robots->drainRows([this](const auto& group, auto rows) { m_rows->take(group, rows); });
  });
  followMatch();
}

AttachedBoards::~AttachedBoards() = default;

const std::vector<link::AttachedBoard>& AttachedBoards::list() const {
  return m_live->options().boards;
}

Result<void> AttachedBoards::attach(const link::AttachedBoard& board) {
  std::vector<link::AttachedBoard> boards = list();
  std::erase_if(boards, [&board](const auto& known) { return known.key == board.key; });
  boards.push_back(board);
  TRY(link::validate(boards));
  use(boards);
  TRY(link::SegmentView::attach(board.key));
  return {};
}

void AttachedBoards::detach(int key) {
  std::vector<link::AttachedBoard> boards = list();
  std::erase_if(boards, [key](const auto& board) { return board.key == key; });
  use(boards);
}

void AttachedBoards::use(const std::vector<link::AttachedBoard>& boards) {
  link::LiveOptions options = m_live->options();
  options.boards = boards;
  m_live->setOptions(options);
  if (m_settings != nullptr) saveLiveOption(*m_settings, "boards", options);
}

std::vector<link::AttachedStatus> AttachedBoards::status() const {
  const bool besideMatch = m_robots && m_shown->source() == m_match;
  const bool isRead = besideMatch || m_live->isListening();
  const auto known = besideMatch ? m_robots->status() : m_live->details().boards;
  std::vector<link::AttachedStatus> all;
  for (const link::AttachedBoard& board : list()) {
    const auto found = std::ranges::find(known, board, &link::AttachedStatus::board);
    const std::string why = isRead ? "" : "Open a match or switch to Live to read it.";
    all.push_back(found != known.end() ? *found : link::AttachedStatus{board, false, why});
  }
  return all;
}

/// Another match has rows and a catalog of its own.
void AttachedBoards::followMatch() {
  m_take.stop();
  m_robots.reset();
  const MatchMemory* memory = m_match->memory();
  if (auto rows = memory->rowsBeside()) {
    m_rows = std::make_unique<link::BoardRowKeeper>(std::move(rows));
    m_robots = std::make_unique<link::AttachedRobots>(memory->timeBeside(), link::AttachedTo::Match,
                                                      m_match->catalog());
  }
  setBesideMatch();
}

void AttachedBoards::setBesideMatch() {
  constexpr int takeInterval = 20;  // ms
  if (!m_robots) return;
  std::vector<std::string> taken;
  for (const auto& robot : m_match->scenario().robots) taken.push_back(robot.identity.name());
  m_robots->set(list(), taken);
  if (list().empty())
    m_take.stop();
  else
    m_take.start(takeInterval);
}

}  // namespace pitchboard::ui
