// SPDX-License-Identifier: GPL-3.0-or-later
// Unknown in, unknown out: every row of the table in docs/plots.md, and every operator and function
// with an unknown value in each place. Decimal commas.
#include <QFile>
#include <QRegularExpression>
#include <QtTest>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <telemetry/expression/expression.h>

using namespace pitchboard;

namespace tst_expression {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

class TestExpression : public QObject {
  Q_OBJECT

  /// With B1.U unknown, B1.K = 2 and every other variable 3.
  static double valueOf(const QString& text) {
    auto made = telemetry::Expression::parse(text.toStdString());
    if (!made) qFatal("%s: %s", qPrintable(text), made.error().message.c_str());
    std::vector<double> values;
    for (const std::string& name : made->variables()) {
      values.push_back(name == "B1/U" ? unknown : name == "B1/K" ? 2.0 : 3.0);
    }
    return made->evaluate(0.0, values);
  }

 private slots:
  void unknownValuesAreAsDocumented_data() {
    QTest::addColumn<QString>("expression");
    QTest::addColumn<QString>("value");
    QFile page(QStringLiteral(PITCHBOARD_SOURCE_DIR "/docs/plots.md"));
    QVERIFY(page.open(QIODevice::ReadOnly));
    const QString text = QString::fromUtf8(page.readAll()).section("### Unknown values", 1);
    static const QRegularExpression row("^\\| (`.*) \\| ([^|]+) \\|$",
                                        QRegularExpression::MultilineOption);
    static const QRegularExpression code("`([^`]+)`");
    for (const auto& found : row.globalMatch(text)) {
      for (const auto& one : code.globalMatch(found.captured(1))) {
        const QString expression = one.captured(1).replace("\\|", "|");
        QTest::newRow(qPrintable(expression)) << expression << found.captured(2);
      }
    }
  }
  void unknownValuesAreAsDocumented() {
    QFETCH(QString, expression);
    QFETCH(QString, value);
    const double is = valueOf(expression);
    if (value == "unknown") {
      QVERIFY2(std::isnan(is), qPrintable(QString::number(is)));
    } else {
      QCOMPARE(is, value.toDouble());
    }
  }

  void everyOperatorAndFunctionKeepsUnknownValues() {
    int looked = 0;
    const auto look = [&](const QString& text) {
      ++looked;
      QVERIFY2(std::isnan(valueOf(text)), qPrintable(text));
    };
    for (const char* oprt :
         {"+", "-", "*", "/", "^", "<", "<=", ">", ">=", "==", "!=", "&&", "||"}) {
      for (const char* other : {"0", "1", "2", "B1.K", "(1 / 0)", "B1.U"}) {
        look(QStringLiteral("B1.U %1 %2").arg(oprt, other));
        look(QStringLiteral("%2 %1 B1.U").arg(oprt, other));
      }
    }
    for (const char* function :
         {"sin",   "cos",   "tan", "asin", "acos", "atan", "sinh",  "cosh", "tanh", "asinh",
          "acosh", "atanh", "exp", "ln",   "log",  "log2", "log10", "sqrt", "abs",  "sign",
          "rint",  "deg",   "rad", "!",    "-",    "min",  "max",   "sum",  "avg"}) {
      look(QStringLiteral("%1(B1.U)").arg(function));
    }
    for (const char* function : {"atan2", "hypot", "wrap", "min", "max", "sum", "avg"}) {
      for (const char* other : {"0", "1", "B1.K", "1 / 0", "B1.U"}) {
        look(QStringLiteral("%1(B1.U, %2)").arg(function, other));
        look(QStringLiteral("%1(%2, B1.U)").arg(function, other));
      }
    }
    QCOMPARE(looked, 13 * 12 + 29 + 7 * 10);
  }

  void knownValuesAreComputedAsBefore_data() {
    QTest::addColumn<double>("value");  // B1.K = 2, B1.A = 3
    QTest::newRow("B1.K < B1.A") << 1.0;
    QTest::newRow("B1.K >= B1.A") << 0.0;
    QTest::newRow("B1.K == -2") << 0.0;
    QTest::newRow("B1.K<-1||B1.A<=3&&B1.A!=-1") << 1.0;
    QTest::newRow("1 < B1.K == 1") << 1.0;
    QTest::newRow("B1.K + 1 == 3 && B1.A * 2 > 5") << 1.0;
    QTest::newRow("0 || 1 && 0 * B1.K") << 0.0;
    QTest::newRow("-B1.K ^ 2") << -4.0;
    QTest::newRow("2 ^ B1.A ^ 2") << 512.0;
    QTest::newRow("B1.A ^ 3 + B1.A ^ 0.5 * 0") << 27.0;
    QTest::newRow("!B1.K == 0") << 1.0;
    QTest::newRow("min(B1.A, B1.K, 7) + max(B1.K, B1.A, -1)") << 5.0;
    QTest::newRow("sign(B1.K) - sign(-B1.A) + sign(0)") << 2.0;
    QTest::newRow("B1.K > 3 ? 1 : B1.A > 2 ? 4 : 5") << 4.0;
    QTest::newRow("B1.K > 1 ? B1.A > 3 ? 1 : 2 : 3") << 2.0;
    QTest::newRow("(B1.K > 1 ? 0 : 1) ? 5 : max(B1.A ? 6 : 7, 1)") << 6.0;
    QTest::newRow("{B1/K} ? {B1/odd: ?(,} : 0") << 3.0;
  }
  void knownValuesAreComputedAsBefore() {
    QFETCH(double, value);
    QCOMPARE(valueOf(QString::fromUtf8(QTest::currentDataTag())), value);
  }

  void decimalCommasAreReported_data() {
    QTest::addColumn<QString>("says");
    QTest::newRow("B1.X * 0 + 1,5") << "the ',' at character 13";
    QTest::newRow("(1,5) + B1.X") << "the ',' at character 3";
    QTest::newRow("{B1/ä,b} + (B1.X + 1,5)") << "the ',' at character 21";
    QTest::newRow("B1.X > 1,5 ? 1 : 0") << "the ',' at character 9";
    QTest::newRow("B1.X, B1.Y") << "the ',' at character 5";
    QTest::newRow("sin(B1.X + 1,5)") << "too many arguments";
    QTest::newRow("hypot(B1.X, 1,5)") << "too many arguments";
  }
  void decimalCommasAreReported() {
    QFETCH(QString, says);
    const auto read = telemetry::Expression::parse(QTest::currentDataTag());
    QVERIFY(!read);
    const QString message = QString::fromStdString(read.error().message);
    QVERIFY2(message.contains(says) && message.contains("decimals with a point"),
             qPrintable(message));
  }

  // A zero byte ends the text for the library, so that it accepted whatever came behind it.
  void aZeroByteIsReported() {
    const auto read = telemetry::Expression::parse(std::string_view("B1.X\0 ? (", 10));
    QVERIFY(!read);
    QVERIFY2(QString::fromStdString(read.error().message).contains("character at 5"),
             read.error().message.c_str());
  }
};

PITCHBOARD_TEST(TestExpression)

}  // namespace tst_expression

#include "tst_expression.moc"
