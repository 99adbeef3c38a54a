// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_palette.h"

#include <QKeyEvent>
#include <QLineEdit>
#include <QListView>
#include <QPainter>
#include <QStandardItemModel>
#include <QStyledItemDelegate>
#include <QVBoxLayout>
#include <utility>

#include <ui/base/table_style.h>
#include <ui/base/text_filter.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr int entryRole = Qt::UserRole;     // its place in the entries
constexpr int kindRole = Qt::UserRole + 1;  // stands at the right

class EntryDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    return {QStyledItemDelegate::sizeHint(option, index).width(), scaled(option.widget, 22)};
  }
  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override {
    QStyledItemDelegate::paint(painter, option, index);
    painter->save();
    painter->setFont(themeFont(TypeRole::Secondary));
    painter->setPen(theme().secondaryText);
    painter->drawText(option.rect.adjusted(0, 0, -scaled(option.widget, 8), 0),
                      Qt::AlignRight | Qt::AlignVCenter, index.data(kindRole).toString());
    painter->restore();
  }
};

}  // namespace

CommandPalette::CommandPalette(std::vector<PaletteEntry> entries, QWidget* window)
    : QDialog(window, Qt::Dialog | Qt::FramelessWindowHint),
      m_entries(std::move(entries)),
      m_search(new QLineEdit(this)),
      m_list(new QListView(this)),
      m_model(new QStandardItemModel(this)),
      m_filter(new TextFilter(this)) {
  setObjectName(QStringLiteral("commandPalette"));
  setWindowTitle(QStringLiteral("Find anything"));
  setAttribute(Qt::WA_DeleteOnClose);
  m_search->setObjectName(QStringLiteral("paletteSearch"));
  m_search->setPlaceholderText(QStringLiteral("Search actions, variables, robots and events"));
  m_search->setAccessibleName(m_search->placeholderText());
  for (std::size_t i = 0; i < m_entries.size(); ++i) {
    // Menus write keys of the field behind a tab.
    const QString& text = m_entries[i].text;
    auto* item = new QStandardItem(text.section(QLatin1Char('\t'), 0, 0));
    item->setEditable(false);
    item->setData(static_cast<int>(i), entryRole);
    item->setData(m_entries[i].kind + text.section(QLatin1Char('\t'), 1), kindRole);
    m_model->appendRow(item);
  }
  m_filter->setSourceModel(m_model);
  m_list->setObjectName(QStringLiteral("paletteList"));
  m_list->setAccessibleName(QStringLiteral("Results"));
  m_list->setModel(m_filter);
  m_list->setUniformItemSizes(true);
  m_list->setItemDelegate(new EntryDelegate(m_list));
  m_list->setFocusPolicy(Qt::NoFocus);
  auto* column = new QVBoxLayout(this);
  const int gap = scaled(this, 8);
  column->setContentsMargins(gap, gap, gap, gap);
  m_list->setFrameShape(QFrame::NoFrame);
  column->setSpacing(gap);
  column->addWidget(m_search);
  column->addWidget(m_list, 1);
  auto* empty = makeEmptyLabel(this, QStringLiteral("paletteEmpty"));
  column->addWidget(empty, 1);
  const auto first = [this, empty] {
    const bool found = m_filter->rowCount() > 0;
    m_list->setVisible(found);
    empty->setVisible(!found);
    empty->setText(QStringLiteral("Nothing matches “%1”.").arg(m_search->text().trimmed()));
    m_list->setCurrentIndex(m_filter->index(best(), 0));
  };
  connect(m_search, &QLineEdit::textChanged, this, [this, first](const QString& text) {
    m_filter->setFilterText(text);
    first();
  });
  connect(m_search, &QLineEdit::returnPressed, this, &CommandPalette::runCurrent);
  connect(m_list, &QListView::clicked, this, &CommandPalette::runCurrent);
  m_search->installEventFilter(this);
  first();
  const int wide = std::min(scaled(this, 560), window->width());
  resize(wide, std::min(scaled(this, 360), window->height()));
  move(window->mapToGlobal(QPoint((window->width() - wide) / 2, scaled(this, 64))));
  m_search->setFocus();
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    // The list is moved in while the text field keeps the focus.
    if (key == Qt::Key_Up || key == Qt::Key_Down || key == Qt::Key_PageUp ||
        key == Qt::Key_PageDown) {
      QCoreApplication::sendEvent(m_list, event);
      return true;
    }
  }
  return QDialog::eventFilter(watched, event);
}

// No title: what it is for stands in the empty line, and Escape or a click outside ends it.
void CommandPalette::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setPen(theme().outerEdge);
  painter.drawRect(rect().adjusted(0, 0, -1, -1));
}

void CommandPalette::changeEvent(QEvent* event) {
  QDialog::changeEvent(event);
  if (event->type() == QEvent::ActivationChange && !isActiveWindow() && isVisible()) close();
}

// The first that is exactly what was typed, or ends with it: "log" means "View: Log" rather than
// "Save log", and "export" means "Timeline: Export…" rather than "Export picture…".
int CommandPalette::best() const {
  const QString typed = m_search->text().trimmed();
  if (typed.isEmpty()) return 0;
  for (int row = 0; row < m_filter->rowCount(); ++row) {
    QString text = m_filter->index(row, 0).data().toString();
    if (text.endsWith(QChar(0x2026))) text.chop(1);
    if (!text.endsWith(typed, Qt::CaseInsensitive)) continue;
    const qsizetype before = text.size() - typed.size() - 1;
    if (before < 0 || !text[before].isLetterOrNumber()) return row;
  }
  return 0;
}

void CommandPalette::runCurrent() {
  const QModelIndex chosen = m_list->currentIndex();
  if (!chosen.isValid()) return;
  const auto run = m_entries[static_cast<std::size_t>(chosen.data(entryRole).toInt())].run;
  close();
  run();
}

}  // namespace pitchboard::ui
