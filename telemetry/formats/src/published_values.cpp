// SPDX-License-Identifier: GPL-3.0-or-later
#include "published_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <base/angles.h>
#include <telemetry/formats/meanings.h>

#include "field_values.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t noIndex = std::numeric_limits<std::size_t>::max();
constexpr double perMetre = 100.0, perVolt = 10.0, percent = 100.0;
// Beyond it no field ends; what was sent stays in the message's own columns.
constexpr double farAway = 1e6;
// s. A ball that was seen before that is a memory: it may have rolled anywhere since.
constexpr double maxBallAge = 2.0;

/// Null for what is taken as it is sent.
const MeaningInfo* publishedOf(FieldMeaning meaning) {
  return info(meaning).kind == UnitKind::None ? nullptr : &info(meaning);
}

bool isOfBall(FieldMeaning meaning) {
  return meaning == FieldMeaning::BallX || meaning == FieldMeaning::BallY ||
         meaning == FieldMeaning::BallFieldX || meaning == FieldMeaning::BallFieldY ||
         meaning == FieldMeaning::BallSeen || meaning == FieldMeaning::BallAge;
}

/// The message has the value in another unit than the published one.
bool differs(const ProfileField& field) {
  const MeaningInfo* known = publishedOf(field.meaning);
  const Unit* unit = unitNamed(field.unit);
  if (known == nullptr || known->variable.empty() || unit == nullptr) return false;
  return unit->kind == known->kind && unit->factor != unitNamed(known->unit)->factor;
}

bool isPosition(FieldMeaning meaning) {
  return meaning == FieldMeaning::X || meaning == FieldMeaning::Y || meaning == FieldMeaning::Theta;
}

double degrees(double radians) {
  double angle = std::fmod(degreesFromRadians(radians), 360.0);
  // As LOCALIZATION_THETA: 0 to 360. A sum so small that 360 comes out is 0.
  if (angle < 0.0) angle += 360.0;
  return angle >= 360.0 ? 0.0 : angle;
}

double signedDegrees(double radians) {
  return degreesFromRadians(std::remainder(radians, 2 * std::numbers::pi));
}

/// Factors as 0.01 leave traces such as 150.00000000000003.
double tidy(double value) {
  if (!std::isfinite(value)) return missing;
  return std::abs(value) < 1e9 ? std::round(value * 1e6) / 1e6 : value;
}

}  // namespace

bool isPublishedForm(const Profile& profile) {
  return profile.format == MessageFormat::Words && profile.frame == MessageFrame{};
}

bool unitFits(FieldMeaning meaning, std::string_view unit) {
  const MeaningInfo* known = publishedOf(meaning);
  if (known == nullptr) return true;
  const Unit* found = unitNamed(unit);
  return found != nullptr && found->kind == known->kind;
}

std::string unitsOf(FieldMeaning meaning) {
  const MeaningInfo* known = publishedOf(meaning);
  if (known == nullptr) return "any";
  switch (known->kind) {
    case UnitKind::Length:
      return "m, cm or mm";
    case UnitKind::Angle:
      return "rad or °";
    case UnitKind::Voltage:
      return "V, 0.1 V or mV";
    case UnitKind::Time:
      return "s, ms, µs or ns";
    case UnitKind::None:
    case UnitKind::AngularRate:
    case UnitKind::Share:
      break;
  }
  return "% or 1";
}

struct PublishedValues::Pose {
  double x = missing, y = missing,
         yaw = missing;  // m from the centre, +x right, +y left of it; rad
};

PublishedValues::PublishedValues(const Profile& sent, const Surroundings& where)
    : m_shown(sent), m_frame(sent.frame), m_where(where) {
  m_indices.fill(noIndex);
  m_factors.fill(1.0);
  std::array<bool, fieldMeaningCount> wanted{};  // published values to be made
  for (std::size_t i = 0; i < sent.fields.size(); ++i) {
    const ProfileField& field = sent.fields[i];
    const auto meaning = static_cast<std::size_t>(field.meaning);
    if (field.meaning != FieldMeaning::None) m_indices[meaning] = i;
    if (const MeaningInfo* known = publishedOf(field.meaning)) {
      const Unit* unit = unitNamed(field.unit);
      const bool fits = unit != nullptr && unit->kind == known->kind;
      if (!known->unit.empty()) m_factors[meaning] = unitNamed(known->unit)->factor;
      if (fits) m_factors[meaning] = unit->factor;
    }
    const bool framed = isPosition(field.meaning) && !(m_frame == MessageFrame{});
    if (framed || differs(field)) wanted[meaning] = true;
    if (isOfBall(field.meaning)) {
      wanted[static_cast<std::size_t>(FieldMeaning::BallDistance)] = true;
      wanted[static_cast<std::size_t>(FieldMeaning::BallAngle)] = true;
    }
  }
  const auto give = [this](std::size_t index, const MeaningInfo& known) {
    ProfileField& field = m_shown.fields[index];
    field.meaning = known.meaning;
    field.unit = known.unit;
    m_made.push_back({index, known.meaning});
  };
  for (std::size_t i = 0; i < sent.fields.size(); ++i) {
    const ProfileField& field = sent.fields[i];
    if (field.variable.empty()) continue;
    ProfileField& shown = m_shown.fields[i];
    shown.key = field.sentName();
    shown.name = field.variable;
    const auto unit = where.unitOf ? where.unitOf(field.variable) : std::string();
    const MeaningInfo* known = publishedOf(field.meaning);
    if (known != nullptr && !known->variable.empty() &&
        (unit == known->unit || unit.empty() || field.variable == known->variable)) {
      if (wanted[static_cast<std::size_t>(field.meaning)]) give(i, *known);
      shown.unit = known->unit;
      wanted[static_cast<std::size_t>(field.meaning)] = false;
    } else if (const auto factor = unitFactor(field.unit, unit)) {
      if (*factor != 1.0) m_scaled.push_back({i, *factor});
      shown.unit = unit;
    }
  }
  for (const MeaningInfo& known : meaningTable) {
    if (!wanted[static_cast<std::size_t>(known.meaning)] || known.variable.empty()) continue;
    if (m_shown.fields.size() >= DecodedText::maxValues) break;
    for (ProfileField& field : m_shown.fields) {
      if (field.meaning == known.meaning) field.meaning = FieldMeaning::None;
    }
    const auto same =
        std::find_if(m_shown.fields.begin(), m_shown.fields.end(),
                     [&known](const ProfileField& field) { return field.name == known.variable; });
    if (same != m_shown.fields.end() &&
        m_indices[static_cast<std::size_t>(known.meaning)] ==
            static_cast<std::size_t>(same - m_shown.fields.begin())) {
      give(static_cast<std::size_t>(same - m_shown.fields.begin()), known);
      continue;
    }
    ProfileField made;
    made.name = known.variable;
    if (same != m_shown.fields.end()) made.name += "_PUBLISHED";  // theirs is something else
    made.category = known.category;
    m_shown.fields.push_back(made);
    give(m_shown.fields.size() - 1, known);
  }
  for (const Made& made : m_made) m_changed.push_back(made.index);
  for (const Scaled& scaled : m_scaled) m_changed.push_back(scaled.index);
  m_shown.frame = {};
}

double PublishedValues::sent(std::span<const double> values, FieldMeaning meaning) const {
  const auto index = static_cast<std::size_t>(meaning);
  return m_indices[index] == noIndex ? missing : values[m_indices[index]] * m_factors[index];
}

PublishedValues::Pose PublishedValues::pose(std::span<const double> values) const {
  Pose out;
  double x = sent(values, FieldMeaning::X), y = sent(values, FieldMeaning::Y);
  double yaw = sent(values, FieldMeaning::Theta);
  if (!m_frame.centre) {
    x -= m_where.length / 2;
    y -= m_where.width / 2;
  }
  if (!m_frame.yLeft) y = -y;
  if (m_frame.clockwise) yaw = -yaw;
  const bool turned = m_frame.x == MessageFrame::XAxis::Left ||
                      (m_frame.x == MessageFrame::XAxis::Opponents && m_where.attacksLeft);
  if (turned) {
    x = -x;
    y = -y;
    yaw += std::numbers::pi;
  }
  out.x = std::clamp(x, -farAway, farAway);
  out.y = std::clamp(y, -farAway, farAway);
  out.yaw = yaw;
  return out;
}

void PublishedValues::ball(std::span<const double> values, double& distance_cm,
                           double& bearing_deg) const {
  distance_cm = bearing_deg = missing;
  const auto has = [this](FieldMeaning meaning) {
    return m_indices[static_cast<std::size_t>(meaning)] != noIndex;
  };
  if (has(FieldMeaning::BallSeen) && !(sent(values, FieldMeaning::BallSeen) > 0.0)) return;
  if (has(FieldMeaning::BallAge)) {
    const double age = sent(values, FieldMeaning::BallAge);
    if (!(age >= 0.0 && age <= maxBallAge)) return;
  }
  if (has(FieldMeaning::BallDistance) && has(FieldMeaning::BallAngle)) {
    const double distance = sent(values, FieldMeaning::BallDistance);
    const double bearing = sent(values, FieldMeaning::BallAngle);
    distance_cm = distance * perMetre;
    bearing_deg = signedDegrees(m_frame.clockwise ? -bearing : bearing);
    return;
  }
  double ahead = sent(values, FieldMeaning::BallX), left = sent(values, FieldMeaning::BallY);
  if (!has(FieldMeaning::BallX)) {
    // On the field: as a robot of that pose sees it. Turning the field turns both.
    const double x = sent(values, FieldMeaning::BallFieldX) - sent(values, FieldMeaning::X);
    double y = sent(values, FieldMeaning::BallFieldY) - sent(values, FieldMeaning::Y);
    if (!m_frame.yLeft) y = -y;
    double yaw = sent(values, FieldMeaning::Theta);
    if (m_frame.clockwise) yaw = -yaw;
    ahead = x * std::cos(yaw) + y * std::sin(yaw);
    left = y * std::cos(yaw) - x * std::sin(yaw);
  }
  distance_cm = std::hypot(ahead, left) * perMetre;
  bearing_deg = signedDegrees(std::atan2(left, ahead));
}

double PublishedValues::published(std::span<const double> values, FieldMeaning meaning) const {
  switch (meaning) {
    case FieldMeaning::X:
      return (pose(values).x + m_where.length / 2) * perMetre;
    case FieldMeaning::Y:
      return (m_where.width / 2 - pose(values).y) * perMetre;
    case FieldMeaning::Theta:
      return degrees(pose(values).yaw);
    case FieldMeaning::Belief:
      return sent(values, meaning) * perMetre;
    case FieldMeaning::Voltage:
      return sent(values, meaning) * perVolt;
    case FieldMeaning::Charge:
      return sent(values, meaning) * percent;
    case FieldMeaning::BallDistance:
    case FieldMeaning::BallAngle: {
      double distance = missing, bearing = missing;
      ball(values, distance, bearing);
      return meaning == FieldMeaning::BallDistance ? distance : bearing;
    }
    default:
      return sent(values, meaning);
  }
}

std::span<const std::size_t> PublishedValues::convert(std::span<double> values) const {
  if (m_changed.empty()) return {};
  std::array<double, fieldMeaningCount> made{};
  for (std::size_t i = 0; i < m_made.size(); ++i) {
    made[i] = tidy(published(values, m_made[i].meaning));
  }
  for (const Scaled& scaled : m_scaled) {
    values[scaled.index] = tidy(values[scaled.index] * scaled.factor);
  }
  for (std::size_t i = 0; i < m_made.size(); ++i) values[m_made[i].index] = made[i];
  return m_changed;
}

}  // namespace pitchboard::telemetry
