// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as the short texts that people type and processes send: an expression, senders that are
// heard, a blackboard to attach to, cognition debug data, a message between reference robots, what
// an advisor has learned of the opponents.
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include <robotlink/cognition/cognition_debug.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/live/attached_robots.h>
#include <telemetry/expression/expression.h>
#include <telemetry/monitor/sender_filter.h>

#include "soccer/aim_habit.h"

using namespace pitchboard;

namespace {

void expression(std::string_view text) {
  auto read = telemetry::Expression::parse(text);
  if (!read) {
    if (read.error().message.empty()) std::abort();
    return;
  }
  for (const double value : {0.0, -1.5, std::nan("")}) {
    const std::vector<double> values(read->variables().size(), value);
    const double first = read->evaluate(2.0, values), second = read->evaluate(2.0, values);
    if (!(first == second || (std::isnan(first) && std::isnan(second)))) std::abort();
  }
}

void cognitionDebug(std::string_view text) {
  link::CognitionDebug read;
  if (!link::readDebugDatagram(text, read)) return;
  const auto written = link::debugDatagrams(read);
  if (written.empty()) std::abort();
  for (const std::string& datagram : written) {
    link::CognitionDebug again;
    if (!link::readDebugDatagram(datagram, again)) std::abort();
  }
}

/// What a robot of the team posts is received by another one, which writes it to its blackboard.
void teamMessage(std::string_view text) {
  struct Team {
    std::shared_ptr<link::TeamChannel> channel = std::make_shared<link::InProcessTeamChannel>();
    std::unique_ptr<link::CognitiveProcess> process;
    link::Blackboard board = link::Blackboard::onHeap();
    double time = 0.0;
    Team() {
      link::ProcessOptions options;
      options.teamChannel = channel;
      process = std::move(*link::findProcess("team")->make(options));
      process->step(board, {0.0});
    }
  };
  static Team team;
  team.channel->post(RobotId{2}, text);
  team.process->step(team.board, {team.time += 0.2});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (size <= 200) expression(text);
  telemetry::SenderFilter filter;
  if (filter.add(text) && filter.empty()) std::abort();
  if (const auto address = telemetry::parseAddress(text)) {
    const auto again = telemetry::parseAddress(address->text());
    if (!again || *again != *address) std::abort();
  }
  if (const auto board = link::parseAttachedBoard(text)) {
    const auto again = link::parseAttachedBoard(link::attachedBoardText(*board));
    if (!again || !(*again == *board)) std::abort();
  }
  cognitionDebug(text);
  teamMessage(text);
  if (const auto learned = link::habitFromJson(text, "fuzz")) {
    const auto again = link::habitFromJson(link::habitToJson(*learned), "again");
    if (!again || !(*again == *learned)) std::abort();
  }
  return 0;
}
