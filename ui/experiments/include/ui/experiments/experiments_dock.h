// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Experiments in the studio: choose or edit one, play it in threads of its own, look at tables,
// ways on the field, distributions and differences, see any run again in Replay, and two of them
// over each other. UI thread only.

class QWidget;

namespace pitchboard::ui {

class ComparedSession;
class ReplayController;
class SituationTests;

/// All must outlive the dock.
struct ExperimentsDockParts {
  ReplayController* replay = nullptr;
  ComparedSession* compared = nullptr;
  SituationTests* tests = nullptr;  ///< what they save is offered here, and played
};
QWidget* makeExperimentsDock(const ExperimentsDockParts& parts, QWidget* parent);

}  // namespace pitchboard::ui
