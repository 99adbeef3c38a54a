// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/notes/notes_dock.h>

#include <QAction>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPushButton>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include <base/file_target.h>
#include <ui/base/file_dialog.h>
#include <ui/base/in_place_message.h>
#include <ui/base/table_style.h>
#include <ui/base/text_filter.h>
#include <ui/sources/note_board.h>
#include <ui/sources/shown_moment.h>

#include "notes_model.h"

namespace pitchboard::ui {
namespace {

class NotesDock : public QWidget {
 public:
  NotesDock(NoteBoard* board, QWidget* parent)
      : QWidget(parent),
        m_board(board),
        m_filter(new QLineEdit(this)),
        m_delete(new QPushButton(QStringLiteral("Delete"), this)),
        m_save(new QPushButton(QStringLiteral("Save…"), this)),
        m_message(new InPlaceMessage(this)),
        m_table(new QTableView(this)),
        m_model(new NotesModel(board, this)),
        m_sorted(new TextFilter(this)),
        m_empty(makeEmptyLabel(this, QStringLiteral("emptyNotes"))) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(makeBar());
    column->addWidget(m_message);
    column->addWidget(m_table, 1);
    column->addWidget(m_empty, 1);
    m_empty->setText(QStringLiteral(
        "Choose Text, Arrow or Circle, then click or drag on the field, on a plot or on a video. "
        "A note belongs to the moment that is shown and is kept beside the recording. M sets a "
        "bookmark."));
    makeTable();
    m_message->clear();
    connect(m_model, &QAbstractItemModel::modelReset, this, &NotesDock::showState);
    connect(m_table->selectionModel(), &QItemSelectionModel::selectionChanged, this,
            &NotesDock::showState);
    showState();
  }
  QSize sizeHint() const override { return {scaled(this, 700), scaled(this, 220)}; }

 protected:
  /// Delete is a key of the window, too.
  bool eventFilter(QObject* watched, QEvent* event) override {
    const bool isKey =
        event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
    if (!isKey || static_cast<QKeyEvent*>(event)->key() != Qt::Key_Delete) {
      return QWidget::eventFilter(watched, event);
    }
    event->accept();
    if (event->type() == QEvent::KeyPress) m_board->remove(selectedIds());
    return true;
  }

 private:
  QHBoxLayout* makeBar() {
    auto* row = new QHBoxLayout;
    const int gap = scaled(this, 4);
    row->setContentsMargins(gap, gap, gap, gap);
    row->setSpacing(gap);
    for (QAction* tool : m_board->tools()) {
      auto* button = new QToolButton(this);
      button->setDefaultAction(tool);
      button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
      row->addWidget(button);
    }
    m_filter->setObjectName(QStringLiteral("notesFilter"));
    m_filter->setAccessibleName(QStringLiteral("Filter"));
    m_filter->setPlaceholderText(QStringLiteral("Filter: text, arrow, field, variable, video"));
    m_filter->setClearButtonEnabled(true);
    connect(m_filter, &QLineEdit::textChanged, m_sorted, &TextFilter::setFilterText);
    row->addWidget(m_filter, 1);
    m_delete->setObjectName(QStringLiteral("deleteNotes"));
    m_delete->setToolTip(QStringLiteral("Deletes the selected notes. Bookmarks stay"));
    connect(m_delete, &QPushButton::clicked, this, [this] { m_board->remove(selectedIds()); });
    row->addWidget(m_delete);
    m_save->setObjectName(QStringLiteral("saveNotes"));
    m_save->setToolTip(QStringLiteral("Saves the listed notes as CSV or JSON"));
    connect(m_save, &QPushButton::clicked, this, [this] { askAndSave(); });
    row->addWidget(m_save);
    return row;
  }

  void makeTable() {
    m_table->setObjectName(QStringLiteral("notesTable"));
    m_sorted->setSourceModel(m_model);
    m_sorted->setSortRole(NotesModel::sortRole);
    m_table->setModel(m_sorted);
    styleTable(m_table);
    m_table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    m_table->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
    m_table->setSortingEnabled(true);
    m_table->sortByColumn(NotesModel::Time, Qt::AscendingOrder);
    constexpr int widths[NotesModel::columns] = {96, 80, 220, 200};  // px of the mock
    for (int column = 0; column < NotesModel::columns; ++column) {
      m_table->setColumnWidth(column, scaled(this, widths[column]));
    }
    const auto go = [this](const QModelIndex& index) {
      m_board->shown()->seek(m_model->timeOf(m_sorted->mapToSource(index).row()));
    };
    connect(m_table, &QTableView::clicked, this, go);
    connect(m_table, &QTableView::activated, this, go);
    auto* remove = new QAction(QStringLiteral("Delete note"), m_table);
    m_table->installEventFilter(this);  // Delete
    connect(remove, &QAction::triggered, this, [this] { m_board->remove(selectedIds()); });
    m_table->addAction(remove);
    m_table->setContextMenuPolicy(Qt::ActionsContextMenu);
  }

  std::vector<quint64> selectedIds() const {
    std::vector<quint64> ids;
    for (const QModelIndex& index : m_table->selectionModel()->selectedRows()) {
      const quint64 id = m_model->idOf(m_sorted->mapToSource(index).row());
      if (id != 0) ids.push_back(id);
    }
    return ids;
  }

  /// What the filter lets through, without the bookmarks, which have no place.
  void askAndSave() {
    std::vector<telemetry::DrawnNote> notes;
    for (int row = 0; row < m_sorted->rowCount(); ++row) {
      const int own = m_sorted->mapToSource(m_sorted->index(row, 0)).row();
      if (m_model->idOf(own) != 0) notes.push_back(m_model->noteOf(own));
    }
    const QString path = askToSave(this, QStringLiteral("Save notes"), QStringLiteral("notes.csv"),
                                   QStringLiteral("Tables (*.csv);;JSON (*.json)"));
    if (path.isEmpty()) return;
    const std::string text = path.endsWith(QLatin1String(".json"), Qt::CaseInsensitive)
                                 ? drawnNotesJson(notes)
                                 : drawnNotesCsv(notes);
    const auto written =
        writeFile(path.toStdString(), {text.data(), text.size()}, IfExists::Replace);
    m_message->showMessage(written ? InPlaceMessage::Tone::Note : InPlaceMessage::Tone::Error,
                           written ? QStringLiteral("Saved as %1").arg(path)
                                   : QString::fromStdString(written.error().text()));
  }

  void showState() {
    const bool any = m_model->rowCount() > 0;
    m_table->setVisible(any);
    m_empty->setVisible(!any);
    m_filter->setEnabled(any);
    m_save->setEnabled(!m_board->entries().empty());
    m_delete->setEnabled(!selectedIds().empty());
  }

  NoteBoard* m_board;
  QLineEdit* m_filter;
  QPushButton* m_delete;
  QPushButton* m_save;
  InPlaceMessage* m_message;
  QTableView* m_table;
  NotesModel* m_model;
  TextFilter* m_sorted;
  QLabel* m_empty;
};

}  // namespace

QWidget* makeNotesDock(NoteBoard* board, QWidget* parent) {
  return new NotesDock(board, parent);
}

}  // namespace pitchboard::ui
