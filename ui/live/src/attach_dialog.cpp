// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/live/attach_dialog.h>

#include <pwd.h>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include <robotlink/blackboard/segments.h>
#include <ui/base/dialog_size.h>
#include <ui/base/file_dialog.h>
#include <ui/base/number_box.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/base/theme.h>
#include <ui/sources/attached_boards.h>

namespace pitchboard::ui {
namespace {

const QString fromFile = QStringLiteral("from a file…");

QString userName(uid_t user) {
  const passwd* known = getpwuid(user);
  return known == nullptr ? QStringLiteral("user %1").arg(user)
                          : QString::fromLocal8Bit(known->pw_name);
}

QTableWidget* makeTable(QWidget* parent, const char* name, const QStringList& columns) {
  auto* table = new QTableWidget(0, static_cast<int>(columns.size()), parent);
  table->setObjectName(QLatin1String(name));
  table->setHorizontalHeaderLabels(columns);
  styleTable(table);
  table->setSelectionMode(QAbstractItemView::SingleSelection);
  // The last column has the explanation: it gets all the width that the others do not need.
  for (int column = 0; column + 1 < table->columnCount(); ++column) {
    table->horizontalHeader()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
  }
  return table;
}

void setTexts(QTableWidget* table, int row, const QStringList& texts) {
  for (int column = 0; column < texts.size(); ++column) {
    QTableWidgetItem* item = table->item(row, column);
    if (item == nullptr) table->setItem(row, column, item = new QTableWidgetItem);
    item->setText(texts[column]);
    item->setToolTip(texts[column]);
  }
}

}  // namespace

AttachDialog::AttachDialog(AttachedBoards* boards, QWidget* parent)
    : QDialog(parent), m_boards(boards) {
  constexpr int refreshMilliseconds = 1000;
  setObjectName(QStringLiteral("attachDialog"));
  setWindowTitle(QStringLiteral("Attach blackboard"));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* about =
      new QLabel(QStringLiteral("Live shows an attached blackboard as a robot. A simulated match "
                                "lists its variables beside those of its robots. Blackboards are "
                                "only read. Changes faster than the sampling rate are missed."),
                 this);
  about->setWordWrap(true);
  m_segments = makeTable(this, "segments",
                         {QStringLiteral("Key"), QStringLiteral("Size"), QStringLiteral("Owner"),
                          QStringLiteral("Attached by"), QStringLiteral("Note")});
  connect(m_segments, &QTableWidget::itemSelectionChanged, this, &AttachDialog::choose);
  connect(m_segments, &QTableWidget::itemDoubleClicked, this, [this] { attach(); });
  m_attached = makeTable(this, "attachedBoards",
                         {QStringLiteral("Robot"), QStringLiteral("Key"), QStringLiteral("Samples"),
                          QStringLiteral("State")});
  m_attached->setMaximumHeight(scaled(this, 110));
  m_message = new QLabel(this);
  m_message->setObjectName(QStringLiteral("attachMessage"));
  m_message->setWordWrap(true);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  m_attach = buttons->addButton(QStringLiteral("Attach"), QDialogButtonBox::ActionRole);
  m_attach->setObjectName(QStringLiteral("attach"));
  m_detach = buttons->addButton(QStringLiteral("Detach"), QDialogButtonBox::ActionRole);
  m_detach->setObjectName(QStringLiteral("detach"));
  connect(m_attach, &QPushButton::clicked, this, &AttachDialog::attach);
  connect(m_detach, &QPushButton::clicked, this, &AttachDialog::detach);
  connect(m_attached, &QTableWidget::itemSelectionChanged, this,
          [this] { m_detach->setEnabled(m_attached->currentRow() >= 0); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addWidget(about);
  column->addWidget(new QLabel(QStringLiteral("Segments on this computer"), this));
  column->addWidget(m_segments, 1);
  column->addWidget(makeForm());
  column->addWidget(new QLabel(QStringLiteral("Attached"), this));
  column->addWidget(m_attached);
  column->addWidget(m_message);
  column->addWidget(buttons);
  resize(dialogSize(this, 560, 540));
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, [this] {
    if (isVisible()) refresh();
  });
  timer->start(refreshMilliseconds);
  refresh();
}

QWidget* AttachDialog::makeForm() {
  auto* widget = new QWidget(this);
  auto* form = new QGridLayout(widget);
  form->setContentsMargins(0, 0, 0, 0);
  form->setHorizontalSpacing(scaled(this, 10));
  for (const int fields : {1, 3}) form->setColumnStretch(fields, 1);
  const auto add = [&](int row, int column, const char* text, QWidget* field) {
    form->addWidget(new QLabel(QLatin1String(text), widget), row, column);
    form->addWidget(field, row, column + 1);
  };
  m_key = new QSpinBox(widget);
  m_key->setObjectName(QStringLiteral("attachKey"));
  m_key->setRange(1, 2147483647);
  m_key->setValue(link::AttachedBoard().key);
  m_key->setToolTip(QStringLiteral(
      "You can enter a key before its segment exists; it is attached as soon as it appears"));
  m_robot = new QSpinBox(widget);
  m_robot->setObjectName(QStringLiteral("attachRobot"));
  m_robot->setRange(0, 999);
  m_robot->setSpecialValueText(QStringLiteral("from the key"));
  m_team = new QComboBox(widget);
  m_team->setObjectName(QStringLiteral("attachTeam"));
  for (const TeamColorInfo& colour : teamColors) {
    m_team->addItem(
        QString::fromUtf8(colour.name.data(), static_cast<qsizetype>(colour.name.size())),
        static_cast<int>(colour.color));
  }
  m_catalog = new QComboBox(widget);
  m_catalog->setObjectName(QStringLiteral("attachCatalog"));
  m_catalog->addItem(QStringLiteral("published map"), QString());
  m_catalog->addItem(fromFile);
  m_catalog->setToolTip(QStringLiteral(
      "Names and positions of its variables: a blackboard.h, SharedMemory.py or JSON file"));
  connect(m_catalog, &QComboBox::activated, this, &AttachDialog::chooseCatalog);
  m_rate = new NumberBox(widget);
  m_rate->setObjectName(QStringLiteral("attachRate"));
  m_rate->setRange(link::AttachedBoard::slowest, link::AttachedBoard::fastest);
  m_rate->setDecimals(1);
  m_rate->setValue(link::AttachedBoard().rate);
  m_rate->setSuffix(QStringLiteral(" per second"));
  add(0, 0, "Key", m_key);
  add(0, 2, "Robot", m_robot);
  add(1, 0, "Catalog", m_catalog);
  add(1, 2, "Team", m_team);
  add(2, 0, "Samples", m_rate);
  return widget;
}

void AttachDialog::refresh() {
  listSegments();
  listAttached();
}

void AttachDialog::listSegments() {
  const auto segments = link::segmentsOfThisComputer();
  const QSignalBlocker quiet(m_segments);
  m_segments->setRowCount(static_cast<int>(segments.size()));
  for (int row = 0; row < m_segments->rowCount(); ++row) {
    const link::SegmentInfo& info = segments[static_cast<std::size_t>(row)];
    setTexts(m_segments, row,
             {QString::number(info.key), QStringLiteral("%1 bytes").arg(info.bytes),
              userName(info.owner),
              info.attached == 1 ? QStringLiteral("1 process")
                                 : QStringLiteral("%1 processes").arg(info.attached),
              info.blackboardSized ? QStringLiteral("fits the published map")
                                   : QStringLiteral("needs its own catalog")});
    m_segments->item(row, 0)->setData(Qt::UserRole, info.key);
  }
  // At first the form means the first segment that it can attach as it stands.
  if (!std::exchange(m_wasListed, true)) {
    const auto first = std::ranges::find(segments, true, &link::SegmentInfo::blackboardSized);
    if (first != segments.end()) {
      m_segments->selectRow(static_cast<int>(first - segments.begin()));
      m_key->setValue(first->key);
    }
  }
  const bool isNote = m_message->property("note").toBool();
  if (segments.empty() && m_message->text().isEmpty()) {
    showStatus(
        QStringLiteral(
            "No program on this computer has shared memory. Start the robot's processes, or enter "
            "the key: the segment is attached as soon as it appears."),
        false);
    m_message->setProperty("note", true);
  } else if (!segments.empty() && isNote) {
    showStatus({}, false);
  }
}

void AttachDialog::listAttached() {
  const std::vector<link::AttachedStatus> boards = m_boards->status();
  m_attached->setRowCount(static_cast<int>(boards.size()));
  for (int row = 0; row < m_attached->rowCount(); ++row) {
    const link::AttachedStatus& status = boards[static_cast<std::size_t>(row)];
    sim::RobotIdentity robot;
    robot.team = status.board.team;
    robot.number = status.board.number();
    setTexts(
        m_attached, row,
        {robotName(robot), QString::number(status.board.key), QString::number(status.samples),
         status.attached ? QStringLiteral("attached") : QString::fromStdString(status.problem)});
    m_attached->item(row, 0)->setData(Qt::UserRole, status.board.key);
  }
  m_detach->setEnabled(m_attached->currentRow() >= 0);
}

void AttachDialog::choose() {
  const QTableWidgetItem* item = m_segments->item(m_segments->currentRow(), 0);
  if (item != nullptr) m_key->setValue(item->data(Qt::UserRole).toInt());
}

void AttachDialog::chooseCatalog(int index) {
  if (m_catalog->itemText(index) != fromFile) return;
  m_catalog->setCurrentIndex(0);
  auto* ask = new QFileDialog(this, QStringLiteral("Choose a variable catalog"), {},
                              QStringLiteral("Catalogs (*.h *.py *.json);;All files (*)"));
  ask->setAttribute(Qt::WA_DeleteOnClose);
  ask->setFileMode(QFileDialog::ExistingFile);
  connect(ask, &QFileDialog::fileSelected, this, [this](const QString& file) {
    const int place = m_catalog->count() - 1;
    m_catalog->insertItem(place, QFileInfo(file).fileName(), file);
    m_catalog->setItemData(place, file, Qt::ToolTipRole);
    m_catalog->setCurrentIndex(place);
  });
  openInDialogFolder(ask);
}

bool AttachDialog::attach() {
  link::AttachedBoard board;
  board.key = m_key->value();
  board.robot = m_robot->value();
  board.team = static_cast<TeamColor>(m_team->currentData().toInt());
  board.catalogFile = m_catalog->currentData().toString().toStdString();
  board.rate = m_rate->value();
  const auto attached = m_boards->attach(board);
  refresh();
  return showStatus(attached ? QString() : QString::fromStdString(attached.error().text()),
                    !attached);
}

void AttachDialog::detach() {
  const QTableWidgetItem* item = m_attached->item(m_attached->currentRow(), 0);
  if (item == nullptr) return;
  m_boards->detach(item->data(Qt::UserRole).toInt());
  refresh();
  showStatus({}, false);
}

bool AttachDialog::showStatus(const QString& sentence, bool bad) {
  QPalette colours = palette();
  colours.setColor(QPalette::WindowText, bad ? theme().errorText : theme().secondaryText);
  m_message->setPalette(colours);
  m_message->setProperty("note", false);
  m_message->setText(sentence);
  return !bad;
}

void showAttachDialog(AttachedBoards* boards, QWidget* window) {
  auto* dialog = window->findChild<AttachDialog*>();
  if (dialog == nullptr) dialog = new AttachDialog(boards, window);
  dialog->show();
  dialog->raise();
  dialog->activateWindow();
}

}  // namespace pitchboard::ui
