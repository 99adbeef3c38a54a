// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// System V shared-memory segments that hold blackboards: attach, create, list, remove. The
// published convention: key 100 × robot number, 2048 bytes, mode 0600, whoever comes first creates
// it. Errors name the key and say what to do.

#include <sys/types.h>
#include <string>
#include <vector>

#include <base/unique_fd.h>
#include <robotlink/blackboard/blackboard.h>

namespace pitchboard::link {

/// What is to happen to a segment of the given key.
enum class AttachMode {
  AttachOrCreate,  ///< as a robot's process: attach to what is there, else create
  AttachOnly,      ///< fail when there is none
  ReadOnly         ///< attach without the right to write (write() is then a programmer error)
};

/// Key of a robot's blackboard. `keyBase` is 0 for real robots; tests and second studios shift it.
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
  pid_t lastUser = 0;            ///< process of the last attach or detach
  unsigned long attached = 0;    ///< processes attached now
  bool blackboardSized = false;  ///< exactly 2048 bytes
  bool orphan = false;           ///< blackboard-sized, ours, nobody attached, its creator is gone
};

class SystemVSegments {
 public:
  /// Attaches or creates. Refuses, with the reason, a segment of another size, another owner or
  /// without permission. A Blackboard that created its segment removes it when destroyed.
  static Result<Blackboard> open(int key, AttachMode mode);

  /// Segments whose key is a multiple of 100 from 100 to 6400 above `keyBase`, in order of key.
  static std::vector<SegmentInfo> list(int keyBase = 0);
  static Result<SegmentInfo> info(int key);
  /// Creates a zeroed segment that stays when this process ends; Conflict when there is one.
  static Result<void> create(int key);
  static Result<void> remove(int key);
};

/// Any segment of this computer, to be looked at and never written: of any size and, where its mode
/// lets us, of any owner. The kernel keeps its memory as long as this lives, also when its key is
/// gone. Any thread.
class SegmentView {
 public:
  /// `bytes`: the size that it must have; 0: any. Errors name the key and say what to do.
  static Result<SegmentView> attach(int key, std::size_t bytes = 0);
  SegmentView(SegmentView&& other) noexcept;
  SegmentView& operator=(SegmentView&& other) noexcept;
  ~SegmentView();

  std::size_t bytes() const { return m_bytes; }
  /// A word, read atomically; 0 beyond the end.
  std::uint32_t word(std::size_t index) const;
  /// False once it was removed, or another one has its key.
  bool isThere() const;
  /// Whether anybody else has it attached, also after it was removed.
  bool isShared() const;

 private:
  SegmentView(const void* address, int key, int shmid, std::size_t bytes);
  const void* m_address = nullptr;
  int m_key = 0, m_shmid = -1;
  std::size_t m_bytes = 0;
};

/// The right to play the simulated vision, control and IMU of one key. Two simulators on one
/// blackboard would fight over every word; the second is refused. Held by an abstract Unix socket
/// name, so it is freed by the kernel whatever happens to its owner.
class BridgeClaim {
 public:
  static Result<BridgeClaim> take(int key);

 private:
  explicit BridgeClaim(UniqueFd socket) : m_socket(std::move(socket)) {}
  UniqueFd m_socket;
};

}  // namespace pitchboard::link
