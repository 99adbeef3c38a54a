// SPDX-License-Identifier: GPL-3.0-or-later
// Waits for as many whole seconds as the first argument says in every way that C knows: see every_wait.h.
#define _GNU_SOURCE
#include "every_wait.h"

int main(int count, char** arguments) {
  if (count != 3) return 2;
  begin_ways(arguments[1], arguments[2]);
  run_ways(c_ways, sizeof c_ways / sizeof *c_ways);
  end_ways();
  return 0;
}
