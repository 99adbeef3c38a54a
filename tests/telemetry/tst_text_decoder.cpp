// SPDX-License-Identifier: GPL-3.0-or-later
#include <QFile>
#include <QtTest>
#include <clocale>
#include <random>

#include <telemetry/formats/text_decoder.h>
#include <telemetry/formats/text_protocol.h>

#include "../support/allocation_counter.h"

using namespace pitchboard::telemetry;

namespace {

const char* const good =
    "1 258 448 -8 56.3184547424 184.634048462 41.0279350281 1 1 1 1 1 8 0.0578 189 OUT";

QStringList names(TextErrors errors) {
  QStringList out;
  for (std::size_t i = 0; i < textErrorCount; ++i) {
    const auto error = static_cast<TextError>(i);
    if (errors.has(error)) out << QString::fromUtf8(errorName(error).data());
  }
  return out;
}

QByteArray message(const char* x = "258", const char* belief = "5.5", const char* control = "1",
                   const char* tail = "189 OUT") {
  return QByteArray("1 ") + x + " 448 -8 " + belief + " 184.5 41.25 " + control +
         " 1 1 1 1 8 0.0578 " + tail;
}

}  // namespace

class TestTextDecoder : public QObject {
  Q_OBJECT
 private slots:
  void readsThePublishedMessage() {
    const TextDecoder decoder;
    DecodedText decoded;
    decoder.decode(good, decoded);
    QVERIFY(decoded.errors.empty());
    QCOMPARE(decoded.robot, 1);
    QCOMPARE(decoded.count, std::size_t(15));
    QCOMPARE(decoder.value(decoded, FieldMeaning::X), std::optional(258.0));
    QCOMPARE(decoder.value(decoded, FieldMeaning::Theta), std::optional(-8.0));
    QCOMPARE(decoder.value(decoded, FieldMeaning::Belief), std::optional(56.3184547424));
    QCOMPARE(decoder.value(decoded, FieldMeaning::BallAngle), std::optional(41.0279350281));
    QCOMPARE(decoder.value(decoded, FieldMeaning::Action), std::optional(8.0));
    QCOMPARE(decoder.value(decoded, FieldMeaning::Voltage), std::optional(189.0));
    QVERIFY(!decoder.value(decoded, FieldMeaning::Sequence));
  }

  void readsTheRecordedCapture() {
    QFile file(PITCHBOARD_TEST_DATA "/telemetry/telemetry_capture_1_robot_60s.txt");
    QVERIFY(file.open(QIODevice::ReadOnly));
    const TextDecoder decoder;
    DecodedText decoded;
    int lines = 0;
    while (!file.atEnd()) {
      const QList<QByteArray> parts = file.readLine().split('\t');
      QCOMPARE(parts.size(), 3);
      decoder.decode(parts[2].toStdString(), decoded);
      QVERIFY2(decoded.errors.empty(), parts[2].constData());
      const QList<QByteArray> texts = parts[2].trimmed().split(' ');
      for (int i = 0; i < 15; ++i) {
        QCOMPARE(decoded.values[static_cast<std::size_t>(i)], texts[i].toDouble());
      }
      ++lines;
    }
    QCOMPARE(lines, 60);
  }

  void readsWhatTheEncoderWrites() {
    TextMessage sent;
    sent.robot = 7;
    sent.x = -3;
    sent.belief = 1e-05F;
    sent.imuEulerZ = -3.1415F;
    sent.vision = 1;
    sent.voltage = 124;
    const TextDecoder decoder;
    DecodedText decoded;
    const std::string text = encode(sent);
    decoder.decode(text, decoded);
    QVERIFY2(decoded.errors.empty(), text.c_str());
    QCOMPARE(decoded.robot, 7);
    QCOMPARE(decoder.value(decoded, FieldMeaning::X), std::optional(-3.0));
    QCOMPARE(float(*decoder.value(decoded, FieldMeaning::Belief)), 1e-05F);
    QCOMPARE(decoder.value(decoded, FieldMeaning::Vision), std::optional(1.0));
  }

  void countsWhatIsWrong_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QStringList>("errors");
    QTest::addColumn<bool>("accepted");
    const auto row = [](const char* name, const QByteArray& text, const QStringList& errors,
                        bool accepted) { QTest::newRow(name) << text << errors << accepted; };
    row("good", message(), {}, true);
    row("more spaces", message().replace(" ", "  \t"), {}, true);
    row("line end", message() + "\r\n", {}, true);
    row("C string", message() + QByteArray(1, '\0'), {}, true);
    row("whole number as float", message("258.0"), {}, true);
    row("exponent", message("258", "1e-05"), {}, true);
    row("denormal", message("258", "1e-320"), {}, true);
    row("too small for a double", message("258", "1e-999"), {}, true);
    row("nan", message("258", "nan"), {"not-finite"}, true);
    row("inf", message("258", "-inf"), {"not-finite"}, true);
    row("nan as int", message("nan"), {"not-finite"}, true);
    row("huge", message("258", "1e999"), {"too-large"}, true);
    row("beyond single", message("258", "1e300"), {"too-large"}, true);
    row("huge int", message("99999999999999999999"), {"too-large"}, true);
    row("beyond 32 bits", message("2147483648"), {"too-large"}, true);
    row("text", message("abc"), {"not-a-number"}, true);
    row("half", message("2.5"), {"not-a-number"}, true);
    row("comma", message("258", "5,5"), {"not-a-number"}, true);
    row("plus", message("258", "+5.5"), {"not-a-number"}, true);
    row("flag", message("258", "5.5", "2"), {"bad-flag"}, true);
    row("two messages", message() + " " + message(), {"trailing-text"}, true);
    row("extra", message("258", "5.5", "1", "189 12 3.5 word OUT"), {}, true);
    row("200 extra", message("258", "5.5", "1", "189 ") + QByteArray("1 ").repeated(200) + "OUT",
        {"too-many-fields"}, true);
    row("200 extra, no end", message("258", "5.5", "1", "189 ") + QByteArray("1 ").repeated(200),
        {"missing-end", "too-many-fields"}, false);
    row("empty", "", {"empty"}, false);
    row("spaces", "  \n", {"empty"}, false);
    row("zeros", QByteArray(20, '\0'), {"empty"}, false);
    row("only end", "OUT", {"missing-fields"}, false);
    row("binary", QByteArray("\x01\xff\x80 OUT"), {"binary"}, false);
    row("NUL inside", QByteArray("1 2\0 3 OUT", 10), {"binary"}, false);
    row("no end", message().chopped(4), {"missing-end"}, false);
    row("end in small letters", message("258", "5.5", "1", "189 out"), {"missing-end"}, false);
    row("cut", message().left(30), {"missing-fields", "missing-end"}, false);
    row("one field less", message("258", "5.5", "1", "OUT"), {"missing-fields"}, false);
    row("robot 0", "0" + message().mid(1), {"bad-robot"}, false);
    row("robot negative", "-1" + message().mid(1), {"bad-robot"}, false);
    row("robot without a port", "64296" + message().mid(1), {"bad-robot"}, false);
    row("robot as text", "one" + message().mid(1), {"bad-robot", "not-a-number"}, false);
    row("over-long", QByteArray(65537, '1'), {"too-long"}, false);
    row("longest", QByteArray(65536, '1'),
        {"missing-fields", "missing-end", "bad-robot", "too-large"}, false);
  }
  void countsWhatIsWrong() {
    QFETCH(QByteArray, text);
    QFETCH(QStringList, errors);
    QFETCH(bool, accepted);
    const TextDecoder decoder;
    DecodedText decoded;
    decoder.decode({text.constData(), static_cast<std::size_t>(text.size())}, decoded);
    QCOMPARE(names(decoded.errors), errors);
    QCOMPARE(decoded.accepted(), accepted);
  }

  void aBadFieldSpoilsOnlyItself() {
    const TextDecoder decoder;
    DecodedText decoded;
    const QByteArray text = message("nan");
    decoder.decode(text.toStdString(), decoded);
    QVERIFY(!decoder.value(decoded, FieldMeaning::X));
    QCOMPARE(decoded.badField, std::size_t(1));
    QCOMPARE(decoder.value(decoded, FieldMeaning::Y), std::optional(448.0));
  }

  void keepsExtraFields() {
    const TextDecoder decoder;
    DecodedText decoded;
    const std::string text = message("258", "5.5", "1", "189 12 goalie OUT").toStdString();
    decoder.decode(text, decoded);
    QCOMPARE(decoded.count, std::size_t(17));
    QCOMPARE(decoder.name(decoded, 15), std::string("OTHER_1"));
    QCOMPARE(decoded.values[15], 12.0);
    QCOMPARE(decoder.name(decoded, 16), std::string("OTHER_2"));
    QVERIFY(!decoded.has(16));
    QVERIFY(decoded.texts[16] == "goalie");
  }

  void isTheSameInEveryLocale() {
    // Where the machine has a locale with a decimal comma it is used; the result is the same.
    for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "pt_BR.UTF-8", "C"}) {
      std::setlocale(LC_ALL, locale);
      const TextDecoder decoder;
      DecodedText decoded;
      decoder.decode(good, decoded);
      QCOMPARE(decoder.value(decoded, FieldMeaning::Belief), std::optional(56.3184547424));
    }
    std::setlocale(LC_ALL, "C");
  }

  void allocatesNothing() {
    if (!countsAllocations) QSKIP("the sanitizer has its own allocation functions");
    const TextDecoder decoder;
    auto decoded = std::make_unique<DecodedText>();
    auto tally = std::make_unique<ErrorTally>();
    const std::string bad = message("nan", "1e999", "7", "x 1 2 3").toStdString();
    const long before = allocations;
    for (int i = 0; i < 1000; ++i) {
      decoder.decode(good, *decoded);
      decoder.decode(bad, *decoded);
      tally->add(decoded->errors, bad);
    }
    QCOMPARE(allocations.load(), before);
    QVERIFY(theCounterCounts());
  }

  void survivesMutations() {
    std::mt19937 random(42);
    const TextDecoder decoder;
    DecodedText decoded;
    static constexpr char interesting[] = " .-+eE0189OUTnaif\t\n\0\xff\x80";
    int accepted = 0;
    for (int round = 0; round < 200'000; ++round) {
      std::string text = good;
      const auto changes = 1 + random() % 6;
      for (unsigned i = 0; i < changes && !text.empty(); ++i) {
        const std::size_t at = random() % text.size();
        switch (random() % 4) {
          case 0:
            text[at] = interesting[random() % sizeof interesting];
            break;
          case 1:
            text.erase(at, 1 + random() % 8);
            break;
          case 2:
            text.insert(at, text.substr(random() % text.size(), random() % 24));
            break;
          default:
            text.resize(at);
        }
      }
      decoder.decode(text, decoded);
      QVERIFY(decoded.count <= DecodedText::maxValues);
      if (!decoded.accepted()) continue;
      ++accepted;
      QVERIFY(decoded.robot >= 1 && decoded.robot <= TextDecoder::maxRobot);
      QVERIFY(decoded.count >= decoder.profile().fields.size());
    }
    QVERIFY(accepted > 1000 && accepted < 190'000);
  }

  void talliesWithASample() {
    ErrorTally tally;
    TextErrors errors;
    errors.add(TextError::Binary);
    tally.add(errors, "a\x01z");
    errors.add(TextError::Empty);
    tally.add(errors, std::string(1000, 'b'));
    QCOMPARE(tally.count(TextError::Binary), std::uint64_t(2));
    QCOMPARE(tally.count(TextError::Empty), std::uint64_t(1));
    QCOMPARE(tally.messages(), std::uint64_t(2));
    QCOMPARE(tally.sample(TextError::Binary).size(), ErrorTally::sampleBytes + 3);
    QCOMPARE(tally.sample(TextError::TooLong), std::string());
    QCOMPARE(printable("a\x01\xc3z"), std::string("a\\x01\\xc3z"));
    // The first byte of a longer character as the last one of all: nothing behind it is looked at
    // (the address sanitizer says so).
    const std::vector<char> cut{'a', '\xc2'};
    QCOMPARE(printable({cut.data(), cut.size()}), std::string("a\\xc2"));
    QCOMPARE(printable("\xc2\x85 \xc2\xa0"), std::string("\\xc2\\x85 \xc2\xa0"));
  }
};

QTEST_GUILESS_MAIN(TestTextDecoder)
#include "tst_text_decoder.moc"
