// SPDX-License-Identifier: GPL-3.0-or-later
// Sends variables of a robot: ./pb2_robot ROBOT ADDRESS [PORT]
#include <arpa/inet.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const int robot = std::atoi(argv[1]), port = argc > 3 ? std::atoi(argv[3]) : 1340 + robot;
  const int out = socket(AF_INET, SOCK_DGRAM, 0), yes = 1;
  setsockopt(out, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<unsigned short>(port));
  if (inet_pton(AF_INET, argv[2], &to.sin_addr) != 1) return 2;
  for (unsigned sequence = 0;; ++sequence) {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    const long long ms = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
    char text[1400];  // a whole number, and one with a point
    const int size =
        std::snprintf(text, sizeof text, "PB2 %d %u %lld VOLTAGE=%d IMU_EULER_Z=%#.9g OUT", robot,
                      sequence, ms, 148, 0.5);
    sendto(out, text, static_cast<std::size_t>(size), 0, reinterpret_cast<sockaddr*>(&to),
           sizeof to);
    usleep(50'000);
  }
}
