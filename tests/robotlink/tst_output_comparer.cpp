// SPDX-License-Identifier: GPL-3.0-or-later
// What counts as a difference: tolerance, codes, a program that acts a little earlier or later.
#include <QtTest>

#include "output_comparer.h"

namespace tst_output_comparer {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

telemetry::ColumnInfo code() {
  telemetry::ColumnInfo column;
  column.name = "ACTION";
  column.type = telemetry::ColumnType::Int32;
  column.kind = telemetry::ColumnKind::Enumeration;
  column.labels = {{2, "turn left"}, {4, "kick right"}, {8, "walk"}};
  return column;
}

telemetry::ColumnInfo length() {
  telemetry::ColumnInfo column;
  column.name = "X";
  column.unit = "cm";
  return column;
}

/// Ten moments a second.
ComparedVariable compared(const telemetry::ColumnInfo& column, const std::vector<double>& recorded,
                          const std::vector<double>& rerun, double slack = 0.0,
                          std::vector<ComparedVariable> unchanged = {}, bool exact = false) {
  OutputComparer comparer(std::span(&column, 1), slack, std::move(unchanged), exact);
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    const ComparedValue value{recorded[i], rerun[i], recorded[i] >= 0.0, recorded[i] == rerun[i]};
    comparer.add(0.1 * static_cast<double>(i), std::span(&value, 1));
  }
  comparer.finish();
  return comparer.variables().front();
}

}  // namespace

class TestOutputComparer : public QObject {
  Q_OBJECT
 private slots:
  void stretchesHaveBeginEndAndSize() {
    const auto found = compared(length(), {5, 5, 5, 5, 5, 5}, {5, 9, 25, 5.5, 5, 8});
    QCOMPARE(found.compared, std::uint64_t(6));
    QCOMPARE(found.unequal, std::uint64_t(4));
    QCOMPARE(found.stretchCount, std::uint64_t(2));  // 0.5 cm is within the tolerance
    QCOMPARE(found.stretches[0].begin, 0.1);
    QVERIFY(std::abs(found.stretches[0].end - 0.3) < 1e-9);
    QCOMPARE(found.stretches[0].largest, 20.0);
    QCOMPARE(found.largest, 20.0);
    QVERIFY(std::abs(found.seconds - 0.2) < 1e-9);
    QCOMPARE(differenceText(found, found.stretches[0]), std::string("9 instead of 5 cm"));
    QCOMPARE(compared(length(), {5, 5}, {5, 5.5}, 0.0, {}, true).stretchCount, std::uint64_t(1));
  }

  void codesAreNamed() {
    const auto found = compared(code(), {2, 2, 8}, {2, 4, 8});
    QCOMPARE(differenceText(found, found.stretches.at(0)),
             std::string("kick right instead of turn left"));
    QCOMPARE(found.largest, 0.0);
    QCOMPARE(valueText(code(), 99), std::string("99"));
  }

  void whatOthersWroteDoesNotCount() {
    const auto found = compared(code(), {2, -1, -1, 2}, {2, 4, 4, 4});
    QCOMPARE(found.compared, std::uint64_t(2));
    QCOMPARE(found.stretchCount, std::uint64_t(1));
    QVERIFY(std::abs(found.stretches[0].begin - 0.3) < 1e-9);
  }

  void aLittleLateIsNoDifference() {
    // The same turn, 0.2 s later.
    const std::vector<double> recorded{8, 8, 2, 2, 2, 2, 8, 8, 8, 8},
        late{8, 8, 8, 8, 2, 2, 2, 2, 8, 8};
    QCOMPARE(compared(code(), recorded, late).stretchCount, std::uint64_t(2));
    QCOMPARE(compared(code(), recorded, late, 0.25).stretchCount, std::uint64_t(0));
    QCOMPARE(compared(code(), recorded, late, 0.15).stretchCount, std::uint64_t(2));
    // A number that changes in between.
    const std::vector<double> rising{0, 10, 20, 30, 40, 50}, behind{0, 0, 12, 24, 33, 50};
    QCOMPARE(compared(length(), rising, behind, 0.15).stretchCount, std::uint64_t(0));
    QVERIFY(compared(length(), rising, {0, 10, 20, 70, 40, 50}, 0.15).stretchCount > 0);
  }

  /// A short kick that one side does not have is a difference, however large the slack is.
  void aMissingKickIsADifference() {
    const std::vector<double> with{8, 8, 8, 4, 8, 8, 8, 8}, without(8, 8.0);
    QCOMPARE(compared(code(), with, without, 0.5).stretchCount, std::uint64_t(1));
    QCOMPARE(compared(code(), without, with, 0.5).stretchCount, std::uint64_t(1));
  }

  void whatDiffersUnchangedIsNotCountedAgain() {
    const std::vector<double> recorded(40, 2.0);
    std::vector<double> rerun = recorded;
    rerun[5] = rerun[30] = 4;
    const auto whole = compared(code(), recorded, rerun);
    QCOMPARE(whole.stretchCount, std::uint64_t(2));
    ComparedVariable known = whole;
    known.stretches.resize(1);
    known.stretchCount = 1;
    const auto rest = compared(code(), recorded, rerun, 0.0, {known});
    QCOMPARE(rest.stretchCount, std::uint64_t(1));
    QCOMPARE(rest.unchangedToo, std::uint64_t(1));
    QVERIFY(std::abs(rest.stretches[0].begin - 3.0) < 1e-9);
  }

  void manyStretchesTakeNoMoreMemory() {
    std::vector<double> recorded, rerun;
    for (int i = 0; i < 5000; ++i) {
      recorded.push_back(2);
      rerun.push_back(i % 2 == 0 ? 2 : 4);
    }
    const auto found = compared(code(), recorded, rerun);
    QCOMPARE(found.stretchCount, std::uint64_t(2500));
    QCOMPARE(found.stretches.size(), ComparedVariable::maxStretches);
  }
};

PITCHBOARD_TEST(TestOutputComparer)

}  // namespace tst_output_comparer

#include "tst_output_comparer.moc"
