// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/log/log_dock.h>

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QLabel>
#include <QLineEdit>
#include <QScrollBar>
#include <QToolButton>
#include <QVBoxLayout>

#include <ui/base/robot_words.h>
#include <ui/base/table_style.h>
#include <ui/base/words_filter.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/source_switch.h>

#include "log_model.h"

namespace pitchboard::ui {
namespace {

class LogDock : public QWidget {
 public:
  LogDock(MatchController* controller, const SourceSwitch* shown, QWidget* parent)
      : QWidget(parent),
        m_controller(controller),
        m_model(new LogModel(this)),
        m_filter(new WordsFilter(this)),
        m_table(new QTableView(this)),
        m_empty(makeEmptyLabel(this, QStringLiteral("emptyLog"))) {
    m_model->setObjectName(QStringLiteral("logModel"));
    m_filter->setSourceModel(m_model);
    m_table->setModel(m_filter);
    m_table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    styleTable(m_table);
    m_table->setColumnWidth(LogModel::Time, scaled(this, 80));
    m_table->setColumnWidth(LogModel::Origin, scaled(this, 160));

    auto* words = new QLineEdit(this);
    words->setObjectName(QStringLiteral("logFilter"));
    words->setPlaceholderText(QStringLiteral("Filter by words, e.g. B1 goal"));
    words->setClearButtonEnabled(true);
    words->addAction(themedIcon(QStringLiteral("view-filter")), QLineEdit::LeadingPosition);
    connect(words, &QLineEdit::textChanged, m_filter, &WordsFilter::setWords);
    auto* clear = new QToolButton(this);
    clear->setIcon(themedIcon(QStringLiteral("edit-clear-all")));
    clear->setToolTip(QStringLiteral("Clear the log"));
    connect(clear, &QToolButton::clicked, m_model, &LogModel::clear);

    auto* row = new QHBoxLayout;
    const int gap = scaled(this, 4);
    row->setContentsMargins(gap, gap, gap, gap);
    row->setSpacing(gap);
    row->addWidget(words, 1);
    row->addWidget(clear);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(row);
    column->addWidget(m_table, 1);
    column->addWidget(m_empty, 1);
    for (const auto changed :
         {&QAbstractItemModel::rowsInserted, &QAbstractItemModel::rowsRemoved}) {
      connect(m_filter, changed, this, &LogDock::showEmpty);
    }
    connect(m_filter, &QAbstractItemModel::modelReset, this, &LogDock::showEmpty);
    showEmpty();

    auto* copy = new QAction(QStringLiteral("Copy"), this);
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    connect(copy, &QAction::triggered, this, [this] { copySelection(); });
    m_table->addAction(copy);
    m_table->setContextMenuPolicy(Qt::ActionsContextMenu);

    // Simulated and live lines stand in one log: both go on while the other is looked at.
    for (FrameSource* source : shown->sources()) {
      connect(
          source, &FrameSource::logReceived, this,
          [this, source](const std::vector<LogLine>& lines) { append(lines, source->clock()); });
      connect(source, &FrameSource::eventsReceived, this,
              [this, source](const std::vector<link::MatchEvent>& events) {
                appendEvents(events, source->clock());
              });
    }
    m_model->setTimesOfDay(shown->timesOfDay());
    connect(shown, &SourceSwitch::timesOfDayChanged, m_model, &LogModel::setTimesOfDay);
    connect(m_controller, &MatchController::errorOccurred, this, [this](const QString& sentence) {
      const FramePtr frame = m_controller->frame();
      append({{frame ? frame->snapshot.time : 0.0, "studio", sentence.toStdString(),
               LogLevel::Warning}});
    });
  }

 private:
  void showEmpty() {
    const bool empty = m_filter->rowCount() == 0;
    m_table->setVisible(!empty);
    m_empty->setVisible(empty);
    m_empty->setText(
        m_model->rowCount() > 0
            ? QStringLiteral("No line has all of these words.")
            : QStringLiteral("Nothing yet. Kicks, goals, falls, errors and what the robots' "
                             "processes print appear here."));
  }

  void append(const std::vector<LogLine>& lines, const std::optional<QDateTime>& clock = {}) {
    const QScrollBar* bar = m_table->verticalScrollBar();
    const bool follows = bar->value() >= bar->maximum();
    m_model->append(lines, clock);
    if (follows) m_table->scrollToBottom();
  }

  void appendEvents(const std::vector<link::MatchEvent>& events,
                    const std::optional<QDateTime>& clock) {
    std::vector<LogLine> lines;
    for (const link::MatchEvent& event : events) lines.push_back(logLineOf(event));
    append(lines, clock);
  }

  void copySelection() {
    QStringList text;
    for (const QModelIndex& row : m_table->selectionModel()->selectedRows()) {
      QStringList cells;
      for (int c = 0; c < LogModel::columns; ++c) {
        cells << row.siblingAtColumn(c).data().toString();
      }
      text << cells.join(QLatin1Char('\t'));
    }
    if (!text.isEmpty()) QApplication::clipboard()->setText(text.join(QLatin1Char('\n')));
  }

  MatchController* m_controller;
  LogModel* m_model;
  WordsFilter* m_filter;
  QTableView* m_table;
  QLabel* m_empty;
};

}  // namespace

QWidget* makeLogDock(MatchController* controller, const SourceSwitch* source, QWidget* parent) {
  return new LogDock(controller, source, parent);
}

}  // namespace pitchboard::ui
