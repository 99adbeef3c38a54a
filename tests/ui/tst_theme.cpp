// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>
#include <cmath>

#include <ui/base/robot_words.h>
#include <ui/base/theme.h>

using namespace pitchboard;
using namespace pitchboard::ui;

class TestTheme : public QObject {
  Q_OBJECT
 private slots:
  void switches() {
    setTheme(*qApp, ThemeChoice::Dark);
    QVERIFY(isDarkTheme());
    QCOMPARE(qApp->palette().color(QPalette::Window), QColor("#2b2e32"));
    QCOMPARE(qApp->palette().color(QPalette::Disabled, QPalette::WindowText), QColor("#69717b"));
    setTheme(*qApp, ThemeChoice::Light);
    QVERIFY(!isDarkTheme());
    QCOMPARE(qApp->palette().color(QPalette::Window), QColor("#eff0f2"));
    QCOMPARE(theme().team(TeamColor::Red), QColor("#c2413c"));
  }

  void iconsTakeTheTextColour_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("in the theme") << QStringLiteral("media-playback-start");
    QTest::newRow("nowhere") << QStringLiteral("no-such-icon-at-all");
  }
  void iconsTakeTheTextColour() {
    QFETCH(QString, name);
    const QIcon icon = themedIcon(name);
    QVERIFY(!icon.isNull());
    for (const ThemeChoice choice : {ThemeChoice::Dark, ThemeChoice::Light}) {
      setTheme(*qApp, choice);
      const auto middle = [&](QIcon::Mode mode) {
        return icon.pixmap(QSize(22, 22), 1.0, mode).toImage().pixelColor(11, 11);
      };
      QCOMPARE(middle(QIcon::Normal), theme().text);
      QCOMPARE(middle(QIcon::Disabled), theme().disabledText);
    }
  }

  void iconsAreSharpAtTwiceTheSize() {
    const QPixmap drawn =
        themedIcon(QStringLiteral("media-playback-start")).pixmap(QSize(22, 22), 2.0);
    QCOMPARE(drawn.size(), QSize(44, 44));
  }

  void words() {
    QCOMPARE(numberText(-1.236, 2), QString::fromUtf8("−1.24"));
    QCOMPARE(numberText(-0.001, 2), QStringLiteral("0.00"));
    QCOMPARE(clockText(312.9), QStringLiteral("05:12"));
    QCOMPARE(clockText(3671), QStringLiteral("1:01:11"));
    QCOMPARE(durationText(59.99), QStringLiteral("59 s"));
    QCOMPARE(durationText(9.97, 1), QStringLiteral("9.9 s"));
    QCOMPARE(durationText(0.2, 1), QStringLiteral("0.2 s"));
    QCOMPARE(durationText(12.7, 1), QStringLiteral("12 s"));
    QCOMPARE(durationText(60), QStringLiteral("1 min"));
    QCOMPARE(durationText(1937), QStringLiteral("32 min 17 s"));
    QCOMPARE(durationText(18299), QStringLiteral("5 h 4 min"));
    QCOMPARE(durationText(273600), QStringLiteral("3 d 4 h"));
    QCOMPARE(durationText(-3), QStringLiteral("0 s"));
    QCOMPARE(durationText(std::nan("")), QStringLiteral("–"));
    QCOMPARE(actionText(42), QStringLiteral("action 42"));
    QCOMPARE(countText(18720).size(), qsizetype(6));
  }
};

QTEST_MAIN(TestTheme)
#include "tst_theme.moc"
