// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/lock_step_slots.h>

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

constexpr std::size_t maxSlots = 512;  // 64 robots of 8 processes; unused pages cost nothing
constexpr std::size_t maxMessageLength = 512;
constexpr std::uint32_t magic = 0x50425432;  // of this layout

/// Messages, each preceded by its length. The side that may write now owns it.
template <std::size_t Most>
struct Box {
  std::uint32_t used = 0;
  std::array<char, Most*(maxMessageLength + 2)> bytes;

  bool add(std::string_view message) {
    const std::size_t end = used + 2 + message.size();
    if (message.size() > maxMessageLength || end > bytes.size()) return false;
    const auto size = static_cast<std::uint16_t>(message.size());
    std::memcpy(bytes.data() + used, &size, 2);
    std::memcpy(bytes.data() + used + 2, message.data(), message.size());
    used = static_cast<std::uint32_t>(end);
    return true;
  }
  // The other side is another process, so whatever it wrote is checked.
  std::vector<std::string> all() const {
    std::vector<std::string> out;
    const std::size_t end = std::min<std::size_t>(used, bytes.size());
    for (std::size_t at = 0; at + 2 <= end;) {
      std::uint16_t size = 0;
      std::memcpy(&size, bytes.data() + at, 2);
      at += 2;
      if (size > maxMessageLength || at + size > end) break;
      out.emplace_back(bytes.data() + at, size);
      at += size;
    }
    return out;
  }
};

struct Slot {
  Word ready{0};  // 1 once the process is ready for cycles
  Word given{0};  // number of the last cycle started
  Word done{0};   // number of the last cycle completed
  Word lockStep{0};
  std::atomic<double> seconds{0.0};
  std::atomic<double> period{0.0};
  Box<64> toProcess;
  Box<16> fromProcess;
};

void wake(Word& word) {
  ::syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

/// Returns when the word is no longer `seen`, when it was woken, or after `longest`.
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

struct SlotMemory {
  std::uint32_t magicWord = magic;
  alignas(64) std::array<Slot, maxSlots> all;
};

namespace {

Slot& at(const SlotPages& pages, int slot) {
  return pages.memory().all[static_cast<std::size_t>(slot)];
}

Result<std::unique_ptr<SlotPages>> mapped(UniqueFd descriptor, bool fresh) {
  void* const address =
      ::mmap(nullptr, sizeof(SlotMemory), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor.get(), 0);
  if (address == MAP_FAILED) {
    return failure(ErrorCode::SystemError,
                   "Cannot share the match clock with processes: " + systemReason(errno));
  }
  // Fresh memory is all zeros, which is the initial state of every slot.
  auto* const memory = static_cast<SlotMemory*>(address);
  if (fresh) memory->magicWord = magic;
  return std::make_unique<SlotPages>(memory, std::move(descriptor));
}

}  // namespace

SlotPages::~SlotPages() {
  ::munmap(m_memory, sizeof(SlotMemory));
}

LockStepSlots::LockStepSlots(std::unique_ptr<SlotPages> pages)
    : m_pages(std::move(pages)), m_taken(maxSlots, false) {}

Result<std::unique_ptr<LockStepSlots>> LockStepSlots::create() {
  UniqueFd descriptor(::memfd_create("pitchboard-match", MFD_CLOEXEC));
  if (!descriptor || ::ftruncate(descriptor.get(), sizeof(SlotMemory)) != 0) {
    return failure(ErrorCode::SystemError,
                   "Cannot share the match clock with processes: " + systemReason(errno));
  }
  auto pages = TRY(mapped(std::move(descriptor), true));
  return std::unique_ptr<LockStepSlots>(new LockStepSlots(std::move(pages)));
}

Result<int> LockStepSlots::take() {
  const auto free = std::ranges::find(m_taken, false);
  if (free == m_taken.end()) {
    return failure(ErrorCode::Conflict, "a match has at most " + std::to_string(maxSlots) +
                                            " reference processes; play with fewer robots");
  }
  *free = true;
  const int index = static_cast<int>(free - m_taken.begin());
  Slot& slot = at(*m_pages, index);
  slot.ready.store(0, std::memory_order_relaxed);
  slot.given.store(0, std::memory_order_relaxed);
  slot.done.store(0, std::memory_order_relaxed);
  slot.toProcess.used = slot.fromProcess.used = 0;
  return index;
}

void LockStepSlots::release(int index) {
  m_taken[static_cast<std::size_t>(index)] = false;
}

std::optional<double> LockStepSlots::period(int index) const {
  const Slot& slot = at(*m_pages, index);
  if (slot.ready.load(std::memory_order_acquire) == 0) return {};
  return slot.period.load(std::memory_order_relaxed);
}

bool LockStepSlots::isDone(int index) const {
  const Slot& slot = at(*m_pages, index);
  return slot.done.load(std::memory_order_acquire) == slot.given.load(std::memory_order_relaxed);
}

bool LockStepSlots::waitUntilReady(int index, std::chrono::milliseconds longest) const {
  return waitFor(at(*m_pages, index).ready, longest,
                 [](std::uint32_t value) { return value != 0; });
}

bool LockStepSlots::waitUntilDone(int index, std::chrono::milliseconds longest) const {
  const Slot& slot = at(*m_pages, index);
  const std::uint32_t given = slot.given.load(std::memory_order_relaxed);
  return waitFor(slot.done, longest, [given](std::uint32_t value) { return value == given; });
}

void LockStepSlots::startCycle(int index, double seconds, bool lockStep,
                               std::span<const std::string> messages) {
  Slot& slot = at(*m_pages, index);
  slot.seconds.store(seconds, std::memory_order_relaxed);
  slot.lockStep.store(lockStep ? 1 : 0, std::memory_order_relaxed);
  slot.toProcess.used = slot.fromProcess.used = 0;
  for (const std::string& message : messages) {
    if (!slot.toProcess.add(message)) break;
  }
  slot.given.fetch_add(1, std::memory_order_release);
  wake(slot.given);
}

std::vector<std::string> LockStepSlots::drainPosted(int index) {
  Slot& slot = at(*m_pages, index);
  std::vector<std::string> posted;
  if (slot.fromProcess.used == 0) return posted;
  posted = slot.fromProcess.all();
  slot.fromProcess.used = 0;
  return posted;
}

Result<std::shared_ptr<LockStepSlot>> LockStepSlot::join(int index) {
  struct stat status {};
  const bool ours = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
                    status.st_size == static_cast<off_t>(sizeof(SlotMemory));
  if (index < 0 || index >= static_cast<int>(maxSlots) || !ours) {
    return failure(ErrorCode::InvalidArgument,
                   "no match to join; only a program that plays a match passes this option",
                   "--lock-step-slot");
  }
  auto pages = TRY(mapped(UniqueFd(::fcntl(descriptor, F_DUPFD_CLOEXEC, 3)), false));
  if (pages->memory().magicWord != magic) {
    return failure(ErrorCode::Unsupported,
                   "the program that plays the match has another version; install both from the "
                   "same package",
                   "--lock-step-slot");
  }
  return std::shared_ptr<LockStepSlot>(new LockStepSlot(std::move(pages), index));
}

void LockStepSlot::ready(double period) {
  Slot& slot = at(*m_pages, m_index);
  slot.period.store(period, std::memory_order_relaxed);
  slot.ready.store(1, std::memory_order_release);
  wake(slot.ready);
}

std::optional<CycleStart> LockStepSlot::wait(std::chrono::milliseconds longest) {
  Slot& slot = at(*m_pages, m_index);
  const std::uint32_t last = m_number;
  if (!waitFor(slot.given, longest, [last](std::uint32_t value) { return value != last; }))
    return {};
  m_number = slot.given.load(std::memory_order_acquire);
  m_cycle = {slot.seconds.load(std::memory_order_relaxed),
             slot.lockStep.load(std::memory_order_relaxed) != 0};
  return m_cycle;
}

void LockStepSlot::done() {
  Slot& slot = at(*m_pages, m_index);
  m_cycle.lockStep = false;
  slot.done.store(m_number, std::memory_order_release);
  wake(slot.done);
}

std::vector<std::string> LockStepSlot::messages() const {
  return at(*m_pages, m_index).toProcess.all();
}

void LockStepSlot::post(std::string_view message) {
  at(*m_pages, m_index).fromProcess.add(message);
}

}  // namespace pitchboard::link
