// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as datagrams of a live match of several teams, the whole way: team, format, state,
// rows, frame; and what a session keeps of it reads back as the same. The first byte chooses port
// and sender.
#include <cstdlib>

#include <robotlink/live/live_rows.h>
#include <robotlink/live/live_state.h>
#include <robotlink/live/live_teams.h>
#include <telemetry/series/series_store.h>

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

constexpr std::size_t budget = std::size_t{16} << 20;
/// The newest rows of each group and what one block more takes, for every group there can be.
constexpr std::size_t above = std::size_t{256} << 20;
constexpr int firstPort = 12000, refereePort = 3838;

link::LiveOptions optionsOfMatch() {
  link::LiveOptions options;
  int port = firstPort;
  for (const char* profile :
       {"published", "mitecom", "robocup", "rhoban", "upenn", "spl", "hulks"}) {
    TeamSetup& team = options.team.teams.emplace_back();
    team.number = 12 + port - firstPort;
    team.firstPort = team.lastPort = port++;
    team.profileName = profile;
    team.profile = *loadProfile(profile);
  }
  return options;
}

struct Match {
  WallTime zero{std::chrono::seconds(1'700'000'000)};
  WallTime now = zero;
  link::LiveOptions options = optionsOfMatch();
  link::LiveState state{options};
  std::shared_ptr<SeriesStore> store = std::make_shared<SeriesStore>(SeriesOptions{budget});
  link::LiveRows rows{store, link::rowsOptions(options, link::teamsOf(options, {}), zero)};

  void take(unsigned char where, std::string_view payload) {
    now += std::chrono::milliseconds(100);
    const Sender sender{{0x0a000000U + where / 8U}, 5000};
    const auto teams = static_cast<int>(options.team.teams.size());
    const int place = where % 8;
    const int port = place < teams ? firstPort + place : refereePort;
    const DatagramView datagram{now, sender, static_cast<std::uint16_t>(port), false, payload};
    if (port == refereePort) {
      if (const auto packet = decodeReferee(payload)) state.takeReferee(*packet, datagram);
      return;
    }
    if (state.monitor.take(datagram) != TeamMonitor::Verdict::Used) return;
    const DecodedText& decoded = state.monitor.decoded();
    if (decoded.place != place + 1) std::abort();
    rows.take(datagram, decoded, state.monitor.decoder(), state.monitor.used());
  }

  void check() {
    const TeamStatus status = state.monitor.status(now);
    if (status.robots.size() > options.team.maxRobots() + MonitorOptions::ordinaryRobots)
      std::abort();
    rows.report(status);
    if (store->memoryBytes() > budget + above) std::abort();
    const double time = secondsOf(now - zero);
    (void)state.frame(options, status, time);
    const std::string text = state.text(options, time, zero);
    const auto again = link::LiveState::read(text, zero);
    if (!again) std::abort();
    if (!(again->options.team.teams == options.team.teams)) std::abort();
    if (again->state.monitor.status(now).robots.size() != status.robots.size()) std::abort();
    if (again->state.text(again->options, time, zero) != text) std::abort();
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static Match match;
  if (size == 0) return 0;
  match.take(data[0], {reinterpret_cast<const char*>(data) + 1, size - 1});
  // All of it is a large value: now and then is enough.
  static unsigned rounds = 0;
  if (++rounds % 64 == 0) match.check();
  return 0;
}
