// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/blackboard/system_v.h>

#include <sys/ipc.h>
#include <sys/shm.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <memory>
#include <optional>

#include <base/system_reason.h>
#include <base/try.h>
#include <robotlink/blackboard/segments.h>

#include "blackboard_memory.h"

namespace pitchboard::link {
namespace {

constexpr unsigned ownerReads = 0400;
constexpr unsigned ownerReadsAndWrites = 0600;
constexpr int createdMode = 0600;
constexpr int robotNumbers = 64;
constexpr int keysPerRobot = 100;
// Another process may create or remove the segment between two of our calls; then we look again.
// More often than this in a row, something is wrong.
constexpr int attempts = 16;

std::string keyContext(int key) {
  return "blackboard " + std::to_string(key);
}

std::string removeHint(int key) {
  return "remove it with `pitchboard-cli blackboard remove --key " + std::to_string(key) +
         "` or `ipcrm -M " + std::to_string(key) + "`";
}

Error systemError(int key, const char* call, int number) {
  return {ErrorCode::SystemError,
          std::string(call) + " failed: " + systemReason(number) +
              (number == ENOSPC ? "; remove unused segments (`pitchboard-cli blackboard remove "
                                  "--orphans`) or raise kernel.shmmni"
                                : ""),
          keyContext(key)};
}

bool processLives(pid_t process) {
  return kill(process, 0) == 0 || errno != ESRCH;
}

SegmentInfo describe(int shmid, const shmid_ds& status) {
  SegmentInfo info;
  info.key = status.shm_perm.__key;
  info.shmid = shmid;
  info.bytes = status.shm_segsz;
  info.mode = status.shm_perm.mode & 0777U;
  info.owner = status.shm_perm.uid;
  info.creator = status.shm_cpid;
  info.lastUser = status.shm_lpid;
  info.attached = status.shm_nattch;
  info.blackboardSized = info.bytes == static_cast<std::size_t>(Blackboard::bytes);
  // A creator of 0 lives in another process namespace (a container): it may well be running.
  info.orphan = info.blackboardSized && info.owner == geteuid() && info.attached == 0 &&
                info.creator > 0 && !processLives(info.creator);
  return info;
}

// Every segment of this machine that still has a key, whoever owns it and whatever its mode.
std::vector<SegmentInfo> allSegments() {
  std::vector<SegmentInfo> found;
  shm_info summary{};
  const int last = shmctl(0, SHM_INFO, reinterpret_cast<shmid_ds*>(&summary));
  for (int slot = 0; slot <= last; ++slot) {
    shmid_ds status{};
    int shmid = -1;
#ifdef SHM_STAT_ANY
    shmid = shmctl(slot, SHM_STAT_ANY, &status);
#endif
    if (shmid < 0) shmid = shmctl(slot, SHM_STAT, &status);
    // Marked for destruction: its key is already free for a new segment, this one is unreachable.
    if (shmid < 0 || (status.shm_perm.mode & SHM_DEST) != 0) continue;
    found.push_back(describe(shmid, status));
  }
  return found;
}

class SystemVMemory : public BlackboardMemory {
 public:
  SystemVMemory(void* address, int key, int shmid, bool created)
      : m_address(address), m_key(key), m_shmid(shmid), m_creator(created ? getpid() : 0) {}
  ~SystemVMemory() override {
    shmdt(m_address);
    if (created()) shmctl(m_shmid, IPC_RMID, nullptr);
  }

  std::uint32_t* words() override { return static_cast<std::uint32_t*>(m_address); }
  int key() const override { return m_key; }
  // A forked child holds a copy of this object; it must not take the segment from its parent.
  bool created() const override { return m_creator == getpid(); }

 private:
  void* m_address;
  int m_key;
  int m_shmid;
  pid_t m_creator;
};

Error permissionError(int key, unsigned owner, unsigned mode, bool write) {
  char octal[8];
  std::snprintf(octal, sizeof octal, "%04o", mode);
  return {ErrorCode::SystemError,
          std::string("its mode ") + octal + " and owner (user " + std::to_string(owner) +
              ") do not let this program " + (write ? "write to" : "read") +
              " it; a blackboard has mode 0600: " + removeHint(key) +
              " and let it be created again",
          keyContext(key)};
}

/// Why the segment cannot be a blackboard of ours, if so.
std::optional<Error> refusal(const SegmentInfo& info, bool write) {
  if (info.owner != geteuid())
    return Error{ErrorCode::Conflict,
                 "belongs to user " + std::to_string(info.owner) + ", this program runs as user " +
                     std::to_string(geteuid()) +
                     "; start both as the same user, or let the owner " + removeHint(info.key),
                 keyContext(info.key)};
  if (!info.blackboardSized)
    return Error{ErrorCode::Conflict,
                 "there is a segment of " + std::to_string(info.bytes) +
                     " bytes, a blackboard has " + std::to_string(Blackboard::bytes) +
                     "; if nothing uses it, " + removeHint(info.key),
                 keyContext(info.key)};
  const unsigned needed = write ? ownerReadsAndWrites : ownerReads;
  // Asked here because root would be let through: what works must not depend on who tries it.
  if ((info.mode & needed) != needed)
    return permissionError(info.key, info.owner, info.mode, write);
  return std::nullopt;
}

// Finds the segment and what it is, without attaching. Empty when there is none.
Result<std::optional<SegmentInfo>> lookUp(int key) {
  // Size 0 finds a segment of any size, so that a wrong size can be explained.
  const int shmid = shmget(key, 0, 0);
  if (shmid < 0) {
    if (errno == ENOENT) return std::optional<SegmentInfo>{};
    if (errno != EACCES) return tl::unexpected(systemError(key, "shmget", errno));
  }
  shmid_ds status{};
  if (shmid >= 0 && shmctl(shmid, IPC_STAT, &status) == 0) {
    if ((status.shm_perm.mode & SHM_DEST) != 0) return std::optional<SegmentInfo>{};
    return std::optional{describe(shmid, status)};
  }
  if (errno == EIDRM || errno == EINVAL) return std::optional<SegmentInfo>{};
  if (errno != EACCES) return tl::unexpected(systemError(key, "shmctl", errno));
  // Not ours to read: the kernel's table still tells whose it is.
  for (const SegmentInfo& info : allSegments()) {
    if (info.key == key) return std::optional{info};
  }
  return std::optional<SegmentInfo>{};
}

Error keyError(int key) {
  return {ErrorCode::InvalidArgument,
          "a blackboard's key is a positive number: 100 times the robot's number", keyContext(key)};
}

}  // namespace

Result<Blackboard> SystemVSegments::open(int key, AttachMode mode) {
  if (key <= 0) return tl::unexpected(keyError(key));
  const bool write = mode != AttachMode::ReadOnly;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const auto there = TRY(lookUp(key));

    int shmid = -1;
    bool created = false;
    if (there.has_value()) {
      if (const auto error = refusal(*there, write)) return tl::unexpected(*error);
      shmid = there->shmid;
    } else if (mode == AttachMode::AttachOrCreate) {
      shmid = shmget(key, Blackboard::bytes, IPC_CREAT | IPC_EXCL | createdMode);
      if (shmid < 0 && errno == EEXIST) continue;
      if (shmid < 0) return tl::unexpected(systemError(key, "shmget", errno));
      created = true;
    } else {
      return failure(ErrorCode::NotFound,
                     "there is no such segment; start the robot's processes or a simulation, or "
                     "create it with `pitchboard-cli blackboard create --key " +
                         std::to_string(key) + "`",
                     keyContext(key));
    }

    void* const address = shmat(shmid, nullptr, write ? 0 : SHM_RDONLY);
    // shmat's way of saying that it failed.
    if (address == reinterpret_cast<void*>(-1)) {
      const int number = errno;
      if (created) shmctl(shmid, IPC_RMID, nullptr);
      if (number == EIDRM || number == EINVAL) continue;
      if (number == EACCES)
        return tl::unexpected(permissionError(key, there->owner, there->mode, write));
      return tl::unexpected(systemError(key, "shmat", number));
    }
    auto memory = std::make_unique<SystemVMemory>(address, key, shmid, created);
    // Removed between look and attach: the memory is there, but nobody else will ever find it.
    shmid_ds status{};
    if (!created && shmctl(shmid, IPC_STAT, &status) == 0 && (status.shm_perm.mode & SHM_DEST) != 0)
      continue;
    return Blackboard(std::move(memory));
  }
  return failure(ErrorCode::SystemError,
                 "other programs keep creating and removing this segment; end them and try again",
                 keyContext(key));
}

std::vector<SegmentInfo> SystemVSegments::list(int keyBase) {
  std::vector<SegmentInfo> found = segmentsOfThisComputer();
  constexpr long long last = static_cast<long long>(keysPerRobot) * robotNumbers;
  std::erase_if(found, [keyBase](const SegmentInfo& info) {
    const long long offset = static_cast<long long>(info.key) - keyBase;
    return offset < keysPerRobot || offset > last || offset % keysPerRobot != 0;
  });
  return found;
}

std::vector<SegmentInfo> segmentsOfThisComputer() {
  std::vector<SegmentInfo> found = allSegments();
  std::erase_if(found, [](const SegmentInfo& info) { return info.key <= 0; });
  std::ranges::sort(found,
                    [](const SegmentInfo& a, const SegmentInfo& b) { return a.key < b.key; });
  return found;
}

Result<SegmentInfo> SystemVSegments::info(int key) {
  if (key <= 0) return tl::unexpected(keyError(key));
  const auto there = lookUp(key);
  if (!there) return tl::unexpected(there.error());
  if (!there->has_value())
    return failure(ErrorCode::NotFound, "there is no such segment", keyContext(key));
  return **there;
}

Result<void> SystemVSegments::create(int key) {
  if (key <= 0) return tl::unexpected(keyError(key));
  if (shmget(key, Blackboard::bytes, IPC_CREAT | IPC_EXCL | createdMode) >= 0) return {};
  if (errno == EEXIST)
    return failure(ErrorCode::Conflict, "exists already; to start from zero, " + removeHint(key),
                   keyContext(key));
  return tl::unexpected(systemError(key, "shmget", errno));
}

Result<void> SystemVSegments::remove(int key) {
  const auto there = TRY(info(key));
  if (shmctl(there.shmid, IPC_RMID, nullptr) == 0) return {};
  if (errno == EPERM || errno == EACCES)
    return failure(
        ErrorCode::SystemError,
        "belongs to user " + std::to_string(there.owner) + "; only that user or root may remove it",
        keyContext(key));
  if (errno == EIDRM || errno == EINVAL)
    return failure(ErrorCode::NotFound, "there is no such segment", keyContext(key));
  return tl::unexpected(systemError(key, "shmctl", errno));
}

}  // namespace pitchboard::link
