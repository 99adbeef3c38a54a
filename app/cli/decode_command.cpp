// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>
#include <set>

#include <base/nearest_name.h>
#include <base/read_file.h>
#include <base/try.h>
#include <robotlink/live/live_pipeline.h>
#include <telemetry/wire/message_format.h>

#include "commands.h"
#include "listen_options.h"
#include "live_json.h"

namespace pitchboard::cli {
namespace {

using namespace telemetry;

constexpr std::size_t maxFileBytes = 256U << 20;

struct DecodeOptions {
  std::vector<std::string> files;
  std::string profile;
  bool json = false;
};

Result<std::string> readAll(const std::string& path) {
  if (path == "-") return readDescriptor(STDIN_FILENO, maxFileBytes, "The input", "stdin");
  return readFile(path, maxFileBytes);
}

/// `unix time <tab> sender <tab> datagram`, as in a capture.
struct CapturedLine {
  std::optional<double> time;
  std::string_view sender;
  std::string_view datagram;
};

CapturedLine splitLine(std::string_view line) {
  const auto first = line.find('\t');
  const auto second = first == line.npos ? line.npos : line.find('\t', first + 1);
  double time = 0.0;
  if (second != line.npos) {
    const auto [stop, code] = std::from_chars(line.data(), line.data() + first, time);
    if (code == std::errc{} && stop == line.data() + first) {
      return {time, line.substr(first + 1, second - first - 1), line.substr(second + 1)};
    }
  }
  return {std::nullopt, {}, line};
}

template <class Visit>
void forEachLine(std::string_view text, Visit visit) {
  std::size_t number = 0;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    visit(text.substr(0, end), ++number);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

/// A file with one packet, or lines of JSON with the packet's bytes under "hex".
struct StoredPacket {
  std::string bytes;
  std::size_t line = 0;  ///< 0: the whole file
};

Result<std::vector<StoredPacket>> storedPackets(const std::string& file, const std::string& text) {
  if (!text.starts_with('{')) return std::vector<StoredPacket>{{text, 0}};
  std::vector<StoredPacket> packets;
  std::optional<Error> error;
  forEachLine(text, [&](std::string_view line, std::size_t number) {
    if (error || line.find_first_not_of(" \t\r") == line.npos) return;
    const Json json = Json::parse(line, nullptr, false);
    const bool good = json.is_object() && json.contains("hex") && json["hex"].is_string();
    const std::string hex = good ? json["hex"].get<std::string>() : std::string();
    StoredPacket packet{{}, number};
    bool digits = good && hex.size() % 2 == 0;
    for (std::size_t i = 0; digits && i < hex.size(); i += 2) {
      unsigned byte = 0;
      const auto [stop, code] = std::from_chars(hex.data() + i, hex.data() + i + 2, byte, 16);
      digits = code == std::errc{} && stop == hex.data() + i + 2;
      packet.bytes += static_cast<char>(byte);
    }
    if (!digits) {
      error = Error{ErrorCode::ParseError,
                    "A line holds a JSON object with the packet under \"hex\", two digits a byte.",
                    file + ":" + std::to_string(number)};
      return;
    }
    packets.push_back(std::move(packet));
  });
  if (error) return tl::unexpected(*error);
  return packets;
}

/// Prints what a pipeline makes of datagrams.
class Decoder : public link::LiveObserver {
 public:
  Decoder(link::LiveOptions options, bool json)
      : m_json(json), m_pipeline(std::move(options), WallTime{}) {
    // It owns the pipeline, not the other way round.
    m_pipeline.observe(std::shared_ptr<LiveObserver>(std::shared_ptr<void>(), this), WallTime{});
  }

  /// `head`: what stands before it; without a time it comes a second after the one before.
  void take(Json head, std::string_view payload, bool ofReferee, std::optional<double> time = {},
            telemetry::Sender sender = {}) {
    const bool isVariables = !ofReferee && payload.starts_with("PB2 ");
    constexpr double mostSeconds = 9e9;
    m_head = std::move(head);
    m_time = std::clamp(time.value_or(m_time + 1.0), -mostSeconds, mostSeconds);
    const link::LiveOptions& options = m_pipeline.options();
    const int port = ofReferee     ? options.refereePort
                     : isVariables ? options.variablesPortBase + 1
                                   : 0;
    const auto after = std::chrono::duration<double>(m_time);
    m_pipeline.take({WallTime(std::chrono::duration_cast<Duration>(after)), sender,
                     static_cast<std::uint16_t>(port), false, payload});
  }

  void received(const link::LiveDatagram& datagram) override {
    if (!isGood(datagram)) m_exitCode = 1;
    if (datagram.decoded != nullptr) noteFields(*datagram.decoded);
    if (m_json) m_head.update(messageJson(datagram, m_pipeline.options()));
    const std::string line = m_json ? dump(m_head) : messageLine(datagram, m_pipeline.options());
    std::printf("%s\n", line.c_str());
  }

  int exitCode() const { return m_exitCode; }
  const link::LiveOptions& options() const { return m_pipeline.options(); }

  /// Warns of fields whose key is in none of the messages, because it is often misspelt.
  void warnOfMissingFields() const {
    const Profile& profile = options().profile;
    const bool hasKeys = profile.format == MessageFormat::KeyValue ||
                         profile.format == MessageFormat::Json ||
                         profile.format == MessageFormat::Lua;
    if (!hasKeys || !m_anyMessage) return;
    const std::vector<std::string_view> others(m_otherKeys.begin(), m_otherKeys.end());
    for (std::size_t i = 0; i < profile.fields.size(); ++i) {
      if (m_wasSent.contains(i)) continue;
      const ProfileField& field = profile.fields[i];
      const std::string& key = field.key.empty() ? field.name : field.key;
      const std::string_view near = nearestName(key, others);
      std::fprintf(stderr, "warning: no message has the key \"%s\" of the field %s%s%s%s\n",
                   key.c_str(), field.name.c_str(), near.empty() ? "" : "; did you mean \"",
                   std::string(near).c_str(), near.empty() ? "" : "\"?");
    }
  }

 private:
  void noteFields(const DecodedText& decoded) {
    if (!decoded.accepted()) return;
    m_anyMessage = true;
    const std::size_t fields = options().profile.fields.size();
    for (std::size_t i = 0; i < std::min(fields, decoded.count); ++i) {
      if (decoded.has(i) || !decoded.texts[i].empty()) m_wasSent.insert(i);
    }
    for (std::size_t i = 0; i < decoded.namedExtras; ++i) m_otherKeys.emplace(decoded.extraKeys[i]);
  }

  const bool m_json;
  link::LivePipeline m_pipeline;
  Json m_head;
  double m_time = 0.0;  // s
  int m_exitCode = 0;
  bool m_anyMessage = false;
  std::set<std::size_t> m_wasSent;  // indices of the profile's fields
  std::set<std::string, std::less<>> m_otherKeys;
};

Json headOf(const std::string& file, std::size_t line) {
  Json head{{"file", file}};
  if (line > 0) head["line"] = line;
  return head;
}

/// One in a file, or lines of JSON.
Result<int> decodeStored(const DecodeOptions& options, Decoder& decoder, bool ofReferee) {
  for (const std::string& file : options.files) {
    const auto bytes = TRY(readAll(file));
    for (const StoredPacket& stored : TRY(storedPackets(file, bytes))) {
      decoder.take(headOf(file, stored.line), stored.bytes, ofReferee);
    }
  }
  return decoder.exitCode();
}

Result<int> decodeTelemetry(const DecodeOptions& options) {
  link::LiveOptions live;
  if (!options.profile.empty()) live.profile = TRY(loadProfile(options.profile));
  Decoder decoder(std::move(live), options.json);
  if (!isTextFormat(decoder.options().profile.format)) {
    return decodeStored(options, decoder, false);
  }
  for (const std::string& file : options.files) {
    const auto text = TRY(readAll(file));
    if (text.empty()) {
      return failure(ErrorCode::ParseError, "The file is empty.", file);
    }
    forEachLine(text, [&](std::string_view line, std::size_t number) {
      const CapturedLine captured = splitLine(line);
      Json head = headOf(file, number);
      if (captured.time) {
        head["time"] = *captured.time;
        head["sender"] = printable(captured.sender);
      }
      const std::string_view address = captured.sender.substr(0, captured.sender.find(':'));
      const auto sender = parseAddress(std::string(address));
      decoder.take(std::move(head), captured.datagram, false, captured.time,
                   {sender ? *sender : Address{}, 0});
    });
  }
  decoder.warnOfMissingFields();
  return decoder.exitCode();
}

Result<int> decodeGameController(const DecodeOptions& options) {
  Decoder decoder({}, options.json);
  return decodeStored(options, decoder, true);
}

}  // namespace

void addDecodeCommand(CLI::App& parent, int& exitCode) {
  CLI::App* decode =
      parent.add_subcommand("decode",
                            "Decode recorded datagrams. Exits with 1 if any of them is invalid.\n"
                            "Examples: pitchboard-cli decode telemetry --json capture.txt\n"
                            "          pitchboard-cli decode gamecontroller --json packet.bin\n"
                            "          echo '1 450 300 0 9.5 80 10 1 1 1 1 1 8 0.1 189 OUT' |\n"
                            "            pitchboard-cli decode telemetry -");
  decode->require_subcommand(1);

  auto text = std::make_shared<DecodeOptions>();
  CLI::App* telemetry = decode->add_subcommand(
      "telemetry",
      "Decode datagrams of robots: messages, and variables (PB2).\n"
      "Text: one per line; a line may begin with time, tab, sender, tab.\n"
      "Binary: one per file, or lines of JSON with the bytes under \"hex\".\n"
      "Example: pitchboard-cli decode telemetry --profile mitecom message.bin");
  telemetry->add_option("FILE", text->files, "Files; - is standard input")->required();
  telemetry
      ->add_option("--profile", text->profile,
                   "Format of the messages: a file (docs/live.md), or " + profileNames())
      ->type_name("FILE|NAME");
  telemetry->add_flag("--json", text->json, "One JSON object per datagram");
  whenChosen(*telemetry, text, exitCode, decodeTelemetry);

  auto referee = std::make_shared<DecodeOptions>();
  CLI::App* controller =
      decode->add_subcommand("gamecontroller",
                             "Decode referee packets: one packet per file, or lines of JSON with "
                             "the bytes under \"hex\".\n"
                             "Example: pitchboard-cli decode gamecontroller --json packet.bin");
  controller->add_option("FILE", referee->files, "Files; - is standard input")->required();
  controller->add_flag("--json", referee->json, "One JSON object per packet");
  whenChosen(*controller, referee, exitCode, decodeGameController);
}

}  // namespace pitchboard::cli
