// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The layers that can be shown or hidden on the field. The layers menu, the settings and the
// defaults all use this table. Constant data; any thread.

#include <array>
#include <cstddef>

namespace pitchboard::ui {

/// In the order of the layers menu.
enum class FieldLayer {
  FieldOfView,
  Belief,
  Ghost,
  PerceivedBall,
  Trails,
  Numbers,
  Grid,
  Landmarks,
  Eopra,
  StarVars,
  Particles,
  PlannedPath,
  Exploration,
  Drawings
};

struct FieldLayerInfo {
  FieldLayer layer;
  const char* key;   ///< name in the settings; must never change
  const char* name;  ///< name on the screen
  bool shown;        ///< by default
};

inline constexpr std::array fieldLayers{
    FieldLayerInfo{FieldLayer::FieldOfView, "fieldOfView", "Field of view", true},
    FieldLayerInfo{FieldLayer::Belief, "belief", "Belief", true},
    FieldLayerInfo{FieldLayer::Ghost, "ghost", "Ghost at the believed pose", true},
    FieldLayerInfo{FieldLayer::PerceivedBall, "perceivedBall", "Perceived ball", true},
    FieldLayerInfo{FieldLayer::Trails, "trails", "Trails", true},
    FieldLayerInfo{FieldLayer::Numbers, "numbers", "Numbers", true},
    FieldLayerInfo{FieldLayer::Grid, "grid", "Coordinate grid", false},
    FieldLayerInfo{FieldLayer::Landmarks, "landmarks", "Landmarks", false},
    FieldLayerInfo{FieldLayer::Eopra, "eopra", "EOPRA sectors", false},
    FieldLayerInfo{FieldLayer::StarVars, "starVars", "StarVars sectors", false},
    FieldLayerInfo{FieldLayer::Particles, "particles", "Localization particles", false},
    FieldLayerInfo{FieldLayer::PlannedPath, "plannedPath", "Planned path", false},
    FieldLayerInfo{FieldLayer::Exploration, "exploration", "Exploration", true},
    FieldLayerInfo{FieldLayer::Drawings, "drawings", "Drawings", true},
};
inline constexpr std::size_t fieldLayerCount = fieldLayers.size();

static_assert(
    [] {
      for (std::size_t i = 0; i < fieldLayerCount; ++i) {
        if (fieldLayers[i].layer != static_cast<FieldLayer>(i)) return false;
      }
      return fieldLayers.back().layer == FieldLayer::Drawings;
    }(),
    "fieldLayers has one row for each FieldLayer, in its order");

}  // namespace pitchboard::ui
