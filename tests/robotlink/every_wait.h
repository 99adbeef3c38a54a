// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Every way to wait that C knows, as a table, and what runs such a table: a process for each way,
// all side by side. C and C++. A line each:
//   WAY MONOTONIC REALTIME BOOTTIME GETTIMEOFDAY TIME  BEGAN ENDED  NOW
// seconds that the wait took by five of the program's clocks; the computer's uptime before and
// after it, which no library changes; and the program's CLOCK_MONOTONIC. "ready" stands before
// them, and the waits begin when the file of the second argument is there.

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/sem.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static int wait_seconds = 1;

struct way {
  const char* name;
  void (*wait)(void);
};

static struct timespec relative(void) {
  struct timespec t;
  t.tv_sec = wait_seconds;
  t.tv_nsec = 0;
  return t;
}
static struct timespec absolute(clockid_t clock) {
  struct timespec t;
  clock_gettime(clock, &t);
  t.tv_sec += wait_seconds;
  return t;
}
static struct timeval relative_timeval(void) {
  struct timeval t;
  t.tv_sec = wait_seconds;
  t.tv_usec = 0;
  return t;
}

static void by_sleep(void) {
  sleep((unsigned)wait_seconds);
}
static void by_usleep(void) {
  usleep((useconds_t)wait_seconds * 1000000U);
}
static void by_nanosleep(void) {
  const struct timespec t = relative();
  nanosleep(&t, NULL);
}
static void by_clock_nanosleep(void) {
  const struct timespec t = absolute(CLOCK_MONOTONIC);
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, NULL);
}
static void by_select(void) {
  struct timeval t = relative_timeval();
  select(0, NULL, NULL, NULL, &t);
}
static void by_pselect(void) {
  const struct timespec t = relative();
  pselect(0, NULL, NULL, NULL, &t, NULL);
}
static void by_poll(void) {
  poll(NULL, 0, wait_seconds * 1000);
}
static void by_ppoll(void) {
  const struct timespec t = relative();
  ppoll(NULL, 0, &t, NULL);
}
static void by_epoll_wait(void) {
  struct epoll_event event;
  epoll_wait(epoll_create1(0), &event, 1, wait_seconds * 1000);
}
static void by_sem_timedwait(void) {
  sem_t semaphore;
  sem_init(&semaphore, 0, 0);
  const struct timespec t = absolute(CLOCK_REALTIME);
  sem_timedwait(&semaphore, &t);
}
static void by_sem_clockwait(void) {
  sem_t semaphore;
  sem_init(&semaphore, 0, 0);
  const struct timespec t = absolute(CLOCK_MONOTONIC);
  sem_clockwait(&semaphore, CLOCK_MONOTONIC, &t);
}
static void wait_for_condition(int shared, clockid_t clock) {
  pthread_condattr_t attributes;
  pthread_condattr_init(&attributes);
  pthread_condattr_setclock(&attributes, clock);
  pthread_condattr_setpshared(&attributes, shared);
  pthread_cond_t condition;
  pthread_cond_init(&condition, &attributes);
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
  const struct timespec until = absolute(clock);
  while (pthread_cond_timedwait(&condition, &mutex, &until) == 0) {
  }
}
static void by_cond_timedwait(void) {
  wait_for_condition(0, CLOCK_REALTIME);
}
static void by_cond_timedwait_monotonic(void) {
  wait_for_condition(0, CLOCK_MONOTONIC);
}
static void by_cond_timedwait_shared(void) {
  wait_for_condition(1, CLOCK_REALTIME);
}
static void by_cond_clockwait(void) {
  pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
  const struct timespec until = absolute(CLOCK_MONOTONIC);
  while (pthread_cond_clockwait(&condition, &mutex, CLOCK_MONOTONIC, &until) == 0) {
  }
}
static void by_mutex_timedlock(void) {
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
  const struct timespec t = absolute(CLOCK_REALTIME);
  pthread_mutex_timedlock(&mutex, &t);
}
static void by_sigtimedwait(void) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR2);
  const struct timespec t = relative();
  sigtimedwait(&set, NULL, &t);
}
static void by_semtimedop(void) {
  const int id = semget(IPC_PRIVATE, 1, 0600);
  struct sembuf take = {0, -1, 0};
  const struct timespec t = relative();
  semtimedop(id, &take, 1, &t);
  semctl(id, 0, IPC_RMID);
}
static void by_setitimer(void) {
  const struct itimerval when = {{0, 0}, relative_timeval()};
  setitimer(ITIMER_REAL, &when, NULL);
  pause();
}
static void by_alarm(void) {
  alarm((unsigned)wait_seconds);
  pause();
}
static void by_timer_settime(void) {
  timer_t timer;
  timer_create(CLOCK_MONOTONIC, NULL, &timer);
  const struct itimerspec when = {{0, 0}, relative()};
  timer_settime(timer, 0, &when, NULL);
  pause();
}
static void wait_for_timer(clockid_t clock, struct itimerspec when, int flags, uint64_t times) {
  const int timer = timerfd_create(clock, 0);
  timerfd_settime(timer, flags, &when, NULL);
  uint64_t more = 0;
  for (uint64_t seen = 0; seen < times; seen += more) {
    if (read(timer, &more, sizeof more) != (ssize_t)sizeof more) return;
  }
}
static void by_timerfd_settime(void) {
  const struct itimerspec when = {{0, 0}, absolute(CLOCK_REALTIME)};
  wait_for_timer(CLOCK_REALTIME, when, TFD_TIMER_ABSTIME, 1);
}
static void by_timerfd_interval(void) {
  const int64_t part = (int64_t)wait_seconds * 250000000;
  struct timespec each;
  each.tv_sec = part / 1000000000;
  each.tv_nsec = part % 1000000000;
  const struct itimerspec when = {each, each};
  wait_for_timer(CLOCK_MONOTONIC, when, 0, 4);
}
static void by_socket_timeout(void) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_DGRAM, 0, ends) != 0) return;
  const struct timeval t = relative_timeval();
  setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &t, sizeof t);
  char byte = 0;
  if (recv(ends[0], &byte, 1, 0) >= 0) abort();
}

static const struct way c_ways[] = {
    {"sleep", by_sleep},
    {"usleep", by_usleep},
    {"nanosleep", by_nanosleep},
    {"clock_nanosleep", by_clock_nanosleep},
    {"select", by_select},
    {"pselect", by_pselect},
    {"poll", by_poll},
    {"ppoll", by_ppoll},
    {"epoll_wait", by_epoll_wait},
    {"sem_timedwait", by_sem_timedwait},
    {"sem_clockwait", by_sem_clockwait},
    {"pthread_cond_timedwait", by_cond_timedwait},
    {"pthread_cond_timedwait_monotonic", by_cond_timedwait_monotonic},
    {"pthread_cond_timedwait_shared", by_cond_timedwait_shared},
    {"pthread_cond_clockwait", by_cond_clockwait},
    {"pthread_mutex_timedlock", by_mutex_timedlock},
    {"sigtimedwait", by_sigtimedwait},
    {"semtimedop", by_semtimedop},
    {"setitimer", by_setitimer},
    {"alarm", by_alarm},
    {"timer_settime", by_timer_settime},
    {"timerfd_settime", by_timerfd_settime},
    {"timerfd_interval", by_timerfd_interval},
    {"SO_RCVTIMEO", by_socket_timeout},
};

static double clock_seconds(clockid_t clock) {
  struct timespec t;
  clock_gettime(clock, &t);
  return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}
static double day_seconds(void) {
  struct timeval t;
  gettimeofday(&t, NULL);
  return (double)t.tv_sec + (double)t.tv_usec * 1e-6;
}
static double uptime(void) {
  double seconds = 0.0;
  FILE* file = fopen("/proc/uptime", "r");
  if (file == NULL || fscanf(file, "%lf", &seconds) != 1) abort();
  fclose(file);
  return seconds;
}

static void run_way(const struct way* one) {
  const double began = uptime();
  const double monotonic = clock_seconds(CLOCK_MONOTONIC), real = clock_seconds(CLOCK_REALTIME);
  const double boot = clock_seconds(CLOCK_BOOTTIME), day = day_seconds();
  const time_t whole = time(NULL);
  one->wait();
  const double now = clock_seconds(CLOCK_MONOTONIC);
  char line[400];
  const int length = snprintf(line, sizeof line, "%s %.4f %.4f %.4f %.4f %d %.2f %.2f %.2f\n",
                              one->name, now - monotonic, clock_seconds(CLOCK_REALTIME) - real,
                              clock_seconds(CLOCK_BOOTTIME) - boot, day_seconds() - day,
                              (int)(time(NULL) - whole), began, uptime(), now);
  if (write(1, line, (size_t)length) != length) abort();
}

static void do_nothing(int number) {
  (void)number;
}

static void begin_ways(const char* seconds, const char* go) {
  wait_seconds = atoi(seconds);
  signal(SIGALRM, do_nothing);
  puts("ready");
  fflush(stdout);
  while (access(go, F_OK) != 0) usleep(1000);
}
static void run_ways(const struct way* ways, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (fork() != 0) continue;
    run_way(&ways[i]);
    _exit(0);
  }
}
static void end_ways(void) {
  while (wait(NULL) > 0 || errno == EINTR) {
  }
}
