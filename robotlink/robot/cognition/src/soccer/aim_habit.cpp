// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/aim_habit.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include <base/byte_sizes.h>
#include <base/lined_json.h>
#include <base/read_file.h>
#include <base/repeatable_math.h>
#include <base/try.h>

namespace pitchboard::link {
namespace {

// Whoever is as far behind is still remembered when the opponents change what they do.
constexpr std::uint16_t maxBehind = 12000;
constexpr double unit = 0.001;
// Before anything was seen: opponents like our own robots, and all peculiarities alike.
constexpr double defaultShare = 0.5;
constexpr std::size_t defaultAim = 3;
constexpr std::size_t maxFileBytes = 16 * kibibyte;

double density(double x, double mean, double sigma) {
  constexpr double root2Pi = 2.5066282746310002;
  const double z = (x - mean) / sigma;
  return repeatable::exp(-0.5 * z * z) / (sigma * root2Pi);
}

/// Half of the goal's width for the middle of the ball.
double halfGoal(const sim::FieldSpec& field) {
  return field.goalWidth / 2 - field.goalPostRadius - field.ballRadius;
}

}  // namespace

void AimHabit::add(const std::array<double, aims.size()>& logs) {
  std::array<double, aims.size()> all{};
  for (std::size_t i = 0; i < aims.size(); ++i) all[i] = logs[i] - unit * behind[i];
  const double best = *std::ranges::max_element(all);
  for (std::size_t i = 0; i < aims.size(); ++i) {
    const double lost = std::min<double>((best - all[i]) / unit, maxBehind);
    behind[i] = static_cast<std::uint16_t>(std::lround(lost));
  }
}

void AimHabit::addKick(const sim::FieldSpec& field, const Point& from, const Point& to) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  constexpr double forward = 0.5;  // m per metre
  if (dx < forward * length(Point{dx, dy})) return;
  const double left = field.halfLength() - from.x;
  constexpr double far = 4.0;  // m; no robot shoots at the goal from farther away
  if (left <= 0.0 || left > far) return;
  const double y = from.y + left * dy / dx;  // where it crosses the goal line
  constexpr double error = 0.1;              // rad: of the kick, and of the ways that were seen
  constexpr double spread = 0.4;             // of half of the part of the goal
  constexpr double elsewhere = 0.2;          // of the balls roll by chance, or as a pass
  std::array<double, aims.size()> logs{};
  for (std::size_t i = 0; i < aims.size(); ++i) {
    const double middle = aims[i] * halfGoal(field);
    const double part = halfGoal(field) * (1.0 - std::abs(aims[i]));
    const double sigma = repeatable::hypot(spread * part, error * left);
    logs[i] =
        repeatable::log((1.0 - elsewhere) * density(y, middle, sigma) + elsewhere / field.width);
  }
  add(logs);
}

std::array<double, AimHabit::aims.size()> AimHabit::shares() const {
  std::array<double, aims.size()> shares{};
  double sum = 0.0;
  for (std::size_t i = 0; i < aims.size(); ++i) {
    const double prior = i == defaultAim ? defaultShare : (1.0 - defaultShare) / (aims.size() - 1);
    shares[i] = prior * repeatable::exp(-unit * behind[i]);
    sum += shares[i];
  }
  for (double& share : shares) share /= sum;
  return shares;
}

double AimHabit::meanAim() const {
  const auto all = shares();
  double sum = 0.0;
  for (std::size_t i = 0; i < aims.size(); ++i) sum += all[i] * aims[i];
  return sum;
}

std::array<std::int32_t, AimHabit::words> AimHabit::asWords() const {
  std::array<std::int32_t, words> out{};
  for (std::size_t i = 0; i < aims.size(); ++i) out[i / 2] |= behind[i] << (16 * (i % 2));
  return out;
}

AimHabit AimHabit::fromWords(const std::array<std::int32_t, words>& all) {
  AimHabit out;
  for (std::size_t i = 0; i < aims.size(); ++i) {
    const auto bits = static_cast<std::uint32_t>(all[i / 2]) >> (16 * (i % 2));
    out.behind[i] = std::min(static_cast<std::uint16_t>(bits & 0xffffU), maxBehind);
  }
  return out;
}

double keeperShift(const AimHabit& habit, const sim::FieldSpec& field) {
  // Half of the way to where the ball comes: it also has to reach the rest of the goal, and stands
  // before the line, where the ways of the ball are nearer to each other.
  constexpr double share = 0.5;
  return -share * halfGoal(field) * habit.meanAim();  // their right is the keeper's left
}

std::string habitToJson(const AimHabit& habit) {
  return nlohmann::ordered_json{{"version", 1}, {"aim", habit.behind}}.dump() + '\n';
}

Result<AimHabit> habitFromJson(std::string_view text, std::string_view source) {
  constexpr int maxInFile = 65535;
  JsonReport report(source);
  const auto root = parseJson(text, report);
  AimHabit read;
  if (root) {
    const JsonObject file(report, *root, "", {"version", "aim", "keeper", "pace"});
    for (const std::string_view key : {"version", "aim"}) file.require(key);
    (void)file.integer("version", 1, 1, 1);
    const auto* items = file.array("aim", read.behind.size());
    if (items && items->size() != read.behind.size()) {
      file.fail("aim", "must have " + std::to_string(read.behind.size()) + " numbers");
    } else if (items) {
      for (std::size_t i = 0; i < items->size(); ++i) {
        const JsonNode& item = (*items)[i];
        const bool isWhole = item.kind == JsonNode::Kind::Number && item.number >= 0.0 &&
                             item.number <= maxInFile && item.number == std::floor(item.number);
        if (!isWhole) file.fail("aim", "must have whole numbers from 0 to 65535");
        if (isWhole) read.behind[i] = static_cast<std::uint16_t>(item.number);
      }
    }
  }
  if (report.failed()) return tl::unexpected(report.error());
  return AimHabit::fromWords(read.asWords());
}

Result<AimHabit> loadHabit(const std::string& path) {
  const auto text = readFile(path, maxFileBytes, "what the advisor has learned");
  if (!text && text.error().code == ErrorCode::NotFound) return AimHabit{};
  if (!text) return tl::unexpected(text.error());
  return habitFromJson(*text, path);
}

}  // namespace pitchboard::link
