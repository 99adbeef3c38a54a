// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/library/library_dock.h>

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QDesktopServices>
#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollBar>
#include <QSettings>
#include <QStandardPaths>
#include <QUrl>
#include <QVBoxLayout>

#include <ui/base/file_dialog.h>
#include <ui/base/in_place_message.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/sources/session_recording.h>

#include "library_model.h"
#include "library_pictures.h"
#include "library_scan.h"

namespace pitchboard::ui {
namespace {

const QString foldersKey = QStringLiteral("library/folders");
constexpr int pictureWidth = 52, pictureHeight = 36;  // px of the mock

QString cacheFolder() {
  return QStandardPaths::writableLocation(QStandardPaths::CacheLocation) +
         QStringLiteral("/library");
}

class LibraryDock : public QWidget {
 public:
  LibraryDock(LibraryDockParts parts, QWidget* parent)
      : QWidget(parent),
        m_parts(std::move(parts)),
        m_scan(new LibraryScan(cacheFolder(), this)),
        m_pictures(new LibraryPictures(cacheFolder(), m_parts.pictures, this)),
        m_model(new LibraryModel(this)),
        m_table(new QTableView(this)),
        m_message(new InPlaceMessage(this)),
        m_empty(makeEmptyLabel(this, QStringLiteral("emptyLibrary"))) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(makeBar());
    column->addWidget(m_message);
    column->addWidget(m_table, 1);
    column->addWidget(m_empty, 1);
    m_message->clear();
    makeTable();
    makeMenu();
    connect(m_scan, &LibraryScan::listed, m_model, &LibraryModel::show);
    connect(m_scan, &LibraryScan::came, m_model, &LibraryModel::merge);
    connect(m_scan, &LibraryScan::changed, this, &LibraryDock::showState);
    connect(m_pictures, &LibraryPictures::came, m_model, &LibraryModel::changedPicture);
    connect(m_parts.recording, &SessionRecording::saved, this, [this] {
      if (isVisible() && !m_scan->isCancelled()) m_scan->start(folders());
    });
    showState();
  }
  QSize sizeHint() const override { return {scaled(this, 900), scaled(this, 300)}; }

 protected:
  void showEvent(QShowEvent* event) override {
    QWidget::showEvent(event);
    lookAgain();
  }
  bool event(QEvent* event) override {
    // Files may have come or gone while another window was used.
    if (event->type() == QEvent::WindowActivate) lookAgain();
    return QWidget::event(event);
  }
  void changeEvent(QEvent* event) override {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) m_pictures->changeTheme();
  }

 private:
  QHBoxLayout* makeBar() {
    m_folders->setObjectName(QStringLiteral("libraryFolders"));
    m_folders->setText(QStringLiteral("Folders"));
    m_folders->setToolTip(QStringLiteral("Choose the folders whose sessions are listed"));
    auto* menu = new QMenu(m_folders);
    connect(menu, &QMenu::aboutToShow, this, [this, menu] { fillFolders(menu); });
    m_folders->setMenu(menu);
    m_words->setObjectName(QStringLiteral("librarySearch"));
    m_words->setAccessibleName(QStringLiteral("Search"));
    m_words->setPlaceholderText(QStringLiteral("Search: team, robot, note, date, file"));
    m_words->setClearButtonEnabled(true);
    m_words->addAction(themedIcon(QStringLiteral("edit-find")), QLineEdit::LeadingPosition);
    connect(m_words, &QLineEdit::textChanged, this, [this](const QString& text) {
      m_model->setFilter(text);
      showState();
    });
    m_progress->setObjectName(QStringLiteral("libraryProgress"));
    m_progress->setTextVisible(false);
    m_progress->setFixedSize(scaled(this, 140), scaled(this, 8));
    m_state->setObjectName(QStringLiteral("libraryState"));
    m_state->setFont(themeFont(TypeRole::Secondary));
    m_state->setForegroundRole(QPalette::PlaceholderText);
    m_cancel->setObjectName(QStringLiteral("cancelLibrary"));
    m_cancel->setText(QStringLiteral("Cancel"));
    connect(m_cancel, &QPushButton::clicked, m_scan, &LibraryScan::cancel);
    auto* row = new QHBoxLayout;
    const int gap = scaled(this, 4);
    row->setContentsMargins(gap, gap, gap, gap);
    row->setSpacing(gap);
    row->addWidget(m_folders);
    row->addWidget(m_words, 1);
    row->addWidget(m_progress);
    row->addWidget(m_state);
    row->addWidget(m_cancel);
    return row;
  }

  void makeTable() {
    m_table->setObjectName(QStringLiteral("library"));
    QPixmap blank(scaled(this, pictureWidth), scaled(this, pictureHeight));
    blank.fill(Qt::transparent);
    m_model->setPictures([this](const LibraryRowPtr& row) { return m_pictures->pictureOf(row); },
                         blank);
    m_table->setModel(m_model);
    styleTable(m_table);
    m_table->setIconSize(blank.size());
    m_table->verticalHeader()->setDefaultSectionSize(scaled(this, pictureHeight + 4));
    m_table->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    m_table->setSelectionMode(QAbstractItemView::SingleSelection);
    m_table->setSortingEnabled(true);
    m_table->sortByColumn(LibraryRow::Date, Qt::DescendingOrder);
    constexpr int widths[LibraryRow::columns] = {186, 150, 56, 64, 56, 60, 190, 200};  // px
    for (int column = 0; column < LibraryRow::columns; ++column) {
      m_table->setColumnWidth(column, scaled(this, widths[column]));
    }
    // Enter opens, too; it must not do so twice where a click already activates.
    connect(m_table, &QTableView::clicked, this, [this] { openCurrent(); });
    auto* enter = new QAction(QStringLiteral("&Open"), m_table);
    enter->setObjectName(QStringLiteral("openFromLibrary"));
    enter->setShortcuts({Qt::Key_Return, Qt::Key_Enter});
    enter->setShortcutContext(Qt::WidgetShortcut);
    connect(enter, &QAction::triggered, this, [this] { openCurrent(); });
    m_table->addAction(enter);
    // Rows that come, go or are sorted neither scroll the table nor change what is chosen.
    connect(m_model, &QAbstractItemModel::modelAboutToBeReset, this, [this] {
      m_scrolled = m_table->verticalScrollBar()->value();
      if (m_table->currentIndex().isValid()) m_current = currentPath();
    });
    connect(m_model, &QAbstractItemModel::modelReset, this, [this] { restorePlace(); });
  }

  void makeMenu() {
    const auto action = [this](const char* name, const QString& text, auto slot) {
      auto* made = new QAction(text, m_table);
      made->setObjectName(QLatin1String(name));
      connect(made, &QAction::triggered, this, [this, slot] {
        if (m_table->currentIndex().isValid()) slot();
      });
      m_table->addAction(made);
      return made;
    };
    action("compareFromLibrary", QStringLiteral("&Compare with what is shown"),
           [this] { m_parts.compare(currentPath()); });
    action("showLibraryFolder", QStringLiteral("Show &folder"), [this] {
      QDesktopServices::openUrl(QUrl::fromLocalFile(QFileInfo(currentPath()).path()));
    });
    action("copyLibraryRow", QStringLiteral("Copy"), [this] {
      copyCurrent();
    })->setShortcut(QKeySequence::Copy);
    m_table->actions().back()->setShortcutContext(Qt::WidgetShortcut);
    m_remove =
        action("removeLibraryFolder", QString(), [this] { removeFolder(folderOf(currentPath())); });
    m_table->setContextMenuPolicy(Qt::ActionsContextMenu);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentChanged, this,
            [this] { nameFolder(); });
    nameFolder();
  }

  /// The menu says which folder it removes.
  void nameFolder() {
    const QModelIndex current = m_table->currentIndex();
    const QString folder =
        current.isValid() ? folderOf(m_model->at(current.row())->path) : QString();
    m_remove->setText(
        QStringLiteral("&Remove the folder %1 from the library").arg(QDir(folder).dirName()));
    for (QAction* each : m_table->actions()) each->setEnabled(current.isValid());
  }

  QStringList folders() const {
    if (m_parts.settings != nullptr && m_parts.settings->contains(foldersKey)) {
      return m_parts.settings->value(foldersKey).toStringList();
    }
    return {m_parts.recording->folder()};
  }

  void setFolders(const QStringList& all) {
    if (m_parts.settings != nullptr) m_parts.settings->setValue(foldersKey, all);
    m_scan->start(all);
  }

  void addFolder() {
    const QString chosen = askForFolder(this, QStringLiteral("Add a folder to the library"));
    if (chosen.isEmpty()) return;
    QStringList all = folders();
    if (!all.contains(chosen)) all << chosen;
    setFolders(all);
  }

  void removeFolder(const QString& folder) {
    QStringList all = folders();
    if (all.removeAll(folder) > 0) setFolders(all);
  }

  /// The folder of the library in which a file was found: the innermost.
  QString folderOf(const QString& path) const {
    QString found;
    for (const QString& folder : folders()) {
      const QString beginning = QDir::cleanPath(folder) + QLatin1Char('/');
      if (QDir::cleanPath(path).startsWith(beginning) && folder.size() > found.size())
        found = folder;
    }
    return found;
  }

  void fillFolders(QMenu* menu) {
    menu->clear();
    menu->addAction(QStringLiteral("&Add folder…"), this, [this] { addFolder(); });
    menu->addAction(QStringLiteral("&Look again"), this, [this] { m_scan->start(folders()); });
    menu->addSeparator();
    for (const QString& folder : folders()) {
      menu->addAction(QStringLiteral("Remove %1").arg(QDir::toNativeSeparators(folder)), this,
                      [this, folder] { removeFolder(folder); });
    }
  }

  void lookAgain() {
    if (isVisible() && !m_scan->isRunning() && !m_scan->isCancelled()) m_scan->start(folders());
  }

  QString currentPath() const { return m_model->at(m_table->currentIndex().row())->path; }

  void openCurrent() {
    if (m_table->currentIndex().isValid()) m_parts.open(currentPath());
  }

  /// With tabs, for a spreadsheet.
  void copyCurrent() const {
    const LibraryRow& row = *m_model->at(m_table->currentIndex().row());
    QStringList cells(row.texts.begin(), row.texts.end());
    cells[LibraryRow::File] = row.path;
    QApplication::clipboard()->setText(cells.join(QLatin1Char('\t')) + QLatin1Char('\n'));
  }

  void restorePlace() {
    const int row = m_current.isEmpty() ? -1 : m_model->rowOf(m_current);
    if (row >= 0) {
      m_table->selectionModel()->setCurrentIndex(
          m_model->index(row, 0), QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    }
    m_table->doItemsLayout();
    m_table->verticalScrollBar()->setValue(m_scrolled);
    nameFolder();
  }

  QString stateText() const {
    const auto count = [](std::size_t sessions) {
      return sessions == 1 ? QStringLiteral("1 session")
                           : QStringLiteral("%1 sessions").arg(countText(sessions));
    };
    const int shown = m_model->rowCount();
    const QString all =
        m_words->text().isEmpty()
            ? count(m_model->all())
            : QStringLiteral("%1 of %2")
                  .arg(countText(static_cast<qulonglong>(shown)), count(m_model->all()));
    if (m_scan->isRunning() && m_scan->unknown() > 0) {
      return QStringLiteral("%1, reading %2 of %3")
          .arg(all, countText(m_scan->read()), countText(m_scan->unknown()));
    }
    return m_scan->isCancelled() ? all + QStringLiteral(", cancelled") : all;
  }

  void showState() {
    const bool isReading = m_scan->isRunning() && m_scan->unknown() > 0;
    m_progress->setVisible(isReading);
    m_cancel->setVisible(isReading);
    m_progress->setRange(0, static_cast<int>(m_scan->unknown()));
    m_progress->setValue(static_cast<int>(m_scan->read()));
    m_state->setText(stateText());
    const bool isEmpty = m_model->rowCount() == 0;
    m_table->setVisible(!isEmpty);
    m_empty->setVisible(isEmpty);
    m_empty->setText(emptyText());
    const QString problems = m_scan->problems().join(QLatin1Char('\n'));
    if (std::exchange(m_said, problems) == problems) return;
    if (problems.isEmpty()) {
      m_message->clear();
    } else {
      m_message->showMessage(InPlaceMessage::Tone::Warning, problems);
    }
  }

  QString emptyText() const {
    if (m_model->all() > 0) return QStringLiteral("No session has all of these words.");
    if (m_scan->isRunning()) return QStringLiteral("Looking for sessions…");
    const QStringList all = folders();
    if (all.isEmpty())
      return QStringLiteral("Add a folder with Folders > Add folder… to see its sessions here.");
    return QStringLiteral("No sessions (*.mcap) in %1 yet. Record a match, or add another folder.")
        .arg(all.join(QStringLiteral(", ")));
  }

  LibraryDockParts m_parts;
  LibraryScan* m_scan;
  LibraryPictures* m_pictures;
  LibraryModel* m_model;
  QTableView* m_table;
  InPlaceMessage* m_message;
  QLabel* m_empty;
  QPushButton* m_folders = new QPushButton(this);
  QLineEdit* m_words = new QLineEdit(this);
  QProgressBar* m_progress = new QProgressBar(this);
  QLabel* m_state = new QLabel(this);
  QPushButton* m_cancel = new QPushButton(this);
  QAction* m_remove = nullptr;
  QString m_current;   // path of the session that is chosen
  int m_scrolled = 0;  // of the table, while its rows change
  QString m_said;
};

}  // namespace

QWidget* makeLibraryDock(LibraryDockParts parts, QWidget* parent) {
  return new LibraryDock(std::move(parts), parent);
}

}  // namespace pitchboard::ui
