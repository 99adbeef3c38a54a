// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Experiments in the studio: choose or edit one, play it in threads of its own, look at tables,
// ways on the field, distributions and differences, and see any run again in Replay. UI thread
// only.

class QWidget;

namespace pitchboard::ui {

class ReplayController;

/// `replay` must outlive the dock.
QWidget* makeExperimentsDock(ReplayController* replay, QWidget* parent);

}  // namespace pitchboard::ui
