// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The simulator as a library with a plain C interface, for learning and for other languages. It
// simulates many worlds of a scenario, which are stepped together and are read and written as
// arrays (docs/worlds.md has a complete example). Handles are opaque; a handle that was destroyed
// or is invalid gives PB_STALE_HANDLE. Any thread may call; calls with the same handle wait for one
// another. Each thread has its own error text. Metres, seconds, radians in the field's frame (x to
// the right goal, y up); percepts and variables have the robots' own units. The caller owns all
// arrays; each `count` is the number of elements and must match the shape of the array.

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define PB_API __attribute__((visibility("default")))
#else
#define PB_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** Increases when functions, columns or members are added. Existing ones never change; a change
 *  that breaks programs would change the library's name (libpitchboard_sim.so.1). */
#define PB_API_VERSION 4

/** Instead of the index of a world: all worlds. */
#define PB_ALL (-1)
/** In an array of int32_t that is written: keep the current value. (In an array of double: NaN.) */
#define PB_KEEP INT32_MIN
/** Words of a blackboard. Int variable i is word i; float variable j is word 125 + j. */
#define PB_BOARD_WORDS 512

/** Result of every function that can fail; pb_last_error() returns the message. */
typedef enum pb_status {
  PB_OK = 0,
  PB_INVALID_ARGUMENT = 1, /**< a null pointer, a number out of range, an array of wrong size */
  PB_NOT_FOUND = 2,        /**< no such scenario, file, world, robot or variable */
  PB_PARSE_ERROR = 3,      /**< the text of the scenario is invalid */
  PB_SYSTEM_ERROR = 4,     /**< an error of the operating system, such as lack of memory */
  PB_CONFLICT = 5,
  PB_UNSUPPORTED = 6,
  PB_STALE_HANDLE = 7 /**< the handle was destroyed or is invalid */
} pb_status;

typedef struct pb_worlds pb_worlds;
typedef struct pb_snapshot pb_snapshot;
typedef struct pb_rollouts pb_rollouts;

/** Options of pb_create(). Initialize them with pb_options_init(), which sets `size`: it tells
 * later versions which members the caller knows. */
typedef struct pb_options {
  size_t size;
  const char* scenario; /**< built-in name or path of a file; null: "one-robot" */
  const char* text;     /**< a scenario as JSON, instead of a name; null: none */
  int32_t worlds;       /**< 1 to 65536; world i has the seed of world 0 plus i */
  int32_t threads;      /**< 1 to 256; has no influence on results */
  int32_t has_seed;     /**< 1: use `seed`; 0: use the scenario's seed */
  uint64_t seed;        /**< seed of world 0 */
  double duration;      /**< seconds until a world ends; 0: as in the scenario */
  const char* noise;    /**< a preset: "none", "paper", "realistic" ...; null: the scenario's */
  const char* physics;  /**< "rigid-body" or "published"; null: the scenario's */
  int32_t particles;    /**< upper limit for each robot's localization; 0: the default */
} pb_options;

/** The dimensions of worlds. Set `size` to sizeof(pb_shape) first. */
typedef struct pb_shape {
  size_t size;
  int32_t worlds;
  int32_t robots;   /**< in each world, in the order of the scenario */
  double tick_rate; /**< ticks per simulated second */
} pb_shape;

/** Arrays of double. The first three can be read with pb_read(); the others only have columns. */
typedef enum pb_array {
  PB_PERCEPTS = 0, /**< [worlds][robots][columns]: what the robot sensed in the last tick. NaN: not
                        written, or no step since the beginning or a snapshot */
  PB_ROBOTS = 1,   /**< [worlds][robots][columns]: the true state of the robots */
  PB_GAME = 2,     /**< [worlds][columns]: ball, clock, score, whether the scenario has ended */
  PB_COMMANDS = 3, /**< the columns of pb_write_commands() */
  /* Rollouts. */
  PB_BELIEF_ROBOTS = 4, /**< [robots][columns]: believed poses with their uncertainty */
  PB_BELIEF_GAME = 5,   /**< [columns]: ball, score, time, set play */
  PB_OUTCOMES = 6       /**< [seeds][columns]: the outcome of each rollout */
} pb_array;

/** Returns the API version of the loaded library, to be compared with PB_API_VERSION. */
PB_API int32_t pb_api_version(void);
/** Returns the program's version, such as "0.4.0"; never null. */
PB_API const char* pb_version(void);
/** Returns the error message of this thread's last call; empty if it succeeded. Never null; valid
 *  until the thread's next call. */
PB_API const char* pb_last_error(void);

/** Returns the number of columns of an array; 0 if there is no such array. New columns are added at
 *  the end. */
PB_API size_t pb_column_count(int32_t array);
/** Returns null if there is no such column. */
PB_API const char* pb_column_name(int32_t array, size_t column);
/** Returns unit and meaning; null if there is no such column. */
PB_API const char* pb_column_words(int32_t array, size_t column);

/** Sets the defaults. `size` must be sizeof(pb_options). */
PB_API pb_status pb_options_init(pb_options* options, size_t size);
/** Creates worlds, which pb_destroy() frees. */
PB_API pb_status pb_create(const pb_options* options, pb_worlds** worlds);
/** Waits for running calls first. Null is allowed. */
PB_API pb_status pb_destroy(pb_worlds* worlds);
PB_API pb_status pb_get_shape(pb_worlds* worlds, pb_shape* shape);
/** Writes the ids of the robots: int32_t [robots]. */
PB_API pb_status pb_robot_ids(pb_worlds* worlds, int32_t* ids, size_t count);

/** Sets the behaviour of a robot in all worlds: one of ours ("striker", "keeper", ...), or "none"
 * if the caller controls it. */
PB_API pb_status pb_set_behaviour(pb_worlds* worlds, int32_t robot, const char* behaviour);
/** Restarts the scenario with this seed. With PB_ALL, world i gets seed + i. */
PB_API pb_status pb_reset(pb_worlds* worlds, int32_t world, uint64_t seed);
/** Advances all worlds by this many ticks. A world whose scenario has ended stands still until it
 * is reset. */
PB_API pb_status pb_step(pb_worlds* worlds, int32_t ticks);

/** Reads one of the first three arrays of pb_array. */
PB_API pb_status pb_read(pb_worlds* worlds, int32_t array, double* out, size_t count);
/** Reads uint32_t [worlds][robots][PB_BOARD_WORDS]. */
PB_API pb_status pb_read_boards(pb_worlds* worlds, uint32_t* out, size_t count);
/** Reads uint64_t [worlds]. Equal states have equal hashes, as in `pitchboard-cli simulate`. */
PB_API pb_status pb_read_hashes(pb_worlds* worlds, uint64_t* out, size_t count);
/** Finds the number of a blackboard variable by its name, such as "VISION_BALL_DIST". */
PB_API pb_status pb_find_variable(const char* name, int32_t* variable);
/** Reads double [worlds][robots][variables]. */
PB_API pb_status pb_read_variables(pb_worlds* worlds, const int32_t* variables,
                                   size_t variable_count, double* out, size_t count);
/** Writes double [worlds][robots][variables]. Int variables accept whole numbers only; NaN keeps
 * the current value. */
PB_API pb_status pb_write_variables(pb_worlds* worlds, const int32_t* variables,
                                    size_t variable_count, const double* values, size_t count);
/** Writes int32_t [worlds][robots][columns of PB_COMMANDS]. */
PB_API pb_status pb_write_commands(pb_worlds* worlds, const int32_t* commands, size_t count);
/** Writes DECISION_ACTION_A: int32_t [worlds][robots]. */
PB_API pb_status pb_write_actions(pb_worlds* worlds, const int32_t* actions, size_t count);

/** Moves a robot or the ball. A position outside the walls is moved inside. */
PB_API pb_status pb_place_robot(pb_worlds* worlds, int32_t world, int32_t robot, double x, double y,
                                double yaw);
PB_API pb_status pb_place_ball(pb_worlds* worlds, int32_t world, double x, double y,
                               double velocity_x, double velocity_y);

/** Saves the exact state of a world and its blackboards, but not what our behaviours remember: a
 *  restored world continues identically only if the caller controls all robots. A snapshot may
 *  outlive its worlds. */
PB_API pb_status pb_take_snapshot(pb_worlds* worlds, int32_t world, pb_snapshot** snapshot);
/** Restores a snapshot in any world (or PB_ALL) of the same scenario. */
PB_API pb_status pb_restore(pb_worlds* worlds, int32_t world, const pb_snapshot* snapshot);
/** Null is allowed. */
PB_API pb_status pb_destroy_snapshot(pb_snapshot* snapshot);

/* Functions for many worlds. `which` contains the numbers of `count` different worlds. If one of
 * them does not exist, nothing is changed. */
/** Restarts each world with its seed. */
PB_API pb_status pb_reset_some(pb_worlds* worlds, const int32_t* which, const uint64_t* seeds,
                               size_t count);
/** Restores the snapshot in each world, which then continues with the noise of its own seed. */
PB_API pb_status pb_restore_seeded(pb_worlds* worlds, const int32_t* which, const uint64_t* seeds,
                                   size_t count, const pb_snapshot* snapshot);
/** `poses` is double [count][3]: x, y and yaw of the robot. */
PB_API pb_status pb_place_robots(pb_worlds* worlds, const int32_t* which, size_t count,
                                 int32_t robot, const double* poses);
/** `balls` is double [count][4]: x, y, and velocity in x and y. */
PB_API pb_status pb_place_balls(pb_worlds* worlds, const int32_t* which, size_t count,
                                const double* balls);

/* Rollouts play many short games from a belief, thousands of times faster than real time
 * (docs/rollouts.md). */

/** Options of pb_rollouts_create(). Initialize them with pb_rollout_options_init(). */
typedef struct pb_rollout_options {
  size_t size;
  const char* scenario; /**< players and field: built-in name or path of a file; null: "match" */
  const char* text;     /**< a scenario as JSON, instead of a name; null: none */
  const char* noise;    /**< a preset; null: the scenario's */
  int32_t threads;      /**< 1 to 256; has no influence on results */
  double tick_rate;     /**< ticks per second: a multiple of 10 up to 120; default 20 */
} pb_rollout_options;

/** Options of pb_rollouts_play(). Initialize them with pb_play_options_init(). */
typedef struct pb_play_options {
  size_t size;
  double seconds; /**< longest duration; default 10 */
  double look;   /**< time in s at which "look_x" and "look_y" are the ball's position; default 5 */
  int32_t go_on; /**< 0: a goal or a ball that is out ends a rollout; 1: it continues */
} pb_play_options;

PB_API pb_status pb_rollout_options_init(pb_rollout_options* options, size_t size);
PB_API pb_status pb_play_options_init(pb_play_options* options, size_t size);
PB_API pb_status pb_rollouts_create(const pb_rollout_options* options, pb_rollouts** rollouts);
/** Waits for running calls first. Null is allowed. */
PB_API pb_status pb_rollouts_destroy(pb_rollouts* rollouts);
/** Writes the number of robots. Their order is that of the scenario. */
PB_API pb_status pb_rollouts_robots(pb_rollouts* rollouts, int32_t* robots);
/** Writes the beginning of the scenario as a belief (PB_BELIEF_ROBOTS and PB_BELIEF_GAME), which
 * the caller can change. */
PB_API pb_status pb_rollouts_beginning(pb_rollouts* rollouts, double* robots, size_t robot_count,
                                       double* game, size_t game_count);
/** Plays a rollout for each seed; equal seeds have equal noise. NaN in a belief stands for the
 * value at the beginning of the scenario. Writes PB_OUTCOMES to `outcomes`. */
PB_API pb_status pb_rollouts_play(pb_rollouts* rollouts, const pb_play_options* options,
                                  const double* robots, size_t robot_count, const double* game,
                                  size_t game_count, const uint64_t* seeds, size_t seed_count,
                                  double* outcomes, size_t outcome_count);

#ifdef __cplusplus
}
#endif
