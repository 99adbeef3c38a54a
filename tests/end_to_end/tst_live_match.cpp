// SPDX-License-Identifier: GPL-3.0-or-later
// Simulated robots and Live on one computer: an independent program plays a match, whose
// communication processes send telemetry as a team's own would; Live sees all of them where they
// believe they are.
#include <QProcess>
#include <QtTest>

#include <netinet/in.h>
#include <cmath>

#include <robotlink/blackboard/match_number.h>
#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/live/live_watch.h>
#include <simcore/world/published_frame.h>

#include "../support/own_match_number.h"

namespace tst_live_match {

using namespace pitchboard;

class TestLiveMatch : public QObject {
  Q_OBJECT

  const OwnMatchNumber m_own;  // its keys and ports are ours
  const link::MatchNumber m_number = m_own.number();
  const int m_keyBase = m_number.keyBase();

 private slots:
  void cleanup() {
    for (const auto& segment : link::SystemVSegments::list(m_keyBase)) {
      (void)link::SystemVSegments::remove(segment.key);
    }
  }

  void liveSeesAMatchThatAnotherProgramPlays() {
    QProcess match;
    match.start(
        QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli"),
        {QStringLiteral("simulate"), QStringLiteral("--scenario"), QStringLiteral("match-3v3"),
         QStringLiteral("--cognition"), QStringLiteral("external") /* the name up to 0.14 */,
         QStringLiteral("--speed"), QStringLiteral("1"), QStringLiteral("--duration"),
         QStringLiteral("60"), QStringLiteral("--match"), QString::number(m_number.value)});
    QVERIFY(match.waitForStarted());
    link::LiveOptions options;
    options.bind = {INADDR_LOOPBACK};
    options.portBase = m_number.telemetryPortBase();
    options.refereePort = m_number.refereePort();
    options.simulated = true;
    link::LiveWatch live(options);
    QTRY_VERIFY(live.take().frame);
    QTRY_VERIFY_WITH_TIMEOUT(live.take().frame->robots.size() == 6, 30000);
    // Where the telemetry says that a robot believes to be is what stands on its blackboard: robots
    // move on between the message and the look, so a step of a second is allowed. Once is enough:
    // it is asked again behind the waiting.
    int agree = 0;
    bool agreed = false;
    const auto compare = [&] {
      agree = 0;
      const auto frame = live.take().frame;
      for (const link::RobotFrame& robot : frame->robots) {
        const int key = m_keyBase + 100 * robot.key.number;
        const auto board = link::SystemVSegments::open(key, link::AttachMode::ReadOnly);
        if (!board) continue;
        const link::RobotVariables variables;
        const int x = board->read(variables.localizationX);
        const int y = board->read(variables.localizationY);
        const auto reported =
            sim::published_frame::localizationFromStudio(frame->settings->field, robot.pose);
        const double away = std::hypot(x - reported.x, y - reported.y);
        if (away < 60.0 && robot.poseKnown()) ++agree;
      }
      agreed = agreed || agree == 6;
      return agreed;
    };
    QTRY_VERIFY2_WITH_TIMEOUT(compare(), qPrintable(QString::number(agree)), 20000);
    const auto details = live.details();
    QCOMPARE(details.team.errors.messages(), std::uint64_t(0));
    QTRY_VERIFY_WITH_TIMEOUT(live.take().frame->robots[0].link->messages >= 3, 20000);
    QVERIFY(live.take().frame->robots[0].link->rate > 0.3);
    match.terminate();
    QVERIFY(match.waitForFinished(60'000));
  }
};

PITCHBOARD_TEST(TestLiveMatch)

}  // namespace tst_live_match

#include "tst_live_match.moc"
