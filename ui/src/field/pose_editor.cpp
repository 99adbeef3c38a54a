// SPDX-License-Identifier: GPL-3.0-or-later
#include "pose_editor.h"

#include <base/angles.h>
#include <ui/theme.h>

#include <QCloseEvent>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QVBoxLayout>

namespace pitchboard::ui {
namespace {

QDoubleSpinBox* spinBox(const char* name, double most, double value, double step, int decimals,
                        const QString& unit) {
  auto* box = new QDoubleSpinBox;
  box->setObjectName(QLatin1String(name));
  box->setRange(-most, most);
  box->setDecimals(decimals);
  box->setSingleStep(step);
  box->setSuffix(unit);
  box->setValue(value);
  box->setAlignment(Qt::AlignRight);
  return box;
}

}  // namespace

PoseEditor::PoseEditor(MatchController* controller, const sim::FieldSpec& field,
                       const QString& robotName, RobotId id, const Pose& pose, QWidget* parent)
    : QFrame(parent, Qt::Popup), m_controller(controller), m_id(id), m_from(pose) {
  setAttribute(Qt::WA_DeleteOnClose);
  setFrameShape(QFrame::StyledPanel);
  m_x = spinBox("x", field.halfLength() + field.border, pose.position.x, 0.05, 2,
                QStringLiteral(" m"));
  m_y = spinBox("y", field.halfWidth() + field.border, pose.position.y, 0.05, 2,
                QStringLiteral(" m"));
  m_heading = spinBox("heading", 180.0, degreesFromRadians(pose.yaw), 5.0, 1, QStringLiteral("°"));
  m_heading->setWrapping(true);

  auto* title = new QLabel(tr("Pose of %1").arg(robotName));
  QFont bold = title->font();
  bold.setBold(true);
  title->setFont(bold);
  auto* hint = new QLabel(tr("Enter keeps it, Esc puts it back"));
  hint->setForegroundRole(QPalette::PlaceholderText);
  auto* form = new QFormLayout;
  form->addRow(QStringLiteral("x"), m_x);
  form->addRow(QStringLiteral("y"), m_y);
  form->addRow(tr("heading"), m_heading);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(title);
  layout->addLayout(form);
  layout->addWidget(hint);
  for (QDoubleSpinBox* box : {m_x, m_y, m_heading}) {
    connect(box, &QDoubleSpinBox::valueChanged, this, &PoseEditor::preview);
  }
  m_x->setFocus();
  m_x->selectAll();
}

Pose PoseEditor::pose() const {
  return {{m_x->value(), m_y->value()}, radiansFromDegrees(m_heading->value())};
}

void PoseEditor::preview() { m_controller->previewRobots({{m_id, m_from, pose()}}); }

void PoseEditor::keyPressEvent(QKeyEvent* event) {
  m_cancelled = event->key() == Qt::Key_Escape;
  const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  if (m_cancelled || enter) {
    close();
  } else {
    QFrame::keyPressEvent(event);
  }
}

void PoseEditor::closeEvent(QCloseEvent* event) {
  // What the boxes show is rounded; only a change counts.
  const auto shown = [](double value, int decimals) { return QString::number(value, 'f', decimals); };
  const bool changed =
      shown(m_x->value(), 2) != shown(m_from.position.x, 2) ||
      shown(m_y->value(), 2) != shown(m_from.position.y, 2) ||
      shown(m_heading->value(), 1) != shown(degreesFromRadians(m_from.yaw), 1);
  if (m_cancelled) {
    m_controller->previewRobots({{m_id, m_from, m_from}});
  } else if (changed) {
    m_controller->moveRobots({{m_id, m_from, pose()}});
  }
  QFrame::closeEvent(event);
}

}  // namespace pitchboard::ui
