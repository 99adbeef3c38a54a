// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a layout of plots: what is accepted comes back from its own text.
#include <QJsonDocument>
#include <cstdlib>

#include <ui/plots/plot_layout.h>

using namespace pitchboard::ui;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const auto layout = layoutFromText({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!layout) {
    if (layout.error().message.empty()) std::abort();
    return 0;
  }
  for (const PageSpec& page : layout->pages) {
    for (const PaneSpec& pane : page.panes) {
      for (const CurveSpec& curve : pane.curves) (void)curveName(curve);
    }
  }
  const QByteArray text = QJsonDocument(toJson(*layout)).toJson();
  const auto again =
      layoutFromText({text.constData(), static_cast<std::size_t>(text.size())}, "again");
  if (!again || !(*again == *layout)) std::abort();
  return 0;
}
