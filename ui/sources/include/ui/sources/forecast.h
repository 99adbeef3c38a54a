// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What may follow a moment, as the field draws it: where the ball will be, and the action that is
// best for a robot. Made by the panel Explore, drawn by the field. An immutable value; UI thread.

#include <QString>
#include <memory>
#include <optional>

#include <robotlink/frame/advice_view.h>

namespace pitchboard::ui {

/// An action drawn as an arrow, or as a ring if it has no target. Metres, the studio's frame.
struct ForecastAction {
  Point from;
  std::optional<Point> to;
  QString text;
  bool isClear = true;  ///< false: others may be as good, so the arrow is dashed
};

struct Forecast {
  std::shared_ptr<const link::BallHeat> heat;  ///< null: none
  std::optional<ForecastAction> best;
};
using ForecastPtr = std::shared_ptr<const Forecast>;

}  // namespace pitchboard::ui
