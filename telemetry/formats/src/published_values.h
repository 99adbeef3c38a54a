// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// From the frame and the units of a team's message to those of the published one (cm from the
// field's corner, degrees, tenths of a volt), in which the rest of the program knows robots.
// Private to formats. Any thread.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <telemetry/formats/text_decoder.h>

namespace pitchboard::telemetry {

/// True when the published meaning of every field may be taken from the message as it is: no frame,
/// format or unit of its own.
bool isPublishedForm(const Profile& profile);

/// The unit says how to convert a field of this meaning. A meaning without a unit fits every text.
bool unitFits(FieldMeaning meaning, std::string_view unit);
/// "m, cm or mm".
std::string unitsOf(FieldMeaning meaning);

/// A profile as its values are shown, and how they are made of what is sent.
class PublishedValues {
 public:
  PublishedValues(const Profile& sent, const Surroundings& where);

  /// The sent fields, of which some are variables under their published names, then those made of
  /// several. Meanings stand at published units only.
  const Profile& shown() const { return m_shown; }
  /// Values of the sent fields in, values of the shown ones out: the same array, with room for
  /// shown().fields. Returns the places that differ from what was sent.
  std::span<const std::size_t> convert(std::span<double> values) const;

 private:
  struct Made {
    std::size_t index = 0;
    FieldMeaning meaning = FieldMeaning::None;
  };
  struct Scaled {
    std::size_t index = 0;
    double factor = 1.0;
  };
  double sent(std::span<const double> values, FieldMeaning meaning) const;
  double published(std::span<const double> values, FieldMeaning meaning) const;
  struct Pose;
  Pose pose(std::span<const double> values) const;
  void ball(std::span<const double> values, double& distance_cm, double& bearing_deg) const;

  Profile m_shown;
  MessageFrame m_frame;
  Surroundings m_where;
  std::array<std::size_t, fieldMeaningCount> m_indices{};
  std::array<double, fieldMeaningCount> m_factors{};  ///< to m, rad, V, s
  std::vector<Made> m_made;
  std::vector<Scaled> m_scaled;
  std::vector<std::size_t> m_changed;
};

}  // namespace pitchboard::telemetry
