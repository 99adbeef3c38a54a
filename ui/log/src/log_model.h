// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What was said by the simulation and the robots' processes: a bounded list, in which the oldest
// lines go first, but never so many of an origin that others push out all that it said; and which
// of them are shown. Window thread.

#include <QAbstractTableModel>
#include <QDateTime>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <base/log_line.h>
#include <ui/base/text_filter.h>
#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class LogModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Time, Origin, Text, columns };
  static constexpr std::size_t maxLines = 10'000;
  /// So many lines more are kept until they are removed together.
  static constexpr std::size_t surplusLines = 500;
  static constexpr int timeRole = Qt::UserRole;          ///< s of the source
  static constexpr int levelRole = Qt::UserRole + 1;     ///< LogLevel
  static constexpr int shownRole = Qt::UserRole + 2;     ///< bool: of the source that is shown
  static constexpr int recordedRole = Qt::UserRole + 3;  ///< bool: read from a session
  using QAbstractTableModel::QAbstractTableModel;

  /// `clock`: the time of day at their source's second 0, where it has one.
  /// `of`: whose lines they are, for setMoment(). `events`: of the match and its referee, which
  /// share one part of the list whatever robot they are about.
  void append(const std::vector<LogLine>& lines, const std::optional<QDateTime>& clock = {},
              const SourceKind* of = nullptr, bool events = false);
  /// The source begins again: its lines so far belong to no moment of it any more, and `text`
  /// divides them from what comes.
  void divide(const SourceKind& of, const QString& text);
  /// The source that is shown, and the moment while it is not the newest: later lines are pale.
  void setMoment(const SourceKind& shown, std::optional<double> time);
  /// The last line of the source shown that had been said at the moment; −1: none.
  int rowAtMoment() const;
  /// Times as time of day, where the lines' source has one.
  void setTimesOfDay(bool on);
  /// Lines so far that tell of this decision by hand were undone.
  void strike(const SourceKind& of, std::uint32_t cause);
  void clear();
  /// Removes this source's lines that are later than `time` (s): the source goes on from there.
  void rewind(const SourceKind& of, double time);
  /// Lines that were removed to make room.
  quint64 dropped() const { return m_dropped; }
  /// Lines of processes that are starting (LogLevel::Debug).
  int startLines() const { return m_startLines; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  /// An origin's lines, or the events. It keeps half of an equal share, if it has so many: then
  /// those that go are neighbours, and a line costs the same whether the list is full or not.
  struct Part {
    std::size_t lines = 0, mayGo = 0;
  };
  struct Line : LogLine {
    std::optional<QDateTime> clock;
    const SourceKind* of = nullptr;  // the rows of kinds are never gone
    bool isEvent = false, isDivider = false, undone = false;
    Part* part = nullptr;  // of m_parts
  };
  Part& partOf(const Line& line);
  void insert(std::vector<Line> lines);
  void makeRoom();
  void forgetWhere(const std::function<bool(const Line&)>& unwanted);
  void forget(std::deque<Line>::iterator first, std::deque<Line>::iterator last);
  bool isLater(const Line& line) const {
    return m_moment && line.of == m_shown && line.time > *m_moment;
  }
  std::deque<Line> m_lines;
  std::map<std::string, Part> m_parts;
  const SourceKind* m_shown = &SourceKind::Simulate;
  std::optional<double> m_moment;
  bool m_timesOfDay = true;
  quint64 m_dropped = 0;
  int m_startLines = 0;
};

/// Lines that contain the filter text, of a level and above. Lines of processes that are starting
/// are folded away unless asked for; those of a session are shown while it is.
class LogFilter : public TextFilter {
 public:
  using TextFilter::TextFilter;
  void setLeast(LogLevel least) {
    m_least = least;
    filterAgain();
  }
  void showStartLines(bool shown) {
    m_startLinesShown = shown;
    filterAgain();
  }
  void showRecorded(bool shown) {
    if (std::exchange(m_recordedShown, shown) != shown) filterAgain();
  }

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

 private:
  LogLevel m_least = LogLevel::Info;
  bool m_startLinesShown = false, m_recordedShown = false;
};

}  // namespace pitchboard::ui
