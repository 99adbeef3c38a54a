// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile_editor.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <iterator>
#include <set>

#include <base/file_target.h>
#include <ui/base/dialog_size.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

using telemetry::FieldMeaning;
using telemetry::FieldType;
using telemetry::Profile;
using telemetry::ProfileField;

enum Column { Name, Type, Unit, Category, Meaning, columns };

constexpr const char* typeWords[] = {"int", "float", "flag", "text"};

QComboBox* choice(QTableWidget* table, int row, int column) {
  return static_cast<QComboBox*>(table->cellWidget(row, column));
}

QString meaningText(FieldMeaning meaning) {
  const std::string_view name = telemetry::meaningName(meaning);
  return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
}

}  // namespace

ProfileEditor::ProfileEditor(const Profile& profile, const QString& file, QWidget* parent)
    : QDialog(parent),
      m_file(file),
      m_opened(profile),
      m_name(new QLineEdit(this)),
      m_end(new QLineEdit(this)),
      m_table(new QTableWidget(0, columns, this)),
      m_problem(new QLabel(this)) {
  setObjectName(QStringLiteral("profileEditor"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(QStringLiteral("Fields of a message"));
  m_name->setText(QString::fromStdString(profile.name));
  m_end->setText(QString::fromStdString(profile.end));
  m_end->setToolTip(QStringLiteral("The word that ends a message"));
  auto* form = new QFormLayout;
  form->addRow(QStringLiteral("Name"), m_name);
  form->addRow(QStringLiteral("Last word"), m_end);

  m_table->setHorizontalHeaderLabels({QStringLiteral("Name"), QStringLiteral("Type"),
                                      QStringLiteral("Unit"), QStringLiteral("Category"),
                                      QStringLiteral("Meaning")});
  m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
  m_table->verticalHeader()->setDefaultSectionSize(scaled(this, 26));
  m_table->horizontalHeader()->setStretchLastSection(true);
  for (const ProfileField& field : profile.fields) addRow(m_table->rowCount(), field);
  connect(m_table, &QTableWidget::itemChanged, this, &ProfileEditor::check);
  for (QLineEdit* edit : {m_name, m_end}) {
    connect(edit, &QLineEdit::textChanged, this, &ProfileEditor::check);
  }

  auto* tools = new QHBoxLayout;
  const auto addTool = [&](const char* icon, const QString& tip, const char* name, auto slot) {
    auto* button = new QToolButton(this);
    button->setObjectName(QLatin1String(name));
    button->setIcon(themedIcon(QLatin1String(icon)));
    button->setText(tip);
    button->setToolTip(tip);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    connect(button, &QToolButton::clicked, this, slot);
    tools->addWidget(button);
  };
  addTool("list-add", QStringLiteral("Add"), "addField", [this] {
    const int row = m_table->currentRow() + 1;
    ProfileField field;
    field.name = "FIELD_" + std::to_string(m_table->rowCount() + 1);
    addRow(row > 0 ? row : m_table->rowCount(), field);
    m_table->setCurrentCell(row > 0 ? row : m_table->rowCount() - 1, Name);
    check();
  });
  addTool("list-remove", QStringLiteral("Remove"), "removeField", [this] { removeRows(); });
  addTool("go-up", QStringLiteral("Up"), "fieldUp", [this] { moveRow(-1); });
  addTool("go-down", QStringLiteral("Down"), "fieldDown", [this] { moveRow(1); });
  tools->addStretch(1);

  m_problem->setObjectName(QStringLiteral("profileProblem"));
  m_problem->setWordWrap(true);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  m_save = buttons->addButton(QStringLiteral("Save as…"), QDialogButtonBox::ActionRole);
  m_save->setObjectName(QStringLiteral("saveProfile"));
  connect(m_save, &QPushButton::clicked, this, &ProfileEditor::askAndSave);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addLayout(form);
  column->addWidget(m_table, 1);
  column->addLayout(tools);
  column->addWidget(m_problem);
  column->addWidget(buttons);
  resize(dialogSize(this, 620, 560));
  check();
}

void ProfileEditor::addRow(int row, const ProfileField& field) {
  const QSignalBlocker quiet(m_table);
  m_table->insertRow(row);
  const auto text = [&](int column, const std::string& value) {
    m_table->setItem(row, column, new QTableWidgetItem(QString::fromStdString(value)));
  };
  text(Name, field.name);
  m_table->item(row, Name)->setData(Qt::UserRole, static_cast<qulonglong>(m_fields.size()));
  m_fields.push_back(field);
  text(Unit, field.unit);
  text(Category, field.category);
  auto* type = new QComboBox(m_table);
  for (const char* word : typeWords) type->addItem(QLatin1String(word));
  type->setCurrentIndex(static_cast<int>(field.type));
  auto* meaning = new QComboBox(m_table);
  for (std::size_t i = 0; i < telemetry::fieldMeaningCount; ++i) {
    meaning->addItem(i == 0 ? QStringLiteral("(display only)")
                            : meaningText(static_cast<FieldMeaning>(i)));
  }
  meaning->setCurrentIndex(static_cast<int>(field.meaning));
  m_table->setCellWidget(row, Type, type);
  m_table->setCellWidget(row, Meaning, meaning);
  for (QComboBox* box : {type, meaning}) {
    connect(box, &QComboBox::currentIndexChanged, this, &ProfileEditor::check);
  }
}

ProfileField ProfileEditor::fieldAt(int row) const {
  const auto text = [&](int column) {
    const QTableWidgetItem* item = m_table->item(row, column);
    return item == nullptr ? std::string() : item->text().trimmed().toStdString();
  };
  ProfileField made = m_fields.at(m_table->item(row, Name)->data(Qt::UserRole).toULongLong());
  made.name = text(Name);
  made.type = static_cast<FieldType>(choice(m_table, row, Type)->currentIndex());
  made.unit = text(Unit);
  made.category = text(Category);
  made.meaning = static_cast<FieldMeaning>(choice(m_table, row, Meaning)->currentIndex());
  return made;
}

Profile ProfileEditor::profile() const {
  Profile made = m_opened;
  made.fields.clear();
  made.name = m_name->text().trimmed().toStdString();
  made.end = m_end->text().trimmed().toStdString();
  for (int row = 0; row < m_table->rowCount(); ++row) made.fields.push_back(fieldAt(row));
  return made;
}

void ProfileEditor::moveRow(int by) {
  const int row = m_table->currentRow();
  const int to = row + by;
  if (row < 0 || to < 0 || to >= m_table->rowCount()) return;
  const ProfileField field = fieldAt(row);
  m_table->removeRow(row);
  addRow(to, field);
  m_table->setCurrentCell(to, Name);
  check();
}

void ProfileEditor::removeRows() {
  std::set<int> rows;
  for (const QModelIndex& index : m_table->selectionModel()->selectedIndexes()) {
    rows.insert(index.row());
  }
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) m_table->removeRow(*row);
  check();
}

void ProfileEditor::say(const QString& sentence, bool bad) {
  QPalette colours = palette();
  colours.setColor(QPalette::WindowText, bad ? theme().errorText : theme().secondaryText);
  m_problem->setPalette(colours);
  m_problem->setText(sentence);
}

void ProfileEditor::check() {
  const Profile now = profile();
  const auto good = telemetry::validate(now);
  m_save->setEnabled(good.has_value());
  if (good)
    say(QStringLiteral("%1 fields. Save the profile to use it.").arg(now.fields.size()), false);
  else
    say(QString::fromStdString(good.error().text()), true);
}

bool ProfileEditor::saveTo(const QString& path) {
  const Profile now = profile();
  const std::string text = telemetry::profileText(now);
  // Reading it back finds everything that reading it later would.
  if (const auto again = telemetry::parseProfile(text, path.toStdString()); !again) {
    say(QString::fromStdString(again.error().text()), true);
    return false;
  }
  if (const auto written = writeFile(path.toStdString(), text, IfExists::Replace); !written) {
    say(QStringLiteral("Could not write %1. %2")
            .arg(path, QString::fromStdString(written.error().message)),
        true);
    return false;
  }
  m_file = path;
  emit saved(now, path);
  say(QStringLiteral("Saved as %1.").arg(QFileInfo(path).fileName()), false);
  return true;
}

void ProfileEditor::askAndSave() {
  auto* ask = new QFileDialog(this, QStringLiteral("Save the profile"), m_file,
                              QStringLiteral("Profiles (*.json)"));
  ask->setAttribute(Qt::WA_DeleteOnClose);
  ask->setAcceptMode(QFileDialog::AcceptSave);
  ask->setDefaultSuffix(QStringLiteral("json"));
  connect(ask, &QFileDialog::fileSelected, this, &ProfileEditor::saveTo);
  ask->open();
}

}  // namespace pitchboard::ui
