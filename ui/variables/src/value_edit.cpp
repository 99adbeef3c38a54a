// SPDX-License-Identifier: GPL-3.0-or-later
#include "value_edit.h"

#include <QLabel>

#include <ui/base/theme.h>

#include "variable_text.h"

namespace pitchboard::ui {

ValueEdit::ValueEdit(const telemetry::ColumnInfo& column, QWidget* parent)
    : QLineEdit(parent), m_column(column), m_problem(new QLabel(parent)) {
  setObjectName(QStringLiteral("valueEdit"));
  setAlignment(Qt::AlignRight);
  setFrame(false);
  setAutoFillBackground(true);
  setAccessibleName(QString::fromStdString(column.name));
  m_problem->setObjectName(QStringLiteral("valueProblem"));
  m_problem->setWordWrap(true);
  m_problem->setFont(themeFont(TypeRole::Secondary));
  m_problem->setMargin(scaled(this, 4));
  m_problem->setStyleSheet(QStringLiteral("background: %1; color: %2;")
                               .arg(theme().errorGround.name(), theme().errorText.name()));
  m_problem->hide();
  connect(this, &QLineEdit::textEdited, this, [this] { isAcceptable(); });
}

ValueEdit::~ValueEdit() {
  delete m_problem;
}

bool ValueEdit::isAcceptable() {
  const Result<double> parsed = parseValue(m_column, text());
  m_problem->setVisible(!parsed);
  if (parsed) return true;
  m_problem->setText(QString::fromStdString(parsed.error().message));
  const int gap = scaled(this, 4);
  const int width = qMin(parentWidget()->width() - 2 * gap, scaled(this, 280));
  const int height = m_problem->heightForWidth(width);
  const bool below = geometry().bottom() + height < parentWidget()->height();
  m_problem->setGeometry(parentWidget()->width() - width - gap,
                         below ? geometry().bottom() + 1 : geometry().top() - height, width,
                         height);
  m_problem->raise();
  return false;
}

void ValueEdit::hideEvent(QHideEvent* event) {
  if (m_problem) m_problem->hide();
  QLineEdit::hideEvent(event);
}

}  // namespace pitchboard::ui
