// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/live_recorder.h>

#include <nlohmann/json.hpp>

#include <robotlink/frame/second_sender.h>
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
  json.update(Json{{"version", r.version},
                   {"sender", r.sender},
                   {"stateName", r.state},
                   {"setPlayName", r.setPlay},
                   {"gamePhaseName", r.phase},
                   {"firstHalf", r.firstHalf},
                   {"stopped", r.stopped ? 1 : 0},
                   {"secsRemaining", r.secondsLeft},
                   {"ourTeam", r.ourTeam}});
  if (r.secondaryTime) json["secondaryTime"] = *r.secondaryTime;
  if (r.kickOffTeam) json["kickOffTeamNumber"] = *r.kickOffTeam;
  for (std::size_t i = 0; i < r.teams.size(); ++i) {
    json["teams"][i].update(Json{{"number", r.teams[i].number},
                                 {"colourName", r.teams[i].colour},
                                 {"score", r.teams[i].score},
                                 {"playersLeft", r.teams[i].playersLeft}});
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
      m_rows(m_writer, rowsOptions(live, zero)),
      m_boards(m_writer) {}

LiveRecorder::~LiveRecorder() = default;

void LiveRecorder::heard(RobotId id, double time, const telemetry::DatagramView& datagram,
                         const telemetry::TextDecoder& decoder,
                         const telemetry::DecodedText& decoded) {
  LiveRecords::heard(id, time, datagram, decoder, decoded);
  m_rows.take(datagram, decoded, decoder, slotOf(id));
}

void LiveRecorder::keep(LiveRecord record) {
  appendRecord(*m_writer, record);
}

void LiveRecorder::happened(const MatchEvent& event) {
  m_writer->append(sessionEvent(event));
}

void LiveRecorder::adopted(const LiveOptions& options) {
  m_rows.setOptions(rowsOptions(options, m_zero));
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
