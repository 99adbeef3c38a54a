// SPDX-License-Identifier: GPL-3.0-or-later
// Profiles in other frames, units and ways of writing. Expected values are worked out on paper for
// a field of 9 by 6 metres.
#include <QtTest>

#include <telemetry/formats/text_decoder.h>

namespace tst_message_frames {

using namespace pitchboard::telemetry;

namespace {

/// `top`: further members of the profile; `fields`: behind the robot's number.
pitchboard::Result<Profile> profileOf(const QByteArray& top, const QByteArray& fields) {
  const QByteArray text =
      "{\"name\": \"team\", " + top +
      "\"fields\": [\n{\"name\": \"n\", \"type\": \"int\", \"meaning\": \"robot\"}" +
      (fields.isEmpty() ? QByteArray() : ",\n" + fields) + "]}";
  return parseProfile(text.toStdString(), "p.json");
}

struct Read {
  Read(const TextDecoder& by, const QByteArray& bytes) : decoder(by), message(bytes) {
    decoder.decode({message.data(), static_cast<std::size_t>(message.size())}, decoded);
  }
  double at(const char* name) const {
    const auto& fields = decoder.profile().fields;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i].name == name) return i < decoded.count ? decoded.values[i] : qQNaN();
    }
    return qInf();
  }
  const TextDecoder& decoder;
  const QByteArray message;  // words of what was decoded point into it
  DecodedText decoded;
};

const QByteArray metres =
    "{\"name\": \"A\", \"type\": \"float\", \"unit\": \"m\", \"meaning\": \"x\"},"
    "{\"name\": \"B\", \"type\": \"float\", \"unit\": \"m\", \"meaning\": \"y\"},"
    "{\"name\": \"C\", \"type\": \"float\", \"unit\": \"°\", \"meaning\": \"theta\"}";

}  // namespace

class TestMessageFrames : public QObject {
  Q_OBJECT
 private slots:
  void frames_data() {
    QTest::addColumn<QByteArray>("frame");
    QTest::addColumn<bool>("attacksLeft");
    QTest::addColumn<QList<double>>("published");  // cm, cm, °
    // The message says 1, 2, 30.
    const auto row = [](const char* name, const char* frame, bool left, QList<double> published) {
      QTest::newRow(name) << QByteArray(frame) << left << published;
    };
    row("published but in metres", "", false, {100, 200, 30});
    row("corner, y left of x", R"("frame": {"y": "left"},)", false, {100, 400, 30});
    row("centre, y right of x", R"("frame": {"origin": "centre"},)", false, {550, 500, 30});
    row("centre, y left of x", R"("frame": {"origin": "centre", "y": "left"},)", false,
        {550, 100, 30});
    row("clockwise", R"("frame": {"origin": "centre", "y": "left", "angle": "clockwise"},)", false,
        {550, 100, 330});
    row("x to the left", R"("frame": {"origin": "centre", "x": "left", "y": "left"},)", false,
        {350, 500, 210});
    row("to the opponents, on the right",
        R"("frame": {"origin": "centre", "x": "opponents", "y": "left"},)", false, {550, 100, 30});
    row("to the opponents, on the left",
        R"("frame": {"origin": "centre", "x": "opponents", "y": "left"},)", true, {350, 500, 210});
    row("right is right on both sides", R"("frame": {"origin": "centre", "y": "left"},)", true,
        {550, 100, 30});
    row("corner, to the opponents on the left", R"("frame": {"x": "opponents"},)", true,
        {800, 400, 210});
  }
  void frames() {
    QFETCH(QByteArray, frame);
    QFETCH(bool, attacksLeft);
    QFETCH(QList<double>, published);
    const auto profile = profileOf(frame + "\"end\": \"\", ", metres);
    QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
    const TextDecoder decoder(*profile, {9.0, 6.0, attacksLeft, {}});
    const Read read(decoder, "7 1 2 30");
    QVERIFY(read.decoded.errors.empty());
    QCOMPARE(decoder.value(read.decoded, FieldMeaning::X), std::optional(published[0]));
    QCOMPARE(decoder.value(read.decoded, FieldMeaning::Y), std::optional(published[1]));
    QCOMPARE(decoder.value(read.decoded, FieldMeaning::Theta), std::optional(published[2]));
    // What was sent stays to be seen.
    QCOMPARE(read.at("A"), 1.0);
    QCOMPARE(read.at("LOCALIZATION_X"), published[0]);
  }

  void unitsAndScales_data() {
    QTest::addColumn<QByteArray>("field");
    QTest::addColumn<QByteArray>("sent");
    QTest::addColumn<int>("meaning");
    QTest::addColumn<double>("published");
    const auto row = [](const char* name, const char* field, const char* sent, FieldMeaning meaning,
                        double published) {
      QTest::newRow(name) << QByteArray(field) << QByteArray(sent) << static_cast<int>(meaning)
                          << published;
    };
    row("volts", R"({"name": "V", "type": "float", "unit": "V", "meaning": "voltage"})", "12.4",
        FieldMeaning::Voltage, 124);
    row("millivolts", R"({"name": "V", "type": "int", "unit": "mV", "meaning": "voltage"})",
        "12400", FieldMeaning::Voltage, 124);
    row("published volts", R"({"name": "V", "type": "int", "meaning": "voltage"})", "124",
        FieldMeaning::Voltage, 124);
    row("steps of 80 mV",
        R"({"name": "V", "type": "int", "unit": "V", "scale": 0.08, "meaning": "voltage"})", "200",
        FieldMeaning::Voltage, 160);
    row("radians", R"({"name": "T", "type": "float", "unit": "rad", "meaning": "theta"})",
        "-1.5707963267948966", FieldMeaning::Theta, 270);
    row("-180 to 180", R"({"name": "T", "type": "float", "unit": "°", "meaning": "theta"})", "-90",
        FieldMeaning::Theta, -90);
    row("offset",
        R"({"name": "T", "type": "int", "unit": "°", "scale": 2, "offset": -180, "meaning": "theta"})",
        "135", FieldMeaning::Theta, 90);
    row("ball in metres",
        R"({"name": "D", "type": "float", "unit": "m", "meaning": "ball-distance"}, {"name": "A", "type": "float", "unit": "rad", "meaning": "ball-angle"})",
        "0.8 1.5707963267948966", FieldMeaning::BallDistance, 80);
  }
  void unitsAndScales() {
    QFETCH(QByteArray, field);
    QFETCH(QByteArray, sent);
    QFETCH(int, meaning);
    QFETCH(double, published);
    const auto profile = profileOf({}, field);
    QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
    const TextDecoder decoder(*profile);
    const Read read(decoder, "1 " + sent + " OUT");
    QVERIFY(read.decoded.errors.empty());
    const auto value = decoder.value(read.decoded, static_cast<FieldMeaning>(meaning));
    QVERIFY(value);
    QCOMPARE(*value, published);
  }

  void aFieldIsAVariable() {
    const auto profile = profileOf(
        R"("frame": {"origin": "centre", "y": "left"}, )",
        R"({"name": "x", "type": "float", "unit": "m", "meaning": "x", "variable": "LOCALIZATION_X"},
           {"name": "y", "type": "float", "unit": "m", "meaning": "y", "variable": "LOCALIZATION_Y"},
           {"name": "ball", "type": "float", "unit": "m", "variable": "VISION_BALL_DIST"},
           {"name": "roll", "type": "float", "unit": "°", "variable": "IMU_EULER_X"})");
    QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
    const Surroundings where{9.0, 6.0, false, [](const std::string& variable) {
                               return std::string(variable.starts_with("IMU") ? "rad" : "cm");
                             }};
    const TextDecoder decoder(*profile, where);
    const Read read(decoder, "1 1.5 -0.5 0.8 180 OUT");
    QCOMPARE(read.at("LOCALIZATION_X"), 600.0);
    QCOMPARE(read.at("LOCALIZATION_Y"), 350.0);
    QCOMPARE(read.at("VISION_BALL_DIST"), 80.0);
    QCOMPARE(read.at("IMU_EULER_X"), 3.141593);
    QVERIFY(qIsInf(read.at("x")));  // it has one name
    QCOMPARE(decoder.profile().fields.size(), std::size_t(5));
    QCOMPARE(decoder.profile().fields[3].unit, std::string("cm"));
    QCOMPARE(decoder.value(read.decoded, FieldMeaning::X), std::optional(600.0));
    QCOMPARE(read.decoded.texts[3], std::string_view("80"));
  }

  void extraFieldsStayBehindWhatIsMade() {
    const auto profile = profileOf({}, metres);
    const TextDecoder decoder(*profile);
    const Read read(decoder, "1 1 2 30 5 word OUT");
    QVERIFY(read.decoded.errors.empty());
    QCOMPARE(read.decoded.count, std::size_t(8));
    QCOMPARE(decoder.name(read.decoded, 4), std::string("LOCALIZATION_X"));
    QCOMPARE(decoder.name(read.decoded, 6), std::string("OTHER_1"));
    QCOMPARE(read.decoded.values[6], 5.0);
    QCOMPARE(read.decoded.texts[7], std::string_view("word"));
  }

  void keysAndValues() {
    const auto profile = profileOf(
        R"("format": "key=value", "separator": ";", )",
        R"({"name": "ROLE", "type": "text", "key": "role", "labels": {"1": "Stürmer", "2": "Torwart"}},
           {"name": "V", "type": "float", "unit": "V", "meaning": "voltage", "key": "batt"},
           {"name": "NOTE", "type": "text", "key": "note"})");
    QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
    const TextDecoder decoder(*profile);
    const Read read(decoder, "n=4; role=Torwart ;batt = 12.4;note=müde;other=1");
    QVERIFY(read.decoded.errors.empty());
    QCOMPARE(read.decoded.robot, 4);
    QCOMPARE(read.at("ROLE"), 2.0);
    QCOMPARE(read.at("VOLTAGE"), 124.0);
    QCOMPARE(read.decoded.texts[3], std::string_view("müde"));
    QVERIFY(qIsNaN(read.at("NOTE")));
    const Read without(decoder, "role=Torwart");
    QVERIFY(without.decoded.errors.has(TextError::BadRobot));
    const Read none(decoder, "n=4;nonsense");
    QVERIFY(none.decoded.errors.has(TextError::BadFormat));
    const Read binary(decoder, "n=4;role=\xff\xfe");
    QVERIFY(binary.decoded.errors.has(TextError::Binary));
  }

  void jsonIsFlattened() {
    const auto profile = profileOf(
        R"("format": "json", )",
        R"({"name": "A", "type": "float", "key": "a.b[1].c"}, {"name": "ON", "type": "flag", "key": "on"},
           {"name": "S", "type": "float", "key": "s"}, {"name": "L", "type": "int", "key": "list[2][0]"})");
    const TextDecoder decoder(*profile);
    const Read read(
        decoder,
        R"({"n": 3, "a": {"b": [{"c": 1}, {"d": [1, 2], "c": 2.5}]}, "on": true, "s": "7.5", "list": [0, [1], [9]]})");
    QVERIFY(read.decoded.errors.empty());
    QCOMPARE(read.decoded.robot, 3);
    QCOMPARE(read.at("A"), 2.5);
    QCOMPARE(read.at("ON"), 1.0);
    QCOMPARE(read.at("S"), 7.5);
    QCOMPARE(read.at("L"), 9.0);
    QVERIFY(Read(decoder, R"({"n": 3)").decoded.errors.has(TextError::BadFormat));
    QVERIFY(Read(decoder, "[3]").decoded.errors.has(TextError::BadFormat));
    const QByteArray deep = "{\"n\":3,\"a\":" + QByteArray(20000, '[');
    QVERIFY(Read(decoder, deep).decoded.errors.has(TextError::BadFormat));
  }

  void umlautsInAMessageOfWords() {
    const QByteArray fields = R"({"name": "NAME", "type": "text"})";
    const auto plain = profileOf({}, fields), utf8 = profileOf(R"("encoding": "utf-8", )", fields);
    QVERIFY(Read(TextDecoder(*plain), "1 Jürgen OUT").decoded.errors.has(TextError::Binary));
    const TextDecoder decoder(*utf8);
    const Read read(decoder, "1 Jürgen OUT");
    QVERIFY(read.decoded.errors.empty());
    QCOMPARE(read.decoded.texts[1], std::string_view("Jürgen"));
    QCOMPARE(printable("Jürgen\x01"), std::string("Jürgen\\x01"));
    for (const char* bad :
         {"1 \xc0\xaf OUT", "1 \xed\xa0\x80 OUT", "1 \xf5\x80\x80\x80 OUT", "1 \xe2\x82"}) {
      QVERIFY(Read(decoder, bad).decoded.errors.has(TextError::Binary));
    }
  }

  void aRobotWithoutANumber() {
    const auto profile = parseProfile(
        R"({"name": "t", "end": "", "robotFrom": {"source": "port", "base": 7109}, "fields": [{"name": "A", "type": "int"}]})",
        "p.json");
    QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
    const TextDecoder decoder(*profile);
    DecodedText out;
    decoder.decode(DatagramView{{}, {}, 7112, false, "5"}, out);
    QVERIFY(out.accepted());
    QCOMPARE(out.robot, 3);
    decoder.decode(DatagramView{{}, {}, 7109, false, "5"}, out);
    QVERIFY(out.errors.has(TextError::BadRobot));
  }

  void mistakesAreNamed_data() {
    QTest::addColumn<QByteArray>("top");
    QTest::addColumn<QByteArray>("field");
    QTest::addColumn<QByteArray>("expected");
    const auto row = [](const char* name, const char* top, const char* field,
                        const char* expected) {
      QTest::newRow(name) << QByteArray(top) << QByteArray(field) << QByteArray(expected);
    };
    const char* a = R"({"name": "A", "type": "int"})";
    row("format", R"("format": "xml", )", a,
        "p.json:1: format: there is no format of messages \"xml\"");
    row("origin", R"("frame": {"origin": "top"}, )", a, "frame.origin: there is no origin \"top\"");
    row("frame key", R"("frame": {"z": 1}, )", a, "frame.z");
    row("unit", R"("frame": {"origin": "centre"}, )",
        R"({"name": "A", "type": "int", "unit": "inch", "meaning": "x"})",
        "p.json:3: fields[1]: A field with the meaning \"x\" has the unit m, cm or mm.");
    row("scale", "", R"({"name": "A", "type": "int", "scale": 0})",
        "A scale is a number other than 0");
    row("label", "", R"({"name": "A", "type": "int", "labels": {"one": "b"}})",
        "fields[1].labels.one: the code of a word is a whole number");
    row("bits", "", R"({"name": "A", "type": "int", "bits": 8})",
        "Only a field with the meaning \"sequence\" has bits.");
    row("too many bits", "", R"({"name": "A", "type": "int", "meaning": "sequence", "bits": 64})",
        "fields[1].bits");
    row("message", R"("format": "protobuf", "message": "spl", )", a,
        "The message is robocup, nubots, rhoban or utra.");
    row("place", R"("format": "binary", )", a,
        "A field of a binary message needs \"at\" and \"as\".");
    row("hex", R"("begins": "5g", )", a, "begins: has two hexadecimal digits for each byte");
    row("separator", R"("separator": "::", )", a, "separator: is one printable character");
    row("two numbers", R"("robotFrom": {"source": "port"}, )", a,
        "A field has the meaning \"robot\" already.");
    row("variable twice", "", R"({"name": "A", "type": "int", "variable": "n"})",
        "Two fields are called \"n\".");
  }
  void mistakesAreNamed() {
    QFETCH(QByteArray, top);
    QFETCH(QByteArray, field);
    QFETCH(QByteArray, expected);
    const auto profile = profileOf(top, field);
    QVERIFY(!profile);
    const QByteArray text = QByteArray::fromStdString(profile.error().text());
    QVERIFY2(text.contains(expected) && text.startsWith("p.json"), text.constData());
  }
};

PITCHBOARD_TEST(TestMessageFrames)

}  // namespace tst_message_frames

#include "tst_message_frames.moc"
