// SPDX-License-Identifier: GPL-3.0-or-later
#include "marks_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QStyledItemDelegate>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include <ui/base/elide_text.h>
#include <ui/base/table_style.h>
#include <ui/base/theme.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/shown_moment.h>

#include "marks_model.h"
#include "plot_pane.h"

namespace pitchboard::ui {
namespace {
constexpr int maxEventsNamed = 3;
constexpr int nameWidth = 188, narrowestName = 100, numberWidth = 48;  // px of the mock
constexpr int widestText = 124;

QString spanText(bool whole) {
  return whole ? QStringLiteral("Whole session") : QStringLiteral("Between A and B");
}

// Robot and unit stand at the end of a name.
class MarksDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    if (!option->rect.isValid()) return;
    constexpr int margin = 4;
    const auto elide = index.column() == MarksModel::Name ? elideName : elideText;
    option->text =
        elide(QFontMetricsF(option->font), option->text, option->rect.width() - 2 * margin);
  }
};
}  // namespace

QString eventsBetween(const std::deque<link::MatchEvent>& events, double a, double b,
                      const PlotFeed& feed) {
  if (a > b) std::swap(a, b);
  const auto first =
      std::lower_bound(events.begin(), events.end(), a,
                       [](const link::MatchEvent& e, double t) { return e.time < t; });
  const auto last = std::upper_bound(
      first, events.end(), b, [](double t, const link::MatchEvent& e) { return t < e.time; });
  QStringList named;
  std::ptrdiff_t marked = 0;
  for (auto event = first; event != last; ++event) {
    if (!link::isMarked(*event) || ++marked > maxEventsNamed) continue;
    named << QStringLiteral("%1 at %2")
                 .arg(QString::fromStdString(sentenceOf(*event)), feed.timeText(event->time, 2));
  }
  if (marked == 0) return {};
  const auto more = marked - named.size();
  const QString all = named.join(QStringLiteral(", "));
  return more > 0 ? QStringLiteral("Between A and B: %1 and %2 more.").arg(all).arg(more)
                  : QStringLiteral("Between A and B: %1.").arg(all);
}

MarksPanel::MarksPanel(PlotFeed* feed, QWidget* parent)
    : QWidget(parent),
      m_feed(feed),
      m_model(new MarksModel(this)),
      m_span(new QToolButton(this)),
      m_times(new QLabel(this)),
      m_difference(new QLabel(this)),
      m_table(new QTableView(this)),
      m_events(new QLabel(this)) {
  setObjectName(QStringLiteral("marksPanel"));
  setBackgroundRole(QPalette::Base);
  setAutoFillBackground(true);
  m_table->setModel(m_model);
  m_table->setObjectName(QStringLiteral("marksTable"));
  styleTable(m_table);
  m_table->setAlternatingRowColors(false);
  m_table->setItemDelegate(new MarksDelegate(m_table));
  m_table->setIconSize(QSize(scaled(this, 8), scaled(this, 8)));
  m_table->horizontalHeader()->setStretchLastSection(false);
  m_table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  m_table->horizontalHeader()->setMinimumSectionSize(scaled(this, 30));
  forgetTextWidths();
  m_times->setTextFormat(Qt::RichText);
  m_difference->setFont(themeFont(TypeRole::Secondary, true));
  m_difference->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  m_times->setFont(themeFont(TypeRole::Secondary));
  m_events->setFont(themeFont(TypeRole::Secondary));
  m_events->setForegroundRole(QPalette::PlaceholderText);
  m_events->setWordWrap(true);
  m_events->setObjectName(QStringLiteral("eventsBetween"));
  const int gap = scaled(this, 8);
  m_events->setContentsMargins(gap, gap / 2, gap, gap);
  auto* head = new QHBoxLayout;
  head->setContentsMargins(gap, scaled(this, 4), gap, scaled(this, 2));
  head->addWidget(m_times, 1);
  head->addWidget(m_span);
  m_span->setObjectName(QStringLiteral("statisticsSpan"));
  m_span->setToolTip(QStringLiteral("Range for mean, σ, min, max and RMS"));
  m_span->setFont(themeFont(TypeRole::Secondary));
  m_span->setAutoRaise(true);
  m_span->setPopupMode(QToolButton::InstantPopup);
  auto* spans = new QMenu(m_span);
  for (const bool whole : {false, true}) {
    spans->addAction(spanText(whole), this, [this, whole] { setWhole(whole); });
  }
  m_span->setMenu(spans);
  m_span->setText(spanText(false));
  head->addWidget(m_difference);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head);
  column->addWidget(m_table, 1);
  column->addWidget(m_events);
  auto* copy = new QAction(QStringLiteral("Copy table"), this);
  copy->setShortcut(QKeySequence::Copy);
  copy->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  connect(copy, &QAction::triggered, this, &MarksPanel::copyTable);
  m_table->addAction(copy);
  m_table->setContextMenuPolicy(Qt::ActionsContextMenu);
  hide();
}

// All columns side by side.
QSize MarksPanel::sizeHint() const {
  int width =
      std::clamp(cellWidth(MarksModel::Name), scaled(this, narrowestName), scaled(this, nameWidth));
  for (int column = MarksModel::AtA; column < MarksModel::columns; ++column) {
    width += m_table->columnWidth(column);
  }
  return {width + 2 * m_table->frameWidth(), scaled(this, 120)};
}

int MarksPanel::cellWidth(int column) const {
  QStyleOptionViewItem option;
  option.initFrom(m_table);
  option.widget = m_table;
  int widest = 0;
  for (int row = 0; row < m_model->rowCount(); ++row) {
    const QModelIndex cell = m_model->index(row, column);
    const int wide = m_table->itemDelegate()->sizeHint(option, cell).width();
    const QString text = cell.data().toString();
    const bool isLabel = column != MarksModel::Name && !text.isEmpty() && text.front().isLetter();
    widest = std::max(widest, isLabel ? std::min(wide, scaled(this, widestText)) : wide);
  }
  return widest;
}

void MarksPanel::forgetTextWidths() {
  for (int c = MarksModel::AtA; c < MarksModel::columns; ++c) {
    m_table->setColumnWidth(c, scaled(this, numberWidth));
  }
}

// Numbers have all the room that they need, labels of codes less. Columns do not become narrower
// again while a mark is dragged.
void MarksPanel::fitTextColumns() {
  for (int column = MarksModel::AtA; column < MarksModel::columns; ++column) {
    const int wanted = std::max(m_table->columnWidth(column), cellWidth(column));
    if (wanted != m_table->columnWidth(column)) m_table->setColumnWidth(column, wanted);
  }
  fitNameColumn();
}

// Names have what the numbers leave, and never so little that curves cannot be told apart: then the
// table scrolls.
void MarksPanel::fitNameColumn() {
  int room = m_table->viewport()->width();
  for (int column = MarksModel::AtA; column < MarksModel::columns; ++column) {
    room -= m_table->columnWidth(column);
  }
  m_table->setColumnWidth(MarksModel::Name, std::max(room, scaled(this, narrowestName)));
}

void MarksPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  fitNameColumn();
}

void MarksPanel::setWhole(bool on) {
  m_whole = on;
  m_span->setText(spanText(on));
  QList<PlotPane*> panes;
  for (const auto& pane : std::as_const(m_panes)) {
    if (pane) panes << pane;
  }
  refresh(panes);
}

void MarksPanel::copyTable() const {
  QApplication::clipboard()->setText(m_model->text());
}

void MarksPanel::refresh(const QList<PlotPane*>& panes) {
  const LinkedTime* time = m_feed->time();
  const ShownMoment& shown = *time->shown();
  if (isHidden()) forgetTextWidths();
  setVisible(shown.hasMarks());
  m_panes.clear();
  for (PlotPane* pane : panes) m_panes << pane;
  if (!shown.hasMarks()) return;
  const double a = *shown.mark(TimeMark::A);
  const double b = *shown.mark(TimeMark::B);
  m_times->setText(QStringLiteral("<b>A</b> %1 &nbsp;&nbsp; <b>B</b> %2")
                       .arg(m_feed->timeText(a, 3), m_feed->timeText(b, 3)));
  m_difference->setText(QStringLiteral("Δt %1 s").arg(
      QString::number(b - a, 'f', 3).replace(QLatin1Char('-'), QStringLiteral("\u2212"))));
  QList<MarksRow> rows;
  for (const PlotPane* pane : panes) {
    if (!pane->isOverTime()) continue;
    for (const Curve& curve : pane->curves()) {
      if (curve.isHidden()) continue;
      rows << marksRow(curve, a, b, m_whole ? time->data() : std::nullopt);
      for (const ComparedRows& session : m_feed->compared()) {
        if (auto row = marksRow(curve, session, a, b, m_whole)) rows << *row;
      }
    }
  }
  m_model->setRows(std::move(rows));
  fitTextColumns();
  m_events->setText(eventsBetween(shown.events()->events(), a, b, *m_feed));
}

}  // namespace pitchboard::ui
