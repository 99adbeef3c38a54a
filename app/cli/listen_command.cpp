// SPDX-License-Identifier: GPL-3.0-or-later
#include <condition_variable>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include <base/try.h>
#include <robotlink/live/live_watch.h>
#include <robotlink/session/session_events.h>

#include "commands.h"
#include "interrupt.h"
#include "listen_options.h"
#include "live_json.h"

namespace pitchboard::cli {
namespace {

struct PrintOptions {
  OptionValues network;
  std::optional<double> duration;
  std::string monitor;
  bool json = false;
};

/// Prints what the watch receives. The watch's thread makes the lines, the main thread prints them.
class Printer : public link::LiveObserver {
 public:
  Printer(const link::LiveOptions& options, telemetry::WallTime began, bool json)
      : m_options(options), m_began(began), m_json(json) {}

  void received(const link::LiveDatagram& datagram) override {
    const auto* state = datagram.state();
    const int version = m_options.refereeVersion;
    if (datagram.isFromRefusedSender() || (state && version != 0 && state->version != version))
      return;
    if (!m_json) {
      std::string line;
      addMessageLine(line, datagram, m_options);
      put(datagram.view.time, datagram.view.sender.text(), line);
      return;
    }
    std::string line;
    addMessageJson(line,
                   {{"type", typeOf(datagram)},
                    {"time", unixSeconds(datagram.view.time)},
                    {"sender", datagram.view.sender.text()},
                    {"port", datagram.view.localPort},
                    {"bytes", datagram.view.payload.size()}},
                   datagram, m_options);
    put(line + "\n");
  }

  void decoded(const link::LiveTopicMessage& message) override {
    if (m_json) return put(dump(topicJson(message)) + "\n");
    put(message.arrival, message.source.address.text(), topicLine(message));
  }

  void happened(const link::MatchEvent& event) override {
    const auto after = std::chrono::duration<double>(event.time);
    const auto time = m_began + std::chrono::duration_cast<telemetry::Duration>(after);
    const telemetry::SessionEvent reported = link::sessionEvent(event);
    if (!m_json) return put(time, "event", reported.text);
    put(dump({{"type", "event"},
              {"time", unixSeconds(time)},
              {"kind", reported.kind},
              {"name", reported.group},
              {"text", reported.text}}) +
        "\n");
  }

  /// Prints what has arrived, or waits for it for this time. Returns false once the reader has
  /// closed the pipe.
  bool print(telemetry::Duration wait) {
    std::unique_lock lock(m_mutex);
    m_come.wait_for(lock, wait, [this] { return !m_lines.empty(); });
    const std::string lines = std::exchange(m_lines, {});
    lock.unlock();
    std::fwrite(lines.data(), 1, lines.size(), stdout);
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  }

  /// Prints the link of every robot.
  void printHealth(const link::LiveDetails& details) {
    if (!m_json) return;
    for (const telemetry::RobotStatus& robot : details.team.robots) {
      put(dump(healthJson(robot, nameOf(robot.key, details.teams), details.team.time)) + "\n");
    }
    for (const link::SentStatus& sent : details.sent) {
      put(dump(healthJson(sent, details.team.time)) + "\n");
    }
    for (const link::TopicSourceStatus& source : details.topics) {
      put(dump(healthJson(source, details.team.time)) + "\n");
    }
  }

  /// Datagrams and events that came faster than they could be printed.
  std::uint64_t left() const {
    const std::lock_guard lock(m_mutex);
    return m_left;
  }

 private:
  static constexpr std::size_t maxBytes = std::size_t{64} << 20;  // waiting

  void put(telemetry::WallTime time, const std::string& sender, const std::string& line) {
    char head[64];
    std::snprintf(head, sizeof head, "%.6f %-21s ", unixSeconds(time), sender.c_str());
    put(head + line + "\n");
  }

  void put(const std::string& line) {
    {
      const std::lock_guard lock(m_mutex);
      if (m_lines.size() + line.size() > maxBytes) {
        ++m_left;
        return;
      }
      m_lines += line;
    }
    m_come.notify_one();
  }

  const link::LiveOptions m_options;
  const telemetry::WallTime m_began;
  const bool m_json;
  mutable std::mutex m_mutex;  // of what follows
  std::condition_variable m_come;
  std::string m_lines;
  std::uint64_t m_left = 0;
};

void reportEnd(const link::LiveDetails& details, std::uint64_t left) {
  const telemetry::TeamStatus& team = details.team;
  const telemetry::ReceiverStatus& network = details.network;
  const std::uint64_t here = network.queueDrops + left;
  std::set<RobotKey> robots;
  for (const telemetry::RobotStatus& robot : team.robots) robots.insert(robot.key);
  for (const link::SentStatus& sent : details.sent) robots.insert(sent.robot);
  const std::uint64_t bad = team.errors.messages() + details.unknownReferee + details.badVariables;
  std::fprintf(
      stderr, "%llu datagram%s from %zu robot%s; lost: %llu in the kernel, %llu here; bad: %llu%s",
      static_cast<unsigned long long>(network.datagrams()), network.datagrams() == 1 ? "" : "s",
      robots.size(), robots.size() == 1 ? "" : "s",
      static_cast<unsigned long long>(network.kernelDrops()), static_cast<unsigned long long>(here),
      static_cast<unsigned long long>(bad), refusedText(details).c_str());
  for (const telemetry::RobotStatus& robot : team.robots) {
    std::fprintf(stderr, "\n  %s", healthLine(robot, nameOf(robot.key, details.teams)).c_str());
  }
  for (const link::SentStatus& sent : details.sent) {
    std::fprintf(stderr, "\n  %s", healthLine(sent).c_str());
  }
  for (const link::TopicSourceStatus& source : details.topics) {
    std::fprintf(stderr, "\n  %s", healthLine(source).c_str());
  }
  if (details.badVariables > 0) {
    std::fprintf(stderr, "\n  variables that could not be read: %llu, e.g. %s",
                 static_cast<unsigned long long>(details.badVariables),
                 details.badVariablesReason.c_str());
  }
  for (std::size_t i = 0; i < telemetry::textErrorCount; ++i) {
    const auto error = static_cast<telemetry::TextError>(i);
    if (team.errors.count(error) == 0) continue;
    std::fprintf(stderr, "\n  %s: %llu, e.g. %s", std::string(errorText(error)).c_str(),
                 static_cast<unsigned long long>(team.errors.count(error)),
                 team.errors.sample(error).c_str());
  }
  if (details.unknownReferee > 0) {
    std::fprintf(stderr, "\n  unknown packets on the referee's port: %llu",
                 static_cast<unsigned long long>(details.unknownReferee));
  }
  std::fputc('\n', stderr);
}

Result<int> listenToRobots(const PrintOptions& options) {
  using Clock = std::chrono::steady_clock;
  using std::chrono::milliseconds;
  link::LiveOptions live = TRY(liveOptions(options.network));
  if (!options.monitor.empty()) live.monitor = TRY(telemetry::parseAddress(options.monitor));

  const InterruptGuard signals;
  link::LiveWatch watch(live);
  const link::LiveDetails begun = TRY(whenListening(watch));
  const auto printer = std::make_shared<Printer>(live, watch.began(), options.json);
  watch.observe(printer);
  reportListening(live, begun.network);
  std::map<std::size_t, std::string> reported;
  std::map<std::string, std::string> reportedSources;
  const auto begin = Clock::now();
  auto nextLook = begin, nextHealth = begin + std::chrono::seconds(1);
  const std::chrono::duration<double> limit(options.duration.value_or(0.0));
  while (!interrupted) {
    const auto now = Clock::now();
    if (now >= nextLook) {
      nextLook = now + milliseconds(100);
      const link::LiveDetails details = watch.details();
      reportPorts(details, reported);
      reportSources(details, reportedSources);
      if (!details.monitorProblem.empty()) {
        return failure(ErrorCode::SystemError, details.monitorProblem);
      }
      if (now >= nextHealth) {
        nextHealth += std::chrono::seconds(1);
        printer->printHealth(details);
      }
    }
    telemetry::Duration wait = milliseconds(100);
    if (options.duration) {
      const auto left = std::chrono::duration_cast<telemetry::Duration>(limit - (now - begin));
      if (left <= telemetry::Duration::zero()) break;
      wait = std::min(wait, left);
    }
    if (!printer->print(wait)) break;
  }
  watch.stopObserving(printer);
  const link::LiveDetails details = watch.details();
  printer->printHealth(details);
  printer->print({});
  reportEnd(details, printer->left());
  return 0;
}

}  // namespace

void addListenCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<PrintOptions>();
  CLI::App* command = parent.add_subcommand(
      "listen",
      "Print what robots and the referee send, until Ctrl+C. Sends nothing unless --monitor is "
      "given.\n"
      "Examples: pitchboard-cli listen\n"
      "          pitchboard-cli listen --json --duration 60 > match.jsonl\n"
      "          pitchboard-cli listen --profile our-team.json --from 192.168.0.0/24\n"
      "          pitchboard-cli listen --team ours.json --team theirs.json\n"
      "          pitchboard-cli listen --foxglove ws://robot3:8765");
  shared::addDuration(*command, "--duration", options->duration,
                      "Stop after this time instead of at Ctrl+C");
  addListenOptions(*command, options->network);
  command
      ->add_option(
          "--monitor", options->monitor,
          "Ask the GameController (2026) at this address for monitor mode: the only thing that "
          "listen can send")
      ->type_name("ADDRESS");
  command->add_flag(
      "--json", options->json,
      "Print one JSON object per message, and the health of each link once a second and at "
      "the end (\"type\": \"health\")");
  whenChosen(*command, options, exitCode, listenToRobots);
}

}  // namespace pitchboard::cli
