// SPDX-License-Identifier: GPL-3.0-or-later
// What an advisor writes to its blackboard, as the studio reads it.
#include <QtTest>

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <robotlink/frame/advice_view.h>
#include <robotlink/match/match_runner.h>
#include <robotlink/session/recorded_frame.h>

namespace tst_advice_view {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

using Words = std::map<std::string, double, std::less<>>;

std::shared_ptr<const AdviceView> read(const Words& words) {
  return readAdvice(
      [&words](std::size_t variable) -> std::optional<double> {
        const auto found = words.find(adviceVariables()[variable]);
        return found == words.end() ? std::nullopt : std::optional(found->second);
      },
      sim::fieldByName("kid-2020").value());
}

/// A robot that would do as usual (+0.01) or kick hard to the right goal (+0.08).
Words thinking() {
  return {{"ADVISOR_STAMP", 7},
          {"ADVISOR_STATE", 2},
          {"ADVISOR_CHOICE", 1},
          {"ADVISOR_ROLLOUTS", 96},
          {"ADVISOR_CANDIDATES", 3},
          {"ADVISOR_CANDIDATE1", 0},
          {"ADVISOR_CANDIDATE2", 109000300},  // x 900 cm, y 300 cm from the upper left corner
          {"ADVISOR_CANDIDATE3", 309000200},
          {"ADVISOR_VALUE1", 0.01},
          {"ADVISOR_VALUE2", 0.08},
          {"ADVISOR_VALUE3", 0.03},
          {"ADVISOR_VALUE", 0.08},
          {"ADVISOR_GAIN", 0.07}};
}

}  // namespace

class TestAdviceView : public QObject {
  Q_OBJECT
 private slots:
  void candidatesHavePlacesAndValues() {
    const auto advice = read(thinking());
    QVERIFY(advice && advice->isThinking);
    QCOMPARE(advice->choice, AdviceKind::StrongKick);
    QCOMPARE(advice->rollouts, 96);
    QCOMPARE(advice->candidates.size(), std::size_t(3));
    const AdviceCandidate& kick = advice->candidates[1];
    QCOMPARE(kick.kind, AdviceKind::StrongKick);
    QVERIFY(kick.isChosen && !advice->candidates[0].isChosen && !advice->candidates[2].isChosen);
    QVERIFY(std::abs(kick.place.x - 4.5) < 1e-9 && std::abs(kick.place.y) < 1e-9);
    QCOMPARE(kick.value, 0.08);
    QVERIFY(std::abs(advice->candidates[2].place.y - 1.0) < 1e-9);  // y points down there
    QCOMPARE(advice->gain, 0.07);
    QVERIFY(!advice->heat);
    QCOMPARE(adviceText(advice->choice), std::string_view("strong kick"));
  }

  void heatIsUnpackedFromTheLowerLeftCorner() {
    Words words = thinking();
    words["ADVISOR_HEAT01"] = 0x0000'000F;    // lower left cell
    words["ADVISOR_HEAT20"] = -2147483648.0;  // upper right cell, level 8: all words are int32
    const auto advice = read(words);
    QVERIFY(advice && advice->heat);
    QCOMPARE(advice->heat->columns * advice->heat->rows, 160);
    QCOMPARE(advice->heat->cells.size(), std::size_t(160));
    QCOMPARE(advice->heat->cells.front(), 1.0F);
    QVERIFY(std::abs(advice->heat->cells.back() - std::pow(2.0F / 3.0F, 7.0F)) < 1e-6F);
    QCOMPARE(advice->heat->cells[1], 0.0F);
  }

  /// The same words on a blackboard of a match, and in rows of a recording.
  void matchesAndRecordingsShowTheSame() {
    Words words = thinking();
    words["ADVISOR_HEAT01"] = 0xF;
    const auto direct = read(words);
    MatchOptions options;
    options.cognition = Cognition::Inline;
    const auto runner = MatchRunner::start(loadScenario("one-robot").value(), options, true);
    QVERIFY(runner);
    (*runner)->post([&](SimulatedMatch& match) {
      Blackboard& board = *match.blackboard(match.simulation().state().robots[0].id);
      const VariableCatalog map = match.catalog().withExtension();
      for (const auto& [name, value] : words) {
        if (const auto number = map.intVar(name)) {
          board.write(*number, static_cast<int>(value));
        } else {
          board.write(map.floatVar(name).value(), static_cast<float>(value));
        }
      }
      return Changed::Yes;
    });
    QTRY_VERIFY((*runner)->latest()->robots.at(0).advice);
    const auto simulated = (*runner)->latest()->robots.at(0).advice;

    telemetry::GroupInfo group{"B1", {}, {{"robot", "1"}, {"team", "blue"}}};
    std::vector<double> row;
    for (const auto& [name, value] : words) {
      group.columns.emplace_back().name = name;
      row.push_back(value);
    }
    for (const char* place : {"TRUE_X", "TRUE_Y", "BALL_X"}) {
      group.columns.emplace_back().name = place;
      row.push_back(1.0);
    }
    telemetry::SeriesStore store;
    store.append(store.addGroup(group), {1.0, {}, row});
    const auto frame = RecordedFrames().frameAt(store, 1.0);
    QCOMPARE(frame.robots.size(), std::size_t(1));
    for (const auto& advice : {simulated, frame.robots[0].advice}) {
      QVERIFY(advice && advice->isThinking);
      QCOMPARE(advice->choice, direct->choice);
      QCOMPARE(advice->candidates.size(), direct->candidates.size());
      for (std::size_t i = 0; i < direct->candidates.size(); ++i) {
        QCOMPARE(advice->candidates[i].kind, direct->candidates[i].kind);
        QCOMPARE(advice->candidates[i].isChosen, direct->candidates[i].isChosen);
        QVERIFY(std::abs(advice->candidates[i].value - direct->candidates[i].value) < 1e-6);
      }
      QVERIFY(advice->heat && *advice->heat == *direct->heat);
    }
  }

  void withoutAnAdvisorThereIsNone() {
    QVERIFY(!read({}));
    QVERIFY(!readAdvice({}, sim::fieldByName("kid-2020").value()));
    Words words = thinking();
    words["ADVISOR_STATE"] = 0;
    QVERIFY(!read(words));
    words["ADVISOR_STATE"] = 1;
    QVERIFY(read(words) && !read(words)->isThinking);
    words["ADVISOR_STAMP"] = 0;
    QVERIFY(!read(words));
  }

  void nonsenseIsLeftOut() {
    for (const double number :
         {-1.0, 1e9, -1e300, 2147483647.0, std::numeric_limits<double>::quiet_NaN(),
          std::numeric_limits<double>::infinity()}) {
      Words words;
      for (const std::string_view name : adviceVariables()) words[std::string(name)] = number;
      words["ADVISOR_STAMP"] = 1;
      words["ADVISOR_STATE"] = 2;
      const auto advice = read(words);
      QVERIFY(advice);
      QVERIFY(advice->candidates.size() <= mostCandidates);
      QVERIFY(std::isfinite(advice->value) && std::abs(advice->value) <= 1000.0);
      for (const AdviceCandidate& one : advice->candidates) {
        QVERIFY(std::isfinite(one.value) && std::abs(one.place.x) < 200.0);
        QVERIFY(!adviceText(one.kind).empty());
      }
      QVERIFY(adviceText(advice->choice).size() < 20);
    }
  }
};

PITCHBOARD_TEST(TestAdviceView)

}  // namespace tst_advice_view

#include "tst_advice_view.moc"
