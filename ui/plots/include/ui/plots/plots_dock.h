// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The Plots dock: tabs of plots with a common time axis, their tool row, and the layout that is
// kept between runs. UI thread only.

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
class ComparedSessions;
class NoteBoard;
class NoticeBar;
class PlotFeed;
class PlotPage;
class PlotPane;
class PlotTarget;
class ShownMoment;

/// What the dock shows and changes; all must outlive it.
struct PlotsContext {
  ShownMoment* shown = nullptr;
  LinkedTime* time = nullptr;            ///< visible range and cursor of plots and timeline
  PlotTarget* plots = nullptr;           ///< requests from other docks; may be null
  QSettings* settings = nullptr;         ///< the user's; may be null
  ComparedSessions* compared = nullptr;  ///< their curves are drawn as well; may be null
  AbandonedFuture* future = nullptr;     ///< drawn if no session is compared; may be null
  PlotLayout first = {};                 ///< layout of the very first start
  NoteBoard* notes = nullptr;            ///< what is drawn on plots; may be null
};

class PlotsDock : public QWidget {
  Q_OBJECT
 public:
  /// Restores the last layout from `context.settings`, if there is one.
  PlotsDock(const PlotsContext& context, QWidget* parent);
  ~PlotsDock() override;

  PlotFeed* feed() const { return m_feed; }
  LinkedTime* time() const { return m_context.time; }
  PlotPage* currentPage() const;
  QList<PlotPage*> pages() const;
  PlotPage* addPage(const PageSpec& spec);
  void closePage(int index);
  void renamePage(int index);
  /// Returns the tabs of the pages, which are hidden while there is only one page. They are above
  /// the plots unless the window puts them elsewhere.
  QWidget* pageTabs() const { return m_pageRow; }

  PlotLayout layoutSpec() const;
  /// Can be undone, like all changes here.
  void setLayoutSpec(const PlotLayout& layout);
  QUndoStack* undoStack() const { return m_undo; }

  const PlotsContext& context() const { return m_context; }
  /// Shows a problem above the plots.
  void showNotice(const QString& sentence);
  void settleNotice();  ///< removes the notice

  /// Returns all variables of the source that is shown, as `GROUP/COLUMN`.
  QStringList variables() const;
  /// Adds curves to the current page and raises the dock.
  void plotVariables(const QStringList& names);
  /// See PlotTarget::plotOver().
  void plotOver(const QString& group, const QString& other, const QStringList& columns);

 signals:
  /// Something that was asked for has happened already; for the status bar.
  void noted(const QString& sentence);

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  QSize sizeHint() const override;

 private:
  QToolBar* makeTools();
  void restore();
  void put(const PlotLayout& layout);
  void changed();
  void compare();
  void scheduleDraw();
  void drawNow();
  void takeRows();
  void renameGroups(const std::map<QString, QString>& names);
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
  QPointer<QWidget> m_pageRow;  // may be in another layout, and is deleted with its parent
  QTabBar* m_tabs;              // in it; the order of the pages
  QStackedWidget* m_stack;
  NoticeBar* m_notices;
  QToolButton* m_window;
  QUndoStack* m_undo;
  PlotLayout m_known;  // what the last command led to
  /// Names that groups have got since the first command that can be undone.
  std::vector<std::map<QString, QString>> m_renamings;
  QAction* m_follow;
  QAction* m_marks;
  QAction* m_box;
  std::unique_ptr<Beat::Part> m_draw;
  QTimer m_saveSoon;
  bool m_restoring = false;
  std::map<const SourceKind*, double> m_windows;  // s, of the sources that were shown
  const SourceKind* m_windowOf = nullptr;
  quint64 m_drawnGeneration = 0;
  quint64 m_drawnRows = 0;
  std::optional<telemetry::TimeRange> m_drawnData;
};

QWidget* makePlotsDock(const PlotsContext& context, QWidget* parent);

}  // namespace pitchboard::ui
