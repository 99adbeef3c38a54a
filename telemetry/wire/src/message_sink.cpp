// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

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

void FieldSink::number(std::string_view key, double value) {
  std::size_t index = 0;
  if (const ProfileField* field = m_map->find(key, index)) setNumber(*field, index, value, *m_out);
}

void FieldSink::word(std::string_view key, std::string_view text) {
  std::size_t index = 0;
  if (const ProfileField* field = m_map->find(key, index)) setWord(*field, index, text, *m_out);
}

void FieldSink::passingWord(std::string_view key, std::string_view text) {
  std::size_t index = 0;
  const ProfileField* field = m_map->find(key, index);
  if (field != nullptr) setWord(*field, index, keep(text, *m_out), *m_out);
}

}  // namespace pitchboard::telemetry
