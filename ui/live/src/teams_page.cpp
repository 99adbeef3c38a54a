// SPDX-License-Identifier: GPL-3.0-or-later
#include "teams_page.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QSpinBox>
#include <QTableWidget>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <utility>

#include <robotlink/live/live_teams.h>
#include <ui/base/file_dialog.h>
#include <ui/base/table_style.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

const QString profileFromFile = QStringLiteral("from a file…");

QIcon swatch(TeamColor colour) {
  constexpr int side = 16;
  QPixmap pixels(side, side);
  pixels.fill(theme().team(colour));
  return pixels;
}

}  // namespace

TeamsPage::TeamsPage(LiveController* live, QWidget* parent)
    : QWidget(parent), m_live(live), m_arrivals(live) {
  constexpr int refreshMilliseconds = 500;
  for (const std::string& name : telemetry::builtInProfiles()) {
    if (auto profile = telemetry::loadProfile(name)) {
      m_known.push_back({QString::fromStdString(name),
                         std::make_shared<const telemetry::TextDecoder>(std::move(*profile))});
    }
  }
  auto* top = new QHBoxLayout;
  top->addLayout(makeList());
  m_form = makeForm();
  top->addWidget(m_form, 1);
  auto* title = new QLabel(QStringLiteral("Incoming messages (preview)"), this);
  title->setFont(themeFont(TypeRole::Secondary));
  m_table = new QTableWidget(0, 5, this);
  m_table->setObjectName(QStringLiteral("teamPreview"));
  m_table->setHorizontalHeaderLabels({QStringLiteral("From"), QStringLiteral("Port"),
                                      QStringLiteral("Messages"), QStringLiteral("Robot"),
                                      QStringLiteral("Content")});
  styleTable(m_table);
  const int widths[] = {110, 55, 84, 150};
  for (int column = 0; column < 4; ++column) {
    m_table->setColumnWidth(column, scaled(this, widths[column]));
  }
  m_message = new QLabel(this);
  m_message->setObjectName(QStringLiteral("teamMessage"));
  m_message->setWordWrap(true);
  auto* column = new QVBoxLayout(this);
  column->addLayout(top);
  column->addWidget(title);
  column->addWidget(m_table, 1);
  column->addWidget(m_message);
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, [this] {
    if (isVisible()) preview();
  });
  timer->start(refreshMilliseconds);
  setTeams({});
}

QLayout* TeamsPage::makeList() {
  m_list = new QListWidget(this);
  m_list->setObjectName(QStringLiteral("teams"));
  m_list->setFixedWidth(scaled(this, 150));
  connect(m_list, &QListWidget::currentRowChanged, this, &TeamsPage::show);
  auto* buttons = new QGridLayout;
  const auto addButton = [&](int place, const char* name, const QString& words, const QString& tip,
                             auto slot) {
    auto* button = new QToolButton(this);
    button->setObjectName(QLatin1String(name));
    button->setText(words);
    button->setToolTip(tip);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    connect(button, &QToolButton::clicked, this, slot);
    buttons->addWidget(button, place / 2, place % 2);
    return button;
  };
  addButton(0, "addTeam", QStringLiteral("Add"), QStringLiteral("Add a team"), [this] {
    add(draftOf(telemetry::TeamSetup()));
    m_name->setFocus();
  });
  m_remove = addButton(1, "removeTeam", QStringLiteral("Remove"),
                       QStringLiteral("Remove this team"), [this] {
                         const int place = m_list->currentRow();
                         if (place < 0) return;
                         m_drafts.erase(m_drafts.begin() + place);
                         delete m_list->takeItem(place);
                         show(m_list->currentRow());
                         preview();
                       });
  addButton(2, "loadTeam", QStringLiteral("Open…"), QStringLiteral("Load a team setup from a file"),
            [this] { ask(false); });
  m_save = addButton(3, "saveTeam", QStringLiteral("Save as…"),
                     QStringLiteral("Save this team as a file, for --team or another computer"),
                     [this] { ask(true); });
  auto* column = new QVBoxLayout;
  m_empty = makeEmptyLabel(m_list->viewport(), QStringLiteral("noTeams"));
  m_empty->setText(QStringLiteral(
      "All robots count as one team. Add a team to give it a name, ports and a message profile."));
  auto* inList = new QVBoxLayout(m_list->viewport());
  inList->setContentsMargins(0, 0, 0, 0);
  inList->addWidget(m_empty);
  column->addWidget(m_list, 1);
  column->addLayout(buttons);
  return column;
}

QWidget* TeamsPage::makeForm() {
  auto* widget = new QWidget(this);
  auto* form = new QFormLayout(widget);
  form->setContentsMargins(0, 0, 0, 0);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  const auto addLine = [&](const char* name, const QString& label, const QString& placeholder) {
    auto* edit = new QLineEdit(widget);
    edit->setObjectName(QLatin1String(name));
    edit->setPlaceholderText(placeholder);
    connect(edit, &QLineEdit::textEdited, this, &TeamsPage::take);
    form->addRow(label, edit);
    return edit;
  };
  const auto addSpin = [&](const char* name, int most, const QString& none) {
    auto* box = new QSpinBox(widget);
    box->setObjectName(QLatin1String(name));
    box->setRange(0, most);
    box->setSpecialValueText(none);
    connect(box, &QSpinBox::valueChanged, this, &TeamsPage::take);
    return box;
  };
  m_name = addLine("teamName", QStringLiteral("Name"), QStringLiteral("looked up by the number"));
  m_number = addSpin("teamNumber", 65535, QStringLiteral("unknown"));
  m_number->setToolTip(QStringLiteral("Number of the team in the GameController"));
  m_colour = new QComboBox(widget);
  m_colour->setObjectName(QStringLiteral("teamColour"));
  m_colour->addItem(QStringLiteral("as the referee says"));
  for (const TeamColorInfo& colour : teamColors) {
    const QString name = QString::fromUtf8(colour.name);
    m_colour->addItem(swatch(colour.color), name, name);
  }
  connect(m_colour, &QComboBox::currentIndexChanged, this, &TeamsPage::take);
  auto* numbers = new QHBoxLayout;
  numbers->addWidget(m_number, 1);
  numbers->addWidget(new QLabel(QStringLiteral("Colour"), widget));
  numbers->addWidget(m_colour, 1);
  form->addRow(QStringLiteral("Number"), numbers);
  m_firstPort = addSpin("teamFirstPort", 65535, QStringLiteral("same as Live"));
  m_lastPort = addSpin("teamLastPort", 65535, QStringLiteral("first port only"));
  m_firstPort->setToolTip(QStringLiteral("UDP ports that this team sends to, at most 64"));
  auto* ports = new QHBoxLayout;
  ports->addWidget(m_firstPort, 1);
  ports->addWidget(new QLabel(QStringLiteral("to"), widget));
  ports->addWidget(m_lastPort, 1);
  form->addRow(QStringLiteral("Ports"), ports);
  m_senders = addLine("teamSenders", QStringLiteral("Only from"), QStringLiteral("all senders"));
  m_senders->setToolTip(
      QStringLiteral("Addresses and networks, e.g. 192.168.0.7, 192.168.18.0/24"));
  m_profile = new QComboBox(widget);
  m_profile->setObjectName(QStringLiteral("teamProfile"));
  m_profile->setToolTip(QStringLiteral("Format of the team's messages"));
  connect(m_profile, &QComboBox::activated, this, &TeamsPage::chooseProfile);
  m_attacks = new QComboBox(widget);
  m_attacks->setObjectName(QStringLiteral("teamAttacks"));
  m_attacks->addItems({QStringLiteral("plays to the right"), QStringLiteral("plays to the left")});
  m_attacks->setToolTip(QStringLiteral("Attack direction"));
  connect(m_attacks, &QComboBox::currentIndexChanged, this, &TeamsPage::take);
  auto* messages = new QHBoxLayout;
  messages->addWidget(m_profile, 1);
  messages->addWidget(m_attacks, 1);
  form->addRow(QStringLiteral("Messages"), messages);
  m_names = addLine("teamRobots", QStringLiteral("Robots"), QStringLiteral("1 Ana, 2 Bo"));
  m_names->setToolTip(QStringLiteral("Numbers and names of its robots, separated by commas"));
  return widget;
}

void TeamsPage::setTeams(const std::vector<telemetry::TeamSetup>& teams) {
  m_drafts.clear();
  m_list->clear();
  for (const telemetry::TeamSetup& team : teams) add(draftOf(team));
  m_list->setCurrentRow(teams.empty() ? -1 : 0);
  show(m_list->currentRow());
}

Result<std::vector<telemetry::TeamSetup>> TeamsPage::teams() const {
  std::vector<telemetry::TeamSetup> all;
  for (const TeamDraft& draft : m_drafts) {
    auto setup = setupOf(draft);
    if (!setup) return tl::unexpected(setup.error());
    all.push_back(std::move(*setup));
  }
  return all;
}

void TeamsPage::add(TeamDraft draft) {
  if (m_drafts.size() >= telemetry::TeamSetup::maxTeams) {
    return showStatus(QStringLiteral("Live can receive at most %1 teams. Remove one first.")
                          .arg(telemetry::TeamSetup::maxTeams),
                      true);
  }
  m_drafts.push_back(std::move(draft));
  m_list->addItem(QString());
  name(m_list->count() - 1);
  m_list->setCurrentRow(m_list->count() - 1);
  preview();
}

void TeamsPage::name(int place) {
  const telemetry::TeamSetup& setup = m_drafts[static_cast<std::size_t>(place)].setup;
  QListWidgetItem* item = m_list->item(place);
  item->setText(QString::fromStdString(setup.title()));
  const auto colour = teamColorNamed(setup.colour);
  item->setIcon(colour ? swatch(*colour) : QIcon());
}

void TeamsPage::show(int place) {
  const bool any = place >= 0 && static_cast<std::size_t>(place) < m_drafts.size();
  m_empty->setVisible(m_drafts.empty());
  m_form->setEnabled(any);
  m_remove->setEnabled(any);
  m_save->setEnabled(any);
  m_filling = true;
  const TeamDraft draft =
      any ? m_drafts[static_cast<std::size_t>(place)] : draftOf(telemetry::TeamSetup());
  const telemetry::TeamSetup& setup = draft.setup;
  m_name->setText(QString::fromStdString(setup.name));
  m_number->setValue(setup.number);
  m_colour->setCurrentIndex(std::max(0, m_colour->findData(QString::fromStdString(setup.colour))));
  m_firstPort->setValue(setup.firstPort);
  m_lastPort->setValue(setup.lastPort == setup.firstPort ? 0 : setup.lastPort);
  m_lastPort->setEnabled(setup.firstPort > 0);
  m_senders->setText(draft.senders);
  m_attacks->setCurrentIndex(setup.attacksLeft ? 1 : 0);
  m_names->setText(draft.robots);
  m_filling = false;
  fillProfiles();
}

TeamDraft* TeamsPage::current() {
  const int row = m_list->currentRow();
  return row >= 0 && static_cast<std::size_t>(row) < m_drafts.size()
             ? &m_drafts[static_cast<std::size_t>(row)]
             : nullptr;
}

void TeamsPage::fillProfiles() {
  const TeamDraft* draft = current();
  const std::string chosen = draft != nullptr ? draft->setup.profileName : "published";
  m_profile->clear();
  for (const std::string& name : telemetry::builtInProfiles()) {
    m_profile->addItem(QString::fromStdString(name), QString::fromStdString(name));
  }
  int index = m_profile->findData(QString::fromStdString(chosen));
  if (index < 0) {
    const QString path = QString::fromStdString(chosen);
    index = m_profile->count();
    m_profile->addItem(QFileInfo(path).fileName(), path);
    m_profile->setItemData(index, path, Qt::ToolTipRole);
  }
  m_profile->addItem(profileFromFile);
  m_profile->setCurrentIndex(index);
}

void TeamsPage::chooseProfile(int index) {
  const auto use = [this](const QString& name) {
    auto profile = telemetry::loadProfile(name.toStdString());
    TeamDraft* draft = current();
    if (draft == nullptr) return;
    if (profile) {
      draft->setup.profile = std::move(*profile);
      draft->setup.profileName = name.toStdString();
      showStatus({}, false);
    } else {
      showStatus(QString::fromStdString(profile.error().text()), true);
    }
    fillProfiles();
    preview();
  };
  if (m_profile->itemText(index) != profileFromFile)
    return use(m_profile->itemData(index).toString());
  fillProfiles();
  auto* ask = new QFileDialog(this, QStringLiteral("Message profile"), {},
                              QStringLiteral("Profiles (*.json)"));
  ask->setAttribute(Qt::WA_DeleteOnClose);
  ask->setFileMode(QFileDialog::ExistingFile);
  connect(ask, &QFileDialog::fileSelected, this, use);
  openInDialogFolder(ask);
}

void TeamsPage::take() {
  TeamDraft* draft = current();
  if (m_filling || draft == nullptr) return;
  telemetry::TeamSetup& setup = draft->setup;
  setup.name = m_name->text().trimmed().toStdString();
  setup.number = m_number->value();
  setup.colour = m_colour->currentData().toString().toStdString();
  setup.firstPort = m_firstPort->value();
  setup.lastPort = m_lastPort->value();
  m_lastPort->setEnabled(setup.firstPort > 0);
  setup.attacksLeft = m_attacks->currentIndex() == 1;
  draft->senders = m_senders->text();
  draft->robots = m_names->text();
  name(m_list->currentRow());
  const auto good = setupOf(*draft);
  showStatus(good ? QString() : QString::fromStdString(good.error().text()), true);
  preview();
}

Result<void> TeamsPage::load(const QString& path) {
  auto setup = telemetry::loadTeamSetup(path.toStdString());
  if (!setup) return tl::unexpected(setup.error());
  add(draftOf(*setup));
  return {};
}

Result<void> TeamsPage::save(const QString& path) {
  const TeamDraft* draft = current();
  if (draft == nullptr) return failure(ErrorCode::NotFound, "No team selected.");
  const auto setup = setupOf(*draft);
  if (!setup) return tl::unexpected(setup.error());
  return telemetry::saveTeamSetup(*setup, path.toStdString());
}

void TeamsPage::ask(bool save) {
  auto* dialog = new QFileDialog(this, QStringLiteral("Team setup"), {},
                                 QStringLiteral("Team setups (*.json)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(save ? QFileDialog::AcceptSave : QFileDialog::AcceptOpen);
  dialog->setFileMode(save ? QFileDialog::AnyFile : QFileDialog::ExistingFile);
  dialog->setDefaultSuffix(QStringLiteral("json"));
  connect(dialog, &QFileDialog::fileSelected, this, [this, save](const QString& path) {
    const auto done = save ? this->save(path) : load(path);
    showStatus(done ? QString() : QString::fromStdString(done.error().text()), true);
  });
  openInDialogFolder(dialog);
}

void TeamsPage::preview() {
  std::vector<telemetry::TeamSetup> setups;
  std::vector<std::uint16_t> ports;
  for (const TeamDraft& draft : m_drafts) {
    const auto setup = setupOf(draft);
    // What cannot be read yet keeps its place.
    setups.push_back(setup ? *setup : draft.setup);
    if (!setup) continue;
    for (int port = setup->firstPort; port > 0 && port <= setup->lastPort; ++port) {
      ports.push_back(static_cast<std::uint16_t>(port));
    }
  }
  m_arrivals.listenAt(ports);
  link::LiveOptions options = m_live->options();
  options.team.teams = std::move(setups);
  const std::vector<PreviewRow> rows = previewOf(m_arrivals.newest(), options, m_known);
  m_table->setRowCount(static_cast<int>(rows.size()));
  for (int row = 0; row < m_table->rowCount(); ++row) {
    const PreviewRow& from = rows[static_cast<std::size_t>(row)];
    const QString texts[] = {from.sender, QString::number(from.port),
                             QString::number(from.messages), from.robot, from.values};
    for (int column = 0; column < 5; ++column) {
      QTableWidgetItem* item = m_table->item(row, column);
      if (item == nullptr) m_table->setItem(row, column, item = new QTableWidgetItem);
      item->setText(texts[column]);
      item->setToolTip(texts[column]);
      item->setForeground(from.used ? palette().brush(QPalette::Text)
                                    : QBrush(theme().warningText));
    }
  }
  if (rows.empty() && m_message->text().isEmpty()) {
    showStatus(
        m_live->isListening()
            ? QStringLiteral("Nothing received on the robots' ports since this page was opened.")
            : QStringLiteral("Live is not listening, but messages on these teams' ports are still "
                             "shown here."),
        false);
  } else if (!rows.empty() && m_message->property("note").toBool()) {
    showStatus({}, false);
  }
}

void TeamsPage::showStatus(const QString& sentence, bool bad) {
  QPalette colours = palette();
  colours.setColor(QPalette::WindowText, bad ? theme().errorText : theme().secondaryText);
  m_message->setPalette(colours);
  m_message->setProperty("note", !bad);
  m_message->setText(sentence);
}

}  // namespace pitchboard::ui
