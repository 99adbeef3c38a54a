// SPDX-License-Identifier: GPL-3.0-or-later
#include "fallback_icons.h"

namespace pitchboard::ui {
namespace {

struct Drawing {
  const char* name;
  const char* path;
};

constexpr Drawing drawings[] = {
    {"media-playback-start", "M4 3v16l15-8z"},
    {"media-playback-pause", "M4 3h5v16H4zM13 3h5v16h-5z"},
    {"media-skip-backward", "M3 3h2v16H3zM12 3v16L5 11zM19 3v16l-7-8z"},
    {"media-seek-forward", "M4 3v16l8-8zM12 3v16l8-8z"},
    {"media-skip-forward", "M17 3h2v16h-2zM10 3v16l7-8zM3 3v16l7-8z"},
    {"document-open", "M2 4h7l2 2h9v12H2zM4 8v8h14V8z"},
    {"document-save", "M3 3h13l3 3v13H3zM7 4v5h7V4zM6 12v6h10v-6z"},
    {"edit-undo", "M3 9l6-5v3h5a5 5 0 0 1 0 10H7v-2h7a3 3 0 0 0 0-6H9v3z"},
    {"edit-redo", "M19 9l-6-5v3H8a5 5 0 0 0 0 10h7v-2H8a3 3 0 0 1 0-6h5v3z"},
    {"edit-delete", "M5 6h12v2H5zM6 9h10v10H6zM9 3h4v2H9z"},
    {"edit-select", "M5 2l12 10-5 1 3 6-3 1-3-6-4 3z"},
    {"starred-symbolic", "M11 2l2.7 6 6.3.6-4.8 4.3 1.4 6.3L11 16l-5.6 3.2 1.4-6.3L2 8.6 8.3 8z"},
    {"arrow-right-double", "M4 4l7 7-7 7zM11 4l7 7-7 7z"},
    {"arrow-down-double", "M4 4l7 7 7-7zM4 11l7 7 7-7z"},
    {"list-add", "M10 3h2v7h7v2h-7v7h-2v-7H3v-2h7z"},
    {"zoom-fit-best", "M2 2h6v2H4v4H2zM14 2h6v6h-2V4h-4zM2 14h2v4h4v2H2zM18 14h2v6h-6v-2h4z"},
};

}  // namespace

QByteArray fallbackIcon(const QString& name) {
  const char* path = "M8 8h6v6H8z";
  for (const Drawing& drawing : drawings) {
    if (name == QLatin1String(drawing.name)) path = drawing.path;
  }
  return QByteArray(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 22 22\">"
             "<path fill-rule=\"evenodd\" d=\"") +
         path + "\"/></svg>";
}

}  // namespace pitchboard::ui
