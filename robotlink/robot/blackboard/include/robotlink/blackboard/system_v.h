// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// System V shared memory of blackboards: attach, create, list, remove. The published convention is
// key 100 × robot number, 2048 bytes, mode 0600, and the first process that needs it creates it.
// Errors name the key and say what to do. Any thread.

#include <sys/types.h>
#include <string>
#include <vector>

#include <base/unique_fd.h>
#include <robotlink/blackboard/blackboard.h>

namespace pitchboard::link {

/// What to do with the segment of a key.
enum class AttachMode {
  AttachOrCreate,  ///< attach if it exists, otherwise create it, as robots' processes do
  AttachOnly,      ///< fail if it does not exist
  ReadOnly         ///< attach without the right to write (then never call write())
};

/// Returns the key of a robot's blackboard. `keyBase` is 0 for real robots and match 0.
constexpr int blackboardKey(RobotId robot, int keyBase = 0) {
  return keyBase + 100 * robot.value;
}

struct SegmentInfo {
  int key = 0;
  int shmid = 0;
  std::size_t bytes = 0;
  unsigned mode = 0;  ///< permission bits
  uid_t owner = 0;
  pid_t creator = 0;
  pid_t lastUser = 0;            ///< process that last attached or detached
  unsigned long attached = 0;    ///< number of attached processes
  bool blackboardSized = false;  ///< exactly 2048 bytes
  bool orphan = false;           ///< blackboard-sized, ours, not attached, its creator has ended
};

class SystemVSegments {
 public:
  /// Attaches or creates. Fails with the reason for a segment of another size, another owner or
  /// without permission. A Blackboard that created its segment removes it when it is destroyed.
  static Result<Blackboard> open(int key, AttachMode mode);

  /// Returns segments with keys `keyBase` + 100, 200, ... 6400, in order of keys.
  static std::vector<SegmentInfo> list(int keyBase = 0);
  static Result<SegmentInfo> info(int key);
  /// Creates a segment of zeros that outlives this process. Fails with Conflict if it exists.
  static Result<void> create(int key);
  static Result<void> remove(int key);
};

/// Read-only access to any segment of this computer, of any size and, if its mode permits, of any
/// owner. The kernel keeps the memory as long as this object lives, even if the segment is removed.
/// Any thread.
class SegmentView {
 public:
  /// Attaches. `bytes` is the required size, 0 for any. Errors name the key and say what to do.
  static Result<SegmentView> attach(int key, std::size_t bytes = 0);
  SegmentView(SegmentView&& other) noexcept;
  SegmentView& operator=(SegmentView&& other) noexcept;
  ~SegmentView();

  std::size_t bytes() const { return m_bytes; }
  /// Reads a word atomically; 0 beyond the end.
  std::uint32_t word(std::size_t index) const;
  /// Returns false once it was removed or another segment has its key.
  bool isThere() const;
  /// Returns whether another process has it attached, even after it was removed.
  bool isShared() const;

 private:
  SegmentView(const void* address, int key, int shmid, std::size_t bytes);
  const void* m_address = nullptr;
  int m_key = 0, m_shmid = -1;
  std::size_t m_bytes = 0;
};

/// The right to simulate vision, control and IMU on the blackboard of one key, so that two
/// simulators never write the same words; the second one is refused. It is the name of an abstract
/// Unix socket, so the kernel frees it if its owner ends in any way.
class BridgeClaim {
 public:
  static Result<BridgeClaim> take(int key);

 private:
  explicit BridgeClaim(UniqueFd socket) : m_socket(std::move(socket)) {}
  UniqueFd m_socket;
};

}  // namespace pitchboard::link
