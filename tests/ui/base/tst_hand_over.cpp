// SPDX-License-Identifier: GPL-3.0-or-later
// What threads hand to the UI thread and what it hands to them: in order, never lost, and dropped
// when nobody is left to take it.

#include <QEventLoop>
#include <QTest>
#include <QThread>
#include <algorithm>
#include <future>
#include <latch>
#include <memory>
#include <thread>
#include <vector>

#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

namespace tst_hand_over {

using namespace pitchboard::ui;

class TestHandOver : public QObject {
  Q_OBJECT

 private slots:
  void callsRunOnTheUiThreadInTheirOrder() {
    UiQueue queue;
    constexpr int each = 500;
    std::vector<std::vector<int>> seen(3);
    int total = 0;
    std::vector<std::jthread> threads;
    for (std::size_t from = 0; from < seen.size(); ++from) {
      threads.emplace_back([&, from] {
        for (int i = 0; i < each; ++i) {
          queue.post([&, from, i] {
            QCOMPARE(QThread::currentThread(), thread());
            seen[from].push_back(i);
            ++total;
          });
        }
      });
    }
    QTRY_COMPARE(total, 3 * each);
    for (const auto& of : seen) {
      QCOMPARE(of.size(), std::size_t{each});
      QVERIFY(std::is_sorted(of.begin(), of.end()));
    }
  }

  void nothingRunsBeforeTheEventLoopDoes() {
    UiQueue queue;
    bool ran = false;
    queue.post([&] { ran = true; });
    QVERIFY(!ran);
    QCoreApplication::processEvents();
    QVERIFY(ran);
  }

  void whatWaitsIsDroppedWithItsReceiver() {
    const auto held = std::make_shared<int>(0);
    {
      UiQueue queue;
      std::jthread([&queue, held] { queue.post([held] { ++*held; }); }).join();
    }
    QCoreApplication::processEvents();
    QCOMPARE(*held, 0);
    QCOMPARE(held.use_count(), 1L);
  }

  void aCallMayEndItsReceiver() {
    auto queue = std::make_unique<UiQueue>();
    int calls = 0;
    queue->post([&] {
      ++calls;
      queue.reset();
    });
    queue->post([&] { ++calls; });
    QCoreApplication::processEvents();
    QVERIFY(!queue);
    QCOMPARE(calls, 1);
  }

  void aCallWithItsOwnEventLoopDelaysNoOtherCall() {
    UiQueue queue;
    std::vector<int> seen;
    queue.post([&] {
      QEventLoop dialog;
      const std::jthread other([&] {
        queue.post([&] {
          seen.push_back(2);
          dialog.quit();
        });
      });
      dialog.exec();
      seen.push_back(3);
    });
    queue.post([&] { seen.push_back(1); });
    QTRY_COMPARE(seen, (std::vector<int>{1, 2, 3}));
  }

  void deliverNeedsNoEventLoop() {
    UiQueue queue;
    std::vector<int> seen;
    queue.post([&] { seen.push_back(1); });
    queue.post([&] { seen.push_back(2); });
    queue.deliver();
    QCOMPARE(seen, (std::vector<int>{1, 2}));
    QCoreApplication::processEvents();
    QCOMPARE(seen.size(), std::size_t{2});
  }

  void oneWorkerKeepsTheOrder() {
    std::vector<int> seen;
    Workers worker;
    for (int i = 0; i < 100; ++i) worker.start([&seen, i] { seen.push_back(i); });
    worker.waitForDone();
    QCOMPARE(seen.size(), std::size_t{100});
    QVERIFY(std::is_sorted(seen.begin(), seen.end()));
  }

  void workersWorkAtTheSameTime() {
    Workers workers(2);
    std::latch both(2);
    for (int i = 0; i < 2; ++i) workers.start([&both] { both.arrive_and_wait(); });
    workers.waitForDone();
    QVERIFY(both.try_wait());
  }

  void onlyIdleThreadsAreTried() {
    std::promise<void> go;
    int calls = 0;
    Workers worker;
    QVERIFY(worker.tryStart([&, wait = go.get_future().share()] {
      wait.wait();
      ++calls;
    }));
    QVERIFY(!worker.tryStart([&] { ++calls; }));
    go.set_value();
    worker.waitForDone();
    QCOMPARE(calls, 1);
    QVERIFY(worker.tryStart([&] { ++calls; }));
    worker.waitForDone();
    QCOMPARE(calls, 2);
  }

  void workersEndWhatWasStarted() {
    int done = 0;
    {
      Workers worker;
      for (int i = 0; i < 50; ++i) worker.start([&done] { ++done; });
    }
    QCOMPARE(done, 50);
  }

  void finishedWorkReleasesItsObjects() {
    const auto held = std::make_shared<int>(0);
    Workers worker;
    worker.start([held] { ++*held; });
    worker.waitForDone();
    QCOMPARE(held.use_count(), 1L);
  }
};

PITCHBOARD_TEST(TestHandOver)

}  // namespace tst_hand_over

#include "tst_hand_over.moc"
