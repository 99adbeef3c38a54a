// SPDX-License-Identifier: GPL-3.0-or-later
#include "derived_series.h"

namespace pitchboard::ui {
struct DerivedSeries::Work {};
DerivedSeries::DerivedSeries(const CurveSpec&) {}
DerivedSeries::~DerivedSeries() = default;
void DerivedSeries::update(PlotFeed&) {}
ColumnView DerivedSeries::view() const { return {}; }
bool DerivedSeries::isFaulty() const { return false; }
bool DerivedSeries::isWorking() const { return false; }
}  // namespace pitchboard::ui
