// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Splits OMG IDL into words and marks. Private to recordings; one thread.

#include <algorithm>
#include <string_view>

namespace pitchboard::telemetry {

struct IdlToken {
  std::string_view text;  ///< empty: the end
  int line = 1;
  bool isText = false;
};

/// Splits a text; comments and lines of the preprocessor are left out.
class IdlTokens {
 public:
  explicit IdlTokens(std::string_view text) : m_rest(text) { take(); }
  const IdlToken& look() const { return m_next; }
  IdlToken take() {
    const IdlToken taken = m_next;
    skip();
    m_next = {{}, m_line, false};
    if (m_rest.empty()) return taken;
    std::size_t length = 1;
    if (m_rest.front() == '"') {
      while (length < m_rest.size() && m_rest[length] != '"') {
        length += m_rest[length] == '\\' ? 2 : 1;
      }
      length = std::min(length + 1, m_rest.size());
      m_next.isText = true;
    } else if (isWord(m_rest.front())) {
      while (length < m_rest.size() && isWord(m_rest[length])) ++length;
    } else if (m_rest.starts_with("::")) {
      length = 2;
    }
    m_next.text = m_rest.substr(0, length);
    m_line += static_cast<int>(std::ranges::count(m_next.text, '\n'));
    m_rest.remove_prefix(length);
    return taken;
  }

 private:
  static bool isWord(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.';
  }
  void passTo(std::string_view mark) {
    const auto at = m_rest.find(mark);
    const std::size_t length = at == m_rest.npos ? m_rest.size() : at + mark.size();
    m_line += static_cast<int>(std::ranges::count(m_rest.substr(0, length), '\n'));
    m_rest.remove_prefix(length);
  }
  void skip() {
    for (;;) {
      if (m_rest.starts_with("//") || m_rest.starts_with('#') || m_rest.starts_with("===")) {
        passTo("\n");
      } else if (m_rest.starts_with("IDL: ")) {  // the name of a part, as rosbag2 writes it
        passTo("\n");
      } else if (m_rest.starts_with("/*")) {
        passTo("*/");
      } else if (!m_rest.empty() && static_cast<unsigned char>(m_rest.front()) <= ' ') {
        m_line += m_rest.front() == '\n' ? 1 : 0;
        m_rest.remove_prefix(1);
      } else {
        return;
      }
    }
  }
  std::string_view m_rest;
  int m_line = 1;
  IdlToken m_next;
};

}  // namespace pitchboard::telemetry
