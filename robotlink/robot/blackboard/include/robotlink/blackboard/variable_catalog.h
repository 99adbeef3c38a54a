// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A catalog maps the names of variables to their places on the blackboard. It is data, because
// every team edits its map: the default is resources/blackboard.json (the published map), and
// others are read from a team's blackboard.h or SharedMemory.py. Plain values; any thread.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/blackboard/blackboard.h>

namespace pitchboard::link {

enum class VariableType { Int, Float };

struct Variable {
  std::string name;
  VariableType type = VariableType::Int;
  int index = 0;
  bool operator==(const Variable&) const = default;
};

/// The layout of a segment: ints begin at word 0, floats at another one.
struct SegmentLayout {
  static constexpr std::size_t maxBytes = std::size_t{1} << 20;
  std::size_t bytes = Blackboard::bytes;
  int floatOffset = Blackboard::floatOffset;  ///< words
  int words() const { return static_cast<int>(bytes / 4); }
  bool operator==(const SegmentLayout&) const = default;
};

struct CatalogEntry;  // a variable and the line it was read from; private to the readers

/// An immutable catalog in which every variable has a unique name and a word of its own.
class VariableCatalog {
 public:
  /// Returns the published map of 83 int and 122 float variables.
  static const VariableCatalog& published();
  /// Returns the published map with its extension (docs/blackboard.md).
  static const VariableCatalog& extended();

  // Each fails with file, line (or JSON path) and the problem; `source` is the name of the file.
  static Result<VariableCatalog> fromJson(std::string_view text, std::string_view source);
  static Result<VariableCatalog> fromHeader(std::string_view text, std::string_view source);
  static Result<VariableCatalog> fromPython(std::string_view text, std::string_view source);
  /// Reads a file and chooses the format by its extension (.json, .h/.hpp, .py).
  static Result<VariableCatalog> fromFile(const std::string& path);
  /// The same for a segment that is only read and may have another layout: `layout` is the default,
  /// and is replaced by the file's "segment" if there is one.
  static Result<VariableCatalog> fromFile(const std::string& path, SegmentLayout& layout);

  /// Adds the variables of the extension whose names and words are free here.
  VariableCatalog withExtension() const;
  /// Returns the catalog in the format of blackboard.json, for a segment of this layout.
  std::string toJson(const SegmentLayout& layout = {}) const;

  /// Returns ints in order of index, then floats in order of index.
  std::span<const Variable> variables() const { return m_variables; }
  const Variable* find(std::string_view name) const;
  std::optional<IntVar> intVar(std::string_view name) const;
  std::optional<FloatVar> floatVar(std::string_view name) const;

  bool operator==(const VariableCatalog& other) const { return m_variables == other.m_variables; }

 private:
  static Result<VariableCatalog> readJson(std::string_view text, std::string_view source,
                                          SegmentLayout& layout, bool anyLayout);
  static Result<VariableCatalog> make(const std::vector<CatalogEntry>& entries,
                                      std::string_view source, const SegmentLayout& layout = {});
  static VariableCatalog builtIn(const char* resource);
  void sort();
  std::vector<Variable> m_variables;
  /// A hash table of the names: 1 + the index of a variable, or 0. Its size is a power of two.
  std::vector<std::uint32_t> m_byName;
};

}  // namespace pitchboard::link
