// SPDX-License-Identifier: GPL-3.0-or-later
// A blackboard that another program writes is sampled, and not touched.

#include <QProcess>
#include <QtTest>

#include <sys/shm.h>

#include <fstream>
#include <random>

#include <robotlink/session/board_sampler.h>
#include <telemetry/series/series_store.h>

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

    auto store = std::make_shared<SeriesStore>();
    const auto zero = std::chrono::steady_clock::now();
    auto sampler =
        BoardSampler::start(segment.key, store, {.rate = 1000.0, .group = "peer", .zero = zero},
                            VariableCatalog::published());
    QVERIFY2(sampler, sampler ? "" : sampler.error().message.c_str());
    const auto id = store->find("peer", "DECISION_ACTION_A");  // int 17
    QVERIFY(id);
    QTRY_VERIFY_WITH_TIMEOUT(
        store->view(id->group)->range().value_or(telemetry::TimeRange{}).end > 2.0, 30'000);
    const BoardSamplerStatus status = (*sampler)->status();
    sampler->reset();
    writer.kill();
    writer.waitForFinished();

    const auto view = store->view(id->group);
    QVERIFY(status.attached && status.message.empty());
    QVERIFY(status.samples <= view->rows());
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
    QCOMPARE(view->info().attributes.at("key"), std::to_string(segment.key));
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

    auto store = std::make_shared<SeriesStore>();
    auto sampler =
        BoardSampler::start(segment.key, store, {.rate = 1000.0}, VariableCatalog::published());
    QVERIFY(sampler);
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
    QTRY_VERIFY_WITH_TIMEOUT((*sampler)->status().samples > 100, 20'000);
    QVERIFY(std::ranges::equal(before, std::span(bytes, before.size())));
    const auto group = (*sampler)->group();
    sampler->reset();
    QVERIFY(std::ranges::equal(before, std::span(bytes, before.size())));

    // And every word arrived as it is, NaN and all.
    double time = 0.0;
    std::vector<std::uint32_t> words;
    std::vector<double> values;
    QVERIFY(store->view(group)->rowAt(1e9, time, words, values));
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

  void saysThatTheSegmentIsGone() {
    const Segment segment;
    QVERIFY(SystemVSegments::create(segment.key));
    auto store = std::make_shared<SeriesStore>();
    auto sampler =
        BoardSampler::start(segment.key, store, {.rate = 500.0}, VariableCatalog::published());
    QVERIFY(sampler);
    QTRY_VERIFY_WITH_TIMEOUT((*sampler)->status().samples > 0, 20'000);
    QVERIFY(SystemVSegments::remove(segment.key));
    QTRY_VERIFY_WITH_TIMEOUT(!(*sampler)->status().attached, 20'000);
    const BoardSamplerStatus gone = (*sampler)->status();
    QVERIFY(QString::fromStdString(gone.message).contains(QString::number(segment.key)));
    QTRY_COMPARE_WITH_TIMEOUT((*sampler)->status().rate, 0.0, 20'000);
    QCOMPARE((*sampler)->status().samples, gone.samples);

    auto fresh = SystemVSegments::open(segment.key, AttachMode::AttachOrCreate);
    QVERIFY(fresh);
    fresh->write(IntVar{17}, 5);
    const auto id = *store->find("key " + std::to_string(segment.key), "DECISION_ACTION_A");
    QTRY_COMPARE_WITH_TIMEOUT(store->view(id.group)->latest(id.column)->value, 5.0, 20'000);
    QVERIFY((*sampler)->status().attached && (*sampler)->status().message.empty());
  }

  void refusals() {
    const Segment segment;
    auto store = std::make_shared<SeriesStore>();
    const auto& catalog = VariableCatalog::published();
    const auto none = BoardSampler::start(segment.key, store, {}, catalog);
    QVERIFY(!none && none.error().code == ErrorCode::NotFound);
    QVERIFY(!SystemVSegments::info(segment.key));  // looking did not create it
    for (const double rate : {0.0, -1.0, 1001.0, std::numeric_limits<double>::quiet_NaN()}) {
      const auto wrong = BoardSampler::start(segment.key, store, {.rate = rate}, catalog);
      QVERIFY(!wrong && wrong.error().code == ErrorCode::InvalidArgument);
    }
    QCOMPARE(store->groups(), std::size_t{0});
  }
};

PITCHBOARD_TEST(TestBoardSampler)

}  // namespace tst_board_sampler

#include "tst_board_sampler.moc"
