// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What all things drawn on the field share: zoom, side, layers, field size; and painting in screen
// pixels at a place of the scene, so that numbers stay upright and strokes keep their width at any
// zoom. The scene is in metres, +y up: the view's transform mirrors y.

#include <QColor>
#include <QFont>
#include <QPainter>
#include <QPointF>
#include <QRectF>
#include <QString>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>

#include <base/geometry.h>
#include <base/robot_key.h>
#include <simcore/world/field.h>
#include <ui/field/field_layers.h>

namespace pitchboard::ui {

/// Which drawings of the robots' programs are not shown, by layer's name and robot.
struct DrawingChoice {
  bool onlySelected = false;
  std::set<std::string> hiddenLayers;
  std::set<RobotKey> hiddenRobots;
  std::set<std::pair<RobotKey, std::string>> hidden;

  bool shows(const RobotKey& robot, const std::string& layer) const {
    return !hiddenRobots.contains(robot) && !hiddenLayers.contains(layer) &&
           !hidden.contains({robot, layer});
  }
};

constexpr std::array<bool, fieldLayerCount> shownAtFirst() {
  std::array<bool, fieldLayerCount> shown{};
  for (std::size_t i = 0; i < fieldLayerCount; ++i) shown[i] = fieldLayers[i].shown;
  return shown;
}

inline double distance(const QPointF& a, const QPointF& b) {
  return std::hypot(a.x() - b.x(), a.y() - b.y());
}

/// Radius of a disc or ring in which a number can be read, pixels.
inline constexpr double readable_px = 6.5;

struct FieldStyle {
  double pixelsPerMetre = 60.0;  ///< of the view; items size their bounding rectangles by it
  bool flipped = false;          ///< seen from the other side
  bool readOnly = false;         ///< no handles
  bool ornaments = true;         ///< selection rings and handles; off in pictures for files
  bool wedgeForAll = false;      ///< field of view of all robots, else of the selected ones
  int eopraGranularity = 4;      ///< m = 4 or 6
  sim::FieldSpec field;
  std::array<bool, fieldLayerCount> layers = shownAtFirst();
  DrawingChoice drawings;

  bool shows(FieldLayer layer) const { return layers[static_cast<std::size_t>(layer)]; }
  /// A length that is at least so many pixels on the screen, metres.
  double atLeast(double metres, double pixels) const;
  double metres(double pixels) const { return pixels / pixelsPerMetre; }
  QRectF playingArea() const;      ///< with its border, metres
  double robotDrawRadius() const;  ///< metres; never smaller than a dot that can be hit
  /// The same for a robot of its own size; 0 = the field's.
  double drawRadius(double own) const {
    return own > 0.0 ? atLeast(own, minRobot_px()) : robotDrawRadius();
  }
  /// A number can be read in it and a hand meets it; in a picture for a file it may be smaller.
  double minRobot_px() const { return ornaments ? 9.0 : 5.0; }
  double ballDrawRadius() const;  ///< metres
};

inline QPointF toScene(const Point& p) {
  return {p.x, p.y};
}
inline Point fromScene(const QPointF& p) {
  return {p.x(), p.y()};
}

/// Replaces the painter's transform by pixels round a scene point for its lifetime. Angles given to
/// screenYaw() are field angles; on the screen y points down and the field may be turned round.
class ScreenPainting {
 public:
  ScreenPainting(QPainter* painter, const QPointF& itemPoint);
  ~ScreenPainting();
  ScreenPainting(const ScreenPainting&) = delete;
  ScreenPainting& operator=(const ScreenPainting&) = delete;

  double pixelsPerMetre() const { return m_scale; }
  /// A field vector in metres as a vector in pixels.
  QPointF pixels(const QPointF& metres) const;
  /// The direction of a field yaw (radians) on the screen, a unit vector in pixels.
  QPointF direction(double yaw) const;

 private:
  QPainter* m_painter;
  QTransform m_before;
  double m_scale;
  double m_signX, m_signY;
};

/// The application's font in bold or plain with this pixel height, cached.
const QFont& fieldFont(int pixelSize, bool bold);
/// `color` as it looks with this opacity on grass. Opaque colours are painted several times faster:
/// Qt hands the spans of translucent shapes to a pool of threads, piece by piece.
QColor onGrass(const QColor& color, double opacity);
/// Text centred on a point in pixels, with a thin shade behind it so that it reads on any ground.
void drawHaloText(QPainter* painter, const QPointF& centre, const QString& text, const QFont& font,
                  const QColor& color, const QColor& halo);
/// The same on a plate of its own: for text that must be read on grass, lines and robots alike.
void drawPlateText(QPainter* painter, const QPointF& centre, const QString& text);
/// How much room that takes, pixels.
QSizeF plateSize(const QString& text);
/// Fixed decimals and a real minus sign.
QString fieldNumber(double value, int decimals);

}  // namespace pitchboard::ui
