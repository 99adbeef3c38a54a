// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/attached_boards.h>

#include <algorithm>

#include <robotlink/live/attached_robots.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_memory.h>

namespace pitchboard::ui {

AttachedBoards::AttachedBoards(MatchController* controller, QObject* parent)
    : QObject(parent), m_controller(controller) {
  connect(controller, &MatchController::restarted, this, &AttachedBoards::follow);
}

AttachedBoards::~AttachedBoards() = default;

// As in Live, unless a robot of the match has the name.
QString AttachedBoards::groupName(int key) const {
  link::AttachedBoard board;
  board.key = key;
  std::string name = link::boardNames({board}).front();
  const auto& robots = m_controller->scenario().robots;
  if (std::ranges::any_of(robots,
                          [&name](const auto& robot) { return robot.identity.name() == name; })) {
    name += " key " + std::to_string(key);
  }
  return QString::fromStdString(name);
}

Result<std::unique_ptr<link::BoardSampler>> AttachedBoards::start(int key, double rate) const {
  auto rows = m_controller->memory()->rowsBeside();
  if (!rows) {
    return failure(ErrorCode::NotFound,
                   "open a match first: what is sampled is kept beside its rows");
  }
  link::BoardSamplerOptions options;
  options.rate = rate;
  options.group = groupName(key).toStdString();
  return link::BoardSampler::start(key, std::move(rows), options, m_controller->catalog());
}

Result<void> AttachedBoards::attach(int key, double rate) {
  // Two samplers must not write one group: the old one ends first, and comes back if need be.
  const auto known = m_boards.find(key);
  if (known != m_boards.end()) known->second.sampler.reset();
  auto sampler = start(key, rate);
  if (!sampler) {
    if (known != m_boards.end()) {
      if (auto again = start(key, known->second.rate)) known->second.sampler = std::move(*again);
    }
    return tl::unexpected(sampler.error());
  }
  m_boards.insert_or_assign(key, Board{rate, std::move(*sampler), {}});
  emit changed();
  return {};
}

void AttachedBoards::detach(int key) {
  if (m_boards.erase(key) != 0) emit changed();
}

// Another match has rows of its own.
void AttachedBoards::follow() {
  for (auto& [key, board] : m_boards) {
    board.sampler.reset();
    auto sampler = start(key, board.rate);
    if (sampler) board.sampler = std::move(*sampler);
    board.problem = sampler ? std::string() : sampler.error().text();
  }
  emit changed();
}

std::map<int, link::BoardSamplerStatus> AttachedBoards::status() const {
  std::map<int, link::BoardSamplerStatus> all;
  for (const auto& [key, board] : m_boards) {
    if (board.sampler) {
      all.emplace(key, board.sampler->status());
    } else {
      link::BoardSamplerStatus waiting;
      waiting.message = board.problem;
      all.emplace(key, waiting);
    }
  }
  return all;
}

}  // namespace pitchboard::ui
