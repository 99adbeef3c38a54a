/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A program in plain C that uses the library as a stranger would: plays a scenario to its end and
 * prints the hash of the last state, then does everything in the wrong order. `capi_user SCENARIO SEED
 * SECONDS`; the exit status is the number of things that were not as promised. */
#include <pitchboard_session.h>
#include <pitchboard_sim.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

static void check(int good, const char *what) {
  if (good) return;
  fprintf(stderr, "FAIL: %s (last error: %s)\n", what, pb_last_error());
  ++failures;
}

static void refused(pb_status status, pb_status expected, const char *what) {
  if (status == expected && strlen(pb_last_error()) > 10) return;
  fprintf(stderr, "FAIL: %s gave %d instead of %d: %s\n", what, (int)status, (int)expected,
          pb_last_error());
  ++failures;
}

/* A shot on its way into the right goal. */
static void rollouts(void) {
  enum { ROLLOUTS = 8 };
  pb_rollout_options options;
  pb_play_options how;
  pb_rollouts *all = NULL;
  int32_t robots = 0;
  uint64_t seeds[ROLLOUTS];
  double goals = 0.0, *poses, *game, *outcomes;
  const size_t columns = pb_column_count(PB_OUTCOMES), wide = pb_column_count(PB_BELIEF_ROBOTS),
               about = pb_column_count(PB_BELIEF_GAME);
  check(pb_rollout_options_init(&options, sizeof options) == PB_OK, "rollout options");
  check(pb_play_options_init(&how, sizeof how) == PB_OK, "play options");
  check(pb_rollouts_create(&options, &all) == PB_OK && all != NULL, "rollouts");
  check(pb_rollouts_robots(all, &robots) == PB_OK && robots == 8, "robots of a match");
  poses = calloc((size_t)robots * wide, sizeof *poses);
  game = calloc(about, sizeof *game);
  outcomes = calloc(ROLLOUTS * columns, sizeof *outcomes);
  check(pb_rollouts_beginning(all, poses, (size_t)robots * wide, game, about) == PB_OK, "belief");
  game[0] = 4.3; /* ball_x */
  game[1] = 0.7; /* ball_y */
  game[4] = 3.0; /* ball_vx */
  for (int i = 0; i < ROLLOUTS; ++i) seeds[i] = (uint64_t)i + 1;
  check(pb_rollouts_play(all, &how, poses, (size_t)robots * wide, game, about, seeds, ROLLOUTS,
                         outcomes, ROLLOUTS * columns) == PB_OK,
        "play");
  for (int i = 0; i < ROLLOUTS; ++i) goals += outcomes[(size_t)i * columns + 3];
  check(goals >= ROLLOUTS / 2, "most shots score");
  refused(pb_rollouts_play(all, &how, poses, 1, game, about, seeds, ROLLOUTS, outcomes,
                           ROLLOUTS * columns),
          PB_INVALID_ARGUMENT, "a belief that is too short");
  check(pb_rollouts_destroy(all) == PB_OK, "destroy rollouts");
  refused(pb_rollouts_robots(all, &robots), PB_STALE_HANDLE, "rollouts that were destroyed");
  free(poses);
  free(game);
  free(outcomes);
}

static void play(const char *scenario, uint64_t seed, double seconds) {
  pb_options options;
  pb_worlds *worlds = NULL;
  pb_shape shape;
  uint64_t hash = 0;
  double *game = NULL;
  size_t columns = pb_column_count(PB_GAME);
  check(pb_options_init(&options, sizeof options) == PB_OK, "options");
  options.scenario = scenario;
  options.has_seed = 1;
  options.seed = seed;
  options.duration = seconds;
  check(pb_create(&options, &worlds) == PB_OK && worlds != NULL, "create");
  shape.size = sizeof shape;
  check(pb_get_shape(worlds, &shape) == PB_OK && shape.worlds == 1, "shape");
  check(pb_step(worlds, (int32_t)(2 * seconds * shape.tick_rate)) == PB_OK, "step");
  game = calloc(columns, sizeof *game);
  check(pb_read(worlds, PB_GAME, game, columns) == PB_OK, "game");
  check(strcmp(pb_column_name(PB_GAME, 0), "tick") == 0 && game[0] == seconds * shape.tick_rate,
        "it stopped when the scenario was over");
  check(pb_read_hashes(worlds, &hash, 1) == PB_OK, "hash");
  printf("0x%016" PRIx64 "\n", hash);
  check(pb_destroy(worlds) == PB_OK, "destroy");
  refused(pb_step(worlds, 1), PB_STALE_HANDLE, "stepping what was destroyed");
  refused(pb_destroy(worlds), PB_STALE_HANDLE, "destroying twice");
  free(game);
}

static void wrongCalls(void) {
  pb_options options;
  pb_worlds *worlds = NULL;
  pb_snapshot *snapshot = NULL;
  pb_shape shape = {0};
  double values[4] = {0};
  int32_t number = 0;
  uint32_t word = 0;
  uint64_t hash = 0;
  const int32_t nonsense = 100000;
  refused(pb_options_init(NULL, sizeof options), PB_INVALID_ARGUMENT, "no options");
  refused(pb_options_init(&options, 3), PB_INVALID_ARGUMENT, "options of another size");
  memset(&options, 0, sizeof options);
  refused(pb_create(&options, &worlds), PB_INVALID_ARGUMENT, "options that were not initialized");
  refused(pb_create(NULL, &worlds), PB_INVALID_ARGUMENT, "no options to create from");
  pb_options_init(&options, sizeof options);
  refused(pb_create(&options, NULL), PB_INVALID_ARGUMENT, "no place for the worlds");
  options.scenario = "no-such-scenario";
  refused(pb_create(&options, &worlds), PB_NOT_FOUND, "no such scenario");
  options.scenario = NULL;
  options.text = "{\"version\": 1, \"robots\": 5}";
  refused(pb_create(&options, &worlds), PB_PARSE_ERROR, "a scenario that is none");
  options.text = NULL;
  options.worlds = 0;
  refused(pb_create(&options, &worlds), PB_INVALID_ARGUMENT, "no worlds");
  options.worlds = 2;
  options.threads = 100000;
  refused(pb_create(&options, &worlds), PB_INVALID_ARGUMENT, "too many threads");
  options.threads = 1;
  options.noise = "loud";
  refused(pb_create(&options, &worlds), PB_NOT_FOUND, "no such noise");
  options.noise = NULL;
  options.duration = -1;
  refused(pb_create(&options, &worlds), PB_INVALID_ARGUMENT, "a negative duration");
  options.duration = 0;
  check(worlds == NULL, "a create that failed leaves null");
  check(pb_create(&options, &worlds) == PB_OK, "create after failures");

  refused(pb_get_shape(worlds, &shape), PB_INVALID_ARGUMENT, "a shape without its size");
  refused(pb_step(NULL, 1), PB_INVALID_ARGUMENT, "stepping null");
  refused(pb_step((pb_worlds *)&options, 1), PB_STALE_HANDLE, "stepping something else");
  refused(pb_step(worlds, 0), PB_INVALID_ARGUMENT, "no ticks");
  refused(pb_step(worlds, -5), PB_INVALID_ARGUMENT, "ticks backwards");
  refused(pb_reset(worlds, 2, 1), PB_NOT_FOUND, "resetting a world that is not there");
  refused(pb_reset(worlds, -2, 1), PB_NOT_FOUND, "resetting world -2");
  refused(pb_read(worlds, PB_PERCEPTS, values, 4), PB_INVALID_ARGUMENT, "too small an array");
  refused(pb_read(worlds, PB_PERCEPTS, NULL, 96), PB_INVALID_ARGUMENT, "no array");
  refused(pb_read(worlds, 17, values, 4), PB_INVALID_ARGUMENT, "an unknown array");
  refused(pb_read_boards(worlds, &word, 1), PB_INVALID_ARGUMENT, "too small for blackboards");
  refused(pb_read_hashes(worlds, &hash, 1), PB_INVALID_ARGUMENT, "too small for hashes");
  refused(pb_robot_ids(worlds, &number, 3), PB_INVALID_ARGUMENT, "too many robots");
  refused(pb_find_variable("VISION_BAL_DIST", &number), PB_NOT_FOUND, "a variable nobody has");
  refused(pb_find_variable(NULL, &number), PB_INVALID_ARGUMENT, "a variable without a name");
  refused(pb_read_variables(worlds, &nonsense, 1, values, 2), PB_INVALID_ARGUMENT, "variable 100000");
  refused(pb_read_variables(worlds, NULL, 1, values, 2), PB_INVALID_ARGUMENT, "no variables");
  refused(pb_read_variables(worlds, &number, (size_t)-1, values, 2), PB_INVALID_ARGUMENT,
          "endless variables");
  refused(pb_write_variables(worlds, &number, 1, values, 3), PB_INVALID_ARGUMENT, "wrong shape");
  refused(pb_write_commands(worlds, NULL, 12), PB_INVALID_ARGUMENT, "no commands");
  refused(pb_write_actions(worlds, &number, 1), PB_INVALID_ARGUMENT, "too few actions");
  refused(pb_set_behaviour(worlds, 1, "goalscorer"), PB_NOT_FOUND, "an unknown behaviour");
  refused(pb_set_behaviour(worlds, 9, "none"), PB_NOT_FOUND, "a robot that is not there");
  refused(pb_set_behaviour(worlds, 1, NULL), PB_INVALID_ARGUMENT, "no behaviour");
  refused(pb_place_robot(worlds, 0, 9, 0, 0, 0), PB_NOT_FOUND, "placing nobody");
  refused(pb_place_ball(worlds, PB_ALL, values[0] / values[1], 0, 0, 0), PB_INVALID_ARGUMENT,
          "a ball at no number");
  refused(pb_take_snapshot(worlds, PB_ALL, &snapshot), PB_INVALID_ARGUMENT, "a snapshot of all");
  refused(pb_take_snapshot(worlds, 0, NULL), PB_INVALID_ARGUMENT, "nowhere to put it");
  refused(pb_restore(worlds, 0, NULL), PB_INVALID_ARGUMENT, "restoring null");
  refused(pb_restore(worlds, 0, (pb_snapshot *)&options), PB_STALE_HANDLE, "restoring something else");
  check(pb_column_name(PB_GAME, 1000) == NULL && pb_column_name(-1, 0) == NULL, "no such column");
  check(pb_column_count(99) == 0, "no such array");
  check(pb_destroy(NULL) == PB_OK && pb_destroy_snapshot(NULL) == PB_OK, "null may be destroyed");
  check(pb_take_snapshot(worlds, 0, &snapshot) == PB_OK, "snapshot");
  check(pb_destroy(worlds) == PB_OK, "destroy with a snapshot");
  check(pb_destroy_snapshot(snapshot) == PB_OK, "the snapshot outlives its worlds");
  refused(pb_destroy_snapshot(snapshot), PB_STALE_HANDLE, "destroying a snapshot twice");
}

int main(int argc, char **argv) {
  check(pb_api_version() == PB_API_VERSION, "the library is that of the header");
  rollouts();
  if (argc == 4) play(argv[1], strtoull(argv[2], NULL, 10), strtod(argv[3], NULL));
  wrongCalls();
  return failures;
}
