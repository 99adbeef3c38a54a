// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>

#include <telemetry/expression/expression.h>
#include <telemetry/expression/expression_unit.h>

namespace tst_expression_unit {

using namespace pitchboard::telemetry;

namespace {

/// X, Y in m; VX in m/s; DIST in cm; ANGLE in °; ACTION a code; NOISY without a known unit.
std::optional<std::string> unitOf(const std::string& name) {
  if (name == "B1/X" || name == "B1/Y") return "m";
  if (name == "B1/VX") return "m/s";
  if (name == "B1/DIST" || name == "B1/odd name") return "cm";
  if (name == "B1/ANGLE") return "°";
  if (name == "B1/ACTION") return "1";
  return std::nullopt;
}

}  // namespace

class TestExpressionUnit : public QObject {
  Q_OBJECT

 private slots:
  void theUnitFollowsFromTheVariables_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("unit");  // empty: unknown
    const auto row = [](const char* text, const char* unit) {
      QTest::newRow(text) << QString::fromUtf8(text) << QString::fromUtf8(unit);
    };
    row("hypot(B1.X - B1.Y, 2)", "m");
    row("B1.X + 5", "m");
    row("min(B1.DIST, 100)", "cm");
    row("-B1.ANGLE", "°");
    row("B1.X * B1.Y", "m²");
    row("sqrt(B1.X^2 + B1.Y^2)", "m");
    row("B1.VX * t", "m");
    row("B1.X / t", "m/s");
    row("B1.VX / t", "m/s²");
    row("1 / B1.VX", "s/m");
    row("t", "s");
    row("t * B1.ACTION", "s");
    row("B1.X / B1.Y", "1");
    row("B1.X > 2 && B1.Y < 1", "1");
    row("B1.ACTION == 4 ? B1.DIST : 0", "cm");
    row("B1.ACTION == 4 ? B1.DIST : B1.X", "");
    row("{B1/odd name} * 2", "cm");
    row("{ B1/odd name }", "cm");
    row("(B1.X + B1.Y) / 2", "m");
    row("deg(atan2(B1.Y, B1.X))", "°");
    row("atan2(B1.Y, B1.X)", "rad");
    row("wrap(B1.ANGLE + 90, 360)", "°");
    row("sin(B1.ANGLE)", "1");
    // A factor that converts.
    row("B1.DIST / 100", "m");
    row("B1.X * 100", "cm");
    row("100 * B1.VX", "cm/s");
    row("B1.ANGLE * pi / 180", "rad");
    row("B1.DIST / 100 - B1.X", "m");
    row("B1.DIST - B1.X", "");
    row("B1.DIST * 1000 / 25", "cm");
    row("B1.DIST * 1000", "");  // 10 µm is no unit of ours
    row("B1.DIST + B1.ANGLE", "");
    row("B1.NOISY * 2", "");
    row("B1.X * B1.NOISY", "");
    row("unheard_of(B1.X)", "");
    row("B1.X ^ B1.Y", "");
    row("sqrt(B1.X)", "");
    row("(B1.X", "");
    row("B1.X B1.Y", "");
    row("", "");
    QTest::newRow("deep") << QString(1000, QLatin1Char('(')) + QStringLiteral("B1.X") +
                                 QString(1000, QLatin1Char(')'))
                          << QString();
  }
  void theUnitFollowsFromTheVariables() {
    QFETCH(QString, text);
    QFETCH(QString, unit);
    const auto found = unitOfExpression(text.toStdString(), unitOf);
    QCOMPARE(QString::fromStdString(found.value_or(std::string())), unit);
  }

  void secondsAreMultipliedAndDivided() {
    QCOMPARE(timesSeconds("m", -1), std::string("m/s"));
    QCOMPARE(timesSeconds("m/s", 1), std::string("m"));
    QCOMPARE(timesSeconds("°/s", -1), std::string("°/s²"));
    QCOMPARE(timesSeconds("1", -1), std::string("1/s"));
    QCOMPARE(timesSeconds("", 1), std::string());
  }

  /// In our words, with the place that a person counts.
  void mistakesAreNamed_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("problem");
    const auto row = [](const char* text, const char* problem) {
      QTest::newRow(text) << QString::fromUtf8(text) << QString::fromUtf8(problem);
    };
    row("B1.X + * 2", "the operator '*' at character 8 has no value before it");
    row("sinus(B1.X)", "'sinus' at character 1 is neither a function nor a variable");
    row("{B1/a b} + sinus(B1.X)", "'sinus' at character 12 is neither a function nor a variable");
    row("(B1.X + 2", "a ')' is missing");
    row("B1.X + 2)", "the bracket ')' at character 9 does not belong there");
    row("B1.X +", "the expression is incomplete: a value is missing at its end");
    row("2 B1.X", "an operator is missing before 'B1.X' at character 3");
    row("B1.X > 2 ? 1", "a ':' with the other value is missing after the '?'");
    row("B1.X : 1", "the ':' at character 6 has no '?' before it");
    row("B1.X + §", "'§' at character 8 is neither a function nor a variable");
  }
  void mistakesAreNamed() {
    QFETCH(QString, text);
    QFETCH(QString, problem);
    const auto parsed = Expression::parse(text.toStdString());
    QVERIFY(!parsed);
    QCOMPARE(QString::fromStdString(parsed.error().message), problem);
  }
};

PITCHBOARD_TEST(TestExpressionUnit)

}  // namespace tst_expression_unit

#include "tst_expression_unit.moc"
