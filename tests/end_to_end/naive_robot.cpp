// SPDX-License-Identifier: GPL-3.0-or-later
// Plays the naive behaviour through a robot's blackboard: naive_robot KEY [PERIOD]
#include <sys/ipc.h>
#include <sys/shm.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

enum Int { ActionA = 17, ActionB = 18, Referee = 51, Lost = 57, SearchOn = 58, Working = 104 };
enum Float { BallDist = 17, PanDeg = 66 };

int main(int argc, char** argv) {
  const int segment = shmget(argc > 1 ? std::atoi(argv[1]) : 100, 2048, 0600);
  if (segment < 0) {
    std::perror("no blackboard: start the simulator first");
    return 1;
  }
  void* const memory = shmat(segment, nullptr, 0);
  auto* const ints = static_cast<volatile int*>(memory);
  auto* const floats = static_cast<volatile float*>(memory) + 125;
  const std::chrono::duration<double> period(argc > 2 ? std::atof(argv[2]) : 0.25);
  while (true) {
    const int bearing = static_cast<int>(floats[PanDeg]);  // degrees, left positive
    const float distance = floats[BallDist];               // cm
    int action = 0;                                        // stand still
    if (ints[Referee] == 2 && ints[Lost] == 1) {
      ints[SearchOn] = 1;
      action = 3;  // turn to find the ball
    } else if (ints[Referee] == 2 && std::abs(bearing) > 40 && std::abs(bearing) < 160) {
      action = bearing > 0 ? 2 : 3;  // turn left, right
    } else if (ints[Referee] == 2 && distance < 25) {
      action = bearing > 0 ? 5 : 4;  // kick left, right
    } else if (ints[Referee] == 2) {
      ints[ActionB] = static_cast<int>(distance / 5);  // how fast, before the action
      action = 8;                                      // walk forward
    }
    ints[ActionA] = action;
    ints[Working] = 1;  // still alive
    std::this_thread::sleep_for(period);
  }
}
