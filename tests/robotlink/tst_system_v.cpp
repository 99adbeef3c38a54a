// SPDX-License-Identifier: GPL-3.0-or-later
#include <QProcess>
#include <QtTest>
#include <csignal>

#include <robotlink/blackboard/system_v.h>

#include "../support/segment_keys.h"

namespace tst_system_v {

using namespace pitchboard;
using namespace pitchboard::link;

class TestSystemV : public QObject {
  Q_OBJECT

  const int m_base = testKeyBase();
  const int m_key = m_base + 100;

  QByteArray peer(const QStringList& arguments) {
    QProcess process;
    process.start("python3",
                  QStringList{PITCHBOARD_TEST_DATA "/blackboard_peer.py", QString::number(m_key)} +
                      arguments);
    if (!process.waitForFinished() || process.exitCode() != 0)
      return "failed: " + process.readAllStandardError();
    return process.readAllStandardOutput().trimmed();
  }
  void startUser(QProcess& other, const QString& action) {
    other.start(QStringLiteral(SEGMENT_USER), {action, QString::number(m_key)});
  }
  QString refusal(AttachMode mode) {
    const auto board = SystemVSegments::open(m_key, mode);
    return board ? QString() : QString::fromStdString(board.error().text());
  }

 private slots:
  void cleanup() { removeSegment(m_key); }

  void independentProcessSeesTheSameWords() {
    auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(board);
    QVERIFY(board->created());
    board->write(IntVar{17}, -8);
    board->write(FloatVar{12}, 0.25F);
    board->write(FloatVar{386}, 3.0F);
    QCOMPARE(peer({"read", "i:17", "f:12", "f:386", "i:511"}),
             QByteArray("-8 0.25 3.0 1077936128"));
    QCOMPARE(peer({"write", "i:107=1", "f:17=nan", "f:66=-12.5"}), QByteArray());
    QCOMPARE(board->read(IntVar{107}), 1);
    QVERIFY(std::isnan(board->read(FloatVar{17})));
    QCOMPARE(board->read(FloatVar{66}), -12.5F);
  }

  void attachesToWhatIsThereAndLeavesIt() {
    QCOMPARE(peer({"write", "i:17=11"}), QByteArray());
    {
      const auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
      QVERIFY(board);
      QVERIFY(!board->created());
      QCOMPARE(board->read(IntVar{17}), 11);
    }
    QVERIFY(SystemVSegments::info(m_key));
  }

  void onlyTheCreatorRemoves() {
    {
      const auto first = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
      {
        const auto second = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
        QVERIFY(second && !second->created());
      }
      QVERIFY(SystemVSegments::info(m_key));
    }
    QVERIFY(!SystemVSegments::info(m_key));
  }

  void forkedChildDoesNotRemove() {
    QProcess other;
    startUser(other, "fork");
    QVERIFY(other.waitForFinished());
    QCOMPARE(other.readAllStandardOutput(), QByteArray("y\n"));
    QVERIFY(!SystemVSegments::info(m_key));
  }

  void mode0600AndExactSize() {
    const auto board = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    const auto info = SystemVSegments::info(m_key);
    QVERIFY(info);
    QCOMPARE(info->mode, 0600U);
    QCOMPARE(info->bytes, std::size_t(2048));
    QCOMPARE(info->attached, 1UL);
    QCOMPARE(info->creator, getpid());
    QVERIFY(!info->orphan);
  }

  void wrongSizeIsRefused_data() {
    QTest::addColumn<int>("bytes");
    QTest::newRow("smaller") << 1024;
    QTest::newRow("one word more") << 2052;
    QTest::newRow("larger") << 4096;
  }
  void wrongSizeIsRefused() {
    QFETCH(int, bytes);
    QVERIFY(shmget(m_key, static_cast<std::size_t>(bytes), IPC_CREAT | IPC_EXCL | 0600) >= 0);
    const QString text = refusal(AttachMode::AttachOrCreate);
    QVERIFY2(text.contains(QString("%1 bytes").arg(bytes)), qPrintable(text));
    QVERIFY2(text.contains("blackboard remove --key"), qPrintable(text));
  }

  void wrongModeIsRefused() {
    QVERIFY(shmget(m_key, 2048, IPC_CREAT | IPC_EXCL | 0400) >= 0);
    QVERIFY2(refusal(AttachMode::AttachOnly).contains("0400"),
             qPrintable(refusal(AttachMode::AttachOnly)));
    QCOMPARE(refusal(AttachMode::ReadOnly), QString());
  }

  void anotherOwnerIsRefused() {
    const int shmid = shmget(m_key, 2048, IPC_CREAT | IPC_EXCL | 0666);
    shmid_ds status{};
    QVERIFY(shmctl(shmid, IPC_STAT, &status) == 0);
    status.shm_perm.uid = 65534;
    if (geteuid() != 0) QSKIP("only root can give a segment away");
    QVERIFY(shmctl(shmid, IPC_SET, &status) == 0);
    QVERIFY2(refusal(AttachMode::AttachOrCreate).contains("belongs to user 65534"),
             qPrintable(refusal(AttachMode::AttachOrCreate)));
  }

  void attachOnlyAndBadKeys() {
    QVERIFY(refusal(AttachMode::AttachOnly).contains("no such segment"));
    QVERIFY(refusal(AttachMode::ReadOnly).contains("no such segment"));
    QCOMPARE(SystemVSegments::open(0, AttachMode::AttachOrCreate).error().code,
             ErrorCode::InvalidArgument);
    QVERIFY(SystemVSegments::create(m_key));
    QCOMPARE(SystemVSegments::create(m_key).error().code, ErrorCode::Conflict);
    QVERIFY(SystemVSegments::remove(m_key));
    QCOMPARE(SystemVSegments::remove(m_key).error().code, ErrorCode::NotFound);
  }

  void readOnlyMemoryCannotBeWritten() {
    const auto owner = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QProcess other;
    startUser(other, "write");
    QVERIFY(other.waitForFinished());
    QCOMPARE(other.exitStatus(), QProcess::CrashExit);
    QCOMPARE(other.exitCode(), SIGSEGV);
    QCOMPARE(owner->read(IntVar{0}), 0);
  }

  void segmentOfAKilledCreatorIsAnOrphan() {
    QProcess other;
    startUser(other, "hold");
    QVERIFY(other.waitForReadyRead());
    QCOMPARE(other.readAllStandardOutput(), QByteArray("y\n"));
    QVERIFY(!SystemVSegments::info(m_key)->orphan);
    other.kill();
    QVERIFY(other.waitForFinished());
    const auto segments = SystemVSegments::list(m_base);
    QCOMPARE(segments.size(), std::size_t(1));
    QCOMPARE(segments[0].key, m_key);
    QVERIFY(segments[0].orphan);
    const auto board = SystemVSegments::open(m_key, AttachMode::ReadOnly);
    QVERIFY(!SystemVSegments::info(m_key)->orphan);
  }

  void removedWhileAttachedMakesRoomForANewOne() {
    auto old = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(SystemVSegments::remove(m_key));
    QVERIFY(SystemVSegments::list(m_base).empty());
    auto fresh = SystemVSegments::open(m_key, AttachMode::AttachOrCreate);
    QVERIFY(fresh && fresh->created());
    old->write(IntVar{1}, 5);
    QCOMPARE(fresh->read(IntVar{1}), 0);
    old = failure(ErrorCode::NotFound, "");  // must not take the new one with it
    QVERIFY(SystemVSegments::info(m_key));
  }

  void bridgeClaimIsExclusiveBetweenProcesses() {
    QProcess other;
    startUser(other, "claim");
    QVERIFY(other.waitForReadyRead());
    QCOMPARE(other.readAllStandardOutput(), QByteArray("y\n"));
    const auto refused = BridgeClaim::take(m_key);
    QVERIFY(!refused);
    QCOMPARE(refused.error().code, ErrorCode::Conflict);
    QVERIFY2(
        QString::fromStdString(refused.error().text()).contains(QString::number(other.processId())),
        refused.error().text().c_str());
    QVERIFY(BridgeClaim::take(m_key + 100));
    other.kill();
    QVERIFY(other.waitForFinished());
    QVERIFY(BridgeClaim::take(m_key));
    QVERIFY(BridgeClaim::take(m_key));  // the one above has been given back
  }
};

PITCHBOARD_TEST(TestSystemV)

}  // namespace tst_system_v

#include "tst_system_v.moc"
