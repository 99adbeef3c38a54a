// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/statistics/statistics_dock.h>

#include <QAbstractItemView>
#include <QAction>
#include <QApplication>
#include <QCompleter>
#include <QDragEnterEvent>
#include <QElapsedTimer>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QSplitter>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <base/file_target.h>
#include <telemetry/expression/expression.h>
#include <ui/base/file_dialog.h>
#include <ui/base/in_place_message.h>
#include <ui/base/number_box.h>
#include <ui/base/table_style.h>
#include <ui/base/variable_names.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>

#include "field_map.h"
#include "line_details.h"
#include "robots_button.h"
#include "statistics_table.h"
#include "stretch_bar.h"

namespace pitchboard::ui {
namespace {

constexpr std::size_t histogramBins = 30;
constexpr int settleMilliseconds = 100;        // after a change, before it is described
constexpr int patienceMilliseconds = 400;      // before progress is shown
constexpr int leastMillisecondsBetween = 500;  // while rows come
constexpr double idleShare = 4.0;              // of the time that the last one took
const QString textsKey = QStringLiteral("statistics/variables");
const QString againstKey = QStringLiteral("statistics/against");
const QString conditionKey = QStringLiteral("statistics/while");

/// The names that expressions may have: of each robot without a group, and of single groups.
QStringList namesOf(const telemetry::SeriesStore* rows) {
  QStringList single;
  std::set<QString> each;
  for (telemetry::GroupId group = 0; rows != nullptr && group < rows->groups(); ++group) {
    const auto view = rows->view(group);
    const telemetry::GroupInfo& info = view->info();
    for (const telemetry::ColumnInfo& column : info.columns) {
      if (column.kind == telemetry::ColumnKind::Text) continue;
      const QString name = QString::fromStdString(column.name);
      single << QString::fromStdString(info.name) + QLatin1Char('/') + name;
      if (info.robot) each.insert(name);
    }
  }
  QStringList all;
  for (const QString& name : each) {
    // In braces a name needs its group.
    all << (inExpression(name) == name ? name : QStringLiteral("each/") + name);
  }
  return all + single;
}

class StatisticsDock : public QWidget {
 public:
  StatisticsDock(const StatisticsDockParts& parts, QWidget* parent)
      : QWidget(parent),
        m_parts(parts),
        m_work(new StretchWork(this)),
        m_add(new QLineEdit(this)),
        m_robots(new RobotsButton(parts.shown, parts.selection, parts.compared, this)),
        m_against(new QLineEdit(this)),
        m_delay(new NumberBox(this)),
        m_save(new QPushButton(QStringLiteral("Save CSV…"), this)),
        m_stretch(new StretchBar(parts.shown, this)),
        m_state(new QLabel(this)),
        m_progress(new QProgressBar(this)),
        m_stop(new QPushButton(this)),
        m_message(new InPlaceMessage(this)),
        m_split(new QSplitter(Qt::Horizontal, this)),
        m_table(new StatisticsTable(parts.settings, m_split)),
        m_details(new LineDetails(m_split)),
        m_empty(makeEmptyLabel(this, QStringLiteral("emptyStatistics"))) {
    setAcceptDrops(true);
    makeTable();
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(makeQuestion());
    column->addLayout(makeStretch());
    column->addWidget(m_message);
    column->addWidget(m_split, 1);
    column->addWidget(m_empty, 1);
    m_message->clear();
    m_empty->setText(QStringLiteral(
        "Type a variable or an expression above, or drag variables here, to see means and how "
        "certain they are, extremes and states. This describes the selected range of the timeline, "
        "or everything if nothing is selected."));
    m_settle.setSingleShot(true);
    m_patience.setSingleShot(true);
    m_patience.setInterval(patienceMilliseconds);
    follow();
    restore();
    showState();
  }

 protected:
  void showEvent(QShowEvent* event) override {
    QWidget::showEvent(event);
    if (m_isStale) describeSoon(0);
  }
  void dragEnterEvent(QDragEnterEvent* event) override {
    if (!draggedVariables(event->mimeData()).isEmpty()) event->acceptProposedAction();
  }
  void dropEvent(QDropEvent* event) override {
    QStringList texts;
    for (const QString& name : draggedVariables(event->mimeData())) texts << inExpression(name);
    event->acceptProposedAction();
    addTexts(texts);
  }
  QSize sizeHint() const override { return {scaled(this, 900), scaled(this, 260)}; }

 private:
  void makeTable() {
    connect(m_table, &StatisticsTable::currentShown, this, [this] {
      m_details->show(m_table->current(), m_appliedAgainst, m_parts.shown->clock());
    });
    connect(m_table, &StatisticsTable::momentClicked, m_parts.shown, &ShownMoment::seek);
    connect(m_details, &LineDetails::momentClicked, m_parts.shown, &ShownMoment::seek);
    connect(m_details, &LineDetails::placeChanged, this, [this] { describeSoon(0); });
    const auto action = [this](const char* name, const char* text, auto slot) {
      auto* made = new QAction(QString::fromUtf8(text), m_table);
      made->setObjectName(QLatin1String(name));
      connect(made, &QAction::triggered, this, slot);
      m_table->addAction(made);
      return made;
    };
    QAction* copy = action("copyStatistics", "Copy", [this] { m_table->copySelection(); });
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    action("statisticsOfEachRobot", "Describe for every robot", [this] { describeEachRobot(); });
    action("removeStatistics", "Remove", [this] { removeSelection(); });
    m_table->setContextMenuPolicy(Qt::ActionsContextMenu);
    m_split->addWidget(m_table);
    m_split->addWidget(m_details);
    m_split->setStretchFactor(0, 1);
    m_split->setStretchFactor(1, 0);
    m_split->setChildrenCollapsible(false);
    m_details->setMinimumWidth(scaled(this, 220));
  }

  QHBoxLayout* makeQuestion() {
    m_add->setObjectName(QStringLiteral("addStatistics"));
    m_add->setAccessibleName(QStringLiteral("Variable or expression"));
    m_add->setPlaceholderText(QStringLiteral("Add a variable or expression"));
    m_add->setToolTip(QStringLiteral(
        "Describes a variable such as BELIEF_ERROR for every robot, B1.TRUE_X for one, or an "
        "expression such as VISION_BALL_DIST / 100. Press Enter to add it"));
    m_add->setMinimumWidth(scaled(this, 120));
    connect(m_add, &QLineEdit::returnPressed, this, &StatisticsDock::addTyped);
    auto* against = new QLabel(QStringLiteral("against"), this);
    m_against->setObjectName(QStringLiteral("statisticsAgainst"));
    m_against->setAccessibleName(QStringLiteral("Other curve"));
    m_against->setPlaceholderText(QStringLiteral("nothing; or e.g. BELIEF_X"));
    m_against->setToolTip(QStringLiteral(
        "Also the error against this variable or expression, the correlation with it, and its "
        "delay"));
    m_against->setClearButtonEnabled(true);
    m_against->setMinimumWidth(scaled(this, 100));
    connect(m_against, &QLineEdit::editingFinished, this, &StatisticsDock::applyAgainst);
    connect(m_against, &QLineEdit::textChanged, this, [this](const QString& text) {
      if (text.isEmpty()) applyAgainst();
    });
    m_delay->setObjectName(QStringLiteral("statisticsDelay"));
    m_delay->setAccessibleName(QStringLiteral("Largest delay"));
    m_delay->setRange(0.05, 60.0);
    m_delay->setValue(1.0);
    m_delay->setPrefix(QStringLiteral("± "));
    m_delay->setSuffix(QStringLiteral(" s"));
    m_delay->setToolTip(QStringLiteral("Largest delay that is tried"));
    connect(m_delay, &QDoubleSpinBox::valueChanged, this, [this] { describeSoon(); });
    m_save->setObjectName(QStringLiteral("saveStatistics"));
    connect(m_save, &QPushButton::clicked, this, [this] { askAndSave(); });
    auto* row = new QHBoxLayout;
    const int gap = scaled(this, 4);
    row->setContentsMargins(gap, gap, gap, 0);
    row->setSpacing(gap);
    row->addWidget(m_add, 3);
    row->addWidget(m_robots);
    row->addWidget(against);
    row->addWidget(m_against, 2);
    row->addWidget(m_delay);
    row->addWidget(m_save);
    return row;
  }

  QVBoxLayout* makeStretch() {
    m_state->setObjectName(QStringLiteral("statisticsState"));
    m_state->setFont(themeFont(TypeRole::Secondary));
    m_state->setForegroundRole(QPalette::PlaceholderText);
    m_state->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_progress->setObjectName(QStringLiteral("statisticsProgress"));
    m_progress->setRange(0, 100);
    m_progress->setTextVisible(false);
    m_progress->setFixedSize(scaled(this, 140), scaled(this, 8));
    m_stop->setObjectName(QStringLiteral("statisticsStop"));
    connect(m_stop, &QPushButton::clicked, this, [this] {
      if (m_work->isRunning()) {
        m_work->cancel();
        m_isCancelled = true;
        showState();
      } else {
        describeSoon(0);
      }
    });
    auto* state = new QHBoxLayout;
    state->setContentsMargins(scaled(this, 4), 0, 0, 0);
    state->addWidget(m_state, 1);
    state->addWidget(m_progress);
    state->addWidget(m_stop);
    auto* column = new QVBoxLayout;
    const int gap = scaled(this, 4);
    column->setContentsMargins(gap, gap, gap, gap);
    column->setSpacing(scaled(this, 3));
    column->addWidget(m_stretch);
    column->addLayout(state);
    return column;
  }

  void follow() {
    const ShownMoment* shown = m_parts.shown;
    connect(shown, &ShownMoment::sourceChanged, this, [this] {
      m_hasNames = false;
      describeSoon();
    });
    connect(shown, &ShownMoment::selectionChanged, this, [this] {
      if (m_stretch->kind() == StretchBar::Kind::Selection) describeSoon();
    });
    connect(shown, &ShownMoment::marksChanged, this, [this] {
      if (m_stretch->kind() == StretchBar::Kind::Marks) describeSoon();
    });
    connect(shown, &ShownMoment::timesOfDayChanged, this, [this] { showResult(); });
    connect(shown, &FrameSource::rewound, this, [this] { describeSoon(); });
    // Rows come with frames, with newer ones while the past is shown, or alone.
    connect(shown, &FrameSource::rowsAppended, this, &StatisticsDock::takeRows);
    connect(shown, &FrameSource::frameReceived, this, [this] { takeRows(); });
    connect(shown, &ShownMoment::newestChanged, this, &StatisticsDock::takeRows);
    connect(m_parts.compared, &ComparedSessions::changed, this, [this] { describeSoon(); });
    connect(m_robots, &RobotsButton::changed, this, [this] { describeSoon(); });
    connect(m_stretch, &StretchBar::changed, this, [this] {
      keep(conditionKey, m_stretch->condition());
      describeSoon();
    });
    connect(&m_settle, &QTimer::timeout, this, &StatisticsDock::describe);
    connect(&m_patience, &QTimer::timeout, this, &StatisticsDock::showState);
    connect(m_work, &StretchWork::progressed, this, &StatisticsDock::showState);
    connect(m_work, &StretchWork::finished, this, [this] {
      m_finished.restart();
      showResult();
      showState();
      takeRows();  // those that came meanwhile
    });
    // Names are looked up when somebody is about to type one.
    connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) {
      if (now == m_add || now == m_against || now == m_stretch->conditionBox()) takeNames();
    });
  }

  void takeNames() {
    if (m_hasNames) return;
    const auto rows = m_parts.shown->series();
    m_hasNames = rows != nullptr && rows->groups() > 0;
    const QStringList names = namesOf(rows.get());
    for (QLineEdit* edit : {m_add, m_against, m_stretch->conditionBox()}) {
      completeNames(edit, names);
    }
  }

  void restore() {
    if (m_parts.settings == nullptr) return;
    m_texts = m_parts.settings->value(textsKey).toStringList();
    m_against->setText(m_parts.settings->value(againstKey).toString());
    m_appliedAgainst = m_against->text();
    m_stretch->setCondition(m_parts.settings->value(conditionKey).toString());
    m_isStale = true;
  }

  void keep(const QString& key, const QVariant& value) {
    if (m_parts.settings != nullptr) m_parts.settings->setValue(key, value);
  }

  void addTyped() {
    const auto* completer = m_add->findChild<QCompleter*>();
    if (completer != nullptr && completer->popup()->isVisible()) {
      if (completer->popup()->currentIndex().isValid()) return;  // Enter chooses there
      completer->popup()->hide();
    }
    const QString text = m_add->text().trimmed();
    if (text.isEmpty()) return;
    const auto parsed = telemetry::Expression::parse(text.toStdString(), telemetry::eachRobot);
    if (!parsed) {
      say(QString::fromStdString(parsed.error().text()));
      return;
    }
    m_add->clear();
    addTexts({text});
  }

  void addTexts(const QStringList& texts) {
    for (const QString& text : texts) {
      if (!m_texts.contains(text)) m_texts << text;
    }
    keep(textsKey, m_texts);
    describeSoon(0);
  }

  void setTexts(const QStringList& texts) {
    m_texts = texts;
    m_texts.removeDuplicates();
    keep(textsKey, m_texts);
    describeSoon(0);
  }

  void removeSelection() {
    QStringList texts = m_texts;
    for (const StatisticsRow* row : m_table->selected()) {
      texts.removeAll(QString::fromStdString(row->line.variable));
    }
    setTexts(texts);
  }

  /// B1.TRUE_X becomes TRUE_X.
  void describeEachRobot() {
    QStringList texts = m_texts;
    for (const StatisticsRow* row : m_table->selected()) {
      if (row->line.robot.empty()) continue;
      const QString robot = QString::fromStdString(row->line.robot);
      const QString text = QString::fromStdString(row->line.variable);
      QString plain = text;
      plain.replace(robot + QLatin1Char('.'), QString());
      plain.replace(QStringLiteral("{%1/").arg(robot), QStringLiteral("{each/"));
      std::ranges::replace(texts, text, plain);
    }
    setTexts(texts);
  }

  void askAndSave() {
    const auto result = m_work->result();
    if (!result) return;
    // Taken before the dialog, behind which numbers change.
    const std::string text = telemetry::stretchCsv(result->lines, result->isCompared, true);
    const QString path =
        askToSave(this, QStringLiteral("Save the statistics"), QStringLiteral("statistics.csv"),
                  QStringLiteral("CSV files (*.csv)"));
    if (path.isEmpty()) return;
    const auto written =
        writeFile(path.toStdString(), {text.data(), text.size()}, IfExists::Replace);
    if (written) {
      m_message->showMessage(InPlaceMessage::Tone::Note, QStringLiteral("Saved as %1").arg(path));
    } else {
      say(QString::fromStdString(written.error().text()));
    }
  }

  void applyAgainst() {
    const QString text = m_against->text().trimmed();
    if (std::exchange(m_appliedAgainst, text) == text) return;
    keep(againstKey, text);
    describeSoon();
  }

  void say(const QString& problem) { m_message->showMessage(InPlaceMessage::Tone::Error, problem); }

  /// The time of the last row there is; a match is often ahead of its rows.
  double newestRow() const {
    const ShownMoment& shown = *m_parts.shown;
    if (shown.source() == m_parts.replay) return shown.now();
    const auto rows = shown.series();
    const auto range = rows ? rows->range() : std::nullopt;
    return range ? range->end : -std::numeric_limits<double>::infinity();
  }

  /// While rows come, everything changes; a part that is over does not.
  void takeRows() {
    if (m_texts.isEmpty() || m_settle.isActive() || m_work->isRunning() || m_isCancelled) return;
    if (newestRow() <= m_describedUntil) return;
    const auto range = m_stretch->range();
    if (range && range->end <= m_describedUntil) return;
    m_isStale = true;
    if (!isVisible()) return;
    const double wait =
        std::max(double(leastMillisecondsBetween), 1000.0 * idleShare * m_work->duration());
    const double passed = m_finished.isValid() ? double(m_finished.elapsed()) : wait;
    m_settle.start(static_cast<int>(std::max(0.0, wait - passed)));
  }

  void describeSoon(int milliseconds = settleMilliseconds) {
    m_isStale = true;
    m_isCancelled = false;
    m_delay->setVisible(!m_against->text().isEmpty());
    if (isVisible()) m_settle.start(milliseconds);
  }

  void describe() {
    m_isStale = false;
    if (m_texts.isEmpty()) {
      m_work->cancel();
      showResult();
      showState();
      return;
    }
    m_describedUntil = newestRow();
    m_work->start(order());
    m_patience.start();
    showState();
  }

  StretchOrder order() const {
    StretchOrder order;
    for (const QString& text : m_texts) {
      order.question.texts.push_back({text.toStdString(), text.toStdString()});
    }
    order.question.condition = m_stretch->condition().toStdString();
    order.question.robots = m_robots->robots();
    order.question.against = m_appliedAgainst.toStdString();
    order.question.maxDelay = m_delay->value();
    order.question.bins = histogramBins;
    if (const auto place = m_details->place()) {
      const FramePtr frame = m_parts.shown->frame();
      const sim::FieldSpec field = frame ? frame->settings->field : sim::FieldSpec();
      m_details->setField(field);
      order.question.placeX = place->first.toStdString();
      order.question.placeY = place->second.toStdString();
      order.question.grid = gridOf(field);
    }
    order.range = m_stretch->range();
    order.between = m_stretch->between();
    const ShownMoment& shown = *m_parts.shown;
    StretchSource source;
    source.name = shown.kind().name;
    if (shown.source() == m_parts.replay) {
      source.path = m_parts.replay->path().toStdString();
    } else {
      source.rows = shown.series();
      if (order.between) source.events = m_stretch->events();
    }
    const bool isThere = !source.path.empty() || source.rows;
    if (isThere && m_robots->takesShown()) order.sources.push_back(std::move(source));
    for (const ComparedSession* compared : m_parts.compared->all()) {
      if (!m_robots->takes(*compared)) continue;
      StretchSource other;
      other.path = compared->path().toStdString();
      other.name = other.path;
      other.offset = compared->offset();
      other.number = compared->number();
      order.sources.push_back(std::move(other));
    }
    return order;
  }

  /// The last result, as far as it is still asked for.
  void showResult() {
    const auto result = m_texts.isEmpty() ? nullptr : m_work->result();
    const bool isFirst = m_table->isEmpty();
    m_table->show(result, result ? m_texts : QStringList(), m_parts.shown->clock());
    if (isFirst) fitDetails();
    const QString problems = result ? shortListOf(result->problems) : QString();
    if (std::exchange(m_said, problems) == problems) return;
    if (problems.isEmpty()) {
      m_message->clear();
    } else {
      m_message->showMessage(InPlaceMessage::Tone::Warning, problems);
    }
  }

  void fitDetails() {
    const int details =
        std::max(m_details->minimumWidth(), std::min(scaled(this, 340), width() / 3));
    m_split->setSizes({width() - details, details});
  }

  void showState() {
    const bool isRunning = m_work->isRunning();
    const bool isLong = isRunning && !m_patience.isActive();
    const bool hasRows = !m_table->isEmpty();
    m_progress->setVisible(isLong);
    m_progress->setValue(static_cast<int>(std::lround(100.0 * m_work->progress())));
    m_stop->setVisible(isLong || m_isCancelled);
    m_stop->setText(m_isCancelled ? QStringLiteral("Describe again") : QStringLiteral("Cancel"));
    m_state->setText(m_isCancelled       ? QStringLiteral("Cancelled")
                     : m_texts.isEmpty() ? QString()
                                         : m_stretch->text());
    m_state->setToolTip(m_state->text());
    m_state->setVisible(!m_state->text().isEmpty());
    m_split->setVisible(hasRows);
    m_empty->setVisible(!hasRows && m_texts.isEmpty());
    m_save->setEnabled(hasRows);
    m_delay->setVisible(!m_against->text().isEmpty());
  }

  StatisticsDockParts m_parts;
  StretchWork* m_work;
  QLineEdit* m_add;
  RobotsButton* m_robots;
  QLineEdit* m_against;
  NumberBox* m_delay;
  QPushButton* m_save;
  StretchBar* m_stretch;
  QLabel* m_state;
  QProgressBar* m_progress;
  QPushButton* m_stop;
  InPlaceMessage* m_message;
  QSplitter* m_split;
  StatisticsTable* m_table;
  LineDetails* m_details;
  QLabel* m_empty;
  QTimer m_settle, m_patience;
  QElapsedTimer m_finished;
  QStringList m_texts;  // variables and expressions that are described
  QString m_appliedAgainst, m_said;
  double m_describedUntil = 0.0;  // s, the newest moment then
  bool m_isStale = false, m_isCancelled = false, m_hasNames = false;
};

}  // namespace

QWidget* makeStatisticsDock(const StatisticsDockParts& parts, QWidget* parent) {
  return new StatisticsDock(parts, parent);
}

}  // namespace pitchboard::ui
