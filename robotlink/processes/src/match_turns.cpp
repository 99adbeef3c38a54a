// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/match_turns.h>

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstring>

#include <base/system_reason.h>
#include <base/try.h>

namespace pitchboard::link {
namespace {

using Word = std::atomic<std::uint32_t>;
static_assert(Word::is_always_lock_free && sizeof(Word) == 4,
              "the words are shared with other processes, and the kernel waits on them");
static_assert(std::atomic<double>::is_always_lock_free);

constexpr std::size_t places = 512;  // 64 robots of 8 processes; unused pages cost nothing
constexpr std::size_t longestMessage = 512;
constexpr std::uint32_t magic = 0x50425432;  // of this layout

/// Messages, each with its length in front; whoever may write it now owns it.
template <std::size_t Most>
struct Box {
  std::uint32_t used = 0;
  std::array<char, Most*(longestMessage + 2)> bytes;

  bool add(std::string_view message) {
    const std::size_t end = used + 2 + message.size();
    if (message.size() > longestMessage || end > bytes.size()) return false;
    const auto size = static_cast<std::uint16_t>(message.size());
    std::memcpy(bytes.data() + used, &size, 2);
    std::memcpy(bytes.data() + used + 2, message.data(), message.size());
    used = static_cast<std::uint32_t>(end);
    return true;
  }
  // The other side is a program of its own: nothing it wrote is taken on trust.
  std::vector<std::string> all() const {
    std::vector<std::string> out;
    const std::size_t end = std::min<std::size_t>(used, bytes.size());
    for (std::size_t at = 0; at + 2 <= end;) {
      std::uint16_t size = 0;
      std::memcpy(&size, bytes.data() + at, 2);
      at += 2;
      if (size > longestMessage || at + size > end) break;
      out.emplace_back(bytes.data() + at, size);
      at += size;
    }
    return out;
  }
};

struct Place {
  Word ready{0};  // 1 once the process takes turns
  Word given{0};  // number of the last turn given
  Word done{0};   // number of the last turn taken to its end
  Word lockStep{0};
  std::atomic<double> seconds{0.0};
  std::atomic<double> period{0.0};
  Box<64> toProcess;
  Box<16> fromProcess;
};

void wake(Word& word) {
  ::syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

/// Returns when the word is not `seen` any more, when it was woken, or after `longest`.
void sleepWhile(const Word& word, std::uint32_t seen, std::chrono::nanoseconds longest) {
  constexpr std::int64_t second = 1'000'000'000;
  const timespec time{static_cast<time_t>(longest.count() / second),
                      static_cast<long>(longest.count() % second)};
  ::syscall(SYS_futex, &word, FUTEX_WAIT, seen, &time, nullptr, 0);
}

template <class Reached>
bool waitFor(const Word& word, std::chrono::milliseconds longest, const Reached& reached) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + longest;
  while (true) {
    const std::uint32_t value = word.load(std::memory_order_acquire);
    if (reached(value)) return true;
    const auto rest = end - Clock::now();
    if (rest <= Clock::duration::zero()) return false;
    sleepWhile(word, value, rest);
  }
}

}  // namespace

struct TurnMemory {
  std::uint32_t magicWord = magic;
  alignas(64) std::array<Place, places> all;
};

namespace {

Place& at(const TurnPages& pages, int place) {
  return pages.memory().all[static_cast<std::size_t>(place)];
}

Result<std::unique_ptr<TurnPages>> mapped(UniqueFd descriptor, bool fresh) {
  void* const address =
      ::mmap(nullptr, sizeof(TurnMemory), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor.get(), 0);
  if (address == MAP_FAILED) {
    return failure(ErrorCode::SystemError,
                   "the match's clock cannot be shared: " + systemReason(errno));
  }
  // Fresh memory is all zeros, which is how every place begins.
  auto* const memory = static_cast<TurnMemory*>(address);
  if (fresh) memory->magicWord = magic;
  return std::make_unique<TurnPages>(memory, std::move(descriptor));
}

}  // namespace

TurnPages::~TurnPages() {
  ::munmap(m_memory, sizeof(TurnMemory));
}

MatchTurns::MatchTurns(std::unique_ptr<TurnPages> pages)
    : m_pages(std::move(pages)), m_taken(places, false) {}

Result<std::unique_ptr<MatchTurns>> MatchTurns::create() {
  UniqueFd descriptor(::memfd_create("pitchboard-match", MFD_CLOEXEC));
  if (!descriptor || ::ftruncate(descriptor.get(), sizeof(TurnMemory)) != 0) {
    return failure(ErrorCode::SystemError,
                   "the match's clock cannot be shared: " + systemReason(errno));
  }
  auto pages = TRY(mapped(std::move(descriptor), true));
  return std::unique_ptr<MatchTurns>(new MatchTurns(std::move(pages)));
}

Result<int> MatchTurns::takePlace() {
  const auto free = std::ranges::find(m_taken, false);
  if (free == m_taken.end()) {
    return failure(ErrorCode::Conflict, "a match has at most " + std::to_string(places) +
                                            " reference processes; play with fewer robots");
  }
  *free = true;
  const int place = static_cast<int>(free - m_taken.begin());
  Place& p = at(*m_pages, place);
  p.ready.store(0, std::memory_order_relaxed);
  p.given.store(0, std::memory_order_relaxed);
  p.done.store(0, std::memory_order_relaxed);
  p.toProcess.used = p.fromProcess.used = 0;
  return place;
}

void MatchTurns::giveBack(int place) {
  m_taken[static_cast<std::size_t>(place)] = false;
}

std::optional<double> MatchTurns::period(int place) const {
  const Place& p = at(*m_pages, place);
  if (p.ready.load(std::memory_order_acquire) == 0) return {};
  return p.period.load(std::memory_order_relaxed);
}

bool MatchTurns::isDone(int place) const {
  const Place& p = at(*m_pages, place);
  return p.done.load(std::memory_order_acquire) == p.given.load(std::memory_order_relaxed);
}

bool MatchTurns::waitUntilReady(int place, std::chrono::milliseconds longest) const {
  return waitFor(at(*m_pages, place).ready, longest,
                 [](std::uint32_t value) { return value != 0; });
}

bool MatchTurns::waitUntilDone(int place, std::chrono::milliseconds longest) const {
  const Place& p = at(*m_pages, place);
  const std::uint32_t given = p.given.load(std::memory_order_relaxed);
  return waitFor(p.done, longest, [given](std::uint32_t value) { return value == given; });
}

void MatchTurns::give(int place, double seconds, bool lockStep,
                      std::span<const std::string> messages) {
  Place& p = at(*m_pages, place);
  p.seconds.store(seconds, std::memory_order_relaxed);
  p.lockStep.store(lockStep ? 1 : 0, std::memory_order_relaxed);
  p.toProcess.used = p.fromProcess.used = 0;
  for (const std::string& message : messages) {
    if (!p.toProcess.add(message)) break;
  }
  p.given.fetch_add(1, std::memory_order_release);
  wake(p.given);
}

std::vector<std::string> MatchTurns::takePosted(int place) {
  Place& p = at(*m_pages, place);
  std::vector<std::string> posted;
  if (p.fromProcess.used == 0) return posted;
  posted = p.fromProcess.all();
  p.fromProcess.used = 0;
  return posted;
}

Result<std::shared_ptr<ProcessTurns>> ProcessTurns::join(int place) {
  struct stat status {};
  const bool ours = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
                    status.st_size == static_cast<off_t>(sizeof(TurnMemory));
  if (place < 0 || place >= static_cast<int>(places) || !ours) {
    return failure(ErrorCode::InvalidArgument,
                   "this process was given no match to take its time from; only the program that "
                   "plays a match uses this option",
                   "--match-turns");
  }
  auto pages = TRY(mapped(UniqueFd(::fcntl(descriptor, F_DUPFD_CLOEXEC, 3)), false));
  if (pages->memory().magicWord != magic) {
    return failure(ErrorCode::Unsupported,
                   "the program that plays the match has another version than this one; install "
                   "both from one package",
                   "--match-turns");
  }
  return std::shared_ptr<ProcessTurns>(new ProcessTurns(std::move(pages), place));
}

void ProcessTurns::ready(double period) {
  Place& p = at(*m_pages, m_place);
  p.period.store(period, std::memory_order_relaxed);
  p.ready.store(1, std::memory_order_release);
  wake(p.ready);
}

std::optional<Turn> ProcessTurns::wait(std::chrono::milliseconds longest) {
  Place& p = at(*m_pages, m_place);
  const std::uint32_t last = m_number;
  if (!waitFor(p.given, longest, [last](std::uint32_t value) { return value != last; })) return {};
  m_number = p.given.load(std::memory_order_acquire);
  m_turn = {p.seconds.load(std::memory_order_relaxed),
            p.lockStep.load(std::memory_order_relaxed) != 0};
  return m_turn;
}

void ProcessTurns::done() {
  Place& p = at(*m_pages, m_place);
  m_turn.lockStep = false;
  p.done.store(m_number, std::memory_order_release);
  wake(p.done);
}

std::vector<std::string> ProcessTurns::messages() const {
  return at(*m_pages, m_place).toProcess.all();
}

void ProcessTurns::post(std::string_view message) {
  at(*m_pages, m_place).fromProcess.add(message);
}

}  // namespace pitchboard::link
