// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Owns a file descriptor (file, socket, end of a pipe) and closes it when it is destroyed. It can
// be moved but not copied. One thread at a time.

namespace pitchboard {

class UniqueFd {
 public:
  UniqueFd() = default;
  /// Takes over the result of open(), socket() and so on; a negative one is no descriptor.
  explicit UniqueFd(int value) : m_value(value) {}
  UniqueFd(UniqueFd&& other) noexcept : m_value(other.release()) {}
  UniqueFd& operator=(UniqueFd&& other) noexcept {
    if (this != &other) reset(other.release());
    return *this;
  }
  ~UniqueFd() { reset(); }

  int get() const { return m_value; }
  explicit operator bool() const { return m_value >= 0; }
  /// Returns the open descriptor and gives up ownership.
  int release() {
    const int value = m_value;
    m_value = -1;
    return value;
  }
  /// Closes the descriptor. errno is preserved, so that a failure can still be reported.
  void reset(int value = -1);

 private:
  int m_value = -1;
};

}  // namespace pitchboard
