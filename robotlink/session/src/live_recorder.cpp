// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/live_recorder.h>

#include <nlohmann/json.hpp>

#include <robotlink/live/live_teams.h>
#include <robotlink/session/session_events.h>
#include <telemetry/wire/referee_json.h>

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string refereeToJson(const telemetry::RefereeState& packet, const RefereeView& r,
                          double time) {
  Json json{{"time", time}};
  json.update(telemetry::refereeJson(packet));
  json["sender"] = r.sender;
  json["setPlayName"] = r.setPlay;
  json["gamePhaseName"] = r.phase;
  json["stopped"] = r.stopped ? 1 : 0;
  json["ourTeam"] = r.ourTeam;
  for (std::size_t i = 0; i < r.teams.size(); ++i) {
    json["teams"][i]["colourName"] = r.teams[i].colour;
    json["teams"][i]["playersLeft"] = r.teams[i].playersLeft;
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
  return std::shared_ptr<LiveRecorder>(new LiveRecorder(std::move(*writer), zero, live));
}

LiveRecorder::LiveRecorder(std::shared_ptr<telemetry::SessionWriter> writer,
                           telemetry::WallTime zero, const LiveOptions& live)
    : LiveRecords(live.refereePort),
      m_writer(std::move(writer)),
      m_zero(zero),
      m_rows(m_writer, rowsOptions(live, teamsOf(live, nullptr), zero)),
      m_boards(m_writer) {}

LiveRecorder::~LiveRecorder() = default;

void LiveRecorder::heard(const RobotKey& robot, double time,
                         const telemetry::DatagramView& datagram,
                         const telemetry::TextDecoder& decoder,
                         const telemetry::DecodedText& decoded) {
  LiveRecords::heard(robot, time, datagram, decoder, decoded);
  m_rows.take(datagram, decoded, decoder, robot);
}

void LiveRecorder::keep(LiveRecord record) {
  appendRecord(*m_writer, record);
}

void LiveRecorder::happened(const MatchEvent& event) {
  m_writer->append(sessionEvent(event));
}

void LiveRecorder::adopted(const LiveOptions& options, const Teams& teams,
                           const std::vector<Renaming>& renamings) {
  m_rows.setOptions(rowsOptions(options, teams, m_zero), renamings);
}

void LiveRecorder::reported(const telemetry::TeamStatus& team) {
  m_rows.report(team);
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
