// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a PB2 datagram: what is accepted keeps the limits, and what is written of it is read
// as the same.
#include <bit>
#include <cmath>
#include <cstdlib>

#include <telemetry/pb2/pb2.h>

using namespace pitchboard::telemetry;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const auto message = parsePb2({reinterpret_cast<const char*>(data), size});
  if (!message) {
    if (message.error().message.empty() || message.error().message.size() > 200) std::abort();
    return 0;
  }
  if (message->robot < 1 || message->robot > Pb2Limits::robots) std::abort();
  if (message->values.size() > Pb2Limits::bytes / 4) std::abort();
  for (const Pb2Value& value : message->values) {
    if (!isPb2Name(value.name)) std::abort();
    Pb2Writer writer(message->robot, message->sequence, message->milliseconds);
    const Pb2Number number = value.whole ? Pb2Number(static_cast<std::int64_t>(value.value))
                                         : Pb2Number(static_cast<float>(value.value));
    if (!writer.fits(Pb2Writer::fieldBytes(value.name, number.text()))) std::abort();
    writer.add(value.name, number.text());
    const std::string text = std::move(writer).finish();
    const auto again = parsePb2(text);
    if (!again || again->values.size() != 1 || again->values[0].name != value.name ||
        again->values[0].whole != value.whole || again->sequence != message->sequence ||
        again->milliseconds != message->milliseconds) {
      std::abort();
    }
    const double back = again->values[0].value;
    if (std::isnan(value.value)
            ? !std::isnan(back)
            : std::bit_cast<std::uint64_t>(back) != std::bit_cast<std::uint64_t>(value.value)) {
      std::abort();
    }
  }
  return 0;
}
