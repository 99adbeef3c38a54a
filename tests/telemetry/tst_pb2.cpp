// SPDX-License-Identifier: GPL-3.0-or-later
// The text in which robots send their variables: numbers come back to the last bit, datagrams keep
// their size, and whatever is wrong is refused with the place.
#include <QtTest>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include <telemetry/pb2/pb2.h>

namespace tst_pb2 {

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

QByteArray bytesOf(std::string_view text) {
  return {text.data(), static_cast<qsizetype>(text.size())};
}

}  // namespace

class TestPb2 : public QObject {
  Q_OBJECT
 private slots:
  void aMessageIsRead() {
    const auto message = parsePb2(
        "PB2 3 4294967295 18446744073709551615 @REFRESH=2500 @WAITING=7 @BLACKBOARD=1 @LATER=1.5 "
        "DECISION_ACTION_A=-12 IMU_EULER_Z=0.1 _a9=3.0 N=nan P=inf M=-inf OUT\n");
    QVERIFY2(message, message ? "" : message.error().text().c_str());
    QCOMPARE(message->robot, 3);
    QCOMPARE(message->sequence, 4294967295U);
    QCOMPARE(message->milliseconds, std::numeric_limits<std::uint64_t>::max());
    QVERIFY(message->status.refresh_ms == 2500 && message->status.waiting == 7);
    QVERIFY(message->status.blackboard == true);
    QCOMPARE(message->values.size(), std::size_t{6});
    QCOMPARE(bytesOf(message->values[0].name), QByteArray("DECISION_ACTION_A"));
    QCOMPARE(message->values[0].value, -12.0);
    QVERIFY(message->values[0].whole);
    // A float of the blackboard, not the double of that text.
    QVERIFY(message->values[1].value == static_cast<double>(0.1F));
    QVERIFY(!message->values[1].whole && !message->values[2].whole);
    QVERIFY(std::isnan(message->values[3].value));
    QVERIFY(message->values[4].value == std::numeric_limits<double>::infinity());
    QVERIFY(message->values[5].value == -std::numeric_limits<double>::infinity());
  }

  void aMessageMayHoldNothing() {
    const auto message = parsePb2("PB2 1 0 0 OUT");
    QVERIFY(message && message->values.empty() && !message->status.blackboard);
  }

  void hostileTextIsRefusedWithThePlace_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("hasText");
    const auto row = [](const char* name, const QByteArray& text, const char* hasText) {
      QTest::newRow(name) << text << QString(hasText);
    };
    row("nothing", "", "byte 0: the datagram must begin with PB2");
    row("other", "PB1 1 1 1 OUT", "byte 0");
    row("robot 0", "PB2 0 1 1 OUT", "byte 4: the robot's number must be 1 to 64, not \"0\"");
    row("robot 65", "PB2 65 1 1 OUT", "byte 4");
    row("robot of 40 digits", "PB2 " + QByteArray(40, '9') + " 1 1 OUT", "byte 4");
    row("cut", "PB2 1", "byte 5: the sequence number");
    row("sequence of 33 bits", "PB2 1 4294967296 1 OUT", "byte 6");
    row("negative sequence", "PB2 1 -1 1 OUT", "byte 6");
    row("time of 65 bits", "PB2 1 1 18446744073709551616 OUT", "byte 8: the time");
    row("no end", "PB2 1 1 1 A=1", "OUT is missing");
    row("end in a word", "PB2 1 1 1 A=1OUT", "byte 10");
    row("two messages", "PB2 1 1 1 OUT PB2 1 2 1 OUT", "byte 14: there is text after OUT");
    row("no value", "PB2 1 1 1 A= OUT", "byte 10: the value of \"A\"");
    row("no name", "PB2 1 1 1 =1 OUT", "byte 10: \"\" is not a name");
    row("no equals", "PB2 1 1 1 A OUT", "byte 10: expected NAME=VALUE");
    row("a digit first", "PB2 1 1 1 1A=1 OUT", "is not a name");
    row("status without name", "PB2 1 1 1 @=1 OUT", "is not a name");
    row("long name", "PB2 1 1 1 " + QByteArray(65, 'A') + "=1 OUT",
        "\"AAAAAAAAAAAAAAAAAAAAAAAA...\"");
    row("words", "PB2 1 1 1 A=one OUT", "not a number that fits: \"one\"");
    row("hexadecimal", "PB2 1 1 1 A=0x10 OUT", "not a number");
    row("two numbers", "PB2 1 1 1 A=1,2 OUT", "not a number");
    row("huge whole number", "PB2 1 1 1 A=9007199254740993 OUT", "fits");
    row("huge float", "PB2 1 1 1 A=1e39 OUT", "fits");
    row("absurd float", "PB2 1 1 1 A=1e99999 OUT", "fits");
    row("only a sign", "PB2 1 1 1 A=- OUT", "fits");
    row("binary", QByteArray("PB2 1 1 1 A\0=1 OUT", 17), "is not a name: use");
    row("control bytes are shown", "PB2 1 1 1 A=\x1b[2J OUT", "\"?[2J\"");
    row("too long", "PB2 1 1 1 " + QByteArray(2000, ' ') + "OUT", "at most 1400 are read");
  }
  void hostileTextIsRefusedWithThePlace() {
    QFETCH(QByteArray, text);
    QFETCH(QString, hasText);
    const auto message = parsePb2({text.data(), static_cast<std::size_t>(text.size())});
    QVERIFY(!message);
    const QString error = QString::fromStdString(message.error().text());
    QVERIFY2(error.contains(hasText), qPrintable(error));
    QVERIFY(error.size() < 200);
  }

  void everyNumberComesBack() {
    std::mt19937 random(28);
    const auto goesThrough = [](float value) {
      const Pb2Number number(value);
      Pb2Writer writer(1, 2, 3);
      writer.add("A", number.text());
      const std::string text = std::move(writer).finish();
      const auto message = parsePb2(text);
      if (!message || message->values.size() != 1 || message->values[0].whole) return false;
      const auto back = static_cast<float>(message->values[0].value);
      return std::isnan(value)
                 ? std::isnan(back)
                 : std::bit_cast<std::uint32_t>(back) == std::bit_cast<std::uint32_t>(value);
    };
    for (int i = 0; i < 50'000; ++i) {
      const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
      QVERIFY2(goesThrough(value), qPrintable(QString::number(double(value), 'g', 12)));
    }
    using Limits = std::numeric_limits<float>;
    for (const float value : {0.0F, -0.0F, 1.0F, -3.0F, 1e9F, 16777216.0F, Limits::denorm_min(),
                              Limits::min(), Limits::max(), -Limits::max(), Limits::infinity(),
                              -Limits::infinity(), Limits::quiet_NaN(), -Limits::quiet_NaN()}) {
      QVERIFY2(goesThrough(value), qPrintable(QString::number(double(value), 'g', 12)));
    }
    for (const std::int64_t value :
         {std::int64_t{0}, std::int64_t{-2147483648LL}, std::int64_t{2147483647}}) {
      Pb2Writer writer(1, 2, 3);
      writer.add("A", Pb2Number(value).text());
      const std::string text = std::move(writer).finish();
      const auto message = parsePb2(text);
      QVERIFY(message && message->values[0].whole);
      QCOMPARE(message->values[0].value, static_cast<double>(value));
    }
  }

  void aDatagramIsFilledToItsLimit() {
    Pb2Writer writer(64, 4294967295U, 18446744073709551615U);
    std::size_t count = 0;
    const std::string name(7, 'A');
    const Pb2Number number(std::int64_t{5});
    while (writer.fits(Pb2Writer::fieldBytes(name, number.text()))) {
      writer.add(name, number.text());
      ++count;
    }
    const std::size_t bytes = writer.bytes();
    const std::string text = std::move(writer).finish();
    QCOMPARE(text.size(), bytes);
    QVERIFY(text.size() <= Pb2Limits::bytes && text.size() + 10 > Pb2Limits::bytes);
    const auto message = parsePb2(text);
    QVERIFY(message);
    QCOMPARE(message->values.size(), count);
  }
};

PITCHBOARD_TEST(TestPb2)

}  // namespace tst_pb2

#include "tst_pb2.moc"
