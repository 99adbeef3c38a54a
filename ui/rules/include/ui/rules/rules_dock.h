// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The panel Rules: chooses the file of the rules, and lists when they were broken in the source
// that is shown and in the sessions that are compared with it. A click leads to the moment. UI
// thread only.

class QWidget;

namespace pitchboard::ui {

class RuleWatch;
class ShownMoment;

/// Both must outlive the dock.
QWidget* makeRulesDock(RuleWatch* rules, ShownMoment* shown, QWidget* parent);

/// Asks for a file of rules and checks it.
void askForRules(RuleWatch* rules, QWidget* parent);

}  // namespace pitchboard::ui
