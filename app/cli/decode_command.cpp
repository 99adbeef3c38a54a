// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>
#include <charconv>
#include <cstdio>
#include <memory>

#include <base/read_file.h>
#include <base/try.h>
#include <robotlink/live/live_teams.h>
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

void put(const DecodeOptions& options, Json json, const Json& body, const std::string& line) {
  json.update(body);
  std::printf("%s\n", options.json ? dump(json).c_str() : line.c_str());
}

Result<int> decodeStoredMessages(const DecodeOptions& options, const TextDecoder& decoder);

Result<int> decodeTelemetry(const DecodeOptions& options) {
  Profile profile = publishedProfile();
  if (!options.profile.empty()) {
    profile = TRY(loadProfile(options.profile));
  }
  const TextDecoder decoder(std::move(profile), link::surroundingsOf(sim::FieldSpec{}));
  if (!isTextFormat(decoder.profile().format)) return decodeStoredMessages(options, decoder);
  auto decoded = std::make_unique<DecodedText>();
  int exitCode = 0;
  for (const std::string& file : options.files) {
    const auto text = TRY(readAll(file));
    if (text.empty()) {
      return failure(ErrorCode::ParseError, "The file is empty.", file);
    }
    forEachLine(text, [&](std::string_view line, std::size_t number) {
      const CapturedLine captured = splitLine(line);
      decoder.decode(captured.datagram, *decoded);
      Json head{{"file", file}, {"line", number}};
      if (captured.time) {
        head["time"] = *captured.time;
        head["sender"] = printable(captured.sender);
      }
      put(options, std::move(head),
          telemetryJson(decoder, *decoded, captured.datagram, decoded->robot),
          telemetryLine(decoder, *decoded, captured.datagram, decoded->robot));
      if (!decoded->accepted()) exitCode = 1;
    });
  }
  return exitCode;
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

/// Messages that are no text: one in a file, or lines of JSON.
Result<int> decodeStoredMessages(const DecodeOptions& options, const TextDecoder& decoder) {
  auto decoded = std::make_unique<DecodedText>();
  int exitCode = 0;
  for (const std::string& file : options.files) {
    const auto bytes = TRY(readAll(file));
    const auto messages = TRY(storedPackets(file, bytes));
    for (const StoredPacket& stored : messages) {
      decoder.decode(stored.bytes, *decoded);
      Json head{{"file", file}};
      if (stored.line > 0) head["line"] = stored.line;
      put(options, std::move(head), telemetryJson(decoder, *decoded, stored.bytes, decoded->robot),
          telemetryLine(decoder, *decoded, stored.bytes, decoded->robot));
      if (!decoded->accepted()) exitCode = 1;
    }
  }
  return exitCode;
}

Result<int> decodeGameController(const DecodeOptions& options) {
  int exitCode = 0;
  for (const std::string& file : options.files) {
    const auto text = TRY(readAll(file));
    const auto packets = TRY(storedPackets(file, text));
    for (const StoredPacket& stored : packets) {
      Json head{{"file", file}};
      if (stored.line > 0) head["line"] = stored.line;
      const auto packet = decodeReferee(stored.bytes);
      if (packet) {
        put(options, std::move(head), refereeJson(*packet), refereeLine(*packet));
        continue;
      }
      exitCode = 1;
      put(options, std::move(head),
          Json{{"error", packet.error().message},
               {"bytes", stored.bytes.size()},
               {"text", printable(stored.bytes)}},
          file + ": " + packet.error().message);
    }
  }
  return exitCode;
}

}  // namespace

void addDecodeCommand(CLI::App& parent, int& exitCode) {
  CLI::App* decode = parent.add_subcommand(
      "decode",
      "Decode stored datagrams. Exit code 1 when one of them could not be used.\n"
      "Examples: pitchboard-cli decode telemetry --json capture.txt\n"
      "          pitchboard-cli decode gamecontroller --json packet.bin\n"
      "          echo '1 450 300 0 9.5 80 10 1 1 1 1 1 8 0.1 189 OUT' |\n"
      "            pitchboard-cli decode telemetry -");
  decode->require_subcommand(1);

  auto text = std::make_shared<DecodeOptions>();
  CLI::App* telemetry = decode->add_subcommand(
      "telemetry",
      "Datagrams of robots. Text: one per line; a line may begin with time, tab, sender, tab.\n"
      "Binary: one per file, or lines of JSON with the bytes under \"hex\".\n"
      "Example: pitchboard-cli decode telemetry --profile mitecom message.bin");
  telemetry->add_option("FILE", text->files, "Files; - is standard input")->required();
  telemetry->add_option(
      "--profile", text->profile,
      "What stands in a message: a file (docs/LIVE.md), or one of\n" + profileNames());
  telemetry->add_flag("--json", text->json, "One JSON object per datagram");
  whenChosen(*telemetry, text, exitCode, decodeTelemetry);

  auto referee = std::make_shared<DecodeOptions>();
  CLI::App* controller = decode->add_subcommand(
      "gamecontroller",
      "Referee packets: one packet per file, or lines of JSON with the bytes under \"hex\"");
  controller->add_option("FILE", referee->files, "Files; - is standard input")->required();
  controller->add_flag("--json", referee->json, "One JSON object per packet");
  whenChosen(*controller, referee, exitCode, decodeGameController);
}

}  // namespace pitchboard::cli
