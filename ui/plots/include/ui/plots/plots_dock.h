// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The plots: tabs of plots over one linked time, their tool row, and what is kept of them between
// runs. UI thread only.

#include <QPointer>
#include <QTimer>
#include <QWidget>
#include <functional>
#include <map>
#include <optional>

#include <telemetry/series/series_store.h>
#include <ui/base/beat.h>
#include <ui/plots/plot_layout.h>
#include <ui/sources/frame_source.h>
#include <ui/sources/linked_time.h>

class QAction;
class QMenu;
class QSettings;
class QStackedWidget;
class QTabBar;
class QToolBar;
class QToolButton;
class QUndoStack;

namespace pitchboard::ui {

class AbandonedFuture;
class ComparedSession;
class NoticeBar;
class PlotFeed;
class PlotPage;
class PlotPane;
class PlotTarget;
class SourceSwitch;
class Timeline;

/// What the dock shows and moves; everything outlives it.
struct PlotsContext {
  SourceSwitch* source = nullptr;
  LinkedTime* time = nullptr;           ///< visible range, cursor and marks of plots and timeline
  Timeline* timeline = nullptr;         ///< the moment shown, events; may be null
  PlotTarget* plots = nullptr;          ///< who asks for plots from elsewhere; may be null
  QSettings* settings = nullptr;        ///< the user's; may be null
  ComparedSession* compared = nullptr;  ///< whose curves are drawn beside; may be null
  AbandonedFuture* future = nullptr;    ///< else its; may be null
  PlotLayout first = {};                ///< shown when nothing was kept, at the very first start
};

class PlotsDock : public QWidget {
  Q_OBJECT
 public:
  /// The layout of the last time comes from `context.settings`, when there are any.
  PlotsDock(const PlotsContext& context, QWidget* parent);
  ~PlotsDock() override;

  PlotFeed* feed() const { return m_feed; }
  LinkedTime* time() const { return m_context.time; }
  PlotPage* currentPage() const;
  QList<PlotPage*> pages() const;
  PlotPage* addPage(const PageSpec& spec);
  void closePage(int index);
  void renamePage(int index);
  /// The tabs of the pages, empty while there is one. They stand above the plots unless the window
  /// has a better place for them.
  QWidget* pageTabs() const { return m_pageRow; }

  PlotLayout layoutSpec() const;
  /// Can be undone, as everything that is changed here.
  void setLayoutSpec(const PlotLayout& layout);
  QUndoStack* undoStack() const { return m_undo; }

  const PlotsContext& context() const { return m_context; }
  /// Says what went wrong, above the plots.
  void showNotice(const QString& sentence);
  void settleNotice();  ///< what it said is over

  /// Every variable of the source that is shown, `GROUP/COLUMN`.
  QStringList variables() const;
  /// Adds to the page in front, and brings it there.
  void plotVariables(const QStringList& names);

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  QSize sizeHint() const override;

 private:
  QToolBar* makeTools();
  void restore();
  void put(const PlotLayout& layout);
  void changed();
  void follow();
  void compare();
  void scheduleDraw();
  void drawNow();
  void takeRows();
  void save();
  void showWindow();
  void takeWindow();
  void pushTimeEdit(const QString& text, const QString& key,
                    const std::function<void(LinkedTime*)>& redo,
                    const std::function<void(LinkedTime*)>& undo);
  PlotPage* pageAt(int tab) const;

  PlotsContext m_context;
  QPointer<LinkedTime> m_time;  // the window deletes it before its docks
  PlotFeed* m_feed;
  QPointer<QWidget> m_pageRow;  // may stand elsewhere, and go with what it stands in
  QTabBar* m_tabs;              // in it; the order of the pages
  QStackedWidget* m_stack;
  NoticeBar* m_notices;
  QToolButton* m_window;
  QUndoStack* m_undo;
  PlotLayout m_known;  // what the last command led to
  QAction* m_follow;
  QAction* m_marks;
  QAction* m_box;
  std::unique_ptr<Beat::Part> m_draw;
  QTimer m_saveSoon;
  bool m_restoring = false;
  std::map<SourceKind, double> m_windows;  // s, of the sources that were shown
  SourceKind m_windowOf{};
  quint64 m_drawnGeneration = 0;
  quint64 m_drawnRows = 0;
  std::optional<telemetry::TimeRange> m_drawnData;
};

QWidget* makePlotsDock(const PlotsContext& context, QWidget* parent);

}  // namespace pitchboard::ui
