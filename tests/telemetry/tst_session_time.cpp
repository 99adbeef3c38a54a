// SPDX-License-Identifier: GPL-3.0-or-later
// Times as people type them: seconds, m:ss, h:mm:ss, times of day; moments outside a session.
#include <QtTest>

#include <base/time_text.h>
#include <telemetry/session/session_time.h>

namespace tst_session_time {

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

/// Central Europe, UTC+2 in summer.
struct ZoneOfThisTest {
  ZoneOfThisTest() {
    qputenv("TZ", "CET-1CEST,M3.5.0,M10.5.0/3");
    tzset();
  }
  ~ZoneOfThisTest() {
    qunsetenv("TZ");
    tzset();
  }
  Q_DISABLE_COPY_MOVE(ZoneOfThisTest)
};

/// 23:58:20.25 of a summer's night there.
WallTime summerNight() {
  using namespace std::chrono;
  return sys_days(2026y / July / 1) + 21h + 58min + 20s + milliseconds(250) + nanoseconds(0);
}

}  // namespace

class TestSessionTime : public QObject {
  Q_OBJECT

 private slots:
  void momentsAreTypedInUsualForms_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("clock");
    QTest::addColumn<double>("seconds");
    const auto row = [](const char* text, double seconds, bool clock = false) {
      QTest::newRow(qPrintable(QLatin1String(text) + QLatin1String(clock ? " --clock" : "")))
          << QString::fromLatin1(text) << clock << seconds;
    };
    row("90.5", 90.5);
    row("01:30", 90.0);
    row("1:30.5", 90.5);
    row("0:01:18.7", 78.7);
    row("75:00", 4500.0);
    row("1:15:00", 4500.0);
    row("2026-07-01T23:59:00", 39.75);
    row("2026-07-02 00:01:00", 159.75);
    row("2026-07-01T22:01:00Z", 159.75);
    row("2026-07-01T23:59", 39.75);
    row("90.5", 90.5, true);
    row("23:58:20.25", 0.0, true);
    row("23:59", 39.75, true);
    row("00:01:00.5", 160.25, true);
    row("21:59:00Z", 39.75, true);
    row("22:01Z", 159.75, true);
    row("2026-07-01 23:59", 39.75, true);
    // Less than a second outside.
    row("-0.9", 0.0);
    row("5000.9", 5000.0);
    row("23:58:20", 0.0, true);
  }
  void momentsAreTypedInUsualForms() {
    const ZoneOfThisTest zone;
    QFETCH(QString, text);
    QFETCH(bool, clock);
    QFETCH(double, seconds);
    const auto time = sessionTime(text.toStdString(), summerNight(), {0.0, 5000.0},
                                  clock ? TimeForms::Clock : TimeForms::Session);
    QVERIFY2(time, time ? "" : time.error().text().c_str());
    QVERIFY2(std::abs(*time - seconds) < 1e-6, qPrintable(QString::number(*time, 'f', 6)));
  }
  /// On the second day of a long session, the same time of day can be before the part begins.
  void theEndOfAPartIsBehindItsBeginning() {
    const WallTime start{std::chrono::seconds(1'800'000'000)};  // 08:00:00Z
    const auto end = [start](std::optional<double> after) {
      return sessionTime("08:01Z", start, {0.0, 100'000.0}, TimeForms::Clock, after).value_or(-1.0);
    };
    QCOMPARE(end({}), 60.0);
    QCOMPARE(end(3600.0), 86'460.0);
  }
  void aMomentOutsideNamesTheRangeOfTheSession_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("clock");
    QTest::addColumn<QString>("words");
    const char* const range = "is outside the session, which goes from 0:01.5 to 16:40";
    const char* const night = "(2026-07-01 23:58:21 to 2026-07-02 00:15:00)";
    const auto row = [](const char* text, bool clock, const char* words) {
      QTest::addRow("%s %s", text, words) << QString::fromLatin1(text) << clock << words;
    };
    row("9999", false, range);
    row("-3", false, range);
    row("14:03:20", false, range);
    row("14:03:20", false, "for a time of day add its date or --clock.");
    row("23:00", true, range);
    row("23:00", true, night);
    row("00:20", true, night);
    row("2026-07-02 14:03:20", false, night);
  }
  void aMomentOutsideNamesTheRangeOfTheSession() {
    const ZoneOfThisTest zone;
    QFETCH(QString, text);
    QFETCH(bool, clock);
    QFETCH(QString, words);
    const auto time = sessionTime(text.toStdString(), summerNight(), {1.5, 1000.0},
                                  clock ? TimeForms::Clock : TimeForms::Session);
    QVERIFY(!time);
    QVERIFY2(QString::fromStdString(time.error().message).contains(words),
             time.error().message.c_str());
  }
  void whatIsNoMomentIsReported() {
    const WallTime start{std::chrono::seconds(1'800'000'000)};
    const QString all = QStringLiteral(
        " soon 12:60 12:00:60 12:60:00 12:00: 1:0 :30 1:2:3 0:00:00:00 1e2 12:00x 2026-02-30T12:00 "
        "2026-13-01T12:00 2026-01-01 nan inf 12:00:00+01:00 - .");
    for (const QString& one : all.split(u' ')) {
      const std::string text = one.toStdString();
      for (const TimeForms forms : {TimeForms::Session, TimeForms::Clock}) {
        const auto time = sessionTime(text, start, {0.0, 1e6}, forms);
        QVERIFY2(!time, text.c_str());
        QVERIFY2(time.error().message.find("is not a time. Write seconds (78.7), m:ss") !=
                     std::string::npos,
                 text.c_str());
      }
    }
    QVERIFY(!sessionTime("12:00:00.", start, {0.0, 1e6}, TimeForms::Clock));
    QVERIFY(!sessionTime("25:00", start, {0.0, 1e6}, TimeForms::Clock));
    QVERIFY(!sessionTime("1:00", start, {0.0, 1e6}, TimeForms::Clock));
    QVERIFY(!sessionTime("2026-01-01 12:00", WallTime{}, {0.0, 10.0}));
    QVERIFY(sessionTime("5", WallTime{}, {0.0, 10.0}));
  }
  void timesAreWrittenAsTheyAreRead() {
    for (const auto& [seconds, text] : {std::pair(0.0, "0:00"),
                                        {78.7, "1:18.7"},
                                        {3723.25, "1:02:03.25"},
                                        {-5.0, "-0:05"},
                                        {59.9996, "1:00"},
                                        {0.0004, "0:00"},
                                        {600.0, "10:00"}}) {
      QCOMPARE(secondsToText(seconds), std::string(text));
      QVERIFY(std::abs(secondsFromText(text).value_or(1e9) - seconds) < 1e-3);
    }
  }
};

PITCHBOARD_TEST(TestSessionTime)

}  // namespace tst_session_time

#include "tst_session_time.moc"
