// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers typed with a decimal comma or a point, in any locale, by keys.
#include <QLineEdit>
#include <QToolTip>
#include <QtTest>

#include <ui/base/number_box.h>

namespace tst_number_box {

using namespace pitchboard::ui;

class TestNumberBox : public QObject {
  Q_OBJECT

 private slots:
  void aTypedNumberIsUnderstood_data() {
    QTest::addColumn<QString>("locale");
    QTest::addColumn<QString>("typed");
    QTest::addColumn<double>("value");
    for (const char* locale : {"C", "de_DE", "en_US", "pl_PL", "sv_SE"}) {
      const auto row = [locale](const char* typed, double value) {
        QTest::addRow("%s in %s", typed, locale)
            << QString::fromLatin1(locale) << QString::fromUtf8(typed) << value;
      };
      row("-1,25", -1.25);
      row("-1.25", -1.25);
      row("0,75", 0.75);
      row(",5", 0.5);
      row("2", 2.0);
      row("1,234", 1.23);  // never a thousand
      row("1,2,5", 1.25);  // the second comma is not taken
      row("1.234,5", 1.23);
    }
  }
  void aTypedNumberIsUnderstood() {
    QFETCH(QString, locale);
    QFETCH(QString, typed);
    QFETCH(double, value);
    const QLocale before;
    QLocale::setDefault(QLocale(locale));
    NumberBox box;
    QLocale::setDefault(before);
    box.setRange(-2000, 2000);
    box.setDecimals(2);
    box.setSuffix(QStringLiteral(" m"));
    box.show();
    box.selectAll();
    QTest::keyClicks(&box, typed);
    QTest::keyClick(&box, Qt::Key_Return);
    QCOMPARE(box.value(), value);
    const QString shown = QString::number(value, 'f', 2).replace(QLatin1Char('-'), QChar(0x2212));
    QCOMPARE(box.text(), shown + QStringLiteral(" m"));
  }

  void aCopiedMinusSignIsUnderstood() {
    NumberBox box;
    box.setRange(-10, 10);
    auto* text = box.findChild<QLineEdit*>();
    text->selectAll();
    text->insert(QStringLiteral("−0,5"));
    QCOMPARE(box.value(), -0.5);
  }

  void lettersAreNotTaken() {
    NumberBox box;
    box.setDecimals(1);
    box.show();
    box.selectAll();
    QTest::keyClicks(&box, QStringLiteral("x7y,z5"));
    QTest::keyClick(&box, Qt::Key_Return);
    QCOMPARE(box.value(), 7.5);
  }

  void tooMuchIsReported_data() {
    QTest::addColumn<QString>("typed");
    QTest::addColumn<double>("value");
    QTest::addColumn<QString>("reported");
    QTest::newRow("too large") << "5000" << 50.0 << "50.0 cm is the largest value.";
    QTest::newRow("too small") << "1" << 2.0 << "2.0 cm is the smallest value.";
    QTest::newRow("within") << "7,5" << 7.5 << QString();
  }
  void tooMuchIsReported() {
    QFETCH(QString, typed);
    QFETCH(double, value);
    QFETCH(QString, reported);
    QToolTip::hideText();
    QTRY_VERIFY(!QToolTip::isVisible());
    NumberBox box;
    box.setRange(2, 50);
    box.setDecimals(1);
    box.setSuffix(QStringLiteral(" cm"));
    box.setValue(20);
    box.show();
    box.selectAll();
    QTest::keyClicks(&box, typed);
    QTest::keyClick(&box, Qt::Key_Return);
    QCOMPARE(box.value(), value);
    QCOMPARE(QToolTip::isVisible(), !reported.isEmpty());
    if (!reported.isEmpty()) QCOMPARE(QToolTip::text(), reported);
  }

  void textIsANumberOrNot() {
    QCOMPARE(numberFromText(QStringLiteral(" -1,25 ")), std::optional(-1.25));
    QCOMPARE(numberFromText(QStringLiteral("−3e2")), std::optional(-300.0));
    for (const char* no : {"", "x", "1,2,3", "1.234,5", "nan", "inf", "1 000"}) {
      QVERIFY2(!numberFromText(QString::fromLatin1(no)), no);
    }
  }
};

PITCHBOARD_GUI_TEST(TestNumberBox)

}  // namespace tst_number_box

#include "tst_number_box.moc"
