// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sentences in boxes that lie on the field and, but for the last, let the mouse through. UI thread
// only.

#include <QList>

class QAction;
class QSettings;
class QWidget;

namespace pitchboard::ui {

class FieldView;
class FrameSource;
class MatchController;
class ShownMoment;

/// All belong to the `canvas` that they lie on. Says that a match is being opened, where the field
/// says that none is.
QWidget* makeOpeningSign(MatchController* controller, QWidget* canvas);
/// Says three things to try to who has never seen the studio, until the match is changed, the past
/// is looked at, or one of `actions` is triggered; the settings keep that it was seen.
void makeFirstSteps(ShownMoment* shown, MatchController* controller, const QList<QAction*>& actions,
                    QSettings* settings, QWidget* canvas);
/// Says at the top that a match is over, and what can be done now.
QWidget* makeFinalWhistleSign(ShownMoment* shown, QWidget* canvas);
/// Says at the top that the past is shown: "Viewing 03:12.50 · press Now to return".
QWidget* makeLookingBackSign(ShownMoment* shown, QWidget* canvas);
/// Says at the lower edge that a match stands still because no robot was told to play.
QWidget* makeNobodyPlaysSign(FrameSource* source, QWidget* canvas);
/// Penalised robots and their remaining time, at the upper right: "B2 24 · R3 5"; at the lower
/// right while robots stand up there.
QWidget* makePenaltyStrip(FrameSource* source, const FieldView* field, QWidget* canvas);
/// Says at the lower left that the mode is on; a click switches it off.
QWidget* makePublishedKeysSign(QAction* publishedKeys, QWidget* canvas);

}  // namespace pitchboard::ui
