// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "message_readers.h"

namespace pitchboard::telemetry {

FieldMap::FieldMap(const Profile& profile) : m_fields(&profile.fields) {
  for (std::size_t i = 0; i < profile.fields.size(); ++i) {
    m_places.emplace_back(profile.fields[i].sentName(), i);
  }
  std::stable_sort(m_places.begin(), m_places.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
}

const ProfileField* FieldMap::find(std::string_view key, std::size_t& place) const {
  const auto found = std::lower_bound(
      m_places.begin(), m_places.end(), key,
      [](const auto& entry, std::string_view wanted) { return entry.first < wanted; });
  if (found == m_places.end() || found->first != key) return nullptr;
  place = found->second;
  return &(*m_fields)[place];
}

void FieldSink::number(std::string_view key, double value) {
  std::size_t place = 0;
  if (const ProfileField* field = m_map->find(key, place)) setNumber(*field, place, value, *m_out);
}

void FieldSink::word(std::string_view key, std::string_view text) {
  std::size_t place = 0;
  if (const ProfileField* field = m_map->find(key, place)) setWord(*field, place, text, *m_out);
}

void FieldSink::passingWord(std::string_view key, std::string_view text) {
  std::size_t place = 0;
  const ProfileField* field = m_map->find(key, place);
  if (field != nullptr) setWord(*field, place, keep(text, *m_out), *m_out);
}

}  // namespace pitchboard::telemetry
