// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/monitor/sender_filter.h>

#include <algorithm>
#include <bit>
#include <charconv>

namespace pitchboard::telemetry {

Result<void> SenderFilter::add(std::string_view text) {
  const auto slash = text.find('/');
  const auto address = parseAddress(text.substr(0, slash));
  if (!address) return tl::unexpected(address.error());
  unsigned bits = 32;
  if (slash != text.npos) {
    const std::string_view length = text.substr(slash + 1);
    const auto [stop, code] = std::from_chars(length.data(), length.data() + length.size(), bits);
    if (code != std::errc{} || stop != length.data() + length.size() || bits > 32) {
      return failure(ErrorCode::InvalidArgument,
                     "A network is written as an address and 0 to 32 bits, e.g. 192.168.0.0/24.",
                     "\"" + std::string(text.substr(0, 40)) + "\"");
    }
  }
  const std::uint32_t mask = bits == 0 ? 0U : ~0U << (32U - bits);
  m_ranges.push_back({address->value & mask, mask});
  return {};
}

std::vector<std::string> SenderFilter::texts() const {
  std::vector<std::string> texts;
  for (const Range& range : m_ranges) {
    const int bits = std::popcount(range.mask);
    texts.push_back(Address{range.address}.text() + (bits == 32 ? "" : "/" + std::to_string(bits)));
  }
  return texts;
}

bool SenderFilter::allows(Address address) const {
  return m_ranges.empty() ||
         std::any_of(m_ranges.begin(), m_ranges.end(),
                     [address](const Range& r) { return (address.value & r.mask) == r.address; });
}

}  // namespace pitchboard::telemetry
