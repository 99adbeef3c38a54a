// SPDX-License-Identifier: GPL-3.0-or-later
#include <arpa/inet.h>
#include <unistd.h>
#include <chrono>
#include <string>
int main(int, char** argv) {  // ROBOT ADDRESS PORT
  const int out = socket(AF_INET, SOCK_DGRAM, 0);
  const sockaddr_in to{AF_INET, htons(in_port_t(std::stoi(argv[3]))), {inet_addr(argv[2])}, {}};
  for (unsigned sequence = 0;; ++sequence, usleep(50'000)) {
    const auto ms = std::chrono::steady_clock::now().time_since_epoch().count() / 1'000'000;
    const std::string text = "PB2 " + std::string(argv[1]) + " " + std::to_string(sequence) + " " +
                             std::to_string(ms) + " VOLTAGE=" + std::to_string(148) +
                             " IMU_EULER_Z=" + std::to_string(0.5) + " OUT";
    sendto(out, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }
}
