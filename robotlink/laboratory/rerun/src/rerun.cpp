// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/rerun/rerun.h>

#include <numeric>
#include <set>

#include <base/try.h>
#include <robotlink/processes/runtime_profile.h>
#include <telemetry/session/session_export.h>

#include "rerun_run.h"

namespace pitchboard::link {
namespace {

std::uint64_t sumOver(const RerunResult& result, std::uint64_t ComparedVariable::*member) {
  return std::accumulate(
      result.variables.begin(), result.variables.end(), std::uint64_t{0},
      [member](std::uint64_t sum, const ComparedVariable& one) { return sum + one.*member; });
}

}  // namespace

Result<RerunProcess> rerunProcessFromText(std::string_view text) {
  const std::size_t equals = text.find('=');
  // Names of processes have no colon; that of a profile may be followed by one and values.
  const std::string_view name = text.substr(0, equals);
  const bool isProfile = equals == std::string_view::npos
                             ? text.ends_with(".json") || text == referenceRuntime
                             : name.find(':') != std::string_view::npos;
  if (isProfile) return RerunProcess{{}, std::string(text)};
  if (equals == 0 || equals == std::string_view::npos || equals + 1 == text.size()) {
    return failure(
        ErrorCode::ParseError,
        "\"" + std::string(text) +
            "\" does not have the form PROCESS=PROGRAM; write for example "
            "decision=./decide.py or decision=reference, or name a runtime profile, such "
            "as team.json, to run all of its processes",
        "--process");
  }
  return RerunProcess{std::string(name), std::string(text.substr(equals + 1))};
}

std::uint64_t RerunResult::compared() const {
  return sumOver(*this, &ComparedVariable::compared);
}
std::uint64_t RerunResult::unequal() const {
  return sumOver(*this, &ComparedVariable::unequal);
}
std::uint64_t RerunResult::unchangedToo() const {
  return sumOver(*this, &ComparedVariable::unchangedToo);
}
std::uint64_t RerunResult::stretches() const {
  return sumOver(*this, &ComparedVariable::stretchCount);
}

Result<RerunPlan> planRerun(const telemetry::SessionReader& session, const RerunOptions& options) {
  return RerunRun::plan(session, options);
}

std::vector<std::string> recordedProcesses(const telemetry::GroupInfo& robot) {
  std::set<std::string> processes;
  for (const telemetry::ColumnInfo& column : robot.columns) {
    const bool isWord = column.type != telemetry::ColumnType::Float64;
    if (!isWord && !VariableCatalog::extended().find(column.name)) continue;
    const std::string writer = VariableMeanings::published().writers(column.name).writer;
    if (!writer.empty()) processes.insert(writer);
  }
  return {processes.begin(), processes.end()};
}

Result<RerunResult> rerun(const telemetry::SessionReader& session, const RerunOptions& options) {
  const auto run = TRY(RerunRun::create(session, options));
  return run->finish();
}

Result<RerunResult> rerunToFile(const telemetry::SessionReader& session,
                                const RerunOptions& options, const std::string& path,
                                IfExists ifExists) {
  // Refused before the work begins.
  TRY(FileTarget::at(path, ifExists, session.file().contents().name));
  // Another reader: the file is read by the copy meanwhile.
  const auto again = TRY(telemetry::SessionReader::open(session.file().contents().name));
  const auto run = TRY(RerunRun::create(again, options));
  Result<void> played;
  telemetry::ExportSelection all;
  all.beside = [&](telemetry::SessionWriter& writer, double time) {
    run->setWriter(&writer);
    played = run->advanceTo(time);
    return played.has_value();
  };
  const auto written =
      telemetry::exportFile(session, telemetry::ExportFormat::Mcap, all, path, {}, ifExists);
  if (!played) return tl::unexpected(played.error());
  if (!written) return tl::unexpected(written.error());
  run->setWriter(nullptr);  // it is gone
  return run->finish();
}

}  // namespace pitchboard::link
