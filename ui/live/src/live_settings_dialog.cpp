// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/live/live_settings_dialog.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QSettings>
#include <QSpinBox>
#include <QTabWidget>
#include <QVBoxLayout>
#include <algorithm>

#include <ui/base/dialog_size.h>
#include <ui/base/explanation.h>
#include <ui/base/number_box.h>
#include <ui/base/theme.h>
#include <ui/sources/live_controller.h>

#include "network_chooser.h"
#include "profile_editor.h"
#include "teams_page.h"

namespace pitchboard::ui {
namespace {

/// As high as its sentences need at its width: a page of tabs asks for less.
class WholePage : public QWidget {
 public:
  using QWidget::QWidget;

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QWidget::resizeEvent(event);
    setMinimumHeight(layout()->heightForWidth(width()));
  }
};

QFormLayout* formOf(QGroupBox* group) {
  auto* form = new QFormLayout(group);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  return form;
}

}  // namespace

LiveSettingsDialog::LiveSettingsDialog(LiveController* live, QSettings* settings, QWidget* parent)
    : QDialog(parent), m_live(live), m_settings(settings) {
  setObjectName(QStringLiteral("liveSettings"));
  setWindowTitle(QStringLiteral("Live settings"));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* tabs = new QTabWidget(this);
  tabs->setObjectName(QStringLiteral("liveTabs"));
  tabs->addTab(makeGeneral(), QStringLiteral("General"));
  m_teams = new TeamsPage(live, this);
  tabs->addTab(m_teams, QStringLiteral("Teams"));
  // On a small screen the pages scroll, and the buttons stay in sight.
  auto* pages = new QScrollArea(this);
  pages->setFrameShape(QFrame::NoFrame);
  pages->setWidgetResizable(true);
  pages->setWidget(tabs);
  m_problem = new QLabel(this);
  m_problem->setObjectName(QStringLiteral("liveProblem"));
  m_problem->setWordWrap(true);
  m_problem->hide();
  auto* buttons = new QDialogButtonBox(
      QDialogButtonBox::Ok | QDialogButtonBox::Apply | QDialogButtonBox::Cancel, this);
  connect(buttons, &QDialogButtonBox::accepted, this, [this] {
    if (apply()) accept();
  });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(buttons->button(QDialogButtonBox::Apply), &QPushButton::clicked, this,
          &LiveSettingsDialog::apply);
  auto* column = new QVBoxLayout(this);
  column->addWidget(pages, 1);
  column->addWidget(m_problem);
  column->addWidget(buttons);
  resize(dialogSize(this, 760, 560));
  adopt();
}

QSpinBox* LiveSettingsDialog::addNumber(QFormLayout* form, const char* name, const QString& label,
                                        int low, int high, const QString& tip) {
  auto* box = new QSpinBox(this);
  box->setObjectName(QLatin1String(name));
  box->setRange(low, high);
  box->setToolTip(tip);
  form->addRow(label, box);
  return box;
}

NumberBox* LiveSettingsDialog::addReal(QFormLayout* form, const char* name, const QString& label,
                                       double low, double high, int decimals, const QString& unit,
                                       const QString& tip) {
  auto* box = new NumberBox(this);
  box->setObjectName(QLatin1String(name));
  box->setDecimals(decimals);
  box->setRange(low, high);
  box->setSingleStep(decimals > 1 ? 0.05 : 1.0);
  box->setSuffix(unit);
  box->setToolTip(tip);
  form->addRow(label, box);
  return box;
}

// Two columns of about the same height.
QWidget* LiveSettingsDialog::makeGeneral() {
  auto* widget = new WholePage(this);
  auto* columns = new QHBoxLayout(widget);
  const auto add = [columns](QWidget* upper, QWidget* lower) {
    auto* column = new QVBoxLayout;
    column->addWidget(upper);
    column->addWidget(lower);
    column->addStretch(1);
    columns->addLayout(column, 1);
  };
  add(makeNetwork(), makeRobots());
  add(makeReferee(), makeMessages());
  return widget;
}

QWidget* LiveSettingsDialog::makeNetwork() {
  auto* widget = new QGroupBox(QStringLiteral("Network"), this);
  QFormLayout* form = formOf(widget);
  m_bind = new NetworkChooser(widget);
  m_bind->setObjectName(QStringLiteral("bind"));
  m_bind->setToolTip(
      QStringLiteral("Every interface: all addresses of this computer, including broadcasts. A "
                     "single address receives no broadcasts. You can also type an address"));
  form->addRow(QStringLiteral("Listen on"), m_bind);
  m_portBase = addNumber(form, "portBase", QStringLiteral("Port base"), 0, 65534,
                         QStringLiteral("Robot n sends to port base + n"));
  m_robots = addNumber(form, "robots", QStringLiteral("Robots"), 1, 64,
                       QStringLiteral("Number of ports after the base"));
  m_variablesPortBase =
      addNumber(form, "variablesPortBase", QStringLiteral("Variables port base"), 0, 65534,
                QStringLiteral("pitchboard-agent on robot n sends to this base + n"));
  m_variablesPortBase->setSpecialValueText(QStringLiteral("off"));
  m_senders = new QLineEdit(widget);
  m_senders->setObjectName(QStringLiteral("senders"));
  m_senders->setPlaceholderText(QStringLiteral("everybody"));
  m_senders->setToolTip(
      QStringLiteral("Addresses and networks of robots, e.g. 192.168.0.7, 192.168.1.0/24. Empty: "
                     "accept all. The referee has its own list"));
  form->addRow(QStringLiteral("Accept robots from"), m_senders);
  form->addRow(makeExplanation(
      QStringLiteral("If another program uses a port, the status bar names it and Live tries again "
                     "every three seconds. The other ports keep working."),
      widget));
  return widget;
}

QWidget* LiveSettingsDialog::makeRobots() {
  auto* widget = new QGroupBox(QStringLiteral("Robots"), this);
  QFormLayout* form = formOf(widget);
  m_timeout =
      addReal(form, "timeout", QStringLiteral("Timeout after"), 0.1, 3600, 1, QStringLiteral(" s"),
              QStringLiteral("A robot that sends nothing for this time is greyed out"));
  m_cells = addNumber(
      form, "cells", QStringLiteral("Battery cells"), 0, 24,
      QStringLiteral(
          "Cells in series. Automatic: the smallest number that fits the highest voltage seen"));
  m_cells->setSpecialValueText(QStringLiteral("automatic"));
  const QString volts = QStringLiteral(" V per cell");
  m_full = addReal(form, "full", QStringLiteral("Full at"), 0.1, 10, 2, volts, {});
  m_low = addReal(form, "low", QStringLiteral("Low below"), 0.1, 10, 2, volts,
                  QStringLiteral("Shown in red"));
  m_empty = addReal(form, "empty", QStringLiteral("Empty at"), 0.0, 10, 2, volts, {});
  m_colours = new QComboBox(widget);
  m_colours->addItem(QStringLiteral("team colour"), false);
  m_colours->addItem(QStringLiteral("by robot number"), true);
  form->addRow(QStringLiteral("Robot colours"), m_colours);
  m_field = new QComboBox(widget);
  for (const sim::FieldSpec& field : sim::builtInFields()) {
    m_field->addItem(QStringLiteral("%1: %2 × %3 m")
                         .arg(QString::fromStdString(field.name))
                         .arg(field.length)
                         .arg(field.width),
                     QString::fromStdString(field.name));
  }
  form->addRow(QStringLiteral("Field"), m_field);
  return widget;
}

QWidget* LiveSettingsDialog::makeReferee() {
  auto* widget = new QGroupBox(QStringLiteral("Referee"), this);
  QFormLayout* form = formOf(widget);
  m_refereePort = addNumber(form, "refereePort", QStringLiteral("Port"), 1, 65535,
                            QStringLiteral("All GameControllers so far use 3838"));
  m_refereeVersion = new QComboBox(widget);
  m_refereeVersion->setObjectName(QStringLiteral("refereeVersion"));
  m_refereeVersion->addItem(QStringLiteral("highest received"), 0);
  constexpr int versions[] = {7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20};
  for (const int version : versions) {
    m_refereeVersion->addItem(QStringLiteral("only %1").arg(version), version);
  }
  m_refereeVersion->setToolTip(
      QStringLiteral("GameControllers of 2014 to 2016 also send version 7, and two GameControllers "
                     "may run at once"));
  form->addRow(QStringLiteral("Packet version"), m_refereeVersion);
  m_refereeSenders = new QLineEdit(widget);
  m_refereeSenders->setObjectName(QStringLiteral("refereeSenders"));
  m_refereeSenders->setPlaceholderText(QStringLiteral("everybody"));
  m_refereeSenders->setToolTip(QStringLiteral(
      "Addresses and networks of the referee's computer. Packets from others are only counted"));
  form->addRow(QStringLiteral("Accept referee from"), m_refereeSenders);
  m_ourTeam = addNumber(
      form, "ourTeam", QStringLiteral("Our team's number"), 0, 65535,
      QStringLiteral("As in the GameController. Cards and field show the penalties of this team"));
  m_ourTeam->setSpecialValueText(QStringLiteral("not chosen"));
  m_monitor = new QCheckBox(QStringLiteral("Ask the referee for monitor mode"), widget);
  m_monitor->setObjectName(QStringLiteral("monitor"));
  m_monitorAddress = new QLineEdit(widget);
  m_monitorAddress->setObjectName(QStringLiteral("monitorAddress"));
  m_monitorAddress->setPlaceholderText(QStringLiteral("IP address"));
  connect(m_monitor, &QCheckBox::toggled, m_monitorAddress, &QWidget::setEnabled);
  form->addRow(m_monitor);
  form->addRow(QStringLiteral("Referee at"), m_monitorAddress);
  form->addRow(makeExplanation(
      QStringLiteral("GameControllers of 2026 send more data to programs that ask for it. While "
                     "this is on, Live sends one packet of five bytes (RGTr and a zero) per second "
                     "to UDP port 3636 of that address. Live never sends anything else and never "
                     "sends to robots. This is off at every start."),
      widget));
  return widget;
}

QWidget* LiveSettingsDialog::makeMessages() {
  auto* widget = new QGroupBox(QStringLiteral("Messages"), this);
  QFormLayout* form = formOf(widget);
  m_profileName = new QLabel(widget);
  m_profileName->setObjectName(QStringLiteral("profileName"));
  m_profileName->setWordWrap(true);
  form->addRow(QStringLiteral("Order of fields"), m_profileName);
  auto* row = new QHBoxLayout;
  const auto add = [&](const QString& text, const char* name, auto slot) {
    auto* button = new QPushButton(text, widget);
    button->setObjectName(QLatin1String(name));
    connect(button, &QPushButton::clicked, this, slot);
    row->addWidget(button);
  };
  add(QStringLiteral("Published"), "publishedProfile", [this] {
    m_profile = telemetry::publishedProfile();
    m_profileFile.clear();
    showProfile();
  });
  add(QStringLiteral("From file…"), "profileFromFile", [this] { chooseProfile(); });
  add(QStringLiteral("Edit…"), "editProfile", [this] { editProfile(); });
  row->addStretch(1);
  form->addRow(row);
  form->addRow(makeExplanation(
      QStringLiteral("Teams add fields of their own. A profile lists the fields of a message in "
                     "order, with their meaning. Further fields are shown as OTHER_1, OTHER_2, …"),
      widget));
  return widget;
}

void LiveSettingsDialog::adopt() {
  const link::LiveOptions& o = m_live->options();
  const LiveSettings saved = loadLiveSettings(*m_settings);
  m_bind->setAddress(QString::fromStdString(o.bind.text()));
  m_portBase->setValue(o.portBase);
  m_robots->setValue(o.robots);
  m_variablesPortBase->setValue(o.variablesPortBase);
  m_refereePort->setValue(o.refereePort);
  m_senders->setText(saved.senders);
  m_refereeSenders->setText(saved.refereeSenders);
  m_refereeVersion->setCurrentIndex(std::max(0, m_refereeVersion->findData(o.refereeVersion)));
  m_timeout->setValue(std::chrono::duration<double>(o.team.timeout).count());
  m_cells->setValue(o.team.battery.cells);
  m_full->setValue(o.team.battery.fullPerCell);
  m_low->setValue(o.team.battery.lowPerCell);
  m_empty->setValue(o.team.battery.emptyPerCell);
  m_colours->setCurrentIndex(o.colourByNumber ? 1 : 0);
  m_field->setCurrentIndex(m_field->findData(QString::fromStdString(o.field.name)));
  m_ourTeam->setValue(o.ourTeam);
  m_monitor->setChecked(o.monitor.has_value());
  m_monitorAddress->setEnabled(o.monitor.has_value());
  QString address = saved.monitorAddress;
  if (const FramePtr frame = m_live->frame(); address.isEmpty() && frame && frame->referee) {
    address = QString::fromStdString(frame->referee->sender).section(QLatin1Char(':'), 0, 0);
  }
  m_monitorAddress->setText(o.monitor ? QString::fromStdString(o.monitor->text()) : address);
  m_teams->setTeams(o.team.teams);
  m_profile = o.profile;
  m_profileFile = saved.profileFile;
  showProfile();
}

void LiveSettingsDialog::showProfile() {
  m_profileName->setText((m_profileFile.isEmpty()
                              ? QStringLiteral("%1, %2 fields")
                              : QStringLiteral("%1, %2 fields, from %3")
                                    .arg(QStringLiteral("%1"), QStringLiteral("%2"),
                                         QFileInfo(m_profileFile).fileName()))
                             .arg(QString::fromStdString(m_profile.name))
                             .arg(m_profile.fields.size()));
  m_profileName->setToolTip(m_profileFile);
}

void LiveSettingsDialog::chooseProfile() {
  auto* ask = new QFileDialog(this, QStringLiteral("Message profile"),
                              QFileInfo(m_profileFile).path(), QStringLiteral("Profiles (*.json)"));
  ask->setAttribute(Qt::WA_DeleteOnClose);
  ask->setFileMode(QFileDialog::ExistingFile);
  connect(ask, &QFileDialog::fileSelected, this, [this](const QString& file) {
    auto loaded = telemetry::loadProfile(file.toStdString());
    if (!loaded) {
      fail(QString::fromStdString(loaded.error().text()));
      return;
    }
    m_problem->hide();
    m_profile = std::move(*loaded);
    m_profileFile = file;
    showProfile();
  });
  ask->open();
}

void LiveSettingsDialog::editProfile() {
  auto* editor = new ProfileEditor(m_profile, m_profileFile, this, m_live);
  connect(editor, &ProfileEditor::saved, this,
          [this](const telemetry::Profile& profile, const QString& file) {
            m_profile = profile;
            m_profileFile = file;
            showProfile();
          });
  editor->show();
}

bool LiveSettingsDialog::fail(const QString& sentence) {
  QPalette red = m_problem->palette();
  red.setColor(QPalette::WindowText, theme().errorText);
  m_problem->setPalette(red);
  m_problem->setText(sentence);
  m_problem->show();
  return false;
}

bool LiveSettingsDialog::read(LiveSettings& live) {
  link::LiveOptions& o = live.options;
  const auto message = [](const Error& error) { return QString::fromStdString(error.text()); };
  const auto bind = telemetry::parseAddress(m_bind->address().toStdString());
  if (!bind) return fail(QStringLiteral("Listen on: %1").arg(message(bind.error())));
  o.bind = *bind;
  o.portBase = m_portBase->value();
  o.robots = m_robots->value();
  o.variablesPortBase = m_variablesPortBase->value();
  o.refereePort = m_refereePort->value();
  live.senders = m_senders->text();
  auto senders = sendersFromText(live.senders);
  if (!senders) return fail(QStringLiteral("Accept robots from: %1").arg(message(senders.error())));
  o.team.senders = std::move(*senders);
  live.refereeSenders = m_refereeSenders->text();
  auto referees = sendersFromText(live.refereeSenders);
  if (!referees)
    return fail(QStringLiteral("Accept referee from: %1").arg(message(referees.error())));
  o.refereeSenders = std::move(*referees);
  o.refereeVersion = m_refereeVersion->currentData().toInt();
  o.team.timeout = std::chrono::milliseconds(qRound64(m_timeout->value() * 1000));
  o.team.battery = {m_cells->value(), m_full->value(), m_low->value(), m_empty->value()};
  if (!(o.team.battery.emptyPerCell < o.team.battery.lowPerCell &&
        o.team.battery.lowPerCell < o.team.battery.fullPerCell)) {
    return fail(QStringLiteral("Battery: empty must be less than low, and low less than full."));
  }
  o.colourByNumber = m_colours->currentData().toBool();
  if (const auto field = sim::fieldByName(m_field->currentData().toString().toStdString())) {
    o.field = *field;
  }
  o.ourTeam = m_ourTeam->value();
  live.monitorAddress = m_monitorAddress->text().trimmed();
  o.monitor.reset();
  if (m_monitor->isChecked()) {
    const auto referee = telemetry::parseAddress(live.monitorAddress.toStdString());
    if (!referee) return fail(QStringLiteral("Referee at: %1").arg(message(referee.error())));
    o.monitor = *referee;
  }
  auto teams = m_teams->teams();
  if (!teams) return fail(QStringLiteral("Teams: %1").arg(message(teams.error())));
  o.team.teams = std::move(*teams);
  o.profile = m_profile;
  live.profileFile = m_profileFile;
  if (const auto good = link::validate(o); !good) return fail(message(good.error()));
  return true;
}

bool LiveSettingsDialog::apply() {
  LiveSettings live;
  live.options = m_live->options();
  if (!read(live)) return false;
  m_problem->hide();
  saveLiveSettings(*m_settings, live);
  m_live->setOptions(live.options);
  return true;
}

void showLiveSettings(LiveController* live, QSettings* settings, QWidget* window) {
  auto* dialog = window->findChild<LiveSettingsDialog*>();
  if (dialog == nullptr) dialog = new LiveSettingsDialog(live, settings, window);
  dialog->show();
  dialog->raise();
  dialog->activateWindow();
}

}  // namespace pitchboard::ui
