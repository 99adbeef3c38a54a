// SPDX-License-Identifier: GPL-3.0-or-later
// Packets recorded from real controllers, and every size that they can be cut to.
#include <telemetry/referee/gamecontroller.h>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include <telemetry/referee/referee_json.h>

#include "../support/recorded_packets.h"

namespace tst_gamecontroller {

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

auto decode(const QByteArray& bytes) {
  return decodeReferee(std::string_view(bytes.constData(), static_cast<std::size_t>(bytes.size())));
}

QByteArray packet(int version, int size, const char* magic = "RGme") {
  QByteArray bytes(size, '\0');
  std::memcpy(bytes.data(), magic, 4);
  bytes[4] = static_cast<char>(version);
  return bytes;
}

QStringList differences;

void compare(const QString& name, const QJsonObject& expected, const char* key,
             std::optional<int> value) {
  if (!expected.contains(key)) return;
  const QJsonValue wanted = expected[key];
  const bool same = wanted.isNull() ? !value : value && wanted.toInt(-999999) == *value;
  if (!same) {
    differences << QStringLiteral("%1.%2: %3 instead of %4")
                       .arg(name, key)
                       .arg(value ? QString::number(*value) : "nothing",
                            wanted.toVariant().toString());
  }
}

}  // namespace

class TestGameController : public QObject {
  Q_OBJECT
 private slots:
  void recordedPackets_data() { addRecordedPackets(); }
  void recordedPackets() {
    QFETCH(QString, packet);
    const auto result = decodeReferee(recordedPacket(packet));
    QVERIFY2(result, result ? "" : result.error().text().c_str());
    const RefereeState& state = std::get<RefereeState>(*result);
    const QJsonObject expected = QJsonDocument::fromJson(recordedPacketFileBytes(packet, ".json"))
                                     .object()["expected"]
                                     .toObject();
    QVERIFY(!expected.isEmpty());
    differences.clear();
    QCOMPARE(QString::fromLatin1(state.magic.data(), 4), expected["header"].toString());
    QCOMPARE(state.trueData(), packet.contains("RGTD"));
    QCOMPARE(state.firstHalf != 0, expected["firstHalf"].toBool());
    QCOMPARE(QString::fromUtf8(labelOf(playStateOf(state.state)).data()),
             expected["stateName"].toString());
    compare("", expected, "version", state.version);
    compare("", expected, "size", state.size);
    compare("", expected, "packetNumber", state.packetNumber);
    compare("", expected, "playersPerTeam", state.playersPerTeam);
    compare("", expected, "state", state.state);
    compare("", expected, "kickOffRaw", state.kickOffRaw);
    compare("", expected, "kickOffTeamNumber", state.kickOffTeam);
    compare("", expected, "secGameState", state.secState);
    compare("", expected, "gamePhase", state.gamePhase);
    compare("", expected, "setPlay", state.setPlay);
    compare("", expected, "competitionType", state.competitionType);
    compare("", expected, "competitionPhase", state.competitionPhase);
    compare("", expected, "stopped", state.stopped);
    compare("", expected, "secsRemaining", state.secsRemaining);
    compare("", expected, "secondaryTime", state.secondaryTime);
    // The v7 packet that a controller of 2015 adds has no game type: no byte tells its recordings
    // from those of 2014. The value beside them is what the program knew.
    if (!packet.startsWith("v7compat")) compare("", expected, "gameType", state.gameType);
    for (const char* name : {"gameTypeName", "secGameStateName"}) {
      if (!expected.contains(name)) continue;
      QCOMPARE(QString::fromStdString(refereeJson(*result)[name]), expected[name].toString());
    }
    if (expected.contains("secGameStateInfoHex")) {
      QByteArray info;
      for (const int byte : *state.secStateInfo) info += static_cast<char>(byte);
      QCOMPARE(QString(info.toHex()), expected["secGameStateInfoHex"].toString());
    }
    QCOMPARE(state.extra2013.has_value(), expected.contains("v7hack_bytes107_115"));
    if (state.extra2013) {
      const QJsonObject extra = expected["v7hack_bytes107_115"].toObject();
      compare("extra", extra, "timeOut", state.extra2013->timeOut);
      compare("extra", extra, "subTime", state.extra2013->subTime);
      for (int i = 0; i < 2; ++i) {
        QCOMPARE(state.extra2013->penaltyTries[std::size_t(i)],
                 extra["penaltyTries"].toArray()[i].toInt());
      }
    }
    for (int t = 0; t < 2; ++t) compareTeam(state, expected["teams"].toArray()[t].toObject(), t);
    QVERIFY2(differences.isEmpty(), qPrintable(differences.join("\n")));
  }

  void everyDocumentedSizeIsKnown_data() {
    QTest::addColumn<int>("version");
    QTest::addColumn<int>("size");
    const int known[][2] = {{7, 116},  {8, 158},  {9, 244},  {10, 588}, {11, 592}, {12, 640},
                            {12, 688}, {11, 58},  {12, 54},  {13, 54},  {14, 62},  {15, 118},
                            {16, 118}, {17, 118}, {18, 118}, {19, 198}, {20, 158}};
    for (const auto& k : known) {
      QTest::addRow("v%d %d", k[0], k[1]) << k[0] << k[1];
    }
  }
  void everyDocumentedSizeIsKnown() {
    QFETCH(int, version);
    QFETCH(int, size);
    const auto good = decode(packet(version, size));
    QVERIFY2(good, good ? "" : good.error().text().c_str());
    QCOMPARE(std::get<RefereeState>(*good).version, version);
    for (const int wrong : {size - 1, size + 1}) {
      const auto bad = decode(packet(version, wrong));
      QVERIFY(!bad);
      QVERIFY(QByteArray::fromStdString(bad.error().text()).contains(QByteArray::number(size)));
    }
  }

  void unknownVersionsAreReported() {
    const auto unknown = decode(packet(21, 200));
    QVERIFY(!unknown);
    QCOMPARE(unknown.error().code, pitchboard::ErrorCode::Unsupported);
    QVERIFY(
        QByteArray::fromStdString(unknown.error().text()).contains("version 21 with 200 bytes"));
  }

  void otherPacketsOnThePort() {
    QVERIFY(std::holds_alternative<TrueDataRequest>(*decode(QByteArray("RGTr\0", 5))));
    QVERIFY(!decode(QByteArray("hello world")));
    QVERIFY(!decode(QByteArray()));
    QVERIFY(!decode(QByteArray("RGme")));

    QByteArray v2 = packet(2, 8, "RGrt");
    v2[5] = 12;
    v2[6] = 3;
    v2[7] = 2;
    const auto reply = std::get<RobotReply>(*decode(v2));
    QCOMPARE(reply.team, 12);
    QCOMPARE(reply.player, 3);
    QCOMPARE(reply.message, std::optional(2));

    QByteArray v1 = packet(1, 16, "RGrt");
    v1[8] = 7;
    v1[10] = 4;
    v1[12] = 1;
    QCOMPARE(std::get<RobotReply>(*decode(v1)).team, 7);
    QCOMPARE(std::get<RobotReply>(*decode(v1)).player, 4);

    QByteArray v4 = packet(4, 32, "RGrt");
    v4[5] = 5;
    v4[6] = 24;
    v4[7] = 1;
    const float x = -1500.5F;
    std::memcpy(v4.data() + 8, &x, 4);
    const auto status = std::get<RobotReply>(*decode(v4));
    QCOMPARE(status.player, 5);
    QCOMPARE(status.team, 24);
    QCOMPARE(status.fallen, std::optional(1));
    QCOMPARE((*status.pose)[0], x);
    QVERIFY(!status.message);

    const auto forwarded =
        std::get<ForwardedReply>(*decode(QByteArray("\x0a\x00\x01\x07", 4) + v4));
    QCOMPARE(forwarded.robot, 0x0a000107U);
    QCOMPARE(forwarded.reply.player, 5);
    QVERIFY(!decode(packet(3, 9, "RGrt")));
  }

  void teamsAreFoundByNumber() {
    const auto result = decodeReferee(recordedPacket("v12hl640_2017.3_SECOND_HALF_PLAYING"));
    const RefereeState& state = std::get<RefereeState>(*result);
    QVERIFY(state.team(1) != nullptr && state.team(2) != nullptr);
    QCOMPARE(state.team(1)->number, 1);
    QCOMPARE(state.team(99), nullptr);
  }

  void codesHaveLabelsOfTheirVersion() {
    RefereeState state;
    state.version = 12;
    state.size = 688;
    const auto penalty = [&state](int code, int red = 0) {
      RefereeTeam& team = state.teams[0];
      team.slotCount = 1;
      team.allSlots[0].number = 1;
      team.allSlots[0].penalty = code;
      team.allSlots[0].red = red;
      return labelOf(gameOf(state).teams[0].players[0].penalty);
    };
    QVERIFY(penalty(34) == "pickup or incapable");
    QVERIFY(penalty(15) == "manual penalty");
    QVERIFY(penalty(15, 1) == "sent off");
    QVERIFY(penalty(0, 1).empty());
    QVERIFY(penaltyName(state, 77) == "UNKNOWN");
    QVERIFY(penaltyOf(state, 77) == PenaltyKind::Unknown);
    state.version = 19;
    state.size = 198;
    QVERIFY(penaltyOf(state, 11) == PenaltyKind::Substitute);
    state.version = 20;
    state.size = 158;
    QVERIFY(penaltyOf(state, 11) == PenaltyKind::Cautioned);
    QVERIFY(penaltyOf(state, 13) == PenaltyKind::Substitute);
    state.league = League::HumanoidSoccer;
    state.setPlay = 5;
    QVERIFY(gameOf(state).setPlay() == SetPlay::GoalKick);
    state.setPlay = 6;
    QVERIFY(gameOf(state).setPlay() == SetPlay::CornerKick);
    QVERIFY(refereeJson(state)["setPlayName"] == "corner");
    state.league = League::StandardPlatform;
    state.setPlay = 1;
    QVERIFY(gameOf(state).setPlay() == SetPlay::GoalKick);
    QVERIFY(labelOf(playStateOf(-1)) == "UNKNOWN");
  }

  // What a simulated game has is the same after it was sent, if the version can tell it.
  void codesAreReadAsTheyAreWritten() {
    RefereeState state;
    state.version = 20;
    state.size = 158;
    state.league = League::HumanoidSoccer;
    for (int i = 1; i <= static_cast<int>(lastOf(SetPlay{})); ++i) {
      state.setPlay = setPlayCode(state, static_cast<SetPlay>(i));
      QCOMPARE(static_cast<int>(gameOf(state).setPlay()), i);
    }
    for (const PenaltyKind kind : {PenaltyKind::Pushing, PenaltyKind::MotionInStop,
                                   PenaltyKind::Cautioned, PenaltyKind::Substitute}) {
      QVERIFY(penaltyOf(state, penaltyCode(state, kind)) == kind);
    }
    // Others by what comes next to them.
    QVERIFY(simulated(penaltyOf(state, penaltyCode(state, PenaltyKind::Incapable))) ==
            PenaltyKind::Incapable);
    for (int i = 0; i < 10; ++i) QCOMPARE(colourCode(colourOf(i)), i);
    QVERIFY(colourOf(10) == TeamColor::Unknown);
  }

  void survivesMutations() {
    std::mt19937 random(7);
    QList<QByteArray> seeds;
    for (const QString& name : ::recordedPackets()) {
      seeds << recordedPacketFileBytes(name, ".bin");
    }
    int decoded = 0;
    for (int round = 0; round < 100'000; ++round) {
      QByteArray bytes = seeds[static_cast<int>(random() % static_cast<unsigned>(seeds.size()))];
      const auto changes = random() % 8;
      for (unsigned i = 0; i < changes && !bytes.isEmpty(); ++i) {
        const auto at = static_cast<int>(random() % static_cast<unsigned>(bytes.size()));
        if (random() % 16 == 0) {
          bytes.truncate(at);
        } else {
          bytes[at] = static_cast<char>(random());
        }
      }
      // A copy of exactly this size, so that a sanitizer sees a read beyond the end.
      const std::vector<char> exact(bytes.begin(), bytes.end());
      const auto result = decodeReferee(std::string_view(exact.data(), exact.size()));
      if (result) ++decoded;
    }
    QVERIFY(decoded > 10'000);
  }

 private:
  static void compareTeam(const RefereeState& state, const QJsonObject& expected, int index) {
    const RefereeTeam& team = state.teams[static_cast<std::size_t>(index)];
    const QString name = QStringLiteral("teams[%1]").arg(index);
    compare(name, expected, "number", team.number);
    compare(name, expected, "colour", team.colour);
    compare(name, expected, "score", team.score);
    compare(name, expected, "penaltyShot", team.penaltyShot);
    compare(name, expected, "singleShots", team.singleShots);
    compare(name, expected, "messageBudget", team.messageBudget);
    compare(name, expected, "goalkeeperColor", team.goalkeeperColour);
    compare(name, expected, "goalkeeper", team.goalkeeper);
    const QJsonArray players = expected["players"].toArray();
    if (players.size() != static_cast<int>(team.slotCount))
      differences << name + ": number of slots";
    for (int i = 0; i < static_cast<int>(team.players().size()); ++i) {
      const QJsonObject wanted = players[i].toObject();
      const RefereePlayer& player = team.players()[static_cast<std::size_t>(i)];
      const QString slot = name + QStringLiteral(".players[%1]").arg(i);
      compare(slot, wanted, "n", player.number);
      compare(slot, wanted, "penalty", player.penalty);
      compare(slot, wanted, "secs", player.secondsLeft);
      compare(slot, wanted, "warnings", player.warnings);
      compare(slot, wanted, "yellow", player.yellow);
      compare(slot, wanted, "red", player.red);
      compare(slot, wanted, "cautions", player.cautions);
      compare(slot, wanted, "goalkeeper", player.goalkeeper);
      if (player.unreliable != wanted.contains("unreliable")) differences << slot + ".unreliable";
      if (wanted.contains("penaltyName") &&
          wanted["penaltyName"].toString() !=
              QString::fromUtf8(penaltyName(state, player.penalty).data())) {
        differences << slot + ".penaltyName";
      }
    }
  }
};

PITCHBOARD_TEST(TestGameController)

}  // namespace tst_gamecontroller

#include "tst_gamecontroller.moc"
