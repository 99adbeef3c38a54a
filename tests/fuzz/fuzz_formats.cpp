// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a message of each built-in profile; the first byte chooses one.
#include <telemetry/monitor/team_setup.h>

#include <cstdlib>
#include <memory>

using namespace pitchboard::telemetry;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static const auto decoders = [] {
    std::vector<std::unique_ptr<const TextDecoder>> made;
    for (const std::string& name : builtInProfiles()) {
      made.push_back(std::make_unique<const TextDecoder>(*loadProfile(name)));
    }
    return made;
  }();
  static DecodedText decoded;
  if (size == 0) return 0;
  const TextDecoder& decoder = *decoders[data[0] % decoders.size()];
  const std::string_view payload(reinterpret_cast<const char*>(data) + 1, size - 1);
  decoder.decode(DatagramView{{}, {{0x0a000007}, 4000}, 1241, false, payload}, decoded);
  if (decoded.count > DecodedText::maxValues) std::abort();
  if (decoded.accepted() && (decoded.robot < 1 || decoded.robot > TextDecoder::maxRobot)) {
    std::abort();
  }
  for (std::size_t i = 0; i < decoded.count; ++i) (void)printable(decoded.texts[i], 40);
  // The same bytes as a setup: what is read reads back the same.
  if (const auto setup = parseTeamSetup(payload, "fuzz")) {
    const auto again = parseTeamSetup(teamSetupText(*setup), "again");
    if (!again || !(*again == *setup)) std::abort();
  }
  return 0;
}
