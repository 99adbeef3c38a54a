// SPDX-License-Identifier: GPL-3.0-or-later
// Waits for as many seconds as the argument says in every way that C and C++ know, one after the
// other. A line each: what it was, and how long it took by two of this program's clocks.
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/sem.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <unistd.h>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <future>
#include <mutex>
#include <semaphore>
#include <thread>
#include <utility>

namespace {

using namespace std::chrono;

seconds waitTime{1};

timespec relative() {
  return {waitTime.count(), 0};
}
timespec absolute(clockid_t clock) {
  timespec t{};
  ::clock_gettime(clock, &t);
  t.tv_sec += waitTime.count();
  return t;
}
int wholeMilliseconds() {
  return static_cast<int>(waitTime.count()) * 1000;
}

void waitForTimer(int descriptor, const itimerspec& when, int flags, std::uint64_t times) {
  ::timerfd_settime(descriptor, flags, &when, nullptr);
  for (std::uint64_t seen = 0, more = 0; seen < times; seen += more) {
    if (::read(descriptor, &more, sizeof more) != sizeof more) return;
  }
  ::close(descriptor);
}

void waitForCondition(bool shared, clockid_t clock) {
  pthread_condattr_t attributes{};
  pthread_condattr_init(&attributes);
  pthread_condattr_setclock(&attributes, clock);
  pthread_condattr_setpshared(&attributes, shared ? 1 : 0);
  pthread_cond_t condition{};
  pthread_cond_init(&condition, &attributes);
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
  const timespec until = absolute(clock);
  while (pthread_cond_timedwait(&condition, &mutex, &until) == 0) {
  }
}

const std::pair<const char*, std::function<void()>> ways[] = {
    {"sleep", [] { ::sleep(static_cast<unsigned>(waitTime.count())); }},
    {"usleep", [] { ::usleep(static_cast<useconds_t>(waitTime.count()) * 1'000'000); }},
    {"nanosleep",
     [] {
       const timespec t = relative();
       ::nanosleep(&t, nullptr);
     }},
    {"clock_nanosleep",
     [] {
       const timespec t = absolute(CLOCK_MONOTONIC);
       ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr);
     }},
    {"sleep_for", [] { std::this_thread::sleep_for(waitTime); }},
    {"sleep_until", [] { std::this_thread::sleep_until(system_clock::now() + waitTime); }},
    {"select",
     [] {
       timeval t{waitTime.count(), 0};
       ::select(0, nullptr, nullptr, nullptr, &t);
     }},
    {"pselect",
     [] {
       const timespec t = relative();
       ::pselect(0, nullptr, nullptr, nullptr, &t, nullptr);
     }},
    {"poll", [] { ::poll(nullptr, 0, wholeMilliseconds()); }},
    {"ppoll",
     [] {
       const timespec t = relative();
       ::ppoll(nullptr, 0, &t, nullptr);
     }},
    {"epoll_wait",
     [] {
       epoll_event event{};
       const int descriptor = ::epoll_create1(0);
       ::epoll_wait(descriptor, &event, 1, wholeMilliseconds());
       ::close(descriptor);
     }},
    {"sem_timedwait",
     [] {
       sem_t semaphore{};
       ::sem_init(&semaphore, 0, 0);
       const timespec t = absolute(CLOCK_REALTIME);
       ::sem_timedwait(&semaphore, &t);
     }},
    {"sem_clockwait",
     [] {
       sem_t semaphore{};
       ::sem_init(&semaphore, 0, 0);
       const timespec t = absolute(CLOCK_MONOTONIC);
       ::sem_clockwait(&semaphore, CLOCK_MONOTONIC, &t);
     }},
    {"pthread_cond_timedwait", [] { waitForCondition(false, CLOCK_REALTIME); }},
    {"pthread_cond_timedwait_monotonic", [] { waitForCondition(false, CLOCK_MONOTONIC); }},
    {"pthread_cond_timedwait_shared", [] { waitForCondition(true, CLOCK_REALTIME); }},
    {"pthread_mutex_timedlock",
     [] {
       pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
       pthread_mutex_lock(&mutex);
       const timespec t = absolute(CLOCK_REALTIME);
       pthread_mutex_timedlock(&mutex, &t);
     }},
    {"condition_variable_wait_for",
     [] {
       std::condition_variable condition;
       std::mutex mutex;
       std::unique_lock lock(mutex);
       condition.wait_for(lock, waitTime, [] { return false; });
     }},
    {"condition_variable_notified",
     [] {
       std::condition_variable condition;
       std::mutex mutex;
       bool set = false;
       std::jthread other([&] {
         std::this_thread::sleep_for(waitTime);
         {
           const std::lock_guard guard(mutex);
           set = true;
         }
         condition.notify_one();
       });
       std::unique_lock lock(mutex);
       condition.wait_for(lock, 10 * waitTime, [&] { return set; });
     }},
    {"counting_semaphore",
     [] {
       std::counting_semaphore<4> semaphore(0);
       (void)semaphore.try_acquire_for(waitTime);
     }},
    {"future", [] { std::promise<int>().get_future().wait_for(waitTime); }},
    {"timed_mutex",
     [] {
       std::timed_mutex mutex;
       mutex.lock();
       std::jthread([&] { (void)mutex.try_lock_for(waitTime); }).join();
     }},
    {"sigtimedwait",
     [] {
       sigset_t set{};
       ::sigemptyset(&set);
       ::sigaddset(&set, SIGUSR2);
       const timespec t = relative();
       ::sigtimedwait(&set, nullptr, &t);
     }},
    {"semtimedop",
     [] {
       const int id = ::semget(IPC_PRIVATE, 1, 0600);
       sembuf take{0, -1, 0};
       const timespec t = relative();
       ::semtimedop(id, &take, 1, &t);
       ::semctl(id, 0, IPC_RMID);
     }},
    {"setitimer",
     [] {
       const itimerval when{{0, 0}, {waitTime.count(), 0}};
       ::setitimer(ITIMER_REAL, &when, nullptr);
       ::pause();
     }},
    {"alarm",
     [] {
       ::alarm(static_cast<unsigned>(waitTime.count()));
       ::pause();
     }},
    {"timer_settime",
     [] {
       timer_t timer{};
       ::timer_create(CLOCK_MONOTONIC, nullptr, &timer);
       const itimerspec when{{0, 0}, relative()};
       ::timer_settime(timer, 0, &when, nullptr);
       ::pause();
       ::timer_delete(timer);
     }},
    {"timerfd_settime",
     [] {
       waitForTimer(::timerfd_create(CLOCK_REALTIME, 0), {{0, 0}, absolute(CLOCK_REALTIME)},
                    TFD_TIMER_ABSTIME, 1);
     }},
    {"timerfd_interval",
     [] {
       const nanoseconds part = nanoseconds(waitTime) / 4;
       const timespec each{part.count() / 1'000'000'000, part.count() % 1'000'000'000};
       waitForTimer(::timerfd_create(CLOCK_MONOTONIC, 0), {each, each}, 0, 4);
     }},
    {"SO_RCVTIMEO",
     [] {
       int ends[2]{};
       ::socketpair(AF_UNIX, SOCK_DGRAM, 0, ends);
       const timeval t{waitTime.count(), 0};
       ::setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &t, sizeof t);
       char byte = 0;
       (void)!::recv(ends[0], &byte, 1, 0);
     }},
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  waitTime = seconds(std::atoi(arguments[1]));
  std::signal(SIGALRM, [](int) {});
  for (const auto& [name, wait] : ways) {
    const auto began = steady_clock::now();
    const auto beganWall = system_clock::now();
    wait();
    const microseconds passed = duration_cast<microseconds>(steady_clock::now() - began);
    const microseconds passedWall = duration_cast<microseconds>(system_clock::now() - beganWall);
    std::printf("%s %.3f %.3f\n", name, static_cast<double>(passed.count()) * 1e-6,
                static_cast<double>(passedWall.count()) * 1e-6);
    std::fflush(stdout);
  }
}
