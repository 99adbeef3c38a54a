// SPDX-License-Identifier: GPL-3.0-or-later
// Draws for a robot: ./draw_robot ROBOT ADDRESS PORT
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<unsigned short>(std::atoi(argv[3])));
  inet_pton(AF_INET, argv[2], &to.sin_addr);
  const int out = socket(AF_INET, SOCK_DGRAM, 0);
  for (double turn = 0.0;; turn += 0.1) {
    char text[500];
    const int length = std::snprintf(text, sizeof text,
                                     "PBD1 %s\n"
                                     "layer decision/target\n"
                                     "arrow 0 0 %.2f %.2f\n"
                                     "layer vision/obstacles robot 0.5\n"
                                     "colour red\n"
                                     "disc 1 0.5 0.2\n",
                                     argv[1], 2 * std::cos(turn), 2 * std::sin(turn));
    sendto(out, text, static_cast<std::size_t>(length), 0, reinterpret_cast<sockaddr*>(&to),
           sizeof to);
    usleep(100'000);
  }
}
