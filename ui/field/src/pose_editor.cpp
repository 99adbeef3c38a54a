// SPDX-License-Identifier: GPL-3.0-or-later
#include "pose_editor.h"

#include <QCloseEvent>
#include <QFormLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QVBoxLayout>
#include <utility>
#include <vector>

#include <base/angles.h>
#include <ui/base/number_box.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

NumberBox* spinBox(const char* name, double most, double value, double step, int decimals,
                   const QString& unit) {
  auto* box = new NumberBox;
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

PoseEditor::PoseEditor(PoseEdit edit, const sim::FieldSpec& field, QWidget* parent)
    : QFrame(parent, Qt::Popup), m_edit(std::move(edit)) {
  setAttribute(Qt::WA_DeleteOnClose);
  setFrameShape(QFrame::StyledPanel);
  m_x = spinBox("x", field.halfLength() + field.border, m_edit.from.position.x, 0.05, 2,
                QStringLiteral(" m"));
  m_y = spinBox("y", field.halfWidth() + field.border, m_edit.from.position.y, 0.05, 2,
                QStringLiteral(" m"));
  auto* form = new QFormLayout;
  form->addRow(QStringLiteral("x"), m_x);
  form->addRow(QStringLiteral("y"), m_y);
  std::vector<NumberBox*> boxes{m_x, m_y};
  if (m_edit.isBall) {
    constexpr double fastest = 20.0;
    m_speed = spinBox("speed", fastest, m_edit.speed, 0.1, 2, QStringLiteral(" m/s"));
    m_speed->setMinimum(0.0);
    form->addRow(QStringLiteral("speed"), m_speed);
  }
  m_heading =
      spinBox("heading", 180.0, degreesFromRadians(m_edit.from.yaw), 5.0, 1, QStringLiteral("°"));
  m_heading->setWrapping(true);
  form->addRow(m_edit.isBall ? QStringLiteral("rolls to") : QStringLiteral("heading"), m_heading);
  // A ball that is only to roll stays where it is until it is kept.
  if (!m_edit.isBall) boxes.push_back(m_heading);
  auto* title = new QLabel(m_edit.title);
  QFont bold = title->font();
  bold.setBold(true);
  title->setFont(bold);
  auto* hint = new QLabel(QStringLiteral("Enter applies, Esc reverts"));
  hint->setForegroundRole(QPalette::PlaceholderText);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(title);
  layout->addLayout(form);
  layout->addWidget(hint);
  for (NumberBox* box : boxes) {
    connect(box, &NumberBox::valueChanged, this, [this] { m_edit.show(pose()); });
  }
  m_x->setFocus();
  m_x->selectAll();
}

Pose PoseEditor::pose() const {
  return {{m_x->value(), m_y->value()}, radiansFromDegrees(m_heading->value())};
}

bool PoseEditor::isChanged() const {
  // What the boxes show is rounded; only a change of that counts.
  const auto differs = [](const NumberBox* box, double before) {
    return QString::number(box->value(), 'f', box->decimals()) !=
           QString::number(before, 'f', box->decimals());
  };
  return differs(m_x, m_edit.from.position.x) || differs(m_y, m_edit.from.position.y) ||
         differs(m_heading, degreesFromRadians(m_edit.from.yaw)) ||
         (m_speed && differs(m_speed, m_edit.speed));
}

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
  m_edit.show({});
  if (!m_cancelled && isChanged()) m_edit.keep(pose(), m_speed ? m_speed->value() : 0.0);
  QFrame::closeEvent(event);
}

}  // namespace pitchboard::ui
