// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Names to be ticked, with a filter, all or none of what it shows at once, and how many
// of all are ticked. UI thread only.

#include <QStringList>
#include <QWidget>

class QLabel;
class QLineEdit;
class QListWidget;

namespace pitchboard::ui {

class CheckList : public QWidget {
  Q_OBJECT
 public:
  /// All names are ticked at first.
  CheckList(const QStringList& names, const QString& placeholder, QWidget* parent);

  QStringList checked() const;
  bool isAllChecked() const;
  bool isEmpty() const;
  /// Only these.
  void setChecked(const QStringList& names);

 private:
  void filter(const QString& text);
  void checkShown(bool on);
  void count();

  QLineEdit* m_filter;
  QListWidget* m_list;
  QLabel* m_count;
};

}  // namespace pitchboard::ui
