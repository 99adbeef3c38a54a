// SPDX-License-Identifier: GPL-3.0-or-later
#include "opponent_file.h"

#include <nlohmann/json.hpp>

#include <base/byte_sizes.h>
#include <base/lined_json.h>
#include <base/read_file.h>
#include <base/try.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t mostOpponentBytes = 16 * kibibyte;
constexpr int mostInFile = 65535;

template <std::size_t N>
void readEvidence(const JsonObject& file, std::string_view key, Evidence<N>& evidence) {
  const auto* items = file.array(key, N);
  if (!items) return;
  if (items->size() != N) {
    return file.fail(key, "must have " + std::to_string(N) + " numbers");
  }
  for (std::size_t i = 0; i < N; ++i) {
    const JsonNode& item = (*items)[i];
    const bool isWhole = item.kind == JsonNode::Kind::Number && item.number >= 0.0 &&
                         item.number <= mostInFile &&
                         item.number == static_cast<double>(static_cast<int>(item.number));
    if (!isWhole) return file.fail(key, "must have whole numbers from 0 to 65535");
    evidence.behind[i] = static_cast<std::uint16_t>(item.number);
  }
}

}  // namespace

std::string opponentsToJson(const OpponentModel& model) {
  const nlohmann::ordered_json out{{"version", 1},
                                   {"keeper", model.keeper.behind},
                                   {"aim", model.aim.behind},
                                   {"pace", model.pace.behind}};
  return out.dump() + '\n';
}

Result<OpponentModel> opponentsFromJson(std::string_view text, std::string_view source) {
  JsonReport report(source);
  const auto root = parseJson(text, report);
  OpponentModel read;
  if (root) {
    const JsonObject file(report, *root, "", {"version", "keeper", "aim", "pace"});
    for (const std::string_view key : {"version", "keeper", "aim", "pace"}) file.require(key);
    (void)file.integer("version", 1, 1, 1);
    readEvidence(file, "keeper", read.keeper);
    readEvidence(file, "aim", read.aim);
    readEvidence(file, "pace", read.pace);
  }
  if (report.failed()) return tl::unexpected(report.error());
  return OpponentModel::fromWords(read.asWords());
}

Result<OpponentModel> loadOpponents(const std::string& path) {
  const auto text = readFile(path, mostOpponentBytes, "what the advisor has learned");
  if (!text && text.error().code == ErrorCode::NotFound) return OpponentModel{};
  if (!text) return tl::unexpected(text.error());
  return opponentsFromJson(*text, path);
}

}  // namespace pitchboard::link
