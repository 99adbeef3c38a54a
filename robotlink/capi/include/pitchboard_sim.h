// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The simulator as a library with a plain C interface, for learning and for other languages: many
// worlds of one scenario, stepped together, read and written as arrays (docs/worlds.md has a
// worked example). Handles are opaque; what was destroyed or never made is noticed and refused. Any
// thread may call; calls with the same handle wait for one another, and the text of an error
// belongs to the thread. Metres, seconds, radians in the field's frame (x to the right goal, y up);
// percepts and variables in the robots' own units. The caller owns every array.

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

/** Grows when functions, columns or members are added. What is there stays as it is; a change that
 *  would break a program changes the library's name (libpitchboard_sim.so.1). */
#define PB_API_VERSION 2

/** In place of a world: all of them. */
#define PB_ALL (-1)
/** In arrays of int32_t that are written: leave what stands there. (In those of double: NaN.) */
#define PB_KEEP INT32_MIN
/** Words of a blackboard. Int variable i is word i, float variable j the bits of word 125 + j. */
#define PB_BOARD_WORDS 512

/** What every function returns that can fail; pb_last_error() then has a sentence. */
typedef enum pb_status {
  PB_OK = 0,
  PB_INVALID_ARGUMENT = 1, /**< a null, a number out of bounds, an array of another size */
  PB_NOT_FOUND = 2,        /**< no such scenario, file, world, robot, variable */
  PB_PARSE_ERROR = 3,      /**< the scenario's text does not follow its format */
  PB_SYSTEM_ERROR = 4,     /**< the operating system refused; memory, threads */
  PB_CONFLICT = 5,
  PB_UNSUPPORTED = 6,
  PB_STALE_HANDLE = 7 /**< the worlds or the snapshot are not there (any more) */
} pb_status;

typedef struct pb_worlds pb_worlds;
typedef struct pb_snapshot pb_snapshot;
typedef struct pb_rollouts pb_rollouts;

/** How worlds are made. Fill it with pb_options_init() first: it sets `size`, by which later
 *  versions tell what the caller knows. */
typedef struct pb_options {
  size_t size;
  const char* scenario; /**< built-in name or path of a file; null: "one-robot" */
  const char* text;     /**< a scenario as JSON, in place of a name; null: none */
  int32_t worlds;       /**< 1 to 65536; world i has the seed of world 0 plus i */
  int32_t threads;      /**< 1 to 256; results do not depend on it */
  int32_t has_seed;     /**< 0: the scenario's seed */
  uint64_t seed;        /**< of world 0 */
  double duration;      /**< s until a world is over; 0: as the scenario says */
  const char* noise;    /**< a preset: "none", "paper", "realistic" ...; null: the scenario's */
  const char* physics;  /**< "rigid-body" or "published"; null: the scenario's */
  int32_t particles;    /**< at most, of each robot that localizes itself; 0: as usual */
} pb_options;

/** What worlds look like. Set `size` to sizeof(pb_shape) before. */
typedef struct pb_shape {
  size_t size;
  int32_t worlds;
  int32_t robots;   /**< of each world, in the order of the scenario */
  double tick_rate; /**< ticks a simulated second */
} pb_shape;

/** What pb_read() reads, as rows of double. */
typedef enum pb_array {
  PB_PERCEPTS = 0, /**< [worlds][robots][columns]: what the last tick let the robot sense; NaN: not
                        written, or not stepped since the beginning or a snapshot */
  PB_ROBOTS = 1,   /**< [worlds][robots][columns]: the truth */
  PB_GAME = 2,     /**< [worlds][columns]: ball, clock, score, whether the scenario is over */
  PB_COMMANDS = 3, /**< for pb_column_...() only: the columns of pb_write_commands() */
  /* Of rollouts, for pb_column_...() only. */
  PB_BELIEF_ROBOTS = 4, /**< [robots][columns]: where they are believed to stand, and how surely */
  PB_BELIEF_GAME = 5,   /**< [columns]: ball, score, time, set play */
  PB_OUTCOMES = 6       /**< [seeds][columns]: what became of each rollout */
} pb_array;

/** Of the library that is running; compare with PB_API_VERSION. */
PB_API int32_t pb_api_version(void);
/** "0.4.0"; never null. */
PB_API const char* pb_version(void);
/** The sentence of this thread's last call that failed; empty after one that worked. Never null; it
 *  stands until the thread's next call. */
PB_API const char* pb_last_error(void);

/** Columns of an array; 0 for an unknown one. New columns are added at the end of their array. */
PB_API size_t pb_column_count(int32_t array);
/** Null where there is none. */
PB_API const char* pb_column_name(int32_t array, size_t column);
/** Unit and meaning; null where there is none. */
PB_API const char* pb_column_words(int32_t array, size_t column);

/** `size`: sizeof(pb_options). */
PB_API pb_status pb_options_init(pb_options* options, size_t size);
PB_API pb_status pb_create(const pb_options* options, pb_worlds** worlds);
/** Waits for calls under way; null is fine. */
PB_API pb_status pb_destroy(pb_worlds* worlds);
PB_API pb_status pb_get_shape(pb_worlds* worlds, pb_shape* shape);
/** Numbers of the robots: int32_t [robots]. */
PB_API pb_status pb_robot_ids(pb_worlds* worlds, int32_t* ids, size_t count);

/** Who decides for a robot in every world from now on: a behaviour of ours ("striker", "keeper",
 *  ...), or "none": the caller. */
PB_API pb_status pb_set_behaviour(pb_worlds* worlds, int32_t robot, const char* behaviour);
/** The beginning of the scenario; of PB_ALL: world i with seed + i. */
PB_API pb_status pb_reset(pb_worlds* worlds, int32_t world, uint64_t seed);
/** So many ticks of every world; one that is over stops there and stands still until it is reset.
 */
PB_API pb_status pb_step(pb_worlds* worlds, int32_t ticks);

/** `count`: of doubles, all rows together. */
PB_API pb_status pb_read(pb_worlds* worlds, int32_t array, double* out, size_t count);
/** uint32_t [worlds][robots][PB_BOARD_WORDS] */
PB_API pb_status pb_read_boards(pb_worlds* worlds, uint32_t* out, size_t count);
/** uint64_t [worlds]; equal states have equal hashes: those of `pitchboard-cli simulate`. */
PB_API pb_status pb_read_hashes(pb_worlds* worlds, uint64_t* out, size_t count);
/** A number for a variable of the blackboard, by name: "VISION_BALL_DIST". */
PB_API pb_status pb_find_variable(const char* name, int32_t* variable);
/** double [worlds][robots][variables] */
PB_API pb_status pb_read_variables(pb_worlds* worlds, const int32_t* variables,
                                   size_t variable_count, double* out, size_t count);
/** The same shape. Ints take whole numbers only; NaN leaves what stands there. */
PB_API pb_status pb_write_variables(pb_worlds* worlds, const int32_t* variables,
                                    size_t variable_count, const double* values, size_t count);
/** int32_t [worlds][robots][columns of PB_COMMANDS] */
PB_API pb_status pb_write_commands(pb_worlds* worlds, const int32_t* commands, size_t count);
/** DECISION_ACTION_A: int32_t [worlds][robots] */
PB_API pb_status pb_write_actions(pb_worlds* worlds, const int32_t* actions, size_t count);

/** Moves by hand; what lies outside the walls is moved inside. */
PB_API pb_status pb_place_robot(pb_worlds* worlds, int32_t world, int32_t robot, double x, double y,
                                double yaw);
PB_API pb_status pb_place_ball(pb_worlds* worlds, int32_t world, double x, double y,
                               double velocity_x, double velocity_y);

/** World and blackboards, exactly. What the robots' own processes remember is not part of it: the
 *  same follows where the caller decides for all robots. A snapshot outlives its worlds. */
PB_API pb_status pb_take_snapshot(pb_worlds* worlds, int32_t world, pb_snapshot** snapshot);
/** Into any world (or PB_ALL) of the same scenario. */
PB_API pb_status pb_restore(pb_worlds* worlds, int32_t world, const pb_snapshot* snapshot);
/** Null is fine. */
PB_API pb_status pb_destroy_snapshot(pb_snapshot* snapshot);

/* Many worlds in one call: `which` has the numbers of `count` different worlds. Nothing is changed
 * when one of them is not there. */
/** Each begins anew with its seed. */
PB_API pb_status pb_reset_some(pb_worlds* worlds, const int32_t* which, const uint64_t* seeds,
                               size_t count);
/** All have the state of the snapshot and go on with the noise of their own seeds. */
PB_API pb_status pb_restore_seeded(pb_worlds* worlds, const int32_t* which, const uint64_t* seeds,
                                   size_t count, const pb_snapshot* snapshot);
/** double [count][3]: x, y, yaw of a robot */
PB_API pb_status pb_place_robots(pb_worlds* worlds, const int32_t* which, size_t count,
                                 int32_t robot, const double* poses);
/** double [count][4]: x, y and velocity */
PB_API pb_status pb_place_balls(pb_worlds* worlds, const int32_t* which, size_t count,
                                const double* balls);

/* Rollouts: from a belief many short games, thousands of times faster than real time
 * (docs/rollouts.md). */

/** Fill it with pb_rollout_options_init() first. */
typedef struct pb_rollout_options {
  size_t size;
  const char* scenario; /**< who plays where: built-in name or path of a file; null: "match" */
  const char* text;     /**< a scenario as JSON, in place of a name; null: none */
  const char* noise;    /**< a preset; null: the scenario's */
  int32_t threads;      /**< 1 to 256; results do not depend on it */
  double tick_rate;     /**< per second: 20 as usual, a multiple of 10 up to 120 */
} pb_rollout_options;

/** How long they play. Fill it with pb_play_options_init() first. */
typedef struct pb_play_options {
  size_t size;
  double seconds; /**< 10 as usual; a rollout ends before with a goal or with the ball out */
  double look;    /**< s: "look_x" and "look_y" are the ball's then; 5 as usual */
  int32_t go_on;  /**< 1: a goal or the ball out does not end it */
} pb_play_options;

PB_API pb_status pb_rollout_options_init(pb_rollout_options* options, size_t size);
PB_API pb_status pb_play_options_init(pb_play_options* options, size_t size);
PB_API pb_status pb_rollouts_create(const pb_rollout_options* options, pb_rollouts** rollouts);
/** Waits for calls under way; null is fine. */
PB_API pb_status pb_rollouts_destroy(pb_rollouts* rollouts);
/** Robots, in the order of the scenario. */
PB_API pb_status pb_rollouts_robots(pb_rollouts* rollouts, int32_t* robots);
/** The beginning of the scenario as a belief, to be changed: PB_BELIEF_ROBOTS and PB_BELIEF_GAME.
 */
PB_API pb_status pb_rollouts_beginning(pb_rollouts* rollouts, double* robots, size_t robot_count,
                                       double* game, size_t game_count);
/** One rollout for each seed; the same seed is the same noise. NaN in a belief is what the scenario
 *  begins with. `..._count`: of doubles. */
PB_API pb_status pb_rollouts_play(pb_rollouts* rollouts, const pb_play_options* options,
                                  const double* robots, size_t robot_count, const double* game,
                                  size_t game_count, const uint64_t* seeds, size_t seed_count,
                                  double* outcomes, size_t outcome_count);

#ifdef __cplusplus
}
#endif
