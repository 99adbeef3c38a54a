// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/variable_names.h>

#include <QAbstractItemView>
#include <QCompleter>
#include <QLineEdit>
#include <QMimeData>
#include <QStringListModel>
#include <algorithm>
#include <utility>

#include <ui/base/plot_target.h>

namespace pitchboard::ui {
namespace {

constexpr int mostDragged = 200;

bool isOfName(QChar c) {
  return c.isLetterOrNumber() || c == QLatin1Char('_') || c == QLatin1Char('.');
}

/// The name that is being written at the cursor.
std::pair<int, int> nameAt(const QLineEdit& edit) {
  const QString text = edit.text();
  int begin = edit.cursorPosition();
  const int end = begin;
  while (begin > 0 && isOfName(text[begin - 1])) --begin;
  return {begin, end};
}

}  // namespace

QStringList draggedVariables(const QMimeData* data) {
  if (data == nullptr || !data->hasFormat(variablesMimeType)) return {};
  QStringList names;
  for (const QString& line : QString::fromUtf8(data->data(variablesMimeType)).split('\n')) {
    const QString name = line.trimmed();
    if (name.indexOf(QLatin1Char('/')) > 0 && !names.contains(name) && names.size() < mostDragged) {
      names << name;
    }
  }
  return names;
}

QString inExpression(const QString& name) {
  const bool plain = std::all_of(name.begin(), name.end(),
                                 [](QChar c) { return isOfName(c) || c == QLatin1Char('/'); }) &&
                     name.count(QLatin1Char('/')) <= 1;
  return plain ? QString(name).replace(QLatin1Char('/'), QLatin1Char('.'))
               : QStringLiteral("{%1}").arg(name);
}

void completeNames(QLineEdit* edit, const QStringList& names) {
  QStringList written;
  for (const QString& name : names) written << inExpression(name);
  const QString completerName = QStringLiteral("expressionCompleter");
  if (auto* known = edit->findChild<QCompleter*>(completerName)) {
    qobject_cast<QStringListModel*>(known->model())->setStringList(written);
    return;
  }
  auto* completer = new QCompleter(new QStringListModel(written, edit), edit);
  completer->setObjectName(completerName);
  completer->setFilterMode(Qt::MatchContains);
  completer->setCaseSensitivity(Qt::CaseInsensitive);
  completer->setMaxVisibleItems(15);
  completer->setWidget(edit);
  QObject::connect(edit, &QLineEdit::textEdited, completer, [edit, completer] {
    constexpr int enough = 2;  // letters, before everything would be offered
    const auto [begin, end] = nameAt(*edit);
    const QString word = edit->text().mid(begin, end - begin);
    if (word.size() < enough || word.front().isDigit()) {
      completer->popup()->hide();
      return;
    }
    completer->setCompletionPrefix(word);
    completer->complete();
  });
  QObject::connect(completer, qOverload<const QString&>(&QCompleter::activated), edit,
                   [edit](const QString& chosen) {
                     const auto [begin, end] = nameAt(*edit);
                     const QString text = edit->text();
                     edit->setText(text.left(begin) + chosen + text.mid(end));
                     edit->setCursorPosition(begin + int(chosen.size()));
                   });
}

}  // namespace pitchboard::ui
