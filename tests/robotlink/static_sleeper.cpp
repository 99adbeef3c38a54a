// SPDX-License-Identifier: GPL-3.0-or-later
// A program into which no library can be loaded.
#include <unistd.h>

int main() {
  for (;;) ::sleep(1);
}
