// SPDX-License-Identifier: GPL-3.0-or-later
// Reads OMG IDL 4.2 (formal/18-01-05) as far as rosidl and DDS use it for messages: modules,
// structs, unions, typedefs, enumerations, constants, sequences, arrays and annotations.
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>

#include <base/try.h>

#include "idl_tokens.h"
#include "message_decoder.h"
#include "ros_types.h"

namespace pitchboard::telemetry {
namespace {

/// A type as it is written. Names are looked up when everything is known.
struct IdlType {
  std::string name;                ///< of a scoped or basic type
  std::string scope;               ///< where it is looked up: "a::b"
  std::shared_ptr<IdlType> items;  ///< of a sequence
  std::vector<std::string> dimensions;
  int line = 1;
};

struct IdlAnnotations {
  bool isOptional = false;
  std::optional<std::uint32_t> id;
  Extensibility extensibility = Extensibility::Unsaid;
  std::string unit;
};

struct IdlMember {
  std::string name;
  IdlType type;
  IdlAnnotations annotations;
  std::vector<std::string> cases{};  ///< of a union
  bool isDefaultCase = false;
};

struct IdlStruct {
  std::string base, scope;
  std::vector<IdlMember> members;
  Extensibility extensibility = Extensibility::Unsaid;
  int line = 1;
  bool isUnion = false;  ///< the first member says which of the others there is
};

struct IdlName {
  std::string_view name;
  RosKind kind;
};
constexpr std::array idlNames{IdlName{"boolean", RosKind::Bool},
                              IdlName{"octet", RosKind::UInt8},
                              IdlName{"char", RosKind::UInt8},
                              IdlName{"int8", RosKind::Int8},
                              IdlName{"uint8", RosKind::UInt8},
                              IdlName{"int16", RosKind::Int16},
                              IdlName{"short", RosKind::Int16},
                              IdlName{"uint16", RosKind::UInt16},
                              IdlName{"unsigned short", RosKind::UInt16},
                              IdlName{"int32", RosKind::Int32},
                              IdlName{"long", RosKind::Int32},
                              IdlName{"uint32", RosKind::UInt32},
                              IdlName{"unsigned long", RosKind::UInt32},
                              IdlName{"int64", RosKind::Int64},
                              IdlName{"long long", RosKind::Int64},
                              IdlName{"uint64", RosKind::UInt64},
                              IdlName{"unsigned long long", RosKind::UInt64},
                              IdlName{"float", RosKind::Float32},
                              IdlName{"double", RosKind::Float64},
                              IdlName{"long double", RosKind::LongDouble},
                              IdlName{"string", RosKind::Text},
                              IdlName{"wstring", RosKind::WideText}};

class Idl {
 public:
  Idl(std::string_view type, std::string_view text) : m_root(type), m_tokens(text) {}

  Result<RosTypes> read() {
    while (!m_tokens.look().text.empty()) {
      readDefinition("", 0);
      if (m_error) return tl::unexpected(*m_error);
    }
    m_types.isIdl = true;
    const std::string root = rootName();
    if (!m_structs.contains(root)) {
      return failure(ErrorCode::ParseError,
                     "The schema does not define \"" + std::string(m_root.substr(0, 100)) + "\".");
    }
    m_types.root = resolveStruct(root, 0);
    if (m_error) return tl::unexpected(*m_error);
    TRY(completeRosTypes(m_types));
    return std::move(m_types);
  }

 private:
  void fail(std::string sentence, int line) {
    if (m_error) return;
    m_error = Error{ErrorCode::ParseError, std::move(sentence),
                    "line " + std::to_string(line) + " of the schema"};
  }
  bool expect(std::string_view text) {
    const IdlToken token = m_tokens.take();
    if (token.text == text && !token.isText) return true;
    fail("\"" + std::string(text) + "\" is missing before \"" +
             std::string(token.text.substr(0, 40)) + "\".",
         token.line);
    return false;
  }
  bool accept(std::string_view text) {
    if (m_tokens.look().text != text || m_tokens.look().isText) return false;
    m_tokens.take();
    return true;
  }
  std::string word() { return std::string(m_tokens.take().text.substr(0, 200)); }

  /// "sensor_msgs::msg::Imu" of "sensor_msgs/msg/Imu" and "sensor_msgs/Imu".
  std::string rootName() const {
    std::string name(m_root.substr(0, 200));
    for (auto at = name.find('/'); at != name.npos; at = name.find('/')) name.replace(at, 1, "::");
    if (m_structs.contains(name)) return name;
    const auto last = name.rfind("::");
    if (last != name.npos) return name.substr(0, last) + "::msg" + name.substr(last);
    return name;
  }

  static std::string joined(const std::string& scope, std::string_view name) {
    return scope.empty() ? std::string(name) : scope + "::" + std::string(name);
  }

  void readDefinition(const std::string& scope, int depth) {
    if (depth > maxRecordedDepth || ++m_count > maxRosFields) {
      return fail("The schema is nested too deep or too long.", m_tokens.look().line);
    }
    const IdlAnnotations annotations = readAnnotations();
    const IdlToken token = m_tokens.take();
    if (token.text == "module") {
      const std::string inner = joined(scope, word());
      if (!expect("{")) return;
      while (!m_error && !m_tokens.look().text.empty() && m_tokens.look().text != "}") {
        readDefinition(inner, depth + 1);
      }
      if (expect("}")) (void)accept(";");
    } else if (token.text == "struct") {
      readStruct(scope, annotations, token.line);
    } else if (token.text == "union") {
      readUnion(scope, annotations, token.line);
    } else if (token.text == "typedef") {
      IdlType type = readType(scope);
      const std::string name = word();
      readDimensions(type);
      m_typedefs[joined(scope, name)] = std::move(type);
      expect(";");
    } else if (token.text == "const") {
      readType(scope);
      const std::string name = joined(scope, word());
      if (!expect("=")) return;
      m_constants[name] = word();
      while (!m_error && !m_tokens.look().text.empty() && m_tokens.look().text != ";") {
        m_tokens.take();
      }
      expect(";");
    } else if (token.text == "enum") {
      readEnumeration(scope);
    } else if (token.text != ";") {
      fail("\"" + std::string(token.text.substr(0, 40)) + "\" is not supported in a schema.",
           token.line);
    }
  }

  IdlAnnotations readAnnotations() {
    IdlAnnotations out;
    while (!m_error && accept("@")) {
      const std::string name = word();
      std::string value;
      if (accept("(")) {
        int open = 1;
        while (!m_error && open > 0 && !m_tokens.look().text.empty()) {
          const IdlToken token = m_tokens.take();
          open += token.text == "(" ? 1 : token.text == ")" ? -1 : 0;
          if (open > 0 && token.text != "value" && token.text != "=") value = token.text;
        }
      }
      if (value.size() >= 2 && value.front() == '"') value = value.substr(1, value.size() - 2);
      if (name == "optional") out.isOptional = value != "false" && value != "FALSE";
      if (name == "id") out.id = numberOf(value);
      if (name == "unit") out.unit = value.substr(0, 20);
      if (name == "final") out.extensibility = Extensibility::Final;
      if (name == "appendable") out.extensibility = Extensibility::Appendable;
      if (name == "mutable") out.extensibility = Extensibility::Mutable;
      if (name == "extensibility") {
        out.extensibility = value == "FINAL"     ? Extensibility::Final
                            : value == "MUTABLE" ? Extensibility::Mutable
                                                 : Extensibility::Appendable;
      }
    }
    return out;
  }

  static std::optional<std::uint32_t> numberOf(std::string_view text) {
    std::uint32_t number = 0;
    const bool isHex = text.starts_with("0x") || text.starts_with("0X");
    if (isHex) text.remove_prefix(2);
    const auto [end, code] =
        std::from_chars(text.data(), text.data() + text.size(), number, isHex ? 16 : 10);
    if (code != std::errc() || end != text.data() + text.size()) return {};
    return number;
  }

  std::string readScopedName() {
    std::string name;
    if (accept("::")) name = "::";
    name += word();
    while (!m_error && accept("::")) name += "::" + word();
    return name.substr(0, 1000);
  }

  IdlType readType(const std::string& scope, int depth = 0) {
    IdlType type;
    type.scope = scope;
    type.line = m_tokens.look().line;
    if (depth > 8) {
      fail("The type is nested too deep.", type.line);
      return type;
    }
    if (accept("sequence")) {
      if (!expect("<")) return type;
      type.items = std::make_shared<IdlType>(readType(scope, depth + 1));
      if (accept(",")) readScopedName();
      expect(">");
      return type;
    }
    type.name = readScopedName();
    if (type.name == "unsigned") type.name += " " + word();
    if (type.name == "long" || type.name == "unsigned long") {
      if (accept("long"))
        type.name += " long";
      else if (accept("double"))
        type.name += " double";
    }
    if ((type.name == "string" || type.name == "wstring") && accept("<")) {
      readScopedName();
      expect(">");
    }
    return type;
  }

  void readDimensions(IdlType& type) {
    while (!m_error && accept("[")) {
      type.dimensions.push_back(readScopedName());
      expect("]");
      if (type.dimensions.size() > 8) fail("The array has too many dimensions.", type.line);
    }
  }

  void readStruct(const std::string& scope, const IdlAnnotations& annotations, int line) {
    const std::string name = joined(scope, word());
    if (accept(";")) return;  // it is defined later
    IdlStruct made;
    made.scope = scope;
    made.line = line;
    made.extensibility = annotations.extensibility;
    if (accept(":")) made.base = readScopedName();
    if (!expect("{")) return;
    while (!m_error && !accept("}")) {
      if (m_tokens.look().text.empty() || ++m_count > maxRosFields) {
        return fail("The struct \"" + name + "\" does not end.", line);
      }
      const IdlAnnotations own = readAnnotations();
      const IdlType type = readType(scope);
      do {
        IdlMember member{word(), type, own};
        readDimensions(member.type);
        made.members.push_back(std::move(member));
      } while (!m_error && accept(","));
      expect(";");
    }
    (void)accept(";");
    m_structs[name] = std::move(made);
  }

  void readUnion(const std::string& scope, const IdlAnnotations& annotations, int line) {
    const std::string name = joined(scope, word());
    if (accept(";")) return;  // it is defined later
    IdlStruct made;
    made.scope = scope;
    made.line = line;
    made.isUnion = true;
    made.extensibility = annotations.extensibility;
    if (made.extensibility == Extensibility::Mutable) {
      return fail("The union \"" + name + "\" is mutable, which is not supported.", line);
    }
    if (!expect("switch") || !expect("(")) return;
    (void)readAnnotations();
    made.members.push_back({"discriminator", readType(scope), {}});
    if (!expect(")") || !expect("{")) return;
    while (!m_error && !accept("}")) {
      if (m_tokens.look().text.empty() || ++m_count > maxRosFields) {
        return fail("The union \"" + name + "\" does not end.", line);
      }
      IdlMember member;
      while (!m_error && (m_tokens.look().text == "case" || m_tokens.look().text == "default")) {
        if (m_tokens.take().text == "default")
          member.isDefaultCase = true;
        else
          member.cases.push_back(readCase());
        expect(":");
      }
      member.annotations = readAnnotations();
      member.type = readType(scope);
      member.name = word();
      readDimensions(member.type);
      expect(";");
      made.members.push_back(std::move(member));
    }
    (void)accept(";");
    m_structs[name] = std::move(made);
  }

  /// A number, a name, or a character as its code.
  std::string readCase() {
    if (accept("-")) return "-" + word();
    if (!accept("'")) return readScopedName();
    const std::string character = word();
    expect("'");
    return character.empty() ? character
                             : std::to_string(static_cast<unsigned char>(character.front()));
  }

  std::int64_t caseOf(const std::string& text, const IdlMember& member, const RosField& choice) {
    if (text == "TRUE" || text == "FALSE") return text == "TRUE" ? 1 : 0;
    const bool isNegative = text.starts_with('-');
    if (const auto number = numberOf(std::string_view(text).substr(isNegative ? 1 : 0))) {
      return isNegative ? -std::int64_t{*number} : std::int64_t{*number};
    }
    const auto last = text.rfind("::");
    const std::string plain = last == text.npos ? text : text.substr(last + 2);
    for (const auto& [code, label] : choice.labels) {
      if (label == plain) return code;
    }
    const std::string constant = lookUp(m_constants, member.type.scope, text);
    const auto number =
        constant.empty() ? std::nullopt : numberOf(m_constants.find(constant)->second);
    if (!number) fail("\"" + text.substr(0, 60) + "\" is not a case.", member.type.line);
    return number.value_or(0);
  }

  void readEnumeration(const std::string& scope) {
    const std::string name = joined(scope, word());
    FieldLabels labels;
    if (!expect("{")) return;
    std::int32_t value = 0;
    while (!m_error && !accept("}")) {
      if (m_tokens.look().text.empty() || labels.size() > 10'000) {
        return fail("The enumeration \"" + name + "\" does not end.", m_tokens.look().line);
      }
      while (!m_error && accept("@")) {
        const std::string annotation = word();
        if (!accept("(")) continue;
        const std::string text = word();
        if (annotation == "value") {
          value = static_cast<std::int32_t>(numberOf(text).value_or(0));
        }
        while (!m_error && !m_tokens.look().text.empty() && !accept(")")) m_tokens.take();
      }
      labels[value++] = word();
      (void)accept(",");
    }
    (void)accept(";");
    m_enumerations[name] = std::move(labels);
  }

  /// Returns the full name of `name` as seen from `scope`; empty if nothing has it.
  template <class Known>
  std::string lookUp(const Known& known, std::string scope, std::string_view name) const {
    if (name.starts_with("::")) {
      const std::string full(name.substr(2));
      return known.contains(full) ? full : std::string();
    }
    for (;;) {
      std::string full = joined(scope, name);
      if (known.contains(full)) return full;
      if (scope.empty()) return {};
      const auto last = scope.rfind("::");
      scope = last == scope.npos ? std::string() : scope.substr(0, last);
    }
  }

  std::uint64_t dimensionOf(const IdlType& type, const std::string& text) {
    if (const auto number = numberOf(text)) return *number;
    const std::string constant = lookUp(m_constants, type.scope, text);
    const auto number =
        constant.empty() ? std::nullopt : numberOf(m_constants.find(constant)->second);
    if (!number) fail("\"" + text.substr(0, 60) + "\" is not the size of an array.", type.line);
    return number.value_or(0);
  }

  std::size_t resolveStruct(const std::string& name, int depth) {
    if (const auto known = m_indices.find(name); known != m_indices.end()) return known->second;
    const std::size_t index = m_types.structs.size();
    m_indices[name] = index;
    const IdlStruct& from = m_structs.find(name)->second;
    std::string shown = name;
    for (auto at = shown.find("::"); at != shown.npos; at = shown.find("::")) {
      shown.replace(at, 2, "/");
    }
    m_types.structs.push_back({shortType(shown), {}, from.extensibility, from.isUnion});
    if (depth > 2 * maxRecordedDepth) {
      fail("The types are nested too deep.", from.line);
      return index;
    }
    std::vector<RosField> fields;
    if (!from.base.empty()) {
      const std::string base = lookUp(m_structs, from.scope, from.base);
      if (base.empty() || base == name) {
        fail("The base \"" + from.base.substr(0, 60) + "\" is unknown.", from.line);
      } else {
        fields = m_types.structs[resolveStruct(base, depth + 1)].fields;
      }
    }
    std::uint32_t id = 0;
    for (const IdlMember& member : from.members) {
      if (m_error) break;
      RosField field;
      field.name = member.name;
      field.isOptional = member.annotations.isOptional;
      field.unit = member.annotations.unit;
      field.id = id = member.annotations.id.value_or(id);
      ++id;
      resolve(member.type, field, depth);
      if (from.isUnion && fields.empty() && !isChoice(field)) {
        fail("The discriminator of \"" + name + "\" is not a whole number.", from.line);
      }
      field.isDefaultCase = member.isDefaultCase;
      for (const std::string& text : member.cases) {
        field.cases.push_back(caseOf(text, member, fields.front()));
      }
      fields.push_back(std::move(field));
      if (++m_count > maxRosFields) fail("The schema has too many fields.", from.line);
    }
    m_types.structs[index].fields = std::move(fields);
    return index;
  }

  static bool isChoice(const RosField& field) {
    return field.list == RosList::One &&
           (field.kind <= RosKind::UInt64 || field.kind == RosKind::Enumeration);
  }

  /// Puts a list into a struct of its own, so that lists can be in lists.
  void wrap(RosField& field) {
    RosField inner = field;
    inner.name.clear();
    inner.unit = field.unit;
    inner.isOptional = false;
    m_types.structs.push_back({"", {inner}, Extensibility::Final});
    field.kind = RosKind::Struct;
    field.list = RosList::One;
    field.count = 0;
    field.type = m_types.structs.size() - 1;
    field.labels.clear();
  }

  void resolve(const IdlType& type, RosField& field, int depth) {
    if (depth > 2 * maxRecordedDepth) return fail("The types are nested too deep.", type.line);
    if (type.items) {
      resolve(*type.items, field, depth + 1);
      if (field.list != RosList::One) wrap(field);
      field.list = RosList::Sequence;
    } else {
      resolveName(type, field, depth);
    }
    std::uint64_t count = 1;
    for (const std::string& dimension : type.dimensions) {
      count *= dimensionOf(type, dimension);
      if (count > 1U << 28U) return fail("The array is too large.", type.line);
    }
    if (type.dimensions.empty()) return;
    if (field.list == RosList::Array) {
      count *= field.count;  // an array of arrays
      if (count > 1U << 28U) return fail("The array is too large.", type.line);
    } else if (field.list == RosList::Sequence) {
      wrap(field);
    }
    field.list = RosList::Array;
    field.count = static_cast<std::uint32_t>(count);
  }

  void resolveName(const IdlType& type, RosField& field, int depth) {
    const auto basic = std::ranges::find(idlNames, type.name, &IdlName::name);
    if (basic != idlNames.end()) {
      field.kind = basic->kind;
      return;
    }
    if (const std::string name = lookUp(m_typedefs, type.scope, type.name); !name.empty()) {
      return resolve(m_typedefs.find(name)->second, field, depth + 1);
    }
    if (const std::string name = lookUp(m_enumerations, type.scope, type.name); !name.empty()) {
      field.kind = RosKind::Enumeration;
      field.labels = m_enumerations.find(name)->second;
      return;
    }
    const std::string name = lookUp(m_structs, type.scope, type.name);
    if (type.name.ends_with("builtin_interfaces::msg::Time")) {
      field.kind = RosKind::Time;
    } else if (type.name.ends_with("builtin_interfaces::msg::Duration")) {
      field.kind = RosKind::TimeSpan;
    } else if (name.empty()) {
      fail("The type \"" + type.name.substr(0, 100) + "\" is unknown.", type.line);
    } else {
      field.kind = RosKind::Struct;
      field.type = resolveStruct(name, depth + 1);
    }
  }

  std::string_view m_root;
  IdlTokens m_tokens;
  std::optional<Error> m_error;
  std::size_t m_count = 0;
  std::map<std::string, IdlStruct> m_structs;
  std::map<std::string, IdlType> m_typedefs;
  std::map<std::string, FieldLabels> m_enumerations;
  std::map<std::string, std::string> m_constants;
  std::map<std::string, std::size_t> m_indices;
  RosTypes m_types;
};

}  // namespace

Result<RosTypes> rosTypesFromIdl(std::string_view type, std::string_view text) {
  if (text.size() > maxRosText) {
    return failure(ErrorCode::ParseError, "The schema is larger than 4 MiB.");
  }
  return Idl(type, text).read();
}

}  // namespace pitchboard::telemetry
