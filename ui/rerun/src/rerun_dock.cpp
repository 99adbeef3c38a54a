// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/rerun/rerun_dock.h>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include <robotlink/rerun/rerun_text.h>
#include <ui/base/file_dialog.h>
#include <ui/base/in_place_message.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/base/text_filter.h>
#include <ui/base/time_axis.h>
#include <ui/rerun/rerunner.h>
#include <ui/sources/shown_moment.h>

#include "differences_model.h"

namespace pitchboard::ui {
namespace {

enum class DifferencesFrom { Recording, LastRun };

class RerunDock : public QWidget {
 public:
  RerunDock(const RerunDockParts& parts, QWidget* parent)
      : QWidget(parent),
        m_parts(parts),
        m_rerunner(parts.rerunner),
        m_model(new DifferencesModel(this)),
        m_filter(new TextFilter(this)),
        m_table(new QTableView(this)),
        m_empty(makeEmptyLabel(this, QStringLiteral("emptyRerun"))) {
    m_model->setObjectName(QStringLiteral("differencesModel"));
    m_filter->setSourceModel(m_model);
    makeTable();
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(makeBar());
    column->addLayout(makeState());
    column->addWidget(m_message);
    column->addWidget(m_table, 1);
    column->addWidget(m_empty, 1);
    m_message->clear();
    connect(m_rerunner, &Rerunner::changed, this, &RerunDock::showAll);
    connect(m_rerunner, &Rerunner::finished, this, &RerunDock::showResult);
    connect(m_filter, &QAbstractItemModel::rowsInserted, this, &RerunDock::showEmpty);
    connect(m_filter, &QAbstractItemModel::rowsRemoved, this, &RerunDock::showEmpty);
    connect(parts.shown, &ShownMoment::timesOfDayChanged, this, &RerunDock::showList);
    showAll();
  }

 private:
  void makeTable() {
    m_table->setObjectName(QStringLiteral("differences"));
    m_table->setModel(m_filter);
    m_table->setSelectionMode(QAbstractItemView::SingleSelection);
    styleTable(m_table);
    const QFontMetricsF digits(m_table->font());
    const auto wide = [&](const QString& text) {
      return static_cast<int>(std::ceil(digits.horizontalAdvance(text))) + scaled(this, 16);
    };
    m_table->setColumnWidth(DifferencesModel::Time, wide(QStringLiteral("88:88:88.888")));
    m_table->setColumnWidth(DifferencesModel::Variable, scaled(this, 190));
    m_table->setColumnWidth(DifferencesModel::Before, scaled(this, 150));
    m_table->setColumnWidth(DifferencesModel::Rerun, scaled(this, 150));
    m_table->setColumnWidth(DifferencesModel::Duration, wide(QStringLiteral("8888.88 s")));
    connect(m_table, &QTableView::clicked, this, &RerunDock::goTo);
    connect(m_table, &QTableView::activated, this, &RerunDock::goTo);
    auto* plot = new QAction(QStringLiteral("Plot this variable of both"), m_table);
    plot->setObjectName(QStringLiteral("plotDifference"));
    connect(plot, &QAction::triggered, this, [this] {
      const QModelIndex row = m_table->currentIndex();
      if (!row.isValid()) return;
      m_rerunner->plot(row.siblingAtColumn(DifferencesModel::Variable).data().toString());
    });
    m_table->addAction(plot);
    m_table->setContextMenuPolicy(Qt::ActionsContextMenu);
  }

  QHBoxLayout* makeBar() {
    m_from->setObjectName(QStringLiteral("rerunFrom"));
    m_from->setAccessibleName(QStringLiteral("Differences"));
    m_from->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    m_from->addItem(QStringLiteral("From the recording"));
    m_from->addItem(QStringLiteral("Since the last run"));
    m_from->setMinimumContentsLength(static_cast<int>(m_from->itemText(0).size()));
    connect(m_from, &QComboBox::currentIndexChanged, this, &RerunDock::showList);
    m_words->setObjectName(QStringLiteral("rerunFilter"));
    m_words->setPlaceholderText(QStringLiteral("Filter by words"));
    m_words->setClearButtonEnabled(true);
    m_words->addAction(themedIcon(QStringLiteral("view-filter")), QLineEdit::LeadingPosition);
    m_words->setMinimumWidth(scaled(this, 80));
    connect(m_words, &QLineEdit::textChanged, this, [this](const QString& text) {
      m_filter->setFilterText(text);
      showEmpty();
    });
    m_follow->setObjectName(QStringLiteral("rerunFollow"));
    connect(m_follow, &QCheckBox::clicked, m_rerunner, &Rerunner::setFollowing);
    const auto button = [this](QPushButton* made, const char* name) {
      made->setObjectName(QLatin1String(name));
      return made;
    };
    button(m_ask, "rerunAsk");
    connect(m_ask, &QPushButton::clicked, this, [this] { m_parts.ask(); });
    button(m_again, "rerunAgain");
    connect(m_again, &QPushButton::clicked, m_rerunner, &Rerunner::again);
    button(m_report, "rerunReport");
    connect(m_report, &QPushButton::clicked, this, [this] { askForReport(); });
    auto* row = new QHBoxLayout;
    const int gap = scaled(this, 4);
    row->setContentsMargins(gap, gap, gap, gap);
    row->setSpacing(gap);
    row->addWidget(m_from);
    row->addWidget(m_words, 1);
    row->addWidget(m_follow);
    row->addWidget(m_ask);
    row->addWidget(m_again);
    row->addWidget(m_report);
    return row;
  }

  QHBoxLayout* makeState() {
    m_state->setObjectName(QStringLiteral("rerunState"));
    m_state->setWordWrap(true);
    m_state->setFont(themeFont(TypeRole::Secondary));
    m_state->setForegroundRole(QPalette::PlaceholderText);
    m_progress->setObjectName(QStringLiteral("rerunDockProgress"));
    m_progress->setRange(0, 100);
    m_progress->setTextVisible(false);
    m_progress->setFixedSize(scaled(this, 140), scaled(this, 8));
    m_cancel->setObjectName(QStringLiteral("rerunDockCancel"));
    connect(m_cancel, &QPushButton::clicked, m_rerunner, &Rerunner::cancel);
    auto* row = new QHBoxLayout;
    row->setContentsMargins(scaled(this, 8), 0, scaled(this, 4), scaled(this, 4));
    row->addWidget(m_state, 1);
    row->addWidget(m_progress);
    row->addWidget(m_cancel);
    return row;
  }

  DifferencesFrom from() const { return static_cast<DifferencesFrom>(m_from->currentIndex()); }

  /// What has changed since the last run is what somebody wants to see who runs again.
  void showResult() {
    const auto& result = m_rerunner->result();
    const QSignalBlocker quiet(m_from);
    m_from->setCurrentIndex(result && result->sinceLast ? 1 : 0);
    showList();
    showAll();
  }

  void showList() {
    m_listed = m_rerunner->result();
    const bool since = m_listed && m_listed->sinceLast && from() == DifferencesFrom::LastRun;
    m_model->show(!m_listed ? std::vector<link::ComparedVariable>()
                  : since   ? *m_listed->sinceLast
                            : m_listed->variables,
                  since ? QStringLiteral("Last run") : QStringLiteral("Recorded"),
                  m_parts.shown->clock());
    showEmpty();
  }

  void showAll() {
    const auto& result = m_rerunner->result();
    const bool running = m_rerunner->isRunning();
    if (m_listed != result) showList();
    m_progress->setVisible(running);
    m_cancel->setVisible(running);
    m_progress->setValue(static_cast<int>(std::lround(100.0 * m_rerunner->progress())));
    m_state->setText(running && m_rerunner->isChecking()
                         ? QStringLiteral("Checking reproducibility…")
                     : running ? QStringLiteral("Running…")
                     : result  ? resultText(*result)
                               : QString());
    m_state->setVisible(!m_state->text().isEmpty());
    if (m_said != m_rerunner->problem()) {
      m_said = m_rerunner->problem();
      if (m_said.isEmpty()) {
        m_message->clear();
      } else {
        m_message->showMessage(InPlaceMessage::Tone::Error, m_said);
      }
    }
    const QString whyNot = m_rerunner->whyNot();
    m_ask->setEnabled(whyNot.isEmpty());
    m_ask->setToolTip(whyNot);
    m_again->setEnabled(!running && m_rerunner->canRunAgain());
    m_again->setToolTip(QStringLiteral("Runs the same again and compares with this run, too"));
    m_report->setEnabled(result != nullptr);
    const QString whyNotFollow = m_rerunner->whyNotFollow();
    m_follow->setEnabled(whyNotFollow.isEmpty());
    m_follow->setToolTip(whyNotFollow.isEmpty()
                             ? QStringLiteral("Runs again whenever its file is saved")
                             : whyNotFollow);
    m_follow->setChecked(m_rerunner->isFollowing());
    // Without a second run there is nothing to choose.
    m_from->setEnabled(result && result->sinceLast);
    showEmpty();
  }

  static QString differencesText(const std::vector<link::ComparedVariable>& variables) {
    qulonglong count = 0;
    int differing = 0;
    for (const link::ComparedVariable& one : variables) {
      count += one.stretchCount;
      differing += one.differs() ? 1 : 0;
    }
    if (count == 0) return QStringLiteral("no difference");
    return QStringLiteral("%1 %2 in %3 %4")
        .arg(countText(count),
             count == 1 ? QStringLiteral("difference") : QStringLiteral("differences"))
        .arg(differing)
        .arg(differing == 1 ? QStringLiteral("variable") : QStringLiteral("variables"));
  }

  QString resultText(const link::RerunResult& result) const {
    QStringList processes;
    for (const link::RerunProcess& one : result.processes) {
      const QString program = QString::fromStdString(one.program);
      processes << QString::fromStdString(one.name) + QLatin1Char('=') +
                       (QFileInfo::exists(program) ? QFileInfo(program).fileName() : program);
    }
    const auto clock = m_parts.shown->clock();
    QStringList sentences{
        QStringLiteral("%1 rerun (%2), %3 to %4, %5: %6.")
            .arg(QString::fromStdString(result.robot), processes.join(QStringLiteral(", ")),
                 momentText(result.begin, 0, clock), momentText(result.end, 0, clock),
                 result.inLockStep ? QStringLiteral("in lock-step") : QStringLiteral("over time"),
                 differencesText(result.variables))};
    if (result.sinceLast) {
      sentences
          << QStringLiteral("Since the last run: %1.").arg(differencesText(*result.sinceLast));
    }
    for (const auto& more : {link::rerunVerdicts(result), result.notes}) {
      for (const std::string& one : more) {
        if (one != "No value differs.") sentences << QString::fromStdString(one);
      }
    }
    if (m_model->all() > static_cast<std::uint64_t>(m_model->rowCount())) {
      sentences << QStringLiteral("Of each variable, the first %1 are listed.")
                       .arg(link::ComparedVariable::maxStretches);
    }
    return sentences.join(QLatin1Char(' '));
  }

  void showEmpty() {
    const bool empty = m_filter->rowCount() == 0;
    m_table->setVisible(!empty);
    m_empty->setVisible(empty);
    if (!empty) return;
    const auto& result = m_rerunner->result();
    m_empty->setText(
        m_model->rowCount() > 0 ? QStringLiteral("No matching differences")
        : result && result->sinceLast && from() == DifferencesFrom::LastRun
            ? QStringLiteral("The last run gave the same outputs.")
        : result
            ? result->unchangedToo() > 0 ? QStringLiteral("Every difference was left out.")
                                         : QStringLiteral("The outputs are the recorded ones.")
            : QStringLiteral(
                  "Would a changed program decide differently? “Rerun with…” runs a recording "
                  "through a robot's process again, and lists here where its outputs differ."));
  }

  void goTo(const QModelIndex& index) {
    m_parts.shown->seek(index.siblingAtColumn(0).data(DifferencesModel::timeRole).toDouble());
  }

  void askForReport() {
    const QFileInfo recording(m_rerunner->recording());
    const QString path = askToSave(this, QStringLiteral("Save the report"),
                                   recording.completeBaseName() + QStringLiteral(" rerun.html"),
                                   QStringLiteral("HTML pages (*.html)"));
    if (path.isEmpty() || !m_rerunner->result()) return;
    const auto written = m_rerunner->writeReport(path);
    if (written) {
      m_message->showMessage(InPlaceMessage::Tone::Note, QStringLiteral("Saved as %1").arg(path));
    } else {
      m_message->showMessage(InPlaceMessage::Tone::Error,
                             QString::fromStdString(written.error().text()));
    }
  }

  RerunDockParts m_parts;
  Rerunner* m_rerunner;
  DifferencesModel* m_model;
  TextFilter* m_filter;
  QTableView* m_table;
  QLabel* m_empty;
  QComboBox* m_from = new QComboBox(this);
  QLineEdit* m_words = new QLineEdit(this);
  QCheckBox* m_follow = new QCheckBox(QStringLiteral("Rerun when the program changes"), this);
  QPushButton* m_ask = new QPushButton(QStringLiteral("Rerun with…"), this);
  QPushButton* m_again = new QPushButton(QStringLiteral("Rerun again"), this);
  QPushButton* m_report = new QPushButton(QStringLiteral("HTML report…"), this);
  QLabel* m_state = new QLabel(this);
  QProgressBar* m_progress = new QProgressBar(this);
  QPushButton* m_cancel = new QPushButton(QStringLiteral("Cancel"), this);
  InPlaceMessage* m_message = new InPlaceMessage(this);
  std::shared_ptr<const link::RerunResult> m_listed;
  QString m_said;
};

}  // namespace

QWidget* makeRerunDock(const RerunDockParts& parts, QWidget* parent) {
  return new RerunDock(parts, parent);
}

}  // namespace pitchboard::ui
