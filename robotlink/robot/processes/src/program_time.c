// SPDX-License-Identifier: GPL-3.0-or-later
/* Loaded into a team's program by LD_PRELOAD: makes its clocks and waits follow the match.
 *
 * Reading a clock adds what the page says. A wait becomes a wait for as long as it takes at the
 * present rate. When the page changes, a thread of this library, the keeper, sets the kernel's
 * timers again and interrupts the waits, which go on with what is left at the new rate: threads by
 * a signal, condition variables by a broadcast. Calls that neither of them interrupts wait in
 * slices. The keeper is started with the first wait and sleeps otherwise.
 *
 * At a rate of 1 a call is made with the time that it was given. Without a page every call goes
 * straight through. Thread-safe.
 *
 * The functions have the names, types and errors of their manual pages, sections 2 and 3. */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/futex.h>
#include <mqueue.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/mman.h>
#include <sys/select.h>
#include <sys/sem.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <sys/uio.h>
#include <threads.h>
#include <time.h>
#include <unistd.h>

#include "time_page.h"

#define EXPORT __attribute__((visibility("default")))

typedef int64_t nanoseconds;
static const nanoseconds second = 1000000000;
static const nanoseconds slice = 20000000; /* of a wait that cannot be interrupted */
static const nanoseconds longest_wait =
    1000000000; /* of one that can, if the program blocks our signal */
static const nanoseconds forever = INT64_MAX;

/* ---- The C library's own functions --------------------------------------------------------------
 */

/* REAL(name) is the C library's function of this name. It is looked up once; looking it up twice at
 * the same time does no harm. */
static void* find(void* _Atomic* place, const char* name) {
  void* function = atomic_load_explicit(place, memory_order_acquire);
  if (function == NULL) {
    function = dlvsym(RTLD_NEXT, name, "GLIBC_2.3.2"); /* x86-64 has older pthread_cond_* besides */
    if (function == NULL) function = dlsym(RTLD_NEXT, name);
    atomic_store_explicit(place, function, memory_order_release);
  }
  return function;
}
#define REAL(name)                                     \
  (__extension__({                                     \
    static void* _Atomic place;                        \
    (__typeof__(&name))(uintptr_t)find(&place, #name); \
  }))

/* ---- The match's time ---------------------------------------------------------------------------
 */

/* A child of vfork() shares this memory; what it closes stays open here. */
static _Atomic pid_t own_process;
static bool is_own_process(void) {
  return atomic_load_explicit(&own_process, memory_order_relaxed) == getpid();
}

static const struct pitchboard_time_page* _Atomic page;

struct reading {
  nanoseconds since, offset;
  double rate;
};

static struct reading read_page(const struct pitchboard_time_page* p) {
  struct reading r;
  uint32_t before, after;
  do {
    before = __atomic_load_n(&p->sequence, __ATOMIC_ACQUIRE);
    r.since = __atomic_load_n(&p->since, __ATOMIC_RELAXED);
    r.offset = __atomic_load_n(&p->offset, __ATOMIC_RELAXED);
    __atomic_load(&p->rate, &r.rate, __ATOMIC_RELAXED);
    __atomic_thread_fence(__ATOMIC_ACQUIRE);
    after = __atomic_load_n(&p->sequence, __ATOMIC_RELAXED);
  } while (before != after || before % 2 != 0);
  return r;
}

__attribute__((constructor)) static void open_page(void) {
  atomic_store(&own_process, getpid());
  const char* file = getenv(PITCHBOARD_TIME_VARIABLE);
  if (file == NULL || *file == '\0') return;
  const int fd = open(file, O_RDONLY | O_CLOEXEC);
  if (fd < 0) return;
  struct stat info;
  if (fstat(fd, &info) == 0 && info.st_size >= (off_t)sizeof(struct pitchboard_time_page)) {
    void* memory = mmap(NULL, sizeof(struct pitchboard_time_page), PROT_READ, MAP_SHARED, fd, 0);
    if (memory != MAP_FAILED) atomic_store(&page, memory);
  }
  REAL(close)(fd);
}

static bool follows(void) {
  return atomic_load_explicit(&page, memory_order_relaxed) != NULL;
}

static nanoseconds from_timespec(const struct timespec* t) {
  if (t->tv_sec >= INT64_MAX / second - 1) return forever;
  return (nanoseconds)t->tv_sec * second + t->tv_nsec;
}
static struct timespec to_timespec(nanoseconds t) {
  struct timespec result = {t / second, t % second};
  if (result.tv_nsec < 0) {
    result.tv_nsec += second;
    --result.tv_sec;
  }
  return result;
}
static nanoseconds from_timeval(const struct timeval* t) {
  if (t->tv_sec >= INT64_MAX / second - 1) return forever;
  return (nanoseconds)t->tv_sec * second + (nanoseconds)t->tv_usec * 1000;
}
static struct timeval to_timeval(nanoseconds t) {
  const struct timespec s = to_timespec(t);
  return (struct timeval){s.tv_sec, s.tv_nsec / 1000};
}
static bool is_valid(const struct timespec* t) {
  return t->tv_sec >= 0 && t->tv_nsec >= 0 && t->tv_nsec < second;
}

static nanoseconds real_time(clockid_t clock) {
  struct timespec t;
  REAL(clock_gettime)(clock, &t);
  return from_timespec(&t);
}

/* How far the program's clocks are ahead of the computer's. */
static nanoseconds shift_of(const struct reading* r) {
  if (r->rate == 1.0) return r->offset;
  const nanoseconds passed = real_time(CLOCK_MONOTONIC) - r->since;
  return r->offset + (nanoseconds)((double)passed * (r->rate - 1.0));
}
static nanoseconds shift(void) {
  const struct pitchboard_time_page* p = atomic_load_explicit(&page, memory_order_relaxed);
  if (p == NULL) return 0;
  const struct reading r = read_page(p);
  return shift_of(&r);
}
static double rate(void) {
  const struct pitchboard_time_page* p = atomic_load_explicit(&page, memory_order_relaxed);
  return p == NULL ? 1.0 : read_page(p).rate;
}

/* Clocks of the processor's time stay as they are. */
static bool is_shifted(clockid_t clock) {
  switch (clock) {
    case CLOCK_REALTIME:
    case CLOCK_REALTIME_COARSE:
    case CLOCK_REALTIME_ALARM:
    case CLOCK_TAI:
    case CLOCK_MONOTONIC:
    case CLOCK_MONOTONIC_COARSE:
    case CLOCK_MONOTONIC_RAW:
    case CLOCK_BOOTTIME:
    case CLOCK_BOOTTIME_ALARM:
      return true;
    default:
      return false;
  }
}

static nanoseconds match_time(clockid_t clock) {
  return real_time(clock) + shift();
}

/* ---- Waits --------------------------------------------------------------------------------------
 */

static uint32_t page_sequence(void) {
  const struct pitchboard_time_page* p = atomic_load_explicit(&page, memory_order_relaxed);
  return p == NULL ? 0 : __atomic_load_n(&p->sequence, __ATOMIC_SEQ_CST);
}

/* A thread that waits, for the keeper. `sequence` is that of the page that its wait follows. */
struct waiter {
  _Atomic pid_t thread; /* 0: free */
  _Atomic uint32_t sequence;
  pthread_cond_t* cond; /* or null; waiters_lock */
};
enum { most_waiters = 256 };
static struct waiter waiters[most_waiters];
static pthread_mutex_t waiters_lock = PTHREAD_MUTEX_INITIALIZER;

static bool start_keeper(void);

static struct waiter* register_waiter(void) {
  if (!start_keeper()) return NULL;
  const pid_t thread = (pid_t)REAL(syscall)(SYS_gettid);
  for (int i = 0; i < most_waiters; ++i) {
    pid_t nobody = 0;
    if (atomic_compare_exchange_strong(&waiters[i].thread, &nobody, thread)) return &waiters[i];
  }
  return NULL;
}

/* A wait until a moment of the program's own CLOCK_MONOTONIC. */
struct wait {
  nanoseconds deadline;  /* `forever`: none */
  struct waiter* waiter; /* null: it cannot be interrupted */
  nanoseconds longest;   /* a part of it, in the computer's time */
  uint32_t sequence;
  nanoseconds real; /* what the last part of it asked for, in the computer's time; 0: it is over */
};

static struct wait sliced_wait(nanoseconds duration) {
  struct wait w = {forever, NULL, slice, 0, 0};
  if (duration != forever) {
    const nanoseconds now = match_time(CLOCK_MONOTONIC);
    w.deadline = duration < 0 ? now : duration > forever - now ? forever : now + duration;
  }
  return w;
}
static struct wait wait_for(nanoseconds duration) {
  struct wait w = sliced_wait(duration);
  w.waiter = register_waiter();
  if (w.waiter != NULL) w.longest = longest_wait;
  return w;
}
/* How far away a moment of one of its clocks is. */
static nanoseconds until(clockid_t clock, const struct timespec* at) {
  const nanoseconds moment = from_timespec(at);
  return moment == forever ? forever : moment - match_time(clock);
}
static nanoseconds left_of(const struct wait* w) {
  if (w->deadline == forever) return forever;
  const nanoseconds left = w->deadline - match_time(CLOCK_MONOTONIC);
  return left > 0 ? left : 0;
}
/* The keeper's signal came to this thread in this part of its wait. The keeper may send it more
 * than once, and the one that is left over would look like a signal of the program. */
static _Thread_local volatile sig_atomic_t is_woken;
static void note_wake(int signal) {
  (void)signal;
  is_woken = 1;
}
/* For how long to wait now, in the computer's time: 0 when the wait is over. */
static nanoseconds next_part(struct wait* w) {
  is_woken = 0;
  w->sequence = page_sequence();
  if (w->waiter != NULL) atomic_store(&w->waiter->sequence, w->sequence);
  const nanoseconds left = left_of(w), most = w->longest;
  const double speed = rate();
  if (left == 0) return w->real = 0;
  if (speed <= 0.0 || left == forever || (double)left / speed >= (double)most)
    return w->real = most;
  return w->real = speed == 1.0 ? left : (nanoseconds)((double)left / speed) + 1;
}
/* After a part of the wait: whether there is another one. A process that was stopped in a pause has
 * some calls interrupted when it goes on. */
static bool goes_on(const struct wait* w, bool timed_out, bool interrupted) {
  return timed_out ? w->real > 0
                   : interrupted && (is_woken || page_sequence() != w->sequence || rate() <= 0.0);
}
static void end_wait(struct wait* w) {
  if (w->waiter != NULL) atomic_store(&w->waiter->thread, 0);
}
static struct timespec from_now(clockid_t clock, nanoseconds duration) {
  return to_timespec(real_time(clock) + duration);
}

/* Returns what `call` gives, which is made with one `part` of the wait after the other. */
#define RETURN_WAIT(type, start, time_of_part, call, timed_out, interrupted) \
  do {                                                                       \
    struct wait w = start;                                                   \
    type result;                                                             \
    do {                                                                     \
      const struct timespec part = time_of_part;                             \
      result = call;                                                         \
    } while (goes_on(&w, timed_out, interrupted));                           \
    end_wait(&w);                                                            \
    return result;                                                           \
  } while (0)
/* The same for calls that tell errors by errno. */
#define RETURN_ERRNO_WAIT(type, start, time_of_part, call, when_timed_out)            \
  RETURN_WAIT(type, start, time_of_part, call, result < 0 && errno == when_timed_out, \
              result < 0 && errno == EINTR)

/* ---- Clocks -------------------------------------------------------------------------------------
 */

EXPORT int clock_gettime(clockid_t clock, struct timespec* t) {
  const int result = REAL(clock_gettime)(clock, t);
  if (result != 0 || !follows() || !is_shifted(clock)) return result;
  const nanoseconds by = shift();
  if (by != 0) *t = to_timespec(from_timespec(t) + by);
  return 0;
}

EXPORT int gettimeofday(struct timeval* restrict t, void* restrict zone) {
  const int result = REAL(gettimeofday)(t, zone);
  if (result == 0 && follows()) {
    const nanoseconds by = shift();
    if (by != 0) *t = to_timeval(from_timeval(t) + by);
  }
  return result;
}

EXPORT time_t time(time_t* result) {
  if (!follows()) return REAL(time)(result);
  struct timespec now;
  clock_gettime(CLOCK_REALTIME_COARSE, &now);
  if (result != NULL) *result = now.tv_sec;
  return now.tv_sec;
}

EXPORT int timespec_get(struct timespec* t, int base) {
  const int result = REAL(timespec_get)(t, base);
  if (result == TIME_UTC && follows()) clock_gettime(CLOCK_REALTIME, t);
  return result;
}

/* ---- Sleeping -----------------------------------------------------------------------------------
 */

EXPORT int clock_nanosleep(clockid_t clock, int flags, const struct timespec* t,
                           struct timespec* left) {
  if (!follows() || !is_shifted(clock) || t == NULL || !is_valid(t)) {
    return REAL(clock_nanosleep)(clock, flags, t, left);
  }
  const bool absolute = (flags & TIMER_ABSTIME) != 0;
  struct wait w = wait_for(absolute ? until(clock, t) : from_timespec(t));
  int error = 0;
  do {
    const struct timespec part = to_timespec(next_part(&w));
    error = w.real > 0 ? REAL(clock_nanosleep)(CLOCK_MONOTONIC, 0, &part, NULL) : 0;
  } while (goes_on(&w, error == 0, error == EINTR));
  end_wait(&w);
  if (error == EINTR && !absolute && left != NULL) *left = to_timespec(left_of(&w));
  return error;
}

EXPORT int nanosleep(const struct timespec* t, struct timespec* left) {
  if (!follows() || t == NULL || !is_valid(t)) return REAL(nanosleep)(t, left);
  const int error = clock_nanosleep(CLOCK_MONOTONIC, 0, t, left);
  if (error == 0) return 0;
  errno = error;
  return -1;
}

EXPORT unsigned sleep(unsigned seconds) {
  if (!follows()) return REAL(sleep)(seconds);
  struct timespec t = {seconds, 0};
  return nanosleep(&t, &t) == 0 ? 0 : (unsigned)(t.tv_sec + (t.tv_nsec >= second / 2));
}

EXPORT int usleep(useconds_t microseconds) {
  if (!follows()) return REAL(usleep)(microseconds);
  const struct timespec t = to_timespec((nanoseconds)microseconds * 1000);
  return nanosleep(&t, NULL);
}

EXPORT int thrd_sleep(const struct timespec* t, struct timespec* left) {
  if (!follows() || t == NULL || !is_valid(t)) return REAL(thrd_sleep)(t, left);
  const int error = clock_nanosleep(CLOCK_MONOTONIC, 0, t, left);
  return error == 0 ? 0 : error == EINTR ? -1 : -2;
}

/* ---- Waiting for file descriptors ---------------------------------------------------------------
 */

static int poll_for(struct pollfd* fds, nfds_t count, nanoseconds duration, const sigset_t* mask) {
  RETURN_WAIT(int, wait_for(duration), to_timespec(next_part(&w)),
              REAL(ppoll)(fds, count, &part, mask), result == 0, result < 0 && errno == EINTR);
}

static nanoseconds from_milliseconds(int milliseconds) {
  return milliseconds < 0 ? forever : (nanoseconds)milliseconds * 1000000;
}

EXPORT int poll(struct pollfd* fds, nfds_t count, int milliseconds) {
  if (!follows() || milliseconds <= 0) return REAL(poll)(fds, count, milliseconds);
  return poll_for(fds, count, from_milliseconds(milliseconds), NULL);
}

EXPORT int ppoll(struct pollfd* fds, nfds_t count, const struct timespec* t, const sigset_t* mask) {
  if (!follows() || t == NULL || !is_valid(t) || from_timespec(t) == 0) {
    return REAL(ppoll)(fds, count, t, mask);
  }
  return poll_for(fds, count, from_timespec(t), mask);
}

/* What _FORTIFY_SOURCE makes of the two. */
int __poll_chk(struct pollfd* fds, nfds_t count, int milliseconds, size_t size);
int __ppoll_chk(struct pollfd* fds, nfds_t count, const struct timespec* t, const sigset_t* mask,
                size_t size);
EXPORT int __poll_chk(struct pollfd* fds, nfds_t count, int milliseconds, size_t size) {
  if (size / sizeof *fds < count) abort();
  return poll(fds, count, milliseconds);
}
EXPORT int __ppoll_chk(struct pollfd* fds, nfds_t count, const struct timespec* t,
                       const sigset_t* mask, size_t size) {
  if (size / sizeof *fds < count) abort();
  return ppoll(fds, count, t, mask);
}

static int select_for(int count, fd_set* in, fd_set* out, fd_set* except, struct wait* w,
                      const sigset_t* mask) {
  /* Each part begins with the sets as they were. */
  fd_set copies[3];
  fd_set* const sets[3] = {in, out, except};
  for (int i = 0; i < 3; ++i) {
    if (sets[i] != NULL) copies[i] = *sets[i];
  }
  for (;;) {
    const struct timespec part = to_timespec(next_part(w));
    const int result = REAL(pselect)(count, in, out, except, &part, mask);
    if (!goes_on(w, result == 0, result < 0 && errno == EINTR)) return result;
    for (int i = 0; i < 3; ++i) {
      if (sets[i] != NULL) *sets[i] = copies[i];
    }
  }
}

EXPORT int select(int count, fd_set* restrict in, fd_set* restrict out, fd_set* restrict except,
                  struct timeval* restrict t) {
  if (!follows() || t == NULL || t->tv_sec < 0 || t->tv_usec < 0 || from_timeval(t) == 0 ||
      count > FD_SETSIZE) {
    return REAL(select)(count, in, out, except, t);
  }
  struct wait w = wait_for(from_timeval(t));
  const int result = select_for(count, in, out, except, &w, NULL);
  end_wait(&w);
  *t = to_timeval(left_of(&w)); /* as Linux does */
  return result;
}

EXPORT int pselect(int count, fd_set* restrict in, fd_set* restrict out, fd_set* restrict except,
                   const struct timespec* restrict t, const sigset_t* restrict mask) {
  if (!follows() || t == NULL || !is_valid(t) || from_timespec(t) == 0 || count > FD_SETSIZE) {
    return REAL(pselect)(count, in, out, except, t, mask);
  }
  struct wait w = wait_for(from_timespec(t));
  const int result = select_for(count, in, out, except, &w, mask);
  end_wait(&w);
  return result;
}

static int epoll_for(int epoll, struct epoll_event* events, int most, nanoseconds duration,
                     const sigset_t* mask) {
  struct wait w = wait_for(duration);
  int result;
  do {
    /* Whole milliseconds, rounded up, as the kernel does. */
    const int part = (int)((next_part(&w) + 999999) / 1000000);
    result = REAL(epoll_pwait)(epoll, events, most, part, mask);
  } while (goes_on(&w, result == 0, result < 0 && errno == EINTR));
  end_wait(&w);
  return result;
}

EXPORT int epoll_pwait(int epoll, struct epoll_event* events, int most, int milliseconds,
                       const sigset_t* mask) {
  if (!follows() || milliseconds <= 0)
    return REAL(epoll_pwait)(epoll, events, most, milliseconds, mask);
  return epoll_for(epoll, events, most, from_milliseconds(milliseconds), mask);
}
EXPORT int epoll_wait(int epoll, struct epoll_event* events, int most, int milliseconds) {
  if (!follows() || milliseconds <= 0) return REAL(epoll_wait)(epoll, events, most, milliseconds);
  return epoll_pwait(epoll, events, most, milliseconds, NULL);
}
EXPORT int epoll_pwait2(int epoll, struct epoll_event* events, int most, const struct timespec* t,
                        const sigset_t* mask) {
  if (!follows() || t == NULL || !is_valid(t) || from_timespec(t) == 0) {
    return REAL(epoll_pwait2)(epoll, events, most, t, mask);
  }
  return epoll_for(epoll, events, most, from_timespec(t), mask);
}

/* ---- Semaphores and locks -----------------------------------------------------------------------
 */

EXPORT int sem_clockwait(sem_t* restrict semaphore, clockid_t clock,
                         const struct timespec* restrict at) {
  if (!follows() || !is_valid(at) || !is_shifted(clock)) {
    return REAL(sem_clockwait)(semaphore, clock, at);
  }
  RETURN_ERRNO_WAIT(int, wait_for(until(clock, at)), from_now(clock, next_part(&w)),
                    REAL(sem_clockwait)(semaphore, clock, &part), ETIMEDOUT);
}
EXPORT int sem_timedwait(sem_t* restrict semaphore, const struct timespec* restrict at) {
  if (!follows() || !is_valid(at)) return REAL(sem_timedwait)(semaphore, at);
  return sem_clockwait(semaphore, CLOCK_REALTIME, at);
}

/* No signal interrupts these. */
#define LOCK_UNTIL(name, type)                                                                \
  EXPORT int name(type* restrict lock, clockid_t clock, const struct timespec* restrict at) { \
    if (!follows() || at == NULL || !is_valid(at) || !is_shifted(clock)) {                    \
      return REAL(name)(lock, clock, at);                                                     \
    }                                                                                         \
    RETURN_WAIT(int, sliced_wait(until(clock, at)), from_now(clock, next_part(&w)),           \
                REAL(name)(lock, clock, &part), result == ETIMEDOUT, false);                  \
  }
LOCK_UNTIL(pthread_mutex_clocklock, pthread_mutex_t)
LOCK_UNTIL(pthread_rwlock_clockrdlock, pthread_rwlock_t)
LOCK_UNTIL(pthread_rwlock_clockwrlock, pthread_rwlock_t)

#define REALTIME_LOCK(name, type, clocklock)                                 \
  EXPORT int name(type* restrict lock, const struct timespec* restrict at) { \
    if (!follows()) return REAL(name)(lock, at);                             \
    return clocklock(lock, CLOCK_REALTIME, at);                              \
  }
REALTIME_LOCK(pthread_mutex_timedlock, pthread_mutex_t, pthread_mutex_clocklock)
REALTIME_LOCK(pthread_rwlock_timedrdlock, pthread_rwlock_t, pthread_rwlock_clockrdlock)
REALTIME_LOCK(pthread_rwlock_timedwrlock, pthread_rwlock_t, pthread_rwlock_clockwrlock)

EXPORT int pthread_clockjoin_np(pthread_t thread, void** value, clockid_t clock,
                                const struct timespec* at) {
  if (!follows() || at == NULL || !is_valid(at) || !is_shifted(clock)) {
    return REAL(pthread_clockjoin_np)(thread, value, clock, at);
  }
  RETURN_WAIT(int, sliced_wait(until(clock, at)), from_now(clock, next_part(&w)),
              REAL(pthread_clockjoin_np)(thread, value, clock, &part), result == ETIMEDOUT, false);
}
EXPORT int pthread_timedjoin_np(pthread_t thread, void** value, const struct timespec* at) {
  if (!follows()) return REAL(pthread_timedjoin_np)(thread, value, at);
  return pthread_clockjoin_np(thread, value, CLOCK_REALTIME, at);
}

EXPORT int mtx_timedlock(mtx_t* restrict mutex, const struct timespec* restrict at) {
  if (!follows()) return REAL(mtx_timedlock)(mutex, at);
  const int error = pthread_mutex_timedlock((pthread_mutex_t*)mutex, at);
  return error == 0 ? thrd_success : error == ETIMEDOUT ? thrd_timedout : thrd_error;
}

/* ---- Condition variables ------------------------------------------------------------------------
 */

/* When a wait is interrupted nobody waits for a moment, and a signal given then would be lost. So
 * signals are counted, per condition variable (several may share a counter: a wait may always end
 * early), and an interrupted wait goes on in slices. */
enum { counters = 4096 };
static _Atomic uint32_t signals[counters];

static _Atomic uint32_t* counter_of(const pthread_cond_t* cond) {
  return &signals[((uintptr_t)cond >> 4) * 2654435761U % counters];
}

EXPORT int pthread_cond_signal(pthread_cond_t* cond) {
  atomic_fetch_add(counter_of(cond), 1);
  return REAL(pthread_cond_signal)(cond);
}
EXPORT int pthread_cond_broadcast(pthread_cond_t* cond) {
  atomic_fetch_add(counter_of(cond), 1);
  return REAL(pthread_cond_broadcast)(cond);
}
EXPORT int cnd_signal(cnd_t* cond) {
  return pthread_cond_signal((pthread_cond_t*)cond) == 0 ? thrd_success : thrd_error;
}
EXPORT int cnd_broadcast(cnd_t* cond) {
  return pthread_cond_broadcast((pthread_cond_t*)cond) == 0 ? thrd_success : thrd_error;
}

/* A bit of glibc's pthread_cond_t, __wrefs: it uses CLOCK_MONOTONIC. */
enum { cond_monotonic = 2 };

static void register_cond(struct waiter* waiter, pthread_cond_t* cond) {
  if (waiter == NULL) return;
  pthread_mutex_lock(&waiters_lock);
  waiter->cond = cond;
  pthread_mutex_unlock(&waiters_lock);
}

EXPORT int pthread_cond_clockwait(pthread_cond_t* restrict cond, pthread_mutex_t* restrict mutex,
                                  clockid_t clock, const struct timespec* restrict at) {
  if (!follows() || !is_valid(at) || !is_shifted(clock)) {
    return REAL(pthread_cond_clockwait)(cond, mutex, clock, at);
  }
  struct wait w = wait_for(until(clock, at));
  register_cond(w.waiter, cond);
  if (w.waiter != NULL) w.longest = INT64_MAX / 8; /* a broadcast always interrupts it */
  _Atomic uint32_t* counter = counter_of(cond);
  const uint32_t before = atomic_load(counter);
  int result;
  for (;;) {
    const struct timespec part = from_now(clock, next_part(&w));
    result = REAL(pthread_cond_clockwait)(cond, mutex, clock, &part);
    if (atomic_load(counter) != before) break;
    if (!goes_on(&w, result == ETIMEDOUT, result == 0)) break;
    if (w.waiter != NULL) {
      register_cond(w.waiter, NULL);
      end_wait(&w);
      w.waiter = NULL;
      w.longest = slice;
    }
  }
  if (result == ETIMEDOUT && w.real > 0) result = 0;
  register_cond(w.waiter, NULL);
  end_wait(&w);
  return result;
}
EXPORT int pthread_cond_timedwait(pthread_cond_t* restrict cond, pthread_mutex_t* restrict mutex,
                                  const struct timespec* restrict at) {
  if (!follows()) return REAL(pthread_cond_timedwait)(cond, mutex, at);
  const bool monotonic = (cond->__data.__wrefs & cond_monotonic) != 0;
  return pthread_cond_clockwait(cond, mutex, monotonic ? CLOCK_MONOTONIC : CLOCK_REALTIME, at);
}
EXPORT int cnd_timedwait(cnd_t* restrict cond, mtx_t* restrict mutex,
                         const struct timespec* restrict at) {
  if (!follows()) return REAL(cnd_timedwait)(cond, mutex, at);
  const int error = pthread_cond_timedwait((pthread_cond_t*)cond, (pthread_mutex_t*)mutex, at);
  return error == 0 ? thrd_success : error == ETIMEDOUT ? thrd_timedout : thrd_error;
}

/* ---- Signals, message queues, System V semaphores
 * ------------------------------------------------ */

EXPORT int sigtimedwait(const sigset_t* restrict set, siginfo_t* restrict info,
                        const struct timespec* restrict t) {
  if (!follows() || t == NULL || !is_valid(t) || from_timespec(t) == 0) {
    return REAL(sigtimedwait)(set, info, t);
  }
  RETURN_ERRNO_WAIT(int, wait_for(from_timespec(t)), to_timespec(next_part(&w)),
                    REAL(sigtimedwait)(set, info, &part), EAGAIN);
}

EXPORT int semtimedop(int id, struct sembuf* operations, size_t count, const struct timespec* t) {
  if (!follows() || t == NULL || !is_valid(t) || from_timespec(t) == 0) {
    return REAL(semtimedop)(id, operations, count, t);
  }
  RETURN_ERRNO_WAIT(int, wait_for(from_timespec(t)), to_timespec(next_part(&w)),
                    REAL(semtimedop)(id, operations, count, &part), EAGAIN);
}

EXPORT ssize_t mq_timedreceive(mqd_t queue, char* restrict message, size_t length,
                               unsigned* restrict priority, const struct timespec* restrict at) {
  if (!follows() || !is_valid(at)) {
    return REAL(mq_timedreceive)(queue, message, length, priority, at);
  }
  RETURN_ERRNO_WAIT(ssize_t, wait_for(until(CLOCK_REALTIME, at)),
                    from_now(CLOCK_REALTIME, next_part(&w)),
                    REAL(mq_timedreceive)(queue, message, length, priority, &part), ETIMEDOUT);
}
EXPORT int mq_timedsend(mqd_t queue, const char* message, size_t length, unsigned priority,
                        const struct timespec* at) {
  if (!follows() || !is_valid(at)) {
    return REAL(mq_timedsend)(queue, message, length, priority, at);
  }
  RETURN_ERRNO_WAIT(int, wait_for(until(CLOCK_REALTIME, at)),
                    from_now(CLOCK_REALTIME, next_part(&w)),
                    REAL(mq_timedsend)(queue, message, length, priority, &part), ETIMEDOUT);
}

/* ---- System calls made by hand: futexes of C++'s atomics, semaphores, futures
 * --------------------- */

static long real_futex(long address, long operation, long value, const struct timespec* t,
                       long address2, long value3) {
  return REAL(syscall)(SYS_futex, address, operation, value, (long)(uintptr_t)t, address2, value3);
}

static long futex(long address, long operation, long value, const struct timespec* t, long address2,
                  long value3) {
  const int command = (int)operation & FUTEX_CMD_MASK;
  const clockid_t clock = command == FUTEX_LOCK_PI || (operation & FUTEX_CLOCK_REALTIME) != 0
                              ? CLOCK_REALTIME
                              : CLOCK_MONOTONIC;
  const bool relative = command == FUTEX_WAIT;
  RETURN_ERRNO_WAIT(long, wait_for(relative ? from_timespec(t) : until(clock, t)),
                    relative ? to_timespec(next_part(&w)) : from_now(clock, next_part(&w)),
                    real_futex(address, operation, value, &part, address2, value3), ETIMEDOUT);
}

EXPORT long syscall(long number, ...) {
  va_list list;
  va_start(list, number);
  long a[6];
  for (int i = 0; i < 6; ++i) a[i] = va_arg(list, long);
  va_end(list);
  if (follows()) {
    if (number == SYS_futex) {
      const int command = (int)a[1] & FUTEX_CMD_MASK;
      const struct timespec* t = (const struct timespec*)a[3];
      if ((command == FUTEX_WAIT || command == FUTEX_WAIT_BITSET || command == FUTEX_LOCK_PI ||
           command == FUTEX_WAIT_REQUEUE_PI) &&
          t != NULL && is_valid(t)) {
        return futex(a[0], a[1], a[2], t, a[4], a[5]);
      }
    } else if (number == SYS_clock_gettime) {
      return clock_gettime((clockid_t)a[0], (struct timespec*)a[1]);
    } else if (number == SYS_gettimeofday) {
      return gettimeofday((struct timeval*)a[0], (void*)a[1]);
    } else if (number == SYS_nanosleep) {
      return nanosleep((const struct timespec*)a[0], (struct timespec*)a[1]);
    }
  }
  return REAL(syscall)(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}

/* ---- Timers of the kernel -----------------------------------------------------------------------
 */

/* An armed timer, in the program's time. */
enum timer_kind { NoTimer, Interval, Posix, UniqueFd };
struct timer {
  enum timer_kind kind;
  union {
    timer_t posix;
    int fd;
  };
  clockid_t clock;
  bool armed;
  nanoseconds deadline; /* of the program's CLOCK_MONOTONIC */
  nanoseconds interval; /* 0: once */
};
enum { most_timers = 256 };
static struct timer timers[most_timers];
static pthread_mutex_t timers_lock = PTHREAD_MUTEX_INITIALIZER;

/* A signal handler may set a timer, or close a file. */
static sigset_t lock_timers(void) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  pthread_mutex_lock(&timers_lock);
  return before;
}
static void unlock_timers(const sigset_t* before) {
  pthread_mutex_unlock(&timers_lock);
  pthread_sigmask(SIG_SETMASK, before, NULL);
}

static nanoseconds real_duration(nanoseconds duration, double speed) {
  const double real = (double)duration / speed;
  return real < 1.0 ? 1 : real > (double)(INT64_MAX / 2) ? INT64_MAX / 2 : (nanoseconds)real;
}

/* Sets the kernel's timer so that it fires at the deadline as the page has it now. One with a
 * descriptor whose deadline has passed fires at once: nobody has read it, see take_expirations().
 */
static int set_kernel_timer(struct timer* t) {
  const double speed = rate();
  struct itimerspec real = {{0, 0}, {0, 0}};
  if (t->armed && speed > 0.0) {
    const nanoseconds now = match_time(CLOCK_MONOTONIC);
    if (t->interval > 0 && t->deadline <= now && t->kind != UniqueFd) {
      t->deadline += ((now - t->deadline) / t->interval + 1) * t->interval;
    }
    if (t->deadline > now || t->interval == 0 || t->kind == UniqueFd) {
      real.it_value = to_timespec(real_duration(t->deadline > now ? t->deadline - now : 1, speed));
    }
    if (t->interval > 0) real.it_interval = to_timespec(real_duration(t->interval, speed));
  }
  switch (t->kind) {
    case Interval: {
      struct itimerval value = {to_timeval(from_timespec(&real.it_interval)),
                                to_timeval(from_timespec(&real.it_value) + 999)};
      return REAL(setitimer)(ITIMER_REAL, &value, NULL);
    }
    case Posix:
      return REAL(timer_settime)(t->posix, 0, &real, NULL);
    case UniqueFd:
      return REAL(timerfd_settime)(t->fd, 0, &real, NULL);
    default:
      return 0;
  }
}

static struct itimerspec remaining_of(const struct timer* t) {
  struct itimerspec left = {{0, 0}, {0, 0}};
  if (!t->armed) return left;
  const nanoseconds now = match_time(CLOCK_MONOTONIC);
  nanoseconds deadline = t->deadline;
  if (deadline <= now && t->interval > 0) {
    deadline += ((now - deadline) / t->interval + 1) * t->interval;
  }
  if (deadline > now) left.it_value = to_timespec(deadline - now);
  left.it_interval = to_timespec(t->interval);
  return left;
}

static struct itimerval remaining_timeval(const struct timer* t) {
  const struct itimerspec left = t != NULL ? remaining_of(t) : (struct itimerspec){{0, 0}, {0, 0}};
  return (struct itimerval){to_timeval(from_timespec(&left.it_interval)),
                            to_timeval(from_timespec(&left.it_value))};
}

static void set_all_timers(void) {
  const sigset_t before = lock_timers();
  for (int i = 0; i < most_timers; ++i) {
    struct timer* t = &timers[i];
    if (t->kind == NoTimer || !t->armed) continue;
    if (t->interval == 0 && t->deadline <= match_time(CLOCK_MONOTONIC)) {
      t->armed = false; /* it has fired */
    } else {
      (void)set_kernel_timer(t);
    }
  }
  unlock_timers(&before);
}

static struct timer* find_timer(enum timer_kind kind, timer_t posix, int fd) {
  for (int i = 0; i < most_timers; ++i) {
    struct timer* t = &timers[i];
    if (t->kind != kind) continue;
    if (kind == Interval || (kind == Posix && t->posix == posix) ||
        (kind == UniqueFd && t->fd == fd))
      return t;
  }
  return NULL;
}
static struct timer* make_timer(enum timer_kind kind, timer_t posix, int fd) {
  struct timer* t = find_timer(kind, posix, fd);
  for (int i = 0; t == NULL && i < most_timers; ++i) {
    if (timers[i].kind == NoTimer) t = &timers[i];
  }
  if (t == NULL) return NULL;
  memset(t, 0, sizeof *t);
  t->kind = kind;
  if (kind == Posix) t->posix = posix;
  if (kind == UniqueFd) t->fd = fd;
  return t;
}

/* Arms a timer in the program's time. Leaves what was left in `old`. */
static int arm(struct timer* t, clockid_t clock, bool absolute, const struct itimerspec* value) {
  t->clock = clock;
  t->armed = value->it_value.tv_sec != 0 || value->it_value.tv_nsec != 0;
  t->interval = from_timespec(&value->it_interval);
  const nanoseconds duration =
      absolute ? until(clock, &value->it_value) : from_timespec(&value->it_value);
  t->deadline = sliced_wait(duration).deadline;
  if (t->armed) (void)start_keeper();
  return set_kernel_timer(t);
}

EXPORT int setitimer(__itimer_which_t which, const struct itimerval* restrict value,
                     struct itimerval* restrict old) {
  if (!follows() || which != ITIMER_REAL || value == NULL)
    return REAL(setitimer)(which, value, old);
  const sigset_t before = lock_timers();
  struct timer* t = find_timer(Interval, NULL, 0);
  if (old != NULL) *old = remaining_timeval(t);
  t = make_timer(Interval, NULL, 0);
  const struct itimerspec set = {to_timespec(from_timeval(&value->it_interval)),
                                 to_timespec(from_timeval(&value->it_value))};
  const int result =
      t != NULL ? arm(t, CLOCK_MONOTONIC, false, &set) : REAL(setitimer)(which, value, NULL);
  unlock_timers(&before);
  return result;
}
EXPORT int getitimer(__itimer_which_t which, struct itimerval* value) {
  if (!follows() || which != ITIMER_REAL) return REAL(getitimer)(which, value);
  const sigset_t before = lock_timers();
  const struct timer* t = find_timer(Interval, NULL, 0);
  *value = remaining_timeval(t);
  unlock_timers(&before);
  return 0;
}
EXPORT unsigned alarm(unsigned seconds) {
  if (!follows()) return REAL(alarm)(seconds);
  const struct itimerval value = {{0, 0}, {seconds, 0}};
  struct itimerval old;
  if (setitimer(ITIMER_REAL, &value, &old) != 0) return 0;
  return (unsigned)old.it_value.tv_sec + (old.it_value.tv_usec > 0);
}
EXPORT useconds_t ualarm(useconds_t microseconds, useconds_t interval) {
  const struct itimerval value = {to_timeval((nanoseconds)interval * 1000),
                                  to_timeval((nanoseconds)microseconds * 1000)};
  struct itimerval old;
  if (setitimer(ITIMER_REAL, &value, &old) != 0) return (useconds_t)-1;
  return (useconds_t)(old.it_value.tv_sec * 1000000 + old.it_value.tv_usec);
}

EXPORT int timer_create(clockid_t clock, struct sigevent* restrict event, timer_t* restrict timer) {
  const int result = REAL(timer_create)(clock, event, timer);
  if (result != 0 || !follows() || !is_shifted(clock)) return result;
  const sigset_t before = lock_timers();
  struct timer* t = make_timer(Posix, *timer, 0);
  if (t != NULL) t->clock = clock;
  unlock_timers(&before);
  return 0;
}
EXPORT int timer_settime(timer_t timer, int flags, const struct itimerspec* restrict value,
                         struct itimerspec* restrict old) {
  const sigset_t before = lock_timers();
  struct timer* t = follows() && value != NULL ? find_timer(Posix, timer, 0) : NULL;
  if (t != NULL && old != NULL) *old = remaining_of(t);
  const int result = t != NULL ? arm(t, t->clock, (flags & TIMER_ABSTIME) != 0, value)
                               : REAL(timer_settime)(timer, flags, value, old);
  unlock_timers(&before);
  return result;
}
EXPORT int timer_gettime(timer_t timer, struct itimerspec* value) {
  const sigset_t before = lock_timers();
  const struct timer* t = follows() ? find_timer(Posix, timer, 0) : NULL;
  if (t != NULL) *value = remaining_of(t);
  const int result = t != NULL ? 0 : REAL(timer_gettime)(timer, value);
  unlock_timers(&before);
  return result;
}
EXPORT int timer_delete(timer_t timer) {
  const sigset_t before = lock_timers();
  struct timer* t = find_timer(Posix, timer, 0);
  if (t != NULL) t->kind = NoTimer;
  unlock_timers(&before);
  return REAL(timer_delete)(timer);
}

static _Atomic bool has_descriptors; /* of timers, now or before */

EXPORT int timerfd_create(clockid_t clock, int flags) {
  const int fd = REAL(timerfd_create)(clock, flags);
  if (fd < 0 || !follows() || !is_shifted(clock)) return fd;
  atomic_store(&has_descriptors, true);
  const sigset_t before = lock_timers();
  struct timer* t = make_timer(UniqueFd, NULL, fd);
  if (t != NULL) t->clock = clock;
  unlock_timers(&before);
  return fd;
}
EXPORT int timerfd_settime(int fd, int flags, const struct itimerspec* value,
                           struct itimerspec* old) {
  const sigset_t before = lock_timers();
  struct timer* t = follows() && value != NULL ? find_timer(UniqueFd, NULL, fd) : NULL;
  if (t != NULL && old != NULL) *old = remaining_of(t);
  const int result = t != NULL ? arm(t, t->clock, (flags & TFD_TIMER_ABSTIME) != 0, value)
                               : REAL(timerfd_settime)(fd, flags, value, old);
  unlock_timers(&before);
  return result;
}
EXPORT int timerfd_gettime(int fd, struct itimerspec* value) {
  const sigset_t before = lock_timers();
  const struct timer* t = follows() ? find_timer(UniqueFd, NULL, fd) : NULL;
  if (t != NULL) *value = remaining_of(t);
  const int result = t != NULL ? 0 : REAL(timerfd_gettime)(fd, value);
  unlock_timers(&before);
  return result;
}

/* How often it has expired in the program's time since it was read; it waits for the next time. The
 * kernel's own count would begin again whenever its timer is set. */
static uint64_t take_expirations(struct timer* t) {
  const nanoseconds now = match_time(CLOCK_MONOTONIC);
  if (t->interval == 0) return 1;
  const nanoseconds count = t->deadline > now ? 0 : (now - t->deadline) / t->interval + 1;
  t->deadline += count * t->interval;
  (void)set_kernel_timer(t);
  return (uint64_t)count;
}

/* ---- The keeper ---------------------------------------------------------------------------------
 */

static _Atomic int keeper_state; /* 0: none yet; 1: runs */

static int wake_signal(void) {
  return SIGRTMAX - 5;
}

/* Interrupts those that wait by an older page. True when there is none. */
static bool wake_waiters(uint32_t sequence) {
  bool all = true;
  for (int i = 0; i < most_waiters; ++i) {
    struct waiter* one = &waiters[i];
    const pid_t thread = atomic_load(&one->thread);
    if (thread == 0 || atomic_load(&one->sequence) == sequence) continue;
    all = false;
    pthread_mutex_lock(&waiters_lock);
    if (one->cond != NULL) {
      REAL(pthread_cond_broadcast)(one->cond);
    } else {
      REAL(syscall)(SYS_tgkill, getpid(), thread, wake_signal());
    }
    pthread_mutex_unlock(&waiters_lock);
  }
  return all;
}

static void* keep(void* unused) {
  const struct pitchboard_time_page* p = atomic_load(&page);
  uint32_t seen = 1; /* never that of a whole page */
  for (;;) {
    const uint32_t now = page_sequence();
    if (now % 2 == 0 && now != seen) {
      set_all_timers();
      /* A signal may come before the wait that it should interrupt, so it is repeated. */
      for (int i = 0; i < 50 && page_sequence() == now && !wake_waiters(now); ++i) {
        const struct timespec pause = {0, 1000000};
        REAL(nanosleep)(&pause, NULL);
      }
      seen = now;
    }
    if (page_sequence() == now)
      real_futex((long)(uintptr_t)&p->sequence, FUTEX_WAIT, (long)now, NULL, 0, 0);
  }
  return unused;
}

/* fork() copies neither threads nor timers, but for those with a descriptor. */
static void after_fork(void) {
  atomic_store(&own_process, getpid());
  pthread_mutex_init(&timers_lock, NULL);
  pthread_mutex_init(&waiters_lock, NULL);
  memset(waiters, 0, sizeof waiters);
  for (int i = 0; i < most_timers; ++i) {
    if (timers[i].kind != UniqueFd) timers[i].kind = NoTimer;
  }
  atomic_store(&keeper_state, 0);
}

/* False if there can be none. */
static bool start_keeper(void) {
  int none = 0;
  if (atomic_load_explicit(&keeper_state, memory_order_acquire) == 1) return true;
  if (!atomic_compare_exchange_strong(&keeper_state, &none, 1)) return true;
  static bool registered;
  if (!registered) pthread_atfork(NULL, NULL, after_fork);
  registered = true;
  /* A signal that the program uses itself stays its own; waits are looked after once a second then.
   */
  struct sigaction action;
  if (sigaction(wake_signal(), NULL, &action) == 0 && action.sa_handler == SIG_DFL) {
    memset(&action, 0, sizeof action);
    action.sa_handler = note_wake;
    action.sa_flags = SA_RESTART; /* calls without a time limit are not disturbed */
    sigaction(wake_signal(), &action, NULL);
  }
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  pthread_t thread;
  const bool started = pthread_create(&thread, NULL, keep, NULL) == 0;
  if (started) pthread_detach(thread);
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  if (!started) atomic_store(&keeper_state, 0);
  return started;
}

/* ---- Timeouts of sockets ------------------------------------------------------------------------
 */

/* SO_RCVTIMEO and SO_SNDTIMEO, kept here instead of in the kernel: a wait is a poll before the
 * call. */
enum { most_sockets = 1024 };
static _Atomic nanoseconds receive_timeout[most_sockets], send_timeout[most_sockets];

static _Atomic nanoseconds* timeout_of(int fd, int option) {
  if (fd < 0 || fd >= most_sockets) return NULL;
  return option == SO_RCVTIMEO   ? &receive_timeout[fd]
         : option == SO_SNDTIMEO ? &send_timeout[fd]
                                 : NULL;
}

EXPORT int setsockopt(int fd, int level, int option, const void* value, socklen_t length) {
  _Atomic nanoseconds* timeout = level == SOL_SOCKET ? timeout_of(fd, option) : NULL;
  if (!follows() || timeout == NULL || length < sizeof(struct timeval)) {
    return REAL(setsockopt)(fd, level, option, value, length);
  }
  const struct timeval none = {0, 0};
  const struct timeval* wanted = value;
  if (wanted->tv_usec < 0 || wanted->tv_usec >= 1000000) {
    errno = EDOM;
    return -1;
  }
  const int result = REAL(setsockopt)(fd, level, option, &none, sizeof none);
  if (result == 0) atomic_store(timeout, from_timeval(wanted));
  return result;
}
EXPORT int getsockopt(int fd, int level, int option, void* restrict value,
                      socklen_t* restrict length) {
  const _Atomic nanoseconds* timeout = level == SOL_SOCKET ? timeout_of(fd, option) : NULL;
  const int result = REAL(getsockopt)(fd, level, option, value, length);
  if (result == 0 && follows() && timeout != NULL && *length >= sizeof(struct timeval)) {
    *(struct timeval*)value = to_timeval(atomic_load(timeout));
  }
  return result;
}

/* False when the time is over; errno is set then. Not for calls that do not block. */
static bool may_go_on(int fd, int option, short events) {
  const _Atomic nanoseconds* timeout = timeout_of(fd, option);
  const nanoseconds limit =
      timeout != NULL ? atomic_load_explicit(timeout, memory_order_relaxed) : 0;
  if (limit == 0 || !follows()) return true;
  const int flags = fcntl(fd, F_GETFL);
  if (flags >= 0 && (flags & O_NONBLOCK) != 0) return true;
  struct pollfd one = {fd, events, 0};
  const int result = poll_for(&one, 1, limit, NULL);
  if (result == 0) errno = EAGAIN;
  return result > 0;
}

#define AFTER_WAIT(type, name, parameters, arguments, fd, option, events, blocks) \
  EXPORT type name parameters {                                                   \
    if ((blocks) && !may_go_on(fd, option, events)) return -1;                    \
    return REAL(name) arguments;                                                  \
  }
AFTER_WAIT(ssize_t, recv, (int fd, void* data, size_t size, int flags), (fd, data, size, flags), fd,
           SO_RCVTIMEO, POLLIN, (flags & MSG_DONTWAIT) == 0)
AFTER_WAIT(ssize_t, recvfrom,
           (int fd, void* restrict data, size_t size, int flags, struct sockaddr* restrict from,
            socklen_t* restrict length),
           (fd, data, size, flags, from, length), fd, SO_RCVTIMEO, POLLIN,
           (flags & MSG_DONTWAIT) == 0)
AFTER_WAIT(ssize_t, recvmsg, (int fd, struct msghdr* message, int flags), (fd, message, flags), fd,
           SO_RCVTIMEO, POLLIN, (flags & MSG_DONTWAIT) == 0)
AFTER_WAIT(ssize_t, readv, (int fd, const struct iovec* parts, int count), (fd, parts, count), fd,
           SO_RCVTIMEO, POLLIN, true)
AFTER_WAIT(int, accept, (int fd, struct sockaddr* restrict from, socklen_t* restrict length),
           (fd, from, length), fd, SO_RCVTIMEO, POLLIN, true)
AFTER_WAIT(int, accept4,
           (int fd, struct sockaddr* restrict from, socklen_t* restrict length, int flags),
           (fd, from, length, flags), fd, SO_RCVTIMEO, POLLIN, true)
AFTER_WAIT(ssize_t, send, (int fd, const void* data, size_t size, int flags),
           (fd, data, size, flags), fd, SO_SNDTIMEO, POLLOUT, (flags & MSG_DONTWAIT) == 0)
AFTER_WAIT(ssize_t, sendto,
           (int fd, const void* data, size_t size, int flags, const struct sockaddr* to,
            socklen_t length),
           (fd, data, size, flags, to, length), fd, SO_SNDTIMEO, POLLOUT,
           (flags & MSG_DONTWAIT) == 0)
AFTER_WAIT(ssize_t, sendmsg, (int fd, const struct msghdr* message, int flags),
           (fd, message, flags), fd, SO_SNDTIMEO, POLLOUT, (flags & MSG_DONTWAIT) == 0)
AFTER_WAIT(ssize_t, write, (int fd, const void* data, size_t size), (fd, data, size), fd,
           SO_SNDTIMEO, POLLOUT, true)

/* Of a timer: how often it has expired in the program's time. */
EXPORT ssize_t read(int fd, void* data, size_t size) {
  if (!may_go_on(fd, SO_RCVTIMEO, POLLIN)) return -1;
  for (;;) {
    const ssize_t result = REAL(read)(fd, data, size);
    uint64_t count = 0;
    if (result != (ssize_t)sizeof count || !atomic_load(&has_descriptors) || !follows()) {
      return result;
    }
    const sigset_t before = lock_timers();
    struct timer* t = find_timer(UniqueFd, NULL, fd);
    if (t != NULL) count = take_expirations(t);
    unlock_timers(&before);
    if (t == NULL) return result;
    if (count == 0) continue; /* it fired before the match became slower */
    memcpy(data, &count, sizeof count);
    return result;
  }
}

/* The number may mean another file now. */
EXPORT int close(int fd) {
  if (fd >= 0 && fd < most_sockets && follows() && is_own_process()) {
    atomic_store_explicit(&receive_timeout[fd], 0, memory_order_relaxed);
    atomic_store_explicit(&send_timeout[fd], 0, memory_order_relaxed);
    const sigset_t before = lock_timers();
    struct timer* t = find_timer(UniqueFd, NULL, fd);
    if (t != NULL) t->kind = NoTimer;
    unlock_timers(&before);
  }
  return REAL(close)(fd);
}
