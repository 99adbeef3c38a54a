// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/monitor_request.h>
#include <telemetry/team_monitor.h>
#include <telemetry/udp_receiver.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <map>
#include <memory>

#include "commands.h"
#include "live_json.h"

namespace pitchboard::cli {
namespace {

using namespace telemetry;

struct Options {
  std::optional<double> duration;
  std::string bind = "0.0.0.0";
  int portBase = 1240;
  int robots = 16;
  int refereePort = 3838;
  std::string profile;
  std::vector<std::string> senders;
  std::string monitor;
  bool json = false;
};

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

/// Ends the loop on SIGINT and SIGTERM, and puts back what was there before.
class SignalGuard {
 public:
  SignalGuard() {
    interrupted = false;
    struct sigaction action {};
    action.sa_handler = [](int) { interrupted = true; };
    sigaction(SIGINT, &action, &m_int);
    sigaction(SIGTERM, &action, &m_term);
  }
  ~SignalGuard() {
    sigaction(SIGINT, &m_int, nullptr);
    sigaction(SIGTERM, &m_term, nullptr);
  }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  struct sigaction m_int {}, m_term {};
};

/// Prints what arrives.
class Printer {
 public:
  Printer(TeamMonitor monitor, std::uint16_t refereePort, bool json)
      : m_monitor(std::move(monitor)), m_refereePort(refereePort), m_json(json) {}

  /// False when nobody reads the output any more.
  bool print(const DatagramBatch& batch) {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const DatagramView datagram = batch[i];
      if (datagram.localPort == m_refereePort || datagram.localPort == robotStatesPort) {
        printReferee(datagram);
      } else {
        printTelemetry(datagram);
      }
    }
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  }

  TeamStatus status(WallTime now) const { return m_monitor.status(now); }
  std::uint64_t unknownReferee() const { return m_unknownReferee; }

 private:
  void put(const char* type, const DatagramView& datagram, const Json& body,
           const std::string& line) {
    if (!m_json) {
      std::printf("%.6f %-21s %s\n", unixSeconds(datagram.time), datagram.sender.text().c_str(),
                  line.c_str());
      return;
    }
    Json json{{"type", type},
              {"time", unixSeconds(datagram.time)},
              {"sender", datagram.sender.text()},
              {"port", datagram.localPort},
              {"bytes", datagram.payload.size()}};
    json.update(body);
    std::printf("%s\n", dump(json).c_str());
  }

  void printTelemetry(const DatagramView& datagram) {
    const auto verdict = m_monitor.take(datagram);
    if (verdict == TeamMonitor::Verdict::SenderRefused) return;
    const TextDecoder& decoder = m_monitor.decoder();
    const DecodedText& decoded = m_monitor.decoded();
    put("telemetry", datagram,
        m_json ? telemetryJson(decoder, decoded, datagram.payload) : Json(),
        m_json ? std::string() : telemetryLine(decoder, decoded, datagram.payload));
  }

  void printReferee(const DatagramView& datagram) {
    if (!m_monitor.options().senders.allows(datagram.sender.address)) return;
    const auto packet = decodeReferee(datagram.payload);
    if (packet) {
      put("referee", datagram, m_json ? refereeJson(*packet) : Json(),
          m_json ? std::string() : refereeLine(*packet));
      return;
    }
    ++m_unknownReferee;
    put("referee", datagram,
        Json{{"error", packet.error().message}, {"text", printable(datagram.payload)}},
        "[" + packet.error().message + "]");
  }

  TeamMonitor m_monitor;
  std::uint16_t m_refereePort;
  bool m_json;
  std::uint64_t m_unknownReferee = 0;
};

/// Says on stderr which ports are not received, once for each change.
void reportPorts(const ReceiverStatus& status, std::map<std::size_t, std::string>& told) {
  for (std::size_t i = 0; i < status.ports.size(); ++i) {
    const PortStatus& port = status.ports[i];
    std::string& last = told[i];
    if (port.problem == last) continue;
    if (port.bound) {
      std::fprintf(stderr, "port %d is received now\n", port.port);
    } else {
      std::fprintf(stderr, "warning: %s It is tried again; the other ports work.\n",
                   port.problem.c_str());
    }
    last = port.problem;
  }
}

void reportEnd(const ReceiverStatus& network, const TeamStatus& team, std::uint64_t unknown) {
  std::fprintf(stderr, "%llu datagrams from %zu robots; lost: %llu in the kernel, %llu here; bad: %llu",
               static_cast<unsigned long long>(network.datagrams()), team.robots.size(),
               static_cast<unsigned long long>(network.kernelDrops()),
               static_cast<unsigned long long>(network.queueDrops + team.refusedRobots),
               static_cast<unsigned long long>(team.errors.total() + unknown));
  for (std::size_t i = 0; i < textErrorCount; ++i) {
    const auto error = static_cast<TextError>(i);
    if (team.errors.count(error) == 0) continue;
    std::fprintf(stderr, "\n  %s: %llu, e.g. %s", std::string(errorWords(error)).c_str(),
                 static_cast<unsigned long long>(team.errors.count(error)),
                 team.errors.sample(error).c_str());
  }
  if (unknown > 0) {
    std::fprintf(stderr, "\n  unknown packets on the referee's port: %llu",
                 static_cast<unsigned long long>(unknown));
  }
  std::fputc('\n', stderr);
}

WallTime wallNow() {
  return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
}

int run(const Options& options) {
  using Clock = std::chrono::steady_clock;
  ReceiverOptions receiver;
  const auto bind = parseAddress(options.bind);
  if (!bind) return reportError(bind.error());
  receiver.bind = *bind;
  auto ports = livePorts(options.portBase, options.robots, options.refereePort);
  if (!ports) return reportError(ports.error());
  receiver.ports = std::move(*ports);
  Profile profile = publishedProfile();
  if (!options.profile.empty()) {
    auto loaded = loadProfile(options.profile);
    if (!loaded) return reportError(loaded.error());
    profile = std::move(*loaded);
  }
  MonitorOptions monitor;
  for (const std::string& sender : options.senders) {
    if (const auto added = monitor.senders.add(sender); !added) return reportError(added.error());
  }
  std::optional<Address> referee;
  if (!options.monitor.empty()) {
    const auto address = parseAddress(options.monitor);
    if (!address) return reportError(address.error());
    referee = *address;
    receiver.ports.push_back(robotStatesPort);
  }

  const SignalGuard signals;
  auto network = UdpReceiver::start(std::move(receiver));
  if (!network) return reportError(network.error());
  Printer printer(TeamMonitor(std::move(profile), std::move(monitor)),
                  static_cast<std::uint16_t>(options.refereePort), options.json);
  std::map<std::size_t, std::string> told;
  std::fprintf(stderr, "listening at %s on UDP ports %d to %d and %d\n", options.bind.c_str(),
               options.portBase + 1, options.portBase + options.robots, options.refereePort);
  DatagramBatch batch;
  const auto begin = Clock::now();
  auto nextRequest = begin;
  const std::chrono::duration<double> limit(options.duration.value_or(0.0));
  while (!interrupted) {
    reportPorts((*network)->status(), told);
    if (referee && Clock::now() >= nextRequest) {
      if (const auto sent = sendMonitorRequest(*referee); !sent) return reportError(sent.error());
      nextRequest = Clock::now() + std::chrono::seconds(1);
    }
    Duration wait = std::chrono::milliseconds(100);
    if (options.duration) {
      const auto left = std::chrono::duration_cast<Duration>(limit - (Clock::now() - begin));
      if (left <= Duration::zero()) break;
      wait = std::min(wait, left);
    }
    if ((*network)->take(batch, wait) && !printer.print(batch)) break;
  }
  (*network)->stop();
  if ((*network)->take(batch)) printer.print(batch);
  reportEnd((*network)->status(), printer.status(wallNow()), printer.unknownReferee());
  return 0;
}

}  // namespace

void addListenCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<Options>();
  CLI::App* command = parent.add_subcommand(
      "listen",
      "Print what robots and the referee send, until Ctrl+C. Sends nothing unless --monitor is given.\n"
      "Examples: pitchboard-cli listen\n"
      "          pitchboard-cli listen --json --duration 60 > match.jsonl\n"
      "          pitchboard-cli listen --profile our-team.json --from 192.168.0.0/24");
  command->add_option("--duration", options->duration, "Seconds; without it until Ctrl+C")
      ->check(CLI::Range(0.0, 1e9));
  command->add_option("--bind", options->bind,
                      "Address to receive at; 0.0.0.0 is every interface, with broadcasts")
      ->capture_default_str();
  command->add_option("--port-base", options->portBase, "Robot n sends to port base + n")
      ->capture_default_str();
  command->add_option("--robots", options->robots, "How many ports after the base")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command->add_option("--gamecontroller-port", options->refereePort, "Port of the referee's packets")
      ->capture_default_str();
  command->add_option("--profile", options->profile, "Order of the fields as JSON (docs/LIVE.md)");
  command->add_option("--from", options->senders,
                      "Only these senders: address or network, may be repeated");
  command->add_option("--monitor", options->monitor,
                      "Ask the referee at this address for monitor mode (controllers of 2026).\n"
                      "This is the only thing that listen can send, and only to that address");
  command->add_flag("--json", options->json, "One JSON object per message");
  command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace pitchboard::cli
