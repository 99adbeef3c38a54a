// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <set>
#include <utility>

#include <base/lined_json.h>
#include <base/try.h>

#include "board_map.h"

namespace pitchboard::link {
namespace {

Error problem(std::string sentence, std::string_view part) {
  return {ErrorCode::InvalidArgument, std::move(sentence), "--attach " + std::string(part)};
}

template <class Number>
bool readNumber(std::string_view text, Number& out) {
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), out);
  return code == std::errc{} && stop == text.data() + text.size();
}

}  // namespace

Result<BoardMap> mapOf(const AttachedBoard& board, const VariableCatalog& usual) {
  SegmentLayout layout;
  if (board.bytes != 0) layout.bytes = board.bytes;
  const bool isPublished = board.catalogFile.empty();
  VariableCatalog catalog = TRY(isPublished ? Result<VariableCatalog>(usual)
                                            : VariableCatalog::fromFile(board.catalogFile, layout));
  if (board.bytes != 0 && layout.bytes != board.bytes) {
    return failure(ErrorCode::Conflict,
                   "says " + std::to_string(layout.bytes) + " bytes, but the size asked for is " +
                       std::to_string(board.bytes),
                   board.catalogFile);
  }
  for (const Variable& variable : catalog.variables()) {
    const int offset = variable.type == VariableType::Int ? 0 : layout.floatOffset;
    if (variable.index + offset < layout.words()) continue;
    return failure(ErrorCode::Conflict,
                   variable.name + " lies beyond the " + std::to_string(layout.bytes) +
                       " bytes of the segment; give the catalog that belongs to it",
                   isPublished ? "the published map" : board.catalogFile);
  }
  return BoardMap{std::move(catalog), layout};
}

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
      const auto team = teamColorNamed(value);
      good = team.has_value();
      board.team = team.value_or(board.team);
    }
    if (!good) {
      return tl::unexpected(
          problem("is not valid; write KEY[,catalog=FILE][,size=BYTES][,robot=N][,rate=R]"
                  "[,team=COLOUR], such as 100,catalog=blackboard.h,robot=3",
                  part));
    }
  }
  TRY(validate(std::vector{board}));
  return board;
}

Result<void> validate(const std::vector<AttachedBoard>& boards) {
  std::set<int> keys;
  for (const AttachedBoard& board : boards) {
    const std::string key = std::to_string(board.key);
    if (board.key <= 0) return tl::unexpected(problem("a key must be a positive number", key));
    if (!keys.insert(board.key).second) {
      return tl::unexpected(problem("this key is attached twice", key));
    }
    if (!(board.rate >= AttachedBoard::slowest && board.rate <= AttachedBoard::fastest)) {
      return tl::unexpected(problem("the rate must lie between 0.1 and 1000 a second", key));
    }
    if (board.robot < 0 || board.robot > 999) {
      return tl::unexpected(problem("a robot number must be 1 to 999", key));
    }
    if (board.bytes % 4 != 0 || board.bytes > SegmentLayout::maxBytes) {
      return tl::unexpected(problem("the size must be a multiple of 4, at most 1 MiB", key));
    }
    TRY(mapOf(board));
  }
  return {};
}

std::string attachedBoardText(const AttachedBoard& board) {
  std::string text = std::to_string(board.key);
  if (!board.catalogFile.empty()) text += ",catalog=" + board.catalogFile;
  if (board.bytes != 0) text += ",size=" + std::to_string(board.bytes);
  if (board.robot != 0) text += ",robot=" + std::to_string(board.robot);
  if (board.rate != AttachedBoard().rate) text += ",rate=" + shortest(board.rate);
  if (board.team != AttachedBoard().team) text += ",team=" + std::string(info(board.team).name);
  return text;
}

std::vector<std::string> boardNames(const std::vector<AttachedBoard>& boards,
                                    const std::vector<std::string>& taken) {
  std::vector<std::string> names;
  for (const AttachedBoard& board : boards) {
    sim::RobotIdentity identity;
    identity.team = board.team;
    identity.number = board.number();
    std::string name = identity.name();
    if (std::ranges::find(names, name) != names.end() ||
        std::ranges::find(taken, name) != taken.end()) {
      name += " key " + std::to_string(board.key);
    }
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace pitchboard::link
