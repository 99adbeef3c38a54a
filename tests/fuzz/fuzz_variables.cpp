// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as datagrams that come to the ports of variables, the whole way: parsed, put in order,
// joined with robots that send messages, rows, frames. Each record begins with two bytes: robot and
// sender, and how much later it comes.
#include <cmath>
#include <cstdlib>

#include <robotlink/live/live_pipeline.h>
#include <telemetry/series/series_store.h>

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

constexpr std::size_t budget = std::size_t{16} << 20;
/// The newest rows of each group: maxRobots groups of at most maxVariables columns.
constexpr std::size_t above = std::size_t{256} << 20;
constexpr std::string_view message = " 450 300 0 9.5 80 10 1 1 1 1 1 8 0.1 189 OUT";

struct Rows : link::LiveObserver {
  std::shared_ptr<SeriesStore> store = std::make_shared<SeriesStore>(SeriesOptions{budget});
  std::shared_ptr<RowSink> rows() override { return store; }
};

struct Match {
  WallTime now{};
  std::shared_ptr<Rows> rows = std::make_shared<Rows>();
  link::LivePipeline pipeline{{}, WallTime{}};

  Match() { pipeline.observe(rows, now); }

  void take(unsigned char where, unsigned char later, std::string_view payload) {
    now += std::chrono::milliseconds(later < 250 ? later : 1000 * (later - 249));
    const int robot = where % 4 + 1;
    const Sender sender{{0x0a000000U + where / 4U % 8U},
                        static_cast<std::uint16_t>(5000 + where / 32)};
    const auto port = static_cast<std::uint16_t>(pipeline.options().variablesPortBase + robot);
    pipeline.take({now, sender, port, false, payload});
    if (where % 16 == 3) {
      const std::string text = std::to_string(robot) + std::string(message);
      const auto own = static_cast<std::uint16_t>(pipeline.options().portBase + robot);
      pipeline.take({now, sender, own, false, text});
    }
  }

  void check() {
    const link::MatchFrame frame = pipeline.advance(now);
    if (rows->store->memoryBytes() > budget + above) std::abort();
    const link::LiveDetails details = pipeline.details(now);
    if (details.sent.size() > link::SentBoards::maxRobots) std::abort();
    for (const link::SentStatus& sent : details.sent) {
      if (sent.variables > link::SentBoards::maxVariables) std::abort();
      if (!std::isfinite(sent.clockOffset) || !std::isfinite(sent.link.jitter)) std::abort();
    }
    for (std::size_t i = 0; i < frame.robots.size(); ++i) {
      const link::RobotFrame& robot = frame.robots[i];
      if (frame.robot(robot.key) != &robot || robot.name.empty()) std::abort();
      if (robot.board.names && robot.board.names->size() != robot.board.values.size()) std::abort();
    }
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static auto match = std::make_unique<Match>();
  static unsigned rounds = 0;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  while (rest.size() > 2) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    if (end > 2) {
      match->take(static_cast<unsigned char>(rest[0]), static_cast<unsigned char>(rest[1]),
                  rest.substr(2, end - 2));
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (++rounds % 16 == 0) match->check();
  // Names are few, and robots come and go: it begins again.
  if (rounds % 20'000 == 0) match = std::make_unique<Match>();
  return 0;
}
