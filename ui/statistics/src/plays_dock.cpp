// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/statistics/plays_dock.h>

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <robotlink/report/session_tally.h>
#include <ui/base/action_reason.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>

#include "plays_model.h"

namespace pitchboard::ui {
namespace {

constexpr int minRefresh = 2000;       // ms between two counts of a match that goes on
constexpr double maxCountShare = 0.2;  // of the time, for counting
constexpr double lead = 3.0;           // s of a clip before a play
constexpr double trail = 5.0;          // s after it

class PlaysDock : public QWidget {
 public:
  PlaysDock(PlaysDockParts parts, QWidget* parent)
      : QWidget(parent),
        m_parts(std::move(parts)),
        m_model(new PlaysModel(this)),
        m_filter(new PlaysFilter(this)),
        m_table(new QTableView(this)),
        m_empty(makeEmptyLabel(this, QStringLiteral("emptyPlays"))) {
    m_model->setObjectName(QStringLiteral("playsModel"));
    m_filter->setSourceModel(m_model);
    m_filter->setSortRole(PlaysModel::sortRole);
    makeTable();
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(makeBar());
    column->addWidget(m_table, 1);
    column->addWidget(m_empty, 1);
    m_timer.setSingleShot(true);
    connect(&m_timer, &QTimer::timeout, this, &PlaysDock::count);
    const ShownMoment* shown = m_parts.shown;
    connect(shown, &ShownMoment::sourceChanged, this, [this] {
      m_ofShown = {};
      showPlays();
      countSoon(0);
    });
    connect(m_parts.compared, &ComparedSessions::changed, this, [this] {
      showPlays();
      if (!uncounted().empty()) countSoon(0);
    });
    connect(shown, &FrameSource::rewound, this, [this] { countSoon(0); });
    connect(shown, &ShownMoment::timesOfDayChanged, this, [this] { showPlays(); });
    connect(shown, &FrameSource::rowsAppended, this, [this] { countLater(); });
    connect(shown, &FrameSource::frameReceived, this, [this] { countLater(); });
    connect(shown, &ShownMoment::newestChanged, this, [this] { countLater(); });
    showPlays();
    showEmpty();
  }
  ~PlaysDock() override { m_isClosing = true; }

 protected:
  void showEvent(QShowEvent* event) override {
    QWidget::showEvent(event);
    if (m_isStale) countSoon(0);
  }

 private:
  void makeTable() {
    m_table->setObjectName(QStringLiteral("plays"));
    m_table->setModel(m_filter);
    m_table->setSelectionMode(QAbstractItemView::SingleSelection);
    m_table->setSortingEnabled(true);
    m_table->sortByColumn(PlaysModel::Time, Qt::AscendingOrder);
    styleTable(m_table);
    const QFontMetricsF digits(m_table->font());
    m_table->setColumnWidth(
        PlaysModel::Time,
        static_cast<int>(std::ceil(digits.horizontalAdvance(QStringLiteral("88:88:88.8")))) +
            scaled(this, 24));
    m_table->setIconSize(QSize(scaled(this, 8), scaled(this, 8)));
    m_table->setColumnWidth(PlaysModel::Session, scaled(this, 120));
    m_table->setColumnWidth(PlaysModel::Kind, scaled(this, 90));
    m_table->setColumnWidth(PlaysModel::Robot, scaled(this, 70));
    for (const auto chosen : {&QTableView::clicked, &QTableView::activated}) {
      connect(m_table, chosen, this, [this] { goTo(); });
    }
    const auto action = [this](const char* name, const char* text, auto slot) {
      auto* made = new QAction(QString::fromUtf8(text), m_table);
      made->setObjectName(QLatin1String(name));
      connect(made, &QAction::triggered, this, [this, slot] {
        if (goTo()) slot(*current());
      });
      m_table->addAction(made);
      return made;
    };
    action("bookmarkPlay", "Set bookmark", [this](const link::PlayEvent& play) {
      m_parts.shown->addBookmark(QString::fromStdString(sentenceOf(play)));
    });
    action("clipPlay", "Export clip…", [this](const link::PlayEvent& play) {
      select(play);
      m_parts.exportRange();
    });
    action("testPlay", "Save this moment as a test…",
           [this](const link::PlayEvent&) { m_parts.saveTest(); });
    action("rerunPlay", "Rerun with…", [this](const link::PlayEvent& play) {
      select(play);
      m_parts.rerun();
    });
    QAction* copy = action("copyPlay", "Copy", [](const link::PlayEvent& play) {
      QApplication::clipboard()->setText(QString::fromStdString(sentenceOf(play)));
    });
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    m_table->setContextMenuPolicy(Qt::ActionsContextMenu);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this, copy] {
      const bool isOther = current() && m_model->sessionOf(currentRow()).id != 0;
      for (QAction* one : m_table->actions()) {
        if (one == copy) continue;
        enableUnless(*one, isOther ? QStringLiteral("This play is of a compared session. Open that "
                                                    "session to use it")
                                   : QString());
      }
    });
  }

  QHBoxLayout* makeBar() {
    m_kind->setObjectName(QStringLiteral("playKind"));
    m_kind->setAccessibleName(QStringLiteral("Kind"));
    m_kind->addItem(QStringLiteral("All kinds"));
    for (std::size_t i = 0; i < link::playKindCount; ++i) {
      m_kind->addItem(capitalised(labelOf(static_cast<link::PlayKind>(i))), static_cast<int>(i));
    }
    connect(m_kind, &QComboBox::currentIndexChanged, this, [this] {
      const QVariant kind = m_kind->currentData();
      m_filter->setKind(kind.isValid() ? std::optional(static_cast<link::PlayKind>(kind.toInt()))
                                       : std::nullopt);
      showEmpty();
    });
    m_session->setObjectName(QStringLiteral("playSession"));
    m_session->setAccessibleName(QStringLiteral("Session"));
    m_session->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    connect(m_session, &QComboBox::currentIndexChanged, this, [this] {
      const QVariant id = m_session->currentData();
      m_filter->setSession(id.isValid() ? std::optional(id.toULongLong()) : std::nullopt);
      showEmpty();
    });
    m_who->setObjectName(QStringLiteral("playRobot"));
    m_who->setAccessibleName(QStringLiteral("Team or robot"));
    m_who->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    m_who->setMinimumContentsLength(12);
    m_who->addItem(QStringLiteral("Both teams"));
    connect(m_who, &QComboBox::currentIndexChanged, this, [this] { filterWho(); });
    m_words->setObjectName(QStringLiteral("playFilter"));
    m_words->setPlaceholderText(QStringLiteral("Filter by words, e.g. saved"));
    m_words->setClearButtonEnabled(true);
    m_words->addAction(themedIcon(QStringLiteral("view-filter")), QLineEdit::LeadingPosition);
    connect(m_words, &QLineEdit::textChanged, this, [this](const QString& text) {
      m_filter->setFilterText(text);
      showEmpty();
    });
    auto* row = new QHBoxLayout;
    const int gap = scaled(this, 4);
    row->setContentsMargins(gap, gap, gap, gap);
    row->setSpacing(gap);
    row->addWidget(m_session);
    row->addWidget(m_kind);
    row->addWidget(m_who);
    row->addWidget(m_words, 1);
    return row;
  }

  void filterWho() {
    const QVariant team = m_who->currentData();
    const bool isRobot = m_who->currentIndex() > 0 && !team.isValid();
    m_filter->setWho(
        isRobot ? m_who->currentText().toStdString() : std::string(),
        team.isValid() ? std::optional(static_cast<TeamColor>(team.toInt())) : std::nullopt);
    showEmpty();
  }

  /// The teams and robots that have plays; the choice stays if it can.
  void fillWho() {
    std::map<TeamColor, std::set<std::string>> teams;
    for (const SessionPlays& session : m_model->sessions()) {
      for (const link::PlayEvent& play : session.plays) teams[play.team].insert(play.name);
    }
    const QString before = m_who->currentText();
    const QSignalBlocker quiet(m_who);
    m_who->clear();
    m_who->addItem(QStringLiteral("Both teams"));
    for (const auto& [team, robots] : teams) {
      m_who->addItem(capitalised(info(team).name), static_cast<int>(team));
    }
    for (const auto& [team, robots] : teams) {
      for (const std::string& robot : robots) {
        if (!robot.empty() && robot.starts_with(info(team).letter)) {
          m_who->addItem(QString::fromStdString(robot));
        }
      }
    }
    m_who->setCurrentIndex(std::max(0, m_who->findText(before)));
    filterWho();
  }

  /// Of the model; -1 without a choice.
  int currentRow() const { return m_filter->mapToSource(m_table->currentIndex()).row(); }

  const link::PlayEvent* current() const {
    const int row = currentRow();
    return row >= 0 ? &m_model->at(row) : nullptr;
  }

  bool goTo() {
    if (current() == nullptr) return false;
    m_parts.shown->seek(m_model->timeOf(currentRow()));
    return true;
  }

  void select(const link::PlayEvent& play) {
    const auto all = m_parts.shown->available();
    if (!all) return;
    const double end = std::min(play.end, play.time + 60.0) + trail;
    m_parts.shown->setSelection(
        telemetry::TimeRange{std::max(all->begin, play.time - lead), std::min(all->end, end)});
  }

  void countSoon(int milliseconds) {
    m_isStale = true;
    if (isVisible()) m_timer.start(milliseconds);
  }

  /// A match goes on: not all the time, so that counting costs little. A recording stays as it is.
  void countLater() {
    if (m_parts.shown->source() == m_parts.replay || m_timer.isActive() || m_isCounting) return;
    countSoon(std::max(minRefresh, static_cast<int>(m_took / maxCountShare)));
  }

  struct Asked {
    quint64 id;  // of a compared session; 0: the source that is shown
    std::string path;
  };

  /// Compared sessions whose plays are unknown. Their files do not change.
  std::vector<Asked> uncounted() const {
    std::vector<Asked> all;
    for (const ComparedSession* session : m_parts.compared->all()) {
      if (!m_ofCompared.contains(session->id())) {
        all.push_back({session->id(), session->path().toStdString()});
      }
    }
    return all;
  }

  static std::vector<link::PlayEvent> playsOf(const std::string& path) {
    const auto session = telemetry::SessionReader::open(path);
    const auto range = session ? session->range() : std::nullopt;
    return range ? link::statisticsOf(*session, *range).plays : std::vector<link::PlayEvent>();
  }

  struct Counted {
    std::vector<link::PlayEvent> plays;
    PlayWords words;
  };
  static Counted withWords(std::vector<link::PlayEvent> plays) {
    PlayWords words = wordsOf(plays);
    return {std::move(plays), std::move(words)};
  }

  void count() {
    if (m_isCounting) {
      m_isStale = true;
      return;
    }
    m_isStale = false;
    const bool isFile = m_parts.shown->source() == m_parts.replay;
    const std::string path = isFile ? m_parts.replay->path().toStdString() : std::string();
    const auto rows = m_parts.shown->series();
    const bool isShownThere = isFile ? !path.empty() : rows != nullptr;
    const std::vector<Asked> others = uncounted();
    if (!isShownThere && others.empty()) return showEmpty();
    const FramePtr frame = m_parts.shown->frame();
    const sim::FieldSpec field = frame ? frame->settings->field : sim::FieldSpec();
    m_isCounting = true;
    showEmpty();
    const FrameSource* source = m_parts.shown->source();
    m_worker.start([this, path, rows, field, source, isShownThere, others] {
      QElapsedTimer timer;
      timer.start();
      std::vector<link::PlayEvent> plays;
      if (isShownThere && !path.empty()) {
        plays = playsOf(path);
      } else if (isShownThere) {
        constexpr double end = std::numeric_limits<double>::max();
        plays = link::statisticsOf(*rows, {-end, end}, field).plays;
      }
      Counted counted = withWords(std::move(plays));
      m_ui.post(
          [this, path, source, counted = std::move(counted), took = timer.elapsed()]() mutable {
            m_took = static_cast<double>(took);
            const bool isShown = source == m_parts.shown->source() &&
                                 (path.empty() || path == m_parts.replay->path().toStdString());
            if (!isShown) return;
            m_ofShown = std::move(counted);
            showPlays();
          });
      for (const Asked& other : others) {
        if (m_isClosing) return;
        m_ui.post([this, id = other.id, found = withWords(playsOf(other.path))]() mutable {
          m_ofCompared[id] = std::move(found);
          showPlays();
        });
      }
      m_ui.post([this] {
        m_isCounting = false;
        if (m_isStale || !uncounted().empty()) countSoon(0);
        showEmpty();
      });
    });
  }

  /// What was counted of the sessions that are open now.
  void showPlays() {
    std::erase_if(m_ofCompared,
                  [this](const auto& one) { return !m_parts.compared->find(one.first); });
    std::vector<SessionPlays> all(1);
    const bool isFile = m_parts.shown->source() == m_parts.replay;
    all[0].name = isFile ? QFileInfo(m_parts.replay->path()).completeBaseName()
                         : QString::fromUtf8(m_parts.shown->kind().name);
    all[0].plays = m_ofShown.plays;
    all[0].words = m_ofShown.words;
    for (const ComparedSession* session : m_parts.compared->all()) {
      const auto found = m_ofCompared.find(session->id());
      const Counted none;
      const Counted& counted = found != m_ofCompared.end() ? found->second : none;
      all.push_back({session->id(), session->number(), session->markedName(), session->offset(),
                     counted.plays, counted.words});
    }
    m_model->show(std::move(all), m_parts.shown->clock());
    fillSessions();
    fillWho();
  }

  /// The choice stays if it can.
  void fillSessions() {
    const std::vector<SessionPlays>& sessions = m_model->sessions();
    const QVariant before = m_session->currentData();
    {
      const QSignalBlocker quiet(m_session);
      m_session->clear();
      m_session->addItem(QStringLiteral("All sessions"));
      for (const SessionPlays& session : sessions) m_session->addItem(session.name, session.id);
      m_session->setCurrentIndex(before.isValid() ? std::max(0, m_session->findData(before)) : 0);
    }
    const QVariant now = m_session->currentData();
    m_filter->setSession(now.isValid() ? std::optional(now.toULongLong()) : std::nullopt);
    m_session->setVisible(sessions.size() > 1);
    m_table->setColumnHidden(PlaysModel::Session, sessions.size() < 2);
  }

  void showEmpty() {
    const bool isEmpty = m_filter->rowCount() == 0;
    m_table->setVisible(!isEmpty);
    m_empty->setVisible(isEmpty);
    if (!isEmpty) return;
    const bool isLive = &m_parts.shown->kind() == &SourceKind::Live;
    m_empty->setText(m_model->rowCount() > 0 ? QStringLiteral("No matching plays")
                     : m_isCounting          ? QStringLiteral("Counting…")
                     : isLive ? QStringLiteral("Record the live robots and open the recording to "
                                               "see their passes, shots and set plays here.")
                              : QStringLiteral("No plays yet. Passes, shots, balls won, set plays "
                                               "and penalties of the match appear here."));
  }

  PlaysDockParts m_parts;
  PlaysModel* m_model;
  PlaysFilter* m_filter;
  QTableView* m_table;
  QLabel* m_empty;
  QComboBox* m_session = new QComboBox(this);
  QComboBox* m_kind = new QComboBox(this);
  QComboBox* m_who = new QComboBox(this);
  QLineEdit* m_words = new QLineEdit(this);
  QTimer m_timer;
  bool m_isStale = true, m_isCounting = false;
  Counted m_ofShown;
  std::map<quint64, Counted> m_ofCompared;  // by the session's id
  std::atomic<bool> m_isClosing = false;
  double m_took = 0.0;  // ms, the last count
  UiQueue m_ui;
  Workers m_worker;  // last: waits for its work before the rest goes
};

}  // namespace

QWidget* makePlaysDock(const PlaysDockParts& parts, QWidget* parent) {
  return new PlaysDock(parts, parent);
}

}  // namespace pitchboard::ui
