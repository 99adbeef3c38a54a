// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A file, a socket or an end of a pipe of the system that is closed with its owner. Moved, never
// copied; one thread at a time, as every object of this kind.

namespace pitchboard {

class UniqueFd {
 public:
  UniqueFd() = default;
  /// Takes over what open(), socket() and the like returned; below 0: nothing.
  explicit UniqueFd(int value) : m_value(value) {}
  UniqueFd(UniqueFd&& other) noexcept : m_value(other.release()) {}
  UniqueFd& operator=(UniqueFd&& other) noexcept {
    if (this != &other) reset(other.release());
    return *this;
  }
  ~UniqueFd() { reset(); }

  int get() const { return m_value; }
  explicit operator bool() const { return m_value >= 0; }
  /// Gives it away open; the caller closes it.
  int release() {
    const int value = m_value;
    m_value = -1;
    return value;
  }
  /// Closes what was held. errno stays as it is, so that a failure can still be told.
  void reset(int value = -1);

 private:
  int m_value = -1;
};

}  // namespace pitchboard
