// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Other blackboards of this computer among the variables: the form that attaches one, what is said
// of each beside its group, and a message when one is removed. UI thread only; belongs to the dock.

#include <QObject>
#include <set>

class QWidget;

namespace pitchboard::ui {

class AttachForm;
class AttachedBoards;
class InPlaceMessage;
class MatchController;
class VariablesModel;

class GuestBoards : public QObject {
 public:
  GuestBoards(MatchController* controller, VariablesModel* model, InPlaceMessage* message,
              QWidget* dock);
  AttachForm* form() const { return m_form; }
  bool contains(int key) const;
  void detach(int key);
  /// Says how each of them is now.
  void refresh();

 private:
  void attach(int key, double rate);

  VariablesModel* m_model;
  InPlaceMessage* m_message;
  AttachedBoards* m_boards;
  AttachForm* m_form;
  std::set<int> m_removed;  // keys whose removal was said
};

}  // namespace pitchboard::ui
