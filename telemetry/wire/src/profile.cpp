// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/wire/profile.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include <base/read_file.h>
#include <resources/resources.h>

namespace pitchboard::telemetry {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, fieldMeaningCount> meanings{
    "none",          "robot",      "x",       "y",       "theta",        "belief",
    "ball-distance", "ball-angle", "control", "vision",  "localization", "decision",
    "imu",           "action",     "yaw",     "voltage", "sequence"};
constexpr std::array<std::string_view, 3> types{"int", "float", "flag"};

constexpr std::size_t maxNameBytes = 60;
constexpr std::size_t maxFileBytes = 1024 * 1024;

/// Walks through text and counts lines on the way, so that a message can name the line.
struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  const char* at;
  int* line;
  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    if (*at == '\n') ++*line;
    ++at;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& other) const { return at == other.at; }
  bool operator!=(const CountingIterator& other) const { return at != other.at; }
};

template <std::size_t N>
std::string list(const std::array<std::string_view, N>& names) {
  std::string out;
  for (const std::string_view name : names) out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

template <std::size_t N>
std::optional<std::size_t> place(const std::array<std::string_view, N>& names,
                                 const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

bool isWord(std::string_view text) {
  return !text.empty() && text.size() <= maxNameBytes &&
         std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 0x7f; });
}

/// Reads the members of one JSON object, and remembers the first thing that was wrong.
class ObjectReader {
 public:
  ObjectReader(const Json& object, std::string where, std::vector<std::string> keys)
      : m_object(object), m_where(std::move(where)) {
    if (!object.is_object()) {
      fail("This must be an object in { }.", "");
      return;
    }
    for (const auto& item : object.items()) {
      if (std::find(keys.begin(), keys.end(), item.key()) == keys.end()) {
        std::string known;
        for (const std::string& key : keys) known += (known.empty() ? "" : ", ") + key;
        fail("This key is not known; the keys are " + known + ".", item.key());
        return;
      }
    }
  }

  std::string text(const char* key, bool required) {
    if (m_error) return {};
    const auto found = m_object.find(key);
    if (found == m_object.end()) {
      if (required) fail("This key is missing.", key);
      return {};
    }
    if (!found->is_string()) {
      fail("This must be text in quotation marks.", key);
      return {};
    }
    return found->get<std::string>();
  }

  template <std::size_t N>
  std::size_t choice(const char* key, const std::array<std::string_view, N>& names,
                     std::optional<std::size_t> otherwise) {
    const std::string word = text(key, !otherwise);
    if (m_error) return 0;
    if (!m_object.contains(key)) return *otherwise;
    const auto found = place(names, word);
    if (!found) fail("\"" + word + "\" is not one of " + list(names) + ".", key);
    return found.value_or(0);
  }

  void fail(std::string message, const std::string& key) {
    if (m_error) return;
    m_error = Error{ErrorCode::ParseError, std::move(message),
                    key.empty() ? m_where : m_where + ": " + key};
  }
  const std::optional<Error>& error() const { return m_error; }

 private:
  const Json& m_object;
  std::string m_where;
  std::optional<Error> m_error;
};

}  // namespace

std::string_view meaningName(FieldMeaning meaning) {
  return meanings[static_cast<std::size_t>(meaning)];
}

std::optional<std::size_t> Profile::indexOf(FieldMeaning meaning) const {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].meaning == meaning) return i;
  }
  return std::nullopt;
}

namespace {

/// What is wrong with one field beside those before it; empty when nothing is.
std::string fieldProblem(const ProfileField& field, std::set<std::string>& names,
                         std::set<FieldMeaning>& used) {
  if (!isWord(field.name)) {
    return "A name has 1 to 60 printable characters without spaces.";
  }
  if (field.name.starts_with("OTHER_")) {
    return "Names that begin with OTHER_ are kept for fields without a name.";
  }
  if (!names.insert(field.name).second) return "Two fields are called \"" + field.name + "\".";
  if (field.unit.size() > maxNameBytes || field.category.size() > maxNameBytes) {
    return "A unit or category has at most 60 characters.";
  }
  if (field.meaning != FieldMeaning::None && !used.insert(field.meaning).second) {
    return "Two fields have the meaning \"" + std::string(meaningName(field.meaning)) + "\".";
  }
  const bool mustBeInt =
      field.meaning == FieldMeaning::Robot || field.meaning == FieldMeaning::Sequence;
  if (mustBeInt && field.type != FieldType::Int) {
    return "A field with the meaning \"" + std::string(meaningName(field.meaning)) +
           "\" has the type int.";
  }
  return {};
}

Result<void> validateAt(const Profile& profile, const std::vector<std::string>& where,
                        const std::string& whole) {
  if (!isWord(profile.end)) {
    return failure(ErrorCode::ParseError,
                   "The end word has 1 to 60 printable characters without spaces.",
                   whole + ": end");
  }
  if (profile.fields.empty() || profile.fields.size() > Profile::maxFields) {
    return failure(ErrorCode::ParseError, "A profile has 1 to 100 fields.", whole + ": fields");
  }
  std::set<std::string> names;
  std::set<FieldMeaning> used;
  for (std::size_t i = 0; i < profile.fields.size(); ++i) {
    std::string problem = fieldProblem(profile.fields[i], names, used);
    if (!problem.empty()) return failure(ErrorCode::ParseError, std::move(problem), where[i]);
  }
  if (!used.contains(FieldMeaning::Robot)) {
    return failure(ErrorCode::ParseError,
                   "No field has the meaning \"robot\", so messages could not be told apart.",
                   whole + ": fields");
  }
  return {};
}

}  // namespace

Result<void> validate(const Profile& profile) {
  std::vector<std::string> where;
  for (std::size_t i = 0; i < profile.fields.size(); ++i) {
    where.push_back("fields[" + std::to_string(i) + "] \"" + profile.fields[i].name + "\"");
  }
  return validateAt(profile, where, "profile");
}

Result<Profile> parseProfile(std::string_view text, const std::string& file) {
  int line = 1;
  std::vector<int> fieldLines;
  const auto noteLines = [&](int depth, Json::parse_event_t event, Json&) {
    if (depth == 2 && event == Json::parse_event_t::object_start) fieldLines.push_back(line);
    return true;
  };
  Json json;
  try {
    json = Json::parse(CountingIterator{text.data(), &line},
                       CountingIterator{text.data() + text.size(), &line}, noteLines);
  } catch (const Json::exception& error) {
    const std::string what = error.what();
    const auto colon = what.rfind(": ");
    return failure(
        ErrorCode::ParseError,
        "This is not JSON: " + (colon == what.npos ? what : what.substr(colon + 2)) + ".",
        file + ":" + std::to_string(line));
  }
  ObjectReader top(json, file + ":1", {"name", "end", "fields"});
  Profile profile;
  profile.name = top.text("name", true);
  if (json.is_object() && json.contains("end")) profile.end = top.text("end", true);
  if (!top.error() && (!json.contains("fields") || !json["fields"].is_array())) {
    top.fail("This must be a list in [ ] of the fields, in the order of the message.", "fields");
  }
  if (top.error()) return tl::unexpected(*top.error());

  std::vector<std::string> where;
  for (const Json& item : json["fields"]) {
    const std::size_t i = where.size();
    const int at = i < fieldLines.size() ? fieldLines[i] : line;
    where.push_back(file + ":" + std::to_string(at) + ": fields[" + std::to_string(i) + "]");
    ObjectReader object(item, where.back(),
                        {"name", "type", "unit", "category", "group", "meaning"});
    ProfileField field;
    field.name = object.text("name", true);
    field.type = static_cast<FieldType>(object.choice("type", types, std::nullopt));
    field.unit = object.text("unit", false);
    // Profiles of version 0.1 call it "group".
    field.category = object.text(item.contains("category") ? "category" : "group", false);
    field.meaning = static_cast<FieldMeaning>(object.choice("meaning", meanings, 0));
    if (object.error()) return tl::unexpected(*object.error());
    profile.fields.push_back(std::move(field));
    if (profile.fields.size() > Profile::maxFields) break;
  }
  if (const auto valid = validateAt(profile, where, file); !valid) {
    return tl::unexpected(valid.error());
  }
  return profile;
}

Result<Profile> loadProfile(const std::string& path) {
  const auto text = readFile(path, maxFileBytes, "The profile");
  if (!text) return tl::unexpected(text.error());
  return parseProfile(*text, path);
}

std::string profileText(const Profile& profile) {
  Json fields = Json::array();
  for (const ProfileField& field : profile.fields) {
    fields.push_back({{"name", field.name},
                      {"type", types[static_cast<std::size_t>(field.type)]},
                      {"unit", field.unit},
                      {"category", field.category},
                      {"meaning", meaningName(field.meaning)}});
  }
  const Json json{{"name", profile.name}, {"end", profile.end}, {"fields", fields}};
  // Bad UTF-8 typed by hand is replaced, not thrown at the caller.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

const Profile& publishedProfile() {
  // The resource is part of the program: a test parses it, so it cannot fail here.
  static const Profile profile =
      parseProfile(resourceText("profiles/published.json"), "profiles/published.json")
          .value_or(Profile{});
  return profile;
}

}  // namespace pitchboard::telemetry
