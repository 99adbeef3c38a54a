// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sentences in boxes that lie on the field and let the mouse through. UI thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;
class Timeline;

/// Both belong to the `canvas` that they lie on. Says that a match is being opened, where the field
/// says that none is.
QWidget* makeOpeningSign(MatchController* controller, QWidget* canvas);
/// Says at the top that the past is shown: "Looking back: 03:12.50 (Now leads back)".
QWidget* makeLookingBackSign(Timeline* timeline, QWidget* canvas);

}  // namespace pitchboard::ui
