// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a team's profile; what is accepted must read back the same.
#include <telemetry/formats/profile.h>

#include <cstdlib>

using namespace pitchboard::telemetry;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto profile = parseProfile(text, "fuzz");
  if (!profile) return 0;
  const auto again = parseProfile(profileText(*profile), "again");
  if (!again || !(*again == *profile)) std::abort();
  return 0;
}
