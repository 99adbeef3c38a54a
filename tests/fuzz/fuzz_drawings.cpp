// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a robot's drawing: what is accepted keeps the limits, comes back from its own text,
// and leaves a bounded book that its own pages make again.
#include <cstdlib>

#include <telemetry/drawings/drawing_store.h>

using namespace pitchboard::telemetry;

namespace {

void check(const Drawing& drawing) {
  if (drawing.layers.size() > DrawingLimits::layers) std::abort();
  for (const DrawingLayer& layer : drawing.layers) {
    if (layer.shapes.size() > DrawingLimits::shapes || layer.points() > DrawingLimits::points ||
        layer.name.empty() || layer.name.size() > DrawingLimits::nameBytes) {
      std::abort();
    }
  }
  const auto again = parseDrawing(drawingText(drawing));
  if (!again || !(*again == drawing)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static DrawingStore store;
  static double time = 0.0;
  const DatagramParts parts = partsOf({reinterpret_cast<const char*>(data), size});
  if (parts.message.size() + parts.drawing.size() > size) std::abort();
  const auto drawing = parseDrawing(parts.drawing);
  if (drawing) check(*drawing);
  time += 0.01;
  (void)store.take(parts.drawing, time);
  static unsigned rounds = 0;
  if (++rounds % 64 != 0) return 0;
  const auto shown = store.at(time);
  if (shown.size() > DrawingLimits::robots) std::abort();
  std::size_t layers = 0;
  for (const RobotDrawings& robot : shown) {
    std::size_t points = 0;
    for (const auto& layer : robot.layers) points += layer->points();
    if (robot.layers.size() > DrawingLimits::layers || points > DrawingLimits::robotPoints) {
      std::abort();
    }
    layers += robot.layers.size();
  }
  if (store.pages(time).size() != layers) std::abort();
  return 0;
}
