// SPDX-License-Identifier: GPL-3.0-or-later
#include "note_editor.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QPushButton>

#include <ui/base/number_box.h>
#include <ui/base/theme.h>
#include <ui/sources/event_list.h>

namespace pitchboard::ui {

using telemetry::DrawnNote;

void editNote(QWidget* parent, const QPoint& global, const DrawnNote& note,
              const std::function<void(const DrawnNote&)>& accept,
              const std::function<void()>& remove) {
  auto* dialog = new QDialog(parent);
  dialog->setObjectName(QStringLiteral("noteEditor"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(remove ? QStringLiteral("Change note") : QStringLiteral("Text note"));
  auto* text = new QLineEdit(QString::fromStdString(note.text), dialog);
  text->setObjectName(QStringLiteral("noteText"));
  text->setMaxLength(EventList::maxNote);
  text->setMinimumWidth(scaled(dialog, 240));
  auto* duration = new NumberBox(dialog);
  duration->setObjectName(QStringLiteral("noteDuration"));
  duration->setRange(DrawnNote::shortestDuration, DrawnNote::longestDuration);
  duration->setDecimals(1);
  duration->setSuffix(QStringLiteral(" s"));
  duration->setValue(note.duration);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, dialog);
  if (remove) {
    QPushButton* button =
        buttons->addButton(QStringLiteral("Delete"), QDialogButtonBox::DestructiveRole);
    button->setObjectName(QStringLiteral("deleteNote"));
    QObject::connect(button, &QPushButton::clicked, dialog, [dialog, remove] {
      remove();
      dialog->reject();
    });
  }
  auto* form = new QFormLayout(dialog);
  form->addRow(QStringLiteral("Text:"), text);
  form->addRow(QStringLiteral("Shown for:"), duration);
  form->addRow(buttons);
  // Without its text, a text is nothing.
  const bool needsText = note.shape == telemetry::NoteShape::Text;
  QPushButton* ok = buttons->button(QDialogButtonBox::Ok);
  const auto check = [ok, text, needsText] {
    ok->setEnabled(!needsText || !text->text().simplified().isEmpty());
  };
  check();
  QObject::connect(text, &QLineEdit::textChanged, dialog, check);
  QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  QObject::connect(buttons, &QDialogButtonBox::accepted, dialog,
                   [dialog, text, duration, note, accept] {
                     DrawnNote changed = note;
                     changed.text = text->text().simplified().toStdString();
                     changed.duration = duration->value();
                     accept(changed);
                     dialog->accept();
                   });
  dialog->adjustSize();
  dialog->move(global);
  dialog->open();
  text->selectAll();
  text->setFocus();
}

}  // namespace pitchboard::ui
