// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <telemetry/formats/profile_names.h>
#include "message_readers.h"

namespace pitchboard::telemetry {

FieldMap::FieldMap(const Profile& profile) : m_fields(&profile.fields) {
  for (std::size_t i = 0; i < profile.fields.size(); ++i) {
    m_indices.emplace_back(profile.fields[i].sentName(), i);
  }
  std::stable_sort(m_indices.begin(), m_indices.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
}

const ProfileField* FieldMap::find(std::string_view key, std::size_t& index) const {
  const auto found = std::lower_bound(
      m_indices.begin(), m_indices.end(), key,
      [](const auto& entry, std::string_view wanted) { return entry.first < wanted; });
  if (found == m_indices.end() || found->first != key) return nullptr;
  index = found->second;
  return &(*m_fields)[index];
}

/// Makes room for a value that the profile does not name, or finds it.
bool FieldSink::extra(std::string_view key, std::size_t& index) {
  if (!m_keepsExtras || key.empty()) return false;
  // As a name: without white space, of bounded length.
  std::array<char, profile_names::maxNameBytes> name{};
  const std::size_t length = std::min(key.size(), name.size());
  std::transform(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(length), name.begin(),
                 [](char c) { return c > ' ' && c < 0x7f ? c : '_'; });
  const std::string_view wanted(name.data(), length);
  const auto end = m_out->extraKeys.begin() + static_cast<std::ptrdiff_t>(m_out->namedExtras);
  const auto known = std::find(m_out->extraKeys.begin(), end, wanted);
  index = m_firstExtra + static_cast<std::size_t>(known - m_out->extraKeys.begin());
  if (known != end) return true;
  if (known == m_out->extraKeys.end() || index >= DecodedText::maxValues) {
    ++m_out->dropped;
    return false;
  }
  *known = keep(wanted, *m_out);
  if (known->empty()) {
    ++m_out->dropped;
    return false;
  }
  ++m_out->namedExtras;
  ++m_out->count;
  return true;
}

void FieldSink::number(std::string_view key, double value) {
  std::size_t index = 0;
  if (const ProfileField* field = m_map->find(key, index)) {
    setNumber(*field, index, value, *m_out);
  } else if (extra(key, index)) {
    m_out->texts[index] = numberText(value, *m_out);
    m_out->values[index] = value;
  }
}

void FieldSink::addText(std::string_view key, std::string_view text) {
  std::size_t index = 0;
  if (const ProfileField* field = m_map->find(key, index)) {
    setText(*field, index, text, *m_out);
  } else if (extra(key, index)) {
    // It may be anything until the team gives it a type: it is kept as text.
    m_out->texts[index] = text;
    m_out->values[index] = readFloat(text).value;
  }
}

void FieldSink::addTemporaryText(std::string_view key, std::string_view text) {
  addText(key, keep(text, *m_out));
}

void FieldSink::addUnquoted(std::string_view key, std::string_view text) {
  const auto error = readFloat(text).error;
  std::size_t index = 0;
  if (!error || error == TextError::NotANumber || m_map->find(key, index)) {
    addText(key, text);
  } else if (extra(key, index)) {
    // Kept as a text, it would make a column of texts of a column of numbers.
    m_out->texts[index] = {};
    m_out->values[index] = missing;
    addError(*error, index, *m_out);
  }
}

void FieldSink::addTemporaryUnquoted(std::string_view key, std::string_view text) {
  addUnquoted(key, keep(text, *m_out));
}

}  // namespace pitchboard::telemetry
