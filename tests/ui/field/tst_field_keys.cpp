// SPDX-License-Identifier: GPL-3.0-or-later
// Every published key asks for what the published simulator's key does (system.md section 9); and
// what the ruler reads.

#include <QTest>

#include <set>

#include <ui/field/field_keys.h>

#include "overlay_items.h"

namespace tst_field_keys {

using namespace pitchboard::ui;

namespace {

/// The order in words.
QString wordsOf(const FieldOrder& order) {
  constexpr const char* names[] = {"select", "add",    "add by shift", "ball",  "move here",
                                   "action", "search", "load",         "reset", "clear"};
  QString words = QLatin1String(names[static_cast<std::size_t>(order.action)]);
  using enum FieldAction;
  for (const FieldAction counted : {Select, AddRobot, Act, Search}) {
    if (order.action == counted) words += QStringLiteral(" %1").arg(order.value);
  }
  if (order.action == Act) words += QStringLiteral(" %1").arg(order.other);
  return words;
}

struct Expected {
  int key;
  Qt::KeyboardModifiers modifiers;
  QString call;
};

std::vector<Expected> expectations() {
  const auto none = Qt::NoModifier;
  const auto ctrl = Qt::ControlModifier;
  const auto shift = Qt::ShiftModifier;
  std::vector<Expected> all{
      {Qt::Key_A, none, "add 0"},
      {Qt::Key_A, ctrl, "add 1"},
      {Qt::Key_A, Qt::AltModifier, "add 2"},
      {Qt::Key_A, shift, "add by shift"},
      {Qt::Key_B, none, "ball"},
      {Qt::Key_Insert, none, "move here"},
      {Qt::Key_F, none, "action 1 -1"},
      {Qt::Key_K, none, "action 8 10"},
      {Qt::Key_V, none, "action 17 -1"},
      {Qt::Key_R, none, "action 18 -1"},
      {Qt::Key_M, none, "action 6 -1"},
      {Qt::Key_N, none, "action 7 -1"},
      {Qt::Key_E, none, "action 2 -1"},
      {Qt::Key_D, none, "action 3 -1"},
      {Qt::Key_O, none, "action 9 -1"},
      {Qt::Key_Q, none, "action 14 -1"},
      {Qt::Key_L, none, "action 5 -1"},
      {Qt::Key_P, none, "action 4 -1"},
      {Qt::Key_I, none, "action 12 -1"},
      {Qt::Key_J, none, "action 13 -1"},
      {Qt::Key_S, none, "action 11 -1"},
      {Qt::Key_T, none, "action 0 -1"},
      {Qt::Key_Y, none, "search 1"},
      {Qt::Key_Z, none, "search 0"},
      {Qt::Key_F2, none, "load"},
      {Qt::Key_F3, none, "reset"},
      {Qt::Key_F4, none, "clear"},
  };
  for (int i = 0; i <= 6; ++i) {
    all.push_back({Qt::Key_0 + i, ctrl, QStringLiteral("select %1").arg(10 + i)});
  }
  return all;
}

}  // namespace

class TestFieldKeys : public QObject {
  Q_OBJECT
 private slots:
  void everyKeyAsksForItsEffect_data() {
    QTest::addColumn<int>("key");
    QTest::addColumn<Qt::KeyboardModifiers>("modifiers");
    QTest::addColumn<QString>("call");
    for (const Expected& row : expectations()) {
      const QKeySequence shown(QKeyCombination(row.modifiers, static_cast<Qt::Key>(row.key)));
      QTest::newRow(qPrintable(shown.toString())) << row.key << row.modifiers << row.call;
    }
  }
  void everyKeyAsksForItsEffect() {
    QFETCH(int, key);
    QFETCH(Qt::KeyboardModifiers, modifiers);
    QFETCH(QString, call);
    const auto order = fieldOrder(key, modifiers);
    QVERIFY(order);
    QCOMPARE(wordsOf(*order), call);
  }

  void theTableHasNoOtherKeysAndNoneTwice() {
    std::set<std::pair<int, int>> known, found;
    for (const Expected& row : expectations()) known.insert({row.key, row.modifiers.toInt()});
    for (const FieldKey& entry : fieldKeys()) {
      for (int i = 0; i < entry.count; ++i) {
        QVERIFY2(found.insert({entry.key + i, entry.modifiers.toInt()}).second, entry.meaning);
      }
    }
    QVERIFY(known == found);
  }

  void theKeypadCountsAsPlainDigits() {
    const auto plain = fieldOrder(Qt::Key_3, Qt::ControlModifier);
    QVERIFY(plain);
    const auto keypad = fieldOrder(Qt::Key_3, Qt::ControlModifier | Qt::KeypadModifier);
    QVERIFY(keypad);
    QCOMPARE(wordsOf(*keypad), wordsOf(*plain));
    QVERIFY(!fieldOrder(Qt::Key_3, Qt::NoModifier));
  }

  void rulerReadsMetresAndDegrees_data() {
    QTest::addColumn<QPointF>("from");
    QTest::addColumn<QPointF>("to");
    QTest::addColumn<QString>("text");
    QTest::newRow("along x") << QPointF(1, 1) << QPointF(3, 1) << QStringLiteral("2.00 m   0.0°");
    QTest::newRow("3-4-5") << QPointF(0, 0) << QPointF(3, 4) << QStringLiteral("5.00 m   53.1°");
    QTest::newRow("down, real minus")
        << QPointF(0, 2) << QPointF(0, 0.5) << QStringLiteral("1.50 m   −90.0°");
    QTest::newRow("back") << QPointF(0, 0) << QPointF(-1.234, 0)
                          << QStringLiteral("1.23 m   180.0°");
    QTest::newRow("nothing") << QPointF(2, 2) << QPointF(2, 2) << QStringLiteral("0.00 m   0.0°");
    QTest::newRow("no minus zero")
        << QPointF(0, 0) << QPointF(3, -0.001) << QStringLiteral("3.00 m   0.0°");
  }
  void rulerReadsMetresAndDegrees() {
    QFETCH(QPointF, from);
    QFETCH(QPointF, to);
    QFETCH(QString, text);
    QCOMPARE(rulerText(from, to), text);
  }
};

PITCHBOARD_GUI_TEST(TestFieldKeys)

}  // namespace tst_field_keys

#include "tst_field_keys.moc"
