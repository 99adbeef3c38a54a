// SPDX-License-Identifier: GPL-3.0-or-later
// What leaves the series store when its memory is full, and readers and writers on threads of their
// own.

#include <QtTest>

#include <atomic>
#include <thread>

#include <telemetry/series/series_store.h>

#include "series_rows.h"

namespace tst_series_memory {

using namespace pitchboard::telemetry;

class TestSeriesMemory : public QObject {
  Q_OBJECT

 private slots:
  void oldestLeaveFirst() {
    SeriesStore store({.memoryBudget = 400'000});
    const GroupId slow = store.addGroup(group("slow")), fast = store.addGroup(group("fast"));
    Source source(1);
    for (int i = 0; i < 60'000; ++i) {
      const NaiveRow row = source.at(i * 0.01);
      store.append(fast, viewOf(row));
      if (i % 10 == 0) store.append(slow, viewOf(row));
      QVERIFY2(store.memoryBytes() <= 400'000 + 2 * 64 * 60, qPrintable(QString::number(i)));
    }
    const auto a = store.view(slow)->range(), b = store.view(fast)->range();
    QVERIFY(a && b && b->begin > 100.0);
    // A chunk of the slow group is 410 s long and leaves as a whole: not before the rows of the
    // others that are as old as its last one.
    QVERIFY2(a->begin <= b->begin, qPrintable(QString::number(a->begin - b->begin)));
    QCOMPARE(b->end, 59'999 * 0.01);
    const auto held = store.view(fast);
    store.setMemoryBudget(1);
    QVERIFY(store.view(fast)->rows() < 64);
    QVERIFY(store.memoryBytes() < 20'000);
    QVERIFY(held->rows() > 1000);
    QVERIFY(held->statistics(7, {0.0, 600.0}).samples > 1000);  // a view keeps its chunks alive
    store.append(fast, viewOf(source.at(700.0)));
    QCOMPARE(store.view(fast)->latest(0)->time, 700.0);
  }

  /// A row's values all follow from its time, so a reader sees at once when it read something torn.
  void readersBesideTheWriter() {
    SeriesStore store({.memoryBudget = 600'000});
    GroupInfo info{"B1",
                   {{"I", ColumnType::Int32, "", "", ColumnKind::Number, {}},
                    {"SLOW", ColumnType::Int32, "", "", ColumnKind::Number, {}},
                    {"D", ColumnType::Float64, "", "", ColumnKind::Number, {}}},
                   {}};
    const GroupId id = store.addGroup(info);
    std::atomic<bool> stop{false};
    std::atomic<int> wrong{0}, looks{0};
    std::vector<std::thread> readers;
    for (int r = 0; r < 3; ++r) {
      readers.emplace_back([&, r] {
        std::vector<Sample> samples;
        std::vector<SeriesBucket> buckets(50);
        std::vector<std::uint32_t> words;
        std::vector<double> values;
        while (!stop) {
          const auto view = store.view(id);
          const auto range = view->range();
          if (!range) continue;
          view->samples(2, {range->end - 100.0 * r, range->end}, samples);
          for (const Sample& s : samples) wrong += s.value != 2.0 * s.time;
          view->buckets(0, *range, buckets);
          for (const auto& b : buckets) {
            wrong += b.samples > 0 && (b.max - b.min != b.samples - 1 || b.first != b.min);
          }
          wrong += view->statistics(2, *range).samples != view->rows();
          double time = 0.0;
          view->rowAt((range->begin + range->end) / 2, time, words, values);
          wrong += words.at(0) != static_cast<std::uint32_t>(time) || values.at(0) != 2.0 * time;
          wrong += store.find("B1", "D") != SeriesId{id, 2};
          if (r == 0) store.setMemoryBudget(looks % 2 == 0 ? 600'000 : 300'000);
          ++looks;
        }
      });
    }
    double time = 0.0;
    for (int i = 0; i < 200'000 || looks < 50; ++i) {
      const std::uint32_t words[] = {static_cast<std::uint32_t>(time),
                                     static_cast<std::uint32_t>(time) / 500};
      const double values[] = {2.0 * time};
      store.append(id, {time, words, values});
      time += 1.0;
      if (i % 30'000 == 29'999) time -= 700.0;
      if (i % 1'000 == 999) {
        store.addGroup({"G" + std::to_string(i % 7), info.columns, {}});
      }
    }
    stop = true;
    for (auto& reader : readers) reader.join();
    QCOMPARE(wrong.load(), 0);
  }

  /// Each thread has a group of its own; a third one forgets everything now and then.
  void severalWriters() {
    SeriesStore store({.memoryBudget = 500'000});
    std::atomic<bool> stop{false};
    std::vector<std::thread> writers;
    for (int w = 0; w < 2; ++w) {
      writers.emplace_back([&, w] {
        const GroupId id = store.addGroup(group("W" + std::to_string(w)));
        Source source(static_cast<unsigned>(w));
        for (int i = 0; i < 20'000; ++i) store.append(id, viewOf(source.next()));
      });
    }
    std::thread clearer([&] {
      while (!stop) {
        store.clear();
        std::this_thread::yield();
      }
    });
    for (auto& writer : writers) writer.join();
    stop = true;
    clearer.join();
    QCOMPARE(store.groups(), std::size_t{2});
    store.clear();
    QVERIFY(!store.range());
  }
};

PITCHBOARD_TEST(TestSeriesMemory)

}  // namespace tst_series_memory

#include "tst_series_memory.moc"
