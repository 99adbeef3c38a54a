// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Packets recorded from real GameControllers (tests/data/gamecontroller), by their names without
// ending. A missing one ends the test program: nothing could be tested.

#include <QByteArray>
#include <QDir>
#include <QFile>
#include <QString>
#include <QStringList>
#include <QtTest>
#include <string>

inline QString recordedPacketFile(const QString& name, const char* ending) {
  return QStringLiteral(PITCHBOARD_TEST_DATA "/gamecontroller/") + name + QLatin1String(ending);
}

inline QByteArray recordedPacketFileBytes(const QString& name, const char* ending) {
  QFile file(recordedPacketFile(name, ending));
  if (!file.open(QIODevice::ReadOnly)) qFatal("no recorded packet %s", qPrintable(name));
  return file.readAll();
}

inline std::string recordedPacket(const QString& name) {
  return recordedPacketFileBytes(name, ".bin").toStdString();
}

/// The names of all.
inline QStringList recordedPackets() {
  QStringList names = QFileInfo(recordedPacketFile({}, "")).dir().entryList({"*.bin"});
  for (QString& name : names) name.chop(4);
  return names;
}

/// A row of the test's data for each: the column "packet" has its name.
inline void addRecordedPackets() {
  QTest::addColumn<QString>("packet");
  const QStringList names = recordedPackets();
  QVERIFY(names.size() > 100);
  for (const QString& name : names) QTest::newRow(qPrintable(name)) << name;
}
