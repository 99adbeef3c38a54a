// SPDX-License-Identifier: GPL-3.0-or-later
#include "help_windows.h"

#include <QApplication>
#include <QDialog>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QScreen>
#include <QStandardItemModel>
#include <QTableView>
#include <QVBoxLayout>

#include <ui/base/table_style.h>
#include <ui/base/text_filter.h>
#include <ui/base/theme.h>

#include "key_map.h"

namespace pitchboard::ui {

void showShortcuts(QWidget* parent, const KeyMap& keys) {
  auto* dialog = new QDialog(parent);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName(QStringLiteral("shortcuts"));
  dialog->setWindowTitle(QStringLiteral("Keyboard shortcuts"));
  const std::vector<KeyLine> lines = keys.lines(true);
  auto* model = new QStandardItemModel(static_cast<int>(lines.size()), 3, dialog);
  model->setHorizontalHeaderLabels(
      {QStringLiteral("Keys"), QStringLiteral("Action"), QStringLiteral("Where")});
  for (int row = 0; row < model->rowCount(); ++row) {
    const KeyLine& line = lines[static_cast<std::size_t>(row)];
    const QString texts[] = {line.keys, line.text, line.group};
    for (int column = 0; column < 3; ++column) {
      model->setItem(row, column, new QStandardItem(texts[column]));
    }
  }
  auto* filter = new TextFilter(dialog);
  filter->setSourceModel(model);
  auto* words = new QLineEdit(dialog);
  words->setObjectName(QStringLiteral("shortcutWords"));
  words->setPlaceholderText(QStringLiteral("Search, e.g. bookmark"));
  words->setClearButtonEnabled(true);
  QObject::connect(words, &QLineEdit::textChanged, filter, &TextFilter::setFilterText);
  auto* table = new QTableView(dialog);
  table->setModel(filter);
  styleTable(table);
  table->resizeColumnsToContents();
  table->horizontalHeader()->setStretchLastSection(false);
  table->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Stretch);
  auto* column = new QVBoxLayout(dialog);
  column->addWidget(words);
  column->addWidget(table);
  const QSize wanted(scaled(parent, 640), scaled(parent, 560));
  dialog->resize(wanted.boundedTo(parent->screen()->availableSize() - QSize(40, 80)));
  dialog->show();
  words->setFocus();
}

void showAbout(QWidget* parent) {
  auto* dialog = new QDialog(parent);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(QStringLiteral("About Pitchboard"));
  auto* text = new QLabel(
      QStringLiteral(
          "<b>Pitchboard %1</b><p>A studio for teams whose humanoid soccer robots run the "
          "Cross Architecture: simulate them, watch them, see what they believe.</p>"
          "<p>Free software under the GNU General Public License, version 3 or later. "
          "There is no warranty.</p>")
          .arg(QApplication::applicationVersion()),
      dialog);
  text->setWordWrap(true);
  auto* column = new QVBoxLayout(dialog);
  const int edge = scaled(parent, 16);
  column->setContentsMargins(edge, edge, edge, edge);
  column->addWidget(text);
  dialog->resize(scaled(parent, 400), dialog->sizeHint().height());
  dialog->show();
}

}  // namespace pitchboard::ui
