// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout_edit.h"

namespace pitchboard::ui {
namespace {

/// Tabs, plots in each, curves in each of them.
struct Shape {
  QString text;
  int curves = 0;
};

Shape shapeOf(const PlotLayout& layout) {
  Shape shape;
  for (const PageSpec& page : layout.pages) {
    shape.text += QLatin1Char('|');
    for (const PaneSpec& pane : page.panes) {
      shape.text += QStringLiteral(" %1").arg(pane.curves.size());
      shape.curves += static_cast<int>(pane.curves.size());
    }
  }
  return shape;
}

}  // namespace

Edit layoutEdit(const PlotLayout& before, const PlotLayout& after,
                const std::function<void(const PlotLayout&)>& put) {
  const Shape was = shapeOf(before), is = shapeOf(after);
  return {is.curves > was.curves   ? QStringLiteral("Add to the plots")
          : is.curves < was.curves ? QStringLiteral("Remove from the plots")
                                   : QStringLiteral("Change the plots"),
          [put, after] { put(after); }, [put, before] { put(before); },
          was.text == is.text ? is.text : QString(), true};
}

}  // namespace pitchboard::ui
