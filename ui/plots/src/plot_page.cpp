// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_page.h"

#include <QDragEnterEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QMimeData>
#include <QScrollArea>
#include <QScrollBar>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include <ui/base/theme.h>
#include <ui/base/variable_names.h>
#include <ui/sources/linked_time.h>

#include "marks_panel.h"
#include "time_ruler.h"

namespace pitchboard::ui {
namespace {
constexpr int plainLeft = 40;  // px of the mock: at least this for the numbers of values

PaneSpec paneOf(PaneKind kind, const CurveSpec& curve) {
  PaneSpec spec;
  spec.kind = kind;
  spec.curves << curve;
  return spec;
}
}  // namespace

PlotPage::PlotPage(PlotFeed* feed, const PageSpec& spec, QWidget* parent)
    : QWidget(parent),
      m_feed(feed),
      m_name(spec.name),
      m_stack(new QWidget(this)),
      m_panes(new QSplitter(Qt::Vertical, m_stack)),
      m_split(new QSplitter(Qt::Horizontal, this)),
      m_scroll(new QScrollArea(m_stack)),
      m_empty(new QLabel(m_stack)),
      m_marks(new MarksPanel(feed, this)) {
  setObjectName(QStringLiteral("plotPage"));
  setAcceptDrops(true);
  const auto axis = [this] { return timeAxis(); };
  m_heads = new MarkHeads(feed->time(), axis, m_stack);
  m_ruler = new TimeRuler(feed, axis, m_stack);
  m_lines = new TimeLines(feed->time(), axis, m_stack);
  m_stack->setBackgroundRole(QPalette::Base);
  m_stack->setAutoFillBackground(true);
  m_panes->setChildrenCollapsible(false);
  m_panes->setHandleWidth(scaled(this, 4));
  m_panes->setBackgroundRole(QPalette::Base);
  // More plots than fit are scrolled: the window never grows because of them.
  m_scroll->setFrameShape(QFrame::NoFrame);
  m_scroll->setWidgetResizable(true);
  m_scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  m_scroll->setFocusPolicy(Qt::NoFocus);
  m_scroll->viewport()->setBackgroundRole(QPalette::Base);
  m_scroll->setWidget(m_panes);
  connect(m_scroll->verticalScrollBar(), &QScrollBar::valueChanged, this, &PlotPage::placeLines);
  m_empty->setObjectName(QStringLiteral("emptyPlots"));
  m_empty->setText(
      QStringLiteral("Drag variables here, or press Enter on one in Variables.\n"
                     "Add curve chooses from a list."));
  m_empty->setAlignment(Qt::AlignCenter);
  m_empty->setForegroundRole(QPalette::PlaceholderText);
  auto* column = new QVBoxLayout(m_stack);
  column->setContentsMargins(0, scaled(this, 2), 0, 0);
  column->setSpacing(0);
  column->addWidget(m_heads);
  column->addWidget(m_empty, 1);
  column->addWidget(m_scroll, 1);
  column->addWidget(m_ruler);
  m_split->setChildrenCollapsible(false);
  m_split->setHandleWidth(scaled(this, 1));
  m_split->addWidget(m_stack);
  m_split->addWidget(m_marks);
  m_split->setStretchFactor(0, 1);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(m_split);
  m_stack->installEventFilter(this);
  connect(m_panes, &QSplitter::splitterMoved, this, &PlotPage::notifyChanged);
  for (const auto moved : {&LinkedTime::cursorChanged, &LinkedTime::playheadMoved}) {
    connect(feed->time(), moved, this, [this] {
      if (!isVisible()) return;
      for (PlotPane* pane : panes()) {
        if (pane->isOverTime())
          pane->showValues();
        else
          pane->refresh();
        if (pane->kind() == PaneKind::Lane) pane->surface()->update();
      }
    });
  }
  for (const PaneSpec& pane : spec.panes) insertPane(m_panes->count(), pane);
  QList<int> shares;
  for (const PaneSpec& pane : spec.panes) shares << pane.share;
  m_panes->setSizes(shares);
  align();
}

class PlotPage::Batch {
 public:
  explicit Batch(PlotPage* page) : m_page(page) { ++m_page->m_batches; }
  ~Batch() {
    if (--m_page->m_batches == 0 && std::exchange(m_page->m_changedInBatch, false)) {
      emit m_page->changed();
    }
  }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

 private:
  PlotPage* m_page;
};

void PlotPage::notifyChanged() {
  if (m_batches > 0)
    m_changedInBatch = true;
  else
    emit changed();
}

PageSpec PlotPage::spec() const {
  PageSpec spec{m_name, {}};
  const QList<int> sizes = m_panes->sizes();
  const QList<PlotPane*> all = panes();
  for (qsizetype i = 0; i < all.size(); ++i) {
    PaneSpec pane = all[i]->spec();
    // A splitter that was never shown has no sizes yet.
    if (sizes.value(i) > 0) pane.share = sizes[i];
    spec.panes << pane;
  }
  return spec;
}

void PlotPage::setName(const QString& name) {
  m_name = name;
  notifyChanged();
}

QList<PlotPane*> PlotPage::panes() const {
  QList<PlotPane*> all;
  for (int i = 0; i < m_panes->count(); ++i) all << static_cast<PlotPane*>(m_panes->widget(i));
  return all;
}

PlotPane* PlotPage::insertPane(int index, const PaneSpec& spec) {
  // A splitter lays a child out, and with it the others, before the child's constructor has ended.
  PlotPane* pane = makePane(m_feed, spec, this);
  m_panes->insertWidget(index, pane);
  m_panes->setStretchFactor(index, spec.kind == PaneKind::Lane ? 0 : 1);
  pane->setBoxTool(m_boxTool);
  connect(pane, &PlotPane::leftChanged, this, &PlotPage::align);
  connect(pane, &PlotPane::changed, this, &PlotPage::notifyChanged);
  connect(pane, &PlotPane::changed, this, &PlotPage::showMarks);
  connect(pane, &PlotPane::sessionToggled, this, &PlotPage::sessionToggled);
  connect(pane, &PlotPane::pointed, this, [this, pane](std::optional<QPointF> at) {
    m_pointedPane = pane;
    m_pointedAt = at;
    showPointed();
  });
  connect(pane, &PlotPane::menuRequested, this,
          [this, pane](int curve, const QPoint& at) { emit menuRequested(pane, curve, at); });
  pane->refresh();
  pane->show();
  align();
  m_lines->raise();
  notifyChanged();
  return pane;
}

void PlotPage::removePane(PlotPane* pane) {
  pane->setParent(nullptr);
  pane->deleteLater();
  align();
  showMarks();
  notifyChanged();
}

void PlotPage::removeAll() {
  for (PlotPane* pane : panes()) {
    pane->setParent(nullptr);
    pane->deleteLater();
  }
  align();
  showMarks();
  notifyChanged();
}

// The table gets the width that its columns want, as long as the curves keep most of theirs. Where
// it must scroll anyway they keep more.
void PlotPage::showMarks() {
  const bool before = m_marks->isVisibleTo(this);
  m_marks->refresh(panes());
  if (before || !m_marks->isVisibleTo(this)) return;
  const int room = width() - m_split->handleWidth();
  int wanted = m_marks->sizeHint().width();
  if (wanted > room * 2 / 5) wanted = room * 3 / 10;
  m_split->setSizes({room - wanted, wanted});
}

void PlotPage::showPointed() {
  std::optional<PointedValue> value;
  if (m_pointedPane && m_pointedAt) {
    const QString text = m_pointedPane->pointedText(*m_pointedAt);
    const QPointF at = m_pointedPane->surface()->mapTo(m_stack, m_pointedAt->toPoint());
    if (!text.isEmpty()) value = {at.y() - m_lines->y(), text};
  }
  m_lines->setPointed(value);
}

void PlotPage::setForPicture(bool on) {
  m_lines->setForPicture(on);
  m_ruler->setForPicture(on);
  for (int i = 1; i < m_panes->count(); ++i) m_panes->handle(i)->setVisible(!on);
  m_scroll->setVerticalScrollBarPolicy(on ? Qt::ScrollBarAlwaysOff : Qt::ScrollBarAsNeeded);
}

void PlotPage::replacePane(PlotPane* pane, const PaneSpec& spec) {
  const int index = m_panes->indexOf(pane);
  if (index < 0) return;
  const QList<int> sizes = m_panes->sizes();
  pane->setParent(nullptr);
  pane->deleteLater();
  insertPane(index, spec);
  m_panes->setSizes(sizes);
}

bool PlotPage::isCoded(const QString& name) const {
  const ColumnView view = m_feed->find(name);
  return view && view.isCoded();
}

QString PlotPage::unitOf(const QString& name) const {
  const ColumnView view = m_feed->find(name);
  return view ? QString::fromStdString(view.info().unit) : QString();
}

void PlotPage::place(const QStringList& names, QList<PlotPane*> takers, int index) {
  const Batch batch(this);
  for (const QString& name : names) {
    const PaneKind kind = isCoded(name) ? PaneKind::Lane : PaneKind::Chart;
    const QString unit = unitOf(name);
    const auto taker = std::ranges::find_if(
        takers, [&](const PlotPane* pane) { return pane->kind() == kind && pane->canTake(unit); });
    if (taker != takers.end())
      (*taker)->addCurve(variableCurve(name));
    else
      takers << insertPane(index++, paneOf(kind, variableCurve(name)));
  }
}

void PlotPage::addVariables(const QStringList& names) {
  // The last one is where somebody worked last.
  QList<PlotPane*> takers = panes();
  std::reverse(takers.begin(), takers.end());
  place(pointOut(names, takers), takers, m_panes->count());
}

QStringList PlotPage::pointOut(const QStringList& names, const QList<PlotPane*>& in) {
  QStringList others, found;
  for (const QString& name : names) {
    const CurveSpec curve = variableCurve(name);
    const auto has =
        std::ranges::find_if(in, [&curve](const PlotPane* pane) { return pane->hasCurve(curve); });
    if (has == in.end()) {
      others << name;
      continue;
    }
    pointOut(*has, curve);
    found << curveName(curve);
  }
  if (!found.isEmpty()) emit alreadyPlotted(found);
  return others;
}

void PlotPage::pointOut(PlotPane* pane, const CurveSpec& curve) {
  pane->pointOut(curve);
  m_scroll->ensureWidgetVisible(pane, 0, 0);
}

void PlotPage::addCurve(const CurveSpec& curve) {
  for (PlotPane* pane : panes()) {
    if (pane->kind() != PaneKind::Chart) continue;
    if (pane->hasCurve(curve)) {
      pointOut(pane, curve);
      emit alreadyPlotted({curveName(curve)});
    } else {
      pane->addCurve(curve);
    }
    return;
  }
  insertPane(0, paneOf(PaneKind::Chart, curve));
}

void PlotPage::align() {
  if (m_aligning) return;
  m_aligning = true;
  bool overTime = false;
  // A new width can change the numbers, and with them the width that they need. The result does not
  // depend on the width before.
  constexpr int maxPasses = 3;
  for (int pass = 0; pass < maxPasses; ++pass) {
    int left = scaled(this, plainLeft);
    int right = scaled(this, PlotPane::rightMargin);
    for (PlotPane* pane : panes()) {
      left = qMax(left, pane->wantedLeft());
      right = qMax(right, pane->wantedRight());
      overTime = overTime || pane->isOverTime();
    }
    if (pass > 0 && left == m_left && right == m_right) break;
    m_left = left;
    m_right = right;
    for (PlotPane* pane : panes()) pane->setEdges(left, right);
  }
  giveLanesTheirHeight();
  const bool empty = m_panes->count() == 0;
  m_empty->setVisible(empty);
  m_scroll->setVisible(!empty);
  m_ruler->setVisible(overTime);
  // Beneath an XY plot the clock would be taken for its axis; then it stands above all plots.
  const bool isAbove = !panes().isEmpty() && !panes().last()->isOverTime();
  auto* column = static_cast<QVBoxLayout*>(m_stack->layout());
  if (isAbove != (column->indexOf(m_ruler) < column->indexOf(m_scroll))) {
    column->removeWidget(m_ruler);
    column->insertWidget(isAbove ? column->indexOf(m_scroll) : -1, m_ruler);
  }
  m_aligning = false;
  placeLines();
  m_ruler->update();
  m_heads->update();
}

// In little room the curves go first. Lanes come back when the page is dragged higher.
void PlotPage::showLanesWhereTheyFit() {
  const QList<PlotPane*> all = panes();
  int charts = 0, lanes = 0;
  for (const PlotPane* pane : all) {
    const int least = std::max(pane->minimumHeight(), pane->minimumSizeHint().height());
    (pane->kind() == PaneKind::Lane ? lanes : charts) += least;
  }
  const bool fit =
      charts == 0 || m_stack->height() - m_ruler->height() - m_heads->height() >= charts + lanes;
  for (PlotPane* pane : all) {
    if (pane->kind() == PaneKind::Lane) pane->setVisible(fit);
  }
}

// A splitter does not take back what a plot of fixed height cannot use.
void PlotPage::giveLanesTheirHeight() {
  QList<int> sizes = m_panes->sizes();
  const QList<PlotPane*> all = panes();
  bool wrong = false;
  int freed = 0, charts = 0;
  for (qsizetype i = 0; i < all.size(); ++i) {
    if (all[i]->isHidden()) continue;
    if (all[i]->kind() != PaneKind::Lane) {
      ++charts;
      continue;
    }
    wrong = wrong || sizes[i] != all[i]->maximumHeight();
    freed += sizes[i] - all[i]->maximumHeight();
    sizes[i] = all[i]->maximumHeight();
  }
  if (!wrong || charts == 0) return;
  for (qsizetype i = 0; i < all.size(); ++i) {
    if (all[i]->kind() != PaneKind::Lane) sizes[i] = qMax(1, sizes[i] + freed / charts);
  }
  m_panes->setSizes(sizes);
}

TimeAxis PlotPage::timeAxis() const {
  const int right = qMax(m_scroll->viewport()->width() - m_right, m_left + 1);
  return {m_feed->time()->range(), static_cast<double>(m_left),
          static_cast<double>(right - m_left)};
}

TimeAxis PlotPage::pictureAxis() const {
  TimeAxis axis = timeAxis();
  axis.left += m_scroll->geometry().left();
  return axis;
}

void PlotPage::placeLines() {
  const bool hinting = m_lines->hint().has_value();
  m_lines->setGeometry(hinting ? m_stack->rect() : m_scroll->geometry());
  QList<QRect> plots;
  for (PlotPane* pane : panes()) {
    if (!pane->isOverTime()) continue;
    const QWidget* surface = pane->surface();
    const QPoint at = surface->mapTo(m_stack, QPoint()) - m_lines->pos();
    for (const QRect& area : pane->lineAreas()) plots << area.translated(at);
  }
  m_lines->setPlots(plots);
  m_lines->raise();
  showPointed();
}

bool PlotPage::eventFilter(QObject* watched, QEvent* event) {
  if (watched == m_stack &&
      (event->type() == QEvent::Resize || event->type() == QEvent::LayoutRequest)) {
    if (event->type() == QEvent::Resize) showLanesWhereTheyFit();
    placeLines();
  }
  return QWidget::eventFilter(watched, event);
}

void PlotPage::setBoxTool(bool on) {
  m_boxTool = on;
  for (PlotPane* pane : panes()) pane->setBoxTool(on);
}

bool PlotPage::isWorking() const {
  for (const PlotPane* pane : panes()) {
    for (const Curve& curve : pane->curves()) {
      if (curve.isWorking()) return true;
    }
  }
  return false;
}

void PlotPage::refresh() {
  for (PlotPane* pane : panes()) pane->refresh();
  showMarks();
  m_ruler->update();
  giveLanesTheirHeight();
  placeLines();
  m_lines->follow();
}

namespace {
constexpr int edge = 14;  // a drop this close to an edge makes a plot of its own
}  // namespace

PlotPage::Target PlotPage::targetAt(const QPoint& position, qsizetype count) const {
  const QPoint at = m_stack->mapFrom(this, position);
  const int reach = scaled(this, edge);
  Target target;
  target.index = m_panes->count();
  const QList<PlotPane*> all = panes();
  for (qsizetype i = 0; i < all.size(); ++i) {
    const QRect area(all[i]->mapTo(m_stack, QPoint()), all[i]->size());
    if (at.y() < area.top() + reach && at.y() >= area.top() - reach) {
      target.index = static_cast<int>(i);
      target.area = QRect(area.left(), area.top() - reach / 2, area.width(), reach);
      return target;
    }
    if (area.contains(at) && at.y() < area.bottom() - reach) {
      return {Place::OnPane, all[i], static_cast<int>(i), area};
    }
  }
  // Below the last plot, or on an empty page.
  target.area = all.isEmpty()
                    ? m_stack->rect()
                    : QRect(0, m_stack->height() - 2 * reach, m_stack->width(), 2 * reach);
  const int third = m_stack->width() / 3;
  if (count == 2 && at.x() > m_stack->width() - third) {
    target.place = Place::NewXy;
    target.area.setLeft(m_stack->width() - third);
  }
  return target;
}

void PlotPage::drop(const QStringList& names, const QPoint& position) {
  if (names.isEmpty()) return;
  const Target target = targetAt(position, names.size());
  if (target.place == Place::NewXy) {
    PaneSpec xy;
    xy.kind = PaneKind::Xy;
    xy.curves << variableCurve(names[0]);
    xy.curves[0].inputs << names[1];
    // A path on the field is one only when a metre is a metre in both directions.
    const ColumnView x = m_feed->find(names[0]), y = m_feed->find(names[1]);
    xy.equalScales = x && y && !x.info().unit.empty() && x.info().unit == y.info().unit;
    insertPane(m_panes->count(), xy);
    return;
  }
  if (target.place == Place::OnPane)
    place(pointOut(names, {target.pane}), {target.pane}, target.index + 1);
  else
    place(names, {}, target.index);
}

void PlotPage::dragEnterEvent(QDragEnterEvent* event) {
  if (!draggedVariables(event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void PlotPage::dragMoveEvent(QDragMoveEvent* event) {
  const QStringList names = draggedVariables(event->mimeData());
  if (names.isEmpty()) return;
  event->acceptProposedAction();
  const Target target = targetAt(event->position().toPoint(), names.size());
  const bool isThere =
      target.place == Place::OnPane && std::ranges::all_of(names, [&target](const QString& name) {
        return target.pane->hasCurve(variableCurve(name));
      });
  const QString label = isThere                         ? QStringLiteral("already in this plot")
                        : target.place == Place::OnPane ? QStringLiteral("add to this plot")
                        : target.place == Place::NewXy  ? QStringLiteral("XY plot")
                                                        : QStringLiteral("new plot");
  m_lines->setHint(DropHint{target.area, label});
}

void PlotPage::dragLeaveEvent(QDragLeaveEvent*) {
  m_lines->setHint({});
}

void PlotPage::dropEvent(QDropEvent* event) {
  m_lines->setHint({});
  const QStringList names = draggedVariables(event->mimeData());
  if (names.isEmpty()) return;
  event->acceptProposedAction();
  drop(names, event->position().toPoint());
}

}  // namespace pitchboard::ui
