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
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include <base/file_target.h>
#include <ui/base/dialog_size.h>
#include <ui/base/file_dialog.h>
#include <ui/base/theme.h>
#include <ui/sources/live_controller.h>

#include "arrivals.h"
#include "team_preview.h"

namespace pitchboard::ui {
namespace {

using telemetry::FieldMeaning;
using telemetry::FieldType;
using telemetry::Profile;
using telemetry::ProfileField;

enum Column { Name, Type, Unit, Scale, Offset, Category, Meaning, Labels, columns };

constexpr const char* typeNames[] = {"int", "float", "flag", "text"};

QComboBox* choice(QTableWidget* table, int row, int column) {
  return static_cast<QComboBox*>(table->cellWidget(row, column));
}

/// "0 = stop, 1 = walk".
QString labelsText(const ProfileField& field) {
  QStringList all;
  for (const auto& [code, label] : field.labels) {
    all << QStringLiteral("%1 = %2").arg(code).arg(QString::fromStdString(label));
  }
  return all.join(QStringLiteral(", "));
}

/// Nothing where it cannot be read.
std::optional<std::map<std::int32_t, std::string>> labelsFrom(const QString& text) {
  std::map<std::int32_t, std::string> labels;
  for (const QString& part : text.split(QLatin1Char(','), Qt::SkipEmptyParts)) {
    const qsizetype equals = part.indexOf(QLatin1Char('='));
    bool good = false;
    const int code = part.left(equals).trimmed().toInt(&good);
    const QString label = equals < 0 ? QString() : part.mid(equals + 1).trimmed();
    if (!good || label.isEmpty()) return std::nullopt;
    labels[code] = label.toStdString();
  }
  return labels;
}

QString meaningText(FieldMeaning meaning) {
  const std::string_view name = telemetry::meaningName(meaning);
  return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
}

}  // namespace

ProfileEditor::ProfileEditor(const Profile& profile, const QString& file, QWidget* parent,
                             LiveController* live)
    : QDialog(parent),
      m_file(file),
      m_opened(profile),
      m_name(new QLineEdit(this)),
      m_end(new QLineEdit(this)),
      m_origin(new QComboBox(this)),
      m_xAxis(new QComboBox(this)),
      m_yAxis(new QComboBox(this)),
      m_angles(new QComboBox(this)),
      m_table(new QTableWidget(0, columns, this)),
      m_last(new QLabel(this)),
      m_problem(new QLabel(this)),
      m_live(live) {
  setObjectName(QStringLiteral("profileEditor"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(QStringLiteral("Fields of a message"));
  m_name->setText(QString::fromStdString(profile.name));
  m_end->setText(QString::fromStdString(profile.end));
  m_end->setToolTip(QStringLiteral("The word that ends a message"));
  auto* form = new QFormLayout;
  form->addRow(QStringLiteral("Name"), m_name);
  form->addRow(QStringLiteral("End word"), m_end);
  addFrame(form);

  m_table->setHorizontalHeaderLabels({QStringLiteral("Name"), QStringLiteral("Type"),
                                      QStringLiteral("Unit"), QStringLiteral("Scale"),
                                      QStringLiteral("Offset"), QStringLiteral("Category"),
                                      QStringLiteral("Meaning"), QStringLiteral("Labels")});
  m_table->horizontalHeaderItem(Scale)->setToolTip(
      QStringLiteral("Value = scale × received number + offset"));
  m_table->horizontalHeaderItem(Labels)->setToolTip(
      QStringLiteral("Labels of codes: 0 = stop, 1 = walk"));
  const std::pair<int, int> widths[] = {{Name, 150},  {Type, 84},     {Unit, 52},    {Scale, 56},
                                        {Offset, 56}, {Category, 96}, {Meaning, 150}};
  for (const auto& [at, wide] : widths) m_table->setColumnWidth(at, scaled(this, wide));
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
  m_last->setObjectName(QStringLiteral("lastMessage"));
  m_last->setWordWrap(true);
  m_last->setForegroundRole(QPalette::PlaceholderText);
  m_last->setVisible(live != nullptr);
  column->addWidget(m_last);
  column->addWidget(m_problem);
  column->addWidget(buttons);
  resize(dialogSize(this, 860, 560));
  check();
  if (live == nullptr) return;
  m_arrivals = std::make_unique<Arrivals>(live);
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, &ProfileEditor::showLast);
  constexpr int refreshMilliseconds = 500;
  timer->start(refreshMilliseconds);
  showLast();
}

ProfileEditor::~ProfileEditor() = default;

// Of x, y, theta and a ball on the field.
void ProfileEditor::addFrame(QFormLayout* form) {
  auto* row = new QHBoxLayout;
  const auto add = [&](QComboBox* box, const char* name, std::initializer_list<const char*> choices,
                       int chosen) {
    box->setObjectName(QLatin1String(name));
    for (const char* label : choices) box->addItem(QString::fromUtf8(label));
    box->setCurrentIndex(chosen);
    row->addWidget(box);
    connect(box, &QComboBox::currentIndexChanged, this, &ProfileEditor::check);
  };
  const telemetry::MessageFrame& frame = m_opened.frame;
  add(m_origin, "frameOrigin", {"Origin: corner", "Origin: centre mark"}, frame.centre ? 1 : 0);
  add(m_xAxis, "frameX", {"+x to the right", "+x to the left", "+x to the opponents"},
      static_cast<int>(frame.x));
  add(m_yAxis, "frameY", {"+y right of +x", "+y left of +x"}, frame.yLeft ? 1 : 0);
  add(m_angles, "frameAngles", {"Angles counter-clockwise", "Angles clockwise"},
      frame.clockwise ? 1 : 0);
  row->addStretch(1);
  form->addRow(QStringLiteral("Frame"), row);
}

void ProfileEditor::showLast() {
  const std::vector<Arrival> all = m_arrivals->newest();
  const auto last = std::ranges::max_element(all, {}, [](const Arrival& one) { return one.time; });
  if (last == all.end()) {
    m_last->setText(QStringLiteral("Last message: none has arrived yet."));
    return;
  }
  link::LiveOptions options = m_live->options();
  options.team.teams.clear();
  if (const Profile now = profile(); telemetry::validate(now)) options.profile = now;
  const std::vector<PreviewRow> rows = previewOf({*last}, options, {});
  m_last->setText(rows.empty()
                      ? QString()
                      : QStringLiteral("Last message, from %1: %2 %3")
                            .arg(rows.front().sender, rows.front().robot, rows.front().values));
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
  text(Scale, QString::number(field.scale, 'g', 12).toStdString());
  text(Offset, QString::number(field.offset, 'g', 12).toStdString());
  text(Labels, labelsText(field).toStdString());
  text(Category, field.category);
  auto* type = new QComboBox(m_table);
  for (const char* label : typeNames) type->addItem(QLatin1String(label));
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
  // What cannot be read keeps what it was; check() says so.
  const ProfileField was = made;
  bool good = false;
  const auto number = [&](int column, double before) {
    const double read = QString::fromStdString(text(column)).toDouble(&good);
    // As it was shown: the digits behind it stay.
    const bool untouched = text(column) == QString::number(before, 'g', 12).toStdString();
    return good && !untouched ? read : before;
  };
  made.scale = number(Scale, was.scale);
  made.offset = number(Offset, was.offset);
  if (QString::fromStdString(text(Labels)) != labelsText(was)) {
    made.labels = labelsFrom(QString::fromStdString(text(Labels))).value_or(was.labels);
  }
  made.category = text(Category);
  made.meaning = static_cast<FieldMeaning>(choice(m_table, row, Meaning)->currentIndex());
  return made;
}

Profile ProfileEditor::profile() const {
  Profile made = m_opened;
  made.fields.clear();
  made.name = m_name->text().trimmed().toStdString();
  made.end = m_end->text().trimmed().toStdString();
  made.frame = {m_origin->currentIndex() == 1,
                static_cast<telemetry::MessageFrame::XAxis>(m_xAxis->currentIndex()),
                m_yAxis->currentIndex() == 1, m_angles->currentIndex() == 1};
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

void ProfileEditor::showStatus(const QString& sentence, bool bad) {
  QPalette colours = palette();
  colours.setColor(QPalette::WindowText, bad ? theme().errorText : theme().secondaryText);
  m_problem->setPalette(colours);
  m_problem->setText(sentence);
}

void ProfileEditor::check() {
  const Profile now = profile();
  auto good = telemetry::validate(now);
  for (int row = 0; good && row < m_table->rowCount(); ++row) {
    const auto cell = [&](int column) { return m_table->item(row, column)->text(); };
    bool isScale = false, isOffset = false;
    (void)cell(Scale).toDouble(&isScale);
    (void)cell(Offset).toDouble(&isOffset);
    const ProfileField& was =
        m_fields.at(m_table->item(row, Name)->data(Qt::UserRole).toULongLong());
    const bool areLabels = cell(Labels) == labelsText(was) || labelsFrom(cell(Labels));
    const char* wrong = !isScale     ? "the scale is not a number"
                        : !isOffset  ? "the offset is not a number"
                        : !areLabels ? "write labels as 0 = stop, 1 = walk"
                                     : nullptr;
    if (wrong != nullptr) {
      good = failure(ErrorCode::InvalidArgument, cell(Name).toStdString() + ": " + wrong);
    }
  }
  m_save->setEnabled(good.has_value());
  if (good)
    showStatus(QStringLiteral("%1 fields. Save the profile to use it.").arg(now.fields.size()),
               false);
  else
    showStatus(QString::fromStdString(good.error().text()), true);
}

bool ProfileEditor::saveTo(const QString& path) {
  if (!m_save->isEnabled()) return false;
  const Profile now = profile();
  const std::string text = telemetry::profileText(now);
  // Reading it back finds everything that reading it later would.
  if (const auto again = telemetry::parseProfile(text, path.toStdString()); !again) {
    showStatus(QString::fromStdString(again.error().text()), true);
    return false;
  }
  if (const auto written = writeFile(path.toStdString(), text, IfExists::Replace); !written) {
    showStatus(QStringLiteral("Could not write %1. %2")
                   .arg(path, QString::fromStdString(written.error().message)),
               true);
    return false;
  }
  m_file = path;
  emit saved(now, path);
  showStatus(QStringLiteral("Saved as %1.").arg(QFileInfo(path).fileName()), false);
  return true;
}

void ProfileEditor::askAndSave() {
  auto* ask = new QFileDialog(this, QStringLiteral("Save the profile"), m_file,
                              QStringLiteral("Profiles (*.json)"));
  ask->setAttribute(Qt::WA_DeleteOnClose);
  ask->setAcceptMode(QFileDialog::AcceptSave);
  ask->setDefaultSuffix(QStringLiteral("json"));
  connect(ask, &QFileDialog::fileSelected, this, &ProfileEditor::saveTo);
  openInDialogFolder(ask);
}

}  // namespace pitchboard::ui
