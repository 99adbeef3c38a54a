// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The base of panels that are a form which scrolls vertically. A subclass fills the column and then
// calls finishForm(). UI thread only.

#include <QScrollArea>
#include <QVBoxLayout>

#include <ui/base/theme.h>

namespace pitchboard::ui {

class ScrolledForm : public QScrollArea {
 protected:
  /// `top`: distance above the first part, in pixels of the design.
  ScrolledForm(QWidget* parent, int top)
      : QScrollArea(parent), m_form(new QWidget(this)), m_column(new QVBoxLayout(m_form)) {
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    const int edge = scaled(this, 8);
    m_column->setContentsMargins(edge, scaled(this, top), edge, edge);
    m_column->setSpacing(scaled(this, 6));
  }
  QWidget* form() const { return m_form; }
  QVBoxLayout* column() const { return m_column; }
  /// Makes the panel wide enough for its parts and a scroll bar.
  void finishForm() {
    m_column->addStretch(1);
    setWidget(m_form);
    setMinimumWidth(m_form->minimumSizeHint().width() + scaled(this, 14));
  }

 private:
  QWidget* m_form;
  QVBoxLayout* m_column;
};

}  // namespace pitchboard::ui
