// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The mean of a value over the field. Squares with few samples are pale; the pointer shows how many
// there are. UI thread only. Metres, in the studio's frame.

#include <QWidget>
#include <optional>
#include <string>

#include <simcore/world/field.h>
#include <telemetry/statistics/curve_statistics.h>

namespace pitchboard::ui {

/// Returns squares that cover a field and its border.
telemetry::MapGrid gridOf(const sim::FieldSpec& field);

class FieldMap : public QWidget {
  Q_OBJECT
 public:
  explicit FieldMap(QWidget* parent);
  /// Shows a map; nothing: an empty field. `unit` is that of the values.
  void show(const std::optional<telemetry::ValueMap>& map, const std::string& unit,
            const sim::FieldSpec& field);
  /// Returns the text for a place of the widget; empty where nothing is known.
  QString textAt(const QPoint& place) const;
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  QRectF area() const;
  QRectF cellArea(int column, int row) const;
  void paintLegend(QPainter& painter) const;

  std::optional<telemetry::ValueMap> m_map;
  std::string m_unit;
  sim::FieldSpec m_field;
  double m_least = 0.0, m_most = 0.0;  // of the means
  double m_usual = 1.0;                // samples of a square that is not pale
};

}  // namespace pitchboard::ui
