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
  if (m_edit.hasHeading) {
    m_heading =
        spinBox("heading", 180.0, degreesFromRadians(m_edit.from.yaw), 5.0, 1, QStringLiteral("°"));
    m_heading->setWrapping(true);
    form->addRow(QStringLiteral("heading"), m_heading);
    boxes.push_back(m_heading);
  }
  auto* title = new QLabel(m_edit.title);
  QFont bold = title->font();
  bold.setBold(true);
  title->setFont(bold);
  auto* hint = new QLabel(QStringLiteral("Enter keeps it, Esc puts it back"));
  hint->setForegroundRole(QPalette::PlaceholderText);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(title);
  layout->addLayout(form);
  layout->addWidget(hint);
  for (NumberBox* box : boxes) {
    connect(box, &NumberBox::valueChanged, this, [this] { m_edit.preview(pose()); });
  }
  m_x->setFocus();
  m_x->selectAll();
}

Pose PoseEditor::pose() const {
  return {{m_x->value(), m_y->value()},
          m_heading ? radiansFromDegrees(m_heading->value()) : m_edit.from.yaw};
}

bool PoseEditor::isChanged() const {
  // What the boxes show is rounded; only a change of that counts.
  const auto differs = [](const NumberBox* box, double before) {
    return QString::number(box->value(), 'f', box->decimals()) !=
           QString::number(before, 'f', box->decimals());
  };
  return differs(m_x, m_edit.from.position.x) || differs(m_y, m_edit.from.position.y) ||
         (m_heading && differs(m_heading, degreesFromRadians(m_edit.from.yaw)));
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
  if (m_cancelled) {
    m_edit.preview(m_edit.from);
  } else if (isChanged()) {
    m_edit.keep(pose());
  }
  QFrame::closeEvent(event);
}

}  // namespace pitchboard::ui
