// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/experiments/experiments_dock.h>

#include <QComboBox>
#include <QDesktopServices>
#include <QFileInfo>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QStandardPaths>
#include <QToolButton>
#include <QUrl>
#include <QVBoxLayout>

#include <base/file_target.h>
#include <ui/base/elide_text.h>
#include <ui/base/file_dialog.h>
#include <ui/base/robot_text.h>
#include <ui/base/running_work.h>
#include <ui/base/theme.h>
#include <ui/experiments/situation_tests.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/replay_controller.h>

#include "experiment_form.h"
#include "experiment_play.h"
#include "results_tabs.h"

namespace pitchboard::ui {

/// A sentence that ends with dots when it is longer than its place is wide; resting the mouse on it
/// tells the rest. UI thread.
class OneLine : public QLabel {
 public:
  using QLabel::QLabel;

 protected:
  void paintEvent(QPaintEvent* /*event*/) override {
    QPainter painter(this);
    const QRect room = contentsRect();
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter,
                     elideText(QFontMetricsF(font()), text(), room.width()));
  }
};

namespace {

QString folderOfExperiments() {
  return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) +
         QStringLiteral("/experiments");
}

class ExperimentsDock : public QWidget {
 public:
  ExperimentsDock(const ExperimentsDockParts& parts, QWidget* parent)
      : QWidget(parent),
        m_parts(parts),
        m_play(new ExperimentPlay(this)),
        m_choice(new QComboBox(this)),
        m_start(new QPushButton(QStringLiteral("Start"), this)),
        m_continue(new QPushButton(QStringLiteral("Continue"), this)),
        m_report(new QPushButton(QStringLiteral("Report"), this)),
        m_progress(new QProgressBar(this)),
        m_message(new OneLine(this)),
        m_tabs(new ResultsTabs(parts.compared != nullptr, this)),
        m_form(new ExperimentForm(this)),
        m_text(new QPlainTextEdit(this)) {
    makeBar();
    makeTabs();
    connect(m_play, &ExperimentPlay::progressed, this, &ExperimentsDock::showProgress);
    connect(m_play, &ExperimentPlay::ended, this, &ExperimentsDock::showResults);
    connect(m_play, &ExperimentPlay::failed, this, [this](const QString& sentence) {
      setPlaying(false);
      offerToContinue();
      showStatus(sentence, true);
    });
    connect(m_play, &ExperimentPlay::recorded, this, &ExperimentsDock::showRecorded);
    if (m_parts.tests != nullptr) {
      connect(m_parts.tests, &SituationTests::saved, this, &ExperimentsDock::open);
    }
    for (const link::ExperimentName& one : link::builtInExperiments()) {
      m_choice->addItem(QString::fromStdString(one.title), QString::fromStdString(one.name));
    }
    for (const link::ExperimentName& one : link::builtInSituations()) {
      m_choice->addItem(QStringLiteral("Test: ") + QString::fromStdString(one.title),
                        QString::fromStdString(one.name));
    }
    connect(m_choice, &QComboBox::currentIndexChanged, this, [this] { load(); });
    load();
    setPlaying(false);
  }

 private:
  void makeBar() {
    m_choice->setObjectName(QStringLiteral("experimentChoice"));
    m_choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_choice->setMinimumContentsLength(16);
    auto* open = new QToolButton(this);
    open->setIcon(themedIcon(QStringLiteral("document-open")));
    open->setToolTip(QStringLiteral("Open an experiment file…"));
    connect(open, &QToolButton::clicked, this, [this] { askAndOpen(); });
    auto* save = new QToolButton(this);
    save->setIcon(themedIcon(QStringLiteral("document-save-as")));
    save->setToolTip(QStringLiteral("Save the edited file…"));
    connect(save, &QToolButton::clicked, this, [this] { askAndSave(); });
    m_start->setObjectName(QStringLiteral("experimentStart"));
    connect(m_start, &QPushButton::clicked, this, [this] { startOrCancel(); });
    m_continue->setObjectName(QStringLiteral("experimentContinue"));
    m_continue->setToolTip(QStringLiteral("Play the runs that are missing in the last results"));
    m_continue->hide();
    connect(m_continue, &QPushButton::clicked, this, [this] { play(m_unfinished); });
    if (m_parts.work != nullptr) {
      m_parts.work->add(this, [this] {
        return m_play->isPlaying()
                   ? QStringLiteral(
                         "An experiment is running (%1). Quitting keeps the runs that "
                         "have ended; Continue in Experiments plays the others.")
                         .arg(m_progressText)
                   : QString();
      });
    }
    m_report->setToolTip(QStringLiteral("Open the report in a browser"));
    m_report->setEnabled(false);
    connect(m_report, &QPushButton::clicked, this, [this] {
      QDesktopServices::openUrl(
          QUrl::fromLocalFile(m_shown->folder + QStringLiteral("/report.html")));
    });
    m_progress->setTextVisible(false);
    m_progress->setFixedSize(scaled(this, 140), scaled(this, 8));
    m_message->setObjectName(QStringLiteral("experimentMessage"));
    m_message->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    auto* row = new QHBoxLayout;
    const int gap = scaled(this, 4);
    row->setContentsMargins(gap, gap, gap, gap);
    row->setSpacing(gap);
    row->addWidget(m_choice, 1);
    for (QWidget* one : {static_cast<QWidget*>(open), static_cast<QWidget*>(save),
                         static_cast<QWidget*>(m_progress), static_cast<QWidget*>(m_continue),
                         static_cast<QWidget*>(m_start), static_cast<QWidget*>(m_report)}) {
      row->addWidget(one);
    }
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(row);
    m_message->setContentsMargins(gap, 0, gap, gap);
    layout->addWidget(m_message);
    layout->addWidget(m_tabs, 1);
    setMinimumHeight(scaled(this, 80));
  }

  void makeTabs() {
    m_text->setObjectName(QStringLiteral("experimentText"));
    m_text->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    m_text->setLineWrapMode(QPlainTextEdit::NoWrap);
    m_tabs->addTab(m_form, QStringLiteral("Form"));
    m_tabs->addTabs();
    m_tabs->addTab(m_text, QStringLiteral("File (JSON)"));
    // The form says what the file says.
    connect(m_tabs, &QTabWidget::currentChanged, this, [this] {
      if (m_tabs->currentWidget() == m_form && m_text->document()->isModified()) showForm();
    });
    connect(m_form, &ExperimentForm::edited, this, [this] { takeForm(); });
    connect(m_tabs, &ResultsTabs::asked, this, &ExperimentsDock::see);
  }

  /// One in Replay, or two over each other.
  void see(const std::vector<std::size_t>& numbers) {
    showStatus(
        numbers.size() == 1
            ? QStringLiteral("Playing run %1 again…").arg(numbers[0])
            : QStringLiteral("Playing runs %1 and %2 again…").arg(numbers[0]).arg(numbers[1]));
    m_play->record(m_shown, numbers);
  }

  void showRecorded(const QStringList& sessions) {
    m_parts.replay->open(sessions.front());
    if (m_parts.compared != nullptr) m_parts.compared->removeAll();
    if (sessions.size() == 1) {
      return showStatus(
          m_shown->experiment.hasTeamPrograms()
              ? QStringLiteral("The run is open in Replay. Team programs do not repeat "
                               "exactly: a run that was not recorded was played again.")
              : QStringLiteral("The run is open in Replay."));
    }
    m_parts.compared->open(sessions.mid(1));
    showStatus(
        QStringLiteral("Both runs are open in Replay; the second is drawn over the first. "
                       "Timeline > Stop comparing ends it."));
  }

  void showStatus(const QString& message, bool isError = false) {
    QPalette colours = palette();
    if (isError) colours.setColor(QPalette::WindowText, theme().errorText);
    m_message->setPalette(colours);
    m_message->setText(message);
    m_message->setVisible(!message.isEmpty());
    m_message->setToolTip(message);
  }

  void load() {
    const auto loaded = link::loadExperiment(m_choice->currentData().toString().toStdString());
    if (!loaded) return showStatus(QString::fromStdString(loaded.error().text()), true);
    m_text->setPlainText(QString::fromStdString(loaded->text));
    m_form->show(*loaded, link::editsOf(loaded->text).value_or(link::ExperimentEdits()));
    m_text->document()->setModified(false);
    showStatus({});
    offerToContinue();
  }

  /// Runs of this very experiment may be missing because it was cancelled, or the studio ended.
  void offerToContinue() {
    const auto experiment =
        link::experimentFromJson(m_text->toPlainText().toStdString(), "File", {}, {});
    m_unfinished = experiment && !m_play->isPlaying()
                       ? ExperimentPlay::unfinished(*experiment, folderOfExperiments())
                       : QString();
    m_continue->setVisible(!m_unfinished.isEmpty());
  }

  void showForm() {
    const std::string text = m_text->toPlainText().toStdString();
    const auto edited = link::experimentFromJson(text, "File", {}, {});
    offerToContinue();
    if (edited)
      m_form->show(*edited, link::editsOf(text).value_or(link::ExperimentEdits()));
    else
      m_form->showError(QString::fromStdString(edited.error().text()));
    m_text->document()->setModified(false);
  }

  /// The file says what the form says; what it cannot say stays in the form until it is right.
  void takeForm() {
    const auto text = link::withEdits(m_text->toPlainText().toStdString(), m_form->edits());
    if (!text) return showStatus(QString::fromStdString(text.error().text()), true);
    const auto experiment = link::experimentFromJson(*text, "File", {}, {});
    if (!experiment) return showStatus(QString::fromStdString(experiment.error().text()), true);
    QTextCursor all(m_text->document());
    all.select(QTextCursor::Document);
    all.insertText(QString::fromStdString(*text));  // Ctrl+Z in the file takes it back
    m_text->document()->setModified(false);
    m_form->show(*experiment, link::editsOf(*text).value_or(link::ExperimentEdits()));
    showStatus({});
    offerToContinue();
  }

  void askAndOpen() {
    const QString path = askToOpen(this, QStringLiteral("Open experiment"),
                                   QStringLiteral("Experiments (*.json);;All files (*)"));
    if (path.isEmpty()) return;
    open(path, false);
  }

  /// A file, read again when it was open before.
  void open(const QString& path, bool play) {
    if (m_play->isPlaying()) {
      return showStatus(QStringLiteral("Cannot open %1 while an experiment is running.").arg(path),
                        true);
    }
    const int known = m_choice->findData(path);
    if (known < 0) m_choice->addItem(QFileInfo(path).completeBaseName(), path);
    const int index = known < 0 ? m_choice->count() - 1 : known;
    if (m_choice->currentIndex() == index) {
      load();
    } else {
      m_choice->setCurrentIndex(index);
    }
    m_tabs->setCurrentWidget(m_form);
    if (play) startOrCancel();
  }

  void askAndSave() {
    const QString path =
        askToSave(this, QStringLiteral("Save experiment"), QStringLiteral("experiment.json"),
                  QStringLiteral("Experiments (*.json)"));
    if (path.isEmpty()) return;
    const auto written =
        writeFile(path.toStdString(), m_text->toPlainText().toStdString(), IfExists::Replace);
    if (!written) return showStatus(QString::fromStdString(written.error().text()), true);
    showStatus(QStringLiteral("Saved as %1").arg(path));
  }

  void startOrCancel() {
    if (m_play->isPlaying()) {
      m_start->setEnabled(false);
      m_play->cancel();
      return;
    }
    play({});
  }

  /// Into this folder, which has some of the runs, or into a new one.
  void play(const QString& folder) {
    auto experiment = link::experimentFromJson(m_text->toPlainText().toStdString(), "File", {}, {});
    if (!experiment) {
      m_tabs->setCurrentWidget(m_text);
      return showStatus(QString::fromStdString(experiment.error().text()), true);
    }
    setPlaying(true);
    m_progressText = QStringLiteral("%1 runs").arg(experiment->allRuns());
    showStatus(QStringLiteral("Playing %1…").arg(m_progressText));
    if (folder.isEmpty())
      m_play->start(std::move(*experiment), folderOfExperiments());
    else
      m_play->resume(std::move(*experiment), folder);
  }

  void setPlaying(bool on) {
    m_start->setEnabled(true);
    m_start->setText(on ? QStringLiteral("Cancel") : QStringLiteral("Start"));
    if (on) m_continue->hide();
    m_progress->setVisible(on);
    m_progress->setRange(0, 0);
    m_choice->setEnabled(!on);
    m_form->setEditable(!on);
    m_text->setReadOnly(on);
    m_tabs->showPlaying(on);
  }

  void showProgress(qulonglong done, qulonglong all, double each) {
    m_progress->setRange(0, 1000);
    m_progress->setValue(
        static_cast<int>(1000.0 * double(done) / double(std::max<qulonglong>(all, 1))));
    const double rate = 1.0 / std::max(each, 1e-9);
    m_progressText = QStringLiteral("%1 of %2 runs").arg(done).arg(all);
    const double left = double(all - done) / std::max(rate, 1e-9);
    showStatus(QStringLiteral("%1, %2 runs/s, %3 left")
                   .arg(m_progressText)
                   .arg(rate, 0, 'f', rate < 10.0 ? 1 : 0)
                   .arg(durationText(left)));
  }

  void showResults(const PlayedPtr& played) {
    setPlaying(false);
    offerToContinue();
    m_shown = played;
    m_tabs->showResults(played);
    std::size_t runs = 0;
    QStringList notPlayed;
    for (const auto& condition : played->summary.conditions) {
      runs += condition.runs;
      if (condition.runs == 0) {
        notPlayed << QStringLiteral("“%1”").arg(QString::fromStdString(condition.name));
      }
    }
    const bool complete = runs == played->experiment.allRuns();
    m_report->setEnabled(complete);
    const auto& checks = played->summary.assertions;
    const auto failed =
        std::count_if(checks.begin(), checks.end(), [](const auto& one) { return !one.holds; });
    QString message = complete ? QStringLiteral("%1 runs").arg(runs)
                               : QStringLiteral("Cancelled: %1 of %2 runs")
                                     .arg(runs)
                                     .arg(played->experiment.allRuns());
    if (!notPlayed.isEmpty()) {
      message += QStringLiteral(". Not played: ") + notPlayed.join(QStringLiteral(", "));
    } else if (!checks.empty()) {
      message += failed == 0
                     ? QStringLiteral("; all assertions hold")
                     : QStringLiteral("; %1 of %2 assertions fail").arg(failed).arg(checks.size());
    }
    for (const std::string& text : link::identicalTexts(played->summary)) {
      message += QStringLiteral(". ") + QString::fromStdString(text).chopped(1);
    }
    showStatus(message + QStringLiteral(". Results: ") + played->folder,
               notPlayed.isEmpty() && failed > 0);
    if (m_tabs->currentWidget() == m_form || m_tabs->currentWidget() == m_text) {
      m_tabs->setCurrentIndex(1);
    }
  }

  ExperimentsDockParts m_parts;
  ExperimentPlay* m_play;
  QComboBox* m_choice;
  QPushButton* m_start;
  QPushButton* m_continue;
  QPushButton* m_report;
  QProgressBar* m_progress;
  QLabel* m_message;
  ResultsTabs* m_tabs;
  ExperimentForm* m_form;
  QPlainTextEdit* m_text;
  PlayedPtr m_shown;
  QString m_unfinished;  // folder with a part of the runs; empty: none
  QString m_progressText;
};

}  // namespace

QWidget* makeExperimentsDock(const ExperimentsDockParts& parts, QWidget* parent) {
  return new ExperimentsDock(parts, parent);
}

}  // namespace pitchboard::ui
