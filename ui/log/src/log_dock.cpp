// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/log/log_dock.h>

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QScrollBar>
#include <QTime>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>
#include <limits>

#include <base/file_target.h>
#include <ui/base/file_dialog.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/shown_moment.h>

#include "log_model.h"

namespace pitchboard::ui {
namespace {

class LogDock : public QWidget {
 public:
  LogDock(MatchController* controller, ShownMoment* shown, QWidget* parent)
      : QWidget(parent),
        m_controller(controller),
        m_shown(shown),
        m_model(new LogModel(this)),
        m_filter(new LogFilter(this)),
        m_table(new QTableView(this)),
        m_empty(makeEmptyLabel(this, QStringLiteral("emptyLog"))) {
    m_model->setObjectName(QStringLiteral("logModel"));
    m_filter->setSourceModel(m_model);
    m_table->setModel(m_filter);
    m_table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    styleTable(m_table);
    // A time of day in Live, an hour and more in a long session.
    const QFontMetricsF digits(m_table->font());
    m_table->setColumnWidth(
        LogModel::Time,
        static_cast<int>(std::ceil(digits.horizontalAdvance(QStringLiteral("88:88:88.888")))) +
            scaled(this, 16));
    m_table->setColumnWidth(LogModel::Origin, scaled(this, 160));

    auto* words = new QLineEdit(this);
    words->setObjectName(QStringLiteral("logFilter"));
    words->setPlaceholderText(QStringLiteral("Filter by words, e.g. B1 goal"));
    words->setClearButtonEnabled(true);
    words->addAction(themedIcon(QStringLiteral("view-filter")), QLineEdit::LeadingPosition);
    connect(words, &QLineEdit::textChanged, this, [this](const QString& text) {
      refilter([this, &text] { m_filter->setFilterText(text); });
    });
    auto* level = new QComboBox(this);
    level->setObjectName(QStringLiteral("logLevel"));
    level->addItem(QStringLiteral("All lines"), static_cast<int>(LogLevel::Info));
    level->addItem(QStringLiteral("Warnings and errors"), static_cast<int>(LogLevel::Warning));
    level->addItem(QStringLiteral("Errors"), static_cast<int>(LogLevel::Error));
    connect(level, &QComboBox::currentIndexChanged, this, [this, level] {
      refilter([&] { m_filter->setLeast(static_cast<LogLevel>(level->currentData().toInt())); });
    });
    m_start->setObjectName(QStringLiteral("logStartLines"));
    m_start->setCheckable(true);
    m_start->setToolTip(QStringLiteral("Show start-up output of processes"));
    connect(m_start, &QToolButton::toggled, this,
            [this](bool on) { refilter([this, on] { m_filter->showStartLines(on); }); });
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
    connect(m_filter, &QAbstractItemModel::layoutChanged, this, &LogDock::showEmpty);
    showEmpty();
    m_start->hide();
    connect(m_table, &QTableView::clicked, this, [this](const QModelIndex& index) {
      // With a key lines are chosen, to be copied.
      if (QApplication::keyboardModifiers() == Qt::NoModifier) goTo(index);
    });
    connect(m_table, &QTableView::activated, this, &LogDock::goTo);
    for (const auto moved : {&ShownMoment::moved, &ShownMoment::sourceChanged}) {
      connect(shown, moved, this, &LogDock::showMoment);
    }
    connect(shown, &ShownMoment::lookingBackChanged, this, &LogDock::showMoment);
    // Scrolling up stops following, and scrolling back to the end follows again.
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
                append(lines, source->clock(), &source->kind());
              });
      connect(source, &FrameSource::eventsReceived, this,
              [this, source](const std::vector<link::MatchEvent>& events) {
                appendEvents(events, source->clock(), source->kind());
              });
      connect(source, &FrameSource::restarted, this, [this, source] {
        // Another session has lines of its own.
        if (!source->kind().hasPresent) {
          m_model->rewind(source->kind(), -std::numeric_limits<double>::infinity());
          showStartLines();
        }
        if (source != m_controller) return;
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
    connect(shown, &ShownMoment::sourceChosen, this,
            [this] { m_filter->showRecorded(!m_shown->kind().hasPresent); });
    connect(shown, &ShownMoment::sourceChosen, this,
            [this] { m_model->setMoment(m_shown->kind(), m_shown->chosenTime()); });
    m_model->setTimesOfDay(shown->timesOfDay());
    connect(shown, &ShownMoment::timesOfDayChanged, m_model, &LogModel::setTimesOfDay);
    connect(m_controller, &MatchController::errorOccurred, this, [this](const QString& sentence) {
      const FramePtr frame = m_controller->frame();
      append({{frame ? frame->snapshot.time : 0.0, "studio", sentence.toStdString(),
               LogLevel::Warning}},
             {}, &m_controller->kind());
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
      m_shown->seek(row.data(LogModel::timeRole).toDouble());
  }

  bool isPast() const { return m_shown->chosenTime().has_value(); }

  void showMoment() {
    if (!isPast() && !m_wasPast) return;
    m_wasPast = isPast();
    m_model->setMoment(m_shown->kind(), m_shown->chosenTime());
    scroll();
  }

  /// Changes the filter and keeps the place: the moment shown or the end while the list follows,
  /// else the line at the top.
  template <class Change>
  void refilter(Change change) {
    const QScrollBar* bar = m_table->verticalScrollBar();
    // A short list cannot show every place at its top: until somebody scrolls, the place stays.
    const bool stays = m_place.isValid() && bar->value() == m_placeAt;
    QPersistentModelIndex top = m_place;
    if (!stays) top = m_filter->mapToSource(m_filter->index(m_table->rowAt(0), 0));
    change();
    // The range of the scroll bar is that of the lines before until they are laid out.
    m_table->doItemsLayout();
    m_place = QModelIndex();
    if (m_follow->isChecked()) return scroll(true);
    int row = top.row();
    QModelIndex next;
    for (; row >= 0 && row < m_model->rowCount() && !next.isValid(); ++row) {
      next = m_filter->mapFromSource(m_model->index(row, 0));
    }
    if (next.isValid()) m_table->scrollTo(next, QAbstractItemView::PositionAtTop);
    m_place = top;
    m_placeAt = bar->value();
  }

  void scroll(bool always = false) {
    // A line that the user clicks is in sight already.
    if (!always && (!m_follow->isChecked() || m_table->underMouse())) return;
    if (!isPast()) {
      m_table->scrollToBottom();
      return;
    }
    int row = m_model->rowAtMoment();
    QModelIndex shown;
    while (row >= 0 && !shown.isValid()) shown = m_filter->mapFromSource(m_model->index(row--, 0));
    if (shown.isValid()) {
      m_table->scrollTo(shown);
    } else {
      m_table->scrollToTop();
    }
  }

  void showStartLines() {
    m_start->setText(QStringLiteral("Start-up lines: %1").arg(m_model->startLines()));
    m_start->setVisible(m_model->startLines() > 0);
  }

  void append(const std::vector<LogLine>& lines, const std::optional<QDateTime>& clock = {},
              const SourceKind* of = nullptr, bool events = false) {
    m_model->append(lines, clock, of, events);
    showStartLines();
    if (!isPast() && m_follow->isChecked()) m_table->scrollToBottom();
  }

  void appendEvents(const std::vector<link::MatchEvent>& events,
                    const std::optional<QDateTime>& clock, const SourceKind& of) {
    std::vector<LogLine> lines;
    for (const link::MatchEvent& event : events) {
      if (event.kind == link::MatchEventKind::Undone) {
        append(std::exchange(lines, {}), clock, &of);
        m_model->strike(of, event.cause);
        continue;
      }
      lines.push_back(logLineOf(event));
      if (event.kind == link::MatchEventKind::ProcessStarted) lines.back().level = LogLevel::Debug;
    }
    append(lines, clock, &of, true);
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
    QByteArray text;  // taken before the dialog, behind which lines come and go
    for (int row = 0; row < m_filter->rowCount(); ++row) {
      text += textOf(m_filter->index(row, 0)).toUtf8() + '\n';
    }
    const QString path = askToSave(this, QStringLiteral("Save the log"), QStringLiteral("log.txt"),
                                   QStringLiteral("Text files (*.txt)"));
    if (path.isEmpty()) return;
    const auto written =
        writeFile(path.toStdString(), {text.constData(), static_cast<std::size_t>(text.size())},
                  IfExists::Replace);
    if (written) return;
    QMessageBox::warning(this, QStringLiteral("Save the log"),
                         QString::fromStdString(written.error().text()));
  }

  MatchController* m_controller;
  ShownMoment* m_shown;
  bool m_wasPast = false;
  QPersistentModelIndex m_place;  ///< the line that a changed filter was to keep
  int m_placeAt = 0;              ///< where the table stood for it
  LogModel* m_model;
  LogFilter* m_filter;
  QTableView* m_table;
  QLabel* m_empty;
  QToolButton* m_start = new QToolButton(this);
  QToolButton* m_follow = new QToolButton(this);
};

}  // namespace

QWidget* makeLogDock(MatchController* controller, ShownMoment* shown, QWidget* parent) {
  return new LogDock(controller, shown, parent);
}

}  // namespace pitchboard::ui
