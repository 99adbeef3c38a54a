// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/scoreboard_state.h>
#include <QComboBox>
#include <QPainter>
#include <QProgressBar>
#include <QStandardItemModel>
#include <QStyleOptionButton>
#include <QtTest>
#include <cmath>

#include <ui/base/elide_text.h>
#include <ui/base/quick_painting.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/base/theme.h>

namespace tst_theme {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

QImage painted(const std::function<void(QPainter&)>& paint, double ratio = 1.0) {
  QImage image(QSize(160, 60) * ratio, QImage::Format_RGB32);
  image.setDevicePixelRatio(ratio);
  image.fill(QColor(90, 120, 60));
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  paint(painter);
  return image;
}

/// The largest difference of a channel.
int difference(const QImage& a, const QImage& b) {
  int most = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QColor one = a.pixelColor(x, y), other = b.pixelColor(x, y);
      most = std::max({most, std::abs(one.red() - other.red()),
                       std::abs(one.green() - other.green()), std::abs(one.blue() - other.blue())});
    }
  }
  return most;
}

/// Where it is not the ground.
QRect ink(const QImage& image) {
  QRect all;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.pixelColor(x, y) != QColor(90, 120, 60)) all |= QRect(x, y, 1, 1);
    }
  }
  return all;
}

}  // namespace

class TestTheme : public QObject {
  Q_OBJECT
 private slots:
  /// At 50 and 60 % dark text stood on the accent colour.
  void theTextOfAProgressBarIsReadable_data() {
    QTest::addColumn<ThemeChoice>("choice");
    QTest::newRow("light") << ThemeChoice::Light;
    QTest::newRow("dark") << ThemeChoice::Dark;
  }
  void theTextOfAProgressBarIsReadable() {
    QFETCH(ThemeChoice, choice);
    setTheme(*qApp, choice);
    QProgressBar bar;
    bar.resize(300, 24);
    bar.setTextVisible(false);
    bar.setValue(60);
    const QImage filled = bar.grab().toImage();
    const QColor chunk = filled.pixelColor(90, filled.height() / 2);
    const QColor rest = filled.pixelColor(270, filled.height() / 2);
    QVERIFY(chunk != rest);
    const auto luminance = [](const QColor& color) {
      const auto linear = [](double c) {
        return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
      };
      return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
             0.0722 * linear(color.blueF());
    };
    for (const QColor& ground : {chunk, rest}) {
      const double a = luminance(ground), b = luminance(bar.palette().color(QPalette::Text));
      const double contrast = (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
      QVERIFY2(contrast >= 4.5, qPrintable(QString::number(contrast)));
    }
    setTheme(*qApp, ThemeChoice::Dark);
  }

  void aNumberIsNeverCut_data() {
    QTest::addColumn<QString>("text");
    for (const char* text : {"TIMEOUT 4 min 20 s", "D no reply 4 min 20 s", "−1200.00 mm",
                             "penalised 45 s", "Memory holds the last 13:29 (128 MB)",
                             "goal B4 12.5 m/s", "3 of 12 sensors", "×0.12", "waiting for words"}) {
      QTest::newRow(text) << QString::fromUtf8(text);
    }
  }
  void aNumberIsNeverCut() {
    QFETCH(QString, text);
    const QFontMetricsF metrics(themeFont(TypeRole::Body));
    const QString dots = QStringLiteral("…");
    const QStringList words = text.split(QLatin1Char(' '));
    for (double width = 0.0; width <= metrics.horizontalAdvance(text) + 1; width += 1.0) {
      const QString shown = elideText(metrics, text, width);
      const QByteArray reported = (QString::number(width) + QLatin1Char(' ') + shown).toUtf8();
      QVERIFY2(shown == dots || metrics.horizontalAdvance(shown) <= width || shown.isEmpty(),
               reported.constData());
      for (const QString& word : shown.split(QLatin1Char(' '))) {
        const bool digits =
            std::any_of(word.begin(), word.end(), [](QChar c) { return c.isDigit(); });
        QVERIFY2(!digits || words.contains(word), reported.constData());
      }
    }
    QCOMPARE(elideText(metrics, text, metrics.horizontalAdvance(text) + 1), text);
  }

  void textIsShortenedBeforeNumbers() {
    const QFontMetricsF metrics(themeFont(TypeRole::Body));
    const double room = metrics.horizontalAdvance(QStringLiteral("TIM… 4 min 20 s"));
    const QString shown = elideText(metrics, QStringLiteral("TIMEOUT 4 min 20 s"), room);
    QVERIFY2(shown.endsWith(QStringLiteral("… 4 min 20 s")), qPrintable(shown));
    // The painter cuts in the same way.
    const auto painted = [room](const QString& text) {
      QImage image(200, 30, QImage::Format_ARGB32_Premultiplied);
      image.fill(Qt::white);
      QPainter painter(&image);
      painter.setFont(themeFont(TypeRole::Body));
      drawTextLine(painter, QRectF(0, 0, room, 30), Qt::AlignLeft, text, Qt::ElideRight);
      return image;
    };
    QVERIFY(painted(QStringLiteral("TIMEOUT 4 min 20 s")) !=
            painted(QStringLiteral("TIMEOUT 4 min 50 s")));
  }

  void wordsAreNotCut() {
    const QFontMetricsF metrics(themeFont(TypeRole::Body));
    const auto shown = [&metrics](const char* room) {
      return elideText(metrics, QStringLiteral("walk forward, fast"),
                       metrics.horizontalAdvance(QString::fromUtf8(room)));
    };
    // "slow" or "fast" is what tells them apart.
    QCOMPARE(shown("walk forward, f…"), QStringLiteral("…forward, fast"));
    QCOMPARE(shown("…forward, fast"), QStringLiteral("…forward, fast"));
    QVERIFY(shown("walk for…").startsWith(QStringLiteral("walk")));
  }

  void namesLoseTheirPrefixFirst() {
    const QFontMetricsF metrics(themeFont(TypeRole::Body));
    const auto shown = [&](const char* room) {
      return elideName(metrics, QStringLiteral("VISION_BALL_DIST B1"),
                       metrics.horizontalAdvance(QString::fromUtf8(room)));
    };
    QCOMPARE(shown("VISION_BALL_DIST B1"), QStringLiteral("VISION_BALL_DIST B1"));
    QCOMPARE(shown("VISION_BALL_DIST B"), QStringLiteral("BALL_DIST B1"));
    QVERIFY(shown("BALL_DI B1").contains(QStringLiteral("…")));
    // However little room there is, the robot stays.
    for (const char* room : {"BALL_DI B1", "BALL B1", "BAL B1"}) {
      QVERIFY2(shown(room).endsWith(QStringLiteral(" B1")), qPrintable(shown(room)));
      QVERIFY(metrics.horizontalAdvance(shown(room)) <=
              metrics.horizontalAdvance(QString::fromUtf8(room)));
    }
  }

  void figuresKeepTheirNames() {
    const QFontMetricsF metrics(themeFont(TypeRole::Body));
    const QString text = QStringLiteral("X 117 cm, Y 32 cm, THETA 180 °");
    const auto shown = [&](const char* room) {
      return elideText(metrics, text, metrics.horizontalAdvance(QString::fromUtf8(room)));
    };
    QCOMPARE(shown("X 117 cm, Y 32 cm, TH"), QStringLiteral("X 117 cm, Y 32 cm, …"));
    QCOMPARE(shown("X 117 cm, Y 3"), QStringLiteral("X 117 cm, …"));
  }

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

  void boxesAreThoseOfQt_data() {
    QTest::addColumn<QColor>("fill");
    QTest::addColumn<QColor>("edge");
    QTest::addColumn<double>("ratio");
    const QColor blue(40, 60, 200), glass(40, 60, 200, 120), white(Qt::white);
    QTest::newRow("plain") << blue << QColor() << 1.0;
    QTest::newRow("with an edge") << blue << white << 1.0;
    QTest::newRow("translucent") << glass << white << 1.0;
    QTest::newRow("twice as sharp") << blue << white << 2.0;
    QTest::newRow("at an odd scale") << blue << white << 1.5;
  }
  void boxesAreThoseOfQt() {
    QFETCH(QColor, fill);
    QFETCH(QColor, edge);
    QFETCH(double, ratio);
    const QRectF box(12, 9, 120, 30);
    const QImage ours = painted([&](QPainter& p) { drawRoundBox(p, box, 3, fill, edge); }, ratio);
    const QImage qts = painted(
        [&](QPainter& p) {
          p.setBrush(fill);
          p.setPen(edge.isValid() ? QPen(edge, 1) : QPen(Qt::NoPen));
          p.drawRoundedRect(edge.isValid() ? box.adjusted(0.5, 0.5, -0.5, -0.5) : box, 3, 3);
        },
        ratio);
    QVERIFY(difference(ours, painted([](QPainter&) {}, ratio)) > 50);
    QVERIFY2(difference(ours, qts) <= 4, qPrintable(QString::number(difference(ours, qts))));
    // One without room for its corners, and one between pixels.
    painted([&](QPainter& p) { drawRoundBox(p, {3, 3, 4, 2}, 3, fill, edge); }, ratio);
    const QRect between = ink(painted([](QPainter& p) {
      drawRoundBox(p, {12.3, 9, 50, 30}, 3, QColor(40, 60, 200));
    }));
    QCOMPARE(between, QRect(12, 9, 50, 30));
  }

  void textIsWhereQtPutsIt_data() {
    QTest::addColumn<int>("alignment");
    QTest::newRow("left") << int(Qt::AlignLeft | Qt::AlignVCenter);
    QTest::newRow("right") << int(Qt::AlignRight | Qt::AlignVCenter);
    QTest::newRow("middle") << int(Qt::AlignCenter);
    QTest::newRow("top") << int(Qt::AlignHCenter | Qt::AlignTop);
  }
  void textIsWhereQtPutsIt() {
    QFETCH(int, alignment);
    const QRectF box(20, 10, 120, 40);
    const QString words = QStringLiteral("12.4 V");
    for (int round = 0; round < 2; ++round) {  // the second is from what was kept
      const QRect ours =
          ink(painted([&](QPainter& p) { drawTextLine(p, box, Qt::Alignment(alignment), words); }));
      const QRect qts = ink(painted([&](QPainter& p) { p.drawText(box, alignment, words); }));
      QVERIFY(qts.width() > 10);
      for (const int off : {ours.left() - qts.left(), ours.right() - qts.right(),
                            ours.top() - qts.top(), ours.bottom() - qts.bottom()}) {
        QVERIFY2(std::abs(off) <= 1, qPrintable(QString::number(off)));
      }
    }
  }

  void textThatDoesNotFitIsCut() {
    const QRectF narrow(20, 10, 50, 40);
    const QString words = QStringLiteral("walk forward, fast");
    const auto draw = [&](const QFont& font, Qt::TextElideMode elide) {
      return ink(painted([&](QPainter& p) {
        p.setFont(font);
        drawTextLine(p, narrow, Qt::AlignLeft | Qt::AlignVCenter, words, elide);
      }));
    };
    const QFont small = themeFont(TypeRole::Small);
    QFont large = small;
    large.setPixelSize(20);
    QVERIFY(draw(small, Qt::ElideNone).right() > 70);
    QVERIFY(draw(small, Qt::ElideRight).right() <= 70);
    // Of another font other words are kept.
    QVERIFY(draw(large, Qt::ElideRight).height() > draw(small, Qt::ElideRight).height());
    QVERIFY(textLineWidth(large, words) > 1.3 * textLineWidth(small, words));
    QCOMPARE(textLineWidth(small, {}), 0.0);
  }

  void words() {
    QCOMPARE(numberText(-1.236, 2), QString::fromUtf8("−1.24"));
    QCOMPARE(numberText(-0.001, 2), QStringLiteral("0.00"));
    QCOMPARE(clockText(312.9), QStringLiteral("05:12"));
    QCOMPARE(clockText(3671), QStringLiteral("1:01:11"));
    QCOMPARE(clockText(-5.3), QStringLiteral("−00:05"));
    QCOMPARE(clockText(-0.3), QStringLiteral("00:00"));
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

  // An unticked box is told from its ground, in menus and lists too.
  void checkBoxesAreSeen() {
    for (const ThemeChoice choice : {ThemeChoice::Dark, ThemeChoice::Light}) {
      setTheme(*qApp, choice);
      const auto luminance = [](const QColor& color) {
        const auto part = [](double c) {
          return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        };
        return 0.2126 * part(color.redF()) + 0.7152 * part(color.greenF()) +
               0.0722 * part(color.blueF());
      };
      for (const auto element :
           {QStyle::PE_IndicatorCheckBox, QStyle::PE_IndicatorItemViewItemCheck}) {
        QImage drawn(17, 17, QImage::Format_ARGB32);
        drawn.fill(theme().window);
        QPainter painter(&drawn);
        QStyleOptionButton option;
        option.rect = QRect(2, 2, 13, 13);
        option.state = QStyle::State_Enabled | QStyle::State_Off;
        qApp->style()->drawPrimitive(element, &option, &painter);
        painter.end();
        const double ground = luminance(theme().window);
        double best = 1.0;
        for (int x = 0; x < drawn.width(); ++x) {
          const double edge = luminance(drawn.pixelColor(x, 8));
          best = std::max(best, (std::max(edge, ground) + 0.05) / (std::min(edge, ground) + 0.05));
        }
        QVERIFY2(best >= 3.0, qPrintable(QString::number(best)));
      }
    }
  }

  void cellsAndBoxesKeepTheirNumbers() {
    setTheme(*qApp, ThemeChoice::Dark);
    const QString text = QStringLiteral("D no reply 4 min 20 s");
    const auto drawn = [](QWidget& widget, int wide) {
      widget.ensurePolished();
      widget.resize(wide, 24);
      return widget.grab().toImage();
    };
    const int wide = QFontMetrics(qApp->font()).horizontalAdvance(text);
    const auto cell = [&](const QString& shown) {
      QStandardItemModel model(1, 1);
      model.setData(model.index(0, 0), shown);
      QTableView table;
      styleTable(&table);
      table.horizontalHeader()->hide();
      table.setModel(&model);
      return drawn(table, wide - 16);
    };
    const auto box = [&](const QString& shown) {
      QComboBox combo;
      combo.addItem(shown);
      return drawn(combo, wide + 10);
    };
    const auto boxWithIcon = [&](const QString& shown) {
      QComboBox combo;
      combo.addItem(themedIcon(QStringLiteral("media-playback-start")), shown);
      return drawn(combo, wide + 20);
    };
    // What does not fit looks like a shorter text that ends in the whole number.
    const auto endsInTheNumber = [&](const auto& picture) {
      for (double fits = wide - 1.0; fits > 0.0; fits -= 1.0) {
        const QString shorter = elideText(QFontMetricsF(qApp->font()), text, fits);
        if (!shorter.endsWith(QStringLiteral("4 min 20 s"))) return false;
        if (picture(text) == picture(shorter)) return true;
      }
      return false;
    };
    QVERIFY(endsInTheNumber(cell));
    QVERIFY(endsInTheNumber(box));
    QVERIFY(endsInTheNumber(boxWithIcon));
  }

  void aPastMomentIsNotPausedAndTheClockEndsAtZero() {
    link::MatchFrame frame;
    frame.truthKnown = true;
    frame.paused = true;
    frame.snapshot.clockRunning = true;
    QCOMPARE(scoreboardOf(frame).state, QStringLiteral("PAUSED"));
    frame.origin = link::FrameOrigin::Recorded;
    QCOMPARE(scoreboardOf(frame).state, QStringLiteral("PLAYING"));
    frame.game.emplace().clock = -3;
    QCOMPARE(scoreboardOf(frame).clock, QStringLiteral("00:00"));
  }

  void theStateDropsTextBeforeNumbers() {
    link::MatchFrame frame;
    frame.origin = link::FrameOrigin::Simulated;
    frame.paused = true;
    Game& game = frame.game.emplace();
    game.state = PlayState::Playing;
    game.restart.kind = SetPlay::CornerKick;
    game.restart.step = Restart::Step::Placing;
    game.restart.team = 0;
    game.teams[0].number = 1;
    game.countdown.ticks = 8;
    const ScoreboardState board = scoreboardOf(frame);
    QCOMPARE(board.state, QStringLiteral("PLAYING · corner kick 1 · 8 s · paused"));
    const QFontMetricsF metrics(themeFont(TypeRole::Secondary, true));
    QStringList shown;
    for (double width = metrics.horizontalAdvance(board.state) + 1;
         width > metrics.horizontalAdvance(QStringLiteral("PLAYING · 8 s")); width -= 1.0) {
      const QString text = stateText(board, metrics, width);
      QVERIFY(metrics.horizontalAdvance(text) <= width);
      if (shown.isEmpty() || shown.last() != text) shown << text;
    }
    const QStringList wanted{board.state,
                             QStringLiteral("PLAYING · corner kick 1 · 8 s"),
                             QStringLiteral("PLAYING · corner kick · 8 s"),
                             QStringLiteral("corner kick 1 · 8 s"),
                             QStringLiteral("corner kick · 8 s"),
                             QStringLiteral("PLAYING · 8 s")};
    QCOMPARE(shown, wanted);
  }
};

PITCHBOARD_GUI_TEST(TestTheme)

}  // namespace tst_theme

#include "tst_theme.moc"
