// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/blackboard/variable_catalog.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <tuple>
#include <unordered_map>

#include <base/read_file.h>
#include <base/try.h>
#include <resources/resources.h>

#include "catalog/catalog_reading.h"
#include "catalog_reading.h"

namespace pitchboard::link {
namespace {

const char* typeName(VariableType type) {
  return type == VariableType::Int ? "int" : "float";
}

// Names come from a file; a message quotes them, so it must stay one readable line.
std::string inQuotes(std::string_view name) {
  std::string text = "\"";
  for (const char c : name.substr(0, 64)) text += (c < ' ' || c == '\x7f') ? '?' : c;
  return text + (name.size() > 64 ? "...\"" : "\"");
}

std::string slot(VariableType type, long long index) {
  return std::string(typeName(type)) + " " + std::to_string(index);
}

/// Where a name is looked for first in a hash table of `size` slots.
std::size_t firstSlot(std::string_view name, std::size_t size) {
  return std::hash<std::string_view>{}(name) & (size - 1);
}

long long wordOf(const CatalogEntry& entry, const SegmentLayout& layout) {
  return entry.type == VariableType::Int ? entry.index : layout.floatOffset + entry.index;
}

}  // namespace

std::string atLine(std::string_view source, int line) {
  return std::string(source) + ":" + std::to_string(line);
}

std::optional<long long> parseIndex(std::string_view digits) {
  int base = 10;
  if (digits.size() > 2 && digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X')) {
    base = 16;
    digits.remove_prefix(2);
  } else if (digits.size() > 1 && digits[0] == '0') {
    base = 8;
    digits.remove_prefix(1);
  }
  long long value = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (digits.empty() || digits[0] == '-' || end != digits.data() + digits.size())
    return std::nullopt;
  return error == std::errc::result_out_of_range ? absurdIndex : value;
}

bool isIdentifier(std::string_view name) {
  const auto letter = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
  };
  return !name.empty() && letter(name.front()) &&
         std::ranges::all_of(name, [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

std::optional<Error> checkCatalogText(std::string_view& text, std::string_view source) {
  if (text.size() > maxCatalogBytes)
    return Error{
        ErrorCode::ParseError,
        "the file has " + std::to_string(text.size()) +
            " bytes; a variable catalog has at most 1 MiB. Choose the team's blackboard.h, "
            "SharedMemory.py or a catalog in JSON",
        std::string(source)};
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  int line = 1;
  for (const char c : text) {
    if (c == '\n') ++line;
    const bool control =
        static_cast<unsigned char>(c) < ' ' && std::strchr("\t\n\v\f\r", c) == nullptr;
    if (control || c == '\0')
      return Error{ErrorCode::ParseError,
                   "this is not a text file: it holds the byte " +
                       std::to_string(static_cast<unsigned char>(c)),
                   atLine(source, line)};
  }
  if (text.find_first_not_of(" \t\n\v\f\r") == std::string_view::npos)
    return Error{ErrorCode::ParseError, "the file is empty", std::string(source)};
  return std::nullopt;
}

// Constants that need parsing: made once and never changed.
const VariableCatalog& VariableCatalog::published() {
  static const VariableCatalog catalog = builtIn("blackboard.json");
  return catalog;
}

const VariableCatalog& VariableCatalog::extended() {
  static const VariableCatalog catalog = published().withExtension();
  return catalog;
}

VariableCatalog VariableCatalog::withExtension() const {
  static const VariableCatalog extension = builtIn("blackboard_extension.json");
  const auto word = [](const Variable& variable) {
    return variable.index + (variable.type == VariableType::Float ? Blackboard::floatOffset : 0);
  };
  std::vector<int> words;
  words.reserve(m_variables.size());
  for (const Variable& own : m_variables) words.push_back(word(own));
  std::ranges::sort(words);
  VariableCatalog out = *this;
  for (const Variable& more : extension.variables()) {
    const bool taken = find(more.name) || std::ranges::binary_search(words, word(more));
    if (!taken) out.m_variables.push_back(more);
  }
  out.sort();
  return out;
}

void VariableCatalog::sort() {
  std::ranges::sort(m_variables, [](const Variable& a, const Variable& b) {
    return std::tie(a.type, a.index) < std::tie(b.type, b.index);
  });
  m_byName.assign(std::bit_ceil(2 * m_variables.size()), 0);
  for (std::size_t i = 0; i < m_variables.size(); ++i) {
    std::size_t at = firstSlot(m_variables[i].name, m_byName.size());
    while (m_byName[at] != 0) at = (at + 1) % m_byName.size();
    m_byName[at] = static_cast<std::uint32_t>(i + 1);
  }
}

VariableCatalog VariableCatalog::builtIn(const char* resource) {
  auto read = fromJson(resourceText(resource), resource);
  if (!read) {
    std::fprintf(stderr, "pitchboard: built-in %s\n", read.error().text().c_str());
    std::abort();
  }
  return *std::move(read);
}

Result<VariableCatalog> VariableCatalog::fromFile(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  auto* const reader = extension == ".json" ? &fromJson
                       : extension == ".h" || extension == ".hpp" || extension == ".hh"
                           ? &fromHeader
                       : extension == ".py" ? &fromPython
                                            : nullptr;
  if (reader == nullptr)
    return failure(ErrorCode::Unsupported,
                   "unknown file type; a variable catalog is a .json, .h, .hpp or .py file", path);
  const auto text = TRY(readFile(path, maxCatalogBytes, "The variable catalog"));
  return reader(text, path);
}

Result<VariableCatalog> VariableCatalog::fromFile(const std::string& path, SegmentLayout& layout) {
  if (std::filesystem::path(path).extension() != ".json") return fromFile(path);
  const auto text = TRY(readFile(path, maxCatalogBytes, "The variable catalog"));
  return readJson(text, path, layout, true);
}

Result<VariableCatalog> VariableCatalog::make(const std::vector<CatalogEntry>& entries,
                                              std::string_view source,
                                              const SegmentLayout& layout) {
  if (entries.empty())
    return failure(ErrorCode::ParseError, "no variable is defined here", std::string(source));
  VariableCatalog catalog;
  const auto size = static_cast<std::size_t>(layout.words());
  std::vector<const CatalogEntry*> ints(size), floats(size);
  // Both kinds by the word that they occupy.
  std::vector<const CatalogEntry*> words(size);
  std::unordered_map<std::string_view, const CatalogEntry*> accepted;
  for (const CatalogEntry& entry : entries) {
    if (!isIdentifier(entry.name))
      return failure(ErrorCode::ParseError,
                     inQuotes(entry.name) +
                         " is not a variable name; use letters, digits and _, a letter first",
                     entry.where);
    const long long count =
        entry.type == VariableType::Int ? layout.words() : layout.words() - layout.floatOffset;
    if (entry.index < 0 || entry.index >= count)
      return failure(
          ErrorCode::ParseError,
          inQuotes(entry.name) + " has the index " +
              (entry.index >= absurdIndex ? "of a huge number" : std::to_string(entry.index)) +
              "; " + typeName(entry.type) + " variables go from 0 to " + std::to_string(count - 1),
          entry.where);
    if (const auto other = accepted.find(entry.name); other != accepted.end())
      return failure(ErrorCode::ParseError,
                     inQuotes(entry.name) + " is defined twice, first in " + other->second->where,
                     entry.where);
    const auto index = static_cast<std::size_t>(entry.index);
    const CatalogEntry*& place = entry.type == VariableType::Int ? ints[index] : floats[index];
    if (place != nullptr)
      return failure(ErrorCode::ParseError,
                     inQuotes(entry.name) + " and " + inQuotes(place->name) + " (" + place->where +
                         ") are both " + slot(entry.type, entry.index),
                     entry.where);
    const CatalogEntry*& word = words[static_cast<std::size_t>(wordOf(entry, layout))];
    if (word != nullptr)
      return failure(ErrorCode::ParseError,
                     inQuotes(entry.name) + " (" + slot(entry.type, entry.index) + ") lies on " +
                         inQuotes(word->name) + " (" + slot(word->type, word->index) + ", " +
                         word->where + "): float 0 is word " + std::to_string(layout.floatOffset),
                     entry.where);
    place = word = &entry;
    accepted.emplace(entry.name, &entry);
    catalog.m_variables.push_back({entry.name, entry.type, static_cast<int>(entry.index)});
  }
  catalog.sort();
  return catalog;
}

const Variable* VariableCatalog::find(std::string_view name) const {
  if (m_byName.empty()) return nullptr;
  for (std::size_t at = firstSlot(name, m_byName.size()); m_byName[at] != 0;
       at = (at + 1) % m_byName.size()) {
    const Variable& variable = m_variables[m_byName[at] - 1];
    if (variable.name == name) return &variable;
  }
  return nullptr;
}

std::optional<IntVar> VariableCatalog::intVar(std::string_view name) const {
  const Variable* const found = find(name);
  if (found == nullptr || found->type != VariableType::Int) return std::nullopt;
  return IntVar{found->index};
}

std::optional<FloatVar> VariableCatalog::floatVar(std::string_view name) const {
  const Variable* const found = find(name);
  if (found == nullptr || found->type != VariableType::Float) return std::nullopt;
  return FloatVar{found->index};
}

}  // namespace pitchboard::link
