// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads a text file from front to back, line by line, with little memory. Private to recordings;
// one thread.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <base/result.h>
#include <base/unique_fd.h>

namespace pitchboard::telemetry {

class TextFile {
 public:
  /// Longer lines are cut.
  static constexpr std::size_t maxLine = 1U << 20;

  /// Fails with NotFound or SystemError.
  static Result<TextFile> open(const std::string& path);
  /// Returns the next line without its end; nothing at the end of the file. Valid until the next
  /// call.
  std::optional<std::string_view> line();
  void rewind();
  /// Returns the share of the file that was read, 0 to 1.
  double progress() const;

 private:
  explicit TextFile(UniqueFd file) : m_file(std::move(file)) {}
  bool fill();

  UniqueFd m_file;
  std::uint64_t m_size = 0, m_read = 0;
  std::string m_buffer;
  std::size_t m_at = 0;
  bool m_atEnd = false;
};

/// Reads a time such as 2026-07-01T14:03:20.5+02:00 as ns since 1970; without a zone it is UTC.
std::optional<std::int64_t> isoTime(std::string_view text);

}  // namespace pitchboard::telemetry
