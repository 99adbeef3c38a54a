// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/formats/text_decoder.h>

#include <algorithm>
#include <limits>

#include <telemetry/formats/message_format.h>

#include "field_values.h"
#include "message_readers.h"
#include "published_values.h"

namespace pitchboard::telemetry {
namespace {

/// Splits the text at white space, or at another character, while it looks at every byte once.
class TokenSplitter {
 public:
  TokenSplitter(std::string_view text, char separator)
      : m_at(text.data()), m_end(text.data() + text.size()), m_separator(separator) {}

  /// Returns the next token; false at the end of the text. Between two semicolons it may be empty.
  bool next(std::string_view& token) {
    while (m_at != m_end && isSpace(*m_at)) ++m_at;
    if (m_at == m_end) return false;
    const char* begin = m_at;
    if (m_separator == ' ') {
      while (m_at != m_end && !isSpace(*m_at)) ++m_at;
      token = {begin, static_cast<std::size_t>(m_at - begin)};
      return true;
    }
    while (m_at != m_end && *m_at != m_separator) ++m_at;
    const char* end = m_at;
    while (end != begin && isSpace(*(end - 1))) --end;
    token = {begin, static_cast<std::size_t>(end - begin)};
    if (m_at != m_end) ++m_at;
    return true;
  }

 private:
  const char* m_at;
  const char* m_end;
  char m_separator;
};

}  // namespace

struct TextDecoder::Plan {
  Plan(Profile profile, const Surroundings& where)
      : sent(std::move(profile)), published(sent, where), keys(sent) {}
  Profile sent;
  PublishedValues published;
  FieldMap keys;
};

TextDecoder::TextDecoder(Profile profile, const Surroundings& where)
    : m_plan(std::make_unique<const Plan>(std::move(profile), where)) {
  m_indices.fill(DecodedText::maxValues);
  const auto& fields = m_plan->published.shown().fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    m_indices[static_cast<std::size_t>(fields[i].meaning)] = i;
  }
  m_indices[static_cast<std::size_t>(FieldMeaning::None)] = DecodedText::maxValues;
}

TextDecoder::~TextDecoder() = default;

const Profile& TextDecoder::profile() const {
  return m_plan->published.shown();
}

void TextDecoder::decode(std::string_view datagram, DecodedText& out) const {
  out.robot = 0;
  out.team.reset();
  out.errors = {};
  out.badField = 0;
  out.count = out.namedExtras = out.dropped = 0;
  if (datagram.size() > maxBytes) return out.errors.add(TextError::TooLong);
  const Profile& sent = m_plan->sent;
  if (isTextFormat(sent.format)) {
    while (!datagram.empty() && (datagram.back() == '\0' || isSpace(datagram.back()))) {
      datagram.remove_suffix(1);
    }
    const bool utf8 = sent.utf8 || sent.format != MessageFormat::Words;
    if (!isText(datagram, utf8)) return out.errors.add(TextError::Binary);
  }
  if (datagram.empty()) return out.errors.add(TextError::Empty);
  if (sent.format == MessageFormat::Words) {
    decodeWords(datagram, out);
  } else {
    decodeFields(datagram, out);
  }
}

void TextDecoder::decode(const DatagramView& datagram, DecodedText& out) const {
  decode(datagram.payload, out);
  const RobotFrom& from = m_plan->sent.robotFrom;
  if (from.source == RobotFrom::Source::Message || !out.accepted()) return;
  const int sent = from.source == RobotFrom::Source::Port
                       ? int{datagram.localPort}
                       : static_cast<int>(datagram.sender.address.value & 0xffU);
  out.robot = std::max(0, sent - from.base);
  if (out.robot < 1 || out.robot > maxRobot) {
    out.robot = 0;
    out.errors.add(TextError::BadRobot);
  }
}

void TextDecoder::decodeWords(std::string_view datagram, DecodedText& out) const {
  const Profile& sent = m_plan->sent;
  const std::size_t fields = sent.fields.size();
  // Values that are made of others stand between the fields and what nobody named.
  const std::size_t shown = profile().fields.size();
  const std::string_view end = sent.end;
  out.made.clear();
  TokenSplitter tokens(datagram, sent.separator);
  std::string_view token;
  std::size_t read = 0;
  bool more = false, ended = false;
  while ((more = tokens.next(token))) {
    ended = !end.empty() && token == end;
    if (ended) break;
    const std::size_t index = read < fields ? read : read + shown - fields;
    if (index >= DecodedText::maxValues) {
      out.errors.add(TextError::TooManyFields);
      while (!ended && tokens.next(token)) ended = !end.empty() && token == end;
      break;
    }
    if (read < fields) {
      setText(sent.fields[read], index, token, out);
    } else {
      // It may be anything until the team gives it a type: it is kept as text.
      out.texts[index] = token;
      out.values[index] = readFloat(token).value;
    }
    ++read;
  }
  out.count = read < fields ? read : read + shown - fields;
  if (read < fields) {
    findRobot(out);
    out.errors.add(TextError::MissingFields);
  } else {
    findRobot(out);
    publish(out);
  }
  if (end.empty()) return;
  if (!ended) {
    out.errors.add(TextError::MissingEnd);
  } else if (tokens.next(token)) {
    out.errors.add(TextError::TrailingText);
  }
}

void TextDecoder::decodeFields(std::string_view datagram, DecodedText& out) const {
  const Profile& sent = m_plan->sent;
  clearFields(profile().fields.size(), out);
  if (!sent.end.empty() && isTextFormat(sent.format)) {
    if (!datagram.ends_with(sent.end)) return out.errors.add(TextError::MissingEnd);
    datagram.remove_suffix(sent.end.size());
  }
  FieldSink sink(m_plan->keys, sent.format, out);
  const auto isGood = [&] {
    switch (sent.format) {
      case MessageFormat::KeyValue:
        return readKeyValue(datagram, sent.separator, sink);
      case MessageFormat::Json:
        return readJson(datagram, sink);
      case MessageFormat::Lua:
        return readLua(datagram, sink);
      case MessageFormat::Binary:
        return readBinary(sent, datagram, out);
      case MessageFormat::Mitecom:
        return readMitecom(datagram, sink);
      case MessageFormat::Hulks:
        return readHulks(datagram, sink);
      case MessageFormat::CitBrains:
        return readCitBrains(datagram, sink);
      case MessageFormat::Protobuf:
        return readProtobuf(sent.message, datagram, sink);
      case MessageFormat::Words:
        break;
    }
    return false;
  };
  if (!isGood() && !sent.tolerant) out.errors.add(TextError::BadFormat);
  findRobot(out);
  publish(out);
}

void TextDecoder::findRobot(DecodedText& out) const {
  if (const auto team = value(out, FieldMeaning::Team); team && *team >= 0.0) {
    out.team = static_cast<int>(*team);
  }
  const Profile& sent = m_plan->sent;
  if (sent.robotFrom.source != RobotFrom::Source::Message) return;
  const std::size_t index = m_indices[static_cast<std::size_t>(FieldMeaning::Robot)];
  const auto robot = value(out, FieldMeaning::Robot);
  if (robot && *robot >= 1.0 && *robot <= maxRobot) {
    out.robot = static_cast<int>(*robot);
  } else if (index < out.count) {
    out.errors.add(TextError::BadRobot);
  }
}

void TextDecoder::publish(DecodedText& out) const {
  const std::size_t fields = m_plan->sent.fields.size();
  const std::size_t shown = profile().fields.size();
  for (std::size_t i = fields; i < shown; ++i) {
    out.values[i] = std::numeric_limits<double>::quiet_NaN();
    out.texts[i] = {};
  }
  for (const std::size_t index : m_plan->published.convert(out.values)) {
    out.texts[index] =
        std::isnan(out.values[index]) ? std::string_view() : numberText(out.values[index], out);
  }
}

std::string TextDecoder::name(const DecodedText& decoded, std::size_t index) const {
  const auto& fields = profile().fields;
  if (index < fields.size()) return fields[index].name;
  const std::size_t extra = index - fields.size();
  return extra < decoded.namedExtras ? std::string(decoded.extraKeys[extra]) : otherName(extra);
}

std::string TextDecoder::otherName(std::size_t extra) {
  return "OTHER_" + std::to_string(extra + 1);
}

std::optional<double> TextDecoder::value(const DecodedText& decoded, FieldMeaning meaning) const {
  const std::size_t index = m_indices[static_cast<std::size_t>(meaning)];
  if (!decoded.has(index)) return std::nullopt;
  return decoded.values[index];
}

}  // namespace pitchboard::telemetry
