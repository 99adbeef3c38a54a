// SPDX-License-Identifier: GPL-3.0-or-later
// A blackboard that another program writes is sampled, and not touched.

#include <QProcess>
#include <QtTest>

#include <sys/shm.h>

#include <fstream>
#include <random>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/live/attached_robots.h>
#include <telemetry/series/series_store.h>

#include "../support/group_facts.h"
#include "../support/segment_keys.h"

namespace tst_board_sampler {

using namespace pitchboard;
using namespace pitchboard::link;
using telemetry::SeriesStore;

namespace {

/// Removes the segment whatever happens.
struct Segment {
  int key = testKeyBase() + 100;
  Segment() { removeSegment(key); }
  ~Segment() { removeSegment(key); }
};

/// One attached blackboard, and its rows.
struct Sampled {
  Sampled(int key, double rate) {
    AttachedBoard board;
    board.key = key;
    board.rate = rate;
    robots.set({board});
  }
  /// With the rows that have come.
  AttachedStatus status() {
    robots.drainRows([this](const auto& group, auto rows) { keeper.take(group, rows); });
    return robots.status().front();
  }
  double newest() {
    status();
    return store->groups() == 0 ? 0.0
                                : store->view(0)->range().value_or(telemetry::TimeRange{}).end;
  }

  const std::chrono::steady_clock::time_point zero = std::chrono::steady_clock::now();
  std::shared_ptr<SeriesStore> store = std::make_shared<SeriesStore>();
  BoardRowKeeper keeper{store};
  AttachedRobots robots{[this] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - zero).count();
  }};
};

}  // namespace

class TestBoardSampler : public QObject {
  Q_OBJECT

 private slots:
  /// An independent program counts a known number of times a second.
  void followsAnotherProgram() {
    const Segment segment;
    QProcess writer;
    writer.start("python3", {PITCHBOARD_TEST_DATA "/blackboard_peer.py",
                             QString::number(segment.key), "count", "i:17", "200"});
    QVERIFY(writer.waitForReadyRead(20'000));

    Sampled sampled(segment.key, 1000.0);
    QTRY_VERIFY_WITH_TIMEOUT(sampled.newest() > 2.0, 30'000);
    const AttachedStatus status = sampled.status();
    const auto& store = sampled.store;
    const auto id = store->find(store->view(0)->info().name, "DECISION_ACTION_A");  // int 17
    QVERIFY(id);
    writer.kill();
    writer.waitForFinished();

    const auto view = store->view(id->group);
    QVERIFY(status.attached && status.problem.empty());
    QCOMPARE(status.samples, std::uint64_t{view->rows()});
    QVERIFY2(status.rate > 10.0 && status.rate < 1010.0, qPrintable(QString::number(status.rate)));
    std::vector<telemetry::Sample> samples;
    view->samples(id->column, {0.0, 1e9}, samples);
    QVERIFY(samples.size() > 100);
    for (std::size_t i = 1; i < samples.size(); ++i) {
      QVERIFY(samples[i].time > samples[i - 1].time && samples[i].value >= samples[i - 1].value);
    }
    const double slope = (samples.back().value - samples.front().value) /
                         (samples.back().time - samples.front().time);
    QVERIFY2(std::abs(slope - 200.0) < 20.0, qPrintable(QString::number(slope)));
    QCOMPARE(attributesOf(view->info()).at("key"), std::to_string(segment.key));
    QCOMPARE(view->info().columns[id->column].labels.at(4), std::string("kick right"));
  }

  void changesNoByte() {
    const Segment segment;
    QVERIFY(SystemVSegments::create(segment.key));
    auto* const bytes = static_cast<unsigned char*>(shmat(shmget(segment.key, 0, 0), nullptr, 0));
    QVERIFY(bytes != reinterpret_cast<void*>(-1));
    std::mt19937 random(1);
    std::vector<unsigned char> before(Blackboard::bytes);
    for (auto& byte : before) byte = static_cast<unsigned char>(random());
    std::ranges::copy(before, bytes);

    Sampled sampled(segment.key, 1000.0);
    QTRY_VERIFY_WITH_TIMEOUT(sampled.status().attached, 20'000);
    // The kernel says so as well: the sampler's mapping cannot be written to.
    char name[32];
    std::snprintf(name, sizeof name, "/SYSV%08x", static_cast<unsigned>(segment.key));
    int readOnly = 0;
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
      if (line.find(name) != std::string::npos && line.find(" r--s ") != std::string::npos)
        ++readOnly;
    }
    QCOMPARE(readOnly, 1);
    QTRY_VERIFY_WITH_TIMEOUT(sampled.status().samples > 100, 20'000);
    sampled.robots.set({});
    QVERIFY(std::ranges::equal(before, std::span(bytes, before.size())));

    // And every word arrived as it is, NaN and all.
    double time = 0.0;
    std::vector<std::uint32_t> words;
    std::vector<double> values;
    QVERIFY(sampled.store->view(0)->rowAt(1e9, time, words, values));
    const auto variables = VariableCatalog::published().variables();
    QCOMPARE(words.size(), variables.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
      const int word = variables[i].index +
                       (variables[i].type == VariableType::Int ? 0 : Blackboard::floatOffset);
      std::uint32_t wanted = 0;
      std::memcpy(&wanted, bytes + 4 * word, 4);
      QCOMPARE(words[i], wanted);
    }
    shmdt(bytes);
  }

  void reportsARemovedSegment() {
    const Segment segment;
    QVERIFY(SystemVSegments::create(segment.key));
    Sampled sampled(segment.key, 500.0);
    QTRY_VERIFY_WITH_TIMEOUT(sampled.status().samples > 0, 20'000);
    QVERIFY(SystemVSegments::remove(segment.key));
    QTRY_VERIFY_WITH_TIMEOUT(!sampled.status().attached, 20'000);
    const AttachedStatus gone = sampled.status();
    QVERIFY(QString::fromStdString(gone.problem).contains(QString::number(segment.key)));
    QTRY_COMPARE_WITH_TIMEOUT(sampled.status().rate, 0.0, 20'000);
    QCOMPARE(sampled.status().samples, gone.samples);

    auto fresh = SystemVSegments::open(segment.key, AttachMode::AttachOrCreate);
    QVERIFY(fresh);
    fresh->write(IntVar{17}, 5);
    const auto& store = sampled.store;
    const auto id = *store->find(store->view(0)->info().name, "DECISION_ACTION_A");
    const auto newest = [&] {
      sampled.status();
      return store->view(id.group)->latest(id.column)->value;
    };
    QTRY_COMPARE_WITH_TIMEOUT(newest(), 5.0, 20'000);
    QVERIFY(sampled.status().attached && sampled.status().problem.empty());
  }

  void refusals() {
    const Segment segment;
    Sampled none(segment.key, 100.0);
    QTRY_VERIFY_WITH_TIMEOUT(!none.status().problem.empty(), 20'000);
    QVERIFY(!SystemVSegments::info(segment.key));  // looking did not create it
    AttachedBoard board;
    for (const double rate : {0.0, -1.0, 1001.0, std::numeric_limits<double>::quiet_NaN()}) {
      board.rate = rate;
      QCOMPARE(validate({board}).error().code, ErrorCode::InvalidArgument);
    }
    QCOMPARE(none.store->groups(), std::size_t{0});
  }
};

PITCHBOARD_TEST(TestBoardSampler)

}  // namespace tst_board_sampler

#include "tst_board_sampler.moc"
