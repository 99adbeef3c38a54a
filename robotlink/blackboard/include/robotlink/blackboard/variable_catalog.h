// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Names of the blackboard's variables: data, because every team edits its map. The default is
// resources/blackboard.json (the published map); others are read from a team's own blackboard.h
// (both header forms) or SharedMemory.py.

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

/// Where a segment has its variables: ints from word 0 on, floats from another one on.
struct SegmentLayout {
  static constexpr std::size_t mostBytes = std::size_t{1} << 20;
  std::size_t bytes = Blackboard::bytes;
  int floatOffset = Blackboard::floatOffset;  ///< words
  int words() const { return static_cast<int>(bytes / 4); }
  bool operator==(const SegmentLayout&) const = default;
};

struct CatalogEntry;  // a variable and the line it was read from; private to the readers

/// A value that never changes once read: every variable has a name, and a word of its own.
class VariableCatalog {
 public:
  /// The published map of 83 int and 122 float variables.
  static const VariableCatalog& published();
  /// The published map and its extension (docs/blackboard.md).
  static const VariableCatalog& extended();

  // Each fails with file, line (or JSON path) and what is wrong; `source` names the file.
  static Result<VariableCatalog> fromJson(std::string_view text, std::string_view source);
  static Result<VariableCatalog> fromHeader(std::string_view text, std::string_view source);
  static Result<VariableCatalog> fromPython(std::string_view text, std::string_view source);
  /// Reads a file and chooses the format by its extension (.json, .h/.hpp, .py).
  static Result<VariableCatalog> fromFile(const std::string& path);
  /// The same for a segment that is only looked at and may be laid out in another way: of the size
  /// in `layout`, or as the file's "segment" says, which is then put there.
  static Result<VariableCatalog> fromFile(const std::string& path, SegmentLayout& layout);

  /// With those variables of the extension whose name and word are free here.
  VariableCatalog withExtension() const;
  /// In the form of blackboard.json.
  std::string toJson() const;

  /// Ints by index, then floats by index.
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
};

}  // namespace pitchboard::link
