// SPDX-License-Identifier: GPL-3.0-or-later
// A match gives the same bits whatever the processor can do: played by child processes in which the
// C library may and may not use fused multiply-add and vectors of 256 bits.
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QtTest>

namespace tst_same_bits {

namespace {

/// Hash of the last state. `features`: for GLIBC_TUNABLES; empty: what the processor has.
QString hashOf(const QStringList& arguments, const QString& features) {
  QProcess process;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.remove(QStringLiteral("GLIBC_TUNABLES"));
  if (!features.isEmpty()) environment.insert(QStringLiteral("GLIBC_TUNABLES"), features);
  process.setProcessEnvironment(environment);
  process.start(QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli"),
                QStringList{"simulate", "--json"} + arguments);
  if (!process.waitForFinished(240'000) || process.exitCode() != 0) {
    return QString::fromUtf8(process.readAllStandardError());
  }
  const auto json = QJsonDocument::fromJson(process.readAllStandardOutput()).object();
  return json.value(QStringLiteral("state_hash")).toString();
}

}  // namespace

class TestSameBits : public QObject {
  Q_OBJECT

 private slots:
  void withAndWithoutFusedMultiplyAdd_data() {
    QTest::addColumn<QStringList>("match");
    QTest::addColumn<QString>("golden");
    // A change of these numbers means that recorded runs no longer repeat: change them only
    // together with the simulation or the reference robots, and say so.
    QTest::newRow("localization, team play and realistic noise")
        << QStringList{"--scenario", "match-3v3", "--noise",    "realistic",
                       "--seed",     "7",         "--duration", "1200"}
        << QStringLiteral("0xbe919854b9730008");
    QTest::newRow("two kinds of robots with their own noise")
        << QStringList{"--scenario",    "match-3v3", "--noise",       "robot",
                       "--robot-model", "kid-size",  "--robot-model", "red=adult-size",
                       "--duration",    "300"}
        << QStringLiteral("0xb6d9beeed3565b53");
    QTest::newRow("with a referee") << QStringList{"--scenario", "match", "--duration", "300"}
                                    << QStringLiteral("0x0b7c98ccfdb13e43");
  }
  void withAndWithoutFusedMultiplyAdd() {
    QFETCH(QStringList, match);
    QFETCH(QString, golden);
    const QString with = hashOf(match, {});
    const QString without = hashOf(match, QStringLiteral("glibc.cpu.hwcaps=-AVX2,-FMA"));
    QVERIFY2(with.startsWith(QStringLiteral("0x")), qPrintable(with));
    QCOMPARE(without, with);
    QCOMPARE(with, golden);
  }
};

}  // namespace tst_same_bits

QTEST_GUILESS_MAIN(tst_same_bits::TestSameBits)

#include "tst_same_bits.moc"
