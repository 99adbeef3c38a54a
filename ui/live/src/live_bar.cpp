// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/live/live_bar.h>

#include <QAbstractItemView>
#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QSettings>
#include <QToolButton>
#include <algorithm>

#include <ui/base/file_dialog.h>
#include <ui/base/theme.h>
#include <ui/live/live_settings_dialog.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/live_settings.h>

namespace pitchboard::ui {

LiveBar::LiveBar(LiveController* live, QSettings* settings, QWidget* parent)
    : QWidget(parent),
      m_live(live),
      m_settings(settings),
      m_ports(new QToolButton(this)),
      m_team(new QComboBox(this)),
      m_monitor(new QToolButton(this)),
      m_catalog(new QToolButton(this)) {
  constexpr Beat::Milliseconds most{500};
  m_ports->setObjectName(QStringLiteral("livePorts"));
  m_ports->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  m_ports->setIcon(themedIcon(QStringLiteral("configure")));
  connect(m_ports, &QToolButton::clicked, this,
          [this] { showLiveSettings(m_live, m_settings, window()); });
  m_team->setObjectName(QStringLiteral("ourTeam"));
  connect(m_team, &QComboBox::activated, this, [this](int at) {
    m_live->setOurTeam(m_team->itemData(at).toInt());
    m_settings->setValue(QStringLiteral("live/ourTeam"), m_team->itemData(at));
  });
  m_monitor->setObjectName(QStringLiteral("monitorMode"));
  m_monitor->setCheckable(true);
  m_monitor->setText(QStringLiteral("Monitor"));
  m_monitor->setIcon(themedIcon(QStringLiteral("visibility")));
  connect(m_monitor, &QToolButton::clicked, this, &LiveBar::switchMonitor);
  m_catalog->setObjectName(QStringLiteral("importCatalog"));
  m_catalog->setText(QStringLiteral("Import catalog…"));
  m_catalog->setIcon(themedIcon(QStringLiteral("document-import")));
  m_catalog->hide();
  connect(m_catalog, &QToolButton::clicked, this, &LiveBar::importCatalog);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(m_ports);
  row->addWidget(m_team);
  row->addWidget(m_monitor);
  row->addWidget(m_catalog);
  setAvailableWidth(Width::Wide);
  m_refresh = Beat::display().add(
      this, most, [this] { refresh(); }, most);
  connect(live, &LiveController::optionsChanged, this, &LiveBar::refresh);
  refresh();
}

void LiveBar::setAvailableWidth(Width width) {
  const bool least = width == Width::Least;
  m_ports->setToolButtonStyle(width == Width::Wide ? Qt::ToolButtonTextBesideIcon
                                                   : Qt::ToolButtonIconOnly);
  // With their texts both would push the whole bar out of the tool bar.
  for (QToolButton* one : {m_monitor, m_catalog}) {
    one->setToolButtonStyle(width == Width::Wide ? Qt::ToolButtonTextOnly : Qt::ToolButtonIconOnly);
  }
  m_team->setFixedWidth(scaled(this, least ? 136 : 150));
  layout()->setSpacing(scaled(this, least ? 2 : 8));
}

void LiveBar::refresh() {
  const link::LiveOptions& options = m_live->options();
  m_ports->setText(m_live->portsText());
  QStringList tip{
      QStringLiteral("Click to open Live settings."),
      options.bind.value == 0
          ? QStringLiteral("Listening on all addresses of this computer.")
          : QStringLiteral("Listening on %1.").arg(QString::fromStdString(options.bind.text()))};
  const link::LiveDetails details = m_live->details();
  for (const telemetry::PortStatus& port : details.network.ports) {
    if (!port.problem.empty()) tip << QString::fromStdString(port.problem);
  }
  if (!details.sharedPorts.empty()) tip << QString::fromStdString(details.sharedPorts);
  m_ports->setToolTip(tip.join(QLatin1Char('\n')));
  m_monitor->setChecked(options.monitor.has_value());
  m_monitor->setToolTip(
      options.monitor
          ? QStringLiteral("Monitor mode is on: Live asks the GameController at %1 for true data "
                           "once a second and sends nothing else.%2")
                .arg(QString::fromStdString(options.monitor->text()),
                     details.monitorProblem.empty()
                         ? QString()
                         : QLatin1Char('\n') + QString::fromStdString(details.monitorProblem))
          : QStringLiteral("Ask the GameController (2026) for monitor mode. When off, Live sends "
                           "nothing at all."));
  showTeams();
  offerCatalog(details);
}

void LiveBar::offerCatalog(const link::LiveDetails& details) {
  constexpr int mostNames = 6;
  QStringList tip;
  for (const link::SentStatus& sent : details.sent) {
    if (sent.unknown.empty()) continue;
    QStringList names;
    for (const std::string& name : sent.unknown) {
      if (names.size() < mostNames) names << QString::fromStdString(name);
    }
    const auto more = static_cast<int>(sent.unknown.size()) - mostNames;
    if (more > 0) names << QStringLiteral("and %1 more").arg(more);
    tip << QStringLiteral("%1 sends variables that are in no catalog: %2.")
               .arg(QString::fromStdString(sent.name), names.join(QStringLiteral(", ")));
  }
  m_catalog->setVisible(!tip.isEmpty());
  tip << QStringLiteral(
      "They are shown anyway. Import the team's blackboard.h, SharedMemory.py or .json to use its "
      "order and types.");
  m_catalog->setToolTip(tip.join(QLatin1Char('\n')));
}

void LiveBar::importCatalog() {
  auto* ask = new QFileDialog(window(), QStringLiteral("Import variable catalog"), {},
                              QStringLiteral("Catalogs (*.h *.hpp *.py *.json);;All files (*)"));
  ask->setObjectName(QStringLiteral("importCatalogDialog"));
  ask->setAttribute(Qt::WA_DeleteOnClose);
  ask->setFileMode(QFileDialog::ExistingFile);
  connect(ask, &QFileDialog::fileSelected, this, [this](const QString& file) {
    link::LiveOptions options = m_live->options();
    const std::string path = file.toStdString();
    std::erase(options.catalogs, path);
    options.catalogs.push_back(path);
    m_live->setOptions(options);  // says what is wrong with it
    saveLiveOption(*m_settings, "catalogs", m_live->options());
  });
  openInDialogFolder(ask);
}

void LiveBar::showTeams() {
  if (m_team->view()->isVisible()) return;
  struct Entry {
    QString text;
    int number;
    bool operator==(const Entry&) const = default;
  };
  QList<Entry> wanted{{QStringLiteral("Our team: choose"), 0}};
  const FramePtr frame = m_live->frame();
  const bool isColour = m_live->options().ourColour && m_live->options().ourTeam == 0;
  const int ours = isColour && frame ? frame->reception.ourTeam : m_live->options().ourTeam;
  // Packets have numbers; setups know the names.
  const std::vector<telemetry::TeamSetup>& setups = m_live->options().team.teams;
  const auto nameOf = [&setups](int number) {
    const auto known = std::ranges::find(setups, number, &telemetry::TeamSetup::number);
    return known == setups.end() || known->name.empty()
               ? QStringLiteral("Team %1").arg(number)
               : QStringLiteral("%1, team %2").arg(QString::fromStdString(known->name)).arg(number);
  };
  if (frame && frame->game) {
    for (const GameTeam& team : frame->game->teams) {
      wanted.append(
          {QStringLiteral("%1 (%2)").arg(
               nameOf(team.number), QString::fromStdString(std::string(info(team.colour).name))),
           team.number});
    }
  } else {
    for (const telemetry::TeamSetup& setup : setups) {
      if (setup.number > 0 && setup.number != ours) {
        wanted.append({nameOf(setup.number), setup.number});
      }
    }
  }
  const auto isOurs = [ours](const Entry& entry) { return entry.number == ours; };
  if (std::none_of(wanted.begin(), wanted.end(), isOurs)) {
    wanted.append({QStringLiteral("%1 (not in this game)").arg(nameOf(ours)), ours});
  }
  QList<Entry> shown;
  for (int i = 0; i < m_team->count(); ++i) {
    shown.append({m_team->itemText(i), m_team->itemData(i).toInt()});
  }
  if (shown != wanted) {
    m_team->clear();
    for (const Entry& entry : wanted) m_team->addItem(entry.text, entry.number);
  }
  m_team->setCurrentIndex(m_team->findData(ours));
  m_team->setToolTip(
      QStringLiteral("Your team: cards and field show its penalties. The list has the teams that "
                     "the referee announces."));
}

void LiveBar::switchMonitor(bool on) {
  if (!on) {
    m_live->setMonitor({});
    return;
  }
  const QString saved = m_settings->value(QStringLiteral("live/monitorAddress")).toString();
  if (const auto address = telemetry::parseAddress(saved.toStdString())) {
    m_live->setMonitor(*address);
  } else {
    // Whom to ask is not known yet.
    m_monitor->setChecked(false);
    showLiveSettings(m_live, m_settings, window());
  }
}

}  // namespace pitchboard::ui
