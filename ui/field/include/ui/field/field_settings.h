// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Keeps which layers and drawings the field shows in the settings. UI thread only.

class QSettings;

namespace pitchboard::ui {

class FieldView;

/// Layers that are not in the settings are left unchanged.
void restoreFieldLayers(FieldView& field, const QSettings& settings);
/// Writes only differences, so that it can be called often.
void saveFieldLayers(const FieldView& field, QSettings& settings);

}  // namespace pitchboard::ui
