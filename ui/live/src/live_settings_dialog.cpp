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
#include <ui/base/file_dialog.h>
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

QFormLayout* formOf(const QGroupBox* group) {
  return static_cast<QFormLayout*>(group->layout());
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

QGroupBox* LiveSettingsDialog::makeGroup(const char* name) {
  auto* group = new QGroupBox(QString::fromUtf8(name), this);
  auto* form = new QFormLayout(group);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  for (const auto& option : link::liveOptionTable()) {
    if (option.info.title == nullptr || option.info.group != std::string_view(name)) continue;
    OptionField field;
    if (option.info.key == std::string_view("bind")) {
      auto* networks = new NetworkChooser(group);
      field = {networks, [networks]() -> OptionValue { return networks->address().toStdString(); },
               [networks](const OptionValue& value) {
                 networks->setAddress(QString::fromStdString(optionText(value)));
               }};
    }
    m_options.add(form, option, group, std::move(field));
  }
  return group;
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
  add(makeNetwork(), makeGroup("Robots"));
  add(makeReferee(), makeMessages());
  return widget;
}

QWidget* LiveSettingsDialog::makeNetwork() {
  QGroupBox* widget = makeGroup("Network");
  formOf(widget)->addRow(makeExplanation(
      QStringLiteral("If another program uses a port, the status bar names it and Live tries again "
                     "every three seconds. The program that was started first gets what robots "
                     "send to this computer alone; all get broadcasts."),
      widget));
  return widget;
}

QWidget* LiveSettingsDialog::makeReferee() {
  QGroupBox* widget = makeGroup("Referee");
  QFormLayout* form = formOf(widget);
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
  QGroupBox* widget = makeGroup("Messages");
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
  m_options.show(o);
  m_monitor->setChecked(o.monitor.has_value());
  m_monitorAddress->setEnabled(o.monitor.has_value());
  QString address = saved.monitorAddress;
  if (const FramePtr frame = m_live->frame(); address.isEmpty() && frame && frame->game) {
    address = QString::fromStdString(frame->reception.sender).section(QLatin1Char(':'), 0, 0);
  }
  m_monitorAddress->setText(o.monitor ? QString::fromStdString(o.monitor->text()) : address);
  m_teams->setTeams(o.team.teams);
  m_profile = o.profile;
  m_profileFile = QString::fromStdString(o.profileFile);
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
  auto* ask = new QFileDialog(this, QStringLiteral("Message profile"), {},
                              QStringLiteral("Profiles (*.json)"));
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
  openInDialogFolder(ask);
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
  if (const auto set = m_options.read(o); !set) return fail(message(set.error()));
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
  o.profileFile = m_profileFile.toStdString();
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
