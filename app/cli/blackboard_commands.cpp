// SPDX-License-Identifier: GPL-3.0-or-later
#include <pwd.h>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include <base/try.h>

#include "blackboard_target.h"

namespace pitchboard::cli {
namespace {

using link::SegmentInfo;
using link::SystemVSegments;

std::string ownerName(uid_t owner) {
  const passwd* const entry = getpwuid(owner);
  return entry != nullptr ? entry->pw_name : std::to_string(owner);
}

const char* stateOf(const SegmentInfo& info) {
  if (!info.blackboardSized) return "wrong size";
  if (info.orphan) return "orphan";
  return info.attached > 0 ? "in use" : "idle";
}

int listBlackboards(int keyBase, bool asJson) {
  const auto segments = SystemVSegments::list(keyBase);
  if (asJson) {
    auto rows = nlohmann::ordered_json::array();
    for (const SegmentInfo& info : segments) {
      nlohmann::ordered_json row;
      row["robot"] = (info.key - keyBase) / 100;
      row["key"] = info.key;
      row["bytes"] = info.bytes;
      row["mode"] = info.mode;
      row["owner"] = info.owner;
      row["creator"] = info.creator;
      row["last_user"] = info.lastUser;
      row["attached"] = info.attached;
      row["blackboard"] = info.blackboardSized;
      row["orphan"] = info.orphan;
      rows.push_back(std::move(row));
    }
    std::printf("%s\n", rows.dump(1).c_str());
    return 0;
  }
  if (segments.empty()) {
    std::printf("No blackboards with keys %d to %d.\n", keyBase + 100, keyBase + 6400);
    return 0;
  }
  std::printf("%5s  %10s  %6s  %4s  %-12s  %8s  %8s  %s\n", "robot", "key", "bytes", "mode",
              "owner", "creator", "attached", "state");
  bool orphans = false;
  for (const SegmentInfo& info : segments) {
    std::printf("%5d  %10d  %6zu  %04o  %-12s  %8d  %8lu  %s\n", (info.key - keyBase) / 100,
                info.key, info.bytes, info.mode, ownerName(info.owner).c_str(), info.creator,
                info.attached, stateOf(info));
    orphans = orphans || info.orphan;
  }
  if (orphans)
    std::printf(
        "\nOrphans were left by programs that have ended. Remove them with\n"
        "  pitchboard-cli blackboard remove --orphans\n");
  return 0;
}

struct RemoveOptions {
  std::vector<int> robots;
  int key = 0;
  int keyBase = 0;
  bool orphans = false;
  bool force = false;
};

Result<std::vector<int>> keysToRemove(const RemoveOptions& options) {
  std::vector<int> keys;
  if (options.orphans) {
    if (!options.robots.empty() || options.key != 0)
      return failure(ErrorCode::InvalidArgument,
                     "--orphans and robots cannot be used together; leave out one of them");
    for (const SegmentInfo& info : SystemVSegments::list(options.keyBase)) {
      if (info.orphan) keys.push_back(info.key);
    }
    return keys;
  }
  for (const int robot : options.robots)
    keys.push_back(link::blackboardKey(RobotId{robot}, options.keyBase));
  if (options.key != 0) keys.push_back(options.key);
  if (keys.empty())
    return failure(ErrorCode::InvalidArgument, "give robot numbers, --key or --orphans");
  return keys;
}

Result<int> removeBlackboards(RemoveOptions& options) {
  const auto keys = TRY(keysToRemove(options));
  if (keys.empty()) std::printf("No orphans.\n");
  int worst = 0;
  for (const int key : keys) {
    const auto info = SystemVSegments::info(key);
    if (!info) {
      worst = reportError(info.error());
      continue;
    }
    if (info->attached > 0 && !options.force) {
      worst = reportError({ErrorCode::Conflict,
                           std::to_string(info->attached) +
                               " processes are attached. End them first, or add --force (they "
                               "would keep a blackboard that no other program can find)",
                           "blackboard " + std::to_string(key)});
      continue;
    }
    const auto removed = SystemVSegments::remove(key);
    if (removed)
      std::printf("removed %d\n", key);
    else
      worst = reportError(removed.error());
  }
  return worst;
}

void addListCommand(CLI::App& parent, int& exitCode) {
  struct Options {
    int keyBase = 0;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  auto* const command = parent.add_subcommand(
      "list",
      "List the blackboards on this computer with owner and attached processes.\n"
      "Example: pitchboard-cli blackboard list");
  command->add_option("--key-base", options->keyBase, "Added to 100 x robot number")
      ->type_name("B")
      ->check(CLI::Range(0, 2'000'000'000));
  command->add_flag("--json", options->json, "Print JSON");
  command->callback(
      [options, &exitCode] { exitCode = listBlackboards(options->keyBase, options->json); });
}

void addCreateCommand(CLI::App& parent, int& exitCode) {
  const auto target = std::make_shared<BlackboardTarget>();
  auto* const command =
      parent.add_subcommand("create",
                            "Create a zeroed blackboard that stays until it is removed.\n"
                            "Example: pitchboard-cli blackboard create 1");
  target->addTo(*command);
  whenChosen(*command, target, exitCode, [](BlackboardTarget& chosen) -> Result<int> {
    const int key = TRY(chosen.resolve());
    TRY(SystemVSegments::create(key));
    std::printf("created %d\n", key);
    return 0;
  });
}

void addRemoveCommand(CLI::App& parent, int& exitCode) {
  const auto options = std::make_shared<RemoveOptions>();
  auto* const command =
      parent.add_subcommand("remove",
                            "Remove blackboards. One with attached processes needs --force.\n"
                            "Example: pitchboard-cli blackboard remove --orphans");
  command->add_option("ROBOT", options->robots, "Robot numbers")->check(CLI::Range(1, 64));
  command->add_option("--key", options->key, "System V key instead of a robot number")
      ->type_name("K")
      ->check(CLI::PositiveNumber);
  command->add_option("--key-base", options->keyBase, "Added to 100 x robot number")
      ->type_name("B")
      ->check(CLI::Range(0, 2'000'000'000));
  command->add_flag("--orphans", options->orphans,
                    "Remove all Pitchboard blackboards without users whose creator has ended");
  command->add_flag("--force", options->force, "Remove it even if processes are attached");
  whenChosen(*command, options, exitCode, removeBlackboards);
}

}  // namespace

void addBlackboardCommands(CLI::App& parent, int& exitCode) {
  auto* const group = parent.add_subcommand("blackboard",
                                            "List, read and change robots' blackboards.\n"
                                            "Example: pitchboard-cli blackboard dump 1");
  group->require_subcommand(1);
  addListCommand(*group, exitCode);
  addDumpCommand(*group, exitCode);
  addWatchCommand(*group, exitCode);
  addSetCommand(*group, exitCode);
  addCreateCommand(*group, exitCode);
  addRemoveCommand(*group, exitCode);
}

}  // namespace pitchboard::cli
