// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/import/aligned_recordings.h>
#include <robotlink/session/session_events.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include <telemetry/formats/text_errors.h>
#include <telemetry/series/group_attributes.h>
#include <telemetry/series/group_order.h>

#include "commands.h"
#include "interrupt.h"
#include "live_json.h"
#include "progress.h"
#include "session_list.h"

namespace pitchboard::cli {
namespace {

using namespace telemetry;

struct InspectOptions {
  std::vector<std::string> places;
  bool json = false, csv = false, events = false, progress = false;
  const std::string& file() const { return places.front(); }
};

constexpr std::array<std::string_view, sessionStreamCount> streamNames{
    "events", "log", "telemetry", "referee/raw", "referee", "checkpoints", "live/state"};

/// A channel that is not in our format.
struct Topic {
  std::string name, encoding, schema, schemaEncoding;
  std::uint64_t messages = 0;
};

std::vector<Topic> otherTopics(const SessionReader& session) {
  const McapContents& contents = session.file().contents();
  std::vector<Topic> topics;
  for (const std::uint16_t id : session.otherChannels()) {
    const McapChannel& channel = contents.channels.at(id);
    Topic topic{channel.topic, channel.messageEncoding, {}, {}};
    if (const auto schema = contents.schemas.find(channel.schema);
        schema != contents.schemas.end()) {
      topic.schema = schema->second.name;
      topic.schemaEncoding = schema->second.encoding;
    }
    const auto counted = contents.statistics.perChannel.find(id);
    if (counted != contents.statistics.perChannel.end()) topic.messages = counted->second;
    topics.push_back(std::move(topic));
  }
  std::ranges::sort(topics, {}, &Topic::name);
  return topics;
}

Json toJson(const SessionReader& session, const InspectOptions& options) {
  const SessionInfo& info = session.info();
  Json out{{"file", options.file()},         {"bytes", session.file().contents().fileBytes},
           {"complete", session.complete()}, {"recording", session.isGrowing()},
           {"damaged", session.isDamaged()}, {"program", info.program},
           {"source", info.source},          {"title", info.title}};
  if (info.seed) out["seed"] = *info.seed;
  out["start"] = unixSeconds(info.start);
  out["created"] = unixSeconds(info.created);
  out["more"] = info.more;
  if (const auto range = session.range()) {
    out["from"] = range->begin;
    out["until"] = range->end;
  }
  out["groups"] = Json::array();
  for (const std::size_t g : listedOrder(session.groups(), &SessionGroup::info)) {
    const SessionGroup& group = session.groups()[g];
    Json columns = Json::array();
    for (const ColumnInfo& column : group.info.columns) columns.push_back(column.name);
    out["groups"].push_back({{"name", group.info.name},
                             {"rows", group.rows},
                             {"attributes", telemetry::attributesOf(group.info)},
                             {"columns", columns}});
  }
  out["messages"] = Json::object();
  for (std::size_t i = 0; i < streamNames.size(); ++i) {
    out["messages"][std::string(streamNames[i])] = session.count(static_cast<SessionStream>(i));
  }
  out["topics"] = Json::array();
  for (const Topic& topic : otherTopics(session)) {
    out["topics"].push_back({{"topic", topic.name},
                             {"messages", topic.messages},
                             {"encoding", topic.encoding},
                             {"schema", topic.schema},
                             {"schemaEncoding", topic.schemaEncoding}});
  }
  out["attachments"] = Json::array();
  for (const auto& attachment : session.file().contents().attachments) {
    out["attachments"].push_back({{"name", attachment.name},
                                  {"mediaType", attachment.mediaType},
                                  {"bytes", attachment.dataSize}});
  }
  if (options.events) {
    out["events"] = Json::array();
    for (const link::MatchEvent& event : link::eventsOf(session)) {
      out["events"].push_back(Json::parse(sessionEventJson(link::sessionEvent(event))));
    }
  }
  out["notes"] = session.notes();
  return out;
}

void printText(const SessionReader& session, const InspectOptions& options) {
  const SessionInfo& info = session.info();
  std::printf("%s: %.3f MB%s\n", options.file().c_str(),
              static_cast<double>(session.file().contents().fileBytes) / 1e6,
              session.isGrowing() ? "; still being recorded"
              : session.complete() && !session.isDamaged()
                  ? ""
                  : "; truncated or damaged: recover it with pitchboard-cli repair");
  if (session.ours()) {
    std::printf("recorded %s by %s, %s \"%s\"", wallText(info.created).c_str(),
                info.program.c_str(), info.source.c_str(), info.title.c_str());
    if (info.seed) std::printf(", seed %llu", static_cast<unsigned long long>(*info.seed));
    std::printf("\n");
  }
  if (const auto aligned = link::alignmentText(info)) {
    std::printf("%s\n", printable(*aligned).c_str());
  }
  if (const auto range = session.range()) {
    std::printf("%.3f s to %.3f s\n", range->begin, range->end);
  }
  for (const std::size_t g : listedOrder(session.groups(), &SessionGroup::info)) {
    const SessionGroup& group = session.groups()[g];
    std::printf("  %-8s %10llu rows of %zu columns\n", group.info.name.c_str(),
                static_cast<unsigned long long>(group.rows), group.info.columns.size());
  }
  for (std::size_t i = 0; i < streamNames.size(); ++i) {
    const auto count = session.count(static_cast<SessionStream>(i));
    if (count > 0) {
      std::printf("  %-11s %7llu messages\n", std::string(streamNames[i]).c_str(),
                  static_cast<unsigned long long>(count));
    }
  }
  for (const Topic& topic : otherTopics(session)) {
    std::printf(
        "  %s %7llu messages  %s (%s)\n", padded(printable(topic.name), 30).c_str(),
        static_cast<unsigned long long>(topic.messages),
        topic.schema.empty() ? "no schema" : printable(topic.schema).c_str(),
        printable(topic.schemaEncoding.empty() ? topic.encoding
                                               : topic.encoding + ", " + topic.schemaEncoding)
            .c_str());
  }
  for (const auto& attachment : session.file().contents().attachments) {
    std::printf("  attachment %s, %llu bytes\n", attachment.name.c_str(),
                static_cast<unsigned long long>(attachment.dataSize));
  }
  if (options.events) {
    for (const link::MatchEvent& event : link::eventsOf(session)) {
      const SessionEvent shown = link::sessionEvent(event);
      std::printf("%10.3f %-10s %-4s %s\n", shown.time, shown.kind.c_str(), shown.group.c_str(),
                  shown.text.c_str());
    }
  }
  for (const std::string& note : session.notes()) std::printf("%s\n", note.c_str());
}

Result<int> inspectSession(const InspectOptions& options) {
  std::error_code unknown;
  if (options.csv || options.places.size() > 1 ||
      std::filesystem::is_directory(options.file(), unknown)) {
    if (options.events) {
      return failure(ErrorCode::InvalidArgument,
                     "--events needs a single recording; `find` searches many.");
    }
    return listSessions({options.places, options.json, options.csv, options.progress});
  }
  const InterruptGuard signals;
  Progress progress("reading", options.progress);
  McapReaderOptions reading;
  reading.progress = std::ref(progress);
  auto session = SessionReader::open(options.file(), reading);
  if (!session) return tl::unexpected(session.error());
  session->check(std::ref(progress));
  if (options.json) {
    std::printf("%s\n", dump(toJson(*session, options)).c_str());
  } else {
    printText(*session, options);
  }
  const bool isReadable = session->complete() || session->isGrowing();
  return isReadable && session->notes().empty() ? 0 : 1;
}

}  // namespace

void addInspectCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<InspectOptions>();
  CLI::App* command =
      parent.add_subcommand("inspect",
                            "Summarize a recording and check all of it. For several recordings, "
                            "or a folder of them, print one line each without checking them: date, "
                            "length, score, teams, robots, events and notes. Exits with 1 if a "
                            "recording is truncated or damaged, or if part of it is unknown, as in "
                            "files of other programs.\n"
                            "Examples: pitchboard-cli inspect match.mcap --events\n"
                            "          pitchboard-cli inspect matches/");
  command->add_option("file", options->places, "One or more recordings, or folders of recordings")
      ->required()
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print a JSON object for each recording");
  command->add_flag("--csv", options->csv, "Print a line of CSV for each recording, after a header")
      ->excludes("--json");
  command->add_flag("--events", options->events, "List the events");
  command->add_flag("--progress", options->progress,
                    "Print progress to stderr even if it is not a terminal");
  whenChosen(*command, options, exitCode, inspectSession);
}

}  // namespace pitchboard::cli
