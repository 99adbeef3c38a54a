// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The Experiments dock: choose or edit an experiment, play it on other threads, view tables, paths
// on the field, distributions and differences, and open any run in Replay, or two runs compared. An
// experiment that was cancelled, or whose studio ended, can be continued. UI thread only.

class QWidget;

namespace pitchboard::ui {

class ComparedSessions;
class ReplayController;
class RunningWork;
class SituationTests;

/// All must outlive the dock.
struct ExperimentsDockParts {
  ReplayController* replay = nullptr;
  ComparedSessions* compared = nullptr;
  SituationTests* tests = nullptr;  ///< tests that it saves are offered and played here
  RunningWork* work = nullptr;      ///< is told of experiments that run
};
QWidget* makeExperimentsDock(const ExperimentsDockParts& parts, QWidget* parent);

}  // namespace pitchboard::ui
