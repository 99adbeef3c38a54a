// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTemporaryDir>
#include <QtTest>

#include <telemetry/formats/profile.h>
#include <telemetry/formats/text_decoder.h>

namespace tst_profile {

using namespace pitchboard::telemetry;

namespace {

QByteArray profileWith(const QByteArray& fields, const QByteArray& top = {}) {
  return "{\n \"name\": \"team\",\n " + top + "\"fields\": [\n" + fields + "\n ]\n}\n";
}
const QByteArray robot = "  {\"name\": \"n\", \"type\": \"int\", \"meaning\": \"robot\"}";

}  // namespace

class TestProfile : public QObject {
  Q_OBJECT
 private slots:
  void thePublishedOneIsValid() {
    const Profile& profile = publishedProfile();
    QCOMPARE(profile.fields.size(), std::size_t(15));
    QVERIFY(validate(profile).has_value());
    QCOMPARE(profile.fields[14].name, std::string("VOLTAGE"));
    QCOMPARE(profile.indexOf(FieldMeaning::BallDistance), std::optional<std::size_t>(5));
    QVERIFY(!profile.indexOf(FieldMeaning::Sequence));
  }

  void textReadsBackTheSame() {
    Profile profile = publishedProfile();
    profile.end = "END";
    profile.fields.push_back({"SEQ", FieldType::Int, "", "Network", FieldMeaning::Sequence});
    const auto again = parseProfile(profileText(profile), "again");
    QVERIFY2(again, again ? "" : again.error().text().c_str());
    QVERIFY(*again == profile);
  }

  void aProfileOfVersionOneHasGroups() {
    std::string text = profileText(publishedProfile());
    QVERIFY(text.find("\"group\"") == std::string::npos);
    for (std::size_t at; (at = text.find("\"category\"")) != std::string::npos;) {
      text.replace(at, 10, "\"group\"");
    }
    const auto old = parseProfile(text, "old");
    QVERIFY2(old, old ? "" : old.error().text().c_str());
    QVERIFY(*old == publishedProfile());
    QCOMPARE(old->fields[1].category, std::string("Belief"));
  }

  void mistakesAreNamed_data() {
    QTest::addColumn<QByteArray>("json");
    QTest::addColumn<QByteArray>("expected");
    QTest::newRow("no JSON") << QByteArray("{\n \"name\": \n}") << QByteArray("p.json:3");
    QTest::newRow("empty") << QByteArray() << QByteArray("p.json:1");
    QTest::newRow("a list") << QByteArray("[]") << QByteArray("an object");
    QTest::newRow("no fields") << QByteArray("{\"name\": \"a\"}") << QByteArray("fields");
    QTest::newRow("no name") << QByteArray("{\"fields\": []}") << QByteArray("name");
    QTest::newRow("unknown key") << profileWith(robot, "\"colour\": 1, ") << QByteArray("colour");
    QTest::newRow("field is text") << profileWith("\"n\"") << QByteArray("fields[0]");
    QTest::newRow("bad type")
        << profileWith(robot + ",\n  {\"name\": \"A\", \"type\": \"double\"}")
        << QByteArray(
               "p.json:5: fields[1].type: there is no type of a field \"double\"; known are int, "
               "float, flag");
    QTest::newRow("bad meaning")
        << profileWith(robot + ",\n\n  {\"name\": \"A\", \"type\": \"int\", \"meaning\": \"ball\"}")
        << QByteArray("p.json:6: fields[1].meaning: there is no meaning \"ball\"");
    QTest::newRow("missing type") << profileWith(robot + ",\n  {\"name\": \"A\"}")
                                  << QByteArray("fields[1].type: is missing");
    QTest::newRow("same name") << profileWith(robot + ",\n  {\"name\": \"n\", \"type\": \"int\"}")
                               << QByteArray("p.json:5: fields[1]: Two fields are called \"n\"");
    QTest::newRow("two robots")
        << profileWith(robot + ",\n  {\"name\": \"m\", \"type\": \"int\", \"meaning\": \"robot\"}")
        << QByteArray("Two fields have the meaning \"robot\"");
    QTest::newRow("no robot") << profileWith("  {\"name\": \"A\", \"type\": \"int\"}")
                              << QByteArray("No field has the meaning \"robot\"");
    QTest::newRow("reserved") << profileWith(robot +
                                             ",\n  {\"name\": \"OTHER_1\", \"type\": \"int\"}")
                              << QByteArray("OTHER_");
    QTest::newRow("name with space")
        << profileWith(robot + ",\n  {\"name\": \"A B\", \"type\": \"int\"}")
        << QByteArray("p.json:5");
    QTest::newRow("robot is a float")
        << profileWith("  {\"name\": \"n\", \"type\": \"float\", \"meaning\": \"robot\"}")
        << QByteArray("has the type int");
    QTest::newRow("number as name")
        << profileWith("  {\"name\": 7, \"type\": \"int\"}")
        << QByteArray("p.json:4: fields[0].name: must be text in quotes");
    QTest::newRow("deep") << QByteArray(100000, '[') << QByteArray("nested deeper than 64 levels");
    QTest::newRow("101 fields") << [] {
      QByteArray fields = robot;
      for (int i = 0; i < 100; ++i) {
        fields += ",\n{\"name\": \"F" + QByteArray::number(i) + "\", \"type\": \"int\"}";
      }
      return profileWith(fields);
    }() << QByteArray("fields: must not have more than 100 entries");
  }
  void mistakesAreNamed() {
    QFETCH(QByteArray, json);
    QFETCH(QByteArray, expected);
    const auto profile = parseProfile(json.toStdString(), "p.json");
    QVERIFY(!profile);
    const QByteArray text = QByteArray::fromStdString(profile.error().text());
    QVERIFY2(text.contains(expected), text.constData());
    QVERIFY2(text.startsWith("p.json"), text.constData());
  }

  void aTeamsOwnOrderIsUsed() {
    const auto profile = parseProfile(
        profileWith("  {\"name\": \"STATE\", \"type\": \"flag\"},\n" + robot +
                        ",\n  {\"name\": \"V\", \"type\": \"int\", \"meaning\": \"voltage\"}",
                    "\"end\": \"END\", ")
            .toStdString(),
        "p.json");
    QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
    const TextDecoder decoder(*profile);
    DecodedText decoded;
    decoder.decode("1 12 124 9.5 END", decoded);
    QVERIFY(decoded.errors.empty());
    QCOMPARE(decoded.robot, 12);
    QCOMPARE(decoder.value(decoded, FieldMeaning::Voltage), std::optional(124.0));
    QCOMPARE(decoder.name(decoded, 3), std::string("OTHER_1"));
  }

  void filesThatCannotBeRead() {
    const auto missing = loadProfile("/nonexistent/profile.json");
    QVERIFY(!missing);
    QCOMPARE(missing.error().code, pitchboard::ErrorCode::NotFound);
    QTemporaryDir folder;
    QVERIFY(!loadProfile(folder.path().toStdString()));
    const QString path = folder.filePath("big.json");
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(QByteArray(2 << 20, ' '));
    file.close();
    const auto big = loadProfile(path.toStdString());
    QVERIFY(!big);
    QVERIFY(QByteArray::fromStdString(big.error().text()).contains("1 MiB"));
  }
};

PITCHBOARD_TEST(TestProfile)

}  // namespace tst_profile

#include "tst_profile.moc"
