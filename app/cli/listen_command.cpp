// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <map>
#include <memory>

#include <robotlink/live/live_teams.h>
#include <telemetry/wire/monitor_request.h>
#include <telemetry/wire/team_monitor.h>
#include <telemetry/wire/udp_receiver.h>

#include "commands.h"
#include "interrupt.h"
#include "listen_options.h"
#include "live_json.h"

namespace pitchboard::cli {
namespace {

using namespace telemetry;

struct Options {
  ListenOptions network;
  std::optional<double> duration;
  std::string monitor;
  bool json = false;
};

/// Prints what arrives.
class Printer {
 public:
  Printer(ListenSetup setup, const ListenOptions& options, bool json)
      : m_monitor(std::move(setup.profile), std::move(setup.monitor)),
        m_referees(std::move(setup.referees)),
        m_refereePort(static_cast<std::uint16_t>(options.refereePort)),
        m_refereeVersion(options.refereeVersion),
        m_json(json) {}

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

  std::string nameOf(const RobotKey& robot) const {
    link::LiveOptions options;
    options.team = m_monitor.options();
    return link::robotName(robot, link::teamsOf(options, m_state ? &*m_state : nullptr));
  }
  TeamStatus status(WallTime now) const { return m_monitor.status(now); }
  std::uint64_t unknownReferee() const { return m_unknownReferee; }
  std::uint64_t refusedReferees() const { return m_refusedReferees; }

  /// How every robot is heard.
  void printHealth(WallTime now) const {
    if (!m_json) return;
    for (const RobotStatus& robot : m_monitor.status(now).robots) {
      std::printf("%s\n", dump(healthJson(robot, nameOf(robot.key), now)).c_str());
    }
    std::fflush(stdout);
  }

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
    const int number = decoded.robot;
    const TeamSetup* team =
        number > 0 ? setupAt(decoded.place, m_monitor.options().teams) : nullptr;
    const std::string title = team != nullptr ? team->title() : std::string();
    Json json;
    if (m_json) {
      json = telemetryJson(decoder, decoded, datagram.payload, number, title);
      if (number > 0) json["name"] = nameOf({decoded.place, number, 0});
    }
    put("telemetry", datagram, json,
        m_json ? std::string() : telemetryLine(decoder, decoded, datagram.payload, number, title));
  }

  void printReferee(const DatagramView& datagram) {
    if (!m_referees.allows(datagram.sender.address)) {
      ++m_refusedReferees;
      return;
    }
    const auto packet = decodeReferee(datagram.payload);
    if (packet) {
      const auto* state = std::get_if<RefereeState>(&*packet);
      if (state && m_refereeVersion != 0 && state->version != m_refereeVersion) return;
      if (state) m_state = *state;
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
  std::optional<RefereeState> m_state;  // the last one
  SenderFilter m_referees;
  std::uint16_t m_refereePort;
  int m_refereeVersion;
  bool m_json;
  std::uint64_t m_unknownReferee = 0, m_refusedReferees = 0;
};

void reportEnd(const ReceiverStatus& network, const Printer& printer, WallTime now) {
  const TeamStatus team = printer.status(now);
  const std::uint64_t unknown = printer.unknownReferee();
  std::fprintf(stderr,
               "%llu datagrams from %zu robots; lost: %llu in the kernel, %llu here; bad: %llu%s",
               static_cast<unsigned long long>(network.datagrams()), team.robots.size(),
               static_cast<unsigned long long>(network.kernelDrops()),
               static_cast<unsigned long long>(network.queueDrops),
               static_cast<unsigned long long>(team.errors.messages() + unknown),
               refusedText(team, printer.refusedReferees()).c_str());
  for (const RobotStatus& robot : team.robots) {
    std::fprintf(stderr, "\n  %s", healthLine(robot, printer.nameOf(robot.key)).c_str());
  }
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

int run(const Options& options) {
  using Clock = std::chrono::steady_clock;
  auto setup = listenSetup(options.network);
  if (!setup) return reportError(setup.error());
  ReceiverOptions& receiver = setup->receiver;
  std::optional<Address> referee;
  if (!options.monitor.empty()) {
    const auto address = parseAddress(options.monitor);
    if (!address) return reportError(address.error());
    referee = *address;
    receiver.ports.push_back(robotStatesPort);
  }

  const InterruptGuard signals;
  const std::vector<std::uint16_t> ports = receiver.ports;
  const auto clock = std::make_shared<const LiveClock>();
  receiver.clock = clock;
  auto network = UdpReceiver::start(std::move(receiver));
  if (!network) return reportError(network.error());
  Printer printer(std::move(*setup), options.network, options.json);
  std::map<std::size_t, std::string> told;
  sayListening(options.network, ports);
  DatagramBatch batch;
  const auto begin = Clock::now();
  auto nextRequest = begin;
  auto nextHealth = begin + std::chrono::seconds(1);
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
    if (Clock::now() >= nextHealth) {
      printer.printHealth(clock->now());
      nextHealth += std::chrono::seconds(1);
    }
  }
  (*network)->stop();
  if ((*network)->take(batch)) printer.print(batch);
  printer.printHealth(clock->now());
  reportEnd((*network)->status(), printer, clock->now());
  return 0;
}

}  // namespace

void addListenCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<Options>();
  CLI::App* command = parent.add_subcommand(
      "listen",
      "Print what robots and the referee send, until Ctrl+C. Sends nothing unless --monitor is "
      "given.\n"
      "Examples: pitchboard-cli listen\n"
      "          pitchboard-cli listen --json --duration 60 > match.jsonl\n"
      "          pitchboard-cli listen --profile our-team.json --from 192.168.0.0/24\n"
      "          pitchboard-cli listen --team ours.json --team theirs.json");
  shared::addDuration(*command, "--duration", options->duration,
                      "Stop after this time; without it until Ctrl+C");
  addListenOptions(*command, options->network);
  command->add_option("--monitor", options->monitor,
                      "Ask the referee at this address for monitor mode (controllers of 2026).\n"
                      "This is the only thing that listen can send, and only to that address");
  command->add_flag("--json", options->json,
                    "One JSON object per message, and how each robot is heard\n"
                    "once a second and at the end (\"type\": \"health\")");
  command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace pitchboard::cli
