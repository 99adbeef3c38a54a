// SPDX-License-Identifier: GPL-3.0-or-later
// A team's blackboard.h. `#define NAME *(mem+13)` and `*(memf+4)` tell their type; plain numbers do
// not, so it is found like this, the first rule that applies:
//  1. a comment behind the number that begins with the word int or float decides for this variable;
//  2. a comment line of its own that has one of these words (not both) among at most four decides
//     for all that follow, up to the next such comment (longer ones are prose);
//  3. otherwise ints come first, and the floats begin at the largest fall of the index from one
//     variable to the next after which an index is used a second time.
// A fall below every index so far without any repetition can be either: that is an error which asks
// for a comment, because a variable of the wrong type would be read from the wrong word.
#include <algorithm>
#include <map>

#include <base/try.h>
#include <robotlink/blackboard/variable_catalog.h>

#include "catalog/catalog_reading.h"

namespace pitchboard::link {
namespace {

/// A line of a C header as a preprocessor sees it: its comments taken aside.
struct HeaderLine {
  int number = 0;       ///< of its first line, from 1
  std::string code;     ///< continued lines joined, a blank for each comment
  std::string comment;  ///< text of all comments that end or run on this line
};

/// Fails, with the line, when a comment is never closed.
Result<std::vector<HeaderLine>> headerLines(std::string_view text, std::string_view source) {
  enum class State { Code, String, Character, LineComment, BlockComment } state = State::Code;
  std::vector<HeaderLine> lines;
  HeaderLine line{1, {}, {}};
  int number = 1;
  int commentStart = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const char next = i + 1 < text.size() ? text[i + 1] : '\0';
    if (c == '\r') continue;
    if (c == '\\' && (next == '\n' || (next == '\r' && text.substr(i + 1, 2) == "\r\n"))) {
      i += next == '\n' ? 1 : 2;
      ++number;
      continue;
    }
    if (c == '\n') {
      ++number;
      // Literals and line comments end here whatever is missing.
      if (state != State::BlockComment) state = State::Code;
      lines.push_back(std::move(line));
      line = HeaderLine{number, {}, {}};
      continue;
    }
    switch (state) {
      case State::Code:
        if (c == '/' && (next == '/' || next == '*')) {
          state = next == '/' ? State::LineComment : State::BlockComment;
          commentStart = number;
          line.code += ' ';
          line.comment += ' ';
          ++i;
        } else {
          if (c == '"') state = State::String;
          if (c == '\'') state = State::Character;
          line.code += c;
        }
        break;
      case State::String:
      case State::Character:
        line.code += c;
        if (c == '\\' && next != '\0') {
          line.code += next;
          ++i;
        } else if (c == (state == State::String ? '"' : '\'')) {
          state = State::Code;
        }
        break;
      case State::LineComment:
        line.comment += c;
        break;
      case State::BlockComment:
        if (c == '*' && next == '/') {
          state = State::Code;
          ++i;
        } else {
          line.comment += c;
        }
        break;
    }
  }
  if (state == State::BlockComment)
    return failure(ErrorCode::ParseError, "the comment that begins here is never closed",
                   atLine(source, commentStart));
  lines.push_back(std::move(line));
  return lines;
}

struct Defined {
  CatalogEntry entry;
  bool typeKnown = false;
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string withoutSpaces(std::string_view text) {
  std::string result(text);
  std::erase_if(result, [](char c) { return c == ' ' || c == '\t'; });
  return result;
}

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> found(1);
  for (const char c : text) {
    if (isLetter(c))
      found.back() += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    else if (!found.back().empty())
      found.emplace_back();
  }
  if (found.back().empty()) found.pop_back();
  return found;
}

std::optional<VariableType> typeNamed(const std::string& word) {
  if (word == "int" || word == "ints" || word == "integer" || word == "integers")
    return VariableType::Int;
  if (word == "float" || word == "floats") return VariableType::Float;
  return std::nullopt;
}

// Rule 1.
std::optional<VariableType> typeBehind(std::string_view comment) {
  const auto all = words(comment);
  return all.empty() ? std::nullopt : typeNamed(all.front());
}

// Rule 2.
std::optional<VariableType> typeOfSection(std::string_view comment) {
  constexpr std::size_t headingWords = 4;
  const auto all = words(comment);
  if (all.size() > headingWords) return std::nullopt;
  std::optional<VariableType> found;
  for (const std::string& word : all) {
    const auto type = typeNamed(word);
    if (type && found && *type != *found) return std::nullopt;
    if (type) found = type;
  }
  return found;
}

// Constants that such a header has beside its variables.
bool isOtherConstant(std::string_view name) {
  return name.starts_with("_") || name == "KEY" || name.ends_with("_KEY") || name == "SIZE" ||
         name.starts_with("SIZE_") || name.ends_with("_SIZE") || name.starts_with("MEM_") ||
         name == "TRUE" || name == "FALSE" || name.ends_with("_H") || name.ends_with("_H_") ||
         name.ends_with("_HPP");
}

struct Value {
  enum class Kind { Unrelated, Plain, Int, Float, Computed, Broken } kind = Kind::Unrelated;
  long long index = 0;
};

Value parseValue(std::string_view text) {
  std::string value = withoutSpaces(text);
  while (value.size() > 2 && value.front() == '(' && value.back() == ')' &&
         value.find('(', 1) == std::string::npos)
    value = value.substr(1, value.size() - 2);
  if (value.empty()) return {};

  std::string_view rest = value;
  const bool wrapped = rest.starts_with("(*(") && rest.ends_with("))");
  if (wrapped) rest = rest.substr(1, rest.size() - 2);
  for (const auto& [name, kind] : {std::pair{std::string_view("memf"), Value::Kind::Float},
                                   std::pair{std::string_view("mem"), Value::Kind::Int}}) {
    if (!rest.starts_with('*')) break;
    if (rest.substr(1) == name) return {kind, 0};
    if (!rest.substr(1).starts_with('(') || !rest.substr(2).starts_with(name) ||
        !rest.ends_with(')'))
      continue;
    std::string_view inside = rest.substr(2 + name.size(), rest.size() - 3 - name.size());
    if (inside.empty()) return {kind, 0};
    if (inside.front() != '+') break;
    const auto index = parseIndex(inside.substr(1));
    return index ? Value{kind, *index} : Value{Value::Kind::Computed, 0};
  }
  for (const std::string& word : words(rest)) {
    if (word == "mem" || word == "memf") return {Value::Kind::Computed, 0};
  }

  if (value.front() >= '0' && value.front() <= '9') {
    std::string_view digits = value;
    while (!digits.empty() && std::string_view("uUlL").find(digits.back()) != std::string::npos)
      digits.remove_suffix(1);
    if (const auto index = parseIndex(digits)) return {Value::Kind::Plain, *index};
    if (value.find_first_of("+-*/<>%|&^(") != std::string::npos &&
        value.find_first_of(".eE") == std::string::npos)
      return {Value::Kind::Computed, 0};
    // 0.5f, 1e-3: a constant of another kind.
    if (value.find_first_not_of("0123456789.eEfFlL+-") == std::string::npos) return {};
    return {Value::Kind::Broken, 0};
  }
  if (value.front() == '(' &&
      value.find_first_not_of("0123456789()+-*/<>%|&^") == std::string::npos)
    return {Value::Kind::Computed, 0};
  return {};
}

// Rule 3, over the plain numbers that no comment decides.
std::optional<Error> splitBlocks(const std::vector<Defined*>& plain) {
  const std::size_t count = plain.size();
  std::map<long long, std::size_t> first;
  std::vector<std::size_t> earlier(count + 1, count);  // suffix minimum of first uses
  for (std::size_t i = 0; i < count; ++i)
    earlier[i] = first.try_emplace(plain[i]->entry.index, i).first->second;
  for (std::size_t i = count; i-- > 0;) earlier[i] = std::min(earlier[i], earlier[i + 1]);

  std::size_t start = count;
  long long largest = 0;
  bool repeats = false;
  long long lowest = count > 0 ? plain[0]->entry.index : 0;
  for (std::size_t i = 1; i < count; ++i) {
    const long long fall = plain[i - 1]->entry.index - plain[i]->entry.index;
    const bool again = earlier[i] < i;
    const bool below = plain[i]->entry.index < lowest;
    lowest = std::min(lowest, plain[i]->entry.index);
    if (fall > largest && (again || below)) {
      start = i;
      largest = fall;
      repeats = again;
    }
  }
  if (start < count && !repeats)
    return Error{ErrorCode::ParseError,
                 "cannot tell whether the float variables begin here: the index falls from " +
                     std::to_string(plain[start - 1]->entry.index) + " to " +
                     std::to_string(plain[start]->entry.index) +
                     " and none is used twice. Put a line `// float` or `// int` before it",
                 plain[start]->entry.where};
  for (std::size_t i = 0; i < count; ++i)
    plain[i]->entry.type = i < start ? VariableType::Int : VariableType::Float;
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view source) : m_source(source) {}

  std::optional<Error> read(const HeaderLine& line) {
    const std::string_view code = trimmed(line.code);
    if (code.empty()) {
      if (const auto type = typeOfSection(line.comment)) m_section = type;
      return std::nullopt;
    }
    if (code.front() != '#') return std::nullopt;
    const std::string_view directive = trimmed(code.substr(1));
    if (skips(directive)) return std::nullopt;
    if (!directive.starts_with("define") || directive.size() < 7 ||
        (directive[6] != ' ' && directive[6] != '\t'))
      return std::nullopt;
    return readDefine(trimmed(directive.substr(6)), line);
  }

  Result<std::vector<CatalogEntry>> take() {
    std::vector<Defined*> undecided;
    for (Defined& defined : m_defined) {
      if (!defined.typeKnown) undecided.push_back(&defined);
    }
    if (const auto error = splitBlocks(undecided)) return tl::unexpected(*error);
    std::vector<CatalogEntry> entries;
    for (Defined& defined : m_defined) entries.push_back(std::move(defined.entry));
    return entries;
  }

 private:
  // Whether the line lies in an `#if 0`: the usual way to keep an old map.
  bool skips(std::string_view directive) {
    const bool opens = directive.starts_with("if");
    if (m_skipDepth > 0) {
      if (opens) ++m_skipDepth;
      const bool otherBranch = directive.starts_with("else") || directive.starts_with("elif");
      if (directive.starts_with("endif") || (otherBranch && m_skipDepth == 1)) --m_skipDepth;
      return true;
    }
    if (opens && withoutSpaces(directive) == "if0") {
      m_skipDepth = 1;
      return true;
    }
    return false;
  }

  std::optional<Error> readDefine(std::string_view text, const HeaderLine& line) {
    const std::string where = atLine(m_source, line.number);
    const auto end = std::ranges::find_if_not(
        text, [](char c) { return isLetter(c) || (c >= '0' && c <= '9'); });
    const std::string name(text.begin(), end);
    const std::string_view rest = text.substr(name.size());
    if (rest.starts_with("(") || isOtherConstant(name)) return std::nullopt;
    const Value value = parseValue(rest);
    switch (value.kind) {
      case Value::Kind::Unrelated:
        return std::nullopt;
      case Value::Kind::Computed:
        return Error{ErrorCode::ParseError,
                     "the index of \"" + name.substr(0, 64) +
                         "\" is computed; write it as a number, *(mem+number) or *(memf+number)",
                     where};
      case Value::Kind::Broken:
        return Error{ErrorCode::ParseError,
                     "the value of \"" + name.substr(0, 64) + "\" is not a number", where};
      default:
        break;
    }
    Defined defined{{name, VariableType::Int, value.index, where}, true};
    if (value.kind == Value::Kind::Float) {
      defined.entry.type = VariableType::Float;
    } else if (value.kind == Value::Kind::Plain) {
      const auto behind = typeBehind(line.comment);
      defined.typeKnown = behind || m_section;
      if (defined.typeKnown) defined.entry.type = behind ? *behind : *m_section;
    }
    m_defined.push_back(std::move(defined));
    return std::nullopt;
  }

  std::string_view m_source;
  std::vector<Defined> m_defined;
  std::optional<VariableType> m_section;
  int m_skipDepth = 0;
};

}  // namespace

Result<VariableCatalog> VariableCatalog::fromHeader(std::string_view text,
                                                    std::string_view source) {
  if (const auto error = checkCatalogText(text, source)) return tl::unexpected(*error);
  const auto lines = TRY(headerLines(text, source));
  HeaderReader reader(source);
  for (const HeaderLine& line : lines) {
    if (const auto error = reader.read(line)) return tl::unexpected(*error);
  }
  const auto entries = TRY(reader.take());
  return make(entries, source);
}

}  // namespace pitchboard::link
