// SPDX-License-Identifier: GPL-3.0-or-later
// Only in tests with the thread sanitizer. QProcess starts a program by clone() in its own memory,
// where the child tells the sanitizer to ignore everything from now on, which then holds for the
// parent, too: it saw the locks of no thread that had started a program. Here the child gets a
// copy.
#include <sched.h>
#include <cstdarg>

extern "C" int __interceptor_clone(int (*)(void*), void*, int, void*, ...);

extern "C" int clone(int (*child)(void*), void* stack, int flags, void* argument, ...) {
  std::va_list rest;
  va_start(rest, argument);
  void* const parentTid = va_arg(rest, void*);
  void* const threadStorage = va_arg(rest, void*);
  void* const childTid = va_arg(rest, void*);
  va_end(rest);
  return __interceptor_clone(child, stack, flags & ~CLONE_VM, argument, parentTid, threadStorage,
                             childTid);
}
