// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Chooses the stretch that is described: the selected range, A to B, everything, or what lies
// between events; and a condition. UI thread only. Times are s of the source that is shown.

#include <QString>
#include <QWidget>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <telemetry/series/series_types.h>
#include <telemetry/session/session_types.h>

class QComboBox;
class QLabel;
class QLineEdit;

namespace pitchboard::ui {

class ShownMoment;

class StretchBar : public QWidget {
  Q_OBJECT
 public:
  enum class Kind { Selection, Marks, Everything, Events };

  /// `shown` must outlive it.
  StretchBar(ShownMoment* shown, QWidget* parent);

  Kind kind() const;
  /// Returns the range; nothing: everything, also where no range is selected.
  std::optional<telemetry::TimeRange> range() const;
  /// Returns the kinds of two events, if what lies between them is described.
  std::optional<std::pair<std::string, std::string>> between() const;
  QString condition() const;
  void setCondition(const QString& text);
  QLineEdit* conditionBox() const { return m_condition; }
  /// Returns what is described, as a sentence without a dot.
  QString text() const;
  /// Returns the events of the source, as files have them.
  std::vector<telemetry::SessionEvent> events() const;

 signals:
  void changed();

 private:
  void showKind();

  ShownMoment* m_shown;
  QComboBox* m_kind;
  QComboBox* m_first;
  QLabel* m_to;
  QComboBox* m_last;
  QLineEdit* m_condition;
  QString m_applied;  // the condition that changed() was emitted for
};

}  // namespace pitchboard::ui
