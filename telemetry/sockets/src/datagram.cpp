// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/sockets/datagram.h>

#include <arpa/inet.h>

namespace pitchboard::telemetry {

std::string Address::text() const {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) {
    if (!out.empty()) out += '.';
    out += std::to_string((value >> shift) & 0xff);
  }
  return out;
}

Result<Address> parseAddress(std::string_view text) {
  in_addr address{};
  if (text.size() > 15 || inet_pton(AF_INET, std::string(text).c_str(), &address) != 1) {
    return failure(ErrorCode::InvalidArgument,
                   "Not an IPv4 address; write it as four numbers, e.g. 192.168.0.7.",
                   "\"" + std::string(text.substr(0, 40)) + "\"");
  }
  return Address{ntohl(address.s_addr)};
}

std::string Sender::text() const {
  return port == 0 ? address.text() : address.text() + ":" + std::to_string(port);
}

void DatagramBatch::append(const DatagramView& d) {
  m_heads.push_back({d.time, d.sender, d.localPort, d.truncated, m_bytes.size(), d.payload.size()});
  m_bytes += d.payload;
}

void DatagramBatch::clear() {
  m_heads.clear();
  m_bytes.clear();
}

DatagramView DatagramBatch::operator[](std::size_t index) const {
  const Head& head = m_heads[index];
  return {head.time, head.sender, head.localPort, head.truncated,
          std::string_view(m_bytes).substr(head.offset, head.length)};
}

}  // namespace pitchboard::telemetry
