// SPDX-License-Identifier: GPL-3.0-or-later
// Particles and paths on their way to a display: the datagrams, and matches with inline and with
// separate processes.
#include <robotlink/match/match_runner.h>
#include <simcore/world/field_text.h>

#include <QtTest>
#include <cmath>

#include "../support/segment_keys.h"

namespace tst_cognition_debug {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

CognitionDebug example() {
  auto cloud = std::make_shared<ParticleCloud>();
  cloud->count = 2000;
  cloud->pose = {{1.25, -2.5}, 0.75};
  cloud->sigma = 0.125;
  for (int i = 0; i < 500; ++i) cloud->particles.push_back({{i / 1000.0, -1.0}, -3.0, 0.002});
  auto path = std::make_shared<PlannedPath>();
  path->points = {{0, 0}, {1, 0.5}, {-4.5, 3}};
  path->complete = false;
  return {RobotId{7}, cloud, path, 0, 0};
}

Scenario match(int robots) {
  Scenario scenario = loadScenario("match-3v3").value();
  scenario.robots.resize(static_cast<std::size_t>(robots));
  return scenario;
}

const CognitionDebug* of(const MatchFrame& frame, int robot) {
  const RobotFrame* one = frame.robot(RobotId{robot});
  return one && one->cognitionDebug ? &*one->cognitionDebug : nullptr;
}

}  // namespace

class TestCognitionDebug : public QObject {
  Q_OBJECT
  const int m_base = testKeyBase();

  MatchOptions separateProcesses(int team, bool cognitionDebug) const {
    MatchOptions options;
    options.cognition = Cognition::Separate;
    options.keyBase = m_base;
    options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    options.process.team = team;
    options.cognitionDebug = cognitionDebug;
    return options;
  }

 private slots:
  void cleanup() {
    for (const int n : {1, 2, 3, 4, 5, 6}) removeSegment(m_base + 100 * n);
  }

  void thereAndBack() {
    const CognitionDebug reported = example();
    const std::vector<std::string> datagrams = debugDatagrams(reported);
    QCOMPARE(datagrams.size(), std::size_t{2});
    QVERIFY(datagrams[0].size() < 20'000);
    CognitionDebug received;
    for (const std::string& datagram : datagrams) QVERIFY(readDebugDatagram(datagram, received));
    QCOMPARE(received.robot, reported.robot);
    QVERIFY(*received.cloud == *reported.cloud);
    QVERIFY(*received.path == *reported.path);
  }

  void strangeNumbersDoNoHarm() {
    CognitionDebug reported;
    reported.robot = {1};
    auto cloud = std::make_shared<ParticleCloud>();
    cloud->particles.resize(2000, {{std::nan(""), 1e300}, INFINITY, -5});
    cloud->sigma = 1e300;
    reported.cloud = cloud;
    CognitionDebug received;
    QVERIFY(readDebugDatagram(debugDatagrams(reported).front(), received));
    QCOMPARE(received.cloud->particles.size(), ParticleCloud::most);
    QVERIFY(std::isfinite(received.cloud->particles[0].position.y));
  }

  void badDatagrams_data() {
    QTest::addColumn<QByteArray>("datagram");
    for (const char* text : {"",
                             "PBT1",
                             "PBT1 cloud",
                             "PBT1 cloud 1",
                             "PBT1 cloud 1 5 0 0 0",
                             "PBT1 cloud 0 5 0 0 0 0",
                             "PBT1 cloud 65 5 0 0 0 0",
                             "PBT1 cloud 1 5 0 0 0 0 1",
                             "PBT1 cloud 1 5 0 0 0 -3",
                             "PBT1 cloud 1 5 0 0 0 0 ",
                             "PBT1 cloud 1 5 x 0 0 0",
                             "PBT1 cloud 1 5 99999999999999999999 0 0 0",
                             "PBT1 cloudy 1 5 0 0 0 0",
                             "PBT1 path",
                             "PBT1 path 1",
                             "PBT1 path 1 2",
                             "PBT1 path 1 1 5",
                             "PBT1 path 1 1 5 nan",
                             "PBT1 path 1 1  5 5",
                             "1 PB1 1 0 0 0 0 0 0 -1",
                             "pBT1 path 1 1"}) {
      QTest::addRow("%s", text) << QByteArray(text);
    }
    QByteArray flood = "PBT1 path 1 1";
    for (int i = 0; i < 1000; ++i) flood += " 1 1";
    QTest::newRow("too many points") << flood;
  }
  void badDatagrams() {
    QFETCH(QByteArray, datagram);
    CognitionDebug cognitionDebug;
    QVERIFY(!readDebugDatagram(datagram.toStdString(), cognitionDebug));
    QVERIFY(!cognitionDebug.cloud && !cognitionDebug.path);
  }

  void overTheLoopbackDevice() {
    using namespace std::chrono_literals;
    auto receiver = CognitionDebugReceiver::listen().value();
    auto sender = CognitionDebugSender::to(receiver.port()).value();
    const auto now = std::chrono::steady_clock::now();
    sender.send(example());
    CognitionDebug other = example();
    other.robot = {2};
    other.path.reset();
    sender.send(other);
    receiver.poll(now);
    auto all = receiver.cognitionDebug(now + 500ms);
    QCOMPARE(all.size(), std::size_t{2});
    QCOMPARE(all[0].robot, RobotId{2});
    QVERIFY(all[0].cloud && !all[0].path);
    QVERIFY(*all[1].path == *example().path);
    QCOMPARE(all[1].pathAge, 0.5);
    QVERIFY(receiver.cognitionDebug(now + 4s).empty());  // silent for too long
    QCOMPARE(receiver.strange(), std::uint64_t{0});
  }

  void refusals() {
    QVERIFY(!CognitionDebugSender::to(0));
    QVERIFY(!CognitionDebugSender::to(65536));
    QVERIFY(!CognitionDebugReceiver::listen(70000));
    auto first = CognitionDebugReceiver::listen().value();
    QVERIFY(!CognitionDebugReceiver::listen(first.port()));
  }

  void inlineProcessesSendDebugData() {
    MatchOptions options;
    options.process.particles = 2000;
    QVERIFY(SimulatedMatch::create(match(6), options).value().cognitionDebug().empty());  // nobody
                                                                                          // asked
    options.cognitionDebug = true;
    auto played = SimulatedMatch::create(match(6), options).value();
    double longest = 0;
    for (int i = 0; i < 60 * 40; ++i) {
      played.tick();
      if (i % 60 != 0) continue;
      for (const CognitionDebug& one : played.cognitionDebug()) {
        if (one.path && one.path->points.size() > 1) {
          const Point a = one.path->points.front(), b = one.path->points.back();
          longest = std::max(longest, distance(a, b));
        }
      }
    }
    const auto all = played.cognitionDebug();
    QCOMPARE(all.size(), std::size_t{6});
    QVERIFY(longest > 0.5);
    for (const CognitionDebug& one : all) {
      QVERIFY(one.cloud && one.path);
      QVERIFY(one.cloud->particles.size() <= ParticleCloud::most);
      QVERIFY(one.cloud->count >= 200);
      double sum = 0;
      for (const Particle& particle : one.cloud->particles) sum += particle.weight;
      QVERIFY(std::abs(sum - 1.0) < 1e-9);
      // By now it knows where it stands: belief, and the path's beginning, in the studio's frame
      // for both sides.
      const Pose truth = played.simulation().robotPose(one.robot).value();
      QVERIFY(std::hypot(one.cloud->pose.position.x - truth.position.x,
                         one.cloud->pose.position.y - truth.position.y) < 0.6);
      if (!one.path->points.empty()) {
        const Point start = one.path->points.front();
        QVERIFY(distance(start, truth.position) < 0.7);
      }
    }
  }

  void askingChangesNothing() {
    const auto hash = [](bool asked) {
      MatchOptions options;
      options.cognitionDebug = asked;
      auto played = SimulatedMatch::create(match(6), options).value();
      for (int i = 0; i < 60 * 20; ++i) {
        played.tick();
        (void)played.cognitionDebug();
      }
      return played.simulation().hash();
    };
    QCOMPARE(hash(true), hash(false));
  }

  void separateProcessesKnowACustomField() {
    Scenario scenario = match(1);
    scenario.settings.field.name = "park";
    scenario.settings.field.length = 40.0;
    scenario.settings.field.width = 20.0;
    const auto again = sim::fieldFromText(sim::fieldToText(scenario.settings.field), "test");
    QVERIFY(again && *again == scenario.settings.field);
    const MatchOptions options = separateProcesses(82, true);
    auto runner = MatchRunner::start(scenario, options).value();
    const auto farthest = [&] {
      double most = 0;
      const auto frame = runner->latest();
      const CognitionDebug* first = frame ? of(*frame, 1) : nullptr;
      if (!first || !first->cloud) return most;
      for (const Particle& p : first->cloud->particles)
        most = std::max(most, std::abs(p.position.x));
      return most;
    };
    // It starts anywhere on the field, so some particle lies far outside a field of 9 metres.
    QTRY_VERIFY_WITH_TIMEOUT(farthest() > 10.0, 20000);
    QVERIFY(farthest() < 25.0);
  }

  void separateProcessesSendDebugData_data() {
    QTest::addColumn<bool>("asked");
    QTest::newRow("asked") << true;
    QTest::newRow("not asked") << false;
  }
  void separateProcessesSendDebugData() {
    QFETCH(bool, asked);
    const MatchOptions options = separateProcesses(80, asked);
    auto runner = MatchRunner::start(match(2), options).value();
    if (!asked) {
      QTRY_VERIFY(runner->latest() && !runner->latest()->robots.empty() &&
                  runner->latest()->robots[0].lamps[3].state == telemetry::HeartbeatState::Working);
      QVERIFY(!runner->latest()->robots[0].cognitionDebug &&
              !runner->latest()->robots[1].cognitionDebug);
      return;
    }
    const auto complete = [&] {
      const auto frame = runner->latest();
      const CognitionDebug* first = frame ? of(*frame, 1) : nullptr;
      const CognitionDebug* second = frame ? of(*frame, 2) : nullptr;
      return first && first->cloud && first->path && second && second->cloud && second->path;
    };
    QTRY_VERIFY_WITH_TIMEOUT(complete(), 20000);
    // A filter that has seen nothing yet has no particles.
    const auto spread = [&] { return of(*runner->latest(), 1)->cloud->particles.size() > 100; };
    QTRY_VERIFY_WITH_TIMEOUT(spread(), 20000);
    QVERIFY(of(*runner->latest(), 1)->cloudAge < 1.0);
  }
};

PITCHBOARD_TEST(TestCognitionDebug)

}  // namespace tst_cognition_debug

#include "tst_cognition_debug.moc"
