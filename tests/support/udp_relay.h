// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A bad wireless network on 127.0.0.1: passes datagrams on, loses some, sends some twice, holds
// some back so that later ones overtake them, and can fail altogether.

#include <atomic>
#include <chrono>
#include <map>
#include <random>
#include <string>
#include <thread>

#include <poll.h>

#include "test_socket.h"

class UdpRelay {
 public:
  struct Network {
    double loss = 0.0, twice = 0.0, late = 0.0;  ///< shares of the datagrams
    std::chrono::milliseconds lateness{200};     ///< at most
    std::int64_t clockAhead = 0;  ///< ms, added to the time in each PB2: another robot's clock
  };

  UdpRelay(std::uint16_t to, const Network& network)
      : m_to(to),
        m_network(network),
        m_thread([this](const std::stop_token& stop) { run(stop); }) {}

  std::uint16_t port() const { return m_in.port(); }
  /// How many datagrams have come in, whether they were passed on or not.
  int received() const { return m_received; }
  /// Nothing passes.
  void fail(bool fails) { m_fails = fails; }
  /// Everything passes at once and in order.
  void heal() { m_heals = true; }

 private:
  using Clock = std::chrono::steady_clock;

  void run(const std::stop_token& stop) {
    std::mt19937 random(28);
    const auto chance = [&random](double share) {
      return std::bernoulli_distribution(share)(random);
    };
    std::multimap<Clock::time_point, std::string> held;
    while (!stop.stop_requested()) {
      pollfd ready{m_in.descriptor(), POLLIN, 0};
      poll(&ready, 1, held.empty() ? 20 : 1);
      for (std::string text = m_in.take(); !text.empty(); text = m_in.take()) {
        ++m_received;
        if (m_fails) continue;
        shiftClock(text);
        const auto now = Clock::now();
        if (m_heals) {
          held.emplace(now, text);
          continue;
        }
        if (chance(m_network.loss)) continue;
        std::uniform_int_distribution<long> wait(1, m_network.lateness.count());
        const auto due = now + (chance(m_network.late) ? std::chrono::milliseconds(wait(random))
                                                       : 0 * m_network.lateness);
        held.emplace(due, text);
        if (chance(m_network.twice)) held.emplace(due, text);
      }
      while (!held.empty() && held.begin()->first <= Clock::now()) {
        if (!m_fails) (void)m_out.send(m_to, held.begin()->second);
        held.erase(held.begin());
      }
    }
  }

  /// PB2 ROBOT SEQUENCE MILLISECONDS ...
  void shiftClock(std::string& text) const {
    if (m_network.clockAhead == 0) return;
    std::size_t begin = 0;
    for (int word = 0; word < 3; ++word) begin = text.find(' ', begin) + 1;
    const std::size_t end = text.find(' ', begin);
    const std::int64_t sent = std::stoll(text.substr(begin, end - begin)) + m_network.clockAhead;
    text.replace(begin, end - begin, std::to_string(sent));
  }

  const std::uint16_t m_to;
  const Network m_network;
  TestSocket m_in, m_out;
  std::atomic<int> m_received = 0;
  std::atomic<bool> m_fails = false, m_heals = false;
  std::jthread m_thread;  // last: it uses all of the above
};
