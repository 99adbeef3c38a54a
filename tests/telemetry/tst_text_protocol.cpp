// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/formats/text_protocol.h>

#include <QFile>
#include <QProcess>
#include <QtTest>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace tst_text_protocol {

using namespace pitchboard::telemetry;

namespace {

constexpr int recorded = 60;
constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

// Python 3 writes format(x, '.12') with the code that writes str(x) in Python 2.7.
QList<QByteArray> writtenByPython(const QList<double>& values) {
  QByteArray input;
  for (const double value : values) {
    input += QByteArray::number(std::bit_cast<quint64>(value), 16) + '\n';
  }
  QProcess python;
  python.start("python3", {"-c",
                           "import struct, sys\n"
                           "for line in sys.stdin:\n"
                           "    bits = struct.pack('=Q', int(line, 16))\n"
                           "    print(format(struct.unpack('=d', bits)[0], '.12'))\n"});
  python.write(input);
  python.closeWriteChannel();
  if (!python.waitForFinished(60'000) || python.exitCode() != 0) {
    qWarning() << python.errorString() << python.readAllStandardError();
  }
  return python.readAllStandardOutput().trimmed().split('\n');
}

}  // namespace

class TestTextProtocol : public QObject {
  Q_OBJECT

 private slots:
  // What the published communication process sent for one robot, for a minute.
  void recordedDatagrams() {
    QFile file(PITCHBOARD_TEST_DATA "/telemetry_capture_1_robot_60s.txt");
    QVERIFY(file.open(QIODevice::ReadOnly));
    int count = 0;
    while (!file.atEnd()) {
      QByteArray line = file.readLine();
      if (line.endsWith('\n')) line.chop(1);
      const QByteArray datagram = line.split('\t').at(2);
      const QList<QByteArray> field = datagram.split(' ');
      QCOMPARE(field.size(), 16);
      TextMessage m;
      int at = 0;
      for (int* value : {&m.robot, &m.x, &m.y, &m.theta}) *value = field[at++].toInt();
      for (float* value : {&m.belief, &m.ballDist, &m.ballAngle}) *value = field[at++].toFloat();
      for (int* value : {&m.control, &m.vision, &m.localization, &m.decision, &m.imu, &m.actionA}) {
        *value = field[at++].toInt();
      }
      m.imuEulerZ = field[at++].toFloat();
      m.voltage = field[at++].toInt();
      QCOMPARE(QByteArray::fromStdString(encode(m)), datagram);
      ++count;
    }
    QCOMPARE(count, recorded);
  }

  void fieldsInTheirOrder() {
    const TextMessage m{.robot = 1,
                        .x = 2,
                        .y = 3,
                        .theta = -4,
                        .belief = 5.5F,
                        .ballDist = -1,
                        .ballAngle = 1e-5F,
                        .control = 7,
                        .vision = 8,
                        .localization = 9,
                        .decision = 10,
                        .imu = 11,
                        .actionA = 12,
                        .imuEulerZ = notANumber,
                        .voltage = 13};
    QCOMPARE(encode(m),
             std::string("1 2 3 -4 5.5 -1.0 9.99999974738e-06 7 8 9 10 11 12 nan 13 OUT"));
  }

  void extremeNumbers() {
    constexpr int low = std::numeric_limits<int>::min(), high = std::numeric_limits<int>::max();
    const TextMessage m{.robot = 64,
                        .x = low,
                        .y = high,
                        .theta = low,
                        .belief = inf,
                        .ballDist = -inf,
                        .ballAngle = std::numeric_limits<float>::max(),
                        .imuEulerZ = std::numeric_limits<float>::denorm_min(),
                        .voltage = low};
    QCOMPARE(encode(m),
             std::string("64 -2147483648 2147483647 -2147483648 inf -inf 3.40282346639e+38 "
                         "0 0 0 0 0 0 1.40129846432e-45 -2147483648 OUT"));
  }

  void numbers_data() {
    QTest::addColumn<double>("value");
    QTest::addColumn<QByteArray>("text");
    const auto row = [](double value, const char* text) {
      QTest::addRow("%s", text) << value << QByteArray(text);
    };
    // Printed by Python 2.7.18.
    row(0.0, "0.0");
    row(-0.0, "-0.0");
    row(1.0, "1.0");
    row(-999.0, "-999.0");
    row(189.5, "189.5");
    row(0.1F, "0.10000000149");
    row(16777216.0F, "16777216.0");
    row(0.0001, "0.0001");
    row(1e-05, "1e-05");
    row(12345678901.0, "12345678901.0");
    row(10000000000.0, "10000000000.0");
    row(99999999999.96, "1e+11");
    row(100000000000.0, "1e+11");
    row(-100000000000.0, "-1e+11");
    row(123456789012.0, "1.23456789012e+11");
    row(120000000000.0, "1.2e+11");
    row(999999999999.0, "9.99999999999e+11");
    row(999999999999.6, "1e+12");
    row(1e12, "1e+12");
    row(1e16, "1e+16");
    row(1e100, "1e+100");
    row(5e-324, "4.94065645841e-324");
    row(std::numeric_limits<double>::max(), "1.79769313486e+308");
    row(inf, "inf");
    row(-inf, "-inf");
    row(notANumber, "nan");
    QTest::newRow("-nan") << std::copysign(double{notANumber}, -1.0) << QByteArray("nan");
  }
  void numbers() {
    QFETCH(double, value);
    QFETCH(QByteArray, text);
    QCOMPARE(QByteArray::fromStdString(pythonFloat(value)), text);
  }

  void manyNumbers() {
    std::mt19937 random(1);
    const auto bits = [&random] { return static_cast<std::uint32_t>(random()); };
    QList<double> values{0.0,  -0.0,           inf,
                         -inf, notANumber,     99999999999.96,
                         1e11, 123456789012.0, 999999999999.6,
                         1e12, 5e-324,         std::numeric_limits<double>::max()};
    for (int i = 0; i < 4000; ++i) values.append(std::bit_cast<float>(bits()));  // any float32
    for (int i = 0; i < 2000; ++i) {  // around the places where the form changes
      const int decade = static_cast<int>(bits() % 22) - 6;
      values.append(static_cast<float>(std::pow(10.0, decade) * (1 + bits() % 1000 / 100.0)));
      values.append(std::pow(10.0, decade) * (1 - 1e-13 * (bits() % 100)));
    }
    const QList<QByteArray> expected = writtenByPython(values);
    QCOMPARE(expected.size(), values.size());
    for (qsizetype i = 0; i < values.size(); ++i) {
      const QByteArray text = QByteArray::fromStdString(pythonFloat(values[i]));
      QVERIFY2(text == expected[i], (text + ", and Python writes " + expected[i]).constData());
    }
  }
};

PITCHBOARD_TEST(TestTextProtocol)

}  // namespace tst_text_protocol

#include "tst_text_protocol.moc"
