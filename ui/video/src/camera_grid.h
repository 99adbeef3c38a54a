// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Places the views of cameras beside each other or below each other, so that pictures are as large
// as they can be. UI thread only; owned by the panel.

#include <QWidget>
#include <algorithm>
#include <vector>

namespace pitchboard::ui {

class CameraGrid : public QWidget {
 public:
  using QWidget::QWidget;

  void add(QWidget* view) {
    m_views.push_back(view);
    view->show();
    place();
  }
  void remove(QWidget* view) {
    std::erase(m_views, view);
    place();
  }

 protected:
  void resizeEvent(QResizeEvent* /*event*/) override { place(); }
  QSize minimumSizeHint() const override {
    return m_views.empty() ? QSize() : m_views.front()->minimumSize();
  }

 private:
  void place() {
    constexpr double shape = 16.0 / 9.0;  // of most videos
    const int count = static_cast<int>(m_views.size());
    int columns = 1;
    double largest = 0.0;
    for (int tried = 1; tried <= count; ++tried) {
      const int rows = (count + tried - 1) / tried;
      const double across = std::min(static_cast<double>(width()) / tried, shape * height() / rows);
      if (across > largest) {
        largest = across;
        columns = tried;
      }
    }
    const int rows = (count + columns - 1) / columns;
    for (int i = 0; i < count; ++i) {
      const int left = width() * (i % columns) / columns, top = height() * (i / columns) / rows;
      const int right = width() * (i % columns + 1) / columns;
      const int bottom = height() * (i / columns + 1) / rows;
      m_views[static_cast<std::size_t>(i)]->setGeometry(left, top, right - left, bottom - top);
    }
  }

  std::vector<QWidget*> m_views;
};

}  // namespace pitchboard::ui
