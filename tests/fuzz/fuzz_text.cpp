// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a robot's text datagram, all the way: the decoder, the team's book-keeping, the
// rows. And the same bytes as a moment of a session that somebody typed.
#include <cmath>
#include <cstdlib>

#include <robotlink/live/live_rows.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_time.h>

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

constexpr std::size_t budget = std::size_t{16} << 20;
/// The newest rows of each group and what one block more takes, for every group there can be.
constexpr std::size_t above = std::size_t{64} << 20;

struct Path {
  WallTime now{std::chrono::seconds(1'700'000'000)};
  TeamMonitor monitor;
  std::shared_ptr<SeriesStore> store = std::make_shared<SeriesStore>(SeriesOptions{budget});
  link::LiveRows rows{store, {now, {}, {}}};

  Path() : monitor(profile()) {}
  static Profile profile() {
    Profile made = publishedProfile();
    made.fields.push_back({"SEQ", FieldType::Int, "", "Network", FieldMeaning::Sequence});
    return made;
  }

  void take(std::string_view text) {
    now += std::chrono::milliseconds(100);
    const Sender sender{{static_cast<std::uint32_t>(text.size() % 7)}, 5000};
    const DatagramView datagram{now, sender, 1241, false, text};
    const auto verdict = monitor.take(datagram);
    const DecodedText& decoded = monitor.decoded();
    if (decoded.count > DecodedText::maxValues) std::abort();
    if (verdict != TeamMonitor::Verdict::Used) return;
    if (decoded.robot < 1 || decoded.count < 16) std::abort();
    rows.take(datagram, decoded, monitor.decoder(), monitor.used());
  }

  void check() {
    const TeamStatus status = monitor.status(now);
    if (status.robots.size() > MonitorOptions::maxRobots(0)) std::abort();
    rows.report(status);
    if (store->groups() > 2 * MonitorOptions::maxRobots(0)) std::abort();
    if (store->memoryBytes() > budget + above) std::abort();
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static Path path;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  path.take(text);
  const auto moment = sessionTime(text, WallTime{std::chrono::seconds(1'700'000'000)}, {0.0, 60.0});
  if (moment && !std::isfinite(*moment)) std::abort();
  // The whole status is a large value: now and then is enough.
  static unsigned rounds = 0;
  if (++rounds % 64 == 0) path.check();
  return 0;
}
