// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads recorded sessions (MCAP files) with a plain C interface, for other languages. It is part of
// libpitchboard_sim and follows the rules of pitchboard_sim.h: opaque handles, a pb_status from
// each function, and the sentence of an error from pb_last_error(). Any thread may call; calls with
// the same session wait for one another. What a call returns is a pb_data: arrays that the library
// owns until pb_data_free(), also after the session is closed. Only what was asked for is read and
// kept. Times are seconds of the session, as in every other program of Pitchboard.

#include <pitchboard_sim.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pb_session pb_session;
typedef struct pb_data pb_data;

/** The type of the values of an array. */
typedef enum pb_type {
  PB_CHARS = 0, /**< UTF-8; a zero follows that is not counted */
  PB_INT32 = 1,
  PB_FLOAT32 = 2,
  PB_FLOAT64 = 3
} pb_type;

/** An array of the library. Set `size` to sizeof(pb_span) first. */
typedef struct pb_span {
  size_t size;
  int32_t type;       /**< pb_type */
  const void* values; /**< valid until pb_data_free(); null if count is 0 */
  size_t count;       /**< number of values */
} pb_span;

/** What stands for a value that is unknown, such as the distance of a ball that is not seen. */
typedef enum pb_unknown {
  PB_UNKNOWN_NAN = 0, /**< NaN */
  PB_UNKNOWN_OLD = 1  /**< the value that the variable still had, as in the file */
} pb_unknown;

/** Opens a file. A file that is truncated, damaged or still being recorded opens as far as it goes;
 *  the description's "notes" say what is missing. PB_NOT_FOUND, PB_SYSTEM_ERROR or PB_PARSE_ERROR
 *  if it cannot be opened. */
PB_API pb_status pb_session_open(const char* path, pb_session** session);
/** Waits for running calls first. Null is allowed. */
PB_API pb_status pb_session_close(pb_session* session);

/** Describes the session: array 0 is a JSON object (PB_CHARS) with `program`, `source`, `title`,
 *  `seed`, `start_ns` (wall time of second 0, ns since 1970), `created_ns`, `more`, `complete`,
 *  `recording`, `damaged`, `from` and `until` (s; missing if nothing was recorded), `notes`, and
 *  `groups` in the order in which they are listed. A group has `index`, `name`, `rows`,
 *  `attributes`, and `columns` with `name`, `type` (pb_type), `unit`, `category`, `kind` ("number",
 *  "flag", "enumeration" or "text") and `labels`, the texts of its codes. */
PB_API pb_status pb_session_describe(pb_session* session, pb_data** data);
/** Finds the group with this name, or the one that had it earlier: a referee corrects colours, and
 * a setup gives robots other names. Writes its index. PB_NOT_FOUND if there is none,
 *  PB_INVALID_ARGUMENT if several groups had the name. */
PB_API pb_status pb_session_group(pb_session* session, const char* name, int32_t* group);
/** Reads the events in a closed range of time (s): array 0 is a JSON list (PB_CHARS), with the keys
 *  of docs/sessions.md. Events that were undone are left out. */
PB_API pb_status pb_session_events(pb_session* session, double begin, double end, pb_data** data);
/** Reads the rows of a group in a closed range of time (s; may be infinite). Array 0 has their
 *  times (PB_FLOAT64), array 1 + i the values of columns[i] in the column's type. `unknown` is a
 *  pb_unknown. */
PB_API pb_status pb_session_rows(pb_session* session, int32_t group, const int32_t* columns,
                                 size_t column_count, double begin, double end, int32_t unknown,
                                 pb_data** data);
/** Reads the last row of each group at or before a time (s). Array g is of group g (PB_FLOAT64):
 * the row's time, then all columns; NaN if there is no row or a value is unknown. */
PB_API pb_status pb_session_frame(pb_session* session, double time, pb_data** data);

/** The mean of samples that follow each other at even steps, and how sure it is: as many
 * independent samples would say as much (`effective`), and the 95 % confidence interval that
 * follows, which is NaN if `effective` is below 2. NaN samples are unknown. docs/statistics.md has
 * the formulas. */
typedef struct pb_mean {
  size_t size; /**< sizeof(pb_mean) */
  double effective, low, high;
} pb_mean;
/** Writes to `mean`, whose `size` has to be set before. */
PB_API pb_status pb_mean_interval(const double* values, size_t count, pb_mean* mean);

/** Writes an array of the data to `span`. */
PB_API pb_status pb_data_span(const pb_data* data, size_t index, pb_span* span);
/** Null is allowed. */
PB_API pb_status pb_data_free(pb_data* data);

#ifdef __cplusplus
}
#endif
