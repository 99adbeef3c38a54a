// SPDX-License-Identifier: GPL-3.0-or-later
// A team's SharedMemory.py: the two dictionaries variable_int and variable_float, written out as
// 'NAME': index. The file is not run, so an index that is computed is an error.
#include <cstring>

#include <robotlink/blackboard/variable_catalog.h>

#include "catalog/catalog_reading.h"

namespace pitchboard::link {
namespace {

struct Token {
  enum class Kind { Name, Number, String, Mark, End } kind = Kind::End;
  std::string_view text;  // a string's content without quotes; a mark is one character
  int line = 1;
  bool closed = true;  // false: a string without its closing quote
};

class Tokens {
 public:
  explicit Tokens(std::string_view text) : m_text(text) {}

  Token next() {
    skipBlanks();
    Token token{Token::Kind::End, {}, m_line};
    if (m_at >= m_text.size()) return token;
    const char c = m_text[m_at];
    if (c == '"' || c == '\'') return string();
    const std::size_t start = m_at;
    if (isWord(c)) {
      while (m_at < m_text.size() && isWord(m_text[m_at])) ++m_at;
      token.text = m_text.substr(start, m_at - start);
      token.kind = c >= '0' && c <= '9' ? Token::Kind::Number : Token::Kind::Name;
      // A prefix of a string (u'', r''): the letters say nothing about its name.
      if (token.kind == Token::Kind::Name && token.text.size() <= 2 && m_at < m_text.size() &&
          (m_text[m_at] == '"' || m_text[m_at] == '\'') &&
          token.text.find_first_not_of("uUrRbBfF") == std::string_view::npos)
        return string();
      return token;
    }
    token.kind = Token::Kind::Mark;
    token.text = m_text.substr(m_at++, 1);
    return token;
  }

 private:
  static bool isWord(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           static_cast<unsigned char>(c) >= 0x80;
  }

  void skipBlanks() {
    for (; m_at < m_text.size(); ++m_at) {
      const char c = m_text[m_at];
      if (c == '#') {
        m_at = std::min(m_text.find('\n', m_at), m_text.size()) - 1;
      } else if (c == '\n') {
        ++m_line;
      } else if (std::strchr(" \t\r\v\f\\", c) == nullptr) {
        return;
      }
    }
  }

  Token string() {
    const char quote = m_text[m_at];
    const std::string triple(3, quote);
    const bool isLong = m_text.substr(m_at, 3) == triple;
    Token token{Token::Kind::String, {}, m_line, false};
    m_at += isLong ? 3 : 1;
    const std::size_t start = m_at;
    for (; m_at < m_text.size(); ++m_at) {
      if (isLong ? m_text.substr(m_at, 3) == triple : m_text[m_at] == quote) {
        token.closed = true;
        break;
      }
      if (m_text[m_at] == '\n' && !isLong) break;
      if (m_text[m_at] == '\\' && m_at + 1 < m_text.size()) ++m_at;
      if (m_text[m_at] == '\n') ++m_line;
    }
    token.text = m_text.substr(start, std::min(m_at, m_text.size()) - start);
    if (token.closed) m_at += isLong ? 3 : 1;
    return token;
  }

  std::string_view m_text;
  std::size_t m_at = 0;
  int m_line = 1;
};

class PythonReader {
 public:
  PythonReader(std::string_view text, std::string_view source) : m_source(source) {
    Tokens tokens(text);
    do m_tokens.push_back(tokens.next());
    while (m_tokens.back().kind != Token::Kind::End);
  }

  std::optional<Error> read() {
    for (m_at = 0; current().kind != Token::Kind::End; ++m_at) {
      const Token& token = current();
      if (token.kind != Token::Kind::Name) continue;
      const bool ints = token.text == "variable_int";
      if (!ints && token.text != "variable_float") continue;
      if (auto error = readUse(ints ? VariableType::Int : VariableType::Float)) return error;
    }
    return std::nullopt;
  }

  std::vector<CatalogEntry> entries;

 private:
  const Token& current() const { return m_tokens[m_at]; }
  const Token& ahead(std::size_t by) const {
    return m_tokens[std::min(m_at + by, m_tokens.size() - 1)];
  }
  static bool is(const Token& token, char mark) {
    return token.kind == Token::Kind::Mark && token.text.front() == mark;
  }
  Error error(const Token& token, std::string message) const {
    return {ErrorCode::ParseError, std::move(message), atLine(m_source, token.line)};
  }

  // At the name of a dictionary: an assignment is read, a change later in the file is refused.
  std::optional<Error> readUse(VariableType type) {
    const Token& name = current();
    const std::string dictionary(name.text);
    if (is(ahead(1), '=') && !is(ahead(2), '=')) {
      m_at += 2;
      bool& seen = type == VariableType::Int ? m_seenInt : m_seenFloat;
      if (seen) return error(name, dictionary + " is assigned a second time");
      seen = true;
      if (!is(current(), '{'))
        return error(current(),
                     dictionary + " must be a dictionary written out as { 'NAME': 13, ... }");
      return readDictionary(type, dictionary, name);
    }
    const bool method = is(ahead(1), '.') && ahead(2).kind == Token::Kind::Name &&
                        (ahead(2).text == "update" || ahead(2).text == "setdefault");
    if (method || assignsItem())
      return error(name, dictionary +
                             " is changed by code here, which is not run; "
                             "write every variable into the dictionary");
    return std::nullopt;
  }

  // variable_int[...] = ...
  bool assignsItem() const {
    if (!is(ahead(1), '[')) return false;
    int depth = 0;
    for (std::size_t i = m_at + 1; i < m_tokens.size(); ++i) {
      if (is(m_tokens[i], '[')) ++depth;
      if (is(m_tokens[i], ']') && --depth == 0)
        return i + 2 < m_tokens.size() && is(m_tokens[i + 1], '=') && !is(m_tokens[i + 2], '=');
      // A subscript of this length is no name; and the search must not cost a whole file each time.
      if (i > m_at + 64) return false;
    }
    return false;
  }

  std::optional<Error> readDictionary(VariableType type, const std::string& dictionary,
                                      const Token& name) {
    const Error open = error(name, "the dictionary " + dictionary + " is never closed");
    ++m_at;
    while (!is(current(), '}')) {
      const Token& key = current();
      if (key.kind == Token::Kind::End) return open;
      if (key.kind != Token::Kind::String)
        return error(key, "a variable's name in quotes is expected here, in " + dictionary);
      if (!key.closed) return error(key, "this name lacks its closing quote");
      if (!is(ahead(1), ':'))
        return ahead(1).kind == Token::Kind::End
                   ? open
                   : error(ahead(1), "a colon is expected after the name " + quotedName(key));
      const Token& number = ahead(2);
      if (number.kind == Token::Kind::End) return open;
      const auto index =
          number.kind == Token::Kind::Number ? parseIndex(number.text) : std::nullopt;
      if (!index)
        return error(number, "the index of " + quotedName(key) +
                                 " must be a whole number, 0 or more, without arithmetic");
      entries.push_back({std::string(key.text), type, *index, atLine(m_source, key.line)});
      const Token& after = ahead(3);
      if (after.kind == Token::Kind::End) return open;
      if (!is(after, ',') && !is(after, '}'))
        return error(after, after.kind == Token::Kind::String
                                ? "a comma is missing before this name"
                                : "the index of " + quotedName(key) +
                                      " is computed; write it as one number");
      m_at += is(after, ',') ? 4 : 3;
    }
    // { ... }.copy(), { ... } + ...: still not what is written here.
    const Token& after = ahead(1);
    if (is(after, '.') || is(after, '|') || is(after, '+') || is(after, '['))
      return error(after, "the dictionary " + dictionary + " is computed; write it out");
    return std::nullopt;
  }

  static std::string quotedName(const Token& key) {
    std::string name = "\"";
    name.append(key.text.substr(0, 64)).append("\"");
    return name;
  }

  std::string_view m_source;
  std::vector<Token> m_tokens;
  std::size_t m_at = 0;
  bool m_seenInt = false;
  bool m_seenFloat = false;
};

}  // namespace

Result<VariableCatalog> VariableCatalog::fromPython(std::string_view text,
                                                    std::string_view source) {
  if (const auto error = checkCatalogText(text, source)) return tl::unexpected(*error);
  PythonReader reader(text, source);
  if (const auto error = reader.read()) return tl::unexpected(*error);
  if (reader.entries.empty())
    return failure(ErrorCode::ParseError,
                   "there is no dictionary variable_int or variable_float with variables in it",
                   std::string(source));
  return make(reader.entries, source);
}

}  // namespace pitchboard::link
