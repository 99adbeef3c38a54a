// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Fusion without its gradients: combo boxes, push buttons and sliders as flat as the rest of the
// window. Colours come from theme(). UI thread only.

#include <QProxyStyle>

namespace pitchboard::ui {

class FlatStyle : public QProxyStyle {
  Q_OBJECT
 public:
  FlatStyle();

  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override;
  void drawComplexControl(ComplexControl control, const QStyleOptionComplex* option,
                          QPainter* painter, const QWidget* widget) const override;
  void drawItemText(QPainter* painter, const QRect& rect, int alignment, const QPalette& palette,
                    bool enabled, const QString& text, QPalette::ColorRole role) const override;
  using QProxyStyle::polish;
  void polish(QWidget* widget) override;
  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* more) const override;
  int pixelMetric(PixelMetric metric, const QStyleOption* option,
                  const QWidget* widget) const override;
  QIcon standardIcon(StandardPixmap icon, const QStyleOption* option,
                     const QWidget* widget) const override;
  QRect subControlRect(ComplexControl control, const QStyleOptionComplex* option, SubControl part,
                       const QWidget* widget) const override;
  QSize sizeFromContents(ContentsType type, const QStyleOption* option, const QSize& contents,
                         const QWidget* widget) const override;

 private:
  /// The text of the combo box that was drawn last and the room for it; empty once it was drawn.
  mutable QString m_comboText;
  mutable QRect m_comboField;
};

}  // namespace pitchboard::ui
