// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Checks the rules of a file (docs/rules.md) in the source that is shown and in the sessions that
// are compared with it: in a recording once, in a match and in Live while rows come. The list of
// the times at which they were broken is a table model in order of time, for the panel Rules and
// the timeline; each beginning in the source is also an event of it. UI thread only; rows are read
// on worker threads. Times are seconds of the source, unless something else is said.

#include <QAbstractTableModel>
#include <QStringList>
#include <QTimer>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include <base/result.h>
#include <robotlink/frame/match_event.h>
#include <telemetry/query/rules.h>
#include <telemetry/series/series_store.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

class QSettings;

namespace pitchboard::ui {

class ComparedSessions;
class ReplayController;
class ShownMoment;

struct BrokenRule {
  telemetry::FoundMoment moment;  ///< of its own session; question: index in RuleWatch::rules()
  bool goesOn = false;            ///< it ends at the newest row
  quint64 session = 0;            ///< id of a compared session; 0: of the source that is shown
  double offset = 0.0;            ///< s, where second 0 of its session stands in the source

  /// s of the source that is shown
  double from() const { return moment.range.begin + offset; }
  double until() const { return moment.range.end + offset; }
};

class RuleWatch : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Severity, Session, Name, Robot, From, Duration, Worst, Text, columns };
  /// Of the source that is shown, and of each compared session; the oldest ones are dropped.
  static constexpr std::size_t maxBroken = 10'000, maxBrokenCompared = 2'000;
  static constexpr int sortRole = Qt::UserRole;

  /// Opens the file of the last time. The parts must outlive it; `settings` may be null.
  RuleWatch(ShownMoment* shown, ReplayController* replay, ComparedSessions* compared,
            QSettings* settings, QObject* parent);
  ~RuleWatch() override;

  /// Reads the rules of a file, keeps its path in the settings, and checks them. After an error,
  /// which is also in problems(), there are no rules.
  Result<void> open(const QString& path);
  /// Reads the file again and checks from the beginning.
  void again();
  void close();
  /// Stops reading recordings. A match and live robots are still checked.
  void cancel();

  const QString& path() const { return m_path; }
  const std::vector<telemetry::Rule>& rules() const { return m_rules; }
  const std::vector<BrokenRule>& broken() const { return m_broken; }
  const telemetry::Rule& ruleOf(const BrokenRule& one) const {
    return m_rules[one.moment.question];
  }
  /// Returns what is wrong with the file or the recordings, and the rules that cannot be checked.
  QStringList problems() const;
  bool isRunning() const { return m_running || m_reading; }
  /// Returns whether a recording is being read, of which progress() tells.
  bool isReading() const { return m_reading || (m_running && isRecording()); }
  bool isCancelled() const { return m_cancelled; }
  /// Returns the share of the recordings that has been checked, 0 to 1.
  double progress() const;
  /// Returns whether sessions are compared with the source.
  bool isComparing() const;
  /// Returns whether more were found than are listed.
  bool isCut() const { return !m_cut.empty(); }
  /// Returns the path of the recording in which it was found, or the name of the other source.
  QString sourceNameOf(const BrokenRule& one) const;
  /// Returns whether this stands in some column of it but the numbers, ignoring case.
  bool contains(const BrokenRule& one, const QString& word) const;
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
  struct Found;
  using Rows = std::shared_ptr<const telemetry::SeriesStore>;
  static std::optional<Found> searched(Search& search, const Rows& rows,
                                       const std::function<bool(double)>& progress);
  void restart();
  void forgetAll();
  void takeRows();
  void advance();
  void followCompared();
  void readNextCompared();
  void start(Workers& worker, const std::shared_ptr<Search>& search, const Rows& rows);
  void take(const std::shared_ptr<Search>& search, Found&& found);
  void noteProblems(quint64 session, const Found& found);
  void listAll(quint64 session, std::vector<BrokenRule>&& found, std::size_t most);
  void listNew(std::vector<BrokenRule>&& found);
  bool list(BrokenRule&& one);
  void dropOldest();
  link::MatchEvent eventOf(const BrokenRule& one) const;
  void listEvents();
  bool isRecording() const;
  QString sessionText(const BrokenRule& one) const;

  ShownMoment* m_shown;
  ReplayController* m_replay;
  ComparedSessions* m_compared;
  QSettings* m_settings;
  QString m_path;
  std::vector<telemetry::Rule> m_rules;
  std::vector<QString> m_ruleTexts;  // severity, name and text of each, to be searched
  std::vector<BrokenRule> m_broken;
  QString m_fileProblem;
  std::map<quint64, QStringList> m_problems;  // of the source (0) and of compared sessions
  std::set<quint64> m_cut;                    // of whose broken rules the oldest ones are dropped
  std::set<quint64> m_checked;                // compared sessions that have been read
  std::shared_ptr<Search> m_search;           // of the source; null: nothing to do
  std::shared_ptr<Search> m_reading;          // of a compared session; null: none is being read
  double m_since = 0.0;                       // s; what was broken before is no news
  bool m_running = false, m_cancelled = false;
  QTimer m_pause;
  UiQueue m_ui;
  Workers m_worker, m_reader;  // last: they wait for their work before the rest goes
};

/// Returns the colour of a severity in lists and on the timeline.
QColor severityColor(telemetry::RuleSeverity severity);

}  // namespace pitchboard::ui
