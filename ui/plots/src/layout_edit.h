// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A change of the plots that can be undone. UI thread only.

#include <ui/plots/plot_layout.h>
#include <ui/sources/edit.h>

namespace pitchboard::ui {

/// The change has happened already; `put` shows a layout. Changes of look and limits within a
/// second are one; what adds or removes is one for itself.
Edit layoutEdit(const PlotLayout& before, const PlotLayout& after,
                const std::function<void(const PlotLayout&)>& put);

}  // namespace pitchboard::ui
