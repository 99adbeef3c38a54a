// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_style.h"

#include <QMenu>
#include <QPainter>
#include <QStyleFactory>
#include <QStyleOption>
#include <QTabBar>
#include <algorithm>

#include <ui/base/elide_text.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr double corner = 3.0;

int textGap() {
  return scaled(nullptr, 8);
}
int arrowRoom() {
  return scaled(nullptr, 22);
}

void drawBox(QPainter* painter, const QStyleOption* option, bool pressed) {
  const bool enabled = option->state & QStyle::State_Enabled;
  const bool focused = (option->state & QStyle::State_HasFocus) &&
                       (option->state & QStyle::State_KeyboardFocusChange);
  const bool hovered = enabled && (option->state & QStyle::State_MouseOver);
  painter->setPen(focused   ? theme().accentLine
                  : hovered ? theme().disabledText
                            : theme().innerLine);
  painter->setBrush(pressed ? theme().selectedRow : enabled ? theme().button : theme().window);
  painter->drawRoundedRect(QRectF(option->rect).adjusted(0.5, 0.5, -0.5, -0.5), corner, corner);
}

// Where the keyboard is must be seen at every stop, on every ground.
void drawFocus(QPainter* painter, const QRect& rect) {
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setPen(QPen(theme().accentLine, 1.5));
  painter->setBrush(Qt::NoBrush);
  painter->drawRoundedRect(QRectF(rect).adjusted(1, 1, -1, -1), corner, corner);
  painter->restore();
}

// A box that is seen on every ground of both themes, ticked or not.
void drawCheck(QPainter* painter, const QStyleOption* option) {
  const bool enabled = option->state & QStyle::State_Enabled;
  const bool on = option->state & QStyle::State_On;
  const bool partly = option->state & QStyle::State_NoChange;
  const double side = std::min(option->rect.width(), option->rect.height());
  QRectF box(0, 0, side - 1, side - 1);
  box.moveCenter(QRectF(option->rect).center());
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setPen(enabled ? theme().secondaryText : theme().disabledText);
  painter->setBrush(!(on || partly) ? theme().view
                    : enabled       ? theme().accentFill
                                    : theme().innerLine);
  painter->drawRoundedRect(box, 2, 2);
  painter->setPen(QPen(enabled ? Qt::white : theme().text, side / 8, Qt::SolidLine, Qt::RoundCap));
  const auto at = [&box](double x, double y) {
    return QPointF(box.left() + x * box.width(), box.top() + y * box.height());
  };
  if (on) {
    const QPointF tick[] = {at(0.24, 0.52), at(0.43, 0.71), at(0.77, 0.30)};
    painter->drawPolyline(tick, 3);
  } else if (partly) {
    painter->drawLine(at(0.28, 0.5), at(0.72, 0.5));
  }
  painter->restore();
}

void drawCombo(const QStyleOptionComboBox* option, QPainter* painter) {
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  drawBox(painter, option, option->state & QStyle::State_On);
  const double wide = scaled(nullptr, 8), high = wide / 2;
  const QPointF at(option->rect.right() + 1 - arrowRoom() / 2.0, option->rect.center().y() + 1.0);
  const QPointF arrow[] = {at + QPointF(-wide / 2, -high / 2), at + QPointF(wide / 2, -high / 2),
                           at + QPointF(0, high / 2)};
  painter->setPen(Qt::NoPen);
  painter->setBrush(option->state & QStyle::State_Enabled ? theme().secondaryText
                                                          : theme().disabledText);
  painter->drawPolygon(arrow, 3);
  painter->restore();
}

void drawSlider(const QStyleOptionSlider* option, const QRect& handle, QPainter* painter) {
  const bool enabled = option->state & QStyle::State_Enabled;
  const int thick = scaled(nullptr, 4);
  const QRect all = option->rect;
  const QRectF groove(all.left(), all.center().y() + 1 - thick / 2.0, all.width(), thick);
  const QPointF knob = QRectF(handle).center();
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setPen(Qt::NoPen);
  painter->setBrush(theme().innerLine);
  painter->drawRoundedRect(groove, thick / 2.0, thick / 2.0);
  QRectF done = groove;
  done.setRight(knob.x());
  painter->setBrush(enabled ? theme().accentFill : theme().disabledText);
  painter->drawRoundedRect(done, thick / 2.0, thick / 2.0);
  const double radius = scaled(nullptr, 6);
  const bool held = option->state & QStyle::State_Sunken;
  painter->setPen(QPen(held ? theme().accentLine : theme().window, 1.5));
  painter->setBrush(enabled ? theme().text : theme().disabledText);
  painter->drawEllipse(QPointF(knob.x(), groove.center().y()), radius, radius);
  painter->restore();
}

const QStyleOptionComboBox* plainCombo(QStyle::ComplexControl control,
                                       const QStyleOptionComplex* option) {
  if (control != QStyle::CC_ComboBox) return nullptr;
  const auto* combo = qstyleoption_cast<const QStyleOptionComboBox*>(option);
  return combo && !combo->editable && combo->frame ? combo : nullptr;
}

}  // namespace

FlatStyle::FlatStyle() : QProxyStyle(QStyleFactory::create(QStringLiteral("Fusion"))) {}

void FlatStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option,
                              QPainter* painter, const QWidget* widget) const {
  if (element == PE_FrameFocusRect) {
    // A tab gives the rectangle of its letters, less a little: the frame would strike them out.
    const bool tab = qobject_cast<const QTabBar*>(widget) != nullptr;
    const int wide = tab ? textGap() : 0, high = tab ? textGap() / 2 + 1 : 0;
    drawFocus(painter, option->rect.adjusted(-wide, -high, wide, high));
    return;
  }
  if (element == PE_IndicatorCheckBox || element == PE_IndicatorItemViewItemCheck) {
    drawCheck(painter, option);
    return;
  }
  if (element != PE_PanelButtonCommand) {
    QProxyStyle::drawPrimitive(element, option, painter, widget);
    return;
  }
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  drawBox(painter, option, option->state & (State_Sunken | State_On));
  painter->restore();
}

void FlatStyle::drawComplexControl(ComplexControl control, const QStyleOptionComplex* option,
                                   QPainter* painter, const QWidget* widget) const {
  if (const auto* combo = plainCombo(control, option)) {
    drawCombo(combo, painter);
    m_comboText = combo->currentText;
    m_comboField = subControlRect(CC_ComboBox, combo, SC_ComboBoxEditField, widget);
    if (option->state & State_HasFocus) drawFocus(painter, option->rect);
    return;
  }
  if (control == CC_ToolButton) {
    QProxyStyle::drawComplexControl(control, option, painter, widget);
    if (option->state & State_HasFocus) drawFocus(painter, option->rect);
    return;
  }
  const auto* slider = qstyleoption_cast<const QStyleOptionSlider*>(option);
  if (control == CC_Slider && slider && slider->orientation == Qt::Horizontal &&
      slider->tickPosition == 0) {
    drawSlider(slider, subControlRect(control, option, SC_SliderHandle, widget), painter);
    if (option->state & State_HasFocus) drawFocus(painter, option->rect);
    return;
  }
  QProxyStyle::drawComplexControl(control, option, painter, widget);
}

// A text that does not fit would be cut in the middle of a letter. Which style draws a combo box's
// label depends on the version of Qt (with a style sheet: Fusion up to 6.4, Qt's own style sheets
// in 6.8), but each of them asks here, right after drawComplexControl().
void FlatStyle::drawItemText(QPainter* painter, const QRect& rect, int alignment,
                             const QPalette& palette, bool enabled, const QString& text,
                             QPalette::ColorRole role) const {
  QString shown = text;
  if (text == m_comboText) {
    const int room = std::min(rect.right(), m_comboField.right()) -
                     std::max(rect.left(), m_comboField.left()) + 1;
    shown = elideText(QFontMetricsF(painter->font()), text, room);
    m_comboText.clear();
  }
  QProxyStyle::drawItemText(painter, rect, alignment, palette, enabled, shown, role);
}

// Grey entries of menus say why in their tooltips.
void FlatStyle::polish(QWidget* widget) {
  QProxyStyle::polish(widget);
  if (auto* menu = qobject_cast<QMenu*>(widget)) menu->setToolTipsVisible(true);
}

// The label of a dialog's button says what it does; a coloured tick would repeat it.
int FlatStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                         QStyleHintReturn* more) const {
  if (hint == SH_DialogButtonBox_ButtonsHaveIcons) return 0;
  return QProxyStyle::styleHint(hint, option, widget, more);
}

int FlatStyle::pixelMetric(PixelMetric metric, const QStyleOption* option,
                           const QWidget* widget) const {
  if (metric == PM_ToolBarExtensionExtent) return scaled(widget, 16);
  if (metric == PM_DockWidgetFrameWidth) return 1;
  return QProxyStyle::pixelMetric(metric, option, widget);
}

// Qt's own arrow of a bar whose buttons have no room is black, also on dark. A floating card has
// the buttons of the panels (DockTitle).
QIcon FlatStyle::standardIcon(StandardPixmap icon, const QStyleOption* option,
                              const QWidget* widget) const {
  if (icon == SP_ToolBarHorizontalExtensionButton) {
    return themedIcon(QStringLiteral("arrow-right-double"));
  }
  if (icon == SP_ToolBarVerticalExtensionButton) {
    return themedIcon(QStringLiteral("arrow-down-double"));
  }
  if (icon == SP_TitleBarNormalButton) return themedIcon(QStringLiteral("window-restore"));
  if (icon == SP_TitleBarCloseButton) return themedIcon(QStringLiteral("window-close"));
  return QProxyStyle::standardIcon(icon, option, widget);
}

QRect FlatStyle::subControlRect(ComplexControl control, const QStyleOptionComplex* option,
                                SubControl part, const QWidget* widget) const {
  const auto* combo = plainCombo(control, option);
  if (combo && part == SC_ComboBoxEditField) {
    return visualRect(combo->direction, combo->rect,
                      combo->rect.adjusted(textGap(), 1, -arrowRoom(), -1));
  }
  return QProxyStyle::subControlRect(control, option, part, widget);
}

QSize FlatStyle::sizeFromContents(ContentsType type, const QStyleOption* option,
                                  const QSize& contents, const QWidget* widget) const {
  QSize size = QProxyStyle::sizeFromContents(type, option, contents, widget);
  if (type == CT_ComboBox) {
    size.setWidth(qMax(size.width(), contents.width() + textGap() + arrowRoom() + 2));
  }
  if (type == CT_PushButton) {
    size.setWidth(qMax(size.width(), contents.width() + 3 * textGap()));
  }
  return size;
}

}  // namespace pitchboard::ui
