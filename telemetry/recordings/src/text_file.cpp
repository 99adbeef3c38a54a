// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>

#include <base/system_reason.h>

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t fillStep = 256U << 10U;

/// Takes exactly `digits` digits off the text.
std::optional<int> takeDigits(std::string_view& text, std::size_t digits) {
  int value = 0;
  if (text.size() < digits) return {};
  const auto [end, code] = std::from_chars(text.data(), text.data() + digits, value);
  if (code != std::errc() || end != text.data() + digits || value < 0) return {};
  text.remove_prefix(digits);
  return value;
}

bool takeOne(std::string_view& text, std::string_view of) {
  if (text.empty() || of.find(text.front()) == of.npos) return false;
  text.remove_prefix(1);
  return true;
}

/// Takes ".123456789" off the text, in ns.
std::int64_t takeFraction(std::string_view& text) {
  if (!takeOne(text, ".,")) return 0;
  std::int64_t value = 0, unit = 100'000'000;
  while (!text.empty() && text.front() >= '0' && text.front() <= '9') {
    value += (text.front() - '0') * unit;
    unit /= 10;
    text.remove_prefix(1);
  }
  return value;
}

/// Takes "Z", "+02:00" or "-0730" off the text, in s.
std::optional<int> takeZone(std::string_view& text) {
  if (text.empty() || takeOne(text, "Zz")) return 0;
  const bool isWest = text.front() == '-';
  if (!takeOne(text, "+-")) return {};
  const auto hours = takeDigits(text, 2);
  (void)takeOne(text, ":");
  const auto minutes = text.empty() ? std::optional<int>(0) : takeDigits(text, 2);
  if (!hours || !minutes) return {};
  return (isWest ? -1 : 1) * (*hours * 3600 + *minutes * 60);
}

}  // namespace

Result<TextFile> TextFile::open(const std::string& path) {
  UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) {
    return failure(errno == ENOENT ? ErrorCode::NotFound : ErrorCode::SystemError,
                   "The file cannot be read: " + systemReason(errno) + ".", path);
  }
  struct stat info {};
  TextFile made(std::move(file));
  if (::fstat(made.m_file.get(), &info) == 0 && info.st_size > 0) {
    made.m_size = static_cast<std::uint64_t>(info.st_size);
  }
  return made;
}

bool TextFile::fill() {
  if (m_atEnd) return false;
  m_buffer.erase(0, m_at);
  m_at = 0;
  const std::size_t begin = m_buffer.size();
  m_buffer.resize(begin + fillStep);
  ssize_t got = 0;
  do {
    got = ::read(m_file.get(), m_buffer.data() + begin, fillStep);
  } while (got < 0 && errno == EINTR);
  m_buffer.resize(begin + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  m_atEnd = got <= 0;
  m_read += static_cast<std::uint64_t>(std::max<ssize_t>(got, 0));
  return !m_atEnd;
}

std::optional<std::string_view> TextFile::line() {
  std::size_t searched = 0;
  for (;;) {
    const auto end = m_buffer.find('\n', m_at + searched);
    if (end != m_buffer.npos || m_buffer.size() - m_at >= maxLine) {
      const std::size_t stop = std::min(end, m_at + maxLine);
      std::string_view line(m_buffer.data() + m_at, stop - m_at);
      m_at = stop + (stop == end ? 1 : 0);
      if (line.ends_with('\r')) line.remove_suffix(1);
      return line;
    }
    searched = m_buffer.size() - m_at;
    if (fill()) continue;
    if (m_at == m_buffer.size()) return {};
    std::string_view line(m_buffer.data() + m_at, m_buffer.size() - m_at);
    m_at = m_buffer.size();
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
}

void TextFile::rewind() {
  (void)::lseek(m_file.get(), 0, SEEK_SET);
  m_buffer.clear();
  m_at = 0;
  m_read = 0;
  m_atEnd = false;
}

double TextFile::progress() const {
  if (m_size == 0) return 1.0;
  return std::min(1.0, static_cast<double>(m_read) / static_cast<double>(m_size));
}

std::optional<std::int64_t> isoTime(std::string_view text) {
  const auto year = takeDigits(text, 4);
  if (!year || !takeOne(text, "-/")) return {};
  const auto month = takeDigits(text, 2);
  if (!month || !takeOne(text, "-/")) return {};
  const auto day = takeDigits(text, 2);
  if (!day || !takeOne(text, "T t")) return {};
  const auto hour = takeDigits(text, 2);
  if (!hour || !takeOne(text, ":")) return {};
  const auto minute = takeDigits(text, 2);
  if (!minute) return {};
  std::optional<int> second = 0;
  if (takeOne(text, ":")) second = takeDigits(text, 2);
  if (!second) return {};
  const std::int64_t fraction = takeFraction(text);
  if (text.starts_with(' ')) text.remove_prefix(1);
  const auto zone = takeZone(text);
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  // Beyond these years, ns do not fit into 64 bits.
  const bool isPossible =
      *year >= 1700 && *year <= 2250 && date.ok() && *hour < 24 && *minute < 60 && *second <= 60;
  if (!zone || !text.empty() || !isPossible) return {};
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  const std::int64_t seconds =
      std::int64_t{days} * 86'400 + *hour * 3600 + *minute * 60 + *second - *zone;
  return seconds * 1'000'000'000 + fraction;
}

}  // namespace pitchboard::telemetry
