// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/log/log_dock.h>

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QScrollBar>
#include <QTime>
#include <QToolButton>
#include <QVBoxLayout>

#include <base/file_target.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/source_switch.h>
#include <ui/sources/timeline.h>

#include "log_model.h"

namespace pitchboard::ui {
namespace {

class LogDock : public QWidget {
 public:
  LogDock(MatchController* controller, const SourceSwitch* shown, Timeline* timeline,
          QWidget* parent)
      : QWidget(parent),
        m_controller(controller),
        m_source(shown),
        m_timeline(timeline),
        m_model(new LogModel(this)),
        m_filter(new LogFilter(this)),
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
    connect(words, &QLineEdit::textChanged, m_filter, &TextFilter::setFilterText);
    auto* level = new QComboBox(this);
    level->setObjectName(QStringLiteral("logLevel"));
    level->addItem(QStringLiteral("All lines"), static_cast<int>(LogLevel::Info));
    level->addItem(QStringLiteral("Warnings and errors"), static_cast<int>(LogLevel::Warning));
    level->addItem(QStringLiteral("Errors"), static_cast<int>(LogLevel::Error));
    connect(level, &QComboBox::currentIndexChanged, this, [this, level] {
      m_filter->setLeast(static_cast<LogLevel>(level->currentData().toInt()));
    });
    m_start->setObjectName(QStringLiteral("logStartLines"));
    m_start->setCheckable(true);
    m_start->setToolTip(QStringLiteral("Show start-up output of processes"));
    connect(m_start, &QToolButton::toggled, this,
            [this](bool on) { m_filter->showStartLines(on); });
    m_follow->setObjectName(QStringLiteral("logFollow"));
    m_follow->setText(QStringLiteral("Follow"));
    m_follow->setCheckable(true);
    m_follow->setChecked(true);
    m_follow->setToolTip(QStringLiteral("Keep the newest line in view"));
    connect(m_follow, &QToolButton::toggled, this, [this](bool on) {
      if (on) m_table->scrollToBottom();
    });
    auto* save = new QToolButton(this);
    save->setIcon(themedIcon(QStringLiteral("document-save-as")));
    save->setToolTip(QStringLiteral("Save the lines shown…"));
    connect(save, &QToolButton::clicked, this, [this] { askAndSave(); });
    auto* clear = new QToolButton(this);
    clear->setIcon(themedIcon(QStringLiteral("edit-clear-all")));
    clear->setToolTip(QStringLiteral("Clear the log"));
    connect(clear, &QToolButton::clicked, m_model, &LogModel::clear);

    auto* row = new QHBoxLayout;
    const int gap = scaled(this, 4);
    row->setContentsMargins(gap, gap, gap, gap);
    row->setSpacing(gap);
    row->addWidget(words, 1);
    row->addWidget(level);
    row->addWidget(m_start);
    row->addWidget(m_follow);
    row->addWidget(save);
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
    m_start->hide();
    connect(m_table, &QTableView::clicked, this, [this](const QModelIndex& index) {
      // With a key lines are chosen, to be copied.
      if (QApplication::keyboardModifiers() == Qt::NoModifier) goTo(index);
    });
    connect(m_table, &QTableView::activated, this, &LogDock::goTo);
    for (const auto moved : {&Timeline::moved, &Timeline::sourceChanged}) {
      connect(timeline, moved, this, &LogDock::showMoment);
    }
    connect(timeline, &Timeline::lookingBackChanged, this, &LogDock::showMoment);
    // Who scrolls up wants to read there; who comes back to the end wants to see what is new.
    connect(m_table->verticalScrollBar(), &QAbstractSlider::actionTriggered, this, [this] {
      const QScrollBar* bar = m_table->verticalScrollBar();
      m_follow->setChecked(bar->sliderPosition() >= bar->maximum());
    });

    auto* copy = new QAction(QStringLiteral("Copy"), this);
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    connect(copy, &QAction::triggered, this, [this] { copySelection(); });
    m_table->addAction(copy);
    m_table->setContextMenuPolicy(Qt::ActionsContextMenu);

    // Simulated and live lines stand in one log: both go on while the other is looked at.
    for (FrameSource* source : shown->sources()) {
      connect(source, &FrameSource::logReceived, this,
              [this, source](const std::vector<LogLine>& lines) {
                append(lines, source->clock(), source->kind());
              });
      connect(source, &FrameSource::eventsReceived, this,
              [this, source](const std::vector<link::MatchEvent>& events) {
                appendEvents(events, source->clock(), source->kind());
              });
      connect(source, &FrameSource::restarted, this, [this, source] {
        if (source->kind() != SourceKind::Simulate) return;
        m_model->divide(source->kind(),
                        QStringLiteral("%1 started, %2")
                            .arg(QString::fromStdString(m_controller->scenario().title),
                                 QTime::currentTime().toString(QStringLiteral("HH:mm"))));
      });
      connect(source, &FrameSource::rewound, this, [this, source](double time) {
        m_model->rewind(source->kind(), time);
        showStartLines();
      });
    }
    m_model->setTimesOfDay(shown->timesOfDay());
    connect(shown, &SourceSwitch::timesOfDayChanged, m_model, &LogModel::setTimesOfDay);
    connect(m_controller, &MatchController::errorOccurred, this, [this](const QString& sentence) {
      const FramePtr frame = m_controller->frame();
      append({{frame ? frame->snapshot.time : 0.0, "studio", sentence.toStdString(),
               LogLevel::Warning}},
             {}, SourceKind::Simulate);
    });
  }

 private:
  void showEmpty() {
    const bool empty = m_filter->rowCount() == 0;
    m_table->setVisible(!empty);
    m_empty->setVisible(empty);
    m_empty->setText(
        m_model->rowCount() > m_model->startLines()
            ? QStringLiteral("No matching log entries")
            : QStringLiteral("Nothing yet. Kicks, goals, falls, errors and what the robots' "
                             "processes print appear here."));
  }

  void goTo(const QModelIndex& index) {
    const QModelIndex row = index.siblingAtColumn(0);
    if (row.data(LogModel::shownRole).toBool())
      m_timeline->seek(row.data(LogModel::timeRole).toDouble());
  }

  bool isPast() const { return m_timeline->isLookingBack() || m_timeline->isRecording(); }

  void showMoment() {
    if (!isPast() && !m_wasPast) return;
    m_wasPast = isPast();
    m_model->setMoment(m_source->kind(),
                       isPast() ? std::optional(m_timeline->shownTime()) : std::nullopt);
    scroll();
  }

  void scroll() {
    // Who clicks on a line has it in sight.
    if (!m_follow->isChecked() || m_table->underMouse()) return;
    if (!isPast()) {
      m_table->scrollToBottom();
      return;
    }
    int row = m_model->rowAtMoment();
    QModelIndex shown;
    while (row >= 0 && !shown.isValid()) shown = m_filter->mapFromSource(m_model->index(row--, 0));
    if (shown.isValid()) m_table->scrollTo(shown);
  }

  void showStartLines() {
    m_start->setText(QStringLiteral("Start-up lines: %1").arg(m_model->startLines()));
    m_start->setVisible(m_model->startLines() > 0);
  }

  void append(const std::vector<LogLine>& lines, const std::optional<QDateTime>& clock = {},
              std::optional<SourceKind> of = {}, bool events = false) {
    m_model->append(lines, clock, of, events);
    showStartLines();
    if (!isPast() && m_follow->isChecked()) m_table->scrollToBottom();
  }

  void appendEvents(const std::vector<link::MatchEvent>& events,
                    const std::optional<QDateTime>& clock, SourceKind of) {
    std::vector<LogLine> lines;
    for (const link::MatchEvent& event : events) {
      if (event.kind == link::MatchEventKind::Undone) {
        append(std::exchange(lines, {}), clock, of);
        m_model->strike(of, event.cause);
        continue;
      }
      lines.push_back(logLineOf(event));
      if (event.kind == link::MatchEventKind::ProcessStarted) lines.back().level = LogLevel::Debug;
    }
    append(lines, clock, of, true);
  }

  static QString textOf(const QModelIndex& row) {
    QStringList cells;
    for (int c = 0; c < LogModel::columns; ++c) cells << row.siblingAtColumn(c).data().toString();
    return cells.join(QLatin1Char('\t'));
  }

  void copySelection() {
    QStringList text;
    for (const QModelIndex& row : m_table->selectionModel()->selectedRows()) text << textOf(row);
    if (!text.isEmpty()) QApplication::clipboard()->setText(text.join(QLatin1Char('\n')));
  }

  void askAndSave() {
    const QString path = QFileDialog::getSaveFileName(this, QStringLiteral("Save the log"),
                                                      QStringLiteral("log.txt"),
                                                      QStringLiteral("Text files (*.txt)"));
    if (path.isEmpty()) return;
    QByteArray text;
    for (int row = 0; row < m_filter->rowCount(); ++row) {
      text += textOf(m_filter->index(row, 0)).toUtf8() + '\n';
    }
    const auto written =
        writeFile(path.toStdString(), {text.constData(), static_cast<std::size_t>(text.size())},
                  IfExists::Replace);
    if (written) return;
    QMessageBox::warning(this, QStringLiteral("Save the log"),
                         QString::fromStdString(written.error().text()));
  }

  MatchController* m_controller;
  const SourceSwitch* m_source;
  Timeline* m_timeline;
  bool m_wasPast = false;
  LogModel* m_model;
  LogFilter* m_filter;
  QTableView* m_table;
  QLabel* m_empty;
  QToolButton* m_start = new QToolButton(this);
  QToolButton* m_follow = new QToolButton(this);
};

}  // namespace

QWidget* makeLogDock(MatchController* controller, const SourceSwitch* source, Timeline* timeline,
                     QWidget* parent) {
  return new LogDock(controller, source, timeline, parent);
}

}  // namespace pitchboard::ui
