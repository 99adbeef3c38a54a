// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Checks the rules of a file (docs/rules.md) in the source that is shown: in a recording once, in a
// match and in Live while rows come. The list of the times at which they were broken is a table
// model in order of time, for the panel Rules and the timeline; each beginning is also an event of
// the source. UI thread only; rows are read on a
// worker thread. Times are seconds of the source.

#include <QAbstractTableModel>
#include <QStringList>
#include <QTimer>
#include <memory>
#include <optional>
#include <vector>

#include <base/result.h>
#include <robotlink/frame/match_event.h>
#include <telemetry/query/rules.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

class QSettings;

namespace pitchboard::ui {

class ReplayController;
class ShownMoment;

struct BrokenRule {
  telemetry::FoundMoment moment;  ///< question: index in RuleWatch::rules()
  bool goesOn = false;            ///< it ends at the newest row
};

class RuleWatch : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Severity, Name, Robot, From, Duration, Worst, Text, columns };
  static constexpr std::size_t maxBroken = 10'000;  ///< the oldest ones are dropped
  static constexpr int sortRole = Qt::UserRole;

  /// Opens the file of the last time. The parts must outlive it; `settings` may be null.
  RuleWatch(ShownMoment* shown, ReplayController* replay, QSettings* settings, QObject* parent);
  ~RuleWatch() override;

  /// Reads the rules of a file, keeps its path in the settings, and checks them. After an error,
  /// which is also in problems(), there are no rules.
  Result<void> open(const QString& path);
  /// Reads the file again and checks from the beginning.
  void again();
  void close();
  void cancel();

  const QString& path() const { return m_path; }
  const std::vector<telemetry::Rule>& rules() const { return m_rules; }
  const std::vector<BrokenRule>& broken() const { return m_broken; }
  const telemetry::Rule& ruleOf(const BrokenRule& one) const {
    return m_rules[one.moment.question];
  }
  /// Returns what is wrong with the file or the recording, and the rules that cannot be checked.
  const QStringList& problems() const { return m_problems; }
  bool isRunning() const { return m_running; }
  bool isCancelled() const { return m_cancelled; }
  /// Returns the progress in a recording, 0 to 1.
  double progress() const { return m_progress; }
  /// Returns the path of the recording that is checked, or the name of the other source.
  QString sourceName() const;
  /// Returns "B1: Lost the ball although it was near".
  QString sentenceOf(const BrokenRule& one) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 signals:
  /// The list, the rules, problems or the progress changed.
  void changed();
  /// Rules of severity error began to be broken now; the sentence is about the first of them.
  void broke(const QString& sentence);

 private:
  struct Search;
  struct Progress;
  void restart();
  void takeRows();
  void advance();
  void take(const std::shared_ptr<Search>& search, Progress&& found);
  bool list(BrokenRule&& one);
  link::MatchEvent eventOf(const BrokenRule& one) const;
  void listEvents();
  bool isRecording() const;

  ShownMoment* m_shown;
  ReplayController* m_replay;
  QSettings* m_settings;
  QString m_path;
  std::vector<telemetry::Rule> m_rules;
  std::vector<BrokenRule> m_broken;
  QStringList m_problems;
  std::shared_ptr<Search> m_search;  // null: nothing to do
  double m_progress = 0.0;
  double m_since = 0.0;  // s; what was broken before is no news
  bool m_running = false, m_cancelled = false;
  QTimer m_pause;
  UiQueue m_ui;
  Workers m_worker;  // last: waits for its work before the rest goes
};

/// Returns the colour of a severity in lists and on the timeline.
QColor severityColor(telemetry::RuleSeverity severity);

}  // namespace pitchboard::ui
