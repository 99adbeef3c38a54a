// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field as a picture without window, for files and documents.

#include <span>
#include <vector>

#include <telemetry/session/drawn_notes.h>
#include <QByteArray>
#include <QFontMetricsF>
#include <QImage>

#include <ui/sources/field_pictures.h>

#include "field_scene.h"

namespace pitchboard::ui {

/// What is written over a picture: score, clock, part of the game, state and penalties; with little
/// room, less of the state and no penalties. The clock alone if no team is known.
QString pictureCaption(const link::MatchFrame& frame, const QFontMetricsF& metrics, double width);

/// The largest picture within `size` pixels that the field with its border fills; both sides are
/// even, as videos want them.
QSize pictureSize(const sim::FieldSpec& field, QSize within);

/// The whole field as large as it fits into `size` pixels, without selection marks, and over it
/// score, match clock and state: a file has no window round it that tells them. Of `notes`, those
/// of the moment are drawn. UI thread; the scene is as before afterwards.
QImage paintPicture(FieldScene& scene, QSize size,
                    std::span<const telemetry::DrawnNote> notes = {});

/// The same as an SVG document, whose user unit is one pixel of `size`. Empty when it cannot be
/// made.
QByteArray svgPicture(FieldScene& scene, QSize size,
                      std::span<const telemetry::DrawnNote> notes = {});

/// Moments one after another, each on a field of its own. UI thread only.
class FilmPainter : public FramePainter {
 public:
  /// Side and layers are taken from `style`.
  FilmPainter(const FieldStyle& style, std::vector<telemetry::DrawnNote> notes);
  QImage paint(const FramePtr& frame, QSize size) override;

 private:
  FieldScene m_scene;
  std::vector<telemetry::DrawnNote> m_notes;
};

}  // namespace pitchboard::ui
