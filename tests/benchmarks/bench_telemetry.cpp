// SPDX-License-Identifier: GPL-3.0-or-later
// How fast telemetry is taken in: the decoder alone, the team's book-keeping, the referee's
// packets, and a real socket on 127.0.0.1 under the load of 16 senders (docs/live.md).

#include <benchmark/benchmark.h>
#include <array>
#include <atomic>
#include <cstring>
#include <fstream>
#include <thread>

#include <telemetry/monitor/team_monitor.h>
#include <telemetry/referee/gamecontroller.h>
#include <telemetry/sockets/udp_receiver.h>

#include "../support/test_socket.h"

namespace {

using namespace pitchboard::telemetry;
using namespace std::chrono_literals;

constexpr std::array<std::string_view, 4> messages{
    "1 258 448 -8 56.3184547424 184.634048462 41.0279350281 1 1 1 1 1 8 0.0578468590975 189 OUT",
    "1 271 451 2 51.9856109619 180.622802734 38.4158439636 1 1 1 1 1 8 0.120696738362 189 OUT",
    "1 287 487 3 63.280544281 174.693557739 39.975063324 1 1 1 1 1 8 0.120715364814 189 OUT",
    "1 301 496 4 61.1415328979 170.703674316 38.4072303772 1 1 1 1 1 2 0.167827829719 189 OUT"};

void decodeText(benchmark::State& state) {
  const TextDecoder decoder;
  auto decoded = std::make_unique<DecodedText>();
  std::size_t i = 0;
  for (auto _ : state) {
    decoder.decode(messages[i++ % messages.size()], *decoded);
    benchmark::DoNotOptimize(decoded->values);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(decodeText);

void takeIntoTeam(benchmark::State& state) {
  TeamMonitor monitor;
  WallTime now{1'700'000'000s};
  std::size_t i = 0;
  for (auto _ : state) {
    now += 10ms;
    benchmark::DoNotOptimize(
        monitor.take({now, {{0x7f000001}, 5000}, 1241, false, messages[i++ % messages.size()]}));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(takeIntoTeam);

void decodeRefereePacket(benchmark::State& state) {
  std::string bytes(688, '\0');
  std::memcpy(bytes.data(), "RGme\x0c", 5);
  for (auto _ : state) benchmark::DoNotOptimize(decodeReferee(bytes));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(decodeRefereePacket);

/// Sends at a steady rate from 16 sockets to the 16 ports, until `stop`.
std::uint64_t sendLoad(const std::vector<std::uint16_t>& ports, int perSecond,
                       std::chrono::seconds duration) {
  const std::vector<TestSocket> sockets(ports.size());
  std::uint64_t sent = 0;
  const auto begin = std::chrono::steady_clock::now();
  constexpr auto slice = 2ms;
  const int perSlice = perSecond / 500;
  for (auto next = begin; next < begin + duration; next += slice) {
    std::this_thread::sleep_until(next);
    for (int i = 0; i < perSlice; ++i) {
      const std::size_t robot = sent % ports.size();
      char text[128];
      const int length =
          std::snprintf(text, sizeof text, "%zu %llu%s", robot + 1,
                        static_cast<unsigned long long>(sent % 1000), messages[0].data() + 5);
      sent += sockets[robot].send(ports[robot], {text, static_cast<std::size_t>(length)}) ? 1 : 0;
    }
  }
  return sent;
}

long residentKib() {
  std::ifstream statm("/proc/self/statm");
  long total = 0, resident = 0;
  statm >> total >> resident;
  return resident * 4;
}

void loopbackLoad(benchmark::State& state) {
  const auto perSecond = static_cast<int>(state.range(0));
  ReceiverOptions options;
  options.bind = {INADDR_LOOPBACK};
  options.ports.assign(16, 0);
  for (auto _ : state) {
    auto receiver = UdpReceiver::start(options);
    std::vector<std::uint16_t> ports;
    for (const PortStatus& port : (*receiver)->status().ports) ports.push_back(port.port);
    TeamMonitor monitor;
    std::uint64_t taken = 0;
    long residentEarly = 0;
    std::atomic<std::uint64_t> sent = 0;
    std::atomic<bool> done = false;
    std::thread sender([&] {
      sent = sendLoad(ports, perSecond, 10s);
      done = true;
    });
    DatagramBatch batch;
    // Taken 60 times a second, as a window does, so that the queue really fills.
    for (bool last = false; !last;) {
      last = done;
      std::this_thread::sleep_for(16ms);
      (*receiver)->take(batch);
      for (std::size_t i = 0; i < batch.size(); ++i) monitor.take(batch[i]);
      taken += batch.size();
      if (residentEarly == 0 && taken > static_cast<std::uint64_t>(perSecond))
        residentEarly = residentKib();
    }
    sender.join();
    const ReceiverStatus status = (*receiver)->status();
    state.counters["sent"] = static_cast<double>(sent);
    state.counters["taken"] = static_cast<double>(taken);
    state.counters["kernelDrops"] = static_cast<double>(status.kernelDrops());
    state.counters["queueDrops"] = static_cast<double>(status.queueDrops);
    state.counters["bad"] = static_cast<double>(monitor.status({}).errors.messages());
    state.counters["grownKiB"] = static_cast<double>(residentKib() - residentEarly);
  }
}
BENCHMARK(loopbackLoad)
    ->Arg(50'000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
