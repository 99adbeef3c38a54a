// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field in the picture of a camera: where four points of the field are seen says where all of
// its ground is. Field in metres, pictures as shares of width and height from the top left. UI
// thread only; pure functions.

#include <QTransform>
#include <optional>
#include <span>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <simcore/world/field.h>
#include <telemetry/session/session_videos.h>

class QPainter;

namespace pitchboard::ui {

/// Points of a field that can be recognized in a picture.
struct FieldMark {
  QString name;
  Point place;  ///< m
};

/// The corners of the field first, then other points of its lines.
std::vector<FieldMark> fieldMarks(const sim::FieldSpec& field);

/// Returns the projection of the ground into the picture; empty without four points, or if three
/// of them are in one line.
std::optional<QTransform> groundToPicture(std::span<const telemetry::VideoLandmark> landmarks);

/// Draws lines, robots and ball of a frame. `toPicture` leads from metres to the painter's units;
/// what is behind the camera is left out.
void paintOverlay(QPainter& painter, const QTransform& toPicture, const link::MatchFrame& frame);
/// The same over a picture that fills this rectangle.
void paintOverlay(QPainter& painter, const QTransform& groundToPicture, const QRectF& rect,
                  const link::MatchFrame& frame);

}  // namespace pitchboard::ui
