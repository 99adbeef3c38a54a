// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/live_recorder.h>

#include <nlohmann/json.hpp>

#include <robotlink/session/session_events.h>
#include <telemetry/referee/referee_json.h>

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string refereeToJson(const telemetry::RefereeState& packet, const MatchFrame& frame) {
  const Game& game = *frame.game;
  Json json{{"time", frame.snapshot.time}};
  json.update(telemetry::refereeJson(packet));
  json["sender"] = frame.reception.sender;
  json["setPlayName"] = labelOf(game.setPlay());
  json["gamePhaseName"] = game.phase == GamePhase::Normal ? "" : labelOf(game.phase);
  json["stopped"] = game.stopped ? 1 : 0;
  json["ourTeam"] = frame.reception.ourTeam;
  for (const bool right : {false, true}) {
    const GameTeam& team = game.teamAt(right);
    json["teams"][right ? 1 : 0]["colourName"] = info(team.colour).name;
    json["teams"][right ? 1 : 0]["playersLeft"] = team.playing();
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

telemetry::SessionInfo liveSessionInfo(const LiveOptions& live, telemetry::WallTime zero,
                                       const std::string& program) {
  telemetry::SessionInfo info;
  info.program = program;
  info.source = "live";
  info.title = "Live";
  info.start = zero;
  info.created = std::chrono::system_clock::now();
  info.more["field"] = live.field.name;
  return info;
}

Result<std::shared_ptr<LiveRecorder>> LiveRecorder::create(const std::string& path,
                                                           const LiveOptions& live,
                                                           telemetry::WallTime zero,
                                                           const RecorderOptions& options) {
  auto writer = telemetry::SessionWriter::create(path, liveSessionInfo(live, zero, options.program),
                                                 options.writer);
  if (!writer) return tl::unexpected(writer.error());
  (*writer)->attach(profileAttachment, "application/json", telemetry::profileText(live.profile));
  return std::shared_ptr<LiveRecorder>(new LiveRecorder(std::move(*writer)));
}

LiveRecorder::~LiveRecorder() = default;

void LiveRecorder::keep(LiveRecord record) {
  appendRecord(*m_writer, record);
}

void LiveRecorder::happened(const MatchEvent& event) {
  m_writer->append(sessionEvent(event));
}

void appendRecord(telemetry::SessionWriter& writer, const LiveRecord& record) {
  using telemetry::SessionStream;
  if (record.stream == SessionStream::Telemetry || record.stream == SessionStream::RefereeRaw) {
    writer.append(record.stream, record.datagram);
  } else {
    writer.appendJson(record.stream, record.time, record.json);
  }
}

}  // namespace pitchboard::link
