// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/plots/plots_dock.h>

#include <QAction>
#include <QDockWidget>
#include <QHBoxLayout>
#include <QInputDialog>
#include <QJsonDocument>
#include <QLayout>
#include <QMenu>
#include <QScopedValueRollback>
#include <QSettings>
#include <QStackedWidget>
#include <QTabBar>
#include <QToolBar>
#include <QToolButton>
#include <QUndoStack>
#include <QVBoxLayout>
#include <algorithm>
#include <limits>
#include <map>

#include <ui/base/notice_bar.h>
#include <ui/base/plot_target.h>
#include <ui/base/theme.h>
#include <ui/plots/plot_layout.h>
#include <ui/plots/plot_menus.h>
#include <ui/sources/abandoned_future.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/edit.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/shown_moment.h>

#include "curve_template.h"
#include "plot_feed.h"
#include "plot_page.h"
#include "plot_pane.h"

namespace pitchboard::ui {
namespace {

/// Tabs, plots in each, curves in each of them.
struct Shape {
  QString text;
  int curves = 0;
};

Shape shapeOf(const PlotLayout& layout) {
  Shape shape;
  for (const PageSpec& page : layout.pages) {
    shape.text += QLatin1Char('|');
    for (const PaneSpec& pane : page.panes) {
      shape.text += QStringLiteral(" %1").arg(pane.curves.size());
      shape.curves += static_cast<int>(pane.curves.size());
    }
  }
  return shape;
}

/// The change has happened already; `put` shows a layout. Changes of look and limits within a
/// second are one; what adds or removes is one for itself.
Edit layoutEdit(const PlotLayout& before, const PlotLayout& after,
                const std::function<void(const PlotLayout&)>& put) {
  const Shape was = shapeOf(before), is = shapeOf(after);
  return {is.curves > was.curves   ? QStringLiteral("Add to the plots")
          : is.curves < was.curves ? QStringLiteral("Remove from the plots")
                                   : QStringLiteral("Change the plots"),
          [put, after] { put(after); }, [put, before] { put(before); },
          was.text == is.text ? is.text : QString()};
}

constexpr int saveMilliseconds = 1000;
const QString noticeTopic = QStringLiteral("plots");
const QString layoutKey = QStringLiteral("plots/layout");

}  // namespace

PlotsDock::PlotsDock(const PlotsContext& context, QWidget* parent)
    : QWidget(parent),
      m_context(context),
      m_time(context.time),
      m_feed(new PlotFeed(context.shown, context.time, this)),
      m_pageRow(new QWidget(this)),
      m_tabs(new QTabBar(m_pageRow)),
      m_stack(new QStackedWidget(this)),
      m_notices(new NoticeBar(this)),
      m_window(new QToolButton(this)),
      m_undo(new QUndoStack(this)) {
  setObjectName(QStringLiteral("plots"));
  m_feed->setNotes(context.notes);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(m_pageRow);
  column->addWidget(m_notices);
  column->addWidget(m_stack, 1);
  auto* pageRow = new QHBoxLayout(m_pageRow);
  pageRow->setContentsMargins(0, 0, 0, 0);
  pageRow->addWidget(m_tabs);
  pageRow->addStretch(1);
  pageRow->addWidget(makeTools());
  m_tabs->setObjectName(QStringLiteral("docks"));  // they look like the tabs of docks
  m_tabs->setAccessibleName(QStringLiteral("Plot tabs"));
  m_tabs->setDrawBase(false);
  // The dock has a tab already: with one page, a row of tabs would only take room from the curves.
  m_tabs->setAutoHide(true);
  m_tabs->setMovable(true);
  m_tabs->setFont(themeFont(TypeRole::Secondary));
  m_tabs->setExpanding(false);
  m_tabs->setElideMode(Qt::ElideRight);
  m_draw = Beat::display().add(this, {}, [this] { drawNow(); });
  m_saveSoon.setSingleShot(true);
  m_saveSoon.setInterval(saveMilliseconds);
  connect(&m_saveSoon, &QTimer::timeout, this, &PlotsDock::save);
  connect(m_tabs, &QTabBar::tabBarDoubleClicked, this, &PlotsDock::renamePage);
  connect(m_tabs, &QTabBar::currentChanged, this, [this](int tab) {
    if (PlotPage* page = pageAt(tab)) m_stack->setCurrentWidget(page);
    scheduleDraw();
  });
  connect(m_tabs, &QTabBar::tabMoved, this, &PlotsDock::changed);
  connect(m_feed, &PlotFeed::refreshed, this, &PlotsDock::takeRows);
  connect(m_feed, &PlotFeed::groupsRenamed, this, &PlotsDock::renameGroups);
  connect(context.shown, &ShownMoment::newestChanged, m_feed, &PlotFeed::refreshSoon);
  connect(context.time, &LinkedTime::rangeChanged, this, &PlotsDock::scheduleDraw);
  connect(context.shown, &ShownMoment::marksChanged, this, &PlotsDock::scheduleDraw);
  if (context.plots != nullptr) {
    connect(context.plots, &PlotTarget::requested, this, &PlotsDock::plotVariables);
    connect(context.plots, &PlotTarget::overRequested, this, &PlotsDock::plotOver);
  }
  connect(context.shown, &ShownMoment::timesOfDayChanged, this, &PlotsDock::scheduleDraw);
  connect(context.shown, &ShownMoment::sourceChosen, this, &PlotsDock::takeWindow);
  connect(context.shown, &ShownMoment::marksMoved, this, [this](const TimeMarks& before) {
    pushTimeEdit(
        QStringLiteral("Move marks A and B"), QStringLiteral("marks"),
        [now = m_context.shown->marks()](LinkedTime* time) { time->shown()->setMarks(now); },
        [before](LinkedTime* time) { time->shown()->setMarks(before); });
  });
  if (context.compared != nullptr) {
    connect(context.compared, &ComparedSessions::changed, this, &PlotsDock::compare);
    connect(context.compared, &ComparedSessions::rowsCame, this, &PlotsDock::scheduleDraw);
    if (context.future != nullptr)
      connect(context.future, &AbandonedFuture::changed, this, &PlotsDock::compare);
    compare();
  }
  restore();
}

void PlotsDock::restore() {
  const QSettings* settings = m_context.settings;
  PlotLayout layout = m_context.first;
  if (settings != nullptr && settings->contains(layoutKey)) {
    const std::string saved = settings->value(layoutKey).toByteArray().toStdString();
    if (const auto read = layoutFromText(saved, "settings")) {
      layout = *read;
    } else {
      layout = {};
      showNotice(QStringLiteral("Could not restore your plots: %1")
                     .arg(QString::fromStdString(read.error().text())));
    }
  }
  m_windows.clear();  // what the tools showed until now is nobody's choice
  takeWindow();
  put(layout);
  m_known = layoutSpec();
  changed();
  m_saveSoon.stop();
}

/// The window of the source that is shown now, as it was left.
void PlotsDock::takeWindow() {
  m_windowOf = &m_context.shown->kind();
  const QSettings* settings = m_context.settings;
  const auto known = m_windows.find(m_windowOf);
  const double saved = known != m_windows.end() ? known->second
                       : settings != nullptr
                           ? settings->value(QLatin1String(m_windowOf->windowKey)).toDouble()
                           : 0.0;
  m_context.time->setWindow(saved > 0.0 ? saved : m_windowOf->window);
}

/// A change of what the layout does not hold; it has happened already.
void PlotsDock::pushTimeEdit(const QString& text, const QString& key,
                             const std::function<void(LinkedTime*)>& redo,
                             const std::function<void(LinkedTime*)>& undo) {
  if (m_restoring) return;
  const auto run = [this](const std::function<void(LinkedTime*)>& change) {
    return [this, change] {
      const QScopedValueRollback restoring(m_restoring, true);
      if (m_time) change(m_time);
    };
  };
  m_undo->push(new EditCommand({text, run(redo), run(undo), key}));
}

PlotsDock::~PlotsDock() {
  if (m_pageRow) save();
  delete m_pageRow;
}

QSize PlotsDock::sizeHint() const {
  return {scaled(this, 800), scaled(this, 248)};
}

PlotPage* PlotsDock::pageAt(int tab) const {
  return tab < 0 ? nullptr : m_tabs->tabData(tab).value<PlotPage*>();
}

PlotPage* PlotsDock::currentPage() const {
  return pageAt(m_tabs->currentIndex());
}

QList<PlotPage*> PlotsDock::pages() const {
  QList<PlotPage*> all;
  for (int i = 0; i < m_tabs->count(); ++i) all << pageAt(i);
  return all;
}

PlotPage* PlotsDock::addPage(const PageSpec& spec) {
  auto* page = new PlotPage(m_feed, spec, m_stack);
  page->setBoxTool(m_box->isChecked());
  m_stack->addWidget(page);
  int index = 0;
  {
    // The first tab becomes the current one before it has its page.
    const QSignalBlocker quiet(m_tabs);
    index = m_tabs->addTab(spec.name);
    m_tabs->setTabData(index, QVariant::fromValue(page));
  }
  auto* close = new QToolButton(m_tabs);
  close->setIcon(themedIcon(QStringLiteral("window-close")));
  close->setIconSize(QSize(scaled(this, 12), scaled(this, 12)));
  close->setFixedSize(scaled(this, 20), scaled(this, 20));
  close->setAutoRaise(true);
  close->setFocusPolicy(Qt::NoFocus);
  close->setToolTip(QStringLiteral("Close this tab"));
  connect(close, &QToolButton::clicked, this,
          [this, page] { closePage(int(pages().indexOf(page))); });
  m_tabs->setTabButton(index, QTabBar::RightSide, close);
  connect(page, &PlotPage::changed, this, [this, page] {
    m_tabs->setTabText(int(pages().indexOf(page)), page->name());
    changed();
    scheduleDraw();
  });
  connect(page, &PlotPage::sessionToggled, this, [this](quint64 id) {
    ComparedSession* session = m_context.compared ? m_context.compared->find(id) : nullptr;
    if (session != nullptr) session->setInPlots(!session->isInPlots());
  });
  connect(page, &PlotPage::alreadyPlotted, this, [this](const QStringList& names) {
    emit noted(names.size() == 1
                   ? QStringLiteral("%1 is already plotted").arg(names.front())
                   : QStringLiteral("%1 variables are already plotted").arg(names.size()));
  });
  connect(page, &PlotPage::menuRequested, this,
          [this, page](PlotPane* pane, int curve, const QPoint& at) {
            showPlotMenu(this, page, pane, curve, at);
          });
  changed();
  return page;
}

void PlotsDock::closePage(int index) {
  PlotPage* page = pageAt(index);
  if (page == nullptr) return;
  m_tabs->removeTab(index);
  m_stack->removeWidget(page);
  page->deleteLater();
  if (m_tabs->count() == 0) addPage({QStringLiteral("Plots"), {}});
  changed();
}

void PlotsDock::renamePage(int index) {
  if (index < 0) return;
  PlotPage* page = pageAt(index);
  if (page == nullptr) return;
  bool taken = false;
  const QString name =
      QInputDialog::getText(this, QStringLiteral("Rename tab"), QStringLiteral("Name of the tab:"),
                            QLineEdit::Normal, page->name(), &taken);
  if (taken && !name.trimmed().isEmpty()) page->setName(name.trimmed());
}

PlotLayout PlotsDock::layoutSpec() const {
  PlotLayout layout;
  for (const PlotPage* page : pages()) layout.pages << page->spec();
  layout.current = m_tabs->currentIndex();
  return layout;
}

void PlotsDock::setLayoutSpec(const PlotLayout& layout) {
  put(layout);
  changed();
}

/// Something that a layout holds is another: kept soon, and can be undone.
void PlotsDock::changed() {
  if (m_restoring) return;
  m_saveSoon.start();
  PlotLayout now = layoutSpec();
  std::map<QString, CurveSpec> named;
  for (const PageSpec& page : now.pages) {
    for (const PaneSpec& pane : page.panes) {
      for (const CurveSpec& curve : pane.curves) {
        const bool computed = curve.kind != CurveKind::Variable || !curve.title.isEmpty();
        if (computed && !isTemplate(curve)) named.emplace(curveName(curve), curve);
      }
    }
  }
  m_feed->setNamedCurves(named);
  if (now == m_known) return;
  const auto putLater = [this, renamed = m_renamings.size()](PlotLayout layout) {
    for (std::size_t i = renamed; i < m_renamings.size(); ++i) {
      layout = renamedGroups(layout, m_renamings[i]);
    }
    put(layout);
    m_known = layoutSpec();
    changed();
  };
  m_undo->push(new EditCommand(layoutEdit(m_known, now, putLater)));
  m_known = std::move(now);
}

void PlotsDock::renameGroups(const std::map<QString, QString>& names) {
  constexpr std::size_t maxRenamings = 1000;
  if (m_undo->count() == 0 || m_renamings.size() == maxRenamings) {
    m_undo->clear();
    m_renamings.clear();
  } else {
    m_renamings.push_back(names);
  }
  const PlotLayout before = layoutSpec(), now = renamedGroups(before, names);
  if (now == before) return;
  const QList<PlotPage*> all = pages();
  for (qsizetype page = 0; page < all.size(); ++page) {
    const QList<PlotPane*> panes = all[page]->panes();
    for (qsizetype pane = 0; pane < panes.size(); ++pane) {
      panes[pane]->setDescriptions(now.pages[page].panes[pane].curves);
    }
  }
  m_known = layoutSpec();
  changed();
}

void PlotsDock::put(const PlotLayout& layout) {
  m_restoring = true;
  while (m_tabs->count() > 0) {
    PlotPage* page = pageAt(0);
    m_tabs->removeTab(0);
    m_stack->removeWidget(page);
    page->deleteLater();
  }
  for (const PageSpec& page : layout.pages) addPage(page);
  if (layout.pages.isEmpty()) addPage({QStringLiteral("Plots"), {}});
  m_tabs->setCurrentIndex(layout.current);
  m_restoring = false;
  scheduleDraw();
}

void PlotsDock::save() {
  if (m_context.settings == nullptr) return;
  m_context.settings->setValue(layoutKey,
                               QJsonDocument(toJson(layoutSpec())).toJson(QJsonDocument::Compact));
  for (const auto& [kind, seconds] : m_windows) {
    m_context.settings->setValue(QLatin1String(kind->windowKey), seconds);
  }
}

void PlotsDock::showNotice(const QString& sentence) {
  m_notices->show({noticeTopic}, sentence);
}

void PlotsDock::settleNotice() {
  m_notices->settle(noticeTopic);
}

QStringList PlotsDock::variables() const {
  m_feed->refresh();
  return m_feed->names();
}

void PlotsDock::plotVariables(const QStringList& names) {
  m_feed->refresh();
  currentPage()->addVariables(names);
  if (auto* dock = qobject_cast<QDockWidget*>(parentWidget())) {
    dock->show();
    dock->raise();
  }
}

void PlotsDock::plotOver(const QString& group, const QString& other, const QStringList& columns) {
  m_feed->refresh();
  for (const PlotPage* page : pages()) {
    for (PlotPane* pane : page->panes()) {
      if (pane->kind() == PaneKind::Xy) continue;
      // As they are drawn: the description may be of the first robot, whoever that is.
      QList<CurveSpec> drawnCurves;
      for (const Curve& curve : pane->curves()) drawnCurves << curve.spec();
      for (const CurveSpec& curve : drawnCurves) {
        if (curve.kind != CurveKind::Variable || curve.inputs.size() != 1) continue;
        const QString& input = curve.inputs.front();
        const qsizetype slash = input.indexOf(QLatin1Char('/'));
        const QString drawn = input.left(slash), column = input.mid(slash + 1);
        if ((drawn != group && drawn != other) || !columns.contains(column)) continue;
        CurveSpec over =
            variableCurve((drawn == group ? other : group) + QLatin1Char('/') + column);
        over.side = curve.side;
        over.style = curve.style;
        pane->addCurve(over);
      }
    }
  }
}

void PlotsDock::showEvent(QShowEvent*) {
  m_feed->setRunning(true);
  scheduleDraw();
}

void PlotsDock::hideEvent(QHideEvent*) {
  m_feed->setRunning(false);
}

void PlotsDock::takeRows() {
  const auto known = m_context.time->data();
  const bool pending =
      m_feed->isWorking() || (currentPage() != nullptr && currentPage()->isWorking());
  if (pending) m_feed->refreshSoon();
  const bool same = known == m_drawnData && m_drawnGeneration == m_feed->generation() &&
                    m_drawnRows == m_feed->rowsRead();
  if (same && !pending) return;
  m_drawnData = known;
  m_drawnGeneration = m_feed->generation();
  m_drawnRows = m_feed->rowsRead();
  drawNow();
}

void PlotsDock::compare() {
  std::vector<ComparedRows> rows;
  for (const ComparedSession* session : m_context.compared->all()) {
    rows.push_back({session->id(), session->number(), session->series(), session->offset(),
                    -std::numeric_limits<double>::infinity(), session->caption(),
                    !session->isInPlots()});
  }
  const AbandonedFuture* future = m_context.future;
  if (rows.empty() && future != nullptr && future->isOn()) {
    rows.push_back({0, 0, future->series(), 0.0, future->begin(), future->caption()});
  }
  m_feed->setCompared(std::move(rows));
  scheduleDraw();
}

void PlotsDock::scheduleDraw() {
  m_draw->want();
}

void PlotsDock::drawNow() {
  m_draw->settle();
  m_feed->setClock(m_context.shown->clock());
  if (PlotPage* page = currentPage(); page != nullptr && isVisible()) page->refresh();
  const telemetry::TimeRange shown = m_context.time->range();
  m_feed->setTimeOfPixel((shown.end - shown.begin) / std::max(width(), 1));
}

QWidget* makePlotsDock(const PlotsContext& context, QWidget* parent) {
  return new PlotsDock(context, parent);
}

namespace {

QString windowText(double seconds) {
  return seconds < 60 ? QStringLiteral("%1 s").arg(seconds)
                      : QStringLiteral("%1 min").arg(seconds / 60);
}

QToolButton* toolButton(QAction* action, QWidget* parent) {
  auto* button = new QToolButton(parent);
  button->setDefaultAction(action);
  button->setAutoRaise(true);
  button->setIconSize(QSize(scaled(parent, 16), scaled(parent, 16)));
  button->setFixedHeight(scaled(parent, 22));
  button->setFont(themeFont(TypeRole::Secondary));
  if (action->icon().isNull()) button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  if (action->menu() != nullptr) button->setPopupMode(QToolButton::InstantPopup);
  return button;
}

}  // namespace

// In the row of tabs, because height is what plots lack.
QToolBar* PlotsDock::makeTools() {
  auto* tools = new QToolBar(QStringLiteral("Plot tools"), this);
  tools->setObjectName(QStringLiteral("plotTools"));
  tools->layout()->setSpacing(1);  // the sheet's, which was asked before it had its name
  tools->setIconSize(QSize(scaled(this, 16), scaled(this, 16)));
  LinkedTime* time = m_context.time;

  m_follow =
      new QAction(themedIcon(QStringLiteral("media-seek-forward")), QStringLiteral("Follow"), this);
  m_follow->setToolTip(QStringLiteral("Follow the newest moment, or the moment shown"));
  m_follow->setCheckable(true);
  m_follow->setChecked(time->isFollowing());
  connect(m_follow, &QAction::triggered, time, &LinkedTime::setFollowing);
  connect(time, &LinkedTime::followingChanged, m_follow, &QAction::setChecked);

  m_window->setObjectName(QStringLiteral("plotWindow"));
  m_window->setToolTip(QStringLiteral("Time span shown while following"));
  m_window->setFont(themeFont(TypeRole::Secondary));
  m_window->setPopupMode(QToolButton::InstantPopup);
  auto* windows = new QMenu(m_window);
  for (const double seconds : LinkedTime::windows) {
    windows->addAction(windowText(seconds), this, [this, time, seconds] {
      const double before = time->window();
      time->setFollowing(true);
      if (seconds == before) return;
      time->setWindow(seconds);
      pushTimeEdit(
          QStringLiteral("Show %1").arg(windowText(seconds)), {},
          [seconds](LinkedTime* to) { to->setWindow(seconds); },
          [before](LinkedTime* to) { to->setWindow(before); });
    });
  }
  m_window->setMenu(windows);
  connect(time, &LinkedTime::windowChanged, this, &PlotsDock::showWindow);
  showWindow();

  m_marks = new QAction(QStringLiteral("A|B"), this);
  m_marks->setToolTip(
      QStringLiteral("Marks A and B: differences and statistics between two moments"));
  m_marks->setCheckable(true);
  m_marks->setChecked(m_context.shown->hasMarks());
  connect(m_marks, &QAction::triggered, time, &LinkedTime::showMarks);
  connect(m_context.shown, &ShownMoment::marksChanged, m_marks,
          [this] { m_marks->setChecked(m_context.shown->hasMarks()); });

  m_box = new QAction(themedIcon(QStringLiteral("select-rectangular")),
                      QStringLiteral("Zoom into a box"), this);
  m_box->setToolTip(QStringLiteral("Drag a box to zoom into it (also Shift-drag)"));
  m_box->setCheckable(true);
  connect(m_box, &QAction::toggled, this, [this](bool on) {
    for (PlotPage* page : pages()) page->setBoxTool(on);
  });

  auto* fit = new QAction(themedIcon(QStringLiteral("zoom-fit-best")),
                          QStringLiteral("Show everything"), this);
  fit->setToolTip(QStringLiteral("Show all data (or double-click a plot)"));
  connect(fit, &QAction::triggered, time, &LinkedTime::fitAll);

  auto* add =
      new QAction(themedIcon(QStringLiteral("list-add")), QStringLiteral("Add curve…"), this);
  add->setToolTip(QStringLiteral("Add a variable, or a curve computed from variables"));
  connect(add, &QAction::triggered, this, [this] { askForCurve(this); });

  auto* more =
      new QAction(themedIcon(QStringLiteral("application-menu")), QStringLiteral("Plots"), this);
  more->setToolTip(QStringLiteral("Tabs, layouts, export"));
  more->setMenu(makePlotsMenu(this));

  auto* newPage =
      new QAction(themedIcon(QStringLiteral("tab-new")), QStringLiteral("New tab"), this);
  connect(newPage, &QAction::triggered, this, [this] {
    addPage({QStringLiteral("Plots %1").arg(m_tabs->count() + 1), {}});
    m_tabs->setCurrentIndex(m_tabs->count() - 1);
  });

  tools->addWidget(toolButton(m_follow, tools));
  tools->addWidget(m_window);
  for (QAction* action : {m_marks, m_box, fit, add, newPage, more}) {
    tools->addWidget(toolButton(action, tools));
  }
  return tools;
}

void PlotsDock::showWindow() {
  const double seconds = m_context.time->window();
  m_windows[m_windowOf] = seconds;
  const auto& offered = LinkedTime::windows;
  const bool round = std::find(offered.begin(), offered.end(), seconds) != offered.end();
  m_window->setText(round ? windowText(seconds) : QStringLiteral("%1 s").arg(seconds, 0, 'g', 3));
  m_window->setAccessibleName(QStringLiteral("Time shown: %1").arg(m_window->text()));
  if (!m_restoring) m_saveSoon.start();
}

}  // namespace pitchboard::ui
