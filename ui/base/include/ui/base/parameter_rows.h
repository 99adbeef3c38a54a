// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rows of a form for numbers that can be changed during a match: name, slider, value with unit. UI
// thread only.

#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <functional>

#include <simcore/world/parameters.h>
#include <ui/base/number_box.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {

/// A slider and a spin box for the same number.
class ParameterRow : public QObject {
 public:
  /// Adds a row to the grid. `edited` is called with the shown value after changes by the user
  /// only.
  ParameterRow(QGridLayout* grid, const QString& name, const QString& tip,
               const sim::ShownParameter& shown, std::function<void(double)> edited,
               QWidget* parent)
      : QObject(parent),
        m_slider(new QSlider(Qt::Horizontal, parent)),
        m_box(new NumberBox(parent)),
        m_edited(std::move(edited)) {
    auto* label = new QLabel(name, parent);
    label->setToolTip(tip);
    label->setBuddy(m_box);
    m_box->setDecimals(shown.decimals);
    m_box->setRange(shown.least, shown.most);
    m_box->setSuffix(QString::fromUtf8(shown.unit));
    m_box->setSingleStep((shown.most - shown.least) / 50);
    m_box->setAlignment(Qt::AlignRight);
    m_box->setKeyboardTracking(false);
    m_box->setButtonSymbols(QAbstractSpinBox::NoButtons);  // the slider is the quick way
    m_box->setToolTip(tip);
    m_box->setAccessibleName(name);
    m_box->setMinimumWidth(scaled(parent, 108));
    m_slider->setRange(0, steps);
    m_slider->setMinimumWidth(scaled(parent, 60));
    m_slider->setToolTip(tip);
    m_slider->setFocusPolicy(Qt::NoFocus);
    const int row = grid->rowCount();
    grid->addWidget(label, row, 0);
    grid->addWidget(m_slider, row, 1);
    grid->addWidget(m_box, row, 2);
    connect(m_slider, &QSlider::valueChanged, this, [this](int at) {
      const double range = m_box->maximum() - m_box->minimum();
      m_box->setValue(m_box->minimum() + range * at / steps);
    });
    connect(m_box, &NumberBox::valueChanged, this, [this](double value) {
      moveSlider();
      m_edited(value);
    });
  }

  void setEnabled(bool enabled) {
    m_slider->setEnabled(enabled);
    m_box->setEnabled(enabled);
  }

  /// Shows a value without calling `edited`. Does nothing while the user edits the row.
  void show(double value) {
    if (m_box->hasFocus() || m_slider->isSliderDown()) return;
    const QSignalBlocker quiet(m_box);
    m_box->setValue(value);
    moveSlider();
  }

 private:
  static constexpr int steps = 200;
  void moveSlider() {
    const QSignalBlocker quiet(m_slider);
    const double range = m_box->maximum() - m_box->minimum();
    m_slider->setValue(qRound((m_box->value() - m_box->minimum()) / range * steps));
  }

  QSlider* m_slider;
  NumberBox* m_box;
  std::function<void(double)> m_edited;
};

}  // namespace pitchboard::ui
