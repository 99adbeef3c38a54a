// SPDX-License-Identifier: GPL-3.0-or-later
#include "join_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include <base/try.h>
#include <ui/base/explanation.h>
#include <ui/base/number_box.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>

#include "clock_view.h"

namespace pitchboard::ui {
namespace {

constexpr int compareMilliseconds = 80;  // after the last change of a number
constexpr double ppm = 1e-6;
constexpr double mostOffset = 1e7, mostDrift = 10'000.0;  // s, ppm
constexpr double poorShare = 0.3;

QString plusMinus(double value, int decimals) {
  return QStringLiteral("± %1").arg(numberText(value, decimals));
}

QString withSign(double value, int decimals) {
  return (value >= 0.0 ? QStringLiteral("+") : QString()) + numberText(value, decimals);
}

NumberBox* clockBox(const char* name, double most, int decimals, const char* unit,
                    QWidget* parent) {
  auto* box = new NumberBox(parent);
  box->setObjectName(QLatin1String(name));
  box->setRange(-most, most);
  box->setDecimals(decimals);
  box->setSuffix(QStringLiteral(" ") + QString::fromUtf8(unit));
  box->setMinimumWidth(scaled(parent, 130));
  return box;
}

}  // namespace

struct JoinDialog::Files {
  std::optional<telemetry::SessionReader> session;
  std::optional<link::RobotRecording> recording;

  Result<void> open(const std::string& sessionPath, const std::string& recordingPath) {
    if (!session) session.emplace(TRY(telemetry::SessionReader::open(sessionPath)));
    if (!recording) recording.emplace(TRY(link::RobotRecording::open(recordingPath)));
    return {};
  }
};

JoinDialog::JoinDialog(const QString& session, const QString& recording, QWidget* parent,
                       std::function<void(const link::JoinOptions&)> join)
    : QDialog(parent),
      m_session(session.toStdString()),
      m_recording(recording.toStdString()),
      m_files(std::make_shared<Files>()) {
  setWindowTitle(QStringLiteral("Add recording of a robot"));
  setObjectName(QStringLiteral("joinDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  makeRows();
  m_what->setText(QFileInfo(recording).fileName());
  m_compareTimer.setSingleShot(true);
  m_compareTimer.setInterval(compareMilliseconds);
  connect(&m_compareTimer, &QTimer::timeout, this, &JoinDialog::compare);
  for (NumberBox* box : {m_offset, m_drift}) {
    connect(box, &QDoubleSpinBox::valueChanged, this, &JoinDialog::compareSoon);
  }
  connect(m_robot, &QComboBox::activated, this,
          [this] { read(m_robot->currentData().toString().toStdString()); });
  connect(m_useEstimate, &QPushButton::clicked, this, [this] {
    if (m_estimate) showClock(*m_estimate);
    m_offset->setFocus();
  });
  connect(m_join, &QPushButton::clicked, this, [this, join = std::move(join)] {
    link::JoinOptions options;
    options.robot = m_robot->currentData().toString().toStdString();
    if (!isEstimate()) {
      options.offset = clock().offset;
      options.drift = clock().drift;
    }
    join(options);
    accept();
  });
  read({});
}

JoinDialog::~JoinDialog() {
  if (m_cancelled) *m_cancelled = true;
  m_worker.waitForDone();
}

void JoinDialog::makeRows() {
  const auto label = [this](const char* name) {
    auto* made = new QLabel(this);
    made->setObjectName(QLatin1String(name));
    made->setWordWrap(true);
    return made;
  };
  m_what = label("joinRecording");
  m_agreement = label("joinAgreement");
  m_message = label("joinMessage");
  m_effect = makeExplanation({}, this);
  m_effect->setObjectName(QStringLiteral("joinEffect"));
  m_offsetEstimate = makeExplanation({}, this);
  m_offsetEstimate->setObjectName(QStringLiteral("joinOffsetEstimate"));
  m_driftEstimate = makeExplanation({}, this);
  m_driftEstimate->setObjectName(QStringLiteral("joinDriftEstimate"));
  m_robot = new QComboBox(this);
  m_robot->setObjectName(QStringLiteral("joinRobot"));
  m_robot->setToolTip(QStringLiteral("The robot of the session that made the recording"));
  m_offset = clockBox("joinOffset", mostOffset, 3, "s", this);
  m_offset->setSingleStep(0.005);
  m_offset->setToolTip(QStringLiteral("Time of the session at the recording's second 0"));
  m_drift = clockBox("joinDrift", mostDrift, 1, "ppm", this);
  m_drift->setToolTip(QStringLiteral(
      "How much faster the session's clock runs: 10 ppm are 36 ms in an hour, counted from the "
      "recording's second 0"));
  m_view = new ClockView(this);
  m_useEstimate = new QPushButton(QStringLiteral("Use the &estimate"), this);
  m_useEstimate->setObjectName(QStringLiteral("joinUseEstimate"));
  m_useEstimate->setAutoDefault(false);
  const auto row = [](QWidget* box, QWidget* beside) {
    auto* made = new QHBoxLayout;
    made->addWidget(box);
    made->addWidget(beside, 1);
    return made;
  };
  auto* form = new QFormLayout;
  form->addRow(QStringLiteral("Recording"), m_what);
  form->addRow(QStringLiteral("&Robot"), m_robot);
  auto* offset = new QLabel(QStringLiteral("&Offset"), this);
  offset->setBuddy(m_offset);
  form->addRow(offset, row(m_offset, m_offsetEstimate));
  auto* drift = new QLabel(QStringLiteral("&Drift"), this);
  drift->setBuddy(m_drift);
  form->addRow(drift, row(m_drift, m_driftEstimate));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  m_join = buttons->addButton(QStringLiteral("&Join"), QDialogButtonBox::ActionRole);
  m_join->setObjectName(QStringLiteral("joinStart"));
  m_join->setDefault(true);
  buttons->addButton(m_useEstimate, QDialogButtonBox::ResetRole);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addLayout(form);
  column->addWidget(m_view, 1);
  column->addWidget(m_agreement);
  column->addWidget(m_effect);
  column->addWidget(m_message);
  column->addWidget(buttons);
  setMinimumWidth(scaled(this, 500));
}

void JoinDialog::read(const std::string& robot) {
  if (m_cancelled) *m_cancelled = true;
  m_cancelled = std::make_shared<std::atomic<bool>>(false);
  m_compareTimer.stop();
  m_compared.reset();
  m_estimate.reset();
  for (QWidget* waits : {static_cast<QWidget*>(m_offset), static_cast<QWidget*>(m_drift),
                         static_cast<QWidget*>(m_useEstimate), static_cast<QWidget*>(m_join)}) {
    waits->setEnabled(false);
  }
  m_robot->setEnabled(m_robot->count() > 0);
  m_offsetEstimate->clear();
  m_driftEstimate->clear();
  m_effect->clear();
  m_agreement->clear();
  m_view->show({});
  showMessage(QStringLiteral("Comparing the clocks…"), false);
  const int mine = ++m_jobs;
  m_worker.start([this, mine, robot, files = m_files, session = m_session, recording = m_recording,
                  cancelled = m_cancelled] {
    const auto made = [&]() -> Result<Read> {
      TRY(files->open(session, recording));
      Read read;
      read.targets = link::joinTargets(*files->session, *files->recording);
      read.notes = files->recording->notes();
      read.files = files->recording->files();
      read.length = files->recording->range().end - files->recording->range().begin;
      read.clocksApart =
          std::chrono::duration<double>(files->recording->start() - files->session->info().start)
              .count();
      // Without a robot of that number, the first one is a beginning.
      const bool isKnown = read.targets.empty() || read.targets.front().isProposed;
      const std::string wanted = robot.empty() && !isKnown ? read.targets.front().robot : robot;
      read.compared = std::make_shared<const link::ComparedTarget>(TRY(link::compareTarget(
          *files->session, *files->recording, wanted, [&cancelled] { return !*cancelled; })));
      return read;
    }();
    m_toUi.post([this, made, mine] {
      if (mine == m_jobs) show(made);
    });
  });
}

void JoinDialog::show(const Result<Read>& read) {
  if (!read) {
    showMessage(QString::fromStdString(read.error().message), true);
    return;
  }
  m_compared = read->compared;
  const link::JoinTarget& target = m_compared->target;
  QString what = QFileInfo(QString::fromStdString(m_recording)).fileName();
  if (read->files > 1) {
    what += QStringLiteral(" and %1 more %2")
                .arg(read->files - 1)
                .arg(read->files == 2 ? QStringLiteral("file") : QStringLiteral("files"));
  }
  m_what->setText(what + QStringLiteral(", ") + durationText(read->length));
  if (m_robot->count() == 0) {
    for (const link::JoinTarget& one : read->targets) {
      const QString name = QString::fromStdString(one.robot);
      m_robot->addItem(one.isBoard ? name : name + QStringLiteral(" (messages)"), name);
    }
  }
  m_robot->setCurrentIndex(m_robot->findData(QString::fromStdString(target.robot)));
  for (QWidget* ready : {static_cast<QWidget*>(m_robot), static_cast<QWidget*>(m_offset),
                         static_cast<QWidget*>(m_drift), static_cast<QWidget*>(m_join)}) {
    ready->setEnabled(true);
  }
  m_effect->setText(
      target.isBoard
          ? QStringLiteral("The recording replaces the received values of %1 while it lasts.")
                .arg(m_robot->currentText())
          : QStringLiteral("No blackboard of %1 was received. The recording is added beside its "
                           "messages.")
                .arg(QString::fromStdString(target.robot)));
  QStringList notes;
  for (const std::string& note : read->notes) notes << QString::fromStdString(note);
  const Result<link::ClockFit>& fit = m_compared->fit;
  if (fit) {
    const link::RobotClock& found = fit->clock;
    m_offsetEstimate->setText(
        QStringLiteral("estimated %1 s %2 ms")
            .arg(withSign(found.offset, 3), plusMinus(1e3 * 2.0 * fit->offsetError, 1)));
    m_driftEstimate->setText(
        QStringLiteral("estimated %1 ppm %2")
            .arg(withSign(found.drift / ppm, 1), plusMinus(2.0 * fit->driftError / ppm, 1)));
    showClock(found);
    m_estimate = clock();
  } else {
    // What the computers' clocks say is a beginning.
    showClock({std::abs(read->clocksApart) < mostOffset ? read->clocksApart : 0.0, 0.0});
    notes.prepend(QString::fromStdString(fit.error().message));
  }
  showMessage(notes.join(QLatin1Char(' ')), !fit);
  m_compareTimer.stop();
  compare();
}

void JoinDialog::showClock(const link::RobotClock& clock) {
  m_offset->setValue(clock.offset);
  m_drift->setValue(clock.drift / ppm);
}

link::RobotClock JoinDialog::clock() const {
  return {m_offset->value(), m_drift->value() * ppm};
}

bool JoinDialog::isEstimate() const {
  return m_estimate && clock() == *m_estimate;
}

void JoinDialog::compareSoon() {
  if (!m_compared) return;
  m_useEstimate->setEnabled(m_estimate && !isEstimate());
  m_compareTimer.start();
}

void JoinDialog::compare() {
  if (!m_compared) return;
  // The boxes round the estimate.
  const link::RobotClock shown = isEstimate() ? m_compared->fit->clock : clock();
  const int mine = ++m_jobs;
  m_worker.start([this, mine, shown, compared = m_compared] {
    const link::ClockAgreement found = compared->comparison.agreement(shown);
    m_toUi.post([this, found, mine] {
      if (mine == m_jobs) showAgreement(found);
    });
  });
}

void JoinDialog::showAgreement(const link::ClockAgreement& agreement) {
  QString text = QStringLiteral("%1 of %2 changes agree")
                     .arg(countText(agreement.agree), countText(agreement.changes));
  if (agreement.agree > 0) {
    text +=
        QStringLiteral(" (%1 %), residual %2 ms, 90 % within %3 ms")
            .arg(numberText(100.0 * agreement.share(), 0), numberText(1e3 * agreement.residual, 1),
                 numberText(1e3 * agreement.spread, 0));
  }
  QPalette colours = palette();
  if (agreement.share() < poorShare) colours.setColor(QPalette::WindowText, theme().warningText);
  m_agreement->setPalette(colours);
  m_agreement->setText(text);
  m_view->show(agreement);
}

void JoinDialog::showMessage(const QString& sentence, bool bad) {
  QPalette colours = palette();
  if (bad) colours.setColor(QPalette::WindowText, theme().errorText);
  m_message->setPalette(colours);
  m_message->setText(sentence);
  m_message->setVisible(!sentence.isEmpty());
}

}  // namespace pitchboard::ui
