// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The formats of datagrams that name their values (or have them at places of their own): each
// reader gives every value with its key to a FieldSink. Memory is bounded by the datagram. Private
// to wire; any thread.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "field_values.h"

namespace pitchboard::telemetry {

/// Which key belongs to which field. Immutable.
class FieldMap {
 public:
  explicit FieldMap(const Profile& profile);
  const ProfileField* find(std::string_view key, std::size_t& index) const;

 private:
  const std::vector<ProfileField>* m_fields;
  std::vector<std::pair<std::string, std::size_t>> m_indices;  // by key
};

/// Takes what the profile has a field for. Of the formats whose messages name their values (pairs,
/// JSON, Lua, mitecom) the rest is kept as extras; the others have a known list, from which the
/// profile chooses.
class FieldSink {
 public:
  FieldSink(const FieldMap& map, MessageFormat format, DecodedText& out)
      : m_map(&map),
        m_out(&out),
        m_firstExtra(out.count),
        m_keepsExtras(format == MessageFormat::KeyValue || format == MessageFormat::Json ||
                      format == MessageFormat::Lua || format == MessageFormat::Mitecom) {}
  void number(std::string_view key, double value);
  /// Adds a text that lies in the datagram.
  void addText(std::string_view key, std::string_view text);
  /// Adds a text that is valid only during the call.
  void addTemporaryText(std::string_view key, std::string_view text);
  /// Adds what stands without quotes: a word, or a number that may be nan, inf or too large.
  void addUnquoted(std::string_view key, std::string_view text);
  void addTemporaryUnquoted(std::string_view key, std::string_view text);

 private:
  bool extra(std::string_view key, std::size_t& index);

  const FieldMap* m_map;
  DecodedText* m_out;
  std::size_t m_firstExtra;
  bool m_keepsExtras;
};

// Each says whether the whole datagram was of the format.
bool readKeyValue(std::string_view text, char separator, FieldSink& sink);
bool readJson(std::string_view text, FieldSink& sink);
bool readLua(std::string_view text, FieldSink& sink);
bool readMitecom(std::string_view bytes, FieldSink& sink);
bool readHulks(std::string_view bytes, FieldSink& sink);
bool readCitBrains(std::string_view bytes, FieldSink& sink);
bool readProtobuf(const std::string& message, std::string_view bytes, FieldSink& sink);
/// Numbers at fixed places. A datagram that ends before a field that is not optional is Truncated.
bool readBinary(const Profile& profile, std::string_view bytes, DecodedText& out);

}  // namespace pitchboard::telemetry
