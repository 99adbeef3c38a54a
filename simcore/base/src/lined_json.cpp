// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/lined_json.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <unordered_set>

namespace pitchboard {
namespace {

constexpr std::size_t maxDepth = 64;

/// How far the lexer has read.
struct ReadPosition {
  int line = 1;
  char last = '\0';
};

class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, ReadPosition* position) : m_at(at), m_position(position) {}
  reference operator*() const { return *m_at; }
  CountingIterator& operator++() {
    m_position->last = *m_at;
    if (*m_at == '\n') ++m_position->line;
    ++m_at;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return m_at == other.m_at; }

 private:
  const char* m_at;
  ReadPosition* m_position;
};

/// The parser's complaint without its own numbering: "[json.exception...] parse error at line 3,
/// column 5: syntax error while ..." becomes "syntax error while ...".
std::string withoutPreamble(std::string text) {
  if (const auto bracket = text.find("] "); text.starts_with('[') && bracket != std::string::npos) {
    text.erase(0, bracket + 2);
  }
  if (text.starts_with("parse error at line")) {
    if (const auto colon = text.find(": "); colon != std::string::npos) text.erase(0, colon + 2);
  }
  return text;
}

/// What people write who are used to other languages.
std::string explained(std::string complaint) {
  const auto says = [&complaint](const char* part) {
    return complaint.find(part) != std::string::npos;
  };
  if (says("parsing object key - unexpected '}'") || says("parsing value - unexpected ']'"))
    return complaint + "; remove the comma in front of it";
  if (says("invalid literal; last read: ") && (says("/'") || says("#'") || says("/*")))
    return complaint + "; JSON has no comments";
  if (says("parsing object key - unexpected number literal"))
    return complaint + "; numbers have a decimal point, such as 0.3";
  return complaint;
}

class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(const ReadPosition& position, JsonReport& report)
      : m_position(position), m_report(report) {}

  JsonNode takeRoot() { return std::move(m_root); }

  bool null() override { return add({}); }
  bool boolean(bool value) override {
    JsonNode node;
    node.kind = JsonNode::Kind::Boolean;
    node.boolean = value;
    return add(std::move(node));
  }
  bool number_integer(number_integer_t value) override {
    return addNumber(static_cast<double>(value), {});
  }
  bool number_unsigned(number_unsigned_t value) override {
    return addNumber(static_cast<double>(value), value);
  }
  bool number_float(number_float_t value, const string_t&) override { return addNumber(value, {}); }
  bool string(string_t& value) override {
    JsonNode node;
    node.kind = JsonNode::Kind::Text;
    node.text = std::move(value);
    return add(std::move(node));
  }
  bool binary(binary_t&) override { return false; }  // does not occur in JSON text
  bool start_object(std::size_t) override { return open(JsonNode::Kind::Object); }
  bool start_array(std::size_t) override { return open(JsonNode::Kind::Array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = m_levels.back();
    if (!level.keys.insert(name).second) {
      m_report.fail(m_position.line, pathTo(name), "is given twice; remove one of them");
      return false;
    }
    level.key = std::move(name);
    level.keyLine = m_position.line;
    return true;
  }

  bool parse_error(std::size_t, const std::string&,
                   const nlohmann::json::exception& error) override {
    m_report.fail(lineOfToken(), "", "not valid JSON: " + explained(withoutPreamble(error.what())));
    return false;
  }

 private:
  struct Level {
    JsonNode node;
    std::string key;
    int keyLine = 1;
    std::unordered_set<std::string> keys;
  };

  /// A number ends only with the character after it, which may have begun the next line.
  int lineOfToken() const {
    return m_position.last == '\n' && m_position.line > 1 ? m_position.line - 1 : m_position.line;
  }

  std::string pathTo(const std::string& name) const {
    std::string path;
    for (const Level& level : m_levels) {
      if (level.node.kind == JsonNode::Kind::Array) {
        path += '[' + std::to_string(level.node.items.size()) + ']';
      } else {
        path += (path.empty() ? "" : ".") + (&level == &m_levels.back() ? name : level.key);
      }
    }
    return path;
  }

  bool addNumber(double value, std::optional<std::uint64_t> whole) {
    JsonNode node;
    node.kind = JsonNode::Kind::Number;
    node.number = value;
    node.whole = whole;
    return add(std::move(node));
  }

  bool open(JsonNode::Kind kind) {
    if (m_levels.size() >= maxDepth) {
      m_report.fail(m_position.line, "",
                    "nested deeper than " + std::to_string(maxDepth) + " levels");
      return false;
    }
    Level& level = m_levels.emplace_back();
    level.node.kind = kind;
    level.node.line = m_position.line;
    return true;
  }

  bool close() {
    JsonNode node = std::move(m_levels.back().node);
    m_levels.pop_back();
    return place(std::move(node));
  }

  bool add(JsonNode node) {
    node.line = node.kind == JsonNode::Kind::Number ? lineOfToken() : m_position.line;
    return place(std::move(node));
  }

  bool place(JsonNode node) {
    if (m_levels.empty()) {
      m_root = std::move(node);
      return true;
    }
    Level& level = m_levels.back();
    if (level.node.kind == JsonNode::Kind::Array) {
      level.node.items.push_back(std::move(node));
    } else {
      node.line = level.keyLine;
      level.node.members.push_back({std::move(level.key), std::move(node)});
    }
    return true;
  }

  const ReadPosition& m_position;
  JsonReport& m_report;
  std::vector<Level> m_levels;
  JsonNode m_root;
};

}  // namespace

const JsonNode* JsonNode::find(std::string_view key) const {
  for (const auto& [name, value] : members) {
    if (name == key) return &value;
  }
  return nullptr;
}

void JsonReport::fail(int line, const std::string& path, const std::string& text, ErrorCode code) {
  constexpr std::size_t most = 20;
  if (m_errors.size() >= most) return;
  const std::string place = m_source + ':' + std::to_string(line);
  const std::string message = path.empty() ? text : path + ": " + text;
  const auto known = [&](const Error& one) {
    return one.context == place && one.message.starts_with(path + ": ");
  };
  if (std::ranges::any_of(m_errors, known)) return;
  m_errors.push_back({code, message, place});
}

Error JsonReport::allErrors() const {
  Error all = m_errors.front();
  for (std::size_t i = 1; i < m_errors.size(); ++i) all.message += '\n' + m_errors[i].text();
  return all;
}

std::optional<JsonNode> parseJson(std::string_view text, JsonReport& report, std::size_t maxBytes) {
  if (text.size() > maxBytes) {
    report.fail(1, "",
                "larger than " + std::to_string(maxBytes >> 20) + " MiB, the most that is read");
    return {};
  }
  ReadPosition position;
  TreeBuilder builder(position, report);
  const bool done =
      nlohmann::json::sax_parse(CountingIterator(text.data(), &position),
                                CountingIterator(text.data() + text.size(), &position), &builder);
  if (report.failed()) return {};
  if (!done) {
    report.fail(position.line, "", "not valid JSON");
    return {};
  }
  return builder.takeRoot();
}

}  // namespace pitchboard
