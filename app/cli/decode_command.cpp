// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <memory>
#include <set>

#include <app/option_arguments.h>
#include <base/byte_sizes.h>
#include <base/nearest_name.h>
#include <base/system_reason.h>
#include <base/try.h>
#include <base/unique_fd.h>
#include <robotlink/live/live_pipeline.h>
#include <telemetry/formats/message_format.h>

#include "commands.h"
#include "listen_options.h"
#include "live_json.h"

namespace pitchboard::cli {
namespace {

using namespace telemetry;

constexpr std::size_t maxLineBytes = 1 * mebibyte;  // a datagram has at most 64 KiB

struct DecodeOptions {
  std::vector<std::string> files;
  OptionValues given;
  bool json = false;
};

/// The lines of a file of any size, one after the other.
class LineFile {
 public:
  static Result<LineFile> open(const std::string& path) {
    LineFile file(path);
    if (path == "-") return file;
    file.m_descriptor.reset(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.m_descriptor) return file.cannotRead(errno);
    return file;
  }

  /// The next line without its end, valid until the next call; nothing at the end of the file.
  Result<std::optional<std::string_view>> next() {
    for (;;) {
      const std::string_view rest = std::string_view(m_buffer).substr(m_begin);
      const auto end = rest.find('\n', m_searched);
      if (end != rest.npos || (m_atEnd && !rest.empty())) {
        const std::string_view line = rest.substr(0, end);
        m_begin += std::min(line.size() + 1, rest.size());
        m_searched = 0;
        ++m_number;
        return line;
      }
      if (m_atEnd) return std::nullopt;
      if (rest.size() > maxLineBytes) {
        return failure(ErrorCode::Unsupported,
                       "This line is longer than 1 MiB, and no datagram is.",
                       m_path + ":" + std::to_string(m_number + 1));
      }
      m_searched = rest.size();
      m_buffer.erase(0, std::exchange(m_begin, 0));
      TRY(fill());
    }
  }
  /// The number of the line that next() returned last, from 1.
  std::size_t number() const { return m_number; }
  /// The first byte of the file, or 0 if it is empty.
  Result<char> first() {
    if (m_buffer.empty()) TRY(fill());
    return m_buffer.empty() ? '\0' : m_buffer.front();
  }
  /// The whole file, if no line was read yet and it is not larger than a line.
  Result<std::string> all() {
    while (!m_atEnd && m_buffer.size() <= maxLineBytes) TRY(fill());
    if (m_atEnd) return m_buffer;
    return failure(ErrorCode::Unsupported,
                   "The file is larger than 1 MiB; no datagram is. Lines of JSON can hold many: "
                   "{\"hex\": \"0a1b...\"}.",
                   m_path);
  }

 private:
  explicit LineFile(const std::string& path) : m_path(path == "-" ? "stdin" : path) {}
  tl::unexpected<Error> cannotRead(int error) const {
    return failure(error == ENOENT ? ErrorCode::NotFound : ErrorCode::SystemError,
                   "The file cannot be read: " + systemReason(error) + ".", m_path);
  }
  Result<void> fill() {
    constexpr std::size_t step = 256 * kibibyte;
    const std::size_t at = m_buffer.size();
    m_buffer.resize(at + step);
    ssize_t got = 0;
    do {
      got = ::read(m_descriptor ? m_descriptor.get() : STDIN_FILENO, m_buffer.data() + at, step);
    } while (got < 0 && errno == EINTR);
    m_buffer.resize(at + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got < 0) return cannotRead(errno);
    m_atEnd = got == 0;
    return {};
  }

  std::string m_path;
  UniqueFd m_descriptor;  // empty: standard input
  std::string m_buffer;
  std::size_t m_begin = 0, m_searched = 0, m_number = 0;
  bool m_atEnd = false;
};

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

/// A packet from a line of JSON with its bytes under "hex".
Result<std::string> packetOf(std::string_view line, const std::string& file, std::size_t number) {
  const Json json = Json::parse(line, nullptr, false);
  const bool good = json.is_object() && json.contains("hex") && json["hex"].is_string();
  const std::string hex = good ? json["hex"].get<std::string>() : std::string();
  std::string bytes;
  bool digits = good && hex.size() % 2 == 0;
  for (std::size_t i = 0; digits && i < hex.size(); i += 2) {
    unsigned byte = 0;
    const auto [stop, code] = std::from_chars(hex.data() + i, hex.data() + i + 2, byte, 16);
    digits = code == std::errc{} && stop == hex.data() + i + 2;
    bytes += static_cast<char>(byte);
  }
  if (digits) return bytes;
  return failure(ErrorCode::ParseError,
                 "A line holds a JSON object with the packet under \"hex\", two digits a byte.",
                 file + ":" + std::to_string(number));
}

/// Prints what a pipeline makes of datagrams.
class Decoder : public link::LiveObserver {
 public:
  Decoder(link::LiveOptions options, bool json)
      : m_json(json), m_pipeline(std::move(options), WallTime{}) {
    // It owns the pipeline, not the other way round.
    m_pipeline.observe(std::shared_ptr<LiveObserver>(std::shared_ptr<void>(), this), WallTime{});
  }

  /// Where a datagram stands. Without a time it comes a second after the one before.
  struct Source {
    const std::string& file;
    std::size_t line = 0;  ///< 0: it is the whole file
    std::optional<double> time{};
    std::string_view sender{};
  };
  void take(const Source& source, std::string_view payload, bool ofReferee) {
    const bool isVariables = !ofReferee && payload.starts_with("PB2 ");
    constexpr double maxSeconds = 9e9;
    m_source = &source;
    m_time = std::clamp(source.time.value_or(m_time + 1.0), -maxSeconds, maxSeconds);
    const link::LiveOptions& options = m_pipeline.options();
    const int port = ofReferee     ? options.refereePort
                     : isVariables ? options.variablesPortBase + 1
                                   : 0;
    const auto after = std::chrono::duration<double>(m_time);
    const std::string_view address = source.sender.substr(0, source.sender.find(':'));
    const auto sender = parseAddress(std::string(address));
    m_pipeline.take({WallTime(std::chrono::duration_cast<Duration>(after)),
                     {sender ? *sender : Address{}, 0},
                     static_cast<std::uint16_t>(port),
                     false,
                     payload});
  }

  void received(const link::LiveDatagram& datagram) override {
    if (!isGood(datagram)) m_exitCode = 1;
    if (datagram.decoded != nullptr) noteFields(*datagram.decoded);
    m_line.clear();
    if (m_json) {
      addMessageJson(m_line, head(), datagram, m_pipeline.options());
    } else {
      addMessageLine(m_line, datagram, m_pipeline.options());
    }
    m_line += '\n';
    std::fwrite(m_line.data(), 1, m_line.size(), stdout);
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
      if (i < m_wasSent.size() && m_wasSent[i]) continue;
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
    m_wasSent.resize(fields);
    for (std::size_t i = 0; i < std::min(fields, decoded.count); ++i) {
      if (decoded.has(i) || !decoded.texts[i].empty()) m_wasSent[i] = true;
    }
    for (std::size_t i = 0; i < decoded.namedExtras; ++i) m_otherKeys.emplace(decoded.extraKeys[i]);
  }

  /// What stands before the content of a datagram.
  Json head() const {
    Json head{{"file", m_source->file}};
    if (m_source->line > 0) head["line"] = m_source->line;
    if (m_source->time) {
      head["time"] = *m_source->time;
      head["sender"] = printable(m_source->sender);
    }
    return head;
  }

  const bool m_json;
  link::LivePipeline m_pipeline;
  const Source* m_source = nullptr;  // of the datagram that is being taken
  std::string m_line;
  double m_time = 0.0;  // s
  int m_exitCode = 0;
  bool m_anyMessage = false;
  std::vector<bool> m_wasSent;  // of each field of the profile
  std::set<std::string, std::less<>> m_otherKeys;
};

/// One in a file, or lines of JSON.
Result<int> decodeStored(const DecodeOptions& options, Decoder& decoder, bool ofReferee) {
  for (const std::string& name : options.files) {
    auto file = TRY(LineFile::open(name));
    if (TRY(file.first()) != '{') {
      const auto bytes = TRY(file.all());
      decoder.take({name}, bytes, ofReferee);
      continue;
    }
    while (const auto line = TRY(file.next())) {
      if (line->find_first_not_of(" \t\r") == line->npos) continue;
      const auto bytes = TRY(packetOf(*line, name, file.number()));
      decoder.take({name, file.number()}, bytes, ofReferee);
    }
  }
  return decoder.exitCode();
}

Result<int> decodeTelemetry(const DecodeOptions& options) {
  link::LiveOptions live;
  TRY(setOptions(live, link::liveOptionTable(), options.given));
  Decoder decoder(std::move(live), options.json);
  if (!isTextFormat(decoder.options().profile.format)) {
    return decodeStored(options, decoder, false);
  }
  for (const std::string& name : options.files) {
    auto file = TRY(LineFile::open(name));
    while (const auto line = TRY(file.next())) {
      const CapturedLine captured = splitLine(*line);
      decoder.take({name, file.number(), captured.time, captured.sender}, captured.datagram, false);
    }
    if (file.number() == 0) return failure(ErrorCode::ParseError, "The file is empty.", name);
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
  shared::addOptions(*telemetry, {&link::liveOption("profileFile"), 1}, link::LiveOptions(),
                     text->given);
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
