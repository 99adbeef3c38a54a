// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a blackboard's words live: the one thing that heap and System V blackboards do not share.
// Owned by Blackboard; the destructor gives the memory back.

#include <cstdint>

namespace pitchboard::link {

class BlackboardMemory {
 public:
  BlackboardMemory() = default;
  BlackboardMemory(const BlackboardMemory&) = delete;
  BlackboardMemory& operator=(const BlackboardMemory&) = delete;
  virtual ~BlackboardMemory() = default;

  /// Blackboard::words words, valid while this object lives.
  virtual std::uint32_t* words() = 0;
  /// System V key; 0 for heap memory.
  virtual int key() const = 0;
  /// This object made the segment and will remove it.
  virtual bool created() const = 0;
};

}  // namespace pitchboard::link
