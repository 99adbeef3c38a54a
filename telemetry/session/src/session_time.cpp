// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_time.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <ctime>
#include <optional>

#include <base/time_text.h>
#include <base/try.h>

namespace pitchboard::telemetry {
namespace {

using std::chrono::floor;
using std::chrono::seconds;

/// Takes what it reads off the front.
class Words {
 public:
  explicit Words(std::string_view text) : m_text(text) {}
  bool take(char c) {
    if (m_text.empty() || m_text.front() != c) return false;
    m_text.remove_prefix(1);
    return true;
  }
  /// Exactly so many digits.
  std::optional<int> number(std::size_t digits) {
    int value = 0;
    if (m_text.size() < digits) return std::nullopt;
    const char* const end = m_text.data() + digits;
    const auto [stop, error] = std::from_chars(m_text.data(), end, value);
    if (error != std::errc() || stop != end || value < 0) return std::nullopt;
    m_text.remove_prefix(digits);
    return value;
  }
  /// What is behind the point, s.
  std::optional<double> fraction() {
    double value = 0.0;
    const std::string text =
        "0." + std::string(m_text.substr(0, m_text.find_first_not_of("0123456789")));
    if (text.size() == 2) return std::nullopt;
    (void)std::from_chars(text.data(), text.data() + text.size(), value);
    m_text.remove_prefix(text.size() - 2);
    return value;
  }
  bool atEnd() const { return m_text.empty(); }

 private:
  std::string_view m_text;
};

struct Moment {
  std::optional<std::array<int, 3>> day;  // year, month, day
  int hour = 0, minute = 0, second = 0;
  double fraction = 0.0;
  bool utc = false;
};

std::optional<Moment> parsed(std::string_view text) {
  Moment moment;
  Words tokens(text);
  if (text.size() > 10 && text[4] == '-') {
    const auto year = tokens.number(4);
    if (!year || !tokens.take('-')) return std::nullopt;
    const auto month = tokens.number(2);
    if (!month || !tokens.take('-')) return std::nullopt;
    const auto day = tokens.number(2);
    if (!day || (!tokens.take('T') && !tokens.take(' '))) return std::nullopt;
    const std::chrono::year_month_day date{std::chrono::year(*year),
                                           std::chrono::month(static_cast<unsigned>(*month)),
                                           std::chrono::day(static_cast<unsigned>(*day))};
    if (!date.ok()) return std::nullopt;
    moment.day = {*year, *month, *day};
  }
  const auto hour = tokens.number(2);
  if (!hour || *hour > 23 || !tokens.take(':')) return std::nullopt;
  const auto minute = tokens.number(2);
  if (!minute || *minute > 59) return std::nullopt;
  moment.hour = *hour;
  moment.minute = *minute;
  if (tokens.take(':')) {
    const auto second = tokens.number(2);
    if (!second || *second > 59) return std::nullopt;
    moment.second = *second;
    if (tokens.take('.')) {
      const auto fraction = tokens.fraction();
      if (!fraction) return std::nullopt;
      moment.fraction = *fraction;
    }
  }
  moment.utc = tokens.take('Z');
  return tokens.atEnd() ? std::optional(moment) : std::nullopt;
}

/// Seconds since 1970.
double wallOf(const Moment& moment, const std::tm& day) {
  std::tm parts{};
  parts.tm_year = day.tm_year;
  parts.tm_mon = day.tm_mon;
  parts.tm_mday = day.tm_mday;  // may be one before or behind the month
  parts.tm_hour = moment.hour;
  parts.tm_min = moment.minute;
  parts.tm_sec = moment.second;
  parts.tm_isdst = -1;
  const std::time_t whole = moment.utc ? timegm(&parts) : mktime(&parts);
  return static_cast<double>(whole) + moment.fraction;
}

double secondsAt(WallTime start, double wall) {
  // The whole seconds apart from the rest: a double holds no nanoseconds since 1970.
  const auto whole = floor<seconds>(start);
  const double rest = std::chrono::duration<double>(start - whole).count();
  return wall - static_cast<double>(whole.time_since_epoch().count()) - rest;
}

/// The moment of a time of day; without its date the one in `range`, or nearest to it.
Result<double> momentOf(const Moment& moment, WallTime start, TimeRange range) {
  if (start.time_since_epoch().count() <= 0) {
    return failure(ErrorCode::InvalidArgument,
                   "This session has no start time. Give the time in seconds of the session.");
  }
  std::tm day{};
  if (moment.day) {
    day.tm_year = (*moment.day)[0] - 1900;
    day.tm_mon = (*moment.day)[1] - 1;
    day.tm_mday = (*moment.day)[2];
    return secondsAt(start, wallOf(moment, day));
  }
  const double begin = std::floor(std::clamp(range.begin, -1e9, 1e9));
  const auto first = static_cast<std::time_t>(floor<seconds>(start).time_since_epoch().count() +
                                              static_cast<std::int64_t>(begin));
  if ((moment.utc ? gmtime_r(&first, &day) : localtime_r(&first, &day)) == nullptr) {
    return failure(ErrorCode::SystemError, "the time zone of this computer cannot be used");
  }
  const auto away = [range](double time) {
    return std::max({0.0, range.begin - time, time - range.end});
  };
  std::array<double, 3> days{};
  for (std::size_t i = 0; i < days.size(); ++i) {
    std::tm one = day;
    one.tm_mday += static_cast<int>(i) - 1;
    days[i] = secondsAt(start, wallOf(moment, one));
  }
  return *std::ranges::min_element(days, {}, away);
}

/// "2026-11-23 14:03:20" by this computer's clock, cut off to the second.
std::string localTime(WallTime start, double time) {
  const auto away = std::chrono::nanoseconds(std::llround(std::clamp(time, -1e9, 1e9) * 1e9));
  const auto whole = floor<seconds>(start + away);
  const auto wall = static_cast<std::time_t>(whole.time_since_epoch().count());
  std::tm parts{};
  char text[32] = "";
  if (localtime_r(&wall, &parts) == nullptr) return {};
  (void)std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &parts);
  return text;
}

std::string quoted(std::string_view text) {
  return '"' + std::string(text.substr(0, 40)) + '"';
}

}  // namespace

Result<double> sessionTime(std::string_view text, WallTime start, TimeRange range, TimeForms forms,
                           std::optional<double> after) {
  constexpr double edge = 1.0;  // s
  const bool clock = forms == TimeForms::Clock && text.find(':') != std::string_view::npos;
  auto time = clock ? std::nullopt : secondsFromText(text);
  const bool ofDay = !time;
  if (ofDay) {
    const auto moment = parsed(text);
    if (!moment || !(moment->day || clock)) {
      return failure(ErrorCode::InvalidArgument,
                     quoted(text) + " is not a time. Write " + sessionTimeForms + '.');
    }
    const double first = std::max(range.begin, after.value_or(range.begin));
    time = TRY(momentOf(*moment, start, {first, range.end}));
  }
  if (*time >= range.begin - edge && *time <= range.end + edge) {
    return std::clamp(*time, range.begin, range.end);
  }
  std::string tokens = quoted(text) + " is outside the session, which goes from " +
                       secondsToText(range.begin) + " to " + secondsToText(range.end);
  if (ofDay) {
    tokens += " (" + localTime(start, range.begin) + " to " + localTime(start, range.end) + ')';
  } else if (text.find(':') != std::string_view::npos) {
    tokens += "; for a time of day add its date or --clock";
  }
  return failure(ErrorCode::InvalidArgument, tokens + '.');
}

}  // namespace pitchboard::telemetry
