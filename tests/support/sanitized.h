// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether a program is built with the address or the thread sanitizer: they replace malloc(), and
// the program is larger with them. gcc defines macros, clang has a feature test.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PITCHBOARD_SANITIZED 1
#elif defined(__has_feature)
#define PITCHBOARD_SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define PITCHBOARD_SANITIZED 0
#endif
