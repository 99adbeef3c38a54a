// SPDX-License-Identifier: GPL-3.0-or-later
// Waits for as many whole seconds as the first argument says in every way that C++ knows, those of
// C among them: see every_wait.h.
#include <chrono>
#include <condition_variable>
#include <future>
#include <iterator>
#include <mutex>
#include <semaphore>
#include <thread>

#include "every_wait.h"

namespace {

std::chrono::seconds waitTime() {
  return std::chrono::seconds(wait_seconds);
}

void bySleepFor() {
  std::this_thread::sleep_for(waitTime());
}
void bySleepUntil() {
  std::this_thread::sleep_until(std::chrono::system_clock::now() + waitTime());
}
void byConditionVariable() {
  std::condition_variable condition;
  std::mutex mutex;
  std::unique_lock lock(mutex);
  condition.wait_for(lock, waitTime(), [] { return false; });
}
void byNotifiedConditionVariable() {
  std::condition_variable condition;
  std::mutex mutex;
  bool set = false;
  std::jthread other([&] {
    std::this_thread::sleep_for(waitTime());
    {
      const std::lock_guard guard(mutex);
      set = true;
    }
    condition.notify_one();
  });
  std::unique_lock lock(mutex);
  condition.wait_for(lock, 10 * waitTime(), [&] { return set; });
}
void byCountingSemaphore() {
  std::counting_semaphore<4> semaphore(0);
  (void)semaphore.try_acquire_for(waitTime());
}
void byFuture() {
  (void)std::promise<int>().get_future().wait_for(waitTime());
}
void byTimedMutex() {
  std::timed_mutex mutex;
  mutex.lock();
  std::jthread([&] { (void)mutex.try_lock_for(waitTime()); }).join();
}

constexpr way cppWays[] = {
    {"sleep_for", bySleepFor},
    {"sleep_until", bySleepUntil},
    {"condition_variable::wait_for", byConditionVariable},
    {"condition_variable::notify_one", byNotifiedConditionVariable},
    {"counting_semaphore::try_acquire_for", byCountingSemaphore},
    {"future::wait_for", byFuture},
    {"timed_mutex::try_lock_for", byTimedMutex},
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  begin_ways(arguments[1], arguments[2]);
  run_ways(c_ways, std::size(c_ways));
  run_ways(cppWays, std::size(cppWays));
  end_ways();
}
