// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Programs of tests/end_to_end that pages of docs/ show to the letter: what people copy is what
// tests run.

#include <QByteArray>
#include <QDir>
#include <QFile>
#include <QString>

/// Why no page of docs/ shows this program (its first line, the licence, may be left out there);
/// empty when one does, in at most `lines` lines.
inline QString whyNotShown(const QString& name, int lines) {
  QFile program(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/end_to_end/") + name);
  if (!program.open(QIODevice::ReadOnly)) return QStringLiteral("there is no ") + name;
  const QByteArray whole = program.readAll();
  const QByteArray language = name.endsWith(QStringLiteral(".py")) ? "python" : "cpp";
  const QByteArray begin = "```" + language + ' ' + name.toUtf8() + '\n';
  const QDir docs(QStringLiteral(PITCHBOARD_SOURCE_DIR "/docs"));
  for (const QString& page : docs.entryList({QStringLiteral("*.md")})) {
    QFile file(docs.filePath(page));
    if (!file.open(QIODevice::ReadOnly)) continue;
    const QByteArray text = file.readAll();
    for (const QByteArray& shown : {whole, whole.mid(whole.indexOf('\n') + 1)}) {
      if (!text.contains(begin + shown + "```\n")) continue;
      const auto count = shown.count('\n');
      return count <= lines ? QString() : QStringLiteral("%1 has %2 lines").arg(name).arg(count);
    }
  }
  return QStringLiteral("no page shows ") + name;
}
