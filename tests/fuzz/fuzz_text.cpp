// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a robot's text datagram, through the decoder and the team's book-keeping.
#include <telemetry/wire/team_monitor.h>

#include <cstdlib>

using namespace pitchboard::telemetry;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static TeamMonitor monitor = [] {
    Profile profile = publishedProfile();
    profile.fields.push_back({"SEQ", FieldType::Int, "", "Network", FieldMeaning::Sequence});
    return TeamMonitor(profile);
  }();
  static WallTime now{std::chrono::seconds(1'700'000'000)};
  now += std::chrono::milliseconds(100);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Sender sender{{static_cast<std::uint32_t>(size % 7)}, 5000};
  const auto verdict = monitor.take({now, sender, 1241, false, text});
  const DecodedText& decoded = monitor.decoded();
  if (decoded.count > DecodedText::maxValues) std::abort();
  if (verdict == TeamMonitor::Verdict::Used && (decoded.robot < 1 || decoded.count < 16))
    std::abort();
  // The whole status is a large value: now and then is enough.
  static unsigned rounds = 0;
  if (++rounds % 64 == 0 && monitor.status(now).robots.size() > MonitorOptions::maxRobots)
    std::abort();
  return 0;
}
