// SPDX-License-Identifier: GPL-3.0-or-later
#include "json_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace pitchboard::cli {
namespace {

bool isPlain(char c) {
  return c >= 0x20 && c < 0x7f && c != '"' && c != '\\';
}

}  // namespace

void addJsonText(std::string& out, std::string_view text) {
  if (std::ranges::all_of(text, isPlain)) {
    out.append(1, '"').append(text).append(1, '"');
    return;
  }
  out += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void addJsonNumber(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  std::array<char, 64> text;
  out.append(text.data(),
             nlohmann::detail::to_chars(text.data(), text.data() + text.size(), value));
}

void addJsonKey(std::string& out, std::string_view key) {
  if (!out.ends_with('{')) out += ',';
  addJsonText(out, key);
  out += ':';
}

}  // namespace pitchboard::cli
