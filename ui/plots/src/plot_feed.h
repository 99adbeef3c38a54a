// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What plots read: one consistent look at a source's rows, renewed with its frames while somebody
// watches. UI thread only.

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

/// A column as it was at the last refresh. Cheap to copy; any thread may read it.
struct ColumnView {
  std::shared_ptr<const telemetry::GroupView> group;
  std::uint32_t column = 0;

  explicit operator bool() const { return group != nullptr; }
  const telemetry::ColumnInfo& info() const { return group->info().columns[column]; }
  bool isCoded() const { return info().kind != telemetry::ColumnKind::Number; }
};

class PlotFeed : public QObject {
  Q_OBJECT
 public:
  /// Both outlive the feed.
  PlotFeed(FrameSource* source, LinkedTime* time, QObject* parent = nullptr);
  ~PlotFeed() override;

  FrameSource* source() const { return m_source; }
  LinkedTime* time() const { return m_time; }
  /// `GROUP/COLUMN`, or `curve/NAME`; nothing when there is no such variable now.
  ColumnView find(const QString& name);
  /// Computed curves that others may take as `curve/NAME`, by name.
  void setNamedCurves(const std::map<QString, CurveSpec>& curves);
  /// Groups that have all of these columns, in the source's order.
  QStringList groupsWith(const QStringList& columns) const;
  /// `GROUP/COLUMN` with the name that the group has now; itself where there is none.
  QString presentName(const QString& name) const;
  /// The group that `first` stands for: of the robots that have these columns one whose value
  /// moves, ours before others and keepers last. Once one has moved it stays that one until it is
  /// gone. Empty where there is none.
  QString firstGroup(const QStringList& columns);
  /// Every variable there is, `GROUP/COLUMN`.
  QStringList names() const;
  /// Wall clock at second 0, where the source has one (Live): then times are written as time of
  /// day.
  const std::optional<QDateTime>& clock() const { return m_clock; }
  void setClock(const std::optional<QDateTime>& clock) { m_clock = clock; }
  /// "05:03.250", or the time of day; s of the source.
  QString timeText(double time, int decimals) const;
  /// Grows when variables came or went: what find() said before is void.
  quint64 generation() const { return m_generation; }
  /// Grows when there are other groups or columns, or `first` is another robot: what groupsWith()
  /// said before is void.
  quint64 looks() const { return m_looks; }

  /// Rows of a second session, whose second 0 is at `offset` (s); null: none. Until `from` (s) they
  /// are those of what is shown.
  void setCompared(std::shared_ptr<const telemetry::SeriesStore> rows, double offset,
                   const QString& caption, double from = -std::numeric_limits<double>::infinity());
  /// The same variable there, at the times of there; nothing when it has none.
  ColumnView compared(const QString& name) const;
  bool hasCompared() const { return m_compared != nullptr; }
  /// Grows whenever rows of a session that is larger than memory have been read: the same range now
  /// looks different.
  quint64 rowsRead() const { return m_rowsRead; }
  /// Whether curves that others are made of were being computed at the last refresh.
  bool isWorking() const { return m_namedWorking; }
  /// Grows when another session is compared; 0: none ever was.
  quint64 comparedGeneration() const { return m_comparedGeneration; }
  double comparedOffset() const { return m_comparedOffset; }
  double comparedFrom() const { return m_comparedFrom; }
  const QString& comparedCaption() const { return m_comparedCaption; }
  /// They are a future of the same match, which it has left.
  bool comparesFuture() const { return m_comparedFrom > -std::numeric_limits<double>::infinity(); }

  /// Refreshes by itself while on; plots that cannot be seen cost nothing.
  void setRunning(bool on);
  /// Takes a new look now.
  void refresh();
  /// Takes one in a beat soon, while it runs.
  void refreshSoon();
  /// How much time a pixel of the plots stands for (s): what moves less than that between two looks
  /// need not be looked at.
  void setTimeOfPixel(double seconds);

 signals:
  /// There may be something new to draw.
  void refreshed();

 private:
  ColumnView named(const QString& name);
  void forget();
  void lookAgain();
  void orderRobots();
  void findFirst();
  /// A number of these columns changes about the moment that is shown.
  /// Nothing while its rows are being read.
  std::optional<bool> isMoving(const QString& group, const QStringList& columns) const;

  FrameSource* m_source;
  LinkedTime* m_time;
  bool m_running = false;
  std::unique_ptr<Beat::Part> m_refresh;
  std::shared_ptr<const telemetry::SeriesStore> m_store;
  quint64 m_storeRevision = 0;
  quint64 m_generation = 1;
  quint64 m_looks = 1;
  quint64 m_rowsRead = 0;
  QStringList m_robots;  // ours before others, keepers last
  qsizetype m_ours = 0;  // how many of them are ours
  QString m_first;       // what `first` stands for; empty while none of them has moved
  std::vector<QStringList> m_firstAsked;  // columns, while it is empty
  bool m_missed = false;                  // somebody waits for a variable that is not there
  std::optional<QDateTime> m_clock;
  std::shared_ptr<const telemetry::SeriesStore> m_compared;
  quint64 m_comparedGeneration = 0;
  double m_comparedOffset = 0.0, m_comparedFrom = 0.0;
  QString m_comparedCaption;
  std::map<telemetry::GroupId, std::shared_ptr<const telemetry::GroupView>> m_views;
  std::map<QString, telemetry::SeriesId> m_found;
  struct Named {
    CurveSpec spec;
    std::unique_ptr<DerivedSeries> rows;  // null: a plain variable under another name
    bool updated = false;                 // since the last refresh
    bool inWork = false;                  // a curve that is made of itself has no rows
  };
  std::map<QString, Named> m_named;
  bool m_namedAsked = false, m_namedWorking = false;
};

}  // namespace pitchboard::ui
