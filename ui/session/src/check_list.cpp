// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_list.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr int fewest = 2, most = 5;  // rows that are seen; more are scrolled to

}  // namespace

CheckList::CheckList(const QStringList& names, const QString& placeholder, QWidget* parent)
    : QWidget(parent),
      m_filter(new QLineEdit(this)),
      m_list(new QListWidget(this)),
      m_count(new QLabel(this)) {
  m_filter->setPlaceholderText(placeholder);
  m_filter->setClearButtonEnabled(true);
  for (const QString& name : names) {
    auto* item = new QListWidgetItem(name, m_list);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    item->setCheckState(Qt::Checked);
  }
  m_list->setUniformItemSizes(true);
  const int rows = std::clamp(m_list->count(), fewest, most);
  const int rowHeight = m_list->count() > 0 ? m_list->sizeHintForRow(0) : scaled(this, 18);
  m_list->setFixedHeight(rows * rowHeight + 2 * m_list->frameWidth());
  auto* row = new QHBoxLayout;
  m_count->setFont(themeFont(TypeRole::Secondary));
  m_count->setObjectName(QStringLiteral("ticked"));
  row->addWidget(m_filter, 1);
  row->addWidget(m_count);
  for (const bool on : {true, false}) {
    auto* button = new QToolButton(this);
    button->setText(on ? QStringLiteral("All") : QStringLiteral("None"));
    button->setAutoRaise(true);
    button->setToolTip(on ? QStringLiteral("Select all listed")
                          : QStringLiteral("Deselect all listed"));
    connect(button, &QToolButton::clicked, this, [this, on] { checkShown(on); });
    row->addWidget(button);
  }
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(scaled(this, 4));
  column->addLayout(row);
  column->addWidget(m_list);
  setFocusProxy(m_filter);
  connect(m_filter, &QLineEdit::textChanged, this, &CheckList::filter);
  connect(m_list, &QListWidget::itemChanged, this, &CheckList::count);
  count();
}

QStringList CheckList::checked() const {
  QStringList names;
  for (int i = 0; i < m_list->count(); ++i) {
    if (m_list->item(i)->checkState() == Qt::Checked) names << m_list->item(i)->text();
  }
  return names;
}

bool CheckList::isAllChecked() const {
  return checked().size() == m_list->count();
}

bool CheckList::isEmpty() const {
  return m_list->count() == 0;
}

void CheckList::setChecked(const QStringList& names) {
  for (int i = 0; i < m_list->count(); ++i) {
    QListWidgetItem* item = m_list->item(i);
    item->setCheckState(names.contains(item->text()) ? Qt::Checked : Qt::Unchecked);
  }
}

void CheckList::count() {
  m_count->setText(QStringLiteral("%1 of %2").arg(checked().size()).arg(m_list->count()));
}

void CheckList::filter(const QString& text) {
  for (int i = 0; i < m_list->count(); ++i) {
    m_list->item(i)->setHidden(!m_list->item(i)->text().contains(text, Qt::CaseInsensitive));
  }
}

void CheckList::checkShown(bool on) {
  for (int i = 0; i < m_list->count(); ++i) {
    if (!m_list->item(i)->isHidden()) {
      m_list->item(i)->setCheckState(on ? Qt::Checked : Qt::Unchecked);
    }
  }
}

}  // namespace pitchboard::ui
