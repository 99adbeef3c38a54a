// SPDX-License-Identifier: GPL-3.0-or-later
// Messages of other teams: the published example bytes, and what an independent writer (python3's
// struct, Google's protobuf) makes of random values.
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>

#include <telemetry/formats/meanings.h>
#include <telemetry/monitor/team_monitor.h>

namespace tst_team_formats {

using namespace pitchboard::telemetry;

namespace {

QByteArray bytesOf(const QJsonObject& message) {
  if (message.contains("text")) return message["text"].toString().toUtf8();
  return QByteArray::fromHex(message["hex"].toString().remove(' ').toLatin1());
}

std::optional<std::size_t> placeOf(const TextDecoder& decoder, const std::string& name) {
  const auto& fields = decoder.profile().fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].name == name) return i;
  }
  return std::nullopt;
}

void decodeAt(const TextDecoder& decoder, const QByteArray& bytes, DecodedText& out) {
  const Sender sender{*parseAddress("10.0.0.7"), 4000};
  decoder.decode(
      DatagramView{{}, sender, 1241, false, {bytes.data(), static_cast<std::size_t>(bytes.size())}},
      out);
}

/// What is wrong with a message that was read; empty: nothing.
QString wrong(const QJsonObject& message) {
  const auto profile = loadProfile(message["profile"].toString().toStdString());
  if (!profile) return QString::fromStdString(profile.error().text());
  const TextDecoder decoder(*profile);
  DecodedText decoded;
  const QByteArray bytes = bytesOf(message);
  decodeAt(decoder, bytes, decoded);
  if (!decoded.accepted()) return QStringLiteral("refused");
  if (!decoded.errors.empty()) return QStringLiteral("has errors, field %1").arg(decoded.badField);
  if (decoded.robot != message["robot"].toInt())
    return QStringLiteral("robot %1").arg(decoded.robot);
  if (message.contains("team") && decoded.team != message["team"].toInt()) {
    return QStringLiteral("team %1").arg(decoded.team.value_or(-1));
  }
  const QJsonObject values = message["values"].toObject();
  for (auto it = values.begin(); it != values.end(); ++it) {
    const auto place = placeOf(decoder, std::string(presentName(it.key().toStdString())));
    if (!place) return it.key() + QStringLiteral(" is no column");
    if (it->isNull()) {
      if (decoded.has(*place)) return it.key() + QStringLiteral(" is no hole");
      continue;
    }
    const double expected = it->toDouble();
    const double got = decoded.values[*place];
    const double tolerance = 2e-5 * std::max(1.0, std::abs(expected));
    double off = std::abs(got - expected);
    if (presentName(it.key().toStdString()) == "LOCALIZATION_THETA")
      off = std::abs(std::remainder(off, 360.0));
    if (!(off <= tolerance))
      return QStringLiteral("%1 is %2, not %3")
          .arg(it.key())
          .arg(got, 0, 'g', 9)
          .arg(expected, 0, 'g', 9);
    if (decoded.texts[*place].empty()) return it.key() + QStringLiteral(" has no word");
  }
  return {};
}

QJsonArray messagesIn(const QByteArray& json) {
  return QJsonDocument::fromJson(json).object()["messages"].toArray();
}

QJsonArray examples() {
  QFile file(QStringLiteral(PITCHBOARD_TEST_DATA "/team_messages.json"));
  return file.open(QIODevice::ReadOnly) ? messagesIn(file.readAll()) : QJsonArray();
}

}  // namespace

class TestTeamFormats : public QObject {
  Q_OBJECT
 private slots:
  void everyBuiltInProfileIsValidAndReadsBack() {
    const auto names = builtInProfiles();
    QVERIFY(names.size() >= 20);
    for (const std::string& name : names) {
      const auto profile = loadProfile(name);
      QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
      const auto again = parseProfile(profileText(*profile), name);
      QVERIFY2(again, again ? "" : again.error().text().c_str());
      QVERIFY2(*again == *profile, name.c_str());
    }
  }

  void anUnknownNameListsTheKnownOnes() {
    const auto none = loadProfile("mitecon");
    QVERIFY(!none);
    QVERIFY2(none.error().text().find("did you mean \"mitecom\"") != std::string::npos,
             none.error().text().c_str());
  }

  void theExamples_data() {
    QTest::addColumn<QJsonObject>("message");
    for (const QJsonValue& value : examples()) {
      QTest::newRow(value.toObject()["name"].toString().toUtf8()) << value.toObject();
    }
  }
  void theExamples() {
    QFETCH(QJsonObject, message);
    const QString problem = wrong(message);
    QVERIFY2(problem.isEmpty(), qPrintable(problem));
  }

  void numbersThatJsonCannotWriteCostThemselvesOnly_data() {
    QTest::addColumn<QByteArray>("number");
    QTest::addColumn<int>("error");
    const auto row = [](const char* number, TextError error) {
      QTest::newRow(number) << QByteArray(number) << static_cast<int>(error);
    };
    for (const char* number :
         {"NaN", "nan", "-nan", "-nan(ind)", "Infinity", "-Infinity", "inf", "-INF"}) {
      row(number, TextError::NotFinite);
    }
    for (const char* number : {"1e400", "-1E+400"}) row(number, TextError::TooLarge);
    QTest::newRow("400 digits") << QByteArray(400, '9') << static_cast<int>(TextError::TooLarge);
  }
  void numbersThatJsonCannotWriteCostThemselvesOnly() {
    QFETCH(QByteArray, number);
    QFETCH(int, error);
    const auto kind = static_cast<TextError>(error);
    const auto read = [&](const char* profile, QByteArray text, bool tolerant) {
      auto made = loadProfile(profile).value();
      made.tolerant = tolerant;
      const TextDecoder decoder(made);
      DecodedText decoded;
      text.replace("@", number);
      decodeAt(decoder, text, decoded);
      std::map<std::string, double> values;
      for (std::size_t i = 0; i < decoded.count; ++i) {
        if (decoded.has(i)) values[decoder.name(decoded, i)] = decoded.values[i];
      }
      const bool isGood = decoded.accepted() && decoded.errors.has(kind) &&
                          !decoded.errors.has(TextError::BadFormat);
      return std::pair(isGood, values);
    };
    // Fields of the profile and others, in objects and lists, first and last, beside quoted ones.
    for (const bool tolerant : {false, true}) {
      const auto [good, values] =
          read("plotjuggler",
               "{\"a\" : @ ,\"robot1\":{\"pose\":{\"x\":@,\"y\":-0.5},\"speed\":@,\"v\":[@,@,3]},"
               "\"q\":\"\\\"@,:\",\n  \"timestamp\":1.5,\"z\":@}",
               tolerant);
      QVERIFY(good);
      QVERIFY(!values.contains("POSE_X") && !values.contains("robot1.speed"));
      QVERIFY(!values.contains("a") && !values.contains("z"));
      QCOMPARE(values.at("POSE_Y"), -0.5);
      QCOMPARE(values.at("ROBOT_TIME"), 1.5);
      QCOMPARE(values.at("robot1.v[2]"), 3.0);
    }
    const auto [good, values] = read(
        "bold-hearts",
        R"({"unum":3,"team":1,"agent":{"ball":[@,0.5]},"hw":{"volt":12.1,"temps":[40,41]}})", true);
    QVERIFY(good);
    QCOMPARE(values.at("BATTERY"), 12.1);
    QCOMPARE(values.at("TEMPERATURE_1"), 40.0);
    // As it was in Lua, whose other values may now follow such a number, too.
    const auto [lua, inLua] =
        read("upenn", R"({["id"]=2,["pose"]={["x"]=@,["y"]=-0.5,["a"]=1.57,},["new"]=@,})", false);
    QVERIFY(lua);
    QCOMPARE(inLua.at("POSE_Y"), -0.5);
  }
  void otherWordsAreNoJson() {
    const TextDecoder decoder(loadProfile("plotjuggler").value());
    for (const char* text : {R"({"a":nothing})", R"({"a":1.2.3})", R"({"a":NaN NaN})", R"({NaN:1})",
                             R"({"a":NaNo})", R"({"a":1e400)"}) {
      DecodedText decoded;
      decodeAt(decoder, text, decoded);
      QVERIFY2(decoded.errors.has(TextError::BadFormat), text);
    }
  }

  /// Each format has an example, or a message of the independent writer.
  void whatAnotherProgramWrites() {
    QTemporaryDir folder;
    QProcess python;
    // The distribution's own: its package has Google's protobuf.
    python.start(
        QStringLiteral("/usr/bin/python3"),
        {QStringLiteral(PITCHBOARD_TEST_DATA "/team_message_writer.py"),
         QStringLiteral(PITCHBOARD_SOURCE_DIR "/telemetry/formats/proto/team_messages.proto"),
         folder.path(), QStringLiteral("13")});
    QVERIFY(python.waitForFinished(60000));
    QVERIFY2(python.exitCode() == 0, python.readAllStandardError().constData());
    const QJsonArray messages = messagesIn(python.readAllStandardOutput());
    QVERIFY(messages.size() >= 200);
    std::set<QString> written;
    for (const QJsonValue& value : messages) {
      const QJsonObject message = value.toObject();
      const QString problem = wrong(message);
      QVERIFY2(problem.isEmpty(), qPrintable(message["name"].toString() + ": " + problem + ": " +
                                             message["hex"].toString()));
      written.insert(message["profile"].toString());
    }
    for (const QJsonValue& value : examples())
      written.insert(value.toObject()["profile"].toString());
    for (const std::string& name : builtInProfiles()) {
      QVERIFY2(written.count(QString::fromStdString(name)) == 1, name.c_str());
    }
  }

  /// Cut or spoilt messages are refused or have holes; nothing is read beyond their end.
  void damagedMessages() {
    std::mt19937 random(7);
    for (const QJsonValue& value : examples()) {
      const QJsonObject message = value.toObject();
      const TextDecoder decoder(*loadProfile(message["profile"].toString().toStdString()));
      const QByteArray whole = bytesOf(message);
      DecodedText decoded;
      for (qsizetype length = 0; length < whole.size(); ++length) {
        // A buffer of its own, so that a sanitizer sees its end.
        const QByteArray cut(whole.constData(), length);
        decodeAt(decoder, cut, decoded);
        QVERIFY(decoded.count <= DecodedText::maxValues);
        if (length == 0) QVERIFY(decoded.errors.has(TextError::Empty));
      }
      for (int round = 0; round < 300; ++round) {
        QByteArray spoilt = whole;
        for (int i = 0; i < 3; ++i) {
          spoilt[static_cast<qsizetype>(random() % static_cast<unsigned>(spoilt.size()))] =
              static_cast<char>(random() & 255U);
        }
        decodeAt(decoder, spoilt, decoded);
        if (decoded.accepted())
          QVERIFY(decoded.robot >= 1 && decoded.robot <= TextDecoder::maxRobot);
      }
    }
  }

  void aBinaryMessageThatIsCutOffIsRefused() {
    const Profile booster = *loadProfile("booster");
    const TextDecoder decoder(booster);
    QByteArray whole(120, '\0');
    whole[0] = '\xe2', whole[1] = 'y';  // 31202
    whole[8] = 7;
    whole[12] = 2;
    DecodedText decoded;
    decodeAt(decoder, whole, decoded);
    QVERIFY(decoded.errors.empty());
    for (const qsizetype length : {60, 119}) {
      decodeAt(decoder, whole.left(length), decoded);
      QVERIFY(decoded.errors.has(TextError::Truncated));
      QVERIFY(!decoded.accepted());
      QCOMPARE(decoded.robot, 2);
    }
    Profile lenient = booster;
    lenient.fields.back().optional = true;
    decodeAt(TextDecoder(lenient), whole.left(118), decoded);
    QVERIFY(decoded.errors.empty());
    QVERIFY(!decoded.has(lenient.fields.size() - 1));
    const auto again = parseProfile(profileText(lenient), "lenient");
    QVERIFY(again && *again == lenient);
  }

  void infinityIsAMistakeAndNanIsNoValue() {
    Profile profile = *loadProfile("rgrt");
    const auto ball = profile.indexOf(FieldMeaning::BallX).value();
    QByteArray message = bytesOf([] {
      for (const QJsonValue& value : examples()) {
        if (value.toObject()["profile"].toString() == QLatin1String("rgrt"))
          return value.toObject();
      }
      return QJsonObject();
    }());
    const TextDecoder decoder(profile);
    DecodedText decoded;
    const auto readWith = [&](float value) {
      std::memcpy(message.data() + profile.fields[ball].at, &value, sizeof value);
      decodeAt(decoder, message, decoded);
      return decoded.accepted() && !decoded.has(ball);
    };
    QVERIFY(readWith(std::numeric_limits<float>::quiet_NaN()));
    QVERIFY(decoded.errors.empty());
    QVERIFY(readWith(std::numeric_limits<float>::infinity()));
    QVERIFY(decoded.errors.has(TextError::NotFinite));
  }

  void anotherTeamsFormatIsRefused() {
    for (const QJsonValue& value : examples()) {
      const QString own = value.toObject()["profile"].toString();
      if (!value.toObject().contains("hex")) continue;
      for (const char* other : {"published", "mitecom", "spl", "booster", "upenn", "plotjuggler"}) {
        if (own == QLatin1String(other) || own.startsWith(QLatin1String("spl"))) continue;
        const TextDecoder decoder(*loadProfile(other));
        DecodedText decoded;
        const QByteArray bytes = bytesOf(value.toObject());
        decodeAt(decoder, bytes, decoded);
        QVERIFY2(!decoded.accepted(), qPrintable(own + " read as " + other));
      }
    }
  }

  void aRobotThatSendsAnotherFormatIsReceived() {
    TeamMonitor monitor(*loadProfile("mitecom"));
    for (const QJsonValue& value : examples()) {
      if (value.toObject()["profile"].toString() != QLatin1String("mitecom")) continue;
      const QByteArray bytes = bytesOf(value.toObject());
      const WallTime now{std::chrono::seconds(1'700'000'000)};
      QCOMPARE(monitor.take({now,
                             {*parseAddress("10.0.0.7"), 4000},
                             12321,
                             false,
                             {bytes.data(), static_cast<std::size_t>(bytes.size())}}),
               TeamMonitor::Verdict::Used);
      const RobotStatus robot = monitor.status(now).robots.at(0);
      QCOMPARE(robot.key.number, 1);
      QCOMPARE(robot.value(FieldMeaning::X), std::optional(600.0));
      QCOMPARE(robot.value(FieldMeaning::Theta), std::optional(90.0));
    }
  }
};

PITCHBOARD_TEST(TestTeamFormats)

}  // namespace tst_team_formats

#include "tst_team_formats.moc"
