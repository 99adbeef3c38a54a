// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How long QTRY_VERIFY and QTRY_COMPARE wait for what must come: 30 s instead of Qt's 5 s, which a
// busy computer of two cores does not always keep. What comes is not waited for any longer, so it
// costs nothing but when a test fails. Part of every test by its precompiled header.

#include <QtTest>

#undef QTRY_VERIFY
#undef QTRY_VERIFY2
#undef QTRY_COMPARE
#define QTRY_VERIFY(expr) QTRY_VERIFY_WITH_TIMEOUT(expr, 30'000)
#define QTRY_VERIFY2(expr, message) QTRY_VERIFY2_WITH_TIMEOUT(expr, message, 30'000)
#define QTRY_COMPARE(expr, expected) QTRY_COMPARE_WITH_TIMEOUT(expr, expected, 30'000)
