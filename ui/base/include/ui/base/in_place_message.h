// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A message inside a panel about what the user just did there, optionally with a button for the
// next step. A new message replaces the old one. UI thread only.

#include <QFrame>
#include <QStringList>
#include <functional>

class QLabel;
class QPushButton;

namespace pitchboard::ui {

/// Returns the first few of these sentences, a line each, and how many more there are: a panel
/// needs its room for what it shows.
QString shortListOf(const QStringList& sentences);

class InPlaceMessage : public QFrame {
  Q_OBJECT
 public:
  enum class Tone { Note, Warning, Error };
  explicit InPlaceMessage(QWidget* parent = nullptr);

  void showMessage(Tone tone, const QString& sentence, const QString& button = {},
                   std::function<void()> action = {});
  void clear();
  QString text() const;

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void colour();

  Tone m_tone = Tone::Note;
  QLabel* m_text;
  QPushButton* m_button;
  std::function<void()> m_action;
};

}  // namespace pitchboard::ui
