// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/rerun/program_watch.h>

#include <sys/stat.h>
#include <filesystem>
#include <set>

#include "rerun_program.h"

namespace pitchboard::link {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t maxNeighbours = 1000;

bool isPlainFile(const std::string& path) {
  std::error_code code;
  return fs::is_regular_file(path, code);
}

/// The .py files in the folder of this one, which may import them.
void addNeighbours(const fs::path& script, std::set<std::string>& files) {
  const fs::path folder = script.has_parent_path() ? script.parent_path() : fs::path(".");
  std::error_code code;
  std::size_t count = 0;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end;
       entry.increment(code)) {
    if (entry->path().extension() != ".py" || !isPlainFile(entry->path().string())) continue;
    files.insert(entry->path().string());
    if (++count == maxNeighbours) return;
  }
}

/// Whole profiles as the processes they consist of; none of one that cannot be read.
std::vector<RerunProcess> eachProcess(std::span<const RerunProcess> processes) {
  std::vector<RerunProcess> all;
  for (const RerunProcess& process : processes) {
    if (!process.name.empty()) {
      all.push_back(process);
      continue;
    }
    const auto runtime = runtimeChoiceFromText(process.program);
    const auto profile = runtime ? loadRuntime(*runtime) : tl::unexpected(runtime.error());
    if (!profile) continue;
    for (const ProfileProcess& one : profile->processes) {
      all.push_back({one.name, process.program});
    }
  }
  return all;
}

}  // namespace

std::vector<std::string> programFiles(std::span<const RerunProcess> processes) {
  std::set<std::string> files;
  for (const RerunProcess& process : eachProcess(processes)) {
    const auto choice = rerunChoice(process, {});
    if (!choice || choice->isInside) continue;
    const std::string profile = process.program.substr(0, process.program.find(':'));
    if (profile.ends_with(".json") && isPlainFile(profile)) files.insert(profile);
    for (const std::string& word : choice->command) {
      fs::path path(word);
      if (path.is_relative() && !choice->directory.empty()) path = choice->directory / path;
      if (!isPlainFile(path.string())) continue;
      files.insert(path.string());
      if (path.extension() == ".py") addNeighbours(path, files);
    }
  }
  return {files.begin(), files.end()};
}

ProgramWatch::ProgramWatch(std::vector<RerunProcess> processes)
    : m_processes(std::move(processes)),
      m_files(programFiles(m_processes)),
      m_known(look(m_files)),
      m_seen(m_known) {}

ProgramWatch::Stamps ProgramWatch::look(const std::vector<std::string>& files) {
  Stamps stamps;
  for (const std::string& file : files) {
    Stamp& stamp = stamps[file];
    struct stat info {};
    if (::stat(file.c_str(), &info) != 0) continue;
    stamp = {info.st_mtim.tv_sec, info.st_mtim.tv_nsec, static_cast<std::uint64_t>(info.st_size),
             info.st_ino, true};
  }
  return stamps;
}

bool ProgramWatch::hasChanged(Time now) {
  Stamps seen = look(m_files);
  if (seen != m_seen) {
    m_seen = std::move(seen);
    m_since = now;
    return false;
  }
  if (m_seen == m_known || now - m_since < settleTime) return false;
  for (const auto& [file, stamp] : m_seen) {
    const Stamp& before = m_known[file];
    if (before.exists && (!stamp.exists || (stamp.size == 0 && before.size > 0))) return false;
    if (stamp != before) m_changed = fs::path(file).filename().string();
  }
  // It may have got neighbours, or a profile another program.
  m_files = programFiles(m_processes);
  m_known = m_seen = look(m_files);
  return true;
}

}  // namespace pitchboard::link
