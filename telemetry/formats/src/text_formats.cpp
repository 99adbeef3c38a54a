// SPDX-License-Identifier: GPL-3.0-or-later
// key=value, JSON and Lua tables.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "message_readers.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t deepestLevel = 16;
constexpr std::size_t maxPathLength = 240;
// Begins a string that stands for a number that JSON cannot write. No text of a robot begins so.
constexpr char unquotedMark = '\0';

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
  return text;
}

/// Where a value stands: "pose.x", "ball[0]". Nothing is kept of a path that no profile can name.
class Path {
 public:
  bool enter(bool list) {
    if (m_levels.size() == deepestLevel) return false;
    m_levels.push_back({m_text.size(), list, 0});
    return true;
  }
  void leave() {
    if (!m_levels.empty()) m_levels.pop_back();
    next();
  }
  void key(std::string_view name) {
    if (m_levels.empty()) return;
    m_text.resize(m_levels.back().begin);
    if (m_text.size() + name.size() + 1 > maxPathLength) name = "?";
    if (!m_text.empty()) m_text += '.';
    m_text += name;
  }
  /// Of the value that comes now.
  std::string_view text() {
    index();
    return m_text;
  }
  void index() {
    if (m_levels.empty() || !m_levels.back().list) return;
    m_text.resize(m_levels.back().begin);
    if (m_text.size() + 24 > maxPathLength) return;
    m_text += '[' + std::to_string(m_levels.back().entry) + ']';
  }
  /// After a value.
  void next() {
    if (m_levels.empty()) return;
    if (m_levels.back().list) ++m_levels.back().entry;
    m_text.resize(m_levels.back().begin);
  }

 private:
  struct Level {
    std::size_t begin;
    bool list;
    std::size_t entry;
  };
  std::string m_text;
  std::vector<Level> m_levels;
};

class JsonEvents : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit JsonEvents(FieldSink& sink) : m_sink(&sink) {}

  bool null() override { return done(); }
  bool boolean(bool value) override { return number(value ? 1.0 : 0.0); }
  bool number_integer(number_integer_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool string(string_t& value) override {
    if (value.starts_with(unquotedMark)) {
      m_sink->addTemporaryUnquoted(m_path.text(), std::string_view(value).substr(1));
    } else {
      m_sink->addTemporaryText(m_path.text(), value);
    }
    return done();
  }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return enter(false); }
  bool end_object() override { return leave(); }
  bool start_array(std::size_t) override { return enter(true); }
  bool end_array() override { return leave(); }
  bool key(string_t& name) override {
    m_path.key(name);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    return false;
  }

 private:
  bool number(double value) {
    m_sink->number(m_path.text(), value);
    return done();
  }
  bool done() {
    m_path.next();
    return true;
  }
  bool enter(bool list) {
    m_path.index();
    return m_path.enter(list);
  }
  bool leave() {
    m_path.leave();
    return true;
  }

  FieldSink* m_sink;
  Path m_path;
};

/// NaN, -Infinity, inf, nan(ind), 1e400: what programs write for a number that JSON cannot write.
bool isBeyondJson(std::string_view token) {
  double value = 0.0;
  const char* end = token.data() + token.size();
  const auto [stop, code] = std::from_chars(token.data(), end, value);
  return stop == end &&
         (code == std::errc::result_out_of_range || (code == std::errc{} && !std::isfinite(value)));
}

/// The text with each of these as a string that begins with `unquotedMark`, so that it does not end
/// the message. Empty if there are none, which is usual.
std::string withStringsForNumbers(std::string_view text) {
  constexpr std::string_view marks = " \t\r\n{}[],:\"";
  std::string out;
  std::size_t copied = 0;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '"') {
      for (++at; at < text.size() && text[at] != '"'; ++at) at += text[at] == '\\';
      ++at;
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(marks, at), text.size());
    const std::size_t next = text.find_first_not_of(" \t\r\n", end);
    const bool isKey = next != std::string_view::npos && text[next] == ':';
    if (const std::string_view token = text.substr(at, end - at); !isKey && isBeyondJson(token)) {
      out += text.substr(copied, at - copied);
      out += "\"\\u0000" + std::string(token) + '"';
      copied = end;
    }
    at = std::max(end, at + 1);
  }
  if (copied > 0) out += text.substr(copied);
  return out;
}

/// One table of Lua: `{["id"]=2, x=1.5, {1, 2}}`.
class LuaReader {
 public:
  LuaReader(std::string_view text, FieldSink& sink) : m_text(text), m_sink(&sink) {}

  bool read() {
    const bool good = peek() == '{' && table();
    return good && peek() == '\0';
  }

 private:
  /// The next character that is no white space; NUL at the end.
  char peek() {
    while (m_at < m_text.size() && isSpace(m_text[m_at])) ++m_at;
    return m_at < m_text.size() ? m_text[m_at] : '\0';
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++m_at;
    return true;
  }

  bool table() {
    if (!take('{')) return false;
    if (!m_path.enter(false)) return false;
    int entry = 1;
    while (peek() != '}') {
      if (!key(entry) || !value()) return false;
      if (!take(',') && !take(';') && peek() != '}') return false;
    }
    ++m_at;
    m_path.leave();
    return true;
  }

  /// `["x"]=`, `[1]=`, `x=`, or nothing: the next number.
  bool key(int& entry) {
    if (take('[')) {
      std::string_view name;
      if (peek() == '"' || peek() == '\'') {
        if (!quoted(name)) return false;
      } else {
        name = bare();
      }
      m_path.key(name);
      return !name.empty() && take(']') && take('=');
    }
    const std::size_t before = m_at;
    const std::string_view name = bare();
    if (!name.empty() && take('=')) {
      m_path.key(name);
      return true;
    }
    m_at = before;
    m_path.key(std::to_string(entry++));
    return true;
  }

  bool value() {
    const char c = peek();
    if (c == '{') return table();
    std::string_view text;
    if (c == '"' || c == '\'') {
      if (!quoted(text)) return false;
      m_sink->addText(m_path.text(), text);
    } else {
      text = bare();
      if (text.empty()) return false;
      if (text == "true" || text == "false") {
        m_sink->number(m_path.text(), text == "true" ? 1.0 : 0.0);
      } else if (text != "nil") {
        m_sink->addUnquoted(m_path.text(), text);
      }
    }
    m_path.next();
    return true;
  }

  bool quoted(std::string_view& out) {
    const char mark = m_text[m_at++];
    const std::size_t begin = m_at;
    while (m_at < m_text.size() && m_text[m_at] != mark) m_at += m_text[m_at] == '\\' ? 2 : 1;
    if (m_at >= m_text.size()) return false;
    out = m_text.substr(begin, m_at - begin);
    ++m_at;
    return true;
  }

  std::string_view bare() {
    peek();
    const std::size_t begin = m_at;
    constexpr std::string_view marks = "{}[]=,;\"'";
    while (m_at < m_text.size() && !isSpace(m_text[m_at]) &&
           marks.find(m_text[m_at]) == marks.npos) {
      ++m_at;
    }
    return m_text.substr(begin, m_at - begin);
  }

  std::string_view m_text;
  std::size_t m_at = 0;
  FieldSink* m_sink;
  Path m_path;
};

}  // namespace

bool readKeyValue(std::string_view text, char separator, FieldSink& sink) {
  std::size_t pairs = 0;
  while (!text.empty()) {
    std::size_t end = 0;
    while (end < text.size() && !(separator == ' ' ? isSpace(text[end]) : text[end] == separator)) {
      ++end;
    }
    const std::string_view pair = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (pair.empty()) continue;
    const std::size_t equals = pair.find('=');
    if (equals == pair.npos || equals == 0) return false;
    sink.addText(trimmed(pair.substr(0, equals)), trimmed(pair.substr(equals + 1)));
    ++pairs;
  }
  return pairs > 0;
}

bool readJson(std::string_view text, FieldSink& sink) {
  JsonEvents events(sink);
  const std::string replaced = withStringsForNumbers(text);
  const std::string_view inner = trimmed(replaced.empty() ? text : std::string_view(replaced));
  return inner.starts_with('{') && nlohmann::json::sax_parse(inner, &events);
}

bool readLua(std::string_view text, FieldSink& sink) {
  return LuaReader(text, sink).read();
}

}  // namespace pitchboard::telemetry
