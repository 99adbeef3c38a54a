// SPDX-License-Identifier: GPL-3.0-or-later
// The widgets of a MappingDialog.
#include <ui/mapping/mapping_dialog.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QSplitter>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include <simcore/world/field.h>
#include <ui/base/dialog_size.h>
#include <ui/base/in_place_message.h>
#include <ui/base/number_box.h>
#include <ui/base/table_style.h>

#include "mapped_field.h"
#include "meaning_tree.h"
#include "offset_strip.h"
#include "topic_tree.h"

namespace pitchboard::ui {
namespace {

/// Places of the box that says by what recordings are aligned.
enum AlignChoice { ByTimes, ByKickOff, BySet, ByHand };
enum TimeColumn { FileColumn, ClockColumn, OffsetColumn, timeColumnCount };

QComboBox* choice(QWidget* parent, const char* name, const QStringList& texts) {
  auto* box = new QComboBox(parent);
  box->setObjectName(QString::fromLatin1(name));
  box->addItems(texts);
  box->setMinimumContentsLength(5);
  return box;
}

const QStringList lengthUnits{QStringLiteral("m"), QStringLiteral("cm"), QStringLiteral("mm")};
const QStringList angleUnits{QStringLiteral("rad"), QStringLiteral("deg")};
const QStringList frames{QStringLiteral("centre, +x to the opponents' goal"),
                         QStringLiteral("centre, +x to the right goal"),
                         QStringLiteral("bottom-left corner")};

void setText(QComboBox* box, const std::string& text) {
  box->setCurrentIndex(std::max(0, box->findText(QString::fromStdString(text))));
}

}  // namespace

MappingDialog::MappingDialog(MappingSource source, QWidget* parent)
    : QDialog(parent), m_source(std::move(source)) {
  setObjectName(QStringLiteral("mappingDialog"));
  setWindowTitle(QStringLiteral("Map topics of %1").arg(m_source.name));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* about = new QLabel(
      QStringLiteral("Drag a field onto what it means, such as x of a robot. Or select both and "
                     "press Assign."),
      this);
  about->setWordWrap(true);
  m_message = new InPlaceMessage(this);
  m_message->setObjectName(QStringLiteral("mappingMessage"));
  m_message->clear();
  auto* right = new QSplitter(Qt::Vertical, this);
  right->addWidget(makeMeanings());
  right->addWidget(makePreview());
  right->setStretchFactor(0, 3);
  right->setStretchFactor(1, 2);
  right->setChildrenCollapsible(false);
  auto* both = new QSplitter(Qt::Horizontal, this);
  both->addWidget(makeTopics());
  both->addWidget(right);
  both->setStretchFactor(0, 1);
  both->setStretchFactor(1, 1);
  both->setSizes({scaled(this, 500), scaled(this, 520)});
  both->setChildrenCollapsible(false);
  auto* column = new QVBoxLayout(this);
  column->addWidget(about);
  column->addWidget(both, 1);
  column->addWidget(makeTimes());
  column->addWidget(m_message);
  column->addWidget(makeButtons());
  resize(dialogSize(this, 1040, 720));
  readFile();
  showMapping();
  prepare();
}

QWidget* MappingDialog::makeTopics() {
  auto* page = new QWidget(this);
  auto* filter = new QLineEdit(page);
  filter->setObjectName(QStringLiteral("mappingFilter"));
  filter->setPlaceholderText(QStringLiteral("Find topics and fields"));
  filter->setClearButtonEnabled(true);
  m_topicTree = new TopicTree(page);
  connect(filter, &QLineEdit::textChanged, m_topicTree, &TopicTree::setFilter);
  m_assign = new QPushButton(QStringLiteral("&Assign"), page);
  m_assign->setObjectName(QStringLiteral("mappingAssign"));
  m_assign->setToolTip(QStringLiteral("Put the selected field into the selected row"));
  m_assign->setAutoDefault(false);
  connect(m_assign, &QPushButton::clicked, this, [this] {
    if (const auto place = m_meanings->place())
      put(place->robot, place->slot, m_topicTree->selected());
  });
  m_useAs = new QToolButton(page);
  m_useAs->setObjectName(QStringLiteral("mappingUseAs"));
  m_useAs->setText(QStringLiteral("&Use field as"));
  m_useAs->setPopupMode(QToolButton::InstantPopup);
  m_useAs->setMenu(new QMenu(m_useAs));
  connect(m_useAs->menu(), &QMenu::aboutToShow, this, &MappingDialog::fillUseMenu);
  connect(m_topicTree, &QTreeWidget::itemSelectionChanged, this, &MappingDialog::showRobot);
  auto* row = new QHBoxLayout;
  row->addWidget(m_useAs);
  row->addStretch();
  row->addWidget(m_assign);
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(filter);
  column->addWidget(m_topicTree, 1);
  column->addLayout(row);
  return page;
}

/// All places, for who has no mouse.
void MappingDialog::fillUseMenu() {
  QMenu* menu = m_useAs->menu();
  menu->clear();
  const link::TopicField field = m_topicTree->selected();
  const auto add = [&](QMenu* to, std::size_t robot, const link::MappingSlotInfo& row) {
    const QString text =
        QStringLiteral("%1: %2").arg(QString::fromStdString(std::string(row.part)),
                                     QString::fromStdString(std::string(row.name)));
    to->addAction(text, this, [this, robot, slot = row.slot, field] { put(robot, slot, field); });
  };
  for (std::size_t i = 0; i < m_mapping.robots.size(); ++i) {
    const link::MappedRobot& robot = m_mapping.robots[i];
    QMenu* of = menu->addMenu(QStringLiteral("Robot %1, %2")
                                  .arg(robot.number)
                                  .arg(QString::fromStdString(std::string(info(robot.team).name))));
    for (const link::MappingSlotInfo& row : link::mappingSlots()) {
      if (row.isOfRobot) add(of, i, row);
    }
  }
  for (const link::MappingSlotInfo& row : link::mappingSlots()) {
    if (!row.isOfRobot) add(menu, 0, row);
  }
}

QWidget* MappingDialog::makeMeanings() {
  auto* page = new QWidget(this);
  m_meanings = new MeaningTree(page);
  connect(m_meanings, &MeaningTree::fieldDropped, this,
          [this](const MeaningTree::Place& place, const link::TopicField& field) {
            put(place.robot, place.slot, field);
          });
  connect(m_meanings, &MeaningTree::cleared, this,
          [this](const MeaningTree::Place& place) { put(place.robot, place.slot, {}); });
  connect(m_meanings, &QTreeWidget::itemSelectionChanged, this, &MappingDialog::showRobot);
  auto* add = new QPushButton(QStringLiteral("Add robot"), page);
  add->setObjectName(QStringLiteral("mappingAddRobot"));
  add->setAutoDefault(false);
  connect(add, &QPushButton::clicked, this, &MappingDialog::addRobot);
  auto* remove = new QPushButton(QStringLiteral("Remove robot"), page);
  remove->setObjectName(QStringLiteral("mappingRemoveRobot"));
  remove->setAutoDefault(false);
  connect(remove, &QPushButton::clicked, this, &MappingDialog::removeRobot);
  auto* row = new QHBoxLayout;
  row->addWidget(add);
  row->addWidget(remove);
  row->addStretch();
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(m_meanings, 1);
  column->addLayout(row);
  column->addWidget(makeRobotForm());
  return page;
}

QWidget* MappingDialog::makeRobotForm() {
  m_robotForm = new QWidget(this);
  m_number = new QSpinBox(m_robotForm);
  m_number->setObjectName(QStringLiteral("mappingNumber"));
  m_number->setRange(1, 99);
  m_number->setKeyboardTracking(false);
  QStringList colours;
  for (const TeamColorInfo& team : teamColors) {
    colours << QString::fromStdString(std::string(team.name));
  }
  m_team = choice(m_robotForm, "mappingTeam", colours);
  m_attacksLeft = new QCheckBox(QStringLiteral("plays to the left"), m_robotForm);
  m_attacksLeft->setObjectName(QStringLiteral("mappingAttacksLeft"));
  m_frame = choice(m_robotForm, "mappingFrame", frames);
  m_unit = choice(m_robotForm, "mappingUnit", lengthUnits);
  m_angleUnit = choice(m_robotForm, "mappingAngleUnit", angleUnits);
  m_ballFrame = choice(m_robotForm, "mappingBallFrame",
                       QStringList{QStringLiteral("the robot's own")} + frames);
  m_ballUnit = choice(m_robotForm, "mappingBallUnit", lengthUnits);
  auto* who = new QHBoxLayout;
  who->addWidget(m_number);
  who->addWidget(m_team);
  who->addWidget(m_attacksLeft);
  who->addStretch();
  auto* pose = new QHBoxLayout;
  pose->addWidget(m_frame, 1);
  pose->addWidget(m_unit);
  pose->addWidget(m_angleUnit);
  auto* ball = new QHBoxLayout;
  ball->addWidget(m_ballFrame, 1);
  ball->addWidget(m_ballUnit);
  auto* form = new QFormLayout(m_robotForm);
  form->setContentsMargins(0, 0, 0, 0);
  form->addRow(QStringLiteral("Robot"), who);
  form->addRow(QStringLiteral("Origin and units of the pose"), pose);
  form->addRow(QStringLiteral("Origin and unit of the ball"), ball);
  for (QComboBox* box : {m_team, m_frame, m_unit, m_angleUnit, m_ballFrame, m_ballUnit}) {
    connect(box, &QComboBox::activated, this, &MappingDialog::takeRobotForm);
  }
  connect(m_number, &QSpinBox::valueChanged, this, &MappingDialog::takeRobotForm);
  connect(m_attacksLeft, &QCheckBox::toggled, this, &MappingDialog::takeRobotForm);
  return m_robotForm;
}

void MappingDialog::showRobot() {
  m_assign->setEnabled(m_meanings->place().has_value() && !m_topicTree->selected().isEmpty());
  m_useAs->setEnabled(!m_topicTree->selected().isEmpty());
  const auto robot = m_meanings->robot();
  m_robotForm->setEnabled(robot.has_value());
  if (!robot || *robot >= m_mapping.robots.size()) return;
  const link::MappedRobot& shown = m_mapping.robots[*robot];
  m_isShowing = true;
  m_number->setValue(shown.number);
  m_team->setCurrentIndex(
      m_team->findText(QString::fromStdString(std::string(info(shown.team).name))));
  m_attacksLeft->setChecked(shown.attacksLeft);
  const link::MappedPose pose = shown.poses.empty() ? link::MappedPose() : shown.poses.front();
  const bool hasPlace = !shown.poses.empty() || shown.transforms;
  m_frame->setCurrentIndex(static_cast<int>(
      shown.poses.empty() && shown.transforms ? shown.transforms->frame : pose.frame));
  m_frame->setEnabled(hasPlace);
  setText(m_unit, pose.unit);
  setText(m_angleUnit, pose.angleUnit);
  m_unit->setEnabled(!shown.poses.empty());
  m_angleUnit->setEnabled(!shown.poses.empty());
  const link::MappedBall ball = shown.ball.value_or(link::MappedBall());
  m_ballFrame->setCurrentIndex(ball.frame ? 1 + static_cast<int>(*ball.frame) : 0);
  setText(m_ballUnit, ball.unit);
  m_ballFrame->setEnabled(shown.ball.has_value());
  m_ballUnit->setEnabled(shown.ball.has_value());
  m_isShowing = false;
}

void MappingDialog::takeRobotForm() {
  const auto robot = m_meanings->robot();
  if (m_isShowing || !robot) return;
  change([&](link::TopicMapping& mapping) {
    link::MappedRobot& to = mapping.robots[*robot];
    to.number = m_number->value();
    to.team = teamColors[static_cast<std::size_t>(m_team->currentIndex())].color;
    to.attacksLeft = m_attacksLeft->isChecked();
    const auto frame = static_cast<link::MappedFrame>(m_frame->currentIndex());
    if (to.transforms) to.transforms->frame = frame;
    for (link::MappedPose& pose : to.poses) {
      pose.frame = frame;
      pose.unit = m_unit->currentText().toStdString();
      pose.angleUnit = m_angleUnit->currentText().toStdString();
    }
    if (!to.ball) return;
    to.ball->unit = m_ballUnit->currentText().toStdString();
    to.ball->angleUnit = m_angleUnit->currentText().toStdString();
    to.ball->frame.reset();
    if (m_ballFrame->currentIndex() > 0) {
      to.ball->frame = static_cast<link::MappedFrame>(m_ballFrame->currentIndex() - 1);
    }
  });
}

QWidget* MappingDialog::makePreview() {
  auto* page = new QWidget(this);
  m_field = new MappedField(page);
  m_moment = new QSlider(Qt::Horizontal, page);
  m_moment->setObjectName(QStringLiteral("mappingMoment"));
  m_moment->setAccessibleName(QStringLiteral("Moment of the recording"));
  m_moment->setRange(0, 1000);
  m_moment->setPageStep(50);
  m_moment->setValue(m_moment->maximum());
  m_moment->setToolTip(QStringLiteral("Moment that the field and the values are of"));
  connect(m_moment, &QSlider::valueChanged, this, &MappingDialog::sample);
  m_momentText = new QLabel(page);
  m_momentText->setMinimumWidth(scaled(page, 60));
  m_problems = new QListWidget(page);
  m_problems->setObjectName(QStringLiteral("mappingProblems"));
  m_problems->setAccessibleName(QStringLiteral("Problems"));
  m_problems->setWordWrap(true);
  m_problems->setMaximumHeight(scaled(page, 70));
  auto* row = new QHBoxLayout;
  row->addWidget(m_moment, 1);
  row->addWidget(m_momentText);
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(m_field, 1);
  column->addLayout(row);
  column->addWidget(m_problems);
  return page;
}

QWidget* MappingDialog::makeTimes() {
  m_timesPage = new QWidget(this);
  m_times = new QTableWidget(0, timeColumnCount, m_timesPage);
  m_times->setObjectName(QStringLiteral("mappingTimes"));
  m_times->setHorizontalHeaderLabels(
      {QStringLiteral("Recording"), QStringLiteral("Time of a message"), QStringLiteral("Offset")});
  styleTable(m_times);
  m_times->verticalHeader()->setDefaultSectionSize(scaled(this, 28));
  m_times->horizontalHeader()->resizeSection(FileColumn, scaled(this, 200));
  m_times->horizontalHeader()->resizeSection(ClockColumn, scaled(this, 240));
  m_strip = new OffsetStrip(m_timesPage);
  connect(m_strip, &OffsetStrip::moved, this, &MappingDialog::moveRecording);
  auto* add = new QPushButton(QStringLiteral("Add recordings…"), m_timesPage);
  add->setObjectName(QStringLiteral("mappingAddRecording"));
  add->setToolTip(
      QStringLiteral("Other recordings of the same match, such as that of the next robot"));
  add->setAutoDefault(false);
  connect(add, &QPushButton::clicked, this, &MappingDialog::addRecordings);
  auto* row = new QHBoxLayout;
  row->addWidget(m_times, 1);
  row->addWidget(add, 0, Qt::AlignTop);
  auto* column = new QVBoxLayout(m_timesPage);
  column->setContentsMargins(0, 0, 0, 0);
  column->addLayout(row);
  column->addWidget(makeAlignment());
  column->addWidget(m_strip);
  m_timesPage->setVisible(!m_source.recordings.isEmpty());
  m_strip->hide();
  return m_timesPage;
}

QWidget* MappingDialog::makeAlignment() {
  m_alignRow = new QWidget(m_timesPage);
  m_align = choice(m_alignRow, "mappingAlign",
                   {QStringLiteral("by their times"), QStringLiteral("by the kick-off"),
                    QStringLiteral("by SET before the kick-off"), QStringLiteral("by hand")});
  m_align->setToolTip(
      QStringLiteral("Moves the recordings so that the event happens in all of them at once. "
                     "Robots may be told of the kick-off later than the referee's log: use SET "
                     "then"));
  connect(m_align, &QComboBox::activated, this, &MappingDialog::alignBy);
  auto* label = new QLabel(QStringLiteral("A&lign recordings:"), m_alignRow);
  label->setBuddy(m_align);
  auto* row = new QHBoxLayout(m_alignRow);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(label);
  row->addWidget(m_align);
  row->addStretch(1);
  m_alignRow->hide();
  return m_alignRow;
}

void MappingDialog::alignBy(int which) {
  switch (static_cast<AlignChoice>(which)) {
    case ByTimes:
      return alignByTimes();
    case ByKickOff:
      return alignByEvent(link::AlignEvent::KickOff);
    case BySet:
      return alignByEvent(link::AlignEvent::Set);
    case ByHand:
      change([](link::TopicMapping& mapping) { mapping.alignedBy.reset(); });
      m_strip->setFocus();
      return showAlignment();
  }
}

void MappingDialog::showAlignment() {
  const bool isMoved = std::ranges::any_of(
      m_mapping.recordings, [](const link::MappedRecording& one) { return one.offset != 0.0; });
  AlignChoice shown = isMoved ? ByHand : ByTimes;
  if (m_mapping.alignedBy) {
    shown = *m_mapping.alignedBy == link::AlignEvent::Set ? BySet : ByKickOff;
  }
  m_align->setCurrentIndex(shown);
  m_alignRow->setVisible(m_source.recordings.size() > 1);
}

void MappingDialog::showTimes() {
  m_isShowing = true;
  const int rows = static_cast<int>(m_recordings.size());
  m_times->setRowCount(rows);
  for (int i = 0; i < rows; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const link::MappedRecording& timing = m_recordings[index].timing;
    if (m_times->item(i, FileColumn) == nullptr) {
      m_times->setItem(i, FileColumn, new QTableWidgetItem);
      auto* clock = choice(m_times, "mappingClock",
                           {QStringLiteral("measured, if the clocks agree"),
                            QStringLiteral("measured (header)"), QStringLiteral("recorded (log)")});
      connect(clock, &QComboBox::activated, this, [this, index](int which) {
        setClock(index, static_cast<link::RecordingClock>(which));
      });
      m_times->setCellWidget(i, ClockColumn, clock);
      auto* offset = new NumberBox(m_times);
      offset->setObjectName(QStringLiteral("mappingOffset"));
      offset->setRange(-1e10, 1e10);  // also for a clock that was never set
      offset->setDecimals(3);
      offset->setSuffix(QStringLiteral(" s"));
      offset->setKeyboardTracking(false);
      connect(offset, &QDoubleSpinBox::valueChanged, this, [this, index](double value) {
        if (!m_isShowing) moveRecording(index, value - m_recordings[index].timing.offset);
      });
      m_times->setCellWidget(i, OffsetColumn, offset);
    }
    m_times->item(i, FileColumn)->setText(QString::fromStdString(timing.file));
    static_cast<QComboBox*>(m_times->cellWidget(i, ClockColumn))
        ->setCurrentIndex(static_cast<int>(timing.clock));
    static_cast<NumberBox*>(m_times->cellWidget(i, OffsetColumn))->setValue(timing.offset);
  }
  const int visible = std::clamp(rows, 1, 4);
  m_times->setFixedHeight(m_times->horizontalHeader()->sizeHint().height() +
                          visible * m_times->verticalHeader()->defaultSectionSize() + 2);
  m_strip->setRecordings(m_recordings);
  m_strip->setVisible(rows > 1);
  showAlignment();
  m_isShowing = false;
}

QWidget* MappingDialog::makeButtons() {
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  m_use = buttons->addButton(m_source.recordings.isEmpty() ? QStringLiteral("Save and use")
                                                           : QStringLiteral("Save and import"),
                             QDialogButtonBox::AcceptRole);
  m_use->setObjectName(QStringLiteral("mappingUse"));
  auto* open = buttons->addButton(QStringLiteral("Open mapping…"), QDialogButtonBox::ActionRole);
  auto* save = buttons->addButton(QStringLiteral("Save as…"), QDialogButtonBox::ActionRole);
  connect(open, &QPushButton::clicked, this, &MappingDialog::openMapping);
  connect(save, &QPushButton::clicked, this, &MappingDialog::saveAs);
  connect(buttons, &QDialogButtonBox::accepted, this, &MappingDialog::use);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  return buttons;
}

}  // namespace pitchboard::ui
