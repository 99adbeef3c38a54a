// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Asks who follows the recording in a match that starts from a moment of it, and when followers are
// let go. Robots by name, metres. UI thread only; deletes itself when it closes.

#include <QDialog>
#include <QStringList>
#include <functional>

namespace pitchboard::ui {

class CheckList;
class NumberBox;

class FollowDialog : public QDialog {
  Q_OBJECT
 public:
  /// `names` are offered, and `ticked` of them ticked at first. `start` gets the choice.
  FollowDialog(const QStringList& names, const QStringList& ticked, QWidget* parent,
               const std::function<void(const QStringList& who, double reach)>& start);

 private:
  CheckList* m_who;
  NumberBox* m_reach;
};

}  // namespace pitchboard::ui
