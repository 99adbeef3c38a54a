// SPDX-License-Identifier: GPL-3.0-or-later
#include "catalog/header_lines.h"

#include "catalog/catalog_reading.h"

namespace pitchboard::link {

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

}  // namespace pitchboard::link
