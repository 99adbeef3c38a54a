// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which layers and drawings the field shows, kept between runs. UI thread only.

class QSettings;

namespace pitchboard::ui {

class FieldView;

/// What is not in the settings stays as it is.
void restoreFieldLayers(FieldView& field, const QSettings& settings);
/// Writes only what differs from what is there, so that it may be called often.
void saveFieldLayers(const FieldView& field, QSettings& settings);

}  // namespace pitchboard::ui
