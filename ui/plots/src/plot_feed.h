// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads a source's rows for the plots: a consistent snapshot, which is refreshed with each frame
// while plots are visible. UI thread only.

#include <QDateTime>
#include <QObject>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include <telemetry/series/series_store.h>
#include <ui/base/beat.h>
#include <ui/plots/plot_layout.h>
#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class DerivedSeries;
class LinkedTime;
class NoteBoard;

/// A column as of the last refresh. Cheap to copy; any thread may read it.
struct ColumnView {
  std::shared_ptr<const telemetry::GroupView> group;
  std::uint32_t column = 0;

  explicit operator bool() const { return group != nullptr; }
  const telemetry::ColumnInfo& info() const { return group->info().columns[column]; }
  bool isCoded() const { return info().kind != telemetry::ColumnKind::Number; }
};

/// A session whose curves are drawn beside those of the source.
struct ComparedRows {
  quint64 id = 0;  ///< of the session; 0: an abandoned future of the same match
  int number = 0;  ///< of its colour and mark (session_mark.h)
  std::shared_ptr<const telemetry::SeriesStore> rows = nullptr;
  double offset = 0.0;  ///< s, time of its second 0 on the axis
  /// s on the axis; until then an abandoned future has the rows of the source.
  double from = -std::numeric_limits<double>::infinity();
  QString caption = {};
  bool isHidden = false;
  quint64 generation = 0;  ///< increases with other rows; the feed's

  bool isFuture() const { return id == 0; }
  /// A range of the axis in its own time.
  telemetry::TimeRange ownTime(telemetry::TimeRange range) const {
    return {range.begin - offset, range.end - offset};
  }
};

/// Old and new names of groups that were renamed at the same time.
using GroupNames = std::map<QString, QString>;

class PlotFeed : public QObject {
  Q_OBJECT
 public:
  /// Both outlive the feed.
  PlotFeed(FrameSource* source, LinkedTime* time, QObject* parent = nullptr);
  ~PlotFeed() override;

  FrameSource* source() const { return m_source; }
  /// The notes that are drawn on plots; null: none.
  NoteBoard* notes() const { return m_notes; }
  void setNotes(NoteBoard* notes) { m_notes = notes; }
  LinkedTime* time() const { return m_time; }
  /// Finds `GROUP/COLUMN` or `curve/NAME`; empty if there is no such variable at the moment.
  ColumnView find(const QString& name);
  /// Sets the computed curves that other curves can use as `curve/NAME`, by name.
  void setNamedCurves(const std::map<QString, CurveSpec>& curves);
  /// Returns the groups that have all of these columns, in the source's order.
  QStringList groupsWith(const QStringList& columns) const;
  /// Returns `GROUP/COLUMN` with the present name of the group; `name` itself if there is no such
  /// variable.
  QString presentName(const QString& name) const;
  /// Returns the group that `first` stands for: a robot with these columns whose value changes, our
  /// robots before others, keepers last, and of the rest the one at the ball. Once chosen it stays
  /// until the robot is gone. Empty if no robot has the columns.
  QString firstGroup(const QStringList& columns);
  /// Returns all variables as `GROUP/COLUMN`.
  QStringList names() const;
  /// The wall-clock time of second 0 if the source has one (Live); times are then shown as times of
  /// day.
  const std::optional<QDateTime>& clock() const { return m_clock; }
  void setClock(const std::optional<QDateTime>& clock) { m_clock = clock; }
  /// Whether legends have the values of the moment; not in a picture that stands for many moments.
  bool showsValues() const { return m_showsValues; }
  void setShowsValues(bool on) { m_showsValues = on; }
  /// Formats seconds of the source as "05:03.250" or as a time of day.
  QString timeText(double time, int decimals) const;
  /// Increases when variables were added or removed; results of find() are then out of date.
  quint64 generation() const { return m_generation; }
  /// Increases when groups or columns changed, or when `first` became another robot; results of
  /// groupsWith() are then out of date.
  quint64 looks() const { return m_looks; }

  /// Sets the sessions whose curves are drawn beside those of the source.
  void setCompared(std::vector<ComparedRows> sessions);
  const std::vector<ComparedRows>& compared() const { return m_compared; }
  /// Returns the same variable in a compared session, at that session's times; empty if it has
  /// none, or is hidden.
  ColumnView find(const ComparedRows& session, const QString& name) const;
  /// Increases when rows of a session that does not fit into memory have been read, so that the
  /// same range has to be drawn again.
  quint64 rowsRead() const { return m_rowsRead; }
  /// Returns whether input curves were still being computed at the last refresh.
  bool isWorking() const { return m_namedWorking; }
  /// Switches automatic refreshing on or off; hidden plots cost nothing.
  void setRunning(bool on);
  /// Refreshes now.
  void refresh();
  /// Refreshes in one of the next beats, if running.
  void refreshSoon();
  /// Sets how many seconds a pixel of the plots covers. Plots need not be refreshed more often than
  /// they move by a pixel.
  void setTimeOfPixel(double seconds);

 signals:
  /// There may be something new to draw.
  void refreshed();
  /// Groups of the source were renamed; plotted curves still belong to them.
  void groupsRenamed(const pitchboard::ui::GroupNames& names);

 private:
  ColumnView named(const QString& name);
  void forget();
  void take(std::shared_ptr<const telemetry::SeriesStore> store);
  void lookAgain();
  void noteNames();
  void orderRobots();
  void findFirst();
  /// Returns whether a number in these columns changes around the shown time; empty while rows are
  /// being read.
  std::optional<bool> isMoving(const QString& group, const QStringList& columns) const;

  FrameSource* m_source;
  NoteBoard* m_notes = nullptr;
  LinkedTime* m_time;
  bool m_running = false;
  std::unique_ptr<Beat::Part> m_refresh;
  std::shared_ptr<const telemetry::SeriesStore> m_store;
  quint64 m_storeRevision = 0;
  std::vector<std::string> m_groupNames;  // by GroupId, as curves name them
  quint64 m_generation = 1;
  quint64 m_looks = 1;
  quint64 m_rowsRead = 0;
  QStringList m_robots;  // ours before others, keepers last
  qsizetype m_ours = 0;  // how many of them are ours
  // What it stood for in sources that were shown before, and may be shown again.
  std::map<std::weak_ptr<const telemetry::SeriesStore>, QString, std::owner_less<>> m_firstOf;
  QString m_first;  // what `first` stands for; empty while no value has changed
  std::vector<QStringList> m_firstAsked;  // columns, while it is empty
  bool m_missed = false;                  // a curve waits for a missing variable
  std::optional<QDateTime> m_clock;
  bool m_showsValues = true;
  std::vector<ComparedRows> m_compared;
  quint64 m_comparedGeneration = 0;
  std::map<telemetry::GroupId, std::shared_ptr<const telemetry::GroupView>> m_views;
  std::map<QString, telemetry::SeriesId> m_found;
  struct Named {
    CurveSpec spec;
    std::unique_ptr<DerivedSeries> rows;  // null: a plain variable with a title
    bool updated = false;                 // since the last refresh
    bool inWork = false;                  // a curve that refers to itself has no rows
  };
  std::map<QString, Named> m_named;
  bool m_namedAsked = false, m_namedWorking = false;
};

}  // namespace pitchboard::ui
