// SPDX-License-Identifier: GPL-3.0-or-later
// Packets recorded from real controllers come back byte for byte when they are decoded and written
// again; bytes that no field describes are the messages of coaches and are named here.
#include <telemetry/referee/gamecontroller_encoder.h>

#include <QtTest>

#include <cmath>

#include "../support/recorded_packets.h"

namespace tst_gamecontroller_encoder {

using namespace pitchboard::telemetry;

namespace {

/// Bytes of a team block that hold a coach's number, penalty and words.
bool isCoach(const RefereeState& state, qsizetype at) {
  struct Range {
    int version, size, teams, block, from, to;
  };
  constexpr Range ranges[] = {{8, 158, 18, 70, 6, 48},    {9, 244, 20, 112, 6, 90},
                              {10, 588, 20, 284, 6, 262}, {11, 592, 24, 284, 6, 262},
                              {12, 640, 24, 308, 6, 264}, {12, 688, 24, 332, 6, 266}};
  for (const Range& r : ranges) {
    if (r.version != state.version || r.size != state.size || at < r.teams) continue;
    const auto inBlock = (at - r.teams) % r.block;
    return inBlock >= r.from && inBlock < r.to;
  }
  return false;
}

}  // namespace

class TestGameControllerEncoder : public QObject {
  Q_OBJECT
 private slots:
  void recordings_data() { addRecordedPackets(); }
  void recordings() {
    QFETCH(QString, packet);
    const std::string bytes = recordedPacket(packet);
    const auto decoded = decodeReferee(bytes);
    QVERIFY(decoded);
    const auto& state = std::get<RefereeState>(*decoded);
    const auto encoded = encodeReferee(state);
    QVERIFY2(encoded, encoded ? "" : encoded.error().text().c_str());
    QCOMPARE(encoded->size(), bytes.size());
    QStringList differences;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      if (bytes[i] == (*encoded)[i] || isCoach(state, static_cast<qsizetype>(i))) continue;
      differences << QString::number(i);
    }
    QVERIFY2(differences.isEmpty(), qPrintable("bytes " + differences.join(", ")));
  }

  void valuesThatDoNotFitAreRefused() {
    RefereeState state;
    state.version = 20;
    state.size = 158;
    QVERIFY(encodeReferee(state));
    state.secsRemaining = 40000;
    const auto refused = encodeReferee(state);
    QVERIFY(!refused);
    QCOMPARE(QString::fromStdString(refused.error().context), QString("byte 14"));
    state.secsRemaining = -300;
    QVERIFY(encodeReferee(state));
    state.version = 6;
    QVERIFY(!encodeReferee(state));
  }

  void theSecondPacketOfThoseYears() {
    // Recorded within the same second as the first; only seconds may have gone on.
    const auto isTime = [](qsizetype at) {
      const bool ofPlayer = at >= 20 && (at - 20) % 48 >= 4 && ((at - 20) % 48 - 4) % 4 >= 2;
      return (at >= 16 && at < 20) || ofPlayer;
    };
    int pairs = 0;
    const QStringList names = recordedPackets();
    for (const char* first : {"v8hl158_", "v9hl244_"}) {
      const QString second = QString("v7compat116_from_v%1GC_").arg(first[1]);
      for (const QString& file : names.filter(QRegularExpression(QString("^") + first))) {
        if (!names.contains(second + file.mid(8))) continue;
        const QByteArray wanted = recordedPacketFileBytes(second + file.mid(8), ".bin");
        const auto packet = decodeReferee(recordedPacket(file));
        const auto bytes = encodeReferee(asVersion7(std::get<RefereeState>(*packet)));
        QVERIFY(bytes);
        QStringList differences;
        for (qsizetype i = 0; i < wanted.size(); ++i) {
          const char have = (*bytes)[static_cast<std::size_t>(i)];
          if (have != wanted[i] && !isTime(i)) differences << QString::number(i);
        }
        QVERIFY2(differences.isEmpty(), qPrintable(file + ": bytes " + differences.join(", ")));
        ++pairs;
      }
    }
    QVERIFY2(pairs >= 8, qPrintable(QString::number(pairs)));
  }

  // Layouts: docs/reference/gamecontroller.md, "Robots' replies".
  void repliesOfEveryVersion() {
    RobotReply reply;
    reply.team = 12;
    reply.player = 3;
    reply.message = 2;
    reply.version = 1;
    QCOMPARE(QByteArray::fromStdString(encodeReply(reply).value()).toHex(' '),
             QByteArray("52 47 72 74 01 00 00 00 0c 00 03 00 02 00 00 00"));
    reply.version = 2;
    QCOMPARE(QByteArray::fromStdString(encodeReply(reply).value()).toHex(' '),
             QByteArray("52 47 72 74 02 0c 03 02"));
    reply.version = 4;
    reply.fallen = 1;
    reply.pose = {1000.0F, -500.0F, 0.5F};
    reply.ballAge = 0.0F;
    reply.ball = {250.0F, 0.0F};
    const std::string bytes = encodeReply(reply).value();
    QCOMPARE(QByteArray::fromStdString(bytes).toHex(' '),
             QByteArray("52 47 72 74 04 03 0c 01 00 00 7a 44 00 00 fa c3 00 00 00 3f "
                        "00 00 00 00 00 00 7a 43 00 00 00 00"));
    const auto read = std::get<RobotReply>(decodeReferee(std::string_view(bytes)).value());
    QCOMPARE(read.team, 12);
    QCOMPARE(read.player, 3);
    QVERIFY(read.pose == reply.pose && read.ball == reply.ball);
    reply.pose = {std::nanf(""), 0.0F, 0.0F};
    QVERIFY(!encodeReply(reply));  // a controller would take it for a broken robot
    reply.version = 3;
    QCOMPARE(encodeReply(reply).error().code, pitchboard::ErrorCode::Unsupported);
  }
};

PITCHBOARD_TEST(TestGameControllerEncoder)

}  // namespace tst_gamecontroller_encoder

#include "tst_gamecontroller_encoder.moc"
