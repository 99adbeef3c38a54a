// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/blackboard/cycle_words.h>

#include <linux/futex.h>
#include <sys/shm.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include <base/try.h>

namespace pitchboard::link {
namespace {

Result<IntVar> wordFrom(std::string_view text, std::string_view option) {
  int word = -1;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), word);
  const bool isNumber = code == std::errc() && end == text.data() + text.size();
  if (isNumber && word >= 0 && word < Blackboard::intVariables) return IntVar{word};
  return failure(ErrorCode::InvalidArgument, "a word of " + std::string(option) +
                                                 " is a number from 0 to 511, not \"" +
                                                 std::string(text.substr(0, 40)) + "\"");
}

Result<CycleWords> oneFrom(std::string_view text, std::string_view option) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  const bool isName = !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (equals == std::string_view::npos || !isName) {
    return failure(ErrorCode::InvalidArgument,
                   std::string(option) +
                       " names processes in small letters and their words, such as decision=460 or "
                       "decision=460:461, not \"" +
                       std::string(text.substr(0, 40)) + "\"");
  }
  const std::string_view numbers = text.substr(equals + 1);
  const std::size_t colon = numbers.find(':');
  CycleWords words;
  words.process = name;
  words.cycle = TRY(wordFrom(numbers.substr(0, colon), option));
  if (colon != std::string_view::npos) {
    words.clock = TRY(wordFrom(numbers.substr(colon + 1), option));
  }
  return words;
}

}  // namespace

Result<std::vector<CycleWords>> cycleWordsFromText(std::string_view text, std::string_view option) {
  std::vector<CycleWords> all;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    all.push_back(TRY(oneFrom(text.substr(at, comma - at), option)));
    at = comma + 1;
  }
  return all;
}

Result<void> checkFree(std::span<const CycleWords> words, const VariableCatalog& catalog,
                       std::string_view option) {
  const auto check = [&](const std::string& name, IntVar word) -> Result<void> {
    for (const Variable& known : catalog.variables()) {
      const int offset = known.type == VariableType::Int ? 0 : Blackboard::floatOffset;
      if (known.index + offset != word.index || known.name == name) continue;
      return failure(ErrorCode::InvalidArgument,
                     "the word " + std::to_string(word.index) + " of " + std::string(option) +
                         " is " + known.name +
                         "; choose one that the map leaves free, such as 460");
    }
    return {};
  };
  for (const CycleWords& one : words) {
    TRY(check(cycleVariable(one.process, cycleSuffix), one.cycle));
    if (one.clock) TRY(check(cycleVariable(one.process, clockSuffix), *one.clock));
  }
  return {};
}

std::string cycleVariable(std::string_view process, std::string_view suffix) {
  std::string name = std::string(process) + std::string(suffix);
  for (char& letter : name) {
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  }
  return name;
}

bool isAnnouncement(const VariableCatalog& catalog, const Variable& variable) {
  if (announcesCycles(variable)) return true;
  if (variable.type != VariableType::Int || !variable.name.ends_with(clockSuffix)) return false;
  const std::string process = variable.name.substr(0, variable.name.size() - clockSuffix.size());
  return catalog.intVar(process + std::string(cycleSuffix)).has_value();
}

CycleAnnouncer::CycleAnnouncer(Blackboard& board, CycleWords words)
    : m_board(board), m_words(std::move(words)) {
  if (board.key() == 0) return;
  const int id = ::shmget(board.key(), 0, 0);
  const void* const address = id < 0 ? nullptr : ::shmat(id, nullptr, SHM_RDONLY);
  if (address != reinterpret_cast<const void*>(-1)) m_segment = address;
}

CycleAnnouncer::~CycleAnnouncer() {
  if (m_segment != nullptr) ::shmdt(m_segment);
}

/// The value stands behind everything that was written before.
void CycleAnnouncer::announce(int value) {
  std::atomic_thread_fence(std::memory_order_release);
  m_board.write(m_words.cycle, value);
  if (m_segment == nullptr) return;
  const auto* const words = static_cast<const std::uint32_t*>(m_segment);
  ::syscall(SYS_futex, words + m_words.cycle.index, FUTEX_WAKE, std::numeric_limits<int>::max(),
            nullptr, nullptr, 0);
}

double CycleAnnouncer::begin(double seconds) {
  const int clock = static_cast<int>(std::clamp(std::floor(seconds * 1000.0 + 1e-6), 0.0,
                                                double(std::numeric_limits<int>::max())));
  if (m_words.clock) m_board.write(*m_words.clock, clock);
  m_cycle = m_cycle < std::numeric_limits<int>::max() ? m_cycle + 1 : 1;
  announce(m_cycle);
  return clock / 1000.0;
}

void CycleAnnouncer::end() {
  announce(-m_cycle);
}

}  // namespace pitchboard::link
