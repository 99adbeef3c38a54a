// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The timeline itself: axis, what memory holds, the window of the plots, marks of events, the
// moment shown. Click or drag to look back, also in the band; the plots' window has a handle below
// the band; Shift-drag chooses a range; wheel zooms, middle-drag or a wheel with Shift moves. UI
// thread only.

#include <QStringList>
#include <QWidget>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include <ui/base/beat.h>
#include <ui/base/time_axis.h>

#include "event_marks.h"

class QLineEdit;
class QScrollBar;

namespace pitchboard::ui {

class AbandonedFuture;
class EventList;
class LinkedTime;
class RuleWatch;
struct BrokenRule;
class ShownMoment;

/// A compared session in a row of its own.
struct ComparedRow {
  const EventList* events = nullptr;
  double offset = 0.0;  ///< s, where its second 0 stands
  QString caption = {};
  int number = 1;         ///< of its colour and mark (session_mark.h)
  bool isOnField = true;  ///< else its mark is hollow
  /// s, its first and last moment, in its own time.
  std::optional<telemetry::TimeRange> range = {};
  quint64 session = 0;  ///< its id
};

class TimelineStrip : public QWidget {
  Q_OBJECT
 public:
  /// `plots` may be null: then there is no window of theirs.
  TimelineStrip(ShownMoment* shown, LinkedTime* plots, QWidget* parent = nullptr);
  ~TimelineStrip() override;

  /// Compared sessions, a row each, below each other; many are low, and scroll.
  void setCompared(std::vector<ComparedRow> rows);

  /// What the match has left, a dashed branch above the band; null: none.
  void setFuture(AbandonedFuture* future);

  /// Broken rules, in a row above the band while there are rules, and in the rows of compared
  /// sessions; null: none.
  void setRules(RuleWatch* rules);

  telemetry::TimeRange shown() const { return m_axis.shown; }
  /// Shows this much; ends following.
  void setShown(telemetry::TimeRange range);
  /// Everything there is, and what comes.
  void showAll();
  bool showsAll() const { return m_showsAll; }
  void zoom(double factor, double anchor);
  /// Opens the note of a bookmark for writing, in its place.
  void editNote(int row);

  // Geometry of the parts, for the menu and for tests.
  const TimeAxis& axis() const { return m_axis; }
  const std::vector<EventMark>& marks();
  const std::vector<EventMark>& comparedMarks(int row = 0);
  QRect bandRect() const;
  /// Empty while there is no such row, or while it is scrolled out of sight.
  QRect comparedRect(int row = 0) const;
  /// The colour and mark at the end of a row; a click there shows the session on the field or not.
  QRect comparedChip(int row = 0) const;
  QRect branchRect() const;  ///< of the abandoned future; empty while there is none
  QRect rulesRect() const;   ///< empty while there are no rules
  /// Where broken rules of a compared session stand, at the foot of its row; empty while there are
  /// no rules.
  QRect comparedRulesRect(int row = 0) const;
  /// Broken rules at this pixel, the most severe first; of a compared session with this id, or of
  /// what is shown (0).
  std::vector<const BrokenRule*> brokenAt(double x, quint64 session = 0) const;
  /// What moves the plots' window, and changes it at its ends: below the band, never narrower than
  /// a hand needs.
  std::optional<QRectF> rangeHandle() const;

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 signals:
  /// A compared session was moved by hand: its second 0 is to be there, s.
  void comparedMoved(int row, double offset);
  /// A compared session is to be on the field, or not any more.
  void comparedToggled(int row);
  /// On this event; null: on none. `row`: of the compared session; -1: of what is shown.
  void menuRequested(QPoint global, const pitchboard::link::MatchEvent* event, int row);
  /// Session files were dropped here.
  void filesDropped(const QStringList& paths);

 private:
  enum class Grab { Nothing, Moment, Window, WindowBegin, WindowEnd, Range, View, Compared, Chip };
  void addZoom(const char* id, const char* text, const std::function<void()>& change);
  MarkSizes markSizes() const;
  std::optional<QRectF> windowRect() const;  // of the plots, in the band
  void fitAxis();
  void updateCalmly();
  void clampShown(telemetry::TimeRange& range) const;
  static constexpr int axisHeight = 14, railHeight = 6,
                       bandHeight = 10;  // px of the mock, from below
  void moveWindow(double by);
  Grab grabAt(QPointF at, Qt::KeyboardModifiers keys) const;
  const EventMark* markAt(QPointF at);
  const EventMark* nearest(const std::vector<EventMark>& marks, double x) const;
  void showCursorAt(QPointF at, Qt::KeyboardModifiers keys);
  QString tipAt(QPointF at);
  void finishNote(bool keep);
  QRect marksRect() const;
  int comparedRows() const { return static_cast<int>(m_compared.size()); }
  int visibleRows() const;
  int comparedRowHeight() const;
  int comparedTop() const;  // of the first visible row
  int rowAt(QPointF at) const;
  void placeScrollBar();
  QString comparedTip(QPointF at);
  int branchHeight() const;
  int lanesTop() const;  // of what stands on the band
  QString rulesTip(double x, quint64 session = 0, QStringList lines = {}) const;
  std::vector<const BrokenRule*> comparedBrokenAt(QPointF at) const;
  void paintBranch(QPainter& painter) const;
  void paintBand(QPainter& painter) const;
  void paintRules(QPainter& painter) const;
  void paintBroken(QPainter& painter, const QRect& place, quint64 session) const;
  void paintWindow(QPainter& painter) const;
  void paintRange(QPainter& painter) const;
  void paintMarks(QPainter& painter);
  void paintCompared(QPainter& painter);
  void paintRow(QPainter& painter, const std::vector<EventMark>& marks,
                const std::deque<link::MatchEvent>& events, double centre, double bottom,
                double strength) const;
  void paintAxis(QPainter& painter) const;
  void paintMoment(QPainter& painter) const;

  ShownMoment* m_shown;
  LinkedTime* m_plots;
  AbandonedFuture* m_future = nullptr;
  RuleWatch* m_rules = nullptr;
  struct LaidOut {
    std::vector<EventMark> marks;
    TimeAxis axis;  // what they were laid out for
    std::uint64_t revision = ~std::uint64_t{0};
  };
  std::vector<ComparedRow> m_compared;
  std::vector<LaidOut> m_comparedMarks;  // of each row
  QScrollBar* m_scroll;                  // of the rows; in their number
  int m_grabRow = -1;
  double m_grabOffset = 0.0;
  std::unique_ptr<Beat::Part> m_calm;
  TimeAxis m_axis;
  bool m_showsAll = true;
  Grab m_grab = Grab::Nothing;
  double m_grabTime = 0.0;             // under the mouse when it was pressed
  telemetry::TimeRange m_grabRange{};  // window or view at that moment
  QPointF m_pressedAt;
  bool m_dragged = false;
  std::vector<EventMark> m_marks;
  TimeAxis m_marksAxis;  // what m_marks were laid out for
  std::uint64_t m_marksRevision = ~std::uint64_t{0};
  const EventList* m_marksOf = nullptr;
  QLineEdit* m_note = nullptr;
  double m_noteTime = 0.0;
};

}  // namespace pitchboard::ui
